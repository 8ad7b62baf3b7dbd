//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;

/// Width of an elementary function of intervals at a point, in units of the last place; 16 is the largest seen (the
/// tangent), and proofs rely on enclosures not much wider than rounding.
pub(crate) const ELEMENTARY_WIDTH_ULP: f64 = 20.0;

/// Width wanted of an integral by rigorous quadrature; the integrands are of order one, and rounding alone costs 1e-14.
pub(crate) const QUADRATURE_WIDTH: f64 = 1e-12;

/// Relative rounding of a derivative up to the third by its formula in floating point, and of the jet that it is
/// compared with.
pub(crate) const JET_ROUNDING: f64 = 1e-14;
