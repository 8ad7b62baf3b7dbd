//! Plants: what the relay drives.

mod drag_axis;
mod error;
mod motion;
mod one_way;
#[cfg(feature = "std")]
mod state_space;
#[cfg(feature = "std")]
mod transfer;

pub use drag_axis::DragAxis;
pub use error::PlantError;
pub use motion::State;
internal! { use one_way::{OneWay, Passage}; }
#[cfg(feature = "std")]
pub use state_space::StateSpace;
internal! {
    #[cfg(feature = "std")]
    use state_space::{Flow, eigenvalues};
}
#[cfg(feature = "std")]
pub use transfer::TransferFunction;
#[cfg(feature = "std")]
pub(crate) use transfer::{horner, product};

#[cfg(feature = "std")]
pub(crate) fn checked_delay(delay_s: f64) -> Result<f64, PlantError> {
    Ok(crate::numeric::domain::non_negative("delay_s", delay_s, "s")?)
}

#[cfg(feature = "std")]
pub(crate) fn all_finite<'a>(part: &'static str, values: impl IntoIterator<Item = &'a f64>) -> Result<(), PlantError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, &value)) => Err(PlantError::NotFinite { part, index, value }),
        None => Ok(()),
    }
}
