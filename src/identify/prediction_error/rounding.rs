//! What rounding does to the estimates: the errors of readings of one motion belong together, as the motion says.
//!
//! Where two points of the motion differ by the part d of a step, their roundings correlate by `1 - 6 d + 6 d^2` over all places of
//! the grid, whose harmonics are `cos(2 pi h d) / h^2` (Bennett 1948; Sripad and Snyder 1977): roundings of a cycle that locks
//! to the sampling add up, and those of a motion that passes the steps evenly cancel.

use nalgebra::{DMatrix, DVector};

use super::filter::{self, Wanted};
use super::model::{Noise, Parameter};
use super::observations::Observations;
use super::scoring::Fitted;

/// Harmonics that are summed; the others count as white.
const HARMONICS: usize = 16;

/// By how much the deviation of each estimate differs from that under white errors. `None` where readings are not rounded, or the
/// model follows them by what is random in it.
pub(super) fn factors(fitted: &Fitted, observations: &Observations, free: &[usize]) -> Option<[f64; Parameter::COUNT]> {
    let step = observations.step?;
    let model = &fitted.model;
    let pass = filter::run(observations, model, Wanted::Slopes).filter(|pass| !pass.stochastic)?;
    let rounding = step * step / 12.0;
    let white = model.size(Noise::White).max(rounding);
    let beside = noise_beside(white, rounding, observations.count());
    let strength = |h: f64| {
        let turn = core::f64::consts::PI * h;
        step * step / (2.0 * turn * turn) * (-4.0 * turn * turn * beside / (step * step)).exp()
    };
    let n = free.len();
    let mut waves = DMatrix::zeros(n, 2 * HARMONICS);
    let (mut information, mut square) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    let samples = observations.output.iter().zip(&observations.weight).skip(observations.first);
    for (((output, weight), innovation), slopes) in samples.zip(&pass.innovations).zip(&pass.slopes) {
        if *weight == 0.0 {
            continue;
        }
        let slope = DVector::from_fn(n, |row, _| slopes[free[row]]);
        information.ger(*weight, &slope, &slope, 1.0);
        square.ger(weight * weight, &slope, &slope, 1.0);
        let (sin, cos) = (core::f64::consts::TAU * (output - innovation.error) / step).sin_cos();
        let (mut real, mut imaginary) = (1.0, 0.0);
        for h in 0..HARMONICS {
            (real, imaginary) = (real * cos - imaginary * sin, real * sin + imaginary * cos);
            waves.column_mut(2 * h).axpy(weight * real, &slope, 1.0);
            waves.column_mut(2 * h + 1).axpy(weight * imaginary, &slope, 1.0);
        }
    }
    let mut rest = white;
    let mut errors = DMatrix::zeros(n, n);
    for h in 0..HARMONICS {
        let strength = strength((h + 1) as f64);
        rest -= strength;
        for part in 0..2 {
            let wave = waves.column(2 * h + part);
            errors.ger(strength, &wave, &wave, 1.0);
        }
    }
    errors += rest * square;
    let inverse = information.cholesky()?.inverse();
    let covariance = &inverse * errors * &inverse;
    let mut factors = [1.0; Parameter::COUNT];
    for (place, index) in free.iter().enumerate() {
        factors[*index] = (covariance[(place, place)] / (model.size(Noise::White) * inverse[(place, place)])).sqrt();
    }
    Some(factors)
}

/// Variance of a noise before the rounding, as little as the readings leave possible: the variance of so many roundings varies.
fn noise_beside(white: f64, rounding: f64, count: f64) -> f64 {
    (white / (1.0 + 2.0 * (0.8 / count).sqrt()) - rounding).max(0.0)
}
