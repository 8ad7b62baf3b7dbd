//! The arithmetics: [`Real`] and [`Scalar`], and the numerical methods the rest stands on.

#[cfg(feature = "std")]
mod dual;
#[cfg(feature = "std")]
pub mod quadrature;
mod ratio;
mod real;
mod root;

pub use ratio::{atanh_root_ratio, cosh_root, exp_m1_ratio, ln_1p_ratio, minus_ln_1p, minus_tanh, sinh_root_ratio};
pub use real::{Real, Scalar};
pub use root::increasing_root;
