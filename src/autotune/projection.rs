//! Variable projection (Golub and Pereyra, *SIAM J. Numer. Anal.* 10, 1973): at a dead time and time constants everything linear follows
//! by least squares, weighted for readings whose errors are correlated.

use nalgebra::{DMatrix, DVector, Vector3};

use super::Family;
use super::innovation_filter::InnovationFilter;
use super::response::{HeldCommand, StateSpace};

/// Order of an autoregression of the residuals.
const ORDER: usize = 2;
/// Least share of a unit column's square that a normal matrix needs beside the other columns: rounding takes less.
const RIDGE: f64 = 1e-12;

/// Readings and command.
#[derive(Clone)]
pub(super) struct ProjectionProblem {
    pub(super) command: HeldCommand,
    pub(super) output: Vec<f64>,
    /// First reading that counts: the command before the record is not known.
    pub(super) first: usize,
    /// Coefficients of `e_k = a_1 e_(k-1) + ... + noise` for errors that no load makes; none for those of a load that wanders.
    pub(super) autoregression: Vec<f64>,
    /// Least variance of a reading's white error, that of rounding.
    pub(super) rounding: f64,
}

/// Values of the searched parameters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SearchPoint {
    /// Dead time, then time constants.
    pub(super) times_s: Vec<f64>,
    /// Variance that the load gains in a second over the variance of a reading's white error, for a process of unit gain.
    pub(super) walk: f64,
}

/// The projection at a point.
pub(super) struct Projection {
    /// Sum of squares of the innovations, over their variances relative to that of a white error.
    pub(super) square: f64,
    /// The same without the answers to the command, at the same load.
    pub(super) undriven: f64,
    /// Mean logarithm of these variances.
    pub(super) log_variance: f64,
    /// Coefficients of the answers to the command, then of load and initial state.
    pub(super) linear: DVector<f64>,
    /// Innovations, output units.
    pub(super) innovations: Vec<f64>,
    /// Readings less the answer, load and initial state.
    pub(super) plain: DVector<f64>,
}

impl ProjectionProblem {
    fn space(family: Family, point: &SearchPoint) -> StateSpace {
        StateSpace::new(family, &point.times_s[1..])
    }

    /// Outputs that the command moves with a coefficient each: a zero adds the two lags with weights of their own.
    fn answers(family: Family, output: Vector3<f64>) -> Vec<Vector3<f64>> {
        if family == Family::SecondOrderZero { vec![Vector3::x(), Vector3::y()] } else { vec![output] }
    }

    /// Columns: answers to the command, then those to initial states and load.
    pub(super) fn columns(&self, family: Family, point: &SearchPoint) -> Vec<Vec<f64>> {
        let space = Self::space(family, point);
        let states = self.command.states(&space, point.times_s[0]);
        let answers = Self::answers(family, space.output())
            .into_iter()
            .map(|output| states.iter().map(|state| output.dot(state)).collect());
        let begins: &[Vector3<f64>] = match family {
            Family::FirstOrder | Family::Integrator => &[Vector3::x(), Vector3::z()],
            _ => &[Vector3::x(), Vector3::y(), Vector3::z()],
        };
        answers.chain(begins.iter().map(|begin| self.command.free(&space, *begin))).collect()
    }

    /// The filter for the errors at a point.
    pub(super) fn filter(&self, family: Family, point: &SearchPoint) -> InnovationFilter {
        let time_s = &self.command.time_s()[self.first..];
        if self.autoregression.is_empty() {
            InnovationFilter::of_load(&Self::space(family, point), time_s, point.walk)
        } else {
            InnovationFilter::of_autoregression(&self.autoregression, time_s.len())
        }
    }

    /// Innovations of series over their standard deviations, from the first reading that counts.
    pub(super) fn whitened<'a>(
        &self,
        filter: &InnovationFilter,
        series: impl IntoIterator<Item = &'a Vec<f64>>,
    ) -> Vec<DVector<f64>> {
        filter.whitened(&series.into_iter().map(|one| &one[self.first..]).collect::<Vec<_>>())
    }

    pub(super) fn projection(&self, family: Family, point: &SearchPoint) -> Option<Projection> {
        let (columns, filter, space) =
            (self.columns(family, point), self.filter(family, point), Self::space(family, point));
        let mut whitened = self.whitened(&filter, columns.iter().chain([&self.output]));
        let target = whitened.pop()?;
        let design = DMatrix::from_columns(&whitened);
        let (scaled, sizes) = unit_columns(&design);
        let found = scaled.clone().svd(true, true).solve(&target, 1e-10).ok()?;
        let square = (&target - &scaled * &found).norm_squared();
        let free = scaled.columns_range(Self::answers(family, space.output()).len()..).into_owned();
        let undriven = free.clone().svd(true, true).solve(&target, 1e-10).ok()?;
        let undriven = (&target - free * undriven).norm_squared();
        let linear = DVector::from_fn(found.len(), |j, _| found[j] / sizes[j]);
        let plain = DVector::from_fn(self.output.len() - self.first, |k, _| {
            let k = k + self.first;
            self.output[k] - columns.iter().zip(linear.iter()).map(|(column, a)| a * column[k]).sum::<f64>()
        });
        let innovations = filter.innovations(plain.as_slice()).collect();
        let log_variance = filter.log_variance;
        square.is_finite().then_some(Projection { square, undriven, log_variance, linear, innovations, plain })
    }

    /// Minus twice the log likelihood per innovation, up to a constant, at the likeliest variance of the white errors that is not below
    /// rounding's: `ln v + square/(n v) - 1` and the mean logarithm of the innovations' variances over `v`.
    pub(super) fn misfit(&self, square: f64, log_variance: f64) -> f64 {
        let mean = square / (self.output.len() - self.first) as f64;
        let variance = mean.max(self.rounding).max(f64::MIN_POSITIVE);
        libm::log(variance) + mean / variance - 1.0 + log_variance
    }

    /// The exponential of the misfit at a point, where it is a process: a variance that falls as the square does.
    pub(super) fn variance(&self, family: Family, point: &SearchPoint) -> f64 {
        let times_s = &point.times_s;
        let apart = family != Family::SecondOrder && family != Family::SecondOrderZero || times_s[2] < 0.9 * times_s[1];
        if times_s[0] < 0.0 || times_s[1..].iter().any(|time| !(*time > 0.0)) || !apart {
            return f64::INFINITY;
        }
        self.fast_variance(family, point)
    }

    /// The same by normal equations, for the search.
    fn fast_variance(&self, family: Family, point: &SearchPoint) -> f64 {
        let filter = self.filter(family, point);
        let mut columns = self.whitened(&filter, self.columns(family, point).iter().chain([&self.output]));
        let Some(target) = columns.pop() else { return f64::INFINITY };
        let count = columns.len();
        let sizes: Vec<f64> = columns.iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
        let normal = DMatrix::from_fn(count, count, |i, j| {
            if i == j { 1.0 + RIDGE } else { columns[i].dot(&columns[j]) / (sizes[i] * sizes[j]) }
        });
        let right = DVector::from_fn(count, |i, _| columns[i].dot(&target) / sizes[i]);
        let Some(solved) = normal.cholesky().map(|factor| factor.solve(&right)) else { return f64::INFINITY };
        libm::exp(self.misfit((target.norm_squared() - right.dot(&solved)).max(0.0), filter.log_variance))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Record;

    /// Minus twice the mean log density of normal errors of the likeliest variance, `ln v + mean/v - 1`, where that is not below rounding's.
    #[test]
    fn misfit_has_the_variance_of_rounding_at_least() {
        let time_s = (0..32).map(f64::from).collect();
        let input = (0..32).map(|k| f64::from(k / 4 % 2)).collect();
        let record = Record::new(time_s, vec![0.0; 32], input).unwrap();
        let (command, output) = (HeldCommand::of(&record), vec![0.0; 32]);
        let problem = ProjectionProblem { command, output, first: 28, autoregression: vec![], rounding: 0.25 };
        let close = |square: f64, expected: f64| (problem.misfit(square, 0.5) - 0.5 - expected).abs() < 1e-12;
        assert!(close(8.0, 2f64.ln()) && close(1.0, 0.25_f64.ln()));
        // Below rounding's the variance stays, and the mean square counts over it.
        assert!(close(0.4, 0.25_f64.ln() + 0.1 / 0.25 - 1.0) && close(0.0, 0.25_f64.ln() - 1.0));
    }
}
