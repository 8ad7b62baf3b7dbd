//! When the mean output vanishes: the paper's lemmas on characteristics, odd or not.

use super::family::{mean_of, odd_nondecreasing, output_scale, sweep};
use super::step::by_steps;
use super::{Case, ClaimPart, Draw, claim, tolerance};
use crate::describing::ClosedForm;
use crate::nonlinearity::{RelayDeadZone, Sinusoid};
use crate::numeric::quadrature::integrate;

claim! {
    LEMMA_1 = "lemma-1" Lemma
    "Odd, nondecreasing and not zero inside the sweep: the mean output has the sign of the bias, and vanishes with it";
    printed Refuted vanishes_only_unbiased(|x| x * x * x - 2.0 * x);
    corrected mean_has_sign_of_bias();
    false vanishes_only_unbiased(|x| libm::sin(3.0 * x));
    needs "odd" vanishes_only_unbiased(|x| x + 0.5);
    needs "nondecreasing" vanishes_only_unbiased(libm::sin);
    needs "not-zero-inside-sweep" inside_the_dead_zone();
    proof |distortion| by_steps(distortion, const { &[ClaimPart::WHOLE] });
}

/// Looks for a nonzero bias at which the mean output of `function` vanishes.
fn vanishes_only_unbiased(draw: &mut Draw, function: fn(f64) -> f64) -> Option<Case> {
    let amplitude = draw.uniform("amplitude", 0.5, 1.5);
    let (mut from, mut to) = (draw.uniform("from", -4.0, -0.1), draw.uniform("to", 0.1, 4.0));
    if draw.index("side", 2) == 0 {
        to = -0.05
    } else {
        from = 0.05
    }
    let mean = |bias| mean_of(function, bias, amplitude);
    let scale = function(from - amplitude).abs().max(function(to + amplitude).abs());
    Some(match bisect(mean, from, to) {
        Some(bias) => draw.at_most(("bias", bias.abs()), ("mean", mean(bias).abs()), scale),
        None => Case::truth(true),
    })
}

/// A zero of `f` between two points of opposite sign.
fn bisect(f: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> Option<f64> {
    let start = f(from);
    if start * f(to) > 0.0 {
        return None;
    }
    for _ in 0..80 {
        let middle = 0.5 * (from + to);
        if start * f(middle) > 0.0 { from = middle } else { to = middle }
    }
    Some(0.5 * (from + to))
}

/// Strictly: the mean is on the bias's side of zero.
fn mean_has_sign_of_bias(draw: &mut Draw) -> Option<Case> {
    let (characteristic, sweep) = (odd_nondecreasing(draw).ok()?, sweep(draw).ok()?);
    let df = characteristic.describing_function(&sweep).ok()?;
    let scale = output_scale(&*characteristic, &sweep);
    // Constant or zero over the sweep and its mirror image, and a bias lost in rounding: no hypothesis, no case.
    if scale == 0.0 || sweep.bias().abs() < 1e-6 * sweep.amplitude() {
        return None;
    }
    let signed = draw.note("f0", df.f0) * sweep.bias().signum();
    let unbiased = Sinusoid::new(0.0, sweep.amplitude()).map(|sweep| characteristic.describing_function(&sweep));
    let unbiased = unbiased.ok()?.ok()?;
    let zero = draw.equal(("f0_unbiased", unbiased.f0), 0.0, scale, tolerance::ROUNDING);
    Some(zero.and(if signed > 0.0 { Case::margin(signed / scale) } else { Case::truth(false) }))
}

/// A biased sweep that a dead zone ends at its turning point, where alone the output is not zero, has mean zero.
fn inside_the_dead_zone(draw: &mut Draw) -> Option<Case> {
    let (bias, amplitude) = (draw.uniform("bias", 0.1, 1.0), draw.uniform("amplitude", 0.1, 1.0));
    let dead_zone = draw.note("dead_zone", bias + amplitude);
    let (relay, sweep) = (RelayDeadZone::new(1.0, dead_zone).ok()?, Sinusoid::new(bias, amplitude).ok()?);
    let f0 = relay.describing_function(&sweep).ok()?.f0;
    Some(Case::truth(draw.note("f0", f0) != 0.0))
}

claim! {
    LEMMA_2 = "lemma-2" Lemma
    "With an even part of one sign the mean output cannot vanish without bias; nondecreasing, only with one of the other sign";
    printed Refuted unbiased_mean_is_not_zero(|x, even| x + even * (x * x - 0.5));
    corrected even_part_decides(|x, even| x * x * x + x + even * (1.0 + libm::exp(-x * x)));
    false even_part_decides(|x, even| x + even * (x * x - 0.5));
    needs "even-part-of-one-sign" unbiased_mean_is_not_zero(|x, even| x + even * (x * x - 0.5));
    needs "even-part-not-zero" unbiased_mean_is_not_zero(|x, _| x);
    needs "nondecreasing" even_part_decides(|x, even| even - x);
    proof |distortion| by_steps(distortion, const { &[ClaimPart::WHOLE] });
}

/// A function with an even part whose size is the second argument.
type WithEvenPart = fn(f64, f64) -> f64;

/// Mean of `function` over a sinusoid of amplitude `amplitude`.
fn mean(function: WithEvenPart, even: f64, bias: f64, amplitude: f64) -> f64 {
    let integrand = |angle: f64| function(bias + amplitude * libm::sin(angle), even);
    integrate(&mut &integrand, -core::f64::consts::FRAC_PI_2, core::f64::consts::FRAC_PI_2, 1e-14, 1000).value
        / core::f64::consts::PI
}

/// Unbiased unit sweep: the mean output is not zero.
fn unbiased_mean_is_not_zero(draw: &mut Draw, function: WithEvenPart) -> Option<Case> {
    let even = draw.uniform("even", 0.1, 1.0);
    let f0 = draw.note("f0", mean(function, even, 0.0, 1.0));
    Some(Case::margin(f0.abs() - tolerance::QUADRATURE))
}

/// Not zero without bias, and zero only at a bias of the sign opposite to the even part's.
fn even_part_decides(draw: &mut Draw, function: WithEvenPart) -> Option<Case> {
    let even = draw.uniform("even", -1.0, 1.0);
    let amplitude = draw.uniform("amplitude", 0.2, 2.0);
    if even.abs() < 1e-3 {
        return None;
    }
    let f0 = |bias| mean(function, even, bias, amplitude);
    let unbiased = draw.note("f0", f0(0.0)).abs() - tolerance::QUADRATURE;
    let opposite = match bisect(f0, -5.0, 5.0) {
        Some(bias) => Case::margin(-draw.note("bias", bias) * even.signum()),
        None => Case::truth(true),
    };
    Some(Case::margin(unbiased).and(opposite))
}
