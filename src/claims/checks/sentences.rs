//! The paper's remarks on bounds and on the disturbance: section 5.3 and the conclusion.

use core::f64::consts::{PI, SQRT_2};

use super::family::cycle;
use super::{Case, Draw, claim, tolerance};
use crate::describing::{ClosedForm, DescribingFunction};
use crate::identify::iso::amplitude_sensitivity;
use crate::nonlinearity::{RelayHysteresis, Sinusoid};

/// Why neither is called proved: the program draws cases, a kernel has the proof.
const SAMPLED: &str = "the program draws cases";

claim! {
    CONFIDENCE_BOUNDS = "confidence-bounds" Statement
    "The bounds of both drags fall as the amplitude grows; that of the inertia grows from 1.414 to 2.136 half-widths";
    printed Refuted inertia(&[(1.0, 4.0, false)]);
    corrected inertia(&[(1.0, SQRT_2, false), (SQRT_2, GREATEST, true), (GREATEST, 10.0, false)]);
    false inertia(&[(SQRT_2, 2.5, true)]);
    not_proved SAMPLED;
}

/// Where the bound of the inertia is greatest beyond its zero: the root `sqrt((5 + sqrt(17))/2)` of `r^4 - 5 r^2 + 2`.
const GREATEST: f64 = 2.135_779_205_069_857;

/// Whether between two ratios of amplitude and half-width the bound of the inertia, eq. 37 times the relative step of the reading,
/// grows or falls; the bounds of the drags, eqs. 38 and 39, fall.
fn inertia(draw: &mut Draw, ranges: &'static [(f64, f64, bool)]) -> Option<Case> {
    let (from, to, grows) = ranges[draw.index("range", ranges.len())];
    let [first, second] = ["first_ratio", "second_ratio"].map(|name| draw.uniform(name, from, to));
    let (smaller, larger) = (first.min(second), first.max(second));
    if larger - smaller < tolerance::CANCELLING {
        return None;
    }
    let [at_smaller, at_larger] = [smaller, larger].map(|ratio| {
        let per_amplitude = amplitude_sensitivity(ratio);
        [per_amplitude.alpha, per_amplitude.beta, per_amplitude.beta_quadratic].map(|s| s.abs() / ratio)
    });
    let drags_fall = at_larger[1] < at_smaller[1] && at_larger[2] < at_smaller[2];
    Some(Case::truth(drags_fall && at_larger[0] != at_smaller[0] && (at_larger[0] > at_smaller[0]) == grows))
}

claim! {
    DISTURBANCE_AND_DRAG = "disturbance-and-drag" Statement
    "On the first harmonic the drag identified does not depend on the disturbance; on exact orbits it does";
    printed Refuted on_exact_orbits();
    corrected on_the_first_harmonic(|df| df.q);
    false on_the_first_harmonic(|df| df.p);
    needs "one-tone" on_exact_orbits();
    not_proved SAMPLED;
}

/// A part of the relay's describing function with bias and offset, and without.
fn on_the_first_harmonic(draw: &mut Draw, part: fn(DescribingFunction<f64>) -> f64) -> Option<Case> {
    let (level, half_width) = (draw.uniform("level", 0.1, 3.0), draw.uniform("half_width", 0.1, 1.0));
    let (offset, bias) = (draw.uniform("offset", -1.0, 1.0), draw.uniform("bias", -1.0, 1.0));
    let amplitude = draw.uniform("amplitude_ratio", 1.01, 4.0) * (half_width + bias.abs());
    let of = |offset: f64, bias: f64| {
        let relay = RelayHysteresis::new(level, half_width, offset).ok()?;
        relay.describing_function(&Sinusoid::new(bias, amplitude).ok()?).ok().map(part)
    };
    let (disturbed, quiet) = (of(offset, bias)?, of(0.0, 0.0)?);
    Some(draw.equal(("disturbed", disturbed), quiet, level / amplitude, tolerance::ROUNDING))
}

/// The drag that Table 3 makes of the exact oscillation of a vehicle with linear drag, disturbed by a share of the level or not.
fn on_exact_orbits(draw: &mut Draw) -> Option<Case> {
    let half_width = draw.log_uniform("half_width", 0.1, 5.0);
    let disturbance = draw.uniform("disturbance", 0.1, 0.5);
    let identified = |disturbance: f64| {
        let orbit = cycle(1.0, [1.0, 0.0], disturbance, 0.0, [1.0, half_width])?;
        let omega = 2.0 * PI / (orbit.time_positive_s + orbit.time_negative_s);
        Some(4.0 * half_width / (PI * omega * orbit.amplitude * orbit.amplitude))
    };
    let (disturbed, quiet) = (identified(disturbance)?, identified(0.0)?);
    Some(draw.equal(("drag_disturbed", disturbed), quiet, quiet, tolerance::CANCELLING))
}
