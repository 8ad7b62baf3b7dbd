//! Matrices of intervals: products by nalgebra, and here the operations with a proof of their own.

use nalgebra::DMatrix;
use num_traits::{One, Zero};

use crate::numeric::{Interval, Real};

impl Zero for Interval {
    fn zero() -> Self {
        Self::ZERO
    }
    fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }
}

impl One for Interval {
    fn one() -> Self {
        Self::ONE
    }
}

/// The largest row sum of magnitudes, rounded up: a norm under which a product is at most the product of the norms.
#[must_use]
pub fn norm(matrix: &DMatrix<Interval>) -> f64 {
    let sum = |row: usize| matrix.row(row).iter().fold(Interval::ZERO, |sum, entry| sum + entry.abs());
    (0..matrix.nrows()).map(|row| sum(row).upper()).fold(0.0, f64::max)
}

/// Encloses every solution of `matrix x = right`: elimination, the largest pivot first. `None` where a pivot may be zero, as
/// for a matrix that is singular or nearly so.
///
/// ```
/// use nalgebra::dmatrix;
/// use selfosc::{numeric::Interval, proof::interval_matrix::solve};
/// let (a, b) = (dmatrix![2.0, 1.0; 1.0, 3.0].map(Interval::point), dmatrix![3.0; 5.0].map(Interval::point));
/// assert!(solve(a, b).is_some_and(|x| x[0].contains(0.8) && x[1].contains(1.4)));
/// ```
#[must_use]
pub fn solve(mut matrix: DMatrix<Interval>, mut right: DMatrix<Interval>) -> Option<DMatrix<Interval>> {
    let size = matrix.nrows();
    let least =
        |entry: Interval| if entry.contains_zero() { 0.0 } else { entry.lower().abs().min(entry.upper().abs()) };
    for column in 0..size {
        let pivot = (column..size)
            .max_by(|&a, &b| least(matrix[(a, column)]).total_cmp(&least(matrix[(b, column)])))
            .filter(|&row| least(matrix[(row, column)]) > 0.0)?;
        matrix.swap_rows(column, pivot);
        right.swap_rows(column, pivot);
        let scale = Interval::ONE / matrix[(column, column)];
        for row in (0..size).filter(|&row| row != column) {
            let factor = matrix[(row, column)] * scale;
            for entry in column..size {
                matrix[(row, entry)] = matrix[(row, entry)] - factor * matrix[(column, entry)];
            }
            for entry in 0..right.ncols() {
                right[(row, entry)] = right[(row, entry)] - factor * right[(column, entry)];
            }
        }
    }
    Some(DMatrix::from_fn(size, right.ncols(), |row, column| right[(row, column)] / matrix[(row, row)]))
}
