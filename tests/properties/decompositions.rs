//! What is decomposed by nalgebra, judged by faer.

use nalgebra::{Complex, DMatrix};
use proptest::prelude::*;
use selfosc::plant::{TransferFunction, eigenvalues};
use selfosc::vehicle::Allocation;

use crate::sampling::config;
use crate::tolerance::{DECOMPOSITION, SEPARATE_POLES};

fn judge(matrix: &DMatrix<f64>) -> faer::Mat<f64> {
    faer::Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
}

/// A chain of integrators has its poles at zero, and a numerator its zeros, to the last bit.
#[test]
fn poles_at_zero_are_exact() {
    let zero = Complex::new(0.0, 0.0);
    let count = |roots: Vec<Complex<f64>>| roots.iter().filter(|root| **root == zero).count();
    let plant = TransferFunction::new(&[1.0], &[1.0, 3.0, 2.0, 0.0, 0.0]).unwrap();
    assert_eq!((plant.poles().unwrap().len(), count(plant.poles().unwrap())), (4, 2));
    let washout = TransferFunction::new(&[2.0, 0.0], &[1.0, 3.0, 2.0]).unwrap();
    assert_eq!((count(washout.zeros().unwrap()), count(washout.poles().unwrap())), (1, 0));
}

/// Distance to the nearest matrix that has this eigenvalue, relative to the norm: the smallest singular value of `A - z I`,
/// written in real numbers. `None` where the judge's own iteration does not converge, once in some ten thousand.
fn backward_error(matrix: &DMatrix<f64>, z: Complex<f64>) -> Option<f64> {
    let n = matrix.nrows();
    let shifted = DMatrix::from_fn(2 * n, 2 * n, |i, j| {
        let entry = if i / n == j / n { matrix[(i % n, j % n)] } else { 0.0 };
        let shift = match (i % n == j % n, i / n, j / n) {
            (false, ..) => 0.0,
            (true, a, b) if a == b => z.re,
            (true, 0, _) => -z.im,
            _ => z.im,
        };
        entry - shift
    });
    let singular = judge(&shifted).singular_values().ok()?;
    Some(singular.into_iter().fold(f64::INFINITY, f64::min) / matrix.norm())
}

fn square() -> impl Strategy<Value = DMatrix<f64>> {
    (1..10_usize).prop_flat_map(|n| {
        prop::collection::vec(-1.0..1.0_f64, n * n).prop_map(move |entries| DMatrix::from_vec(n, n, entries))
    })
}

/// The pseudo-inverse by singular values, where rows or columns are far from dependent.
fn check_allocation<const AXES: usize, const THRUSTERS: usize>(entries: &[f64]) -> Result<(), TestCaseError> {
    let matrix: [[f64; THRUSTERS]; AXES] = std::array::from_fn(|i| std::array::from_fn(|j| entries[THRUSTERS * i + j]));
    let svd = faer::Mat::from_fn(AXES, THRUSTERS, |i, j| matrix[i][j]).svd();
    prop_assume!(svd.is_ok());
    let svd = svd.unwrap();
    let singular = svd.S().column_vector();
    let condition = singular[0] / singular[AXES.min(THRUSTERS) - 1];
    prop_assume!(condition < 100.0);
    let (expected, found) = (svd.pseudoinverse(), Allocation::from_matrix(matrix).unwrap());
    let largest = singular[AXES.min(THRUSTERS) - 1].recip();
    for i in 0..THRUSTERS {
        for j in 0..AXES {
            let error = (found.inverse()[i][j] - expected[(i, j)]).abs();
            prop_assert!(error <= DECOMPOSITION * condition * largest, "{matrix:?}: {error}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn an_allocation_has_the_inverse_by_singular_values(entries in prop::collection::vec(-1.0..1.0_f64, 48)) {
        check_allocation::<2, 2>(&entries)?;
        check_allocation::<3, 3>(&entries)?;
        check_allocation::<3, 4>(&entries)?;
        check_allocation::<4, 3>(&entries)?;
        check_allocation::<6, 8>(&entries)?;
    }

    #[test]
    fn eigenvalues_belong_to_a_matrix_next_to_the_given_one(matrix in square()) {
        let found = eigenvalues(&matrix).unwrap();
        prop_assert_eq!(found.len(), matrix.nrows());
        let sum: Complex<f64> = found.iter().sum();
        prop_assert!((sum - matrix.trace()).norm() <= DECOMPOSITION * matrix.norm() * found.len() as f64);
        for &value in &found {
            let Some(error) = backward_error(&matrix, value) else { continue };
            prop_assert!(error <= DECOMPOSITION, "{matrix} {value}");
        }
        // False variant: a number as far off as the matrix is large.
        let far = backward_error(&matrix, Complex::new(2.0 * matrix.norm(), 0.0));
        prop_assert!(far.is_none_or(|error| error > 0.5));
    }

    /// Real poles a factor of three or more apart, over many decades: the companion matrix must be balanced.
    #[test]
    fn poles_over_decades_keep_their_digits(gaps in prop::collection::vec(0.5..2.0_f64, 2..6), slowest in -3.0..1.0_f64) {
        let mut logarithm = slowest;
        let mut poles = vec![-10f64.powf(slowest)];
        for gap in gaps {
            logarithm += gap;
            poles.push(-10f64.powf(logarithm));
        }
        let denominator = poles.iter().fold(vec![1.0], |product: Vec<f64>, pole| {
            let shifted = std::iter::once(&0.0).chain(&product).map(|c| -pole * c);
            product.iter().chain([&0.0]).zip(shifted).map(|(c, s)| c + s).collect()
        });
        let mut found = TransferFunction::new(&[1.0], &denominator).unwrap().poles().unwrap();
        found.sort_by(|a, b| b.re.total_cmp(&a.re));
        for (found, pole) in found.iter().zip(&poles) {
            prop_assert!((found - pole).norm() <= SEPARATE_POLES * pole.abs(), "{found} {pole}");
        }
    }
}
