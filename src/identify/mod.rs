//! From an oscillation to a model of the vehicle.
//!
//! [`Session`] goes the whole way from logs to a conclusion; the methods stand beside it for who has features or records:
//! [`iso`], [`exact`], [`fit`], [`joint`], and [`select`] for the drag law. What a record proves about a model, without any
//! assumption on the distribution of errors, is in `bounded`.

#[cfg(feature = "std")]
mod any_float;
#[cfg(feature = "std")]
pub mod bounded;
mod drag_law;
mod error;
pub mod exact;
#[cfg(feature = "std")]
pub mod fit;
pub mod iso;
#[cfg(feature = "std")]
pub mod joint;
mod reading;
#[cfg(feature = "std")]
pub mod select;
#[cfg(feature = "std")]
mod warning;
#[cfg(feature = "std")]
mod workflow;

// Not part of the workflow: on vehicles outside its family of models it misses more often than a default may.
internal! {
    #[cfg(feature = "std")]
    mod prediction_error;
}

pub use drag_law::DragLaw;
pub use error::IdentifyError;
#[cfg(feature = "std")]
pub use warning::Warning;
#[cfg(feature = "std")]
pub use workflow::{
    Caution, Conclusion, DragChoice, DragVerdict, FeatureMeans, FeatureValues, Identification, Method, Model,
    Probabilities, RecordConclusion, Refusal, Refused, Session, Settings, SettingsError, Source, Stage, Total,
};
