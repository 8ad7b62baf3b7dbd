//! The gains of a controller.

use super::ControlError;
use crate::numeric::{Limit, Scalar, domain};

/// On what the three actions of a controller act. The derivative always acts on the measurement, so that a step of the
/// reference gives no kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Structure {
    /// Proportional to the error; no integral.
    Pd,
    /// Proportional to the error, with its integral.
    Pid,
    /// Integral of the error; proportional to the measurement, so that a step of the reference is not overshot.
    Ipd,
}

impl Structure {
    /// Its name in lower case.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pd => "pd",
            Self::Pid => "pid",
            Self::Ipd => "ipd",
        }
    }
}

/// Gains of a controller: from the error to the command `K_p + K_i/s`, from the measurement `-K_d s/(filter_s s + 1)`.
///
/// With the command in F and the coordinate in x: `proportional` F/x, `integral` F/(x s), `derivative` F s/x. A loop
/// feels the same gains in each [`Structure`]; only the answer to the reference differs.
///
/// ```
/// use selfosc::control::{Gains, Structure};
/// let gains = Gains::new(Structure::Pd, 0.5, 0.0, 0.3, 0.02)?;
/// assert_eq!(gains.derivative(), 0.3);
/// assert!(Gains::new(Structure::Pd, 0.5, 0.1, 0.3, 0.02).is_err()); // a PD has no integral gain
/// # Ok::<(), selfosc::control::ControlError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "std",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "GainsParts<T>", bound(deserialize = "T: Scalar + serde::Deserialize<'de>"))
)]
pub struct Gains<T> {
    structure: Structure,
    proportional: T,
    integral: T,
    derivative: T,
    filter_s: T,
}

/// Gains as they are written, not yet checked.
#[cfg(feature = "std")]
#[derive(serde::Deserialize)]
struct GainsParts<T> {
    structure: Structure,
    proportional: T,
    integral: T,
    derivative: T,
    filter_s: T,
}

#[cfg(feature = "std")]
impl<T: Scalar> TryFrom<GainsParts<T>> for Gains<T> {
    type Error = ControlError;

    fn try_from(parts: GainsParts<T>) -> Result<Self, ControlError> {
        Self::new(parts.structure, parts.proportional, parts.integral, parts.derivative, parts.filter_s)
    }
}

impl<T: Scalar> Gains<T> {
    /// Gains as they are. `filter_s` is the time constant of the filter on the derivative, zero where speed itself is
    /// measured.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless the proportional gain is positive, the others zero or more, all finite; and
    /// for an integral gain of a PD, or none of an I-PD.
    pub fn new(
        structure: Structure,
        proportional: T,
        integral: T,
        derivative: T,
        filter_s: T,
    ) -> Result<Self, ControlError> {
        domain::positive("proportional gain", proportional, "command per output unit")?;
        match structure {
            Structure::Pd => {
                let remedy = "give 0, or choose a structure with an integral";
                domain::require("integral gain of a PD controller", integral, "", Limit::Within(0.0, 0.0), remedy)?
            }
            Structure::Pid => domain::non_negative("integral gain", integral, "command per output unit and s")?,
            Structure::Ipd => {
                domain::positive("integral gain of an I-PD controller", integral, "command per output unit and s")?
            }
        };
        domain::non_negative("derivative gain", derivative, "command per output unit per s")?;
        domain::non_negative("time constant of the filter", filter_s, "s")?;
        Ok(Self { structure, proportional, integral, derivative, filter_s })
    }

    /// On what the actions act.
    pub fn structure(&self) -> Structure {
        self.structure
    }
    /// Proportional gain K_p, F/x.
    pub fn proportional(&self) -> T {
        self.proportional
    }
    /// Integral gain K_i, F/(x s); zero for none.
    pub fn integral(&self) -> T {
        self.integral
    }
    /// Derivative gain K_d, F s/x; zero for none.
    pub fn derivative(&self) -> T {
        self.derivative
    }
    /// Time constant of the filter on the derivative, s; zero for none.
    pub fn filter_s(&self) -> T {
        self.filter_s
    }
}
