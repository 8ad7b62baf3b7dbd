//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;

/// Parameters from the features of an exact orbit: rounding of the features times the condition of the inversion, at
/// most 1e5 over the shapes drawn.
pub(crate) const INVERSION: f64 = 1e-9;

/// Derivatives of the same: slopes are difference quotients, good to 1e-8, and meet the same condition.
pub(crate) const INVERSION_DERIVATIVE: f64 = 1e-4;

/// The same in single precision, for well-conditioned shapes.
pub(crate) const INVERSION_SINGLE: f64 = 1e-3;

/// Parameters common to exact rows: the search ends at a relative step of 1e-9.
pub(crate) const JOINT: f64 = 1e-6;
