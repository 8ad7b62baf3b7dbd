//! The arithmetics: [`Real`] and [`Scalar`], and the numerical methods the rest stands on.

#[cfg(feature = "std")]
mod dual;
#[cfg(feature = "std")]
pub mod quadrature;
mod real;
pub mod special;

pub use real::{Real, Scalar};
