//! One number from the estimates of several records.

use super::residuals::NORMAL;
use super::tail::chi_square_tail;
use crate::identify::joint::{ConfidenceInterval, Estimate};

/// Below this probability records disagree.
pub(super) const DISAGREE: f64 = 0.01;

impl ConfidenceInterval {
    /// Half its width in normal standard deviations: right where it is no normal one, too.
    pub(super) fn deviation(self) -> f64 {
        0.5 * (self.high - self.low) / NORMAL
    }
}

impl Estimate {
    /// With a relative error that all records share.
    pub(super) fn with_error(mut self, relative: f64) -> Self {
        if let Some(spread) = &mut self.spread {
            let more = self.value.abs() * relative;
            let wider = NORMAL * (spread.deviation().hypot(more) - spread.deviation());
            let std = spread.std.hypot(more);
            *spread = ConfidenceInterval { std, low: spread.low - wider, high: spread.high + wider };
        }
        self
    }

    /// With an interval that holds those of the others, too.
    pub(super) fn holding(mut self, others: &[Self]) -> Self {
        if let Some(spread) = &mut self.spread {
            for other in others.iter().filter_map(|other| other.spread) {
                (spread.low, spread.high) = (spread.low.min(other.low), spread.high.max(other.high));
            }
            spread.std = spread.std.max(spread.deviation());
        }
        self
    }

    /// In another unit.
    pub(super) fn in_units(mut self, factor: f64) -> Self {
        self.value *= factor;
        if let Some(spread) = &mut self.spread {
            for number in [&mut spread.std, &mut spread.low, &mut spread.high] {
                *number *= factor;
            }
        }
        self
    }
}

/// Numbers with their standard deviations, all above zero.
pub(super) type Known = Vec<(f64, f64)>;

/// Mean of numbers weighted by their precision, with its standard deviation.
pub(super) fn mean(numbers: &Known) -> (f64, f64) {
    let weight: f64 = numbers.iter().map(|(_, std)| std.powi(-2)).sum();
    (numbers.iter().map(|(value, std)| value * std.powi(-2)).sum::<f64>() / weight, weight.sqrt().recip())
}

/// Probability that numbers scatter more if they are one; one for a single number.
#[allow(clippy::cast_precision_loss, reason = "a count of records")]
pub(super) fn probability_of_one(numbers: &Known) -> f64 {
    let (mean, _) = mean(numbers);
    let scatter: f64 = numbers.iter().map(|(value, std)| ((value - mean) / std).powi(2)).sum();
    if numbers.len() > 1 { chi_square_tail(scatter, numbers.len() as f64 - 1.0) } else { 1.0 }
}

/// Values with their standard deviations; `None` where one has none.
pub(super) fn known(estimates: &[Estimate]) -> Option<Known> {
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
        let spread = ConfidenceInterval { std, low: value - NORMAL * std, high: value + NORMAL * std };
        return (Estimate { value, spread: Some(spread) }, None);
    }
    let count = numbers.len() as f64;
    let value = numbers.iter().map(|(value, _)| value).sum::<f64>() / count;
    let between = (numbers.iter().map(|(v, _)| (v - value).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
    let spread = ConfidenceInterval { std: between.hypot(std), low: value, high: value };
    let held = Estimate { value, spread: Some(spread) }.holding(estimates);
    let spread = held.spread.map(|held| ConfidenceInterval { std: spread.std, ..held });
    (Estimate { value, spread }, Some(between))
}
