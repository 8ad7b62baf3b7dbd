//! The uncertainty budget: sources of error that no residual shows, and what each moves.
//!
//! The record's scatter gives the statistical interval (type A of JCGM 100:2008, the GUM). A compass with hard iron or a thruster
//! whose thrust changes after a reversal moves the inertia and leaves the residuals as they are: such sources have sizes that are
//! declared (type B). The practical half-width is `H^2 = (2 h)^2 + sum_i (share_i size_i)^2`, h the statistical half-width.
//!
//! What a practical interval does not hold: the scale of the thrust, and a source that is not in the table.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::{Disturbances, Estimate, Reported};
use crate::numeric::domain::require;
use crate::numeric::{Limit, OutOfDomain};

/// A source of error that no residual shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorSource {
    /// Scale of the sensor.
    SensorGain,
    /// Scale of the time stamps.
    Clock,
    /// Heading error of one cycle per turn, as hard iron beside a compass makes.
    HeadingError,
    /// Thrust after a reversal that differs from steady thrust, as the propeller's own wash makes.
    ThrustDynamics,
}

/// What one unit of a source moves, in percent.
struct Shares {
    /// Scale of the output, and of time: they move every parameter by the power that its unit has of them.
    output: f64,
    time: f64,
    /// Of the inertia.
    alpha: f64,
    /// Of the drag force at the record's top speed.
    drag: f64,
    /// Constant force, of the command's level.
    delta: f64,
    /// Delay, of half the period.
    delay: f64,
}

/// Shares of the trial: medians over 24 simulated vehicles, seeds 5530000 to 5530023, made by `tests/trust/budget.py`.
const HEADING_ERROR: Shares = Shares { output: 0.0, time: 0.0, alpha: 1.4, drag: 8.8, delta: 1.3, delay: 0.11 };
const THRUST_DYNAMICS: Shares = Shares { output: 0.0, time: 0.0, alpha: 0.45, drag: 0.93, delta: 0.001, delay: 0.004 };
/// Exact: the record of `(1 + e) x` or of `(1 + e) t` is one of the same model with other parameters.
const SENSOR_GAIN: Shares = Shares { output: 1.0, time: 0.0, alpha: 0.0, drag: 0.0, delta: 0.0, delay: 0.0 };
const CLOCK: Shares = Shares { output: 0.0, time: 1.0, alpha: 0.0, drag: 0.0, delta: 0.0, delay: 0.0 };

impl ErrorSource {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::SensorGain, Self::Clock, Self::HeadingError, Self::ThrustDynamics];

    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SensorGain => "sensor-gain",
            Self::Clock => "clock",
            Self::HeadingError => "heading-error",
            Self::ThrustDynamics => "thrust-dynamics",
        }
    }

    /// Unit of its size.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::HeadingError => "degree",
            Self::SensorGain | Self::Clock | Self::ThrustDynamics => "%",
        }
    }

    /// What makes it smaller.
    #[must_use]
    pub fn remedy(self) -> &'static str {
        match self {
            Self::SensorGain => "calibrate the sensor against a known distance or full turns",
            Self::Clock => "log the stamps of the autopilot's own clock",
            Self::HeadingError => "swing the compass, or log an integrated gyroscope",
            Self::ThrustDynamics => "record a second relay level, or a longer period",
        }
    }

    fn shares(self) -> Shares {
        match self {
            Self::SensorGain => SENSOR_GAIN,
            Self::Clock => CLOCK,
            Self::HeadingError => HEADING_ERROR,
            Self::ThrustDynamics => THRUST_DYNAMICS,
        }
    }
}

/// Sizes of the sources: each the half-width of a 95 % interval. The default is of a calibrated vehicle.
///
/// ```
/// use selfosc::identify::{Assumptions, ErrorSource};
/// let uncalibrated = Assumptions { heading_error_deg: 1.0, ..Assumptions::default() };
/// assert_eq!(uncalibrated.size(ErrorSource::HeadingError), 1.0);
/// assert_eq!(Assumptions::NONE.size(ErrorSource::Clock), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Assumptions {
    /// Scale error of the sensor, in percent.
    #[serde(rename = "sensor-gain")]
    pub sensor_gain_percent: f64,
    /// Scale error of the time stamps, in percent.
    #[serde(rename = "clock")]
    pub clock_percent: f64,
    /// Amplitude of the heading error of one cycle per turn, in degrees. It counts for headings alone.
    #[serde(rename = "heading-error")]
    pub heading_error_deg: f64,
    /// Difference of the thrust after a reversal from steady thrust, in percent of steady thrust.
    #[serde(rename = "thrust-dynamics")]
    pub thrust_dynamics_percent: f64,
}

/// The sources of the sizes are in spec/conventions.md.
impl Default for Assumptions {
    fn default() -> Self {
        Self {
            sensor_gain_percent: 0.5,
            clock_percent: 0.25,
            heading_error_deg: 1.0 / 3.0,
            thrust_dynamics_percent: 1.0,
        }
    }
}

impl Assumptions {
    /// No source: the practical intervals are twice as wide as the statistical ones.
    pub const NONE: Self =
        Self { sensor_gain_percent: 0.0, clock_percent: 0.0, heading_error_deg: 0.0, thrust_dynamics_percent: 0.0 };

    /// Size of a source, in its [unit](ErrorSource::unit).
    #[must_use]
    pub fn size(&self, source: ErrorSource) -> f64 {
        match source {
            ErrorSource::SensorGain => self.sensor_gain_percent,
            ErrorSource::Clock => self.clock_percent,
            ErrorSource::HeadingError => self.heading_error_deg,
            ErrorSource::ThrustDynamics => self.thrust_dynamics_percent,
        }
    }

    /// With another size of one source.
    #[must_use]
    pub fn with(mut self, source: ErrorSource, size: f64) -> Self {
        *match source {
            ErrorSource::SensorGain => &mut self.sensor_gain_percent,
            ErrorSource::Clock => &mut self.clock_percent,
            ErrorSource::HeadingError => &mut self.heading_error_deg,
            ErrorSource::ThrustDynamics => &mut self.thrust_dynamics_percent,
        } = size;
        self
    }

    /// For outputs that are no headings: depth, position.
    pub(crate) fn without_heading(self) -> Self {
        self.with(ErrorSource::HeadingError, 0.0)
    }

    /// Whether every size is finite and not negative.
    pub(crate) fn check(&self) -> Result<(), OutOfDomain> {
        ErrorSource::ALL.into_iter().try_for_each(|source| {
            let remedy = "give 0 for a source that does not act";
            require("size of a source of error", self.size(source), source.unit(), Limit::NonNegative, remedy)
                .map(|_| ())
        })
    }
}

/// One line of the budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BudgetEntry {
    /// Name of the [source](ErrorSource).
    pub source: Cow<'static, str>,
    /// Size assumed.
    pub size: f64,
    /// Its unit.
    pub unit: Cow<'static, str>,
    /// Half-width of the inertia's interval by this source alone, in percent of the inertia.
    pub share_percent: f64,
    /// What makes it smaller.
    pub remedy: Cow<'static, str>,
}

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
    /// What the trial's share is a share of.
    whole: f64,
}

impl Moved {
    /// Half the width of the declared sources' interval of a value, from shares that are independent of each other.
    fn declared(&self, value: f64, assumed: &Assumptions) -> f64 {
        let part = |source: ErrorSource| {
            let shares = source.shares();
            let exact = (shares.output * self.output + shares.time * self.time).abs() * value.abs();
            let tried = (self.trial)(&shares) * self.whole.abs();
            0.01 * assumed.size(source) * (exact + tried)
        };
        ErrorSource::ALL.into_iter().map(|source| part(source).powi(2)).sum::<f64>().sqrt()
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
        Self {
            alpha: practical(self.alpha, alpha),
            beta: practical(self.beta, drag(1)),
            beta_quadratic: practical(self.beta_quadratic, drag(2)),
            beta_cubic: self.beta_cubic.map(|cubic| practical(cubic, drag(3))),
            skew: optional(self.skew, 0.0, 0.0),
            coulomb: optional(self.coulomb, 0.0, 0.0).map(Estimate::not_below_zero),
            memory: optional(self.memory, 1.0, 1.0),
            memory_s: time(self.memory_s),
            stiffness: optional(self.stiffness, 1.0, 0.0),
            lag_s: time(self.lag_s),
            ramp_s: time(self.ramp_s),
            filter_s: time(self.filter_s),
            delay_s: practical(self.delay_s, delay).not_below_zero(),
            deltas,
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Assumptions, ErrorSource, Moved};
    use crate::identify::answer::{ConfidenceInterval, Estimate};

    /// 3-4-5: twice a half-width of 2 beside declared sources of 3.
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

    #[test]
    fn sizes_are_finite_and_not_negative() {
        assert!(Assumptions::default().check().is_ok() && Assumptions::NONE.check().is_ok());
        for size in [-0.1, f64::NAN, f64::INFINITY] {
            assert!(ErrorSource::ALL.into_iter().all(|source| Assumptions::NONE.with(source, size).check().is_err()));
        }
    }
}
