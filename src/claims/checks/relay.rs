//! The relay with hysteresis: eqs. 30-32 and the paper's sentences on it.

use core::f64::consts::PI;

use super::algebra::{exactly, no_function, number};
use super::kernels::{BREAKPOINT, on_unit, prove_kernel};
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::describing::{ClosedForm, DescribingFunction, KernelForm, bias_of_output, by_quadrature};
use crate::nonlinearity::{Branches, Kernel, RelayHysteresis, Sinusoid};
use crate::numeric::Real;
use crate::proof::polynomial::Rational;

/// A relay, an input that switches it, and the describing function by quadrature.
struct SwitchedRelay {
    level: f64,
    half_width: f64,
    offset: f64,
    bias: f64,
    amplitude: f64,
    integral: DescribingFunction<f64>,
}

fn switching(draw: &mut Draw) -> Option<SwitchedRelay> {
    let (level, half_width) = (draw.uniform("level", 0.1, 3.0), draw.uniform("half_width", 0.0, 2.0));
    let (offset, bias) = (draw.uniform("offset", -1.0, 1.0), draw.uniform("bias", -2.0, 2.0));
    let amplitude = draw.note("amplitude", (half_width + bias.abs()) * 1.0001) + draw.uniform("excess", 0.0, 3.0);
    let relay = RelayHysteresis::new(level, half_width, offset).ok()?;
    let integral = by_quadrature(&relay, &Sinusoid::new(bias, amplitude).ok()?).ok()?;
    Some(SwitchedRelay { level, half_width, offset, bias, amplitude, integral })
}

/// A formula for a part of the describing function against its integral.
fn formula(
    draw: &mut Draw,
    part: fn(&DescribingFunction<f64>) -> f64,
    formula: fn(&SwitchedRelay) -> f64,
    gain: bool,
) -> Option<Case> {
    let case = switching(draw)?;
    let scale = (case.level + case.offset.abs()) / if gain { case.amplitude } else { 1.0 };
    Some(draw.equal(("formula", formula(&case)), part(&case.integral), scale, tolerance::QUADRATURE))
}

claim! {
    RELAY_Q = "relay-q" Identity
    "Q of a relay with hysteresis is -4 C x_a/(pi X^2), whatever the bias and the offset";
    printed Holds formula(|df| df.q, |s| -4.0 * s.level * s.half_width / (PI * s.amplitude * s.amplitude), true);
    false formula(|df| df.q, |s| -4.0 * s.level * (s.half_width + s.bias) / (PI * s.amplitude * s.amplitude), true);
    needs "switches-both-ways" formula_below_switching();
    proof |distortion| {
        let term = |u| -(number(2.0) * u / Rational::pi());
        prove_printed(distortion, term, |width, _| -(number(4.0) * width / Rational::pi()), |df| df.q)
    };
}

/// Below the switching amplitude the output is constant: its Q is zero, the formula's is not.
fn formula_below_switching(draw: &mut Draw) -> Option<Case> {
    let half_width = draw.uniform("half_width", 0.5, 1.0);
    let amplitude = draw.uniform("amplitude", 0.1, 0.5);
    let formula = -4.0 * half_width / (PI * amplitude * amplitude);
    Some(draw.equal(("formula", formula), 0.0, 1.0, tolerance::ROUNDING))
}

claim! {
    RELAY_P = "relay-p" Identity
    "P of a relay with hysteresis is (2C/(pi X)) [sqrt(1 - ((x_a - x_0)/X)^2) + sqrt(1 - ((x_a + x_0)/X)^2)]";
    printed Holds formula(|df| df.p, |s| in_phase(s, s.bias), true);
    false formula(|df| df.p, |s| in_phase(s, 0.0), true);
    proof |distortion| {
        let term = |u| number(2.0) / Rational::pi() * root(u);
        prove_printed(distortion, term, |width, bias| term(width - bias) + term(width + bias), |df| df.p)
    };
}

fn in_phase(s: &SwitchedRelay, bias: f64) -> f64 {
    let root = |distance: f64| (1.0 - (distance / s.amplitude).powi(2)).sqrt();
    2.0 * s.level / (PI * s.amplitude) * (root(s.half_width - bias) + root(s.half_width + bias))
}

claim! {
    RELAY_F0 = "relay-f0" Identity
    "The mean output is C (t_high - t_low)/T = (C/pi) [asin((x_a + e_0)/X) - asin((x_a - e_0)/X)], plus the offset";
    printed Holds mean_output(1.0);
    // The times exchanged: the sign error that reading T_H as the time at command +C makes.
    false mean_output(-1.0);
    proof prove_relay_f0;
}

fn mean_output(draw: &mut Draw, sign: f64) -> Option<Case> {
    let s = switching(draw)?;
    let angle = |distance: f64| libm::asin(distance / s.amplitude);
    let (rising, falling) = (angle(s.half_width - s.bias), angle(s.half_width + s.bias));
    let by_angle = s.level / PI * (falling - rising) + s.offset;
    // High from the rising to the falling crossing: as a share of a turn.
    let high = PI - rising + falling;
    let by_time = sign * bias_of_output(s.level, high, 2.0 * PI - high) + s.offset;
    let (expected, scale) = (s.integral.f0, s.level + s.offset.abs());
    let equations = [("by_angle", by_angle, expected, scale), ("by_time", by_time, expected, scale)];
    Some(draw.equations(equations, tolerance::QUADRATURE))
}

claim! {
    SECOND_QUADRANT = "second-quadrant" Statement
    "-G_N of the unbiased relay with hysteresis covers the second quadrant, and nothing else";
    printed Holds covers(0.5 * PI, PI);
    false covers(0.5 * PI, 1.25 * PI);
    exactly some_relay on "covered" at &[[0.25], [0.75]],
        every_relay on "nothing-else" at &[[2.0, 0.25, 1.0], [2.0, 0.75, 1.0]];
}

/// Each point at an angle between the two is -G_N of some relay and amplitude, and each -G_N lies at such an angle.
fn covers(draw: &mut Draw, from: f64, to: f64) -> Option<Case> {
    let (angle, magnitude) = (draw.uniform("angle", from, to), draw.log_uniform("magnitude", 1e-3, 1e3));
    // -G_N = (4C/(pi X)) exp(j (pi - asin(x_a/X))): choose X = 1.
    let (half_width, level) = (libm::sin(PI - angle), 0.25 * PI * magnitude);
    let gain = |level: f64, half_width: f64, amplitude: f64| {
        let sweep = Sinusoid::new(0.0, amplitude).ok()?;
        RelayHysteresis::new(level, half_width, 0.0).ok()?.describing_function(&sweep).ok()
    };
    let Some(reached) = gain(level, half_width, 1.0) else { return Some(Case::truth(false)) };
    let hit = libm::hypot(-reached.p - magnitude * libm::cos(angle), -reached.q - magnitude * libm::sin(angle));
    let covered = draw.equal(("distance", hit), 0.0, magnitude, tolerance::ROUNDING);
    let (width, excess) = (draw.uniform("half_width", 0.0, 2.0), draw.uniform("excess", 0.0, 2.0));
    let any = gain(level, width, width + excess + 1e-9)?;
    Some(covered.and(Case::truth(-any.p <= 0.0 && -any.q >= 0.0)))
}

claim! {
    SWITCHING_CONDITION = "switching-condition" Identity
    "Eq. 31 has a value, and the relay oscillates, exactly when (x_a + abs(x_0))/X <= 1";
    printed Holds condition(1.0);
    false condition(1.1);
    exactly farther_level on "whole" at &[[0.5, 0.2], [0.5, -0.2], [0.2, 0.5], [0.2, -0.5]];
}

fn condition(draw: &mut Draw, limit: f64) -> Option<Case> {
    let (half_width, bias) = (draw.uniform("half_width", 0.0, 2.0), draw.uniform("bias", -1.0, 1.0));
    let amplitude = draw.uniform("amplitude", 0.1, 4.0);
    let meets = (half_width + bias.abs()) / amplitude <= limit;
    let radicands = [half_width - bias, half_width + bias].map(|distance| 1.0 - (distance / amplitude).powi(2));
    let (relay, sweep) = (RelayHysteresis::new(1.0, half_width, 0.0).ok()?, Sinusoid::new(bias, amplitude).ok()?);
    let real = radicands.iter().all(|radicand| *radicand >= 0.0);
    Some(Case::truth(meets == real && meets == relay.describing_function(&sweep).is_ok()))
}

/// Describing function of the unit relay under a unit sinusoid, in closed form.
pub(super) fn relay<T: Real>(level: T, half_width: T, bias: T) -> DescribingFunction<T> {
    let relay = RelayHysteresis::new(level, half_width, T::zero());
    let df = relay.and_then(|relay| Ok((relay, Sinusoid::new(bias, T::one())?)));
    df.ok().and_then(|(relay, sweep)| relay.describing_function(&sweep).ok()).unwrap_or_else(no_function)
}

pub(super) fn root<T: Real>(distance: T) -> T {
    (T::one() - distance.square()).sqrt()
}

/// Half-widths and biases, over the amplitude, in each case of sign: which of the two is the larger, the bias's sign,
/// and how many of the two levels lie in the middle half of the sweep, where the code goes another way.
#[rustfmt::skip]
pub(super) const SWITCHINGS: [[f64; 2]; 12] = [
    [0.3, 0.1], [0.3, -0.1], [0.1, 0.3], [0.1, -0.3],
    [0.625, 0.25], [0.625, -0.25], [0.25, 0.625], [0.25, -0.625],
    [0.75, 0.125], [0.75, -0.125], [0.125, 0.75], [0.125, -0.75],
];

/// Proof of a printed formula in three parts, for all half-widths and biases: the closed form of a sign is its integral; the
/// formula's term of a switching level, at the ratio u, is that closed form; the terms are put together as the code does.
fn prove_printed(
    distortion: Distortion,
    term: impl Fn(Rational) -> Rational,
    formula: impl Fn(Rational, Rational) -> Rational,
    component: fn(DescribingFunction<Rational>) -> Rational,
) -> Verdict {
    const TERM: ClaimPart = ClaimPart::named("term");
    const SUM: ClaimPart = ClaimPart::named("sum");
    let of_level = |[at]: [Rational; 1], factor: Rational| {
        let level = Kernel::Sign { at, level: number(1.0), branches: Branches::Rising };
        Some([term(at) * factor - component(on_unit(level))])
    };
    let of_sum = |[half_width, bias]: [Rational; 2], factor: Rational| {
        Some([formula(half_width, bias) * factor - component(relay(number(1.0), half_width, bias))])
    };
    prove_kernel(KernelForm::Sign, distortion, BREAKPOINT)
        .and(|| exactly(TERM, distortion, &[[0.3], [-0.3], [0.7], [-0.7]], of_level))
        .and(|| exactly(SUM, distortion, &SWITCHINGS, of_sum))
}

/// The inverse sine: towards the turning points by the half angle, as the code forms it.
fn inverse_sine(u: Rational) -> Rational {
    let (half, quarter_turn) = (number(0.5), number(0.5) * Rational::pi());
    let from = |end: Rational| number(2.0) * (half * end).sqrt().asin();
    let near_an_end = || u.select(|| from(number(1.0) + u) - quarter_turn, || quarter_turn - from(number(1.0) - u));
    (u.abs() - half).select(|| u.asin(), near_an_end)
}

/// Eq. 32: by the angles, and by the times between the two crossings.
fn prove_relay_f0(distortion: Distortion) -> Verdict {
    let term = |u| -(inverse_sine(u) / Rational::pi());
    let times = |[half_width, bias]: [Rational; 2], factor: Rational| {
        let high = Rational::pi() - inverse_sine(half_width - bias) + inverse_sine(half_width + bias);
        let by_time = bias_of_output(factor, high, number(2.0) * Rational::pi() - high);
        Some([by_time - relay(number(1.0), half_width, bias).f0])
    };
    prove_printed(distortion, term, |width, bias| term(width - bias) - term(width + bias), |df| df.f0)
        .and(|| exactly(ClaimPart::named("sum"), distortion, &SWITCHINGS, times))
}

/// Each direction of the quadrant is that of some relay: with `t` from 0 to 1 the angle is `pi - 2 atan(t)`, its cosine
/// `-(1 - t^2)/(1 + t^2)`, its sine `2 t/(1 + t^2)`.
fn some_relay([t]: [Rational; 1], factor: Rational) -> Option<[Rational; 2]> {
    let square = t.square();
    let [cosine, sine] = [square - number(1.0), number(2.0) * t].map(|part| part / (number(1.0) + square));
    let df = relay(Rational::pi() / number(4.0), sine, number(0.0));
    Some([df.p + factor * cosine, df.q + factor * sine])
}

/// Every relay's components have the signs of the quadrant.
fn every_relay([level, half_width, amplitude]: [Rational; 3], factor: Rational) -> Option<[Rational; 2]> {
    let relay = RelayHysteresis::new(level, half_width, number(0.0)).ok()?;
    let df = relay.describing_function(&Sinusoid::new(number(0.0), amplitude).ok()?).ok()?;
    let scale = number(4.0) * level / (Rational::pi() * amplitude);
    let share = half_width / amplitude;
    Some([df.p - factor * scale * root(share), df.q + factor * scale * share])
}

/// The larger of the two distances that eq. 31 takes roots of is the least amplitude that the relay asks for.
fn farther_level([half_width, bias]: [Rational; 2], factor: Rational) -> Option<[Rational; 1]> {
    let relay = RelayHysteresis::new(number(1.0), half_width, number(0.0)).ok()?;
    let farther = (half_width - bias).abs().max((half_width + bias).abs());
    Some([farther - factor * relay.least_amplitude(bias)])
}
