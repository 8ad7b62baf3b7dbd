//! The tolerances of the checks: each the smallest that its reason allows, relative to the scale of the quantity.

/// Bound asked of a proof that numbers of order 1 are equal: the size of remainders of Taylor's series at little cost.
pub const PROOF: f64 = 1e-10;
/// Closed form against quadrature: the quadrature stops at 1e-13 of the integrand on each of at most a dozen pieces.
pub const QUADRATURE: f64 = 2e-12;
/// Two closed forms of the same number: a few roundings of inverse sines and square roots.
pub const ROUNDING: f64 = 1e-13;
/// The same where the two forms cancel to a part of their terms: three decimal digits of [`ROUNDING`].
pub const CANCELLING: f64 = 1e-10;
/// Closed form against step-by-step integration of fourth order with 4000 steps a period, `(2 pi/4000)^3/6 = 6e-10` at the kink of quadratic
/// drag, over two switchings.
pub const INTEGRATED: f64 = 1e-8;
/// The same where the motion passes kinks, each of which costs a square of the step, `2 pi/4000` of the period.
pub const INTEGRATED_ACROSS_KINKS: f64 = 1e-5;
/// Parameters from a record with 1000 samples in a period, times `X_m/x_a`: the two switching levels are read up to one
/// sample's motion late, each at most `2 pi/1000` of the amplitude, and drag follows from their mean's first power.
pub const SAMPLED: f64 = 4.0 * core::f64::consts::PI / 1000.0;
