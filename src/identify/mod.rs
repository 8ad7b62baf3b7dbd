//! From an oscillation to a model of the vehicle.

mod error;
pub mod iso;

pub use error::IdentifyError;
