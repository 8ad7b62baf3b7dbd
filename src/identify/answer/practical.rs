//! The practical interval: `H^2 = (2 h)^2 + sum_i (share_i size_i)^2`, h the statistical half-width, the sum over the sources of the
//! [budget](super::budget).
//!
//! Not in a practical interval: the scale of the thrust, and a source that is not in the table.

use super::budget::{Assumptions, BudgetEntry, ErrorSource, Shares};
use super::covariance::matrix;
use super::{Disturbances, Estimate, Reason, Reported};

/// A record's own units of force, speed and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MotionScale {
    /// Half the command's range.
    pub(crate) level: f64,
    /// Top speed.
    pub(crate) speed: f64,
    pub(crate) half_period_s: f64,
}

/// Powers of output and time in a parameter's unit, and the part of the answer's trial that it takes.
#[derive(Clone, Copy)]
struct Moved {
    output: f64,
    time: f64,
    trial: fn(&Shares) -> f64,
    /// The whole of the trial's share.
    whole: f64,
}

impl Moved {
    /// Half the width of the declared sources' interval of a value, from independent shares.
    fn declared(&self, value: f64, assumed: &Assumptions) -> f64 {
        let part = |source: ErrorSource| self.exact(value, source, assumed).abs() + self.tried(source, assumed);
        ErrorSource::ALL.into_iter().map(|source| part(source).powi(2)).sum::<f64>().sqrt()
    }

    /// Change by a source whose shares are powers of the unit.
    fn exact(&self, value: f64, source: ErrorSource, assumed: &Assumptions) -> f64 {
        let shares = source.shares();
        0.01 * assumed.size(source) * (shares.output * self.output + shares.time * self.time) * value
    }

    /// Change by a source whose share is of the trial.
    fn tried(&self, source: ErrorSource, assumed: &Assumptions) -> f64 {
        0.01 * assumed.size(source) * (self.trial)(&source.shares()) * self.whole.abs()
    }
}

impl Reported {
    /// With its budget and the practical interval of every estimate; `scales` are those of the records, in their order.
    pub(crate) fn with_budget(mut self, assumed: &Assumptions, scales: &[MotionScale]) -> Self {
        let count = scales.len().max(1) as f64;
        let mean = |of: fn(&MotionScale) -> f64| scales.iter().map(of).sum::<f64>() / count;
        let (speed, half_period_s) = (mean(|scale| scale.speed), mean(|scale| scale.half_period_s));
        let none = |_: &Shares| 0.0;
        // Units are powers of output, time and the command: alpha has command s^2/output.
        let exact = |output: f64, time: f64| Moved { output, time, trial: none, whole: 0.0 };
        let alpha = Moved { trial: |shares| shares.alpha, whole: self.alpha.value, ..exact(1.0, 2.0) };
        self.budget = ErrorSource::ALL
            .into_iter()
            .filter(|source| assumed.size(*source) > 0.0)
            .map(|source| {
                let alone = Assumptions::NONE.with(source, assumed.size(source));
                BudgetEntry {
                    source: source.name().into(),
                    size: assumed.size(source),
                    unit: source.unit().into(),
                    share_percent: 100.0 * alpha.declared(self.alpha.value, &alone) / self.alpha.value.abs(),
                    remedy: source.remedy().into(),
                }
            })
            .collect();
        self.budget.sort_by(|a, b| b.share_percent.total_cmp(&a.share_percent));
        // A source takes its share of the drag force for whichever law is there.
        let force = self.beta.value.abs() * speed + self.beta_quadratic.value.abs() * speed * speed;
        let drag = |power: i32| Moved {
            trial: |shares| shares.drag,
            whole: if speed > 0.0 { force / speed.powi(power) } else { 0.0 },
            ..exact(f64::from(power), f64::from(power))
        };
        // A scale moves the three coefficients together. Which of them takes a trial's share is undecided: apart.
        let (drags, estimates) = ([1, 2, 3].map(drag), self.drags());
        let declared = matrix(|i, j| {
            let estimated = |k: usize| estimates[k].filter(|drag| drag.spread.is_some());
            let Some((row, column)) = estimated(i).zip(estimated(j)) else { return 0.0 };
            let of = |source: ErrorSource| {
                let together =
                    drags[i].exact(row.value, source, assumed) * drags[j].exact(column.value, source, assumed);
                let apart = if i == j { drags[i].tried(source, assumed) } else { 0.0 };
                together + apart * apart
            };
            ErrorSource::ALL.into_iter().map(of).sum()
        });
        let practical =
            |estimate: Estimate, moved: Moved| estimate.with_declared(moved.declared(estimate.value, assumed));
        let optional = |estimate: Option<Estimate>, output: f64, time: f64| {
            estimate.map(|estimate| practical(estimate, exact(output, time)))
        };
        let time = |estimate: Option<Estimate>| optional(estimate, 0.0, 1.0).map(Estimate::not_below_zero);
        let deltas: Disturbances = self
            .deltas
            .iter()
            .zip(scales)
            .map(|(delta, scale)| {
                practical(*delta, Moved { trial: |shares| shares.delta, whole: scale.level, ..exact(0.0, 0.0) })
            })
            .collect();
        let delay = Moved { trial: |shares| shares.delay, whole: half_period_s, ..exact(0.0, 1.0) };
        let alpha = practical(self.alpha, alpha);
        let [beta, beta_quadratic] = [practical(self.beta, drags[0]), practical(self.beta_quadratic, drags[1])];
        let beta_cubic = self.beta_cubic.map(|cubic| practical(cubic, drags[2]));
        // The practical interval may be too wide where the statistical interval, half of it at most, is not.
        self.reasons.retain(|reason| !matches!(reason, Reason::TooWide { .. }));
        let found = Self {
            alpha,
            beta,
            beta_quadratic,
            beta_cubic,
            drag_covariance: self
                .drag_covariance
                .map(|covariance| covariance.with_declared(declared, [Some(beta), Some(beta_quadratic), beta_cubic])),
            skew: optional(self.skew, 0.0, 0.0),
            memory: optional(self.memory, 1.0, 1.0),
            memory_s: time(self.memory_s),
            stiffness: optional(self.stiffness, 1.0, 0.0),
            lag_s: time(self.lag_s),
            ramp_s: time(self.ramp_s),
            pause_s: time(self.pause_s),
            filter_s: time(self.filter_s),
            delay_s: practical(self.delay_s, delay).not_below_zero(),
            deltas,
            ..self
        };
        Reason::too_wide(alpha).into_iter().fold(found, Self::with_reason)
    }
}

#[cfg(test)]
mod tests {
    use super::Moved;
    use crate::identify::answer::budget::{Assumptions, ErrorSource};
    use crate::identify::answer::{ConfidenceInterval, Estimate, Reason};

    /// A statistical half-width of 28 % makes a practical half-width of 57 %, of no use.
    #[test]
    fn the_practical_interval_decides_what_is_too_wide() {
        let spread = ConfidenceInterval { std: 3.1, low: 15.5, high: 27.8 };
        let alpha = Estimate::new(21.7, Some(spread));
        assert_eq!(Reason::too_wide(alpha), None);
        let found = Reason::too_wide(alpha.with_declared(0.3));
        assert!(matches!(found, Some(Reason::TooWide { relative }) if (relative - 0.567).abs() < 0.01), "{found:?}");
    }

    /// An interval as wide as the inertia itself shows none: another experiment, or a process without inertia.
    #[test]
    fn a_width_of_all_points_to_processes_without_inertia() {
        assert!(Reason::TooWide { relative: 1.0 }.to_string().contains("selfosc autotune"));
        assert!(Reason::TooWide { relative: 0.99 }.to_string().starts_with("the inertia is known to within 99 %"));
    }

    /// 3-4-5: twice a half-width of 2 with declared sources of 3.
    #[test]
    fn practical_half_widths_add_in_squares() {
        let spread = ConfidenceInterval { std: 1.0, low: 8.0, high: 12.0 };
        let found = Estimate::new(10.0, Some(spread)).with_declared(3.0).combined;
        assert_eq!(found, Some(ConfidenceInterval { std: 2.5, low: 5.0, high: 15.0 }));
        assert_eq!(Estimate::new(10.0, None).with_declared(3.0).combined, None);
        let near = Estimate::new(0.1, Some(spread)).with_declared(3.0).not_below_zero().combined;
        assert!(near.is_some_and(|interval| interval.low == 0.0));
    }

    /// Of an inertia of 2, 1 % of time is 2 % and 1.5 % of output 1.5 %; trials take their share of the whole.
    #[test]
    fn shares_are_powers_of_the_unit_or_those_of_the_trial() {
        let moved = Moved { output: 1.0, time: 2.0, trial: |shares| shares.alpha, whole: 2.0 };
        let sizes = Assumptions::NONE.with(ErrorSource::Clock, 1.0);
        approx::assert_relative_eq!(moved.declared(2.0, &sizes), 0.04, max_relative = 1e-12);
        let both = sizes.with(ErrorSource::SensorGain, 1.5);
        approx::assert_relative_eq!(moved.declared(2.0, &both), 0.05, max_relative = 1e-12);
        let heading = Assumptions::NONE.with(ErrorSource::HeadingError, 1.0);
        let share = ErrorSource::HeadingError.shares().alpha;
        approx::assert_relative_eq!(moved.declared(2.0, &heading), 0.02 * share, max_relative = 1e-12);
        assert_eq!(moved.declared(2.0, &heading.without_heading()), 0.0);
    }
}
