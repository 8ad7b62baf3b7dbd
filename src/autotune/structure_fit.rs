//! The fit of a structure: parameters and coefficients with their intervals, and the evidence for the structure.

use nalgebra::{DMatrix, DVector};

use super::projection::{ProjectionProblem, SearchPoint, unit_columns};
use super::search::SETTLED;
use super::{Family, ProcessModel, Ranged};
use crate::identify::NORMAL_95;

/// Least eigenvalue of an information matrix of unit columns: below it stands rounding, and the readings tell nothing there.
const UNTOLD: f64 = 1e-12;

/// Gain, dead time and time constants of a structure, and the coefficients of its equation of motion.
fn meaning(family: Family, times_s: &[f64], linear: &[f64]) -> (Vec<f64>, [f64; 5]) {
    let (delay_s, lag) = (times_s[0], |k: usize| times_s.get(k).copied().unwrap_or(0.0));
    match family {
        Family::SecondOrderZero => {
            let gain = linear[0] + linear[1];
            // gain (zero s + 1) = c_1 (T_2 s + 1) + c_2 (T_1 s + 1).
            let zero_s = (linear[0] * lag(2) + linear[1] * lag(1)) / gain;
            let body = [lag(1) * lag(2), lag(1) + lag(2), 1.0].map(|part| part / gain.abs());
            (vec![gain, delay_s, lag(1), lag(2), zero_s], [body[0], body[1], body[2], zero_s, delay_s])
        }
        _ => {
            let gain = linear[0];
            let body = match family {
                Family::FirstOrder => [0.0, lag(1), 1.0],
                Family::EqualLags => [lag(1) * lag(1), 2.0 * lag(1), 1.0],
                Family::Integrator => [0.0, 1.0, 0.0],
                Family::IntegratorLag => [lag(1), 1.0, 0.0],
                Family::SecondOrder | Family::SecondOrderZero => [lag(1) * lag(2), lag(1) + lag(2), 1.0],
            };
            let body = body.map(|part| part / gain.abs());
            let parameters = [gain, delay_s].into_iter().chain(times_s[1..].iter().copied()).collect();
            (parameters, [body[0], body[1], body[2], 0.0, delay_s])
        }
    }
}

/// A fitted structure without its weight.
pub(super) struct StructureFit {
    pub(super) family: Family,
    pub(super) criterion: f64,
    /// Minus twice the largest log likelihood, up to a constant of the record.
    misfit: f64,
    pub(super) model: ProcessModel,
    pub(super) innovations: Vec<f64>,
    pub(super) plain: DVector<f64>,
    /// Share of the innovations' square that the answers to the command leave.
    pub(super) left: f64,
}

pub(super) fn fitted(
    problem: &ProjectionProblem,
    family: Family,
    point: &SearchPoint,
    interval_s: f64,
) -> Option<StructureFit> {
    let found = problem.projection(family, point)?;
    let (count, searched) = (found.innovations.len() as f64, point.times_s.len());
    let free = searched + found.linear.len();
    // Rounding leaves an error even where the residual shows none.
    let variance = (found.square / (count - free as f64).max(1.0)).max(problem.rounding);
    let misfit = count * problem.misfit(found.square, found.log_variance);
    // The Bayesian criterion at the unbiased variance, `square/(n - p)` for `square/n`.
    let criterion = misfit + count * libm::log(count / (count - free as f64).max(1.0)) + free as f64 * libm::log(count);
    // Sensitivities of the innovations to all parameters: differences over half an interval bridge the kinks.
    let columns = problem.columns(family, point);
    let filter = problem.filter(family, point);
    let linear: Vec<f64> = found.linear.iter().copied().collect();
    let answer = |times_s: Vec<f64>| -> DVector<f64> {
        let columns = problem.columns(family, &SearchPoint { times_s, walk: point.walk });
        let sum: Vec<f64> = (0..problem.output.len())
            .map(|k| columns.iter().zip(&linear).map(|(column, a)| a * column[k]).sum())
            .collect();
        problem.whitened(&filter, [&sum]).swap_remove(0)
    };
    let mut sensitivities: Vec<DVector<f64>> = Vec::new();
    let times_s = &point.times_s;
    let steps: Vec<f64> = (0..searched)
        .map(|k| if k == 0 { 0.5 * interval_s.min(times_s[0].max(interval_s)) } else { 1e-3 * times_s[k] })
        .collect();
    for k in 0..searched {
        let shifted = |sign: f64| {
            let mut other = times_s.clone();
            other[k] = (other[k] + sign * steps[k]).max(0.0);
            other
        };
        let (up, down) = (shifted(1.0), shifted(-1.0));
        let width = up[k] - down[k];
        sensitivities.push((answer(up) - answer(down)) / width);
    }
    sensitivities.extend(problem.whitened(&filter, &columns));
    let design = DMatrix::from_columns(&sensitivities);
    let (scaled, sizes) = unit_columns(&design);
    let information = scaled.transpose() * &scaled;
    // A direction that the readings do not tell has a wide error, as no pseudo-inverse gives it.
    let eigen = information.symmetric_eigen();
    let inverse = DMatrix::from_diagonal(&eigen.eigenvalues.map(|value| value.max(UNTOLD).recip()));
    let inverse = &eigen.eigenvectors * inverse * eigen.eigenvectors.transpose();
    let covariance = DMatrix::from_fn(free, free, |i, j| variance * inverse[(i, j)] / (sizes[i] * sizes[j]));
    // Both meanings are functions of all parameters: errors by their derivatives.
    let all: Vec<f64> = times_s.iter().chain(&linear).copied().collect();
    let meaning_of = |all: &[f64]| {
        let (parameters, coefficients) = meaning(family, &all[..searched], &all[searched..]);
        parameters.into_iter().chain(coefficients).collect::<Vec<f64>>()
    };
    let values = meaning_of(&all);
    let mut slopes = DMatrix::zeros(values.len(), free);
    for k in 0..free {
        let step = 1e-6 * all[k].abs().max(1e-9);
        let mut other = all.clone();
        other[k] += step;
        for (row, (moved, value)) in meaning_of(&other).iter().zip(&values).enumerate() {
            slopes[(row, k)] = (moved - value) / step;
        }
    }
    let spread = &slopes * covariance * slopes.transpose();
    let ranged = |k: usize| {
        let (value, std) = (values[k], spread[(k, k)].max(0.0).sqrt());
        Ranged { value, std, low: value - NORMAL_95 * std, high: value + NORMAL_95 * std }
    };
    let named = family.parameters().len();
    let model = ProcessModel {
        family,
        weight: 0.0,
        parameters: (0..named).map(ranged).collect(),
        coefficients: core::array::from_fn(|k| ranged(named + k)),
        covariance: core::array::from_fn(|i| core::array::from_fn(|j| spread[(named + i, named + j)])),
    };
    let finite = values.iter().chain(spread.iter()).all(|value| value.is_finite());
    let left = found.square / found.undriven.max(f64::MIN_POSITIVE);
    let (innovations, plain) = (found.innovations, found.plain);
    finite.then_some(StructureFit { family, criterion, misfit, model, innovations, plain, left })
}

/// Without structures that are a limit of theirs: they fit no better, their lag at its bound; or they are less likely, and their zero and
/// a lag cancel within their errors.
pub(super) fn distinct(mut fits: Vec<StructureFit>) -> Vec<StructureFit> {
    let found: Vec<(Family, f64, f64)> = fits.iter().map(|fit| (fit.family, fit.misfit, fit.criterion)).collect();
    fits.retain(|fit| {
        let limits = || found.iter().filter(|(family, ..)| fit.family.limits().contains(family));
        let better = limits().all(|(_, misfit, _)| misfit - fit.misfit > SETTLED);
        better && (!fit.cancels() || limits().all(|(.., criterion)| *criterion > fit.criterion))
    });
    fits
}

impl StructureFit {
    /// Whether the interval of the zero reaches that of a lag.
    fn cancels(&self) -> bool {
        let reaches = |a: &Ranged, b: &Ranged| a.low <= b.high && b.low <= a.high;
        match (self.family, &self.model.parameters[..]) {
            (Family::SecondOrderZero, [_, _, slow, fast, zero]) => reaches(slow, zero) || reaches(fast, zero),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A structure whose parameters are known to a tenth.
    fn fit(family: Family, criterion: f64, misfit: f64, parameters: &[f64]) -> StructureFit {
        let ranged = |value: &f64| Ranged { value: *value, std: 0.05, low: value - 0.1, high: value + 0.1 };
        let none = ranged(&0.0);
        let parameters = parameters.iter().map(ranged).collect();
        let model =
            ProcessModel { family, weight: 0.0, parameters, coefficients: [none; 5], covariance: [[0.0; 5]; 5] };
        let (innovations, plain) = (vec![], DVector::zeros(0));
        StructureFit { family, criterion, misfit, model, innovations, plain, left: 0.0 }
    }

    /// A zero that cancels a lag within their errors goes where a limit is likelier; so does what fits no better than a limit.
    #[test]
    fn structures_that_are_a_limit_of_theirs_go() {
        let stays = |criterion: f64, misfit: f64, [slow, fast, zero]: [f64; 3]| {
            let simple = fit(Family::FirstOrder, 10.0, 5.0, &[1.0, 1.0, 3.0]);
            let found =
                distinct(vec![simple, fit(Family::SecondOrderZero, criterion, misfit, &[1.0, 1.0, slow, fast, zero])]);
            assert_eq!(found[0].family, Family::FirstOrder);
            found.len() == 2
        };
        assert!(stays(12.0, 4.0, [3.0, 1.0, 2.0]), "apart");
        assert!(!stays(12.0, 4.0, [3.0, 1.0, 1.15]) && !stays(12.0, 4.0, [3.0, 1.0, 2.85]), "cancels");
        assert!(stays(9.0, 4.0, [3.0, 1.0, 1.15]), "likelier");
        assert!(!stays(12.0, 5.0, [3.0, 1.0, 2.0]), "fits no better");
    }
}
