//! Why there is no model.

use crate::describing::DescribingError;
use crate::nonlinearity::NonlinearityError;
use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, AtLeast, AtMost, Plain};
use crate::orbit::OrbitError;
use crate::plant::PlantError;

/// Why an oscillation gives no model.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// A feature or setting outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// No orbit of a drag axis has these features.
    #[error(
        "switching level over amplitude is {}, but orbits with these times and this delay have it below {} \
         (1 - delay (1/t_plus + 1/t_minus)), and above 0 without a delay; read the level where the command was given \
         (--half-width), and check the delay (--delay)", AtLeast(*.ratio), AtMost(*.limit)
    )]
    NoOrbit {
        /// Switching level over amplitude.
        ratio: f64,
        /// Its upper bound, however strong the drag.
        limit: f64,
    },
    /// The features are those of an orbit whose drag is lost in rounding.
    #[error(
        "switching level over amplitude is {}, too near its limits to tell the drag; repeat the experiment with another \
         half-width, as `selfosc design` proposes", About(*.ratio)
    )]
    Unresolved {
        /// Switching level over amplitude.
        ratio: f64,
    },
    /// Fewer numbers measured than parameters asked for.
    #[error(
        "{equations} residuals for {parameters} parameters, which leaves nothing to judge the fit by; give more \
         experiments or fix the delay (--delay)"
    )]
    TooFewEquations {
        /// Residuals there are.
        equations: usize,
        /// Parameters to estimate.
        parameters: usize,
    },
    /// The experiments do not tell the parameters apart.
    #[error(
        "some combination of the parameters changes the residuals only {} times as much as another does; give \
         experiments that differ more in relay level or half-width, or fix the delay (--delay)", About(*.ratio)
    )]
    Confounded {
        /// Smallest over largest singular value of the scaled Jacobian.
        ratio: f64,
    },
    /// The search for the best parameters did not end.
    #[error(
        "the parameters still move after {steps} steps, at a residual rms of {}; leave out the start-up (--from) and records of \
         other vehicles, or give the delay (--delay) or the drag law (--drag)", About(*.rms)
    )]
    NotSettled {
        /// Steps made.
        steps: usize,
        /// Residual rms reached.
        rms: f64,
    },
    /// The output answers the command's opposite.
    #[error("the output moves against the command: say that it is logged with the opposite sign (--invert)")]
    CommandSign,
    /// The first harmonic belongs to no vehicle.
    #[error(
        "{parameter} = {} by the first harmonic with a delay of {} s in a period of {} s, but it must be \
         above 0; check the delay (--delay), and the sign of the command (--invert)",
        Plain(*.value), Plain(*.delay_s), Plain(*.period_s)
    )]
    Unphysical {
        /// The parameter.
        parameter: &'static str,
        /// Its value, in units of the experiment.
        value: f64,
        /// Delay given, in s.
        delay_s: f64,
        /// Period, in s.
        period_s: f64,
    },
    /// No limit cycle at the parameters tried.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
    /// The parameters tried are not those of a plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// Condition 40 fails, or the relay or the input is outside its domain.
    #[error(transparent)]
    Describing(#[from] DescribingError),
}

crate::numeric::codes! { pub IdentifyError {
    OutOfDomain.0 => "feature", NoOrbit => "no-orbit", Unresolved => "unresolved",
    TooFewEquations => "too-few-equations", Confounded => "confounded", NotSettled => "not-settled",
    CommandSign => "command-sign", Unphysical => "unphysical", Orbit.0 => "orbit", Plant.0 => "plant",
    Describing.0 => "condition-40",
} }

impl From<NonlinearityError> for IdentifyError {
    fn from(error: NonlinearityError) -> Self {
        Self::Describing(error.into())
    }
}

/// The remedy for a feature that is no number.
pub(crate) const READ_AGAIN: &str = "read it off the record again";
