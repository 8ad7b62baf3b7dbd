//! From an oscillation to a model of the vehicle.
//!
//! [`Session`] goes the whole way from logs to a conclusion. Beside it, for who has features of a cycle and no log, stand [`iso`]
//! and [`exact`]; what a record proves about a model, without any assumption on the distribution of errors, is in `bounded`, and
//! the experiment to run in `design`. The names of the JSON document are in `document`.

internal! { mod answer; }
#[cfg(feature = "std")]
mod signal;

pub mod iso;

pub mod exact;

internal! {
    #[cfg(feature = "std")]
    mod fit;
}

#[cfg(feature = "std")]
pub mod bounded;

#[cfg(feature = "std")]
pub mod design;

#[cfg(feature = "std")]
mod session;

#[cfg(feature = "std")]
pub(crate) use answer::distribution::NORMAL_95;
pub use answer::{DragLaw, IdentifyError};
#[cfg(feature = "std")]
pub use {
    answer::{
        Assumptions, BudgetEntry, ConfidenceInterval, Delay, Disturbances, DragCovariance, DragVerdict, ErrorSource,
        Estimate, LawEvidence, Reason, Reported, Term, Trust, Warning,
    },
    fit::prediction_error::{PredictedMotion, Prediction},
    session::{
        Caution, Conclusion, Guaranteed, Identification, Method, Model, Refusal, Session, Settings, SettingsError,
        Source, Stage, Validation, document,
    },
};
