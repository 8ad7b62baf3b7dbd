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

/// Terms of the exponential series; with a norm of at most 1/2 the remainder is below `0.5^19/19! = 2e-23`.
const TERMS: u32 = 18;

/// The largest row sum of magnitudes, rounded up: a norm under which a product is at most the product of the norms.
#[must_use]
pub fn norm(matrix: &DMatrix<Interval>) -> f64 {
    let sum = |row: usize| matrix.row(row).iter().fold(Interval::ZERO, |sum, entry| sum + entry.abs());
    (0..matrix.nrows()).map(|row| sum(row).upper()).fold(0.0, f64::max)
}

/// Encloses the exponential of every matrix in `matrix`, which is square: the series of a part, with its remainder, squared
/// until it is the whole. `None` where the norm is not finite or exceeds `2^40`.
///
/// ```
/// use nalgebra::dmatrix;
/// use selfosc::{numeric::Interval, proof::interval_matrix::exponential};
/// let turn = dmatrix![0.0, -1.0; 1.0, 0.0].map(Interval::point);
/// let Some(rotation) = exponential(&turn) else { panic!("not enclosed") };
/// assert!(rotation[(1, 0)].contains(1f64.sin()) && rotation[(1, 0)].width() < 1e-14);
/// ```
#[must_use]
pub fn exponential(matrix: &DMatrix<Interval>) -> Option<DMatrix<Interval>> {
    let whole = norm(matrix);
    let squarings = (0..=40).find(|&k| whole <= 0.5 * 2f64.powi(k))?;
    let part = matrix * Interval::point(0.5f64.powi(squarings));
    let size = matrix.nrows();
    let (mut term, mut sum) = (DMatrix::identity(size, size), DMatrix::identity(size, size));
    for k in 1..=TERMS {
        term = &term * &part * (Interval::ONE / Interval::point(f64::from(k)));
        sum += &term;
    }
    // At most the next term times a geometric series of ratio 1/40; twice it, and TERMS for TERMS + 1, leave room for rounding.
    let rest = 2.0 * norm(&(&term * &part)) / f64::from(TERMS);
    sum += DMatrix::from_element(size, size, Interval::symmetric(rest));
    for _ in 0..squarings {
        sum = &sum * &sum;
    }
    Some(sum)
}

/// The lowest power of two, at most `2^squarings`, to which every matrix in `matrix` shrinks every vector in the norm of the largest
/// component; `None` where none is shown to.
///
/// ```
/// use nalgebra::dmatrix;
/// use selfosc::{numeric::Interval, proof::interval_matrix::contraction};
/// assert_eq!(contraction(&dmatrix![0.9, 1.0; 0.0, 0.9].map(Interval::point), 12), Some(64));
/// assert_eq!(contraction(&dmatrix![1.0, 0.0; 0.0, 0.9].map(Interval::point), 12), None);
/// ```
#[must_use]
pub fn contraction(matrix: &DMatrix<Interval>, squarings: u32) -> Option<u32> {
    let mut power = matrix.clone();
    for squaring in 0..=squarings {
        if norm(&power) < 1.0 {
            return Some(1 << squaring);
        }
        power = &power * &power;
    }
    None
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
