//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;

/// Closed form against the oracle, relative to the value itself: what the catalogue promises.
pub(crate) const CLOSED_FORM: f64 = 1e-12;

/// Error of a closed form above that, as a multiple of what moving every input by half to one unit in its last place does to
/// the exact value: a dozen rounded operations.
pub(crate) const CONDITION: f64 = 8.0;

/// A few rounded operations, relative to the largest number that takes part.
pub(crate) const ROUNDING: f64 = 1e-15;
