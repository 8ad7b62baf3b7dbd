//! Small linear algebra in any arithmetic.

use crate::scalar::Scalar;

/// Rows of equal length.
pub type Matrix<S> = Vec<Vec<S>>;

/// Scalar product.
pub fn dot<S: Scalar>(left: &[S], right: &[S]) -> S {
    left.iter().zip(right).fold(S::ZERO, |sum, (&a, &b)| sum + a * b)
}

/// Product of square matrices.
#[must_use]
pub fn product<S: Scalar>(left: &Matrix<S>, right: &Matrix<S>) -> Matrix<S> {
    let columns = right.first().map_or(0, Vec::len);
    let column = |j: usize| right.iter().map(|row| row[j]).collect::<Vec<_>>();
    let columns: Vec<_> = (0..columns).map(column).collect();
    left.iter().map(|row| columns.iter().map(|column| dot(row, column)).collect()).collect()
}

/// The solution of a square system by elimination with scaled partial pivoting; `None` where a pivot vanishes.
#[must_use]
pub fn solve<S: Scalar>(mut matrix: Matrix<S>, mut right: Vec<S>) -> Option<Vec<S>> {
    let n = right.len();
    for (row, value) in matrix.iter_mut().zip(&mut right) {
        let largest = row.iter().fold(S::ZERO, |most, &entry| if entry.abs() > most { entry.abs() } else { most });
        if !(largest > S::ZERO) {
            return None;
        }
        row.iter_mut().for_each(|entry| *entry = *entry / largest);
        *value = *value / largest;
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| {
            matrix[i][k].abs().partial_cmp(&matrix[j][k].abs()).unwrap_or(std::cmp::Ordering::Equal)
        })?;
        if !(matrix[pivot][k].abs() > S::ZERO) {
            return None;
        }
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let (above, below) = matrix.split_at_mut(k + 1);
        let (pivot_row, pivot_right) = (&above[k], right[k]);
        for (row, value) in below.iter_mut().zip(&mut right[k + 1..]) {
            let factor = row[k] / pivot_row[k];
            for (entry, &upper) in row[k + 1..].iter_mut().zip(&pivot_row[k + 1..]) {
                *entry = *entry - factor * upper;
            }
            *value = *value - factor * pivot_right;
        }
    }
    for k in (0..n).rev() {
        let known = dot(&matrix[k][k + 1..], &right[k + 1..]);
        right[k] = (right[k] - known) / matrix[k][k];
    }
    Some(right)
}

/// Least-squares solution of an overdetermined system by modified Gram-Schmidt; `None` where the columns are dependent.
#[must_use]
pub fn least_squares<S: Scalar>(rows: &Matrix<S>, right: &[S]) -> Option<Vec<S>> {
    let n = rows.first()?.len();
    let mut basis: Vec<Vec<S>> = (0..n).map(|j| rows.iter().map(|row| row[j]).collect()).collect();
    let mut upper = vec![vec![S::ZERO; n]; n];
    let mut rest = right.to_vec();
    let mut projection = Vec::with_capacity(n);
    for j in 0..n {
        let (left, others) = basis.split_at_mut(j + 1);
        let column = &left[j];
        let square = dot(column, column);
        if !(square > S::ZERO) {
            return None;
        }
        upper[j][j] = S::ONE;
        for (k, other) in others.iter_mut().enumerate() {
            let share = dot(column, other) / square;
            upper[j][j + 1 + k] = share;
            other.iter_mut().zip(column).for_each(|(entry, &one)| *entry = *entry - share * one);
        }
        let share = dot(column, &rest) / square;
        projection.push(share);
        rest.iter_mut().zip(column).for_each(|(entry, &one)| *entry = *entry - share * one);
    }
    solve(upper, projection)
}

/// Spectral radius by Gelfand's formula, `lim norm(M^k)^(1/k)`, with k = 2^40 by repeated squaring.
///
/// The norm of `M^k` exceeds `radius^k` by a factor polynomial in k at most, so the formula is right to about 40 n ln 2/2^40.
#[must_use]
pub fn spectral_radius<S: Scalar>(matrix: &Matrix<S>) -> f64 {
    const SQUARINGS: i32 = 40;
    let mut power = matrix.clone();
    let mut logarithm = 0.0;
    for step in 0..=SQUARINGS {
        let norm =
            power.iter().flatten().fold(S::ZERO, |most, &entry| if entry.abs() > most { entry.abs() } else { most });
        if !(norm > S::ZERO) {
            return 0.0;
        }
        logarithm += norm.to_f64().ln() * f64::powi(2.0, -step);
        power.iter_mut().flatten().for_each(|entry| *entry = *entry / norm);
        power = product(&power, &power);
    }
    logarithm.exp()
}

#[cfg(test)]
mod tests {
    use f256::f256;

    use super::*;

    #[test]
    fn systems_with_known_solutions() {
        let hilbert = |i: usize, j: usize| f256::ONE / f256::from_count(i + j + 1);
        let matrix: Matrix<f256> = (0..8).map(|i| (0..8).map(|j| hilbert(i, j)).collect()).collect();
        let right = matrix.iter().map(|row| dot(row, &[f256::ONE; 8])).collect::<Vec<_>>();
        for solution in [solve(matrix.clone(), right.clone()).unwrap(), least_squares(&matrix, &right).unwrap()] {
            assert!(solution.iter().all(|&x| (x - f256::ONE).to_f64().abs() < 1e-45));
        }
        assert!(solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 1.0]).is_none());
    }

    #[test]
    fn spectral_radii_of_jordan_blocks_rotations_and_nilpotents() {
        let block = vec![vec![0.9, 1.0, 0.0], vec![0.0, 0.9, 1.0], vec![0.0, 0.0, 0.9]];
        assert!((spectral_radius(&block) - 0.9).abs() < 1e-9);
        assert!((spectral_radius(&vec![vec![0.6, -0.8], vec![0.8, 0.6]]) - 1.0).abs() < 1e-9);
        assert_eq!(spectral_radius(&vec![vec![0.0, 1.0], vec![0.0, 0.0]]), 0.0);
    }
}
