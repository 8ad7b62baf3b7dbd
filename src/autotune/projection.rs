//! Variable projection (Golub and Pereyra, *SIAM J. Numer. Anal.* 10, 1973): at a dead time and time constants everything linear follows
//! by least squares, weighted for readings whose errors are correlated.

use nalgebra::{DMatrix, DVector};

use super::Family;
use super::response::HeldCommand;

/// Order of the autoregression of the residuals: a load that wanders passes the process's lag and is smooth.
pub(super) const ORDER: usize = 2;
/// Least share of a unit column's square that a normal matrix needs beside the other columns: rounding takes less.
const RIDGE: f64 = 1e-12;

/// Readings and command, with the weights of the errors' autoregression.
pub(super) struct ProjectionProblem {
    pub(super) command: HeldCommand,
    pub(super) output: Vec<f64>,
    /// First reading that counts: the command before the record is not known.
    pub(super) first: usize,
    /// Coefficients of `e_k = a_1 e_(k-1) + ... + noise`.
    pub(super) autoregression: Vec<f64>,
}

/// Values of the searched parameters: dead time first, then time constants.
pub(super) type SearchPoint = Vec<f64>;

/// The projection at a point.
pub(super) struct Projection {
    /// Sum of squares of the whitened residuals.
    pub(super) square: f64,
    /// Coefficients of the answers to the command, then of load and initial state.
    pub(super) linear: DVector<f64>,
    /// Whitened residuals.
    pub(super) residual: DVector<f64>,
    /// Residuals as they are.
    pub(super) plain: DVector<f64>,
}

impl ProjectionProblem {
    /// Columns: answers to the command, then load, trend of an integrator, and modes of the initial state.
    pub(super) fn columns(&self, family: Family, point: &[f64]) -> Vec<Vec<f64>> {
        let (command, delay_s) = (&self.command, point[0]);
        let time = command.time_s();
        let constant = || vec![1.0; time.len()];
        let mode = |lag_s: f64| time.iter().map(|t| libm::exp(-t / lag_s)).collect::<Vec<_>>();
        let late_mode = |lag_s: f64| time.iter().map(|t| t / lag_s * libm::exp(-t / lag_s)).collect::<Vec<_>>();
        match family {
            Family::FirstOrder => vec![command.lagged(delay_s, point[1]), constant(), mode(point[1])],
            Family::SecondOrder => {
                let (slow, fast) = (point[1], point[2]);
                let parts = [command.lagged(delay_s, slow), command.lagged(delay_s, fast)];
                // 1/((a s + 1)(b s + 1)) = (a/(a s + 1) - b/(b s + 1))/(a - b).
                let answer =
                    parts[0].iter().zip(&parts[1]).map(|(x, y)| (slow * x - fast * y) / (slow - fast)).collect();
                vec![answer, constant(), mode(slow), mode(fast)]
            }
            Family::SecondOrderZero => {
                let (slow, fast) = (point[1], point[2]);
                let [slow_part, fast_part] = [slow, fast].map(|lag_s| command.lagged(delay_s, lag_s));
                vec![slow_part, fast_part, constant(), mode(slow), mode(fast)]
            }
            Family::EqualLags => {
                vec![command.lagged_twice(delay_s, point[1]), constant(), mode(point[1]), late_mode(point[1])]
            }
            Family::Integrator => vec![command.integrated(delay_s), constant(), time.to_vec()],
            Family::IntegratorLag => {
                let parts = [command.integrated(delay_s), command.lagged(delay_s, point[1])];
                // 1/(s (a s + 1)) = 1/s - a/(a s + 1).
                let answer = parts[0].iter().zip(&parts[1]).map(|(x, y)| x - point[1] * y).collect();
                vec![answer, constant(), time.to_vec(), mode(point[1])]
            }
        }
    }

    /// Innovations of a series: its values less their prediction from the values before.
    pub(super) fn whitened(&self, series: &[f64]) -> Vec<f64> {
        (self.first..series.len())
            .map(|k| {
                let before = self.autoregression.iter().enumerate().map(|(lag, a)| a * series[k - lag - 1]);
                series[k] - before.sum::<f64>()
            })
            .collect()
    }

    pub(super) fn projection(&self, family: Family, point: &[f64]) -> Option<Projection> {
        let columns = self.columns(family, point);
        let whitened: Vec<DVector<f64>> = columns.iter().map(|column| DVector::from(self.whitened(column))).collect();
        let design = DMatrix::from_columns(&whitened);
        let target = DVector::from(self.whitened(&self.output));
        let (scaled, sizes) = unit_columns(&design);
        let found = scaled.clone().svd(true, true).solve(&target, 1e-10).ok()?;
        let residual = &target - scaled * &found;
        let linear = DVector::from_fn(found.len(), |j, _| found[j] / sizes[j]);
        let plain = DVector::from_fn(self.output.len() - self.first, |k, _| {
            let k = k + self.first;
            self.output[k] - columns.iter().zip(linear.iter()).map(|(column, a)| a * column[k]).sum::<f64>()
        });
        let square = residual.norm_squared();
        square.is_finite().then_some(Projection { square, linear, residual, plain })
    }

    /// The square at a point, where it is a process.
    pub(super) fn square(&self, family: Family, point: &[f64]) -> f64 {
        let apart = family != Family::SecondOrder && family != Family::SecondOrderZero || point[2] < 0.9 * point[1];
        if point[0] < 0.0 || point[1..].iter().any(|time| !(*time > 0.0)) || !apart {
            return f64::INFINITY;
        }
        self.fast_square(family, point)
    }

    /// The same by normal equations, for the search.
    fn fast_square(&self, family: Family, point: &[f64]) -> f64 {
        let columns: Vec<Vec<f64>> = self.columns(family, point).iter().map(|column| self.whitened(column)).collect();
        let target = self.whitened(&self.output);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let count = columns.len();
        let sizes: Vec<f64> = columns.iter().map(|c| dot(c, c).sqrt().max(f64::MIN_POSITIVE)).collect();
        let normal = DMatrix::from_fn(count, count, |i, j| {
            if i == j { 1.0 + RIDGE } else { dot(&columns[i], &columns[j]) / (sizes[i] * sizes[j]) }
        });
        let right = DVector::from_fn(count, |i, _| dot(&columns[i], &target) / sizes[i]);
        let Some(solved) = normal.cholesky().map(|factor| factor.solve(&right)) else { return f64::INFINITY };
        (dot(&target, &target) - right.dot(&solved)).max(0.0)
    }
}

/// A design with columns of unit norm, so that its rank does not depend on units, and the norms.
pub(super) fn unit_columns(design: &DMatrix<f64>) -> (DMatrix<f64>, Vec<f64>) {
    let sizes: Vec<f64> = design.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
    let scaled = DMatrix::from_fn(design.nrows(), design.ncols(), |i, j| design[(i, j)] / sizes[j]);
    (scaled, sizes)
}

/// Coefficients of an autoregression by least squares (the covariance method); none where the errors are as good as white.
pub(super) fn autoregression(errors: &DVector<f64>) -> Vec<f64> {
    let count = errors.len() - ORDER;
    let design = DMatrix::from_fn(count, ORDER, |i, j| errors[i + ORDER - 1 - j]);
    let target = DVector::from_fn(count, |i, _| errors[i + ORDER]);
    let normal = design.transpose() * &design;
    let Some(found) = normal.cholesky().map(|factor| factor.solve(&(design.transpose() * &target))) else {
        return vec![];
    };
    let left = (&target - design * &found).norm_squared() / target.norm_squared().max(f64::MIN_POSITIVE);
    // The Bayesian criterion for two coefficients.
    if count as f64 * libm::log(left) + ORDER as f64 * libm::log(count as f64) < 0.0 {
        found.iter().copied().collect()
    } else {
        vec![]
    }
}
