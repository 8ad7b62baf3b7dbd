//! The whole way from logs to a conclusion: reading, features, every method asked for, the drag law chosen, what to beware of.
//!
//! [`Session`] takes logs or samples and gives an [`Identification`]; [`Conclusion`] is its JSON document.

mod document;
mod guaranteed;
mod identification;
mod methods;
mod model;
mod refusal;
mod session;
mod settings;

pub use document::{
    Conclusion, DragChoice, FeatureMeans, FeatureValues, RecordConclusion, Refused, ReportedModel, Total, Units,
};
pub use guaranteed::{BoundedConclusion, Guaranteed};
pub use identification::{Caution, Identification, RefusedMethod, Source, Validation};
pub use model::Model;
pub use refusal::Refusal;
pub use session::{Session, Stage};
pub use settings::{Method, Settings, SettingsError};
