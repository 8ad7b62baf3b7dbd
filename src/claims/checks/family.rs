//! Families of characteristics that claims draw from.

use super::{Case, Draw, tolerance};
use crate::describing::{Boxed, ClosedForm, DescribingFunction, by_quadrature};
use crate::nonlinearity::{
    Backlash, Branch, Characteristic, Custom, DeadZone, NonlinearityError, Preload, Quantizer, Relay, RelayDeadZone,
    RelayDeadZoneHysteresis, RelayHysteresis, Saturation, SaturationAsymmetric, Sinusoid,
};
use crate::orbit::{LimitCycle, limit_cycle};
use crate::plant::DragAxis;

/// Odd, nondecreasing, without memory: the hypothesis of the corrected lemma 1 (but for vanishing on the sweep).
pub(super) fn odd_nondecreasing(draw: &mut Draw) -> Result<Boxed<f64>, NonlinearityError> {
    let (a, b) = (draw.uniform("a", 0.1, 3.0), draw.uniform("b", 0.1, 2.0));
    Ok(match draw.index("family", 6) {
        0 => Box::new(Relay::new(a)?),
        1 => Box::new(Saturation::new(a, b)?),
        2 => Box::new(DeadZone::new(a, b)?),
        3 => Box::new(RelayDeadZone::new(a, b)?),
        4 => Box::new(Preload::new(a, b)?),
        _ => Box::new(Quantizer::new(b)?),
    })
}

/// Odd with memory: the rising branch is the falling branch turned about the origin.
pub(super) fn odd_hysteretic(draw: &mut Draw) -> Result<Boxed<f64>, NonlinearityError> {
    let (a, b) = (draw.uniform("a", 0.1, 3.0), draw.uniform("b", 0.1, 2.0));
    Ok(match draw.index("family", 3) {
        0 => Box::new(RelayHysteresis::new(a, b, 0.0)?),
        1 => Box::new(RelayDeadZoneHysteresis::new(a, b, 0.5 * b)?),
        _ => Box::new(Backlash::new(a, b)?),
    })
}

/// Not odd: excluded by Theorem 1 and the lemmas.
pub(super) fn not_odd(draw: &mut Draw) -> Result<Boxed<f64>, NonlinearityError> {
    let (a, b) = (draw.uniform("a", 0.1, 3.0), draw.uniform("b", 0.1, 2.0));
    Ok(match draw.index("family", 2) {
        0 => Box::new(RelayHysteresis::new(a, b, 0.3 * a)?),
        _ => Box::new(SaturationAsymmetric::new(a, -0.5 * b, b)?),
    })
}

/// A biased sinusoid of moderate size.
pub(super) fn sweep(draw: &mut Draw) -> Result<Sinusoid<f64>, NonlinearityError> {
    Sinusoid::new(draw.uniform("bias", -2.0, 2.0), draw.uniform("amplitude", 0.1, 5.0))
}

/// An unbiased sinusoid of moderate size.
pub(super) fn unbiased(draw: &mut Draw) -> Result<Sinusoid<f64>, NonlinearityError> {
    Sinusoid::new(0.0, draw.uniform("amplitude", 0.1, 5.0))
}

/// Largest magnitude of the output at the ends and in the middle of the sweep: the scale of its Fourier coefficients.
pub(super) fn output_scale(
    characteristic: &(impl Characteristic<Number = f64> + ?Sized),
    sweep: &Sinusoid<f64>,
) -> f64 {
    let at = |x| characteristic.output(x, Branch::Rising, sweep).abs();
    at(sweep.minimum()).max(at(sweep.maximum())).max(at(sweep.bias()))
}

/// Mean and first harmonic of the output in closed form, times `factor`, against quadrature.
pub(super) fn closed_is_integral(
    draw: &mut Draw,
    characteristic: &(impl ClosedForm<Number = f64> + ?Sized),
    sweep: &Sinusoid<f64>,
    scale: f64,
    factor: f64,
) -> Option<Case> {
    let closed = characteristic.describing_function(sweep).ok()? * factor;
    let (integral, amplitude) = (by_quadrature(characteristic, sweep).ok()?, sweep.amplitude());
    let equations = [
        ("f0", closed.f0, integral.f0, scale),
        ("y_p1", closed.p * amplitude, integral.p * amplitude, scale),
        ("y_q1", closed.q * amplitude, integral.q * amplitude, scale),
    ];
    Some(draw.equations(equations, tolerance::QUADRATURE))
}

/// The limit cycle of an axis with linear and quadratic drag, a disturbance and a delay under a relay of a level and a half-width.
pub(super) fn cycle(
    alpha: f64,
    [linear, quadratic]: [f64; 2],
    disturbance: f64,
    delay_s: f64,
    [level, half_width]: [f64; 2],
) -> Option<LimitCycle<f64>> {
    let axis = DragAxis::mixed(alpha, linear, quadratic).ok()?.with_disturbance(disturbance).ok()?;
    limit_cycle(&axis.with_delay_s(delay_s).ok()?, &RelayHysteresis::new(level, half_width, 0.0).ok()?).ok()
}

/// Mean output of a function without memory and without kinks.
pub(super) fn mean_of(function: fn(f64) -> f64, bias: f64, amplitude: f64) -> f64 {
    let smooth = Custom::new(|x: f64, _| function(x), &[]);
    let df: Result<DescribingFunction<f64>, _> =
        Sinusoid::new(bias, amplitude).map_err(Into::into).and_then(|sweep| by_quadrature(&smooth, &sweep));
    df.map_or(f64::NAN, |df| df.f0)
}
