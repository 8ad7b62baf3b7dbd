//! The relay with hysteresis: eqs. 30-32 and what the paper says of it in words.

use core::f64::consts::PI;

use super::claim::claim;
use super::{Budget, Case, Draw, Hypothesis, Printed, Verdict, proof, sample, tolerance};
use crate::describing::{ClosedForm, DescribingFunction, bias_of_output, by_quadrature};
use crate::experiment::Relay;
use crate::nonlinearity::{RelayHysteresis, Sinusoid};

/// A relay, an input that switches it, and the describing function by quadrature.
struct Switching {
    level: f64,
    half_width: f64,
    offset: f64,
    bias: f64,
    amplitude: f64,
    integral: DescribingFunction<f64>,
}

fn switching(draw: &mut Draw) -> Option<Switching> {
    let (level, half_width) = (draw.uniform("level", 0.1, 3.0), draw.uniform("half_width", 0.0, 2.0));
    let (offset, bias) = (draw.uniform("offset", -1.0, 1.0), draw.uniform("bias", -2.0, 2.0));
    let amplitude = draw.note("amplitude", (half_width + bias.abs()) * 1.0001) + draw.uniform("excess", 0.0, 3.0);
    let relay = RelayHysteresis::new(level, half_width, offset).ok()?;
    let integral = by_quadrature(&relay, &Sinusoid::new(bias, amplitude).ok()?).ok()?;
    Some(Switching { level, half_width, offset, bias, amplitude, integral })
}

/// A formula for a part of the describing function against its integral.
fn formula(
    budget: Budget,
    part: fn(&DescribingFunction<f64>) -> f64,
    formula: fn(&Switching) -> f64,
    gain: bool,
) -> Verdict {
    sample(budget, |draw| {
        let Some(case) = switching(draw) else { return Case::Skipped };
        let scale = (case.level + case.offset.abs()) / if gain { case.amplitude } else { 1.0 };
        draw.equal(("formula", formula(&case)), part(&case.integral), scale, tolerance::QUADRATURE)
    })
}

claim! {
    RELAY_Q = "relay-q" "30" Identity
    "Q of a relay with hysteresis is -4 C x_a/(pi X^2), whatever the bias and the offset" {
        printed: Printed::Holds(|budget| {
            formula(budget, |df| df.q, |s| -4.0 * s.level * s.half_width / (PI * s.amplitude * s.amplitude), true)
                .backed_by(proof::relay_q)
        }),
        corrected: None,
        falsified: |budget| {
            formula(budget, |df| df.q, |s| -4.0 * s.level * (s.half_width + s.bias) / (PI * s.amplitude * s.amplitude), true)
        },
        hypotheses: &[Hypothesis { id: "switches-both-ways", counterexample: Some(formula_below_switching) }],
        depends: &["kernel-sign", "describing-function"],
    }
}

/// Below the switching amplitude the output is constant: its Q is zero, the formula's is not.
fn formula_below_switching(budget: Budget) -> Verdict {
    sample(budget, |draw| {
        let half_width = draw.uniform("half_width", 0.5, 1.0);
        let amplitude = draw.uniform("amplitude", 0.1, 0.5);
        let formula = -4.0 * half_width / (PI * amplitude * amplitude);
        draw.equal(("formula", formula), 0.0, 1.0, tolerance::ROUNDING)
    })
}

claim! {
    RELAY_P = "relay-p" "31" Identity
    "P of a relay with hysteresis is (2C/(pi X)) [sqrt(1 - ((x_a - x_0)/X)^2) + sqrt(1 - ((x_a + x_0)/X)^2)]" {
        printed: Printed::Holds(|budget| formula(budget, |df| df.p, |s| in_phase(s, s.bias), true).backed_by(proof::relay_p)),
        corrected: None,
        falsified: |budget| formula(budget, |df| df.p, |s| in_phase(s, 0.0), true),
        hypotheses: &[Hypothesis { id: "switches-both-ways", counterexample: None }],
        depends: &["kernel-sign", "describing-function"],
    }
}

fn in_phase(s: &Switching, bias: f64) -> f64 {
    let root = |distance: f64| (1.0 - (distance / s.amplitude).powi(2)).sqrt();
    2.0 * s.level / (PI * s.amplitude) * (root(s.half_width - bias) + root(s.half_width + bias))
}

claim! {
    RELAY_F0 = "relay-f0" "32" Identity
    "The mean output is C (t_high - t_low)/T = (C/pi) [asin((x_a + e_0)/X) - asin((x_a - e_0)/X)], plus the offset" {
        printed: Printed::Holds(|budget| mean_output(budget, 1.0).backed_by(proof::relay_f0)),
        corrected: None,
        // The times exchanged: the sign error that reading T_H as the time at command +C makes.
        falsified: |budget| mean_output(budget, -1.0),
        hypotheses: &[Hypothesis { id: "switches-both-ways", counterexample: None }],
        depends: &["kernel-sign", "describing-function"],
    }
}

fn mean_output(budget: Budget, sign: f64) -> Verdict {
    sample(budget, |draw| {
        let Some(s) = switching(draw) else { return Case::Skipped };
        let angle = |distance: f64| (distance / s.amplitude).asin();
        let (rising, falling) = (angle(s.half_width - s.bias), angle(s.half_width + s.bias));
        let by_angle = s.level / PI * (falling - rising) + s.offset;
        // High from the rising crossing to the falling one: as a share of one turn.
        let high = PI - rising + falling;
        let by_time = sign * bias_of_output(s.level, high, 2.0 * PI - high) + s.offset;
        let scale = s.level + s.offset.abs();
        draw.equal(("by_angle", by_angle), s.integral.f0, scale, tolerance::QUADRATURE).and(draw.equal(
            ("by_time", by_time),
            s.integral.f0,
            scale,
            tolerance::QUADRATURE,
        ))
    })
}

claim! {
    SECOND_QUADRANT = "second-quadrant" "section 4.1 (Goldfarb)" Statement
    "-G_N of the unbiased relay with hysteresis covers the second quadrant, and nothing else" {
        printed: Printed::Holds(|budget| covers(budget, 0.5 * PI, PI).backed_by(proof::second_quadrant)),
        corrected: None,
        falsified: |budget| covers(budget, 0.5 * PI, 1.25 * PI),
        hypotheses: &[],
        depends: &["relay-p", "relay-q"],
    }
}

/// Each point at an angle between the two is -G_N of some relay and amplitude, and each -G_N lies at such an angle.
fn covers(budget: Budget, from: f64, to: f64) -> Verdict {
    sample(budget, |draw| {
        let (angle, magnitude) = (draw.uniform("angle", from, to), draw.log_uniform("magnitude", 1e-3, 1e3));
        // -G_N = (4C/(pi X)) exp(j (pi - asin(x_a/X))): choose X = 1.
        let (half_width, level) = ((PI - angle).sin(), 0.25 * PI * magnitude);
        let gain = |level: f64, half_width: f64, amplitude: f64| {
            let sweep = Sinusoid::new(0.0, amplitude).ok()?;
            RelayHysteresis::new(level, half_width, 0.0).ok()?.describing_function(&sweep).ok()
        };
        let Some(reached) = gain(level, half_width, 1.0) else { return Case::truth(false) };
        let hit = (-reached.p - magnitude * angle.cos()).hypot(-reached.q - magnitude * angle.sin());
        let covered = draw.equal(("distance", hit), 0.0, magnitude, tolerance::ROUNDING);
        let (width, excess) = (draw.uniform("half_width", 0.0, 2.0), draw.uniform("excess", 0.0, 2.0));
        match gain(level, width, width + excess + 1e-9) {
            Some(any) => covered.and(Case::truth(-any.p <= 0.0 && -any.q >= 0.0)),
            None => Case::Skipped,
        }
    })
}

claim! {
    NOISE = "relay-noise" "section 4.1, in words" Statement
    "While the input moves one way, noise smaller than the half-width switches the relay at most once" {
        printed: Printed::Refuted(|budget| switches_once(budget, 0.0, 10.0)),
        corrected: Some(|budget| switches_once(budget, 0.0, 1.0)),
        falsified: |budget| switches_once(budget, 1.5, 2.0),
        hypotheses: &[
            Hypothesis { id: "noise-below-half-width", counterexample: Some(|budget| switches_once(budget, 1.5, 2.0)) },
        ],
        depends: &[],
    }
}

/// A slow ramp through both levels with noise between the given shares of the half-width: exactly one switching.
fn switches_once(budget: Budget, least: f64, most: f64) -> Verdict {
    sample(Budget { cases: budget.cases.min(200), ..budget }, |draw| {
        let half_width = draw.uniform("half_width", 0.1, 1.0);
        let noise = half_width * draw.uniform("noise_over_half_width", least, most);
        let Ok(relay) = RelayHysteresis::new(1.0, half_width, 0.0) else { return Case::Skipped };
        let mut relay = Relay::new(relay, false);
        let (mut switchings, mut high) = (0, false);
        for step in -500..=500 {
            let input = f64::from(step) / 500.0 * (half_width + noise + 0.1);
            let disturbed = input + noise * draw.unrecorded(-1.0, 1.0);
            let now = relay.step(disturbed) > 0.0;
            switchings += usize::from(now != high);
            high = now;
        }
        Case::truth(draw.note("switchings", switchings as f64) == 1.0)
    })
}

claim! {
    SWITCHING_CONDITION = "switching-condition" "40" Identity
    "Eq. 31 has a value, and the relay oscillates, exactly when (x_a + abs(x_0))/X <= 1" {
        printed: Printed::Holds(|budget| condition(budget, 1.0)),
        corrected: None,
        falsified: |budget| condition(budget, 1.1),
        hypotheses: &[],
        depends: &["relay-p"],
    }
}

fn condition(budget: Budget, limit: f64) -> Verdict {
    sample(budget, |draw| {
        let (half_width, bias) = (draw.uniform("half_width", 0.0, 2.0), draw.uniform("bias", -1.0, 1.0));
        let amplitude = draw.uniform("amplitude", 0.1, 4.0);
        let meets = (half_width + bias.abs()) / amplitude <= limit;
        let radicands = [half_width - bias, half_width + bias].map(|distance| 1.0 - (distance / amplitude).powi(2));
        let (Ok(relay), Ok(sweep)) = (RelayHysteresis::new(1.0, half_width, 0.0), Sinusoid::new(bias, amplitude))
        else {
            return Case::Skipped;
        };
        let real = radicands.iter().all(|radicand| *radicand >= 0.0);
        Case::truth(meets == real && meets == relay.describing_function(&sweep).is_ok())
    })
}

claim! {
    SAMPLED_LEVEL = "sampled-level" "section 4.3" Statement
    "A sampled relay switches at x_a or beyond, at most one sample's motion beyond" {
        printed: Printed::Holds(|budget| overshoot(budget, 0.0)),
        corrected: None,
        falsified: |budget| overshoot(budget, 0.01),
        hypotheses: &[],
        depends: &[],
    }
}

/// The level at which a sampled relay switches up on a sinusoid, against `x_a (1 + least)` and `x_a` plus one step.
fn overshoot(budget: Budget, least: f64) -> Verdict {
    sample(budget, |draw| {
        let (half_width, step) = (draw.uniform("half_width", 0.05, 0.95), draw.uniform("step_rad", 0.001, 0.5));
        let start = draw.uniform("phase_rad", -0.5 * PI, -0.5 * PI + step);
        let Ok(relay) = RelayHysteresis::new(1.0, half_width, 0.0) else { return Case::Skipped };
        let mut relay = Relay::new(relay, false);
        let mut angle = start;
        while angle < 0.5 * PI && relay.step(angle.sin()) < 0.0 {
            angle += step;
        }
        if angle >= 0.5 * PI {
            return Case::Skipped;
        }
        let level = draw.note("level", angle.sin());
        Case::margin(level - half_width * (1.0 + least)).and(Case::margin(half_width + step - level))
    })
}
