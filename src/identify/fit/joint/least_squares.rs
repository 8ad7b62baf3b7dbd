//! Nonlinear least squares over parameters that are zero or more: Levenberg-Marquardt on the QR decomposition, bounds by an
//! active set.

use nalgebra::{DMatrix, DVector};

use crate::identify::answer::{AxisParameter, IdentifyError};

/// Number of common parameters.
const COUNT: usize = AxisParameter::COUNT;

/// Residuals with their derivatives, a row of the Jacobian each.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Linearised {
    pub(super) residuals: Vec<f64>,
    pub(super) jacobian: Vec<[f64; COUNT]>,
}

/// Where the search ended.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Minimum {
    pub(super) values: [f64; COUNT],
    /// Estimated, and not on the bound zero.
    pub(super) free: [bool; COUNT],
    pub(super) residuals: Vec<f64>,
    /// Zero in the rows and columns of fixed parameters.
    pub(super) covariance: [[f64; COUNT]; COUNT],
}

impl Minimum {
    /// Sum of squares over the degrees of freedom.
    pub(super) fn variance(&self) -> f64 {
        sum_of_squares(&self.residuals) / self.degrees_of_freedom() as f64
    }

    pub(super) fn degrees_of_freedom(&self) -> usize {
        self.residuals.len() - count(&self.free)
    }
}

/// Steps allowed; about ten are needed.
const MAX_STEPS: usize = 200;
/// Relative step at which the search ends.
const SETTLED: f64 = 1e-9;
/// Cosine of the angle between the residuals and what parameters can change, at which it ends: below the root of the rounding
/// the cost no longer falls.
const ANGLE: f64 = 1e-8;
/// Damping of the first step, in parts of the largest eigenvalue, and its factor after every step (Marquardt 1963).
const FIRST_DAMPING: f64 = 1e-3;
const DAMPING_FACTOR: f64 = 10.0;
/// Ratio of singular values below which two combinations of parameters are indistinguishable.
const RANK: f64 = 1e-9;

/// The minimum reached from `start`, all of whose `estimated` parameters are above zero: they are searched in units of it.
pub(super) fn minimise(
    start: [f64; COUNT],
    estimated: [bool; COUNT],
    evaluate: impl Fn(&[f64; COUNT]) -> Result<Linearised, IdentifyError>,
) -> Result<Minimum, IdentifyError> {
    let mut values = start;
    let mut here = evaluate(&values)?;
    let (equations, parameters) = (here.residuals.len(), count(&estimated));
    if equations <= parameters {
        return Err(IdentifyError::TooFewEquations { equations, parameters });
    }
    let mut damping = FIRST_DAMPING;
    for _ in 0..MAX_STEPS {
        let free = std::array::from_fn(|j| estimated[j] && (values[j] > 0.0 || here.slope(j) < 0.0));
        let system = here.decompose(&start, &free)?;
        let cost = sum_of_squares(&here.residuals);
        let step = system.step(damping);
        let next = std::array::from_fn(|j| (values[j] + step[j] * start[j]).max(0.0));
        let moved =
            (0..COUNT).map(|j| (next[j] - values[j]).abs() / start[j]).filter(|x| x.is_finite()).fold(0.0, f64::max);
        if moved <= SETTLED || system.reachable <= ANGLE * cost.sqrt() {
            let variance = cost / (equations - count(&free)) as f64;
            let covariance = system.covariance(variance, &start)?;
            return Ok(Minimum { values, free, residuals: here.residuals, covariance });
        }
        match evaluate(&next) {
            Ok(there) if sum_of_squares(&there.residuals) < cost => {
                (values, here) = (next, there);
                damping /= DAMPING_FACTOR;
            }
            _ => damping *= DAMPING_FACTOR,
        }
    }
    Err(IdentifyError::NotSettled {
        steps: MAX_STEPS,
        rms: (sum_of_squares(&here.residuals) / equations as f64).sqrt(),
    })
}

fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum()
}

fn count(flags: &[bool]) -> usize {
    flags.iter().filter(|&&flag| flag).count()
}

/// The free part of a Jacobian `J = Q R`, decomposed.
struct Decomposed {
    columns: Vec<usize>,
    triangle: DMatrix<f64>,
    /// The residuals turned, `Q^T r`.
    turned: DVector<f64>,
    /// Length of the part of the residuals that the parameters can change.
    reachable: f64,
}

impl Linearised {
    /// Half the derivative of the sum of squares.
    fn slope(&self, column: usize) -> f64 {
        self.residuals.iter().zip(&self.jacobian).map(|(residual, row)| residual * row[column]).sum()
    }

    fn decompose(&self, unit: &[f64; COUNT], free: &[bool; COUNT]) -> Result<Decomposed, IdentifyError> {
        let columns: Vec<usize> = (0..COUNT).filter(|&j| free[j]).collect();
        let qr = DMatrix::from_fn(self.residuals.len(), columns.len(), |i, j| {
            self.jacobian[i][columns[j]] * unit[columns[j]]
        })
        .qr();
        let mut turned = DVector::from_column_slice(&self.residuals);
        qr.q_tr_mul(&mut turned);
        turned.resize_vertically_mut(columns.len(), 0.0);
        let (triangle, reachable) = (qr.unpack_r(), turned.norm());
        if triangle.iter().any(|entry| !entry.is_finite()) || !reachable.is_finite() {
            return Err(IdentifyError::Confounded { ratio: f64::NAN });
        }
        Ok(Decomposed { columns, triangle, turned, reachable })
    }
}

/// Square of the largest singular value: the largest eigenvalue of `M^T M`, which rounding hardly touches.
fn largest_squared(matrix: &DMatrix<f64>) -> f64 {
    matrix.tr_mul(matrix).symmetric_eigenvalues().max()
}

impl Decomposed {
    /// The damped step, in the units of the search: least squares of `R s = -Q^T r` above `sqrt(damping) s = 0`.
    fn step(&self, damping: f64) -> [f64; COUNT] {
        let mut step = [0.0; COUNT];
        let count = self.columns.len();
        if count == 0 {
            return step;
        }
        let weight = (damping * largest_squared(&self.triangle)).sqrt();
        let mut stacked = self.triangle.clone().resize_vertically(2 * count, 0.0);
        stacked.view_mut((count, 0), (count, count)).fill_diagonal(weight);
        let mut right = (-&self.turned).resize_vertically(2 * count, 0.0);
        let qr = stacked.qr();
        qr.q_tr_mul(&mut right);
        if let Some(solution) = qr.unpack_r().solve_upper_triangular(&right.rows(0, count)) {
            for (&column, &value) in self.columns.iter().zip(&solution) {
                step[column] = value;
            }
        }
        step
    }

    fn covariance(&self, variance: f64, unit: &[f64; COUNT]) -> Result<[[f64; COUNT]; COUNT], IdentifyError> {
        let mut covariance = [[0.0; COUNT]; COUNT];
        let count = self.columns.len();
        if count == 0 {
            return Ok(covariance);
        }
        let inverse = self.triangle.solve_upper_triangular(&DMatrix::identity(count, count));
        let inverse = inverse.filter(|inverse| inverse.iter().all(|entry| entry.is_finite()));
        let Some(inverse) = inverse else { return Err(IdentifyError::Confounded { ratio: 0.0 }) };
        let ratio = (largest_squared(&self.triangle) * largest_squared(&inverse)).sqrt().recip();
        if ratio.is_nan() || ratio <= RANK {
            return Err(IdentifyError::Confounded { ratio });
        }
        let information = &inverse * inverse.transpose();
        for (i, &row) in self.columns.iter().enumerate() {
            for (j, &column) in self.columns.iter().enumerate() {
                covariance[row][column] = variance * information[(i, j)] * unit[row] * unit[column];
            }
        }
        Ok(covariance)
    }
}
