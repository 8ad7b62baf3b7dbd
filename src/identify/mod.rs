//! From an oscillation to a model of the vehicle.

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

pub use drag_law::DragLaw;
pub use error::IdentifyError;
#[cfg(feature = "std")]
pub use warning::Warning;
