//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;

/// Width of an elementary function at a point, in units of the last place of the result; measured maxima are below, and
/// proofs elsewhere rely on enclosures not much wider than rounding.
pub(crate) const ELEMENTARY_WIDTH_ULP: f64 = 12.0;
