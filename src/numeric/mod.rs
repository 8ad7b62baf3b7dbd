//! The arithmetics: [`Real`] and [`Scalar`], and the numerical methods the rest stands on.

#[cfg(feature = "std")]
mod dual;
#[cfg(feature = "std")]
mod expression;
mod interval;
#[cfg(feature = "std")]
pub mod quadrature;
mod real;

#[cfg(feature = "std")]
pub use expression::Expression;
pub use interval::Interval;
pub use real::{Real, Scalar};
