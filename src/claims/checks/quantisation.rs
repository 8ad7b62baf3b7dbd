//! What an error of the amplitude does to the parameters: eqs. 37-39.

use super::algebra::{exactly, number};
use super::enclosure::unknown;
use super::identification::oscillation;
use super::{
    AsPrinted, Budget, Case, ClaimPart, ClaimVariable, Distortion, Hypothesis, Verdict, claim, sample, tolerance,
};
use crate::identify::iso::{Oscillation, Parameters, amplitude_sensitivity};
use crate::numeric::{self, Real};
use crate::proof::polynomial::Rational;

/// Relative derivatives of (alpha, beta, beta_xx) by the relative amplitude, by first derivatives through the identification.
fn derivatives(o: &Oscillation<f64>) -> Option<[f64; 3]> {
    let constant = numeric::Gradient::<f64, 1>::from_f64;
    let dual = Oscillation {
        relay_level: constant(o.relay_level),
        switch_level: constant(o.switch_level),
        amplitude: numeric::Gradient::new(o.amplitude, [o.amplitude]),
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
const RATIO: ClaimPart = ClaimPart::over(
    "ratio",
    "no delay; the ratio of amplitude and half-width",
    const { &[ClaimVariable::number("X/x_a", 1.0, f64::INFINITY)] },
);

claim! {
    QUANTISATION_ALPHA = "quantisation-alpha" "37" Identity
    "dalpha/alpha = [(2 - r^2)/(r^2 - 1)] dX/X with r = X_m/x_a" {
        domain: &[RATIO],
        printed: AsPrinted::Holds(|budget| sensitivity(budget, 0, false, false, 1.0)),
        corrected: None,
        falsified: |budget| sensitivity(budget, 0, false, false, 1.001),
        proof: Some(prove_quantisation_alpha),
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
        domain: &[RATIO],
        printed: AsPrinted::Holds(|budget| sensitivity(budget, 1, true, false, 1.0)),
        corrected: None,
        falsified: |budget| sensitivity(budget, 1, true, false, 1.001),
        proof: Some(prove_quantisation_beta),
        hypotheses: &[Hypothesis { id: NO_DELAY, counterexample: Some(|budget| sensitivity(budget, 1, true, true, 1.0)) }],
        depends: &["table-3"],
    }
}

claim! {
    QUANTISATION_BETA_XX = "quantisation-beta-xx" "39" Identity
    "dbeta_xx/beta_xx = -3 dX/X" {
        domain: &[RATIO],
        printed: AsPrinted::Holds(|budget| sensitivity(budget, 2, true, false, 1.0)),
        corrected: None,
        falsified: |budget| sensitivity(budget, 2, true, false, 1.001),
        proof: Some(prove_quantisation_beta_xx),
        hypotheses: &[Hypothesis { id: NO_DELAY, counterexample: Some(|budget| sensitivity(budget, 2, true, true, 1.0)) }],
        depends: &["table-3"],
    }
}

claim! {
    QUANTISATION_ZERO = "quantisation-zero" "after 37" Theorem
    "At X_m = sqrt(2) x_a alpha is insensitive, to first order, to an error of the amplitude" {
        domain: &[
            ZERO,
            ClaimPart::over(
                "positive-below",
                "the slope is positive below",
                const { &[ClaimVariable::number("X/x_a", 1.0, core::f64::consts::SQRT_2)] },
            ),
            ClaimPart::over(
                "negative-above",
                "the slope is negative above",
                const { &[ClaimVariable::number("X/x_a", core::f64::consts::SQRT_2, f64::INFINITY)] },
            ),
        ],
        printed: AsPrinted::Absent,
        corrected: Some(|budget| {
            zero_at(budget, core::f64::consts::SQRT_2, false, false)
        }),
        falsified: |budget| zero_at(budget, 1.5, false, false),
        proof: Some(prove_quantisation_zero),
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

/// What is identified from an unbiased oscillation of that amplitude, half-width, level and angular frequency one.
fn identified<T: Real>(amplitude: T) -> Parameters<T> {
    let (one, zero) = (T::one(), T::zero());
    let period_s = T::two() * T::pi();
    Oscillation { relay_level: one, switch_level: one, amplitude, bias: zero, period_s, delay_s: zero }
        .identify()
        .unwrap_or(Parameters { alpha: unknown(), beta: unknown(), beta_quadratic: unknown(), disturbance: unknown() })
}

/// A formula with its derivative.
type Slope = numeric::Gradient<Rational, 1>;

/// `X dp/dX = sensitivity p` for one of the parameters, whatever the ratio: level with the middle half of the sweep, and beyond.
fn prove_sensitivity(
    distortion: Distortion,
    read: fn(Parameters<Slope>) -> Slope,
    printed: fn(Rational) -> Rational,
) -> Verdict {
    const COVERED: ClaimPart = ClaimPart::whole("ratio", "");
    exactly(COVERED, distortion, &[[3.0], [1.5]], |[amplitude], factor: Rational| {
        let [variable] = numeric::Gradient::variables([amplitude]);
        let parameter = read(identified(variable));
        Some([amplitude * parameter.slopes()[0] - factor * printed(amplitude) * parameter.value()])
    })
}

/// Eq. 37.
fn prove_quantisation_alpha(distortion: Distortion) -> Verdict {
    prove_sensitivity(distortion, |found| found.alpha, |r| amplitude_sensitivity(r).alpha)
}

/// Eq. 38.
fn prove_quantisation_beta(distortion: Distortion) -> Verdict {
    prove_sensitivity(distortion, |found| found.beta, |r| amplitude_sensitivity(r).beta)
}

/// Eq. 39.
fn prove_quantisation_beta_xx(distortion: Distortion) -> Verdict {
    prove_sensitivity(distortion, |found| found.beta_quadratic, |r| amplitude_sensitivity(r).beta_quadratic)
}

/// Where the slope of alpha vanishes, and on which side it has which sign.
const ZERO: ClaimPart = ClaimPart::whole("zero", "the slope vanishes at X/x_a = sqrt(2), unbiased, no delay");

/// The slope of alpha times `r (r^2 - 1)` is `(2 - r^2)` times alpha, whose square is that of a product of positive numbers.
fn prove_quantisation_zero(distortion: Distortion) -> Verdict {
    let slope = |ratio: Rational, factor: Rational| {
        let [amplitude] = numeric::Gradient::variables([ratio]);
        let alpha = identified(amplitude).alpha;
        let square = ratio.square();
        let (one, two) = (number(1.0), number(2.0));
        let size = number(16.0) * (square - one) / (Rational::pi() * square).square();
        Some([
            alpha.slopes()[0] * ratio * (square - one) - (two - factor * square) * alpha.value(),
            alpha.value().square() - size,
        ])
    };
    let at_root = |[]: [Rational; 0], factor: Rational| {
        let [amplitude] = numeric::Gradient::variables([factor * number(2.0).sqrt()]);
        Some([identified(amplitude).alpha.slopes()[0]])
    };
    let sign = |name, point: f64| {
        exactly(ClaimPart::whole(name, ""), distortion, &[[point]], |[ratio]: [Rational; 1], factor| {
            slope(ratio, factor)
        })
    };
    // Level with the middle half of the sweep only above twice the half-width.
    exactly(ZERO, distortion, &[[]], at_root)
        .and(|| sign("positive-below", 1.25))
        .and(|| sign("negative-above", 1.5))
        .and(|| sign("negative-above", 3.0))
}
