//! The common answer of every method: the drag law, an estimate with its error, trust and its reasons, warnings, errors.

#[cfg(feature = "std")]
pub(crate) mod any_float;
#[cfg(feature = "std")]
mod budget;
#[cfg(feature = "std")]
mod covariance;
#[cfg(feature = "std")]
pub(crate) mod distribution;
mod drag_law;
mod error;
#[cfg(feature = "std")]
mod estimate;
#[cfg(feature = "std")]
mod laws;
#[cfg(feature = "std")]
mod parameter;
#[cfg(feature = "std")]
mod practical;
#[cfg(feature = "std")]
mod reported;
#[cfg(feature = "std")]
mod term;
#[cfg(feature = "std")]
mod trust;
#[cfg(feature = "std")]
mod warning;

pub use drag_law::DragLaw;
pub use error::IdentifyError;
pub(crate) use error::READ_AGAIN;
#[cfg(feature = "std")]
pub use {
    budget::{Assumptions, BudgetEntry, ErrorSource},
    covariance::DragCovariance,
    estimate::{ConfidenceInterval, Disturbances, Estimate},
    laws::{DragVerdict, LawEvidence},
    parameter::{AxisParameter, Delay},
    reported::Reported,
    term::Term,
    trust::{Reason, Trust},
    warning::Warning,
};
#[cfg(feature = "std")]
pub(crate) use {covariance::matrix, practical::MotionScale};
