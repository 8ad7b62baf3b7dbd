//! The experiment on the vehicle itself: sample by sample, without allocation, in f32 or f64.
//!
//! An [`Experiment`] is fed with readings and answers with commands. It watches its sensor and its clock, switches the relay,
//! finds the cycles, notices when they repeat, and tries new relay parameters when they do not. It ends at the neutral
//! command: with an [`Outcome`], with a named [`Fault`], or upon [`Experiment::abort`]. No reading of a sensor makes it
//! panic or exceed the command's limits.
//!
//! | file | content |
//! |---|---|
//! | `protocol` | what is to be done and within which limits |
//! | `sensor` | from readings to the coordinate that the relay sees; what a sound sensor cannot say |
//! | `supervisor` | the state machine: relay, time-outs, attempts, faults |
//! | `steadiness` | cycles, and whether they repeat |
//! | `experiment` | all of it together |
//! | `outcome` | what a finished experiment found |

mod experiment;
mod fault;
mod outcome;
mod protocol;
mod sensor;
mod steadiness;
mod supervisor;

pub use experiment::Experiment;
pub use fault::Fault;
pub use outcome::Outcome;
pub use protocol::{Coordinate, Protocol};
#[cfg(feature = "std")]
pub(crate) use supervisor::{Key, Observation, Observer, Supervisor};
pub use supervisor::{Phase, Step};
