//! The state of the motion at a time, from the readings about it.

use nalgebra::{DMatrix, DVector};

use super::Signal;
use crate::plant::State;

/// The least and the largest.
pub(super) fn ends(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// The largest less the least.
pub(crate) fn extent(values: &[f64]) -> f64 {
    let (low, high) = ends(values);
    high - low
}

impl Signal {
    /// The state at a time, from the parabola of least squares through the readings within `reach_s`, four at least.
    pub(crate) fn state_near(&self, at_s: f64, reach_s: f64) -> State<f64> {
        let Self { time_s, output, .. } = self;
        let from = time_s.partition_point(|t| *t < at_s - reach_s).min(time_s.len() - 4);
        let to = time_s.partition_point(|t| *t <= at_s + reach_s).max(from + 4).min(time_s.len());
        let matrix =
            DMatrix::from_fn(to - from, 3, |row, power| ((time_s[from + row] - at_s) / reach_s).powi(power as i32));
        let solution = least_squares(matrix, DVector::from_fn(to - from, |row, _| output[from + row] - output[from]));
        let (offset, velocity) = (solution[0], solution[1] / reach_s);
        if offset.is_finite() && velocity.is_finite() {
            State { position: output[from] + offset, velocity }
        } else {
            State { position: output[from], velocity: 0.0 }
        }
    }
}

/// The solution of least squares by QR; not a number where the equations are singular, which the callers take for no answer.
pub(crate) fn least_squares(matrix: DMatrix<f64>, mut right: DVector<f64>) -> DVector<f64> {
    let unknowns = matrix.ncols();
    let qr = matrix.qr();
    qr.q_tr_mul(&mut right);
    let solution = qr.unpack_r().solve_upper_triangular(&right.rows(0, unknowns));
    solution.unwrap_or_else(|| DVector::repeat(unknowns, f64::NAN))
}
