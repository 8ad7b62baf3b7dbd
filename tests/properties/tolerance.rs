//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;

/// Parameters from the features of an exact orbit, and back: some ten roundings times the condition of the inversion, up
/// to 1e5 over the shapes drawn.
pub(crate) const INVERSION: f64 = 1e-10;
/// Derivatives of the same: slopes are difference quotients, good to 1e-8, under a milder condition.
pub(crate) const INVERSION_DERIVATIVE: f64 = 1e-5;
/// The inversion in single precision, for a well-conditioned shape: some ten roundings of 6e-8, magnified tenfold.
pub(crate) const INVERSION_SINGLE: f64 = 2e-5;
/// Common parameters from exact rows: the search ends at a relative step of 1e-9.
pub(crate) const JOINT: f64 = 1e-7;
