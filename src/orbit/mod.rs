//! Exact limit cycles, beside the harmonic balance that approximates them.

mod error;
#[cfg(feature = "std")]
mod extrema;
#[cfg(feature = "std")]
pub mod integrate;
#[cfg(feature = "std")]
mod relay_cycle;
#[cfg(feature = "std")]
mod relay_linear;
#[cfg(feature = "std")]
mod relay_multiplier;
#[cfg(feature = "std")]
mod tsypkin;

pub use error::OrbitError;
#[cfg(feature = "std")]
pub use relay_linear::{RelayLoop, RelayOrbit};
#[cfg(feature = "std")]
pub use tsypkin::tsypkin_locus;
