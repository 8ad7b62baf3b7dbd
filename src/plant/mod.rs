//! Plants: what the relay drives.

mod drag_axis;
mod error;

pub use drag_axis::DragAxis;
pub use error::PlantError;
