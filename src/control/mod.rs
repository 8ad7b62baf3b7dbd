//! Controllers from an identified axis, and their margins.
//!
//! | file | content |
//! |---|---|
//! | `design` | gains from a bandwidth by pole placement |
//! | `open_loop`, `margins` | crossovers, stability and margins with the delay |
//! | `closed_loop` | poles and bandwidth, computed without the design equations |
//! | `model` | an axis with every term that an identification may report |
//! | `uncertain_drag` | slopes of a drag whose coefficients vary together |
//! | `process`, `robust` | processes with lags, filters, memory; margins and sensitivity proved over a box of them |
//! | `controller`, `reference` | what runs on the vehicle |
//! | `response` | the simulated answer to a step, and its figures |
//! | `ultimate`, `rules` | the critical point from relay experiments, and the classic rules |
//!
//! Design, margins, controllers, ultimate point and rules need neither `std` nor a heap, in f32 or f64.

#[cfg(feature = "std")]
mod closed_loop;
mod controller;
mod criterion;
mod design;
mod error;
mod gains;
mod margins;
#[cfg(feature = "std")]
mod model;
mod open_loop;
#[cfg(feature = "std")]
mod process;
mod reference;
#[cfg(feature = "std")]
mod response;
#[cfg(feature = "std")]
mod robust;
mod roots;
mod rules;
mod ultimate;
#[cfg(feature = "std")]
mod uncertain_drag;

pub use controller::{ControlFault, ControlStep, Controller};
pub use criterion::RobustCriterion;
pub use design::Tuning;
#[cfg(feature = "std")]
pub(crate) use design::{Body, double_pole};
pub use error::ControlError;
pub use gains::{Gains, Structure};
pub use margins::Margins;
#[cfg(feature = "std")]
pub use model::{AxisModel, NAMES};
pub use open_loop::OpenLoop;
#[cfg(feature = "std")]
pub use process::LinearProcess;
pub use reference::FeedForward;
#[cfg(feature = "std")]
pub use response::{Answer, StepResponse};
#[cfg(feature = "std")]
pub use robust::{CriterionRange, ProcessIntervals, WorstMargin, WorstMargins};
pub use rules::Rule;
#[cfg(feature = "std")]
pub use ultimate::critical_point;
pub use ultimate::{FrequencyPoint, RelayTest, UltimatePoint};
#[cfg(feature = "std")]
pub use uncertain_drag::UncertainDrag;

internal! {
    #[cfg(feature = "std")]
    use robust::{loop_gain_beyond};
}
