//! Theorems 2 and 3: when the self-oscillations of a closed loop are symmetric, on exact orbits and on the first harmonic.

use super::algebra::{exactly, number};
use super::existence::{return_error, with_integrator};
use super::step::by_steps;
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::balance::{LipschitzLoop, OddCharacteristic};
use crate::describing::{bias_of_output, by_quadrature};
use crate::nonlinearity::{Custom, RelayHysteresis, Sinusoid};
use crate::numeric::{Interval, Real};
use crate::orbit::{ListedOrbit, TwoLevelRelay, orbits};
use crate::plant::TransferFunction;
use crate::proof::polynomial::Rational;

/// Closed loops are dear: a hundredth of the cases that a formula gets.
fn few(cases: usize) -> usize {
    cases.div_ceil(100)
}

/// A plant with lags, with or without an integrator, under a relay whose levels may be offset.
struct LaggedLoop {
    integrating: bool,
    offset: bool,
}

impl LaggedLoop {
    /// Its exact orbits with a single switching each way, and the reference.
    fn orbits(&self, draw: &mut Draw) -> Option<(Vec<ListedOrbit>, f64)> {
        let (first, second) = (draw.log_uniform("first_lag_s", 0.3, 3.0), draw.log_uniform("second_lag_s", 0.3, 3.0));
        let lags = [first * second, first + second, 1.0];
        let denominator = if self.integrating { vec![lags[0], lags[1], 1.0, 0.0] } else { lags.to_vec() };
        let plant = TransferFunction::new(&[1.0], &denominator).ok()?;
        let offset = if self.offset { draw.uniform("offset", 0.1, 0.5) } else { 0.0 };
        let reference = draw.uniform("reference", 0.1, 0.4);
        let relay = RelayHysteresis::new(1.0, draw.uniform("half_width", 0.1, 0.3), offset).ok()?;
        let lap = first + second;
        let relay = TwoLevelRelay::from(relay).with_reference(reference).ok()?;
        let found = orbits(&plant, &relay, Some(0.1 * lap..=100.0 * lap)).ok()?.orbits;
        (!found.is_empty()).then_some((found, reference))
    }
}

/// Difference of the times at both commands.
fn skew_s(orbit: &ListedOrbit) -> Interval {
    orbit.time_high_s - orbit.time_low_s
}

/// The number of an enclosure that is nearest to another: of two close poles it is wider than the rounding of a number.
fn nearest(enclosure: Interval, to: f64) -> f64 {
    to.clamp(enclosure.lower(), enclosure.upper())
}

/// Equal times at both commands, and the output's middle on the reference where the plant integrates.
fn symmetry(draw: &mut Draw, orbit: &ListedOrbit, centre: f64) -> Case {
    let (period, amplitude) = (orbit.period_s.midpoint(), orbit.amplitude().midpoint());
    let skew = nearest(skew_s(orbit), 0.0);
    let middle = nearest(orbit.bias(), centre);
    let equations = [("time_difference_s", skew, 0.0, period), ("middle", middle, centre, amplitude)];
    draw.equations(equations, tolerance::CANCELLING)
}

/// Every orbit is symmetric.
fn symmetric(draw: &mut Draw, family: &LaggedLoop) -> Option<Case> {
    let (orbits, reference) = family.orbits(draw)?;
    let centre = if family.integrating { reference } else { 0.0 };
    Some(orbits.iter().fold(Case::truth(true), |case, orbit| case.and(symmetry(draw, orbit, centre))))
}

/// No orbit is symmetric: the margin is the least difference of times, as a share of the period.
fn asymmetric(draw: &mut Draw, family: &LaggedLoop) -> Option<Case> {
    let (orbits, _) = family.orbits(draw)?;
    let skew = |orbit: &ListedOrbit| skew_s(orbit).abs().lower() / orbit.period_s.upper() - tolerance::CANCELLING;
    Some(Case::margin(draw.note("least_skew", orbits.iter().map(skew).fold(f64::INFINITY, f64::min))))
}

/// The first harmonic of `function` balances `gain/(s (s + 1)^2)`, which turns the phase over at 1 rad/s with half its gain,
/// at this bias and amplitude: residuals of `F_0 = 0` and of `1 + P G = 0`.
fn residual(function: fn(f64) -> f64, gain: f64, bias: f64, amplitude: f64) -> Option<f64> {
    let sweep = Sinusoid::new(bias, amplitude).ok()?;
    let df = by_quadrature(&Custom::new(|x: f64, _| function(x), &[]), &sweep).ok()?;
    Some(df.f0.abs().max((1.0 - 0.5 * gain * df.p).abs()))
}

/// Poles of `gain/(s (s + 1)^2)` without its integrator.
const EQUAL_LAGS: [f64; 2] = [1.0, 1.0];

/// `gain/(s (s + 1)^2)` oscillates with a bias under `x^3 - 2x`, which is odd: proved, and confirmed by an integration over
/// a period. The search begins at the first harmonic's balance: the bias solves `F_0 = 0`, the amplitude `1 + P G = 0`.
fn odd_and_astatic_without_bias(draw: &mut Draw) -> Option<Case> {
    let gain = draw.uniform("gain", 0.56, 0.75);
    let amplitude = ((4.0 - 2.0 / gain) / 3.75).sqrt();
    let bias = (2.0 - 1.5 * amplitude * amplitude).sqrt();
    let proved = || {
        let (plant, cubic) = (with_integrator(EQUAL_LAGS, gain)?, vec![-2.0, 1.0]);
        let cubic = OddCharacteristic::Polynomial { odd_coefficients: cubic };
        LipschitzLoop::new(&plant, cubic).ok()?.prove_biased_near(bias, amplitude, 1.0).ok()
    };
    let proved = proved()?;
    let off = return_error(&proved, EQUAL_LAGS, gain, |x| x * x * x - 2.0 * x);
    if draw.note("off", off) > tolerance::INTEGRATED {
        return None;
    }
    let least_bias = draw.note("least_bias", proved.mean().abs().lower());
    Some(Case::margin(-least_bias / proved.amplitude().upper()))
}

const FIRST_HARMONIC: ClaimPart = ClaimPart::named("first-harmonic");
const RELAY_ORBITS: ClaimPart = ClaimPart::named("relay-orbits");

claim! {
    THEOREM_2 = "theorem-2" Theorem
    "Odd, nondecreasing and not zero inside the sweep: symmetric about any constant reference if the process integrates, and about none but zero if not";
    cases few;
    printed Refuted odd_and_astatic_without_bias();
    corrected symmetric(&LaggedLoop { integrating: true, offset: false })
        and asymmetric(&LaggedLoop { integrating: false, offset: false });
    // A reference that does not matter without an integrator either.
    false symmetric(&LaggedLoop { integrating: false, offset: false });
    needs "integrating" symmetric(&LaggedLoop { integrating: false, offset: false });
    needs "odd" symmetric(&LaggedLoop { integrating: true, offset: true });
    needs "nondecreasing" odd_and_astatic_without_bias();
    proof prove_theorem_2;
}

/// Gain 1 up to the input 1, then 0.2 up to the limits at -7 and 4, is not odd; and 10/(s (s + 1)(s + 2)) oscillates half-wave
/// symmetrically under it. Proved for its odd continuation: beyond
/// the largest input the characteristic does not matter.
fn not_odd_and_symmetric(draw: &mut Draw) -> Option<Case> {
    const POLES: [f64; 2] = [1.0, 2.0];
    let limited = |x: f64| {
        let inside = x.clamp(-7.0, 4.0);
        inside.clamp(-1.0, 1.0) + 0.2 * (inside - inside.clamp(-1.0, 1.0))
    };
    let gain = draw.uniform("gain", 9.0, 11.0);
    let proved = || {
        let odd = OddCharacteristic::PiecewiseLinear { kinks: vec![1.0], slopes: vec![1.0, 0.2] };
        let plant = with_integrator(POLES, gain)?;
        LipschitzLoop::new(&plant, odd).ok()?.prove_near(0.25 * gain, 1.4).ok()
    };
    let proved = proved()?;
    let off = return_error(&proved, POLES, gain, limited);
    let largest = proved.largest_input().ok()?;
    if draw.note("off", off) > tolerance::INTEGRATED_ACROSS_KINKS {
        return None;
    }
    Some(Case::margin(draw.note("largest_input", largest) / 4.0 - 1.0))
}

/// `x + x^2 - 1/2` is not odd, and balances an astatic process of gain 2 without bias at amplitude 1.
fn not_odd_and_astatic_with_bias(draw: &mut Draw) -> Option<Case> {
    let (gain, bias, amplitude) = (draw.note("gain", 2.0), draw.note("bias", 0.0), draw.note("amplitude", 1.0));
    let balanced = residual(|x| x + x * x - 0.5, gain, bias, amplitude);
    Some(Case::margin(draw.note("residual", balanced?) - tolerance::QUADRATURE))
}

claim! {
    THEOREM_3 = "theorem-3" Theorem
    "Integrating process: an even part of one sign makes the self-oscillations asymmetric; an odd nondecreasing characteristic keeps them symmetric";
    cases few;
    printed Refuted not_odd_and_symmetric();
    corrected asymmetric(&LaggedLoop { integrating: true, offset: true })
        and symmetric(&LaggedLoop { integrating: true, offset: false });
    false asymmetric(&LaggedLoop { integrating: true, offset: false });
    needs "integrating" symmetric(&LaggedLoop { integrating: false, offset: false });
    needs "even-part-of-one-sign" not_odd_and_astatic_with_bias();
    proof prove_theorem_3;
}

/// On the first harmonic by lemma 1; on exact orbits by the mean of the command and the levels at which it switches: mean zero is
/// equal times, and mirrored half waves that switch at both levels are mirrored at the reference.
fn prove_theorem_2(distortion: Distortion) -> Verdict {
    let orbits = |[level, positive_s, negative_s, half_width, reference]: [Rational; 5], factor: Rational| {
        let relay = RelayHysteresis::new(level, half_width, number(0.0)).ok()?;
        let mean = bias_of_output(level, positive_s, negative_s);
        // The input is the reference less the output; it rises through the first level and falls through the second.
        let [rising, falling] = relay.switching_levels();
        let (lower, upper) = (reference - rising, reference - falling);
        Some([
            mean * (positive_s + negative_s) - factor * level * (positive_s - negative_s),
            (lower + upper) / number(2.0) - reference,
        ])
    };
    by_steps(distortion, const { &[FIRST_HARMONIC] })
        .and(|| exactly(RELAY_ORBITS, distortion, &[[1.0, 0.6, 0.4, 0.2, 0.3]], orbits))
}

/// On the first harmonic by lemmas 1 and 2; on exact orbits by the mean of the command: with levels `offset +- level` it vanishes
/// where the times differ by `-offset/level` of the period.
fn prove_theorem_3(distortion: Distortion) -> Verdict {
    let orbits = |[level, positive_s, offset]: [Rational; 3], factor: Rational| {
        let negative_s = positive_s * (level + offset) / (level - offset);
        let period_s = positive_s + negative_s;
        Some([
            bias_of_output(level, positive_s, negative_s) + factor * offset,
            (positive_s - negative_s) / period_s + offset / level,
        ])
    };
    by_steps(distortion, const { &[FIRST_HARMONIC] })
        .and(|| exactly(RELAY_ORBITS, distortion, &[[1.0, 0.6, 0.3]], orbits))
}
