//! The whole loop in simulation: axis, delays, relay, sensor.

use crate::numeric::{Limit, OutOfDomain, domain};
use std::collections::VecDeque;

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::{ExperimentError, Record, RelayState};
use crate::nonlinearity::RelayHysteresis;
use crate::plant::{DragAxis, State};

/// What stands between the coordinate and the record. Zeros make a perfect sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensor {
    /// Delay between the coordinate and its reading, in s; it adds to that of the axis.
    pub delay_s: f64,
    /// Readings are rounded to whole multiples of this; 0 for none.
    pub quantum: f64,
    /// Standard deviation of Gaussian noise on a reading before it is rounded.
    pub noise: f64,
}

/// An experiment to simulate: an axis under a relay about the reference zero, observed at a fixed rate.
///
/// The motion is in closed form between switchings; no integrator adds an error. The relay either watches its input all the
/// time, or, [held](Self::held), compares each reading and holds its command until the next. A relay that watches all the
/// time sees the coordinate itself, delayed but without noise and rounding.
///
/// ```
/// use selfosc::experiment::SimulatedExperiment;
/// use selfosc::{nonlinearity::RelayHysteresis, plant::DragAxis};
/// let axis = DragAxis::quadratic(1.0, 0.5)?;
/// let record = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.run(60.0)?;
/// assert_eq!(record.samples(), 601);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedExperiment {
    axis: DragAxis<f64>,
    relay: RelayHysteresis<f64>,
    rate_hz: f64,
    held: bool,
    sensor: Sensor,
    seed: u64,
    start: State<f64>,
}

impl SimulatedExperiment {
    /// The most samples a simulation may have.
    pub const MOST_SAMPLES: f64 = 1e8;

    /// A perfect sensor and a relay that watches all the time; starts at rest at zero.
    ///
    /// # Errors
    /// [`ExperimentError::OutOfDomain`] unless the rate is positive and finite.
    pub fn new(axis: DragAxis<f64>, relay: RelayHysteresis<f64>, rate_hz: f64) -> Result<Self, ExperimentError> {
        domain::positive("rate", rate_hz, "Hz")?;
        let start = State { position: 0.0, velocity: 0.0 };
        Ok(Self { axis, relay, rate_hz, held: false, sensor: Sensor::default(), seed: 0, start })
    }

    /// The relay looks at each reading, and holds its command until the next.
    #[must_use]
    pub fn held(self) -> Self {
        Self { held: true, ..self }
    }

    /// The same experiment with another sensor.
    ///
    /// # Errors
    /// [`ExperimentError::OutOfDomain`] unless all its numbers are finite, zero or more.
    pub fn with_sensor(self, sensor: Sensor) -> Result<Self, ExperimentError> {
        Ok(Self { sensor: sensor.checked()?, ..self })
    }

    /// The same experiment with other noise.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// The same experiment from another state.
    ///
    /// # Errors
    /// [`ExperimentError::OutOfDomain`] unless the state is finite.
    pub fn from_state(self, start: State<f64>) -> Result<Self, ExperimentError> {
        domain::finite("initial position", start.position, "output units")?;
        domain::finite("initial velocity", start.velocity, "output units per s")?;
        Ok(Self { start, ..self })
    }

    /// The record of `duration_s` seconds: at each sample the reading, and the command given upon it. The command starts
    /// positive.
    ///
    /// # Errors
    /// [`ExperimentError::OutOfDomain`] for a duration that is not positive or has more than
    /// [`MOST_SAMPLES`](Self::MOST_SAMPLES) samples; [`ExperimentError::TooShort`].
    pub fn run(&self, duration_s: f64) -> Result<Record, ExperimentError> {
        domain::positive("duration", duration_s, "s")?;
        let last = (duration_s * self.rate_hz + 1e-9).floor();
        let remedy = "shorten the experiment or lower the rate";
        let samples = if last < Self::MOST_SAMPLES { last + 1.0 } else { domain::three_digits(last, f64::ceil) };
        domain::require("number of samples", samples, "", Limit::AtMost(Self::MOST_SAMPLES), remedy)?;
        let mut random = Pcg64Mcg::seed_from_u64(self.seed);
        let mut relay = RelayState::new(self.relay, true);
        let mut motion = SimulatedMotion::new(self.axis, self.start, relay.output());
        if self.held {
            motion.seen_s = f64::INFINITY;
        } else {
            let half_width = self.relay.half_width();
            let remedy = "give a half-width, or hold the relay between samples";
            domain::require("half-width", half_width, "output units", Limit::Positive, remedy)?;
        }
        let (mut time, mut output, mut input) = (Vec::new(), Vec::new(), Vec::new());
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
        for sample in 0..=last as u64 {
            #[allow(clippy::cast_precision_loss, reason = "below 1e8")]
            let now = sample as f64 / self.rate_hz;
            if !self.held {
                self.watch(&mut relay, &mut motion, now);
            }
            let position = motion.at(now - self.sensor.delay_s).position;
            let reading = self.sensor.read(position, &mut random);
            if self.held {
                relay.step(-reading);
                motion.command(now + self.axis.delay_s(), relay.output());
            }
            time.push(now);
            output.push(reading);
            input.push(relay.output());
        }
        Record::new(time, output, input)
    }

    /// Switches a relay that watches all the time, up to the time `until`.
    fn watch(&self, relay: &mut RelayState<f64>, motion: &mut SimulatedMotion, until: f64) {
        let level = self.relay.half_width();
        loop {
            // The positive command lasts until x rises past the level, the negative one until it falls past it.
            let high = relay.output() > self.relay.offset();
            let target = if high { level } else { -level };
            let Some(crossing) = motion.next_crossing(target, high, until - self.sensor.delay_s) else { return };
            relay.step(if high { f64::NEG_INFINITY } else { f64::INFINITY });
            motion.command(crossing + self.sensor.delay_s + self.axis.delay_s(), relay.output());
            motion.seen_s = crossing;
        }
    }
}

impl Sensor {
    /// The same, where all its numbers are finite, zero or more.
    pub(crate) fn checked(self) -> Result<Self, OutOfDomain> {
        domain::non_negative("sensor delay", self.delay_s, "s")?;
        domain::non_negative("quantum", self.quantum, "output units")?;
        domain::non_negative("noise", self.noise, "output units")?;
        Ok(self)
    }

    /// The reading of a value: with noise, rounded.
    pub(crate) fn read(&self, value: f64, random: &mut Pcg64Mcg) -> f64 {
        let noise: f64 = StandardNormal.sample(random);
        let noisy = value + self.noise * noise;
        if self.quantum > 0.0 { (noisy / self.quantum).round() * self.quantum } else { noisy }
    }
}

/// The motion so far, and the commands on their way.
#[derive(Clone, Debug)]
pub(super) struct SimulatedMotion {
    axis: DragAxis<f64>,
    /// Beginnings of the stretches with constant command: time, state, command. The last has no end yet.
    stretches: VecDeque<(f64, State<f64>, f64)>,
    /// Up to here the relay has seen the motion.
    pub(super) seen_s: f64,
}

impl SimulatedMotion {
    pub(super) fn new(axis: DragAxis<f64>, start: State<f64>, command: f64) -> Self {
        Self { axis, stretches: VecDeque::from([(0.0, start, command)]), seen_s: 0.0 }
    }

    /// From `time_s` on, not before the last stretch begins, `command` acts.
    pub(super) fn command(&mut self, time_s: f64, command: f64) {
        let Some(&(begin, state, before)) = self.stretches.back() else { return };
        if command != before {
            let state = self.axis.advance(state, before, (time_s - begin).max(0.0));
            self.stretches.push_back((time_s.max(begin), state, command));
        }
    }

    /// The state at a time; before the start, that at the start. Forgets stretches that ended before.
    pub(super) fn at(&mut self, time_s: f64) -> State<f64> {
        while self.stretches.len() > 1 && self.stretches[1].0 <= time_s.min(self.seen_s) {
            self.stretches.pop_front();
        }
        let index = self.stretches.iter().rposition(|stretch| stretch.0 <= time_s).unwrap_or(0);
        let (begin, state, command) = self.stretches[index];
        self.axis.advance(state, command, (time_s - begin).max(0.0))
    }

    /// When the position next passes `level` after what has been seen, and not after `until`.
    fn next_crossing(&mut self, level: f64, rising: bool, until: f64) -> Option<f64> {
        let count = self.stretches.len();
        for index in 0..count {
            let (begin, state, command) = self.stretches[index];
            let end = if index + 1 < count { self.stretches[index + 1].0 } else { f64::INFINITY };
            if end <= self.seen_s {
                continue;
            }
            let from = begin.max(self.seen_s);
            let state = self.axis.advance(state, command, from - begin);
            let beyond = if rising { state.position >= level } else { state.position <= level };
            let crossing = if beyond { Some(0.0) } else { self.axis.time_to_position(state, command, level) };
            if let Some(crossing) = crossing.map(|wait| from + wait).filter(|crossing| *crossing <= end) {
                return (crossing <= until).then_some(crossing);
            }
        }
        self.seen_s = self.seen_s.max(until.min(self.stretches[count - 1].0));
        None
    }
}
