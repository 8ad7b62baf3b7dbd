//! Model average: all models tried, weighted by their likelihood and number of parameters.

use rayon::prelude::*;

use super::confounded_lags;
use super::model::{Parameter, VehicleModel};
use super::observations::Observations;
use super::rounding;
use super::scoring::{self, Fitted};
use super::structure_search::SearchOutcome;
use crate::identify::answer::{ConfidenceInterval, Estimate};

/// A model's distribution of a parameter: normal, or a point where the model lacks the parameter.
#[derive(Clone, Copy, Debug)]
struct MixtureComponent {
    weight: f64,
    mean: f64,
    std: f64,
}

/// Intervals of terms that were chosen by the record are wider by this.
pub(super) const CHOSEN: f64 = 1.15;
/// Power of the likelihoods of models with confounded lags: where none of them is the true model, the likelihood is overconfident.
const TEMPER: f64 = 0.5;

/// Prior odds against each lag beyond the delay: hardly any record rules a small one out, and without them it would widen every interval.
const LATE_ODDS: f64 = 6.0;
/// Logarithm of the odds against each parameter outside [`SUBTLE`]: subtle parameters move the inertia, the rest hardly.
const PLAIN_LOG_ODDS: f64 = 0.25;

/// Twice the log-likelihood that each further parameter must gain for a model to count. A structure that the record hardly
/// shows moves the inertia, so that it counts sooner.
const IDLE: f64 = 1.0;
const IDLE_STRUCTURE: f64 = 0.25;
/// The structures meant.
const SUBTLE: [Parameter; 9] = [
    Parameter::Stiffness,
    Parameter::CubicDrag,
    Parameter::Skew,
    Parameter::Memory,
    Parameter::MemoryS,
    Parameter::LagS,
    Parameter::RampS,
    Parameter::PauseS,
    Parameter::FilterS,
];

/// Covariance of the structural parameters, zero where not estimated.
type StructureCovariance = [[f64; Parameter::COUNT]; Parameter::COUNT];

/// Covariance of the structural parameters of a model under white errors; `None` where the record does not determine a parameter.
fn covariance(fitted: &Fitted, observations: &Observations) -> Option<StructureCovariance> {
    let free = scoring::movable(&fitted.model, &fitted.score, observations);
    let mut covariance = [[0.0; Parameter::COUNT]; Parameter::COUNT];
    for index in &free {
        let mut unit = [0.0; Parameter::COUNT];
        unit[*index] = 1.0;
        let (column, _) = scoring::solve(&fitted.score.structure_information, &unit, &free, 1e-10)?;
        free.iter().zip(column).for_each(|(row, entry)| covariance[*row][*index] = entry);
    }
    Some(covariance)
}

/// The covariance under rounding errors, from that under white errors: correlations stay.
fn under_rounding(fitted: &Fitted, observations: &Observations, covariance: &mut StructureCovariance) {
    let free = scoring::movable(&fitted.model, &fitted.score, observations);
    if let Some(factors) = rounding::factors(fitted, observations, &free) {
        for (row, factor) in covariance.iter_mut().zip(factors) {
            row.iter_mut().zip(factors).for_each(|(entry, other)| *entry *= factor * other);
        }
    }
}

/// Number of a model's linear and quadratic drags. They are no question of parsimony: any hull has both, and a law of one of them is
/// the sum with the other at zero. A share too small to gain anything still moves the other drag, and with it the inertia. So a
/// law's weight is its likelihood.
pub(super) fn drags(model: &VehicleModel) -> usize {
    [Parameter::LinearDrag, Parameter::QuadraticDrag].into_iter().filter(|drag| model.is_free(*drag)).count()
}

/// Logarithm of the prior odds against a model's terms.
pub(super) fn log_odds_against(model: &VehicleModel, known_delay_s: Option<f64>) -> f64 {
    let (had, ways) = confounded_lags::ways(model, known_delay_s);
    let subtle = SUBTLE.iter().filter(|parameter| model.is_free(**parameter)).count();
    // The confounded lags share the odds.
    had as f64 * libm::log(LATE_ODDS * ways as f64) + PLAIN_LOG_ODDS * (model.freedom() - subtle - drags(model)) as f64
}

/// The models of an average with their weights and their covariances.
pub(super) struct Average<'a> {
    pub(super) members: Vec<(f64, &'a Fitted, StructureCovariance)>,
}

impl<'a> Average<'a> {
    /// `observations` are those of a model; `value` is the logarithm of its weight.
    pub(super) fn new(
        found: &'a SearchOutcome,
        observations: impl Fn(&Fitted) -> &'a Observations + Sync,
        value: impl Fn(&Fitted) -> f64,
    ) -> Self {
        let best = &found.tried[found.best];
        let top = value(best);
        let temper = if confounded_lags::is_in(&best.model) { TEMPER } else { 1.0 };
        let mut members: Vec<(f64, &Fitted, StructureCovariance)> = Vec::new();
        for fitted in &found.tried {
            let weight = libm::exp(temper * (value(fitted) - top));
            if weight < 1e-3 {
                continue;
            }
            // The same model reached twice counts once, the likelier time.
            if let Some(same) = members.iter_mut().find(|(_, other, _)| other.model.is_alike(&fitted.model)) {
                if fitted.log_likelihood <= same.1.log_likelihood {
                    continue;
                }
                if let Some(covariance) = covariance(fitted, observations(fitted)) {
                    *same = (weight, fitted, covariance);
                }
                continue;
            }
            if let Some(covariance) = covariance(fitted, observations(fitted)) {
                members.push((weight, fitted, covariance));
            }
        }
        // A model that contains another and hardly gains on it has a parameter without effect.
        let idle = |(_, fitted, _): &(f64, &Fitted, StructureCovariance)| {
            members.iter().any(|(_, other, _)| {
                contains(&fitted.model, &other.model)
                    && 2.0 * (fitted.log_likelihood - other.log_likelihood) < least_gain(&fitted.model, &other.model)
            })
        };
        let idle: Vec<bool> = members.iter().map(idle).collect();
        let mut keep = idle.iter().map(|idle| !idle);
        members.retain(|_| keep.next().unwrap_or(true));
        let sum: f64 = members.iter().map(|member| member.0).sum();
        members.par_iter_mut().for_each(|(weight, fitted, covariance)| {
            *weight /= sum;
            under_rounding(fitted, observations(fitted), covariance);
        });
        Self { members }
    }

    /// The estimate of a parameter: the mean over the models; its interval is wider than the mixture's by `factor`.
    pub(super) fn estimate(&self, parameter: Parameter, factor: f64) -> Option<Estimate> {
        let index = parameter as usize;
        let components: Vec<MixtureComponent> = self
            .members
            .iter()
            .map(|(weight, fitted, covariance)| MixtureComponent {
                weight: *weight,
                mean: fitted.model.values[index],
                std: factor * covariance[index][index].sqrt(),
            })
            .collect();
        let mean: f64 = components.iter().map(|c| c.weight * c.mean).sum();
        let variance: f64 = components.iter().map(|c| c.weight * (c.std.powi(2) + (c.mean - mean).powi(2))).sum();
        let std = variance.sqrt();
        if !mean.is_finite() || !std.is_finite() {
            return None;
        }
        // All models share the value where it was given, and rounding of the weights is no spread.
        let given = components.iter().all(|c| c.std == 0.0 && c.mean == components[0].mean);
        if given {
            return Some(Estimate::new(components[0].mean, None));
        }
        let (low, high) = (quantile(&components, 0.025), quantile(&components, 0.975));
        // A component far away with less weight than a tail moves the mean, but no end of the interval.
        Some(Estimate::new(mean.max(low).min(high), Some(ConfidenceInterval { std, low, high })))
    }
}

impl Average<'_> {
    /// Covariance of parameters: the mean of the models' own, wider by the square of `factor`, and the covariance of their values (law of total
    /// covariance).
    pub(super) fn covariance<const N: usize>(&self, parameters: [Parameter; N], factor: f64) -> [[f64; N]; N] {
        let mean = |value: &dyn Fn(&Fitted, &StructureCovariance) -> f64| -> f64 {
            self.members.iter().map(|(weight, fitted, covariance)| weight * value(fitted, covariance)).sum()
        };
        let centre = parameters.map(|parameter| mean(&|fitted, _| fitted.model.value(parameter)));
        core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let [row, column] = [i, j].map(|k| parameters[k]);
                mean(&|fitted, covariance| {
                    let apart = (fitted.model.value(row) - centre[i]) * (fitted.model.value(column) - centre[j]);
                    factor * factor * covariance[row as usize][column as usize] + apart
                })
            })
        })
    }
}

/// Whether the first model has all that the second has, and more.
fn contains(a: &VehicleModel, b: &VehicleModel) -> bool {
    let covers = |a: &[bool], b: &[bool]| a.iter().zip(b).all(|(a, b)| *a || !*b);
    (a.switching, a.clock) == (b.switching, b.clock)
        && a.freedom() > b.freedom()
        && covers(&a.free, &b.free)
        && covers(&a.noise_free, &b.noise_free)
}

/// Least gain in log-likelihood of the first model over the second, which it contains.
fn least_gain(more: &VehicleModel, less: &VehicleModel) -> f64 {
    let added = (more.freedom() - drags(more)).saturating_sub(less.freedom() - drags(less));
    let subtle = SUBTLE.iter().filter(|parameter| more.is_free(**parameter) && !less.is_free(**parameter)).count();
    IDLE_STRUCTURE * subtle as f64 + IDLE * added.saturating_sub(subtle) as f64
}

/// Where a mixture of normal distributions and points reaches a probability.
fn quantile(components: &[MixtureComponent], probability: f64) -> f64 {
    let below = |x: f64| -> f64 {
        let share = |c: &MixtureComponent| {
            if c.std > 0.0 {
                0.5 * libm::erfc((c.mean - x) / (c.std * core::f64::consts::SQRT_2))
            } else if x >= c.mean {
                1.0
            } else {
                0.0
            }
        };
        components.iter().map(|c| c.weight * share(c)).sum()
    };
    let ends = components.iter().map(|c| (c.mean - 9.0 * c.std, c.mean + 9.0 * c.std));
    let (mut low, mut high) =
        ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), end| (low.min(end.0), high.max(end.1)));
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        if below(middle) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    // Rounding must not leave out the point itself that the probability is reached at.
    let points = components.iter().filter(|c| c.std == 0.0).map(|c| c.mean);
    let reached = points.into_iter().find(|point| low <= *point && *point <= high);
    reached.unwrap_or(f64::midpoint(low, high))
}

#[cfg(test)]
mod tests {
    use super::{MixtureComponent, quantile};

    #[test]
    fn the_end_of_an_interval_does_not_miss_the_point_it_stands_on() {
        let point = MixtureComponent { weight: 0.98, mean: 0.0, std: 0.0 };
        let beside = |mean: f64| MixtureComponent { weight: 0.02, mean, std: 0.01 };
        for mean in [0.3, -0.3, 7.1] {
            let mixture = [point, beside(mean)];
            assert_eq!([0.025, 0.975].map(|probability| quantile(&mixture, probability)), [0.0, 0.0], "beside {mean}");
        }
        // More than the tail lies above: the upper end is there.
        let wide = [MixtureComponent { weight: 0.9, ..point }, MixtureComponent { weight: 0.1, ..beside(0.3) }];
        assert_eq!(quantile(&wide, 0.025), 0.0);
        assert!(quantile(&wide, 0.975) > 0.29);
    }

    #[test]
    fn without_points_a_quantile_is_that_of_the_normal_distribution() {
        let one = [MixtureComponent { weight: 1.0, mean: 2.0, std: 0.5 }];
        assert!((quantile(&one, 0.975) - (2.0 + 0.5 * 1.959_963_984_540_054)).abs() < 1e-12);
        assert!((quantile(&one, 0.025) - (2.0 - 0.5 * 1.959_963_984_540_054)).abs() < 1e-12);
    }
}
