//! From an oscillation to a model of the vehicle.
//!
//! [`Session`] goes the whole way from logs to a conclusion; the methods stand beside it for who has features or records:
//! [`iso`], [`exact`], [`fit`], [`joint`], and [`select`] for the drag law. What a record proves about a model, without any
//! assumption on the distribution of errors, is in `bounded`.

#[cfg(feature = "std")]
mod any_float;
#[cfg(feature = "std")]
pub mod bounded;
#[cfg(feature = "std")]
pub mod design;
mod drag_law;
mod error;
pub mod exact;
#[cfg(feature = "std")]
pub mod fit;
pub mod iso;
#[cfg(feature = "std")]
pub mod joint;
#[cfg(feature = "std")]
pub mod prediction_error;
mod reading;
#[cfg(feature = "std")]
pub mod select;
#[cfg(feature = "std")]
mod warning;
#[cfg(feature = "std")]
mod workflow;

pub use drag_law::DragLaw;
pub use error::IdentifyError;
#[cfg(feature = "std")]
pub use prediction_error::{DragVerdict, LawEvidence, Reason, Reported, Term, Trust};
#[cfg(feature = "std")]
pub use warning::Warning;
#[cfg(feature = "std")]
pub use workflow::{
    BoundedConclusion, Caution, Conclusion, DragChoice, FeatureMeans, FeatureValues, Guaranteed, Identification,
    Method, Model, RecordConclusion, Refusal, Refused, RefusedMethod, ReportedModel, Session, Settings, SettingsError,
    Source, Stage, Total, Units, Validation,
};
