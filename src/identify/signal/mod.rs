//! What a record shows before any model is fitted to it: its half-period, its clock, the pieces of its command, readings that stand
//! apart or repeat, and the state at a time.

mod clock;
mod command;
mod numbers;
mod outliers;
mod repeats;
#[allow(clippy::module_inception, reason = "the type that the room is named after")]
mod signal;

pub use clock::Clock;
pub(crate) use clock::grid;
pub use command::SwitchingInstant;
pub(crate) use command::{CommandPiece, is_switched};
pub(crate) use numbers::least_squares;
pub(crate) use outliers::outliers;
pub(crate) use repeats::weights_of_repeats;
pub(crate) use signal::{Signal, half_period_s};
