//! Processes with dead time from a record: heaters, tanks, axes. Time constants and dead time are searched; gain, load and initial
//! state are linear and projected out (variable projection: Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973). Gains follow for all
//! that the record leaves, with a limit of the sensitivity that is proved.
//!
//! | file | content |
//! |---|---|
//! | `process` | structures, parameters with intervals |
//! | `response`, `innovation_filter`, `projection` | answers to a logged command, innovations, and least squares over them |
//! | `search`, `structure_fit`, `fit` | dead time and time constants; intervals and evidence of a structure; the processes of a record |
//! | `load_step` | a loop's answer to a step of the load, and its integral of the absolute error |
//! | `exchange`, `gains` | the fastest gains for every process of the record's confidence set, and the proof of their sensitivity |
//! | `curves` | open loop and answer to a load, of the likeliest process and at the ends of the confidence set |
//! | `rules` | rules of thumb beside them |
//! | `first_order`, `on_board` | on a controller: gains of bounded sensitivity, a first-order process from readings, without allocation |
//! | `error` | why a record identifies no process |

#[cfg(feature = "std")]
mod curves;
mod error;
#[cfg(feature = "std")]
mod exchange;
mod first_order;
#[cfg(feature = "std")]
mod fit;
#[cfg(feature = "std")]
mod gains;
#[cfg(feature = "std")]
mod innovation_filter;
#[cfg(feature = "std")]
mod load_step;
mod on_board;
#[cfg(feature = "std")]
mod process;
#[cfg(feature = "std")]
mod projection;
#[cfg(feature = "std")]
mod response;
#[cfg(feature = "std")]
mod rules;
#[cfg(feature = "std")]
mod search;
#[cfg(feature = "std")]
mod structure_fit;

#[cfg(feature = "std")]
pub use curves::LoopCurves;
pub use error::ProcessError;
pub use first_order::FirstOrderProcess;
#[cfg(feature = "std")]
pub use first_order::RelayCycle;
#[cfg(feature = "std")]
pub use gains::{Actions, GainsWanted, ProvedGains, ultimate};
pub use on_board::ProcessReadings;
#[cfg(feature = "std")]
pub use process::{Contradiction, Family, ProcessModel, ProcessRecord, Ranged};
#[cfg(feature = "std")]
pub use rules::{Ruled, rules};

/// Share of the output's variance that a structure must explain: below, a fifth is noise, or the record is not what its columns say.
const LEAST_EXPLAINED: f64 = 0.8;
