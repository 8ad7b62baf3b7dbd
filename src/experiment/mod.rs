//! The experiment: a relay in the loop, and the record that it leaves.

#[cfg(feature = "std")]
mod clinic;
#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
mod live;
#[cfg(feature = "std")]
mod log;
#[cfg(feature = "std")]
mod record;
mod relay;
#[cfg(feature = "std")]
mod rows;
#[cfg(feature = "std")]
mod simulation;

#[cfg(feature = "std")]
pub use clinic::TimeUnit;
#[cfg(feature = "std")]
pub use error::{ExperimentError, Place};
#[cfg(feature = "std")]
pub use live::LiveVehicle;
#[cfg(feature = "std")]
pub use log::{Columns, Log};
#[cfg(feature = "std")]
pub use record::Record;
pub use relay::RelayState;
#[cfg(feature = "std")]
pub use simulation::{Sensor, SimulatedExperiment};
