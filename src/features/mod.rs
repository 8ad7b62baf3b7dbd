//! What a self-oscillation shows: cycles, and means over them with their spreads.
//!
//! [`Cycles`] and [`Summary`] work on samples as they come, without allocation; a whole record goes through the same two.

#[cfg(feature = "std")]
mod batch;
mod cycle;
mod error;
#[cfg(feature = "std")]
mod manoeuvre;
#[cfg(feature = "std")]
mod orders;
mod peak;
mod summary;

pub use cycle::{Cycle, Cycles};
pub use error::FeatureError;
pub use summary::{CycleStatistics, Features, Summary};
#[cfg(feature = "std")]
pub use {
    batch::{RecordFeatures, RelayLevels},
    manoeuvre::NotAnExperiment,
};

/// Half-periods without a change of the command that count as lost, against the longest seen.
pub(crate) const LOST: f64 = 4.0;
