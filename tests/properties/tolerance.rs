//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;
/// A half-period from the matrix exponential against a published 16-digit value, relative: rounding.
pub(crate) const PERIOD: f64 = 1e-14;
/// Exact orbits against integration at a relative tolerance of 1e-12 per step over some tens of periods.
pub(crate) const INTEGRATION: f64 = 1e-8;
/// Tsypkin's series cut after 4000 terms, relative to the largest: the tail of `k^-3` is 1e-8 of it.
pub(crate) const TSYPKIN: f64 = 1e-7;
/// A multiplier from the decay of a deviation of 1e-4: its second-order part.
pub(crate) const DECAY: f64 = 2e-3;
/// Harmonic balance against a published value of 12 or 7 digits: half a unit of its last place.
pub(crate) const PUBLISHED_12: f64 = 5e-13;
/// The same for 7 decimals.
pub(crate) const PUBLISHED_7: f64 = 5e-8;
/// Two ways to the same balance, relative: Newton's method ends at rounding times the condition.
pub(crate) const BALANCE: f64 = 1e-9;
