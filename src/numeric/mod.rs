//! The arithmetics: [`Real`] and [`Scalar`], and the numerical methods the rest stands on.

mod bessel;
pub(crate) mod domain;
#[cfg(feature = "std")]
mod expression;
mod gradient;
mod interval;
mod jet;
mod minimum;
pub mod power;
#[cfg(feature = "std")]
pub mod quadrature;
mod ratio;
mod real;
mod root;
#[cfg(feature = "std")]
pub mod scan;
pub mod special;

pub use domain::{Limit, OutOfDomain};
#[cfg(feature = "std")]
pub use expression::Expression;
pub use gradient::{Component, Gradient};
pub use interval::Interval;
pub use jet::Jet;
pub use minimum::golden_section;
pub use ratio::{
    atanh_root_ratio, cosh_root, cosh_root_difference, exp_m1_ratio, ln_1p_ratio, minus_ln_1p, minus_tanh,
    sinh_root_difference, sinh_root_ratio,
};
pub use real::{Real, Scalar};
pub use root::increasing_root;
