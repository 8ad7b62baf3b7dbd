//! The relay as a state machine: the paper's sentences on it.

use core::f64::consts::PI;

use super::algebra::{exactly, number};
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim};
use crate::experiment::RelayState;
use crate::nonlinearity::RelayHysteresis;
use crate::proof::polynomial::{Decision, Rational, decided};

claim! {
    NOISE = "relay-noise" Statement
    "While the input moves one way, noise smaller than the half-width switches the relay at most once";
    cases |all| all.min(200);
    printed Refuted switches_once(0.0, 10.0);
    corrected switches_once(0.0, 1.0);
    false switches_once(1.5, 2.0);
    needs "noise-below-half-width" switches_once(1.5, 2.0);
    proof prove_noise;
}

/// A slow ramp through both levels with noise between the given shares of the half-width: exactly one switching.
fn switches_once(draw: &mut Draw, least: f64, most: f64) -> Option<Case> {
    let half_width = draw.uniform("half_width", 0.1, 1.0);
    let noise = half_width * draw.uniform("noise_over_half_width", least, most);
    let relay = RelayHysteresis::new(1.0, half_width, 0.0).ok()?;
    let mut relay = RelayState::new(relay, false);
    let (mut switchings, mut high) = (0, false);
    for step in -500..=500 {
        let input = f64::from(step) / 500.0 * (half_width + noise + 0.1);
        let disturbed = input + noise * draw.unrecorded(-1.0, 1.0);
        let now = relay.step(disturbed) > 0.0;
        switchings += usize::from(now != high);
        high = now;
    }
    Some(Case::truth(draw.note("switchings", switchings as f64) == 1.0))
}

claim! {
    SAMPLED_LEVEL = "sampled-level" Statement
    "A sampled relay switches at x_a or beyond, at most one sample's motion beyond";
    printed Holds overshoot(0.0);
    false overshoot(0.01);
    proof prove_sampled_level;
}

/// The level at which a sampled relay switches up on a sinusoid, against `x_a (1 + least)` and `x_a` plus a step.
fn overshoot(draw: &mut Draw, least: f64) -> Option<Case> {
    let (half_width, step) = (draw.uniform("half_width", 0.05, 0.95), draw.uniform("step_rad", 0.001, 0.5));
    let start = draw.uniform("phase_rad", -0.5 * PI, -0.5 * PI + step);
    let relay = RelayHysteresis::new(1.0, half_width, 0.0).ok()?;
    let mut relay = RelayState::new(relay, false);
    let mut angle = start;
    while angle < 0.5 * PI && relay.step(libm::sin(angle)) < 0.0 {
        angle += step;
    }
    if angle >= 0.5 * PI {
        return None;
    }
    let level = draw.note("level", libm::sin(angle));
    Some(Case::margin(level - half_width * (1.0 + least)).and(Case::margin(half_width + step - level)))
}

/// The relay's comparisons of an input, each a number and whether it is positive, and whether the command turns.
fn asked<const N: usize>(
    point: [f64; N],
    high: bool,
    of: impl Fn([Rational; N]) -> [Rational; 2],
) -> Option<(Vec<Decision>, bool)> {
    let step = |at: [Rational; N]| {
        let [input, half_width] = of(at);
        let mut relay = RelayState::new(RelayHysteresis::new(number(1.0), half_width, number(0.0)).ok()?, high);
        let before = relay.output();
        Some(!(relay.step(input) - before).is_zero())
    };
    let (turned, decisions) = decided(point, step);
    Some((decisions, turned?))
}

/// The relay turns up at an input and down at a later, higher input: its comparisons there, the growth of the input and
/// the two distances of the noise from the half-width add up to zero, hence not all have the required sign.
fn prove_noise(distortion: Distortion) -> Verdict {
    // The disturbed inputs are where the relay turns; the identity shows that the noise is too large there.
    const POINT: [f64; 5] = [1.0, 0.5, -1.0, -0.5, 0.25];
    let up = asked(POINT, false, |[input, noise, .., half_width]| [input + noise, half_width]);
    let down = asked(POINT, true, |[_, _, input, noise, half_width]| [input + noise, half_width]);
    let (Some((up, true)), Some((down, true))) = (up, down) else { return Verdict::undecided("one step of the relay") };
    let (&[(above, true)], &[(_, false), (below, false)]) = (up.as_slice(), down.as_slice()) else {
        return Verdict::undecided("decisions of the relay");
    };
    let sum = |[first, first_noise, later, later_noise, half_width]: [Rational; 5], factor: Rational| {
        let room = (half_width - first_noise) + (half_width + later_noise);
        Some([above - below + (later - first) + factor * room])
    };
    exactly(ClaimPart::WHOLE, distortion, &[POINT], sum)
}

/// A sample that turns the command is at the level or beyond, and beyond it by less than the motion since the sample
/// before, which did not.
fn prove_sampled_level(distortion: Distortion) -> Verdict {
    const POINT: [f64; 3] = [0.25, 0.75, 0.5];
    let before = asked(POINT, false, |[input, _, half_width]| [input, half_width]);
    let turning = asked(POINT, false, |[_, input, half_width]| [input, half_width]);
    let (Some((before, false)), Some((turning, true))) = (before, turning) else {
        return Verdict::undecided("one step of the relay");
    };
    let (&[(missed, false), ..], &[(beyond, true)]) = (before.as_slice(), turning.as_slice()) else {
        return Verdict::undecided("decisions of the relay");
    };
    let functions = |[before, turning, half_width]: [Rational; 3], factor: Rational| {
        let overshoot = turning - half_width;
        Some([beyond - factor * overshoot, overshoot - missed - (turning - before)])
    };
    exactly(ClaimPart::WHOLE, distortion, &[POINT], functions)
}
