//! From an oscillation to a model of the vehicle.
//!
//! [`Session`] goes the whole way from logs to a conclusion. Beside it, for who has features of a cycle and no log, stand [`iso`]
//! and [`exact`]; what a record proves about a model, without any assumption on the distribution of errors, is in `bounded`, and
//! the experiment to run in `design`.

#[cfg(feature = "std")]
mod any_float;
#[cfg(feature = "std")]
pub mod bounded;
#[cfg(feature = "std")]
pub mod design;
mod drag_law;
mod error;
pub mod exact;
pub mod iso;
mod reading;
#[cfg(feature = "std")]
mod warning;
#[cfg(feature = "std")]
mod workflow;

internal! {
    #[cfg(feature = "std")]
    mod fit;
    #[cfg(feature = "std")]
    mod joint;
    #[cfg(feature = "std")]
    mod prediction_error;
    #[cfg(feature = "std")]
    mod select;
}

pub use drag_law::DragLaw;
pub use error::IdentifyError;
#[cfg(feature = "std")]
pub use joint::{ConfidenceInterval, Delay, Estimate};
#[cfg(feature = "std")]
pub use prediction_error::{DragVerdict, LawEvidence, Prediction, Reason, Reported, Term, Trust};
#[cfg(feature = "std")]
pub use warning::Warning;
#[cfg(feature = "std")]
pub use workflow::{
    BoundedConclusion, Caution, Conclusion, DragChoice, FeatureMeans, FeatureValues, Guaranteed, Identification,
    Method, Model, RecordConclusion, Refusal, Refused, RefusedMethod, ReportedModel, Session, Settings, SettingsError,
    Source, Stage, Total, Units, Validation,
};
