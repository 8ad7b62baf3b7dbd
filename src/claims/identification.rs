//! From the first harmonic to parameters: eqs. 21-29, 33-34, Table 3, 37-39, 41-42, the zig-zag test.

use core::f64::consts::PI;

use nalgebra::Complex;

use super::claim::claim;
use super::{Budget, Case, Draw, Hypothesis, Printed, Verdict, proof, sample, tolerance};
use crate::describing::{DescribingFunction, by_quadrature};
use crate::identify::iso::{Oscillation, Parameters, amplitude_sensitivity, parameters};
use crate::identify::select::pairwise::{Decision, decide, relative_spread_percent};
use crate::nonlinearity::{RelayHysteresis, Sinusoid};
use crate::numeric::quadrature::integrate;
use crate::numeric::{Gradient, Real};

/// An axis on one tone: parameters, amplitude, angular frequency.
struct Tone {
    alpha: f64,
    linear: f64,
    quadratic: f64,
    amplitude: f64,
    omega: f64,
}

impl Tone {
    fn draw(draw: &mut Draw) -> Self {
        Self {
            alpha: draw.log_uniform("alpha", 0.1, 10.0),
            linear: draw.uniform("linear_drag", 0.0, 3.0),
            quadratic: draw.uniform("quadratic_drag", 0.0, 3.0),
            amplitude: draw.uniform("amplitude", 0.1, 2.0),
            omega: draw.log_uniform("omega_rad_s", 0.2, 5.0),
        }
    }

    /// First harmonic `(f_R, f_I)` of the left side over the amplitude, by quadrature along the sinusoid.
    fn first_harmonic(&self) -> (f64, f64) {
        let force = |angle: f64| {
            let speed = self.amplitude * self.omega * angle.cos();
            let acceleration = -self.amplitude * self.omega * self.omega * angle.sin();
            self.alpha * acceleration + self.linear * speed + self.quadratic * speed * speed.abs()
        };
        let coefficient = |weight: fn(f64) -> f64| {
            let piece = |from, to| integrate(|angle| force(angle) * weight(angle), from, to, 1e-14, 1000).value;
            (piece(-0.5 * PI, 0.5 * PI) + piece(0.5 * PI, 1.5 * PI)) / (PI * self.amplitude)
        };
        (coefficient(f64::sin), coefficient(f64::cos))
    }

    /// Size of the left side over the amplitude.
    fn scale(&self) -> f64 {
        (self.alpha * self.omega + self.linear + self.quadratic * self.amplitude * self.omega) * self.omega
    }
}

claim! {
    FIRST_HARMONIC = "first-harmonic-equations" "21-25" Identity
    "On one tone the drag axis has f_R = -alpha w^2 and f_I = beta_1 w + (8/(3 pi)) beta_2 X w^2" {
        printed: Printed::Holds(|budget| left_side(budget, 8.0 / (3.0 * PI)).backed_by(proof::first_harmonic)),
        corrected: None,
        falsified: |budget| left_side(budget, 0.85),
        hypotheses: &[],
        depends: &["fourier-coefficients", "sine-abs-sine"],
    }
}

fn left_side(budget: Budget, sine_abs_sine: f64) -> Verdict {
    sample(budget, |draw| {
        let tone = Tone::draw(draw);
        let (real, imaginary) = tone.first_harmonic();
        let (inertia, scale) = (-tone.alpha * tone.omega * tone.omega, tone.scale());
        let drag = (tone.linear + sine_abs_sine * tone.quadratic * tone.amplitude * tone.omega) * tone.omega;
        draw.equal(("f_r", real), inertia, scale, tolerance::QUADRATURE).and(draw.equal(
            ("f_i", imaginary),
            drag,
            scale,
            tolerance::QUADRATURE,
        ))
    })
}

claim! {
    LINEAR_DRAG = "linear-drag" "26-27" Theorem
    "On one tone with linear drag, alpha = P/w^2 and beta = -Q/w give the parameters back" {
        printed: Printed::Holds(|budget| gives_back(budget, |tone| tone.quadratic = 0.0, |p| p.beta, |t| t.linear).backed_by(proof::linear_drag)),
        corrected: None,
        falsified: |budget| gives_back(budget, |_| {}, |p| p.beta, |t| t.linear),
        hypotheses: &[Hypothesis { id: "one-tone", counterexample: None }],
        depends: &["first-harmonic-equations"],
    }
}

claim! {
    QUADRATIC_DRAG = "quadratic-drag" "28-29" Theorem
    "On one tone with quadratic drag, alpha = P/w^2 and beta_xx = -(3 pi/8) Q/(X w^2) give the parameters back" {
        printed: Printed::Holds(|budget| gives_back(budget, |tone| tone.linear = 0.0, |p| p.beta_quadratic, |t| t.quadratic).backed_by(proof::quadratic_drag)),
        corrected: None,
        falsified: |budget| gives_back(budget, |_| {}, |p| p.beta_quadratic, |t| t.quadratic),
        hypotheses: &[Hypothesis { id: "one-tone", counterexample: None }],
        depends: &["first-harmonic-equations"],
    }
}

/// The relay's gain balances the left side; the identification gives back what the left side was made of.
fn gives_back(
    budget: Budget,
    law: fn(&mut Tone),
    identified: fn(&Parameters<f64>) -> f64,
    given: fn(&Tone) -> f64,
) -> Verdict {
    sample(budget, |draw| {
        let mut tone = Tone::draw(draw);
        law(&mut tone);
        let (real, imaginary) = tone.first_harmonic();
        let gain = DescribingFunction { f0: 0.0, p: -real, q: -imaginary };
        let found = parameters(gain, tone.amplitude, tone.omega);
        let drag_scale = tone.scale() / tone.omega * (1.0 + 1.0 / (tone.amplitude * tone.omega));
        let alpha_scale = tone.scale() / (tone.omega * tone.omega);
        draw.equal(("alpha_found", found.alpha), tone.alpha, alpha_scale, tolerance::QUADRATURE).and(draw.equal(
            ("drag_found", identified(&found)),
            given(&tone),
            drag_scale,
            tolerance::QUADRATURE,
        ))
    })
}

/// Features of an oscillation that meets condition 40, with room to differentiate.
fn oscillation(draw: &mut Draw, biased: bool, delayed: bool) -> Oscillation<f64> {
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
    TABLE_3 = "table-3" "Table 3" Identity
    "Eqs. 27 and 29 with 30 and 31 put in are Table 3" {
        printed: Printed::Holds(|budget| table_3(budget, 1.5).backed_by(proof::table_3)),
        corrected: None,
        falsified: |budget| table_3(budget, 3.0 * PI / 8.0),
        hypotheses: &[],
        depends: &["linear-drag", "quadratic-drag", "relay-p", "relay-q"],
    }
}

/// Table 3's own expressions against eqs. 27 and 29 of a gain by quadrature.
fn table_3(budget: Budget, quadratic_factor: f64) -> Verdict {
    sample(budget, |draw| {
        let o = oscillation(draw, true, false);
        let (Ok(relay), Ok(sweep)) =
            (RelayHysteresis::new(o.relay_level, o.switch_level, 0.0), Sinusoid::new(o.bias, o.amplitude))
        else {
            return Case::Skipped;
        };
        let Ok(gain) = by_quadrature(&relay, &sweep) else { return Case::Skipped };
        let omega = o.omega_rad_s();
        let composed = parameters(gain, o.amplitude, omega);
        let (level, width, amplitude) = (o.relay_level, o.switch_level, o.amplitude);
        let root = |distance: f64| (1.0 - (distance / amplitude).powi(2)).sqrt();
        let alpha = 2.0 * level / (PI * omega * omega * amplitude) * (root(width - o.bias) + root(width + o.bias));
        let beta = 4.0 * level * width / (PI * omega * amplitude * amplitude);
        let beta_xx = quadratic_factor * level * width / (omega * omega * amplitude.powi(3));
        let mut equal = |name, written: f64, composed: f64| {
            draw.equal((name, written), composed, composed.abs().max(1e-3), tolerance::CANCELLING)
        };
        equal("alpha", alpha, composed.alpha).and(equal("beta", beta, composed.beta)).and(equal(
            "beta_xx",
            beta_xx,
            composed.beta_quadratic,
        ))
    })
}

claim! {
    DELAY_ROTATION = "delay-rotation" "33-34" Identity
    "A delay turns the describing function by -w T_d: lengths stay, delays add, a negative one undoes" {
        printed: Printed::Holds(|budget| rotation(budget, -1.0).backed_by(proof::delay_rotation)),
        corrected: None,
        falsified: |budget| rotation(budget, 1.0),
        hypotheses: &[],
        depends: &["describing-function"],
    }
}

fn rotation(budget: Budget, sign: f64) -> Verdict {
    sample(budget, |draw| {
        let (p, q) = (draw.uniform("p", -3.0, 3.0), draw.uniform("q", -3.0, 3.0));
        let (one, two) = (draw.uniform("phase_rad", 0.0, 6.0), draw.uniform("second_phase_rad", 0.0, 6.0));
        let gain = DescribingFunction { f0: 0.0, p, q };
        let turned = gain.delayed(one);
        let expected = Complex::new(p, q) * Complex::new(0.0, sign * one).exp();
        let scale = p.hypot(q) + 1e-3;
        let both = turned.delayed(two);
        let at_once = gain.delayed(one + two);
        let back = turned.delayed(-one);
        let mut equal =
            |name, value: f64, expected: f64| draw.equal((name, value), expected, scale, tolerance::ROUNDING);
        equal("p_turned", turned.p, expected.re)
            .and(equal("q_turned", turned.q, expected.im))
            .and(equal("length", turned.p.hypot(turned.q), p.hypot(q)))
            .and(equal("p_in_two", both.p, at_once.p))
            .and(equal("q_in_two", both.q, at_once.q))
            .and(equal("p_back", back.p, p))
            .and(equal("q_back", back.q, q))
    })
}

/// Relative derivatives of (alpha, beta, beta_xx) by the relative amplitude, by dual numbers through the identification.
fn derivatives(o: &Oscillation<f64>) -> Option<[f64; 3]> {
    let constant = Gradient::<f64, 1>::from_f64;
    let dual = Oscillation {
        relay_level: constant(o.relay_level),
        switch_level: constant(o.switch_level),
        amplitude: Gradient::new(o.amplitude, [o.amplitude]),
        bias: constant(o.bias),
        period_s: constant(o.period_s),
        delay_s: constant(o.delay_s),
    };
    let found = dual.identify().ok()?;
    Some([found.alpha, found.beta, found.beta_quadratic].map(|parameter| parameter.slopes()[0] / parameter.value()))
}

/// One of eqs. 37-39 against the derivative.
fn sensitivity(budget: Budget, index: usize, biased: bool, delayed: bool, factor: f64) -> Verdict {
    sample(budget, |draw| {
        let o = oscillation(draw, biased, delayed);
        let Some(derivatives) = derivatives(&o) else { return Case::Skipped };
        let printed = amplitude_sensitivity(o.amplitude / o.switch_level);
        let printed = [printed.alpha, printed.beta, printed.beta_quadratic][index];
        draw.equal(("printed", factor * printed), derivatives[index], 1.0 + printed.abs(), tolerance::CANCELLING)
    })
}

const NO_DELAY: &str = "no-delay";

claim! {
    QUANTISATION_ALPHA = "quantisation-alpha" "37" Identity
    "dalpha/alpha = [(2 - r^2)/(r^2 - 1)] dX/X with r = X_m/x_a" {
        printed: Printed::Holds(|budget| sensitivity(budget, 0, false, false, 1.0).backed_by(proof::quantisation_alpha)),
        corrected: None,
        falsified: |budget| sensitivity(budget, 0, false, false, 1.001),
        hypotheses: &[
            Hypothesis { id: "unbiased", counterexample: Some(|budget| sensitivity(budget, 0, true, false, 1.0)) },
            Hypothesis { id: NO_DELAY, counterexample: Some(|budget| sensitivity(budget, 0, false, true, 1.0)) },
        ],
        depends: &["table-3"],
    }
}

claim! {
    QUANTISATION_BETA = "quantisation-beta" "38" Identity
    "dbeta/beta = -2 dX/X" {
        printed: Printed::Holds(|budget| sensitivity(budget, 1, true, false, 1.0).backed_by(proof::quantisation_beta)),
        corrected: None,
        falsified: |budget| sensitivity(budget, 1, true, false, 1.001),
        hypotheses: &[Hypothesis { id: NO_DELAY, counterexample: Some(|budget| sensitivity(budget, 1, true, true, 1.0)) }],
        depends: &["table-3"],
    }
}

claim! {
    QUANTISATION_BETA_XX = "quantisation-beta-xx" "39" Identity
    "dbeta_xx/beta_xx = -3 dX/X" {
        printed: Printed::Holds(|budget| sensitivity(budget, 2, true, false, 1.0).backed_by(proof::quantisation_beta_xx)),
        corrected: None,
        falsified: |budget| sensitivity(budget, 2, true, false, 1.001),
        hypotheses: &[Hypothesis { id: NO_DELAY, counterexample: Some(|budget| sensitivity(budget, 2, true, true, 1.0)) }],
        depends: &["table-3"],
    }
}

claim! {
    QUANTISATION_ZERO = "quantisation-zero" "after 37" Theorem
    "At X_m = sqrt(2) x_a alpha is insensitive, to first order, to an error of the amplitude" {
        printed: Printed::Absent,
        corrected: Some(|budget| {
            zero_at(budget, core::f64::consts::SQRT_2, false, false).backed_by(proof::quantisation_zero)
        }),
        falsified: |budget| zero_at(budget, 1.5, false, false),
        hypotheses: &[
            Hypothesis {
                id: "unbiased",
                counterexample: Some(|budget| zero_at(budget, core::f64::consts::SQRT_2, true, false)),
            },
            Hypothesis {
                id: NO_DELAY,
                counterexample: Some(|budget| zero_at(budget, core::f64::consts::SQRT_2, false, true)),
            },
        ],
        depends: &["quantisation-alpha"],
    }
}

/// The derivative of alpha vanishes at `ratio`, is positive below and negative above.
fn zero_at(budget: Budget, ratio: f64, biased: bool, delayed: bool) -> Verdict {
    sample(budget, |draw| {
        let base = oscillation(draw, biased, delayed);
        let slope = |ratio: f64| {
            let at =
                Oscillation { amplitude: ratio * base.switch_level, bias: 0.8 * (ratio - 1.0) * base.bias, ..base };
            derivatives(&at).map(|derivatives| derivatives[0])
        };
        let (Some(here), Some(below), Some(above)) = (slope(ratio), slope(0.99 * ratio), slope(1.01 * ratio)) else {
            return Case::Skipped;
        };
        draw.equal(("slope", here), 0.0, 1.0, tolerance::CANCELLING).and(Case::truth(below > 0.0 && above < 0.0))
    })
}

claim! {
    RELATIVE_SPREAD = "relative-spread" "41" Definition
    "The relative spread of two values is their sample standard deviation over their mean" {
        printed: Printed::Holds(|budget| spread(budget, 1.0).backed_by(proof::relative_spread)),
        corrected: None,
        // Over n in place of n - 1.
        falsified: |budget| spread(budget, 2.0),
        hypotheses: &[],
        depends: &[],
    }
}

fn spread(budget: Budget, degrees_of_freedom: f64) -> Verdict {
    sample(budget, |draw| {
        let values = [draw.uniform("first", 0.1, 10.0), draw.uniform("second", 0.1, 10.0)];
        let mean = 0.5 * (values[0] + values[1]);
        let square: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        let expected = (square / degrees_of_freedom).sqrt() / mean * 100.0;
        draw.equal(("spread", relative_spread_percent(values[0], values[1])), expected, 100.0, tolerance::ROUNDING)
    })
}

claim! {
    DRAG_DECISION = "drag-decision" "42" Definition
    "The drag law is the one whose coefficient spreads less, by more than the margin" {
        printed: Printed::Holds(|budget| decision(budget, decide)),
        corrected: None,
        // The paper's two names of the laws exchanged.
        falsified: |budget| decision(budget, |linear, quadratic, margin| decide(quadratic, linear, margin)),
        hypotheses: &[],
        depends: &["relative-spread"],
    }
}

fn decision(budget: Budget, rule: fn(f64, f64, f64) -> Decision) -> Verdict {
    sample(budget, |draw| {
        let (linear, quadratic) =
            (draw.uniform("spread_linear", 0.0, 30.0), draw.uniform("spread_quadratic", 0.0, 30.0));
        let (margin, wider) = (draw.uniform("margin", 0.0, 10.0), draw.uniform("wider", 0.0, 10.0));
        let by_distance = match (linear - quadratic).abs() > margin {
            false => Decision::Undecided,
            true if quadratic < linear => Decision::Quadratic,
            true => Decision::Linear,
        };
        let decided = rule(linear, quadratic, margin);
        let reserved = rule(linear, quadratic, margin + wider);
        Case::truth(decided == by_distance && (reserved == decided || reserved == Decision::Undecided))
    })
}

claim! {
    ZIG_ZAG = "zig-zag" "introduction" Identity
    "Nomoto's T r' + r = K delta_R is the drag axis alpha = T/K, beta = 1/K" {
        printed: Printed::Holds(|budget| nomoto(budget, |gain| 1.0 / gain).backed_by(proof::zig_zag)),
        corrected: None,
        falsified: |budget| nomoto(budget, |gain| gain),
        hypotheses: &[],
        depends: &[],
    }
}

/// Turning rate under a constant rudder: Nomoto's `K d (1 - exp(-t/T))` satisfies the axis's equation.
fn nomoto(budget: Budget, drag: fn(f64) -> f64) -> Verdict {
    sample(budget, |draw| {
        let (time_constant, gain) = (draw.uniform("time_constant_s", 0.5, 20.0), draw.uniform("gain_per_s", 0.05, 0.9));
        let (rudder, t) = (draw.uniform("rudder_rad", -0.4, 0.4), draw.uniform("time_s", 0.0, 30.0));
        let decay = (-t / time_constant).exp();
        let (rate, acceleration) = (gain * rudder * (1.0 - decay), gain * rudder * decay / time_constant);
        let moment = time_constant / gain * acceleration + drag(gain) * rate;
        draw.equal(("moment", moment), rudder, rudder.abs() + 1e-3, tolerance::ROUNDING)
    })
}
