//! From the first harmonic to parameters: eqs. 21-29, 33-34, Table 3, 37-39, 41-42, the zig-zag test.

use crate::numeric::{Gradient, Interval, Real};
use crate::proof::identity::{IdentityJet, prove_zero_of_two};
use crate::proof::polynomial::{Rational, decided};
use core::f64::consts::PI;

use nalgebra::Complex;

use super::algebra::{identity, number};
use super::relay::{SWITCHINGS, relay, root};
use super::{Case, ClaimPart, ClaimVariable, Distortion, Draw, Evidence, Verdict, claim, tolerance};
use crate::describing::{DescribingFunction, by_quadrature};
use crate::identify::fit::select::pairwise::{Decision, decide, relative_spread_percent};
use crate::identify::iso::{Oscillation, parameters};
use crate::nonlinearity::{RelayHysteresis, Sinusoid};

/// Features of an oscillation that satisfies condition 40, with room to differentiate.
pub(super) fn oscillation(draw: &mut Draw, biased: bool, delayed: bool) -> Oscillation<f64> {
    let switch_level = draw.uniform("switch_level", 0.1, 1.0);
    let bias = if biased { draw.uniform("bias", -0.5, 0.5) * switch_level } else { 0.0 };
    Oscillation {
        relay_level: draw.uniform("relay_level", 0.5, 2.0),
        switch_level,
        amplitude: draw.uniform("amplitude_ratio", 1.05, 4.0) * (switch_level + bias.abs()),
        bias,
        period_s: draw.uniform("period_s", 1.0, 8.0),
        delay_s: if delayed { draw.uniform("delay_s", 0.05, 0.3) } else { 0.0 },
    }
}

claim! {
    TABLE_3 = "table-3" Identity
    "Eqs. 27 and 29 with 30 and 31 put in are Table 3";
    printed Holds table_3(1.5);
    false table_3(3.0 * PI / 8.0);
    exactly table_3_of_relay on "table" at &SWITCHINGS;
}

/// Table 3's own expressions against eqs. 27 and 29 of a gain by quadrature.
fn table_3(draw: &mut Draw, quadratic_factor: f64) -> Option<Case> {
    let o = oscillation(draw, true, false);
    let (relay, sweep) =
        (RelayHysteresis::new(o.relay_level, o.switch_level, 0.0).ok()?, Sinusoid::new(o.bias, o.amplitude).ok()?);
    let gain = by_quadrature(&relay, &sweep).ok()?;
    let omega = o.omega_rad_s();
    let composed = parameters(gain, o.amplitude, omega);
    let (level, width, amplitude) = (o.relay_level, o.switch_level, o.amplitude);
    let root = |distance: f64| (1.0 - (distance / amplitude).powi(2)).sqrt();
    let alpha = 2.0 * level / (PI * omega * omega * amplitude) * (root(width - o.bias) + root(width + o.bias));
    let beta = 4.0 * level * width / (PI * omega * amplitude * amplitude);
    let beta_xx = quadratic_factor * level * width / (omega * omega * amplitude.powi(3));
    let equation = |name, written: f64, composed: f64| (name, written, composed, composed.abs().max(1e-3));
    let equations = [
        equation("alpha", alpha, composed.alpha),
        equation("beta", beta, composed.beta),
        equation("beta_xx", beta_xx, composed.beta_quadratic),
    ];
    Some(draw.equations(equations, tolerance::CANCELLING))
}

claim! {
    DELAY_ROTATION = "delay-rotation" Identity
    "A delay turns the describing function by -w T_d: lengths stay, delays add, a negative one undoes";
    printed Holds rotation(-1.0);
    false rotation(1.0);
    proof prove_delay_rotation;
}

fn rotation(draw: &mut Draw, sign: f64) -> Option<Case> {
    let (p, q) = (draw.uniform("p", -3.0, 3.0), draw.uniform("q", -3.0, 3.0));
    let (one, two) = (draw.uniform("phase_rad", 0.0, 6.0), draw.uniform("second_phase_rad", 0.0, 6.0));
    let gain = DescribingFunction { f0: 0.0, p, q };
    let turned = gain.delayed(one);
    let expected = Complex::new(p, q) * Complex::new(0.0, sign * one).exp();
    let scale = libm::hypot(p, q) + 1e-3;
    let both = turned.delayed(two);
    let at_once = gain.delayed(one + two);
    let back = turned.delayed(-one);
    let equations = [
        ("p_turned", turned.p, expected.re, scale),
        ("q_turned", turned.q, expected.im, scale),
        ("length", libm::hypot(turned.p, turned.q), libm::hypot(p, q), scale),
        ("p_in_two", both.p, at_once.p, scale),
        ("q_in_two", both.q, at_once.q, scale),
        ("p_back", back.p, p, scale),
        ("q_back", back.q, q, scale),
    ];
    Some(draw.equations(equations, tolerance::ROUNDING))
}

claim! {
    RELATIVE_SPREAD = "relative-spread" Definition
    "The relative spread of two values is their sample standard deviation over their mean";
    printed Holds spread(1.0);
    // Over n in place of n - 1.
    false spread(2.0);
    exactly squared_spread on "ratio" at &[[1.0, 2.0], [2.0, 1.0]];
}

fn spread(draw: &mut Draw, degrees_of_freedom: f64) -> Option<Case> {
    let values = [draw.uniform("first", 0.1, 10.0), draw.uniform("second", 0.1, 10.0)];
    let mean = 0.5 * (values[0] + values[1]);
    let square: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    let expected = (square / degrees_of_freedom).sqrt() / mean * 100.0;
    Some(draw.equal(("spread", relative_spread_percent(values[0], values[1])), expected, 100.0, tolerance::ROUNDING))
}

claim! {
    DRAG_DECISION = "drag-decision" Definition
    "The drag law is the one whose coefficient spreads less, by more than the margin";
    printed Holds decision(decide);
    // The paper's two names of the laws exchanged.
    false decision(|linear, quadratic, margin| decide(quadratic, linear, margin));
    proof prove_decision;
}

fn decision(draw: &mut Draw, rule: fn(f64, f64, f64) -> Decision) -> Option<Case> {
    let (linear, quadratic) = (draw.uniform("spread_linear", 0.0, 30.0), draw.uniform("spread_quadratic", 0.0, 30.0));
    let (margin, wider) = (draw.uniform("margin", 0.0, 10.0), draw.uniform("wider", 0.0, 10.0));
    let by_distance = match (linear - quadratic).abs() > margin {
        false => Decision::Undecided,
        true if quadratic < linear => Decision::Quadratic,
        true => Decision::Linear,
    };
    let decided = rule(linear, quadratic, margin);
    let reserved = rule(linear, quadratic, margin + wider);
    Some(Case::truth(decided == by_distance && (reserved == decided || reserved == Decision::Undecided)))
}

claim! {
    ZIG_ZAG = "zig-zag" Identity
    "Nomoto's T r' + r = K delta_R is the drag axis alpha = T/K, beta = 1/K";
    printed Holds nomoto(|gain| 1.0 / gain);
    false nomoto(|gain| gain);
    exactly response_to_step on "response" at &[[1.0, 2.0, 0.5]];
}

/// Turning rate under a constant rudder: Nomoto's `K d (1 - exp(-t/T))` satisfies the axis's equation.
fn nomoto(draw: &mut Draw, drag: fn(f64) -> f64) -> Option<Case> {
    let (time_constant, gain) = (draw.uniform("time_constant_s", 0.5, 20.0), draw.uniform("gain_per_s", 0.05, 0.9));
    let (rudder, t) = (draw.uniform("rudder_rad", -0.4, 0.4), draw.uniform("time_s", 0.0, 30.0));
    let decay = libm::exp(-t / time_constant);
    let (rate, acceleration) = (gain * rudder * (1.0 - decay), gain * rudder * decay / time_constant);
    let moment = time_constant / gain * acceleration + drag(gain) * rate;
    Some(draw.equal(("moment", moment), rudder, rudder.abs() + 1e-3, tolerance::ROUNDING))
}

/// Table 3, for all half-widths and biases.
fn table_3_of_relay([width, bias]: [Rational; 2], factor: Rational) -> Option<[Rational; 3]> {
    let found = parameters(relay(number(1.0), width, bias), number(1.0), number(1.0));
    let pi = Rational::pi();
    let alpha = number(2.0) / pi * (root(width - bias) + root(width + bias));
    Some([
        factor * alpha - found.alpha,
        factor * number(4.0) * width / pi - found.beta,
        factor * number(1.5) * width - found.beta_quadratic,
    ])
}

/// Turning is multiplication by `exp(-j phase)`, and turning back undoes it.
fn prove_delay_rotation(distortion: Distortion) -> Verdict {
    const COVERED: ClaimPart =
        ClaimPart::over("rotation", "", const { &[ClaimVariable::new("phase", "rad", 0.0, 6.5)] });
    identity(COVERED, distortion, |phase, factor| {
        let (one, none) = (IdentityJet::one(), IdentityJet::zero());
        let (cosine, sine) = (factor * phase.cos(), factor * phase.sin());
        let real = DescribingFunction { f0: none, p: one, q: none };
        let imaginary = DescribingFunction { f0: none, p: none, q: one };
        let (turned, other) = (real.delayed(phase), imaginary.delayed(phase));
        let back = turned.delayed(-phase);
        [
            turned.p - cosine,
            turned.q + sine,
            other.p - sine,
            other.q - cosine,
            turned.p.square() + turned.q.square() - one,
            back.p - one,
            back.q,
        ]
    })
    .and(|| prove_delays_add(distortion))
}

/// A unit gain turned twice and turned by the sum: real and imaginary part.
fn turned_twice<T: Real>(one: T, two: T, distortion: Distortion) -> [T; 2] {
    let gain = DescribingFunction { f0: T::zero(), p: T::one(), q: T::zero() };
    let (in_turn, at_once) = (gain.delayed(one).delayed(two), gain.delayed(one + two));
    let factor = distortion.at(one, PHASES);
    [factor * in_turn.p - at_once.p, factor * in_turn.q - at_once.q]
}

/// A little more than a turn.
const PHASES: [f64; 2] = [0.0, 6.5];

/// Two delays in turn are their sum.
fn prove_delays_add(distortion: Distortion) -> Verdict {
    const COVERED: ClaimPart = ClaimPart::named("delays-add");
    let values = |one, two| turned_twice::<Interval>(one, two, distortion);
    let series = |one, two| turned_twice::<IdentityJet>(one, two, distortion);
    match prove_zero_of_two(values, series, [PHASES; 2], tolerance::PROOF, 20_000) {
        Ok(proved) => Verdict::Holds(Evidence::identity(COVERED, proved.bound.value(), proved.boxes)),
        Err(_) => Verdict::undecided("20000 cells for two phases"),
    }
}

/// Eq. 41 squared: the first value the larger, and the second.
fn squared_spread([first, second]: [Rational; 2], factor: Rational) -> Option<[Rational; 1]> {
    let mean = (first + second) / number(2.0);
    let square = (first - mean).square() + (second - mean).square();
    let spread = relative_spread_percent(first, second) / number(100.0);
    Some([factor * square / mean.square() - spread.square()])
}

/// Nomoto's response to a unit step of the rudder satisfies the axis's equation.
fn response_to_step([t, time_constant, gain]: [Rational; 3], factor: Rational) -> Option<[Rational; 1]> {
    let [t] = Gradient::variables([t]);
    let [time_constant, gain] = [time_constant, gain].map(Gradient::<_, 1>::constant);
    let rate = gain * (Gradient::one() - (-t / time_constant).exp());
    let (alpha, beta) = ((time_constant / gain).value(), factor / gain.value());
    Some([alpha * rate.slopes()[0] + beta * rate.value() - number(1.0)])
}

/// The code's comparisons, read off: each outcome comes with those that define it, and no more.
fn prove_decision(distortion: Distortion) -> Verdict {
    let factor = number(distortion.factor());
    let mut cases = 0;
    for point in [[9.0, 2.0, 3.0], [2.0, 9.0, 3.0], [4.0, 5.0, 3.0]] {
        let (decision, comparisons) = decided(point, |[linear, quadratic, margin]| decide(linear, quadratic, margin));
        let [above, below] = decided(point, |[linear, quadratic, margin]: [Rational; 3]| {
            [linear - quadratic - factor * margin, -factor * margin - (linear - quadratic)]
        })
        .0;
        // The difference less the margin, then the margin's negative less the difference.
        let defining = match decision {
            Decision::Quadratic => vec![(above, true)],
            Decision::Linear => vec![(above, false), (-below, false)],
            Decision::Undecided => vec![(above, false), (-below, true)],
        };
        if comparisons != defining {
            return Verdict::undecided("the comparisons of three cases");
        }
        cases += 1;
    }
    Verdict::Holds(Evidence::identity(ClaimPart::WHOLE, 0.0, cases))
}
