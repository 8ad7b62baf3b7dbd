//! The one table of tolerances: each with its reason.

/// Width of an elementary function at a point, in units of the last place of the result; measured maxima are below, and
/// proofs elsewhere rely on enclosures not much wider than rounding.
pub(crate) const ELEMENTARY_WIDTH_ULP: f64 = 12.0;
