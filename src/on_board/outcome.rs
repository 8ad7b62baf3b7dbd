//! The result of a finished experiment.

use crate::features::Features;
use crate::identify::exact::MeanCycle;
use crate::identify::iso::{Oscillation, Parameters};
use crate::identify::{DragLaw, IdentifyError};
use crate::numeric::Scalar;
use crate::plant::DragAxis;

/// Features of the steady cycles of the last attempt, with the relay's parameters. Their spreads and number are its
/// quality; errors of the parameters by the sensor and the drag law are not in them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Outcome<T> {
    /// Means and spreads over the steady cycles: the same numbers as of the attempt's record as a whole.
    pub features: Features<T>,
    /// Relay level C of the last attempt.
    pub relay_level: T,
    /// Half-width x_a of the last attempt.
    pub half_width: T,
    /// Attempts it took.
    pub attempts: u8,
}

impl<T: Scalar> Outcome<T> {
    pub(super) fn new(features: Features<T>, relay_level: T, half_width: T, attempts: u8) -> Self {
        Self { features, relay_level, half_width, attempts }
    }

    /// Parameters by the paper's method, for the whole delay of the loop. In the units of reading and command.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] for a delay that is none.
    pub fn iso(&self, delay_s: T) -> Result<Parameters<T>, IdentifyError> {
        Oscillation::of(&self.features, self.relay_level, delay_s).identify()
    }

    /// The axis whose exact limit cycle has these features, for the whole delay of the loop. Two features cannot tell mixed
    /// drag: that answers as linear drag does.
    ///
    /// # Errors
    /// Those of [`MeanCycle::linear_drag`].
    pub fn exact(&self, law: DragLaw, delay_s: T) -> Result<DragAxis<T>, IdentifyError> {
        let cycle = MeanCycle::of(&self.features, self.relay_level, delay_s);
        match law {
            DragLaw::Quadratic => cycle.quadratic_drag(),
            DragLaw::Linear | DragLaw::Mixed => cycle.linear_drag(),
        }
    }
}
