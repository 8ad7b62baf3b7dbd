//! The arithmetics: [`Real`] and [`Scalar`], and the numerical methods the rest stands on.

#[cfg(feature = "std")]
mod balls;
mod bessel;
mod complex;
pub(crate) mod domain;
mod gradient;
mod interval;
mod jet;
#[cfg(feature = "std")]
mod lanes;
mod minimum;
mod ratio;
mod real;
mod root;
#[cfg(feature = "std")]
mod runge_kutta;
#[cfg(feature = "std")]
mod significant;

internal! {
    mod power;
    #[cfg(feature = "std")]
    mod quadrature;
    #[cfg(feature = "std")]
    mod scan;
    mod special;
}

#[cfg(all(test, feature = "std"))]
#[path = "../../tests/properties/numeric/rounded/mod.rs"]
#[allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::cast_possible_truncation, reason = "a test may panic")]
pub(crate) mod rounded;

#[cfg(feature = "std")]
pub(crate) use balls::{Balls, Sizes};
#[cfg(feature = "std")]
pub(crate) use lanes::Lanes;
#[cfg(feature = "std")]
pub(crate) use runge_kutta::runge_kutta;
#[cfg(feature = "std")]
pub(crate) use significant::significant;

pub(crate) use complex::Complex;
pub(crate) use domain::codes;
pub use domain::{Limit, OutOfDomain};
pub use interval::Interval;
pub(crate) use real::operators;
pub use real::{Real, Scalar};
pub use special::Special;

internal! {
    use gradient::{Component, Gradient};
    use jet::{Jet};
    use minimum::{golden_section};
    use ratio::{
        atanh_root_ratio, cosh_root, cosh_root_difference, exp_m1_ratio, ln_1p_ratio, minus_ln_1p, minus_tanh,
        sinh_root_difference, sinh_root_ratio,
    };
    use real::{own_sine_series};
    use root::{increasing_root};
}
