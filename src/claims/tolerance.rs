//! The tolerances of the sampled checks: each the smallest that its reason allows, relative to the scale of the quantity.

/// Closed form against quadrature: the quadrature stops at 1e-13 of the integrand on each of at most a dozen pieces.
pub const QUADRATURE: f64 = 2e-12;
/// Two closed forms of one number: a few roundings of inverse sines and square roots.
pub const ROUNDING: f64 = 1e-13;
/// The same where the two forms cancel to a part of their terms: three decimal digits of [`ROUNDING`].
pub const CANCELLING: f64 = 1e-10;
