//! The arithmetics: [`Real`] and [`Scalar`], and the numerical methods the rest stands on.

#[cfg(feature = "std")]
mod dual;
mod interval;
#[cfg(feature = "std")]
pub mod quadrature;
mod real;

pub use interval::Interval;
pub use real::{Real, Scalar};
