//! Why there is no model.

use crate::describing::DescribingError;
use crate::nonlinearity::NonlinearityError;

/// Why an oscillation gives no model.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// A feature that is not a number of the right kind.
    #[error("{feature} = {value} must be {required}; read it off the record again")]
    Feature {
        /// Name and unit of the feature.
        feature: &'static str,
        /// The value given, in that unit.
        value: f64,
        /// What it has to be.
        required: &'static str,
    },
    /// Condition 40 is not met, or the relay or the input is not one.
    #[error(transparent)]
    Describing(#[from] DescribingError),
}

impl From<NonlinearityError> for IdentifyError {
    fn from(error: NonlinearityError) -> Self {
        Self::Describing(error.into())
    }
}
