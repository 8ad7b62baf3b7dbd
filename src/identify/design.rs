//! Which experiment to make: from a rough model, a sensor and a time limit the relay level and half-width that determine the
//! inertia best, and the second level that best discriminates the drag laws.
//!
//! Every experiment of a grid is simulated with the rough model, and the standard deviations are those of the Cramer-Rao bound
//! for an estimator that knows neither drag law nor constant force nor, unless it is given, delay (Ljung 1999, section 13.3; Goodwin
//! and Payne 1977). Where cycles would lock to the sampling, so that one cycle's readings return time and again, they count once.
//!
//! Not considered: lags, forces and noise that the rough model and the sensor lack.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::answer::Delay;
use super::fit::prediction_error::information::{Information, of_record};
use crate::experiment::{ExperimentError, Sensor, SimulatedExperiment};
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::domain::{Plain, require};
use crate::numeric::{Limit, OutOfDomain};
use crate::orbit::limit_cycle;
use crate::plant::DragAxis;

/// Known parameters and admissible experiments.
///
/// ```
/// use selfosc::experiment::Sensor;
/// use selfosc::identify::{Delay, design::Situation};
/// use selfosc::plant::DragAxis;
/// let axis = DragAxis::quadratic(1.0, 0.5)?.with_delay_s(0.1)?;
/// let sensor = Sensor { quantum: 0.0175, ..Sensor::default() };
/// let situation =
///     Situation { axis, sensor, rate_hz: 10.0, time_limit_s: 60.0, largest_level: 1.0, largest_amplitude: 2.0, delay: Delay::Estimated };
/// let best = &situation.experiments()?[0];
/// assert!(best.first.std.alpha < 0.02 && best.first.amplitude <= 2.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Situation {
    /// The rough model, with its delay and constant force.
    pub axis: DragAxis<f64>,
    /// The sensor.
    pub sensor: Sensor,
    /// Samples per second, of sensor and relay.
    pub rate_hz: f64,
    /// Length of a record, in s.
    pub time_limit_s: f64,
    /// The largest relay level, in command units.
    pub largest_level: f64,
    /// The largest amplitude of the output that is allowed; infinite for any.
    pub largest_amplitude: f64,
    /// Whether the delay will be known; one that is given here is that of the axis.
    pub delay: Delay,
}

/// Expected standard deviations; infinite where the record would leave a parameter open. Where the cycles would lock to the sampling they
/// are lower bounds: the roundings of one cycle do not average.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deviations {
    /// Of the inertia.
    #[serde(with = "super::answer::any_float")]
    pub alpha: f64,
    /// Of linear drag in presence of quadratic drag.
    #[serde(with = "super::answer::any_float")]
    pub beta: f64,
    /// Of quadratic drag in presence of linear drag.
    #[serde(with = "super::answer::any_float")]
    pub beta_quadratic: f64,
    /// Of the delay, in s; zero where it is given.
    #[serde(with = "super::answer::any_float")]
    pub delay_s: f64,
}

/// One record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Relay level C, in command units.
    pub relay_level: f64,
    /// Half-width x_a of the hysteresis, in output units.
    pub half_width: f64,
    /// Amplitude of the limit cycle, in output units.
    pub amplitude: f64,
    /// Its period, in s.
    pub period_s: f64,
    /// Whether its cycles would lock to the sampling.
    pub locks: bool,
    /// Expected standard deviations from this record alone.
    pub std: Deviations,
}

/// A record, and a second record at another level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proposal {
    /// The record.
    pub first: Run,
    /// The second record that best discriminates the drag laws; `None` if no second level oscillates.
    pub second: Option<Second>,
}

/// A second record.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Second {
    /// The record.
    pub run: Run,
    /// Expected standard deviations from both.
    pub together: Deviations,
    /// Standard deviations by which both refute a law without the rough model's linear drag.
    pub linear_needed: f64,
    /// The same of its quadratic drag.
    pub quadratic_needed: f64,
}

/// Why there is no proposal.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// A number outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// The sensor or the rate is none.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// No relay of the grid makes the rough model oscillate as wanted.
    #[error(
        "no relay up to level {} makes five cycles of at least eight samples within {} s{}; give drag (--beta, --beta-quadratic), \
         allow a larger level (--level) or amplitude (--largest-amplitude), log longer (--time) or faster (--rate)",
        Plain(*.largest_level), Plain(*.time_limit_s), Within(*.largest_amplitude)
    )]
    NoExperiment {
        /// The largest level.
        largest_level: f64,
        /// The time limit, in s.
        time_limit_s: f64,
        /// The largest amplitude.
        largest_amplitude: f64,
    },
}

/// A limit of the amplitude, where there is one.
struct Within(f64);

impl core::fmt::Display for Within {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if self.0.is_finite() { write!(f, " and amplitude {}", Plain(self.0)) } else { Ok(()) }
    }
}

crate::numeric::codes! { pub DesignError {
    OutOfDomain.0, Experiment.0, NoExperiment => "no-relay",
} }

/// Levels of the grid, in parts of the largest.
const LEVELS: [f64; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];
/// Half-widths of the grid: the least, in errors of a reading, their ratio, and how many.
const NARROWEST: f64 = 3.0;
const RATIO: f64 = 1.35;
const HALF_WIDTHS: i32 = 24;
/// The fewest cycles of a record, and the fewest samples of a cycle.
const FEWEST_CYCLES: f64 = 5.0;
const FEWEST_SAMPLES: f64 = 8.0;
/// Cycles of which fewer readings than this part count repeat themselves.
const LOCKED: f64 = 0.6;
/// Without any error of a reading it counts as exact to this part of the amplitude.
const FINEST: f64 = 1e-4;

/// A run with its information.
type Informed = (Run, Information);

impl Situation {
    /// Proposals, that of the least variance of the inertia first and those that would lock to the sampling last, each with the second level
    /// that best discriminates the laws.
    ///
    /// # Errors
    /// [`DesignError`] for numbers outside their domain, and where nothing oscillates within the limits.
    pub fn experiments(&self) -> Result<Vec<Proposal>, DesignError> {
        let positive = |quantity, value, unit| require(quantity, value, unit, Limit::Positive, "give what is possible");
        positive("largest relay level", self.largest_level, "command units")?;
        positive("time limit", self.time_limit_s, "s")?;
        positive("sampling rate", self.rate_hz, "Hz")?;
        if !(self.largest_amplitude > 0.0) {
            positive("largest amplitude", self.largest_amplitude, "output units")?;
        }
        let Sensor { quantum, noise, .. } = self.sensor.checked()?;
        let error = libm::hypot(quantum, noise);
        // Without an error the scale is how far the largest level drives the axis in a few samples.
        let travel = self.largest_level / self.axis.alpha() * (3.0 / self.rate_hz).powi(2);
        let narrowest = if error > 0.0 { NARROWEST * error } else { travel };
        let grid: Vec<(f64, f64)> = LEVELS
            .iter()
            .flat_map(|part| {
                (0..HALF_WIDTHS).map(move |step| (part * self.largest_level, narrowest * RATIO.powi(step)))
            })
            .collect();
        let runs: Result<Vec<Option<Informed>>, DesignError> =
            grid.into_par_iter().map(|(level, half_width)| self.run(level, half_width)).collect();
        let mut runs: Vec<Informed> = runs?.into_iter().flatten().collect();
        runs.sort_by(|(a, _), (b, _)| a.locks.cmp(&b.locks).then(a.std.alpha.total_cmp(&b.std.alpha)));
        if runs.is_empty() {
            let Self { largest_level, time_limit_s, largest_amplitude, .. } = *self;
            return Err(DesignError::NoExperiment { largest_level, time_limit_s, largest_amplitude });
        }
        Ok(runs.iter().map(|first| Proposal { first: first.0, second: self.second(first, &runs) }).collect())
    }

    /// One experiment; `None` where it does not oscillate as wanted.
    fn run(&self, relay_level: f64, half_width: f64) -> Result<Option<Informed>, DesignError> {
        let Ok(relay) = RelayHysteresis::new(relay_level, half_width, 0.0) else { return Ok(None) };
        let Ok(cycle) = limit_cycle(&self.axis, &relay) else { return Ok(None) };
        let (amplitude, period_s) = (cycle.amplitude, cycle.period_s);
        let fits = amplitude <= self.largest_amplitude
            && FEWEST_CYCLES * period_s <= self.time_limit_s
            && period_s * self.rate_hz >= FEWEST_SAMPLES;
        if !fits {
            return Ok(None);
        }
        let experiment = SimulatedExperiment::new(self.axis, relay, self.rate_hz)?.held().with_sensor(self.sensor)?;
        let record = experiment.run(self.time_limit_s)?;
        let variance =
            (self.sensor.quantum.powi(2) / 12.0 + self.sensor.noise.powi(2)).max((FINEST * amplitude).powi(2));
        Ok(of_record(&record, &self.axis, variance).map(|(information, counted)| {
            let std = self.deviations(&information);
            (Run { relay_level, half_width, amplitude, period_s, locks: counted < LOCKED, std }, information)
        }))
    }

    /// The Cramer-Rao bound.
    fn deviations(&self, information: &Information) -> Deviations {
        let known = self.delay != Delay::Estimated;
        let mut information = *information;
        if known {
            // A known delay carries no information on the other parameters.
            information.fill_row(3, 0.0);
            information.fill_column(3, 0.0);
            information[(3, 3)] = 1.0;
        }
        let scale = information.diagonal().map(|entry| entry.max(f64::MIN_POSITIVE).sqrt().recip());
        let scaled = Information::from_fn(|row, column| information[(row, column)] * scale[row] * scale[column]);
        let variance = scaled.cholesky().map(|factor| factor.inverse());
        let std = |index: usize| {
            variance.map_or(f64::INFINITY, |variance: Information| variance[(index, index)].sqrt() * scale[index])
        };
        Deviations { alpha: std(0), beta: std(1), beta_quadratic: std(2), delay_s: if known { 0.0 } else { std(3) } }
    }

    /// The second record, at another level, that best discriminates the drag laws; one that would lock only where all others would.
    fn second(&self, first: &Informed, runs: &[Informed]) -> Option<Second> {
        let others = runs.iter().filter(|(run, _)| run.relay_level != first.0.relay_level);
        let seconds = others.map(|(run, information)| {
            let together = self.deviations(&(first.1 + information));
            let needed = |drag: f64, std: f64| drag.abs() / std;
            Second {
                run: *run,
                together,
                linear_needed: needed(self.axis.linear_drag(), together.beta),
                quadratic_needed: needed(self.axis.quadratic_drag(), together.beta_quadratic),
            }
        });
        let told = |second: &Second| second.linear_needed.max(second.quadratic_needed);
        seconds.max_by(|a, b| b.run.locks.cmp(&a.run.locks).then(told(a).total_cmp(&told(b))))
    }
}
