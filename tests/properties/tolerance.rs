//! The one table of tolerances. Each is the smallest that its reason allows.

/// Closed form against quadrature, relative to the largest output: the quadrature stops at 1e-13 of the integrand for
/// each of at most a dozen pieces.
pub(crate) const QUADRATURE: f64 = 2e-12;

/// Closed-form limit cycles against integration, relative: the integrator's 1e-13 a step over some hundred steps, and
/// its approach to the cycle stopped at 1e-13 a cycle while a deviation may need ten cycles to shrink.
pub(crate) const INTEGRATION: f64 = 1e-10;

/// Limit cycles against 30-digit references, relative: rounding, magnified by one over the distance of the multiplier
/// from one, which is down to 1/125 at g = 1e-6.
pub(crate) const REFERENCE: f64 = 2e-13;

/// Closed-form motion against itself or an integrator, relative to the largest way and speed involved: some ten
/// roundings.
pub(crate) const MOTION: f64 = 1e-12;

/// f32 against f64, relative: some ten roundings of 6e-8, magnified up to twentyfold by a multiplier near one.
pub(crate) const SINGLE: f64 = 2e-5;

/// Derivatives against central differences of relative step 1e-5: its square, and rounding over the step.
pub(crate) const DIFFERENCE: f64 = 1e-7;
