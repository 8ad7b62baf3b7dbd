//! Effect of the sensor's step on the parameters: eqs. 37-39 as curves, and Fig. 14.

use super::table4::{PrintedTable, Yaw, means};
use crate::identify::iso::{AmplitudeSensitivity, amplitude_sensitivity};

/// The compass's step in degrees (section 5.1): the error of the amplitude that Fig. 14 assumes.
pub const COMPASS_STEP_DEG: f64 = 1.0;

/// Eqs. 37-39 at a given ratio of amplitude to switching level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// `X_m/x_a`.
    pub amplitude_ratio: f64,
    /// Percent of error per percent of amplitude error.
    pub sensitivity: AmplitudeSensitivity<f64>,
}

/// Eqs. 37-39 for ratios from just above 1, where eq. 37 has its pole, to 4; `X_m = sqrt(2) x_a`, its zero, is among them.
#[must_use]
pub fn curves() -> Vec<CurvePoint> {
    let (pole, zero, end, steps) = (1.05, core::f64::consts::SQRT_2, 4.0, 40);
    let segment = |from: f64, to: f64| (0..steps).map(move |i| from + (to - from) * f64::from(i) / f64::from(steps));
    let ratios = segment(pole, zero).chain(segment(zero, end)).chain([end]);
    ratios
        .map(|amplitude_ratio| CurvePoint { amplitude_ratio, sensitivity: amplitude_sensitivity(amplitude_ratio) })
        .collect()
}

/// An experiment in Fig. 14.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Error {
    /// Number of the experiment.
    pub experiment: u32,
    /// Relative difference of the printed parameter from the mean of all, in percent.
    pub percent: Yaw<f64>,
    /// Half-width of the bounds by quantisation, in percent: eqs. 37-39 with a compass step.
    pub bound_percent: Yaw<f64>,
}

/// Fig. 14: relative errors of the printed parameters, and their bounds by quantisation.
///
/// The bounds take the amplitude as the only quantity in error, an unbiased oscillation and no delay.
#[must_use]
pub fn figure14(table: &PrintedTable) -> Vec<Error> {
    let printed = table.printed();
    let mean = means(&printed);
    let rows = table.experiments().iter().zip(&printed);
    rows.map(|(row, parameters)| {
        let amplitude = row.amplitude.value();
        let sensitivity = amplitude_sensitivity(amplitude / row.switch_level.value());
        let bound = |sensitivity: f64| (sensitivity * COMPASS_STEP_DEG / amplitude * 100.0).abs();
        Error {
            experiment: row.number,
            percent: parameters.with(mean, |value, mean| (value / mean - 1.0) * 100.0),
            bound_percent: Yaw {
                alpha: bound(sensitivity.alpha),
                beta_r: bound(sensitivity.beta),
                beta_rr: bound(sensitivity.beta_quadratic),
            },
        }
    })
    .collect()
}
