//! A pooled estimate from several records.

use crate::identify::answer::distribution::chi_square_tail;
use crate::identify::answer::{ConfidenceInterval, Estimate};

/// Below this probability records disagree.
pub(super) const DISAGREE: f64 = 0.01;

/// Numbers with their standard deviations, all above zero.
pub(super) type Measured = Vec<(f64, f64)>;

/// Mean of numbers weighted by their precision, with its standard deviation.
pub(super) fn mean(numbers: &Measured) -> (f64, f64) {
    let weight: f64 = numbers.iter().map(|(_, std)| std.powi(-2)).sum();
    (numbers.iter().map(|(value, std)| value * std.powi(-2)).sum::<f64>() / weight, weight.sqrt().recip())
}

/// Probability of more scatter if the numbers are equal; 1 for a single number.
pub(super) fn probability_of_one(numbers: &Measured) -> f64 {
    let (mean, _) = mean(numbers);
    let scatter: f64 = numbers.iter().map(|(value, std)| ((value - mean) / std).powi(2)).sum();
    if numbers.len() > 1 { chi_square_tail(scatter, numbers.len() - 1) } else { 1.0 }
}

/// Values with their standard deviations; `None` unless all have one.
pub(super) fn known(estimates: &[Estimate]) -> Option<Measured> {
    let one = |estimate: &Estimate| {
        let std = estimate.spread.map(ConfidenceInterval::deviation).filter(|std| *std > 0.0);
        std.map(|std| (estimate.value, std))
    };
    estimates.iter().map(one).collect()
}

/// Estimates of one number together, and the scatter between them beyond chance. Where they agree they are weighted by their
/// precision; where they do not, the interval holds every one's own.
#[allow(clippy::cast_precision_loss, reason = "a count of records")]
pub(super) fn pooled(estimates: &[Estimate]) -> (Estimate, Option<f64>) {
    let Some(numbers) = known(estimates) else {
        let first = estimates.iter().find(|estimate| estimate.spread.is_some()).unwrap_or(&estimates[0]);
        return (*first, None);
    };
    let (value, std) = mean(&numbers);
    if probability_of_one(&numbers) >= DISAGREE {
        return (Estimate::new(value, Some(ConfidenceInterval::normal(value, std))), None);
    }
    let count = numbers.len() as f64;
    let value = numbers.iter().map(|(value, _)| value).sum::<f64>() / count;
    let between = (numbers.iter().map(|(v, _)| (v - value).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
    let spread = ConfidenceInterval { std: libm::hypot(between, std), low: value, high: value };
    let held = Estimate::new(value, Some(spread)).holding(estimates);
    let spread = held.spread.map(|held| ConfidenceInterval { std: spread.std, ..held });
    (Estimate::new(value, spread), Some(between))
}

/// The weights that [`pooled`] gives each record's number, zero for a record without one. `None` where the numbers do not agree.
pub(super) fn weights(estimates: &[Option<Estimate>]) -> Option<Vec<f64>> {
    let numbers = known(&estimates.iter().flatten().copied().collect::<Vec<Estimate>>());
    if numbers.as_ref().is_some_and(|numbers| probability_of_one(numbers) < DISAGREE) {
        return None;
    }
    let precision =
        |estimate: &Option<Estimate>| estimate.and_then(|one| one.spread).map(|one| one.deviation().powi(-2));
    let mut weights: Vec<f64> = estimates.iter().map(|one| precision(one).unwrap_or(0.0)).collect();
    if numbers.is_none() {
        // The first with an error stands for all.
        let first = weights.iter().position(|weight| *weight > 0.0);
        weights.iter_mut().enumerate().filter(|(index, _)| Some(*index) != first).for_each(|(_, weight)| *weight = 0.0);
    }
    let sum: f64 = weights.iter().sum();
    Some(weights.into_iter().map(|weight| if sum > 0.0 { weight / sum } else { 0.0 }).collect())
}

#[cfg(test)]
mod tests {
    use super::{ConfidenceInterval, Estimate, pooled, weights};
    use crate::identify::answer::distribution::NORMAL_95 as NORMAL;

    fn estimate(value: f64, std: f64) -> Estimate {
        Estimate::new(value, Some(ConfidenceInterval::normal(value, std)))
    }

    fn ends(estimate: Estimate) -> [f64; 3] {
        estimate.spread.map_or([f64::NAN; 3], |spread| [spread.low, estimate.value, spread.high])
    }

    #[test]
    fn estimates_that_agree_are_weighted_and_others_are_held() {
        // Weights 4 and 1, and a variance of a fifth.
        let (one, apart) = pooled(&[estimate(2.0, 0.5), estimate(3.0, 1.0)]);
        let reach = NORMAL * 0.2f64.sqrt();
        for (found, expected) in ends(one).into_iter().zip([2.2 - reach, 2.2, 2.2 + reach]) {
            approx::assert_relative_eq!(found, expected, max_relative = 1e-14);
        }
        assert_eq!(apart, None);
        let (one, apart) = pooled(&[estimate(2.0, 0.1), estimate(4.0, 0.2)]);
        for (found, expected) in ends(one).into_iter().zip([2.0 - 0.1 * NORMAL, 3.0, 4.0 + 0.2 * NORMAL]) {
            approx::assert_relative_eq!(found, expected, max_relative = 1e-14);
        }
        approx::assert_relative_eq!(apart.unwrap_or_default(), 2f64.sqrt(), max_relative = 1e-14);
        // The 1 % point of chi-square with 1 degree of freedom is 6.635.
        let gap = |square: f64| pooled(&[estimate(0.0, 1.0), estimate((2.0 * square).sqrt(), 1.0)]).1.is_some();
        assert!(gap(6.64) && !gap(6.63));
    }

    #[test]
    fn weights_are_those_of_the_pooled_mean() {
        let found = weights(&[Some(estimate(2.0, 0.5)), None, Some(estimate(3.0, 1.0))]);
        assert_eq!(found, Some(vec![0.8, 0.0, 0.2]));
        assert_eq!(weights(&[Some(estimate(2.0, 0.1)), Some(estimate(4.0, 0.2))]), None);
        let exact = Estimate::new(0.0, None);
        assert_eq!(
            weights(&[Some(exact), Some(estimate(2.0, 0.3)), Some(estimate(9.0, 0.3))]),
            Some(vec![0.0, 1.0, 0.0])
        );
        assert_eq!(weights(&[Some(exact), None]), Some(vec![0.0; 2]));
    }

    #[test]
    fn a_shared_error_adds_in_squares_and_intervals_hold_others() {
        let wider = estimate(2.0, 0.3).with_error(0.2);
        for (found, expected) in ends(wider).into_iter().zip([2.0 - 0.5 * NORMAL, 2.0, 2.0 + 0.5 * NORMAL]) {
            approx::assert_relative_eq!(found, expected, max_relative = 1e-14);
        }
        assert_eq!(estimate(2.0, 0.3).with_error(0.0), estimate(2.0, 0.3));
        let held = estimate(2.0, 0.3).holding(&[estimate(1.0, 0.1), estimate(2.1, 0.1)]);
        assert_eq!(ends(held), [1.0 - 0.1 * NORMAL, 2.0, 2.0 + 0.3 * NORMAL]);
        assert_eq!(ends(estimate(2.0, 0.3).in_units(2.0)), ends(estimate(4.0, 0.6)));
        // An estimate without an error is the others'.
        let exact = Estimate::new(0.0, None);
        assert_eq!(pooled(&[exact, estimate(2.0, 0.3)]), (estimate(2.0, 0.3), None));
    }
}
