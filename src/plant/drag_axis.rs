//! One degree of freedom of an underwater vehicle: inertia, drag, a constant disturbance and a delay.

use super::PlantError;
use crate::numeric::{Limit, Real, domain};

/// The axis `alpha x'' + beta_1 x' + beta_2 |x'| x' = u(t - T_d) + delta` (eq. 6 and Table 2; eq. 36 with the delay).
///
/// With forces in F (N, or N m for a rotation) and the coordinate in x (m, or rad), `alpha` has unit F s^2/x, `beta_1`
/// F s/x, `beta_2` F s^2/x^2, `delta` F. Drag whose *force* is proportional to speed is linear drag, to its square
/// quadratic drag; the paper names the drag coefficient and says constant and linear. The delay is the whole delay of
/// the loop, that of the actuator and that of the sensor.
///
/// ```
/// use selfosc::plant::DragAxis;
/// let yaw = DragAxis::quadratic(6e-4, 2e-5)?.with_disturbance(1e-3)?.with_delay_s(0.2)?;
/// assert_eq!(yaw.quadratic_drag(), 2e-5);
/// assert!(DragAxis::linear(0.0, 1.0).is_err());
/// # Ok::<(), selfosc::plant::PlantError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "std",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "DragAxisParts<T>", bound(deserialize = "T: Real + serde::Deserialize<'de>"))
)]
pub struct DragAxis<T> {
    alpha: T,
    linear_drag: T,
    quadratic_drag: T,
    disturbance: T,
    delay_s: T,
}

/// An axis as it is written, not yet checked.
#[cfg(feature = "std")]
#[derive(serde::Deserialize)]
struct DragAxisParts<T> {
    alpha: T,
    linear_drag: T,
    quadratic_drag: T,
    disturbance: T,
    delay_s: T,
}

#[cfg(feature = "std")]
impl<T: Real> TryFrom<DragAxisParts<T>> for DragAxis<T> {
    type Error = PlantError;

    fn try_from(parts: DragAxisParts<T>) -> Result<Self, PlantError> {
        let axis = Self::mixed(parts.alpha, parts.linear_drag, parts.quadratic_drag)?;
        axis.with_disturbance(parts.disturbance)?.with_delay_s(parts.delay_s)
    }
}

impl<T: Real> DragAxis<T> {
    /// Linear and quadratic drag together; no disturbance, no delay.
    ///
    /// # Errors
    /// [`PlantError::OutOfDomain`] unless `alpha > 0` and both drag coefficients are zero or more, all finite.
    pub fn mixed(alpha: T, linear_drag: T, quadratic_drag: T) -> Result<Self, PlantError> {
        let remedy = "give the inertia with added mass";
        domain::require("alpha", alpha, "F s^2/x", Limit::Positive, remedy)?;
        let remedy = "drag takes energy out: check its sign, or give 0";
        domain::require("linear_drag", linear_drag, "F s/x", Limit::NonNegative, remedy)?;
        domain::require("quadratic_drag", quadratic_drag, "F s^2/x^2", Limit::NonNegative, remedy)?;
        Ok(Self { alpha, linear_drag, quadratic_drag, disturbance: T::zero(), delay_s: T::zero() })
    }

    /// Drag force proportional to speed (the paper's case 1, eqs. 26-27).
    ///
    /// # Errors
    /// As [`mixed`](Self::mixed).
    pub fn linear(alpha: T, linear_drag: T) -> Result<Self, PlantError> {
        Self::mixed(alpha, linear_drag, T::zero())
    }

    /// Drag force proportional to the square of speed (the paper's case 2, eqs. 28-29).
    ///
    /// # Errors
    /// As [`mixed`](Self::mixed).
    pub fn quadratic(alpha: T, quadratic_drag: T) -> Result<Self, PlantError> {
        Self::mixed(alpha, T::zero(), quadratic_drag)
    }

    /// The same axis under the constant force `disturbance`, in F.
    ///
    /// # Errors
    /// [`PlantError::OutOfDomain`] unless it is finite.
    pub fn with_disturbance(self, disturbance: T) -> Result<Self, PlantError> {
        domain::finite("disturbance", disturbance, "F")?;
        Ok(Self { disturbance, ..self })
    }

    /// The same axis with the delay `delay_s`, in s.
    ///
    /// # Errors
    /// [`PlantError::OutOfDomain`] unless it is finite and zero or more.
    pub fn with_delay_s(self, delay_s: T) -> Result<Self, PlantError> {
        domain::non_negative("delay_s", delay_s, "s")?;
        Ok(Self { delay_s, ..self })
    }

    /// Inertia with added mass, alpha, in F s^2/x.
    #[inline]
    pub fn alpha(&self) -> T {
        self.alpha
    }
    /// Coefficient beta_1 of the drag force proportional to speed, in F s/x.
    #[inline]
    pub fn linear_drag(&self) -> T {
        self.linear_drag
    }
    /// Coefficient beta_2 of the drag force proportional to the square of speed, in F s^2/x^2.
    #[inline]
    pub fn quadratic_drag(&self) -> T {
        self.quadratic_drag
    }
    /// Constant disturbing force delta, in F.
    #[inline]
    pub fn disturbance(&self) -> T {
        self.disturbance
    }
    /// Delay T_d between command and force, in s.
    #[inline]
    pub fn delay_s(&self) -> T {
        self.delay_s
    }
}
