//! The effect of an error of the amplitude on the parameters: eqs. 37-39.

use super::algebra::{exactly, number, unknown};
use super::identification::oscillation;
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::identify::iso::{Oscillation, Parameters, amplitude_sensitivity};
use crate::numeric::{self, Real};
use crate::proof::polynomial::Rational;
use core::f64::consts::SQRT_2;

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
fn sensitivity(draw: &mut Draw, index: usize, biased: bool, delayed: bool, factor: f64) -> Option<Case> {
    let o = oscillation(draw, biased, delayed);
    let derivatives = derivatives(&o)?;
    let printed = amplitude_sensitivity(o.amplitude / o.switch_level);
    let printed = [printed.alpha, printed.beta, printed.beta_quadratic][index];
    Some(draw.equal(("printed", factor * printed), derivatives[index], 1.0 + printed.abs(), tolerance::CANCELLING))
}

/// Eqs. 37 to 39: the parameter, whether the oscillation may be biased, and the hypothesis in addition to no delay.
macro_rules! sensitivities {
    ($($constant:ident = $id:literal $statement:literal, $index:literal $field:ident, biased $biased:literal
       $(, without $hypothesis:literal)?;)+) => {
        $(
            claim! {
                $constant = $id Identity $statement;
                printed Holds sensitivity($index, $biased, false, 1.0);
                false sensitivity($index, $biased, false, 1.001);
                $(needs $hypothesis sensitivity($index, true, false, 1.0);)?
                needs "no-delay" sensitivity($index, $biased, true, 1.0);
                proof |distortion| {
                    prove_sensitivity(distortion, |found| found.$field, |ratio| amplitude_sensitivity(ratio).$field)
                };
            }
        )+
    };
}

sensitivities! {
    QUANTISATION_ALPHA = "quantisation-alpha" "dalpha/alpha = [(2 - r^2)/(r^2 - 1)] dX/X with r = X_m/x_a",
        0 alpha, biased false, without "unbiased";
    QUANTISATION_BETA = "quantisation-beta" "dbeta/beta = -2 dX/X", 1 beta, biased true;
    QUANTISATION_BETA_XX = "quantisation-beta-xx" "dbeta_xx/beta_xx = -3 dX/X", 2 beta_quadratic, biased true;
}

claim! {
    QUANTISATION_ZERO = "quantisation-zero" Theorem
    "At X_m = sqrt(2) x_a alpha is insensitive, to first order, to an error of the amplitude";
    corrected zero_at(SQRT_2, false, false);
    false zero_at(1.5, false, false);
    needs "unbiased" zero_at(SQRT_2, true, false);
    needs "no-delay" zero_at(SQRT_2, false, true);
    // Level with the middle half of the sweep only above twice the half-width.
    exactly
        at_root on "zero" at &[[]],
        slope on "positive-below" at &[[1.25]],
        slope on "negative-above" at &[[1.5], [3.0]];
}

/// The derivative of alpha vanishes at `ratio`, is positive below and negative above.
fn zero_at(draw: &mut Draw, ratio: f64, biased: bool, delayed: bool) -> Option<Case> {
    let base = oscillation(draw, biased, delayed);
    let slope = |ratio: f64| {
        let at = Oscillation { amplitude: ratio * base.switch_level, bias: 0.8 * (ratio - 1.0) * base.bias, ..base };
        derivatives(&at).map(|derivatives| derivatives[0])
    };
    let (here, below, above) = (slope(ratio)?, slope(0.99 * ratio)?, slope(1.01 * ratio)?);
    Some(draw.equal(("slope", here), 0.0, 1.0, tolerance::CANCELLING).and(Case::truth(below > 0.0 && above < 0.0)))
}

/// Parameters from an unbiased oscillation of that amplitude; half-width, level and angular frequency are 1.
fn identified<T: Real>(amplitude: T) -> Parameters<T> {
    let (one, zero) = (T::one(), T::zero());
    let period_s = T::two() * T::pi();
    Oscillation { relay_level: one, switch_level: one, amplitude, bias: zero, period_s, delay_s: zero }
        .identify()
        .unwrap_or(Parameters { alpha: unknown(), beta: unknown(), beta_quadratic: unknown(), disturbance: unknown() })
}

/// A formula with its derivative.
type Slope = numeric::Gradient<Rational, 1>;

/// `X dp/dX = sensitivity p` for a parameter at every ratio: level with the middle half of the sweep, and beyond.
fn prove_sensitivity(
    distortion: Distortion,
    read: fn(Parameters<Slope>) -> Slope,
    printed: fn(Rational) -> Rational,
) -> Verdict {
    const COVERED: ClaimPart = ClaimPart::named("ratio");
    exactly(COVERED, distortion, &[[3.0], [1.5]], |[amplitude], factor: Rational| {
        let [variable] = numeric::Gradient::variables([amplitude]);
        let parameter = read(identified(variable));
        Some([amplitude * parameter.slopes()[0] - factor * printed(amplitude) * parameter.value()])
    })
}

/// The slope of alpha times `r (r^2 - 1)` is `(2 - r^2)` times alpha, whose square is that of a product of positive numbers.
fn slope([ratio]: [Rational; 1], factor: Rational) -> Option<[Rational; 2]> {
    let [amplitude] = numeric::Gradient::variables([ratio]);
    let alpha = identified(amplitude).alpha;
    let square = ratio.square();
    let (one, two) = (number(1.0), number(2.0));
    let size = number(16.0) * (square - one) / (Rational::pi() * square).square();
    Some([
        alpha.slopes()[0] * ratio * (square - one) - (two - factor * square) * alpha.value(),
        alpha.value().square() - size,
    ])
}

fn at_root([]: [Rational; 0], factor: Rational) -> Option<[Rational; 1]> {
    let [amplitude] = numeric::Gradient::variables([factor * number(2.0).sqrt()]);
    Some([identified(amplitude).alpha.slopes()[0]])
}
