//! The process in the loop: linear plants as transfer functions and in state space, with delay.

mod error;
#[cfg(feature = "std")]
mod state_space;
#[cfg(feature = "std")]
mod transfer;

pub use error::PlantError;
#[cfg(feature = "std")]
pub use state_space::{Flow, StateSpace, eigenvalues};
#[cfg(feature = "std")]
pub use transfer::TransferFunction;

#[cfg(feature = "std")]
pub(crate) fn checked_delay(delay_s: f64) -> Result<f64, PlantError> {
    if delay_s.is_finite() && delay_s >= 0.0 { Ok(delay_s) } else { Err(PlantError::Delay { delay_s }) }
}

#[cfg(feature = "std")]
pub(crate) fn all_finite<'a>(
    part: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), PlantError> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, &value)) => Err(PlantError::NotFinite { part, index, value }),
        None => Ok(()),
    }
}
