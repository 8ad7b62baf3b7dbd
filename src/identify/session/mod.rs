//! From logs to a conclusion: reading, features, every requested method, choice of the drag law, cautions.
//!
//! [`Session`] takes logs or samples and gives an [`Identification`]; [`Conclusion`] is its JSON document.

pub mod document;
mod guaranteed;
mod identification;
mod methods;
mod model;
mod refusal;
#[allow(clippy::module_inception, reason = "the type that the room is named after")]
mod session;
mod settings;
mod stage;

pub use document::Conclusion;
pub use guaranteed::Guaranteed;
pub use identification::{Caution, Identification, Source, Validation};
pub use model::Model;
pub use refusal::Refusal;
pub use session::Session;
pub use settings::{Method, Settings, SettingsError};
pub use stage::Stage;
