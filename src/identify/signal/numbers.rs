//! Extents of columns of numbers, and linear least squares.

use nalgebra::{DMatrix, DVector};

/// The least and the largest.
pub(super) fn ends(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// The largest less the least.
pub(crate) fn extent(values: &[f64]) -> f64 {
    let (low, high) = ends(values);
    high - low
}

/// The solution of least squares by QR; not a number where the equations are singular, which the callers take for no answer.
pub(crate) fn least_squares(matrix: DMatrix<f64>, mut right: DVector<f64>) -> DVector<f64> {
    let unknowns = matrix.ncols();
    let qr = matrix.qr();
    qr.q_tr_mul(&mut right);
    let solution = qr.unpack_r().solve_upper_triangular(&right.rows(0, unknowns));
    solution.unwrap_or_else(|| DVector::repeat(unknowns, f64::NAN))
}
