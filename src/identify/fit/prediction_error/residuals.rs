//! Tests of a model's residuals: do the halves of the record agree.

use super::model::Parameter;
use super::observations::Observations;
use super::scoring::{self, Fitted};
use crate::identify::answer::distribution::chi_square_tail;

/// Below this probability the halves disagree.
pub(super) const DISAGREE: f64 = 1e-4;

/// Probability, by chance, of a difference of the two halves' scores at least as large, and half the difference of the inertias that they want: a
/// score test of constant parameters (Nyblom 1989 with a given instant). One if a half does not determine the parameters.
pub(super) fn halves(fitted: &Fitted, observations: &Observations) -> (f64, f64) {
    compared(fitted, observations).unwrap_or((1.0, 0.0))
}

fn compared(fitted: &Fitted, observations: &Observations) -> Option<(f64, f64)> {
    let free: Vec<usize> = scoring::movable(&fitted.model, &fitted.score, observations)
        .into_iter()
        .filter(|index| *index != Parameter::Position as usize && *index != Parameter::Velocity as usize)
        .collect();
    let n = free.len();
    let sum = |from: usize, to: usize| {
        let mut gradient = nalgebra::DVector::zeros(n);
        let mut information = nalgebra::DMatrix::zeros(n, n);
        for part in &fitted.pass.parts[from..to] {
            for (row, i) in free.iter().enumerate() {
                gradient[row] += part.structure[*i];
                for (column, j) in free.iter().enumerate() {
                    information[(row, column)] += part.structure_information[*i][*j];
                }
            }
        }
        (gradient, information)
    };
    let parts = fitted.pass.parts.len();
    let (first, i1) = sum(0, parts / 2);
    let (second, i2) = sum(parts / 2, parts);
    // Where the first half's estimate would go, less where the second's would; the variances add up.
    let (c1, c2) = (i1.cholesky()?, i2.cholesky()?);
    let apart = c1.solve(&first) - c2.solve(&second);
    let covariance = c1.inverse() + c2.inverse();
    let statistic = apart.dot(&covariance.cholesky()?.solve(&apart));
    let inertia = free.iter().position(|index| *index == Parameter::Alpha as usize);
    Some((chi_square_tail(statistic, n), inertia.map_or(0.0, |index| 0.5 * apart[index].abs())))
}
