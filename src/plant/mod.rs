//! Plants: what the relay drives.

mod drag_axis;
mod error;
mod motion;
mod one_way;

pub use drag_axis::DragAxis;
pub use error::PlantError;
pub use motion::State;
pub use one_way::{OneWay, Passage};
