//! The sensor and the logger: what they make of the position.

use serde::Serialize;

use crate::random::Random;

/// The sensor, the clock, and the logger. Zeros switch an imperfection off.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sensor {
    /// Samples logged in a second.
    pub rate_hz: f64,
    /// Readings, and decisions of the autopilot, for each sample logged.
    pub readings_per_sample: u32,
    /// A reading shows the position of so long before its instant, in s.
    pub latency_s: f64,
    /// Time constant of a first-order filter in the sensor, in s.
    pub filter_s: f64,
    /// Step of the rounding.
    pub quantum: f64,
    /// A value on the grid of the rounding.
    pub grid_offset: f64,
    /// Standard deviation of the noise before rounding.
    pub noise: f64,
    /// Correlation of the noise from one sample logged to the next (autoregressive, first order).
    pub noise_correlation: f64,
    /// Degrees of freedom of Student's t, for noise with heavy tails (scaled to the same standard deviation); zero for Gaussian noise.
    pub noise_freedom: u32,
    /// A wandering error: standard deviation of its change per square root of a second.
    pub walk: f64,
    /// Share of readings with an outlier.
    pub outlier_share: f64,
    /// Size of the outliers, of either sign.
    pub outlier: f64,
    /// The sensor has a value at every so-many-th reading only, and repeats it in between; 1 for a value each time.
    pub refresh_every: u32,
    /// The instants of the readings deviate from the even grid by up to this, in s, and the stamps say so.
    pub irregular_s: f64,
    /// Stamps are late by up to this at random, evenly, in s.
    pub late_s: f64,
    /// Stamps are rounded to whole multiples of this, in s.
    pub stamp_step_s: f64,
    /// Share of samples missing at random.
    pub missing_share: f64,
    /// Mean time between gaps in s, beyond the second that passes at least; zero for no gaps.
    pub gap_every_s: f64,
    /// Length of a gap in s.
    pub gap_s: f64,
    /// Readings are logged between plus and minus half of this; zero for no wrapping.
    pub turn: f64,
}

impl Default for Sensor {
    fn default() -> Self {
        Self {
            rate_hz: 10.0,
            readings_per_sample: 1,
            latency_s: 0.0,
            filter_s: 0.0,
            quantum: 0.0,
            grid_offset: 0.0,
            noise: 0.0,
            noise_correlation: 0.0,
            noise_freedom: 0,
            walk: 0.0,
            outlier_share: 0.0,
            outlier: 0.0,
            refresh_every: 1,
            irregular_s: 0.0,
            late_s: 0.0,
            stamp_step_s: 0.0,
            missing_share: 0.0,
            gap_every_s: 0.0,
            gap_s: 0.0,
            turn: 0.0,
        }
    }
}

impl Sensor {
    /// Time between readings in s.
    #[must_use]
    pub fn interval_s(&self) -> f64 {
        1.0 / (self.rate_hz * f64::from(self.readings_per_sample))
    }

    /// To the nearest value on the grid.
    #[must_use]
    pub fn round(&self, value: f64) -> f64 {
        if self.quantum == 0.0 {
            return value;
        }
        // A grid through zero gives numbers that are multiples exactly.
        let steps = ((value - self.grid_offset) / self.quantum).round();
        self.grid_offset + steps * self.quantum
    }
}

/// A sensor at work.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'a> {
    sensor: &'a Sensor,
    random: Random,
    coloured: f64,
    walk: f64,
    taken: u32,
    held: f64,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(sensor: &'a Sensor, mut random: Random) -> Self {
        let coloured = random.normal();
        Self { sensor, random, coloured, walk: 0.0, taken: 0, held: 0.0 }
    }

    /// A standard deviate of the noise.
    fn noise(&mut self) -> f64 {
        let sensor = self.sensor;
        if sensor.noise_freedom > 0 {
            let freedom = f64::from(sensor.noise_freedom);
            let squares: f64 = (0..sensor.noise_freedom).map(|_| self.random.normal().powi(2)).sum();
            return self.random.normal() / (squares / freedom).sqrt() * ((freedom - 2.0) / freedom).sqrt();
        }
        if sensor.noise_correlation == 0.0 {
            return self.random.normal();
        }
        let kept = sensor.noise_correlation.powf(1.0 / f64::from(sensor.readings_per_sample));
        self.coloured = kept * self.coloured + (1.0 - kept * kept).sqrt() * self.random.normal();
        self.coloured
    }

    /// The next reading.
    pub(crate) fn read(&mut self, position: f64) -> f64 {
        let sensor = self.sensor;
        let noise = self.noise();
        self.walk += sensor.walk * sensor.interval_s().sqrt() * self.random.normal();
        let outlier = if self.random.chance(sensor.outlier_share) { sensor.outlier * self.random.sign() } else { 0.0 };
        if self.taken.is_multiple_of(sensor.refresh_every) {
            self.held = sensor.round(position + self.walk + sensor.noise * noise + outlier);
        }
        self.taken += 1;
        self.held
    }
}

/// The logger at work: stamps, missing samples, wrapping.
#[derive(Clone, Debug)]
pub(crate) struct Logger<'a> {
    sensor: &'a Sensor,
    random: Random,
    gap_until_s: f64,
    next_gap_s: f64,
    last_stamp_s: f64,
}

impl<'a> Logger<'a> {
    pub(crate) fn new(sensor: &'a Sensor, mut random: Random) -> Self {
        let next_gap_s = Self::wait(sensor, &mut random);
        Self { sensor, random, gap_until_s: f64::NEG_INFINITY, next_gap_s, last_stamp_s: f64::NEG_INFINITY }
    }

    fn wait(sensor: &Sensor, random: &mut Random) -> f64 {
        if sensor.gap_every_s > 0.0 {
            -sensor.gap_every_s * random.uniform(f64::MIN_POSITIVE, 1.0).ln()
        } else {
            f64::INFINITY
        }
    }

    /// The stamp of a sample at a true time since the beginning of the record; `None` where it is missing.
    pub(crate) fn stamp(&mut self, time_s: f64) -> Option<f64> {
        let sensor = self.sensor;
        let late_s = sensor.late_s * self.random.uniform(0.0, 1.0);
        let missing = self.random.chance(sensor.missing_share);
        if time_s >= self.next_gap_s {
            self.gap_until_s = time_s + sensor.gap_s;
            self.next_gap_s = self.gap_until_s + 1.0 + Self::wait(sensor, &mut self.random);
        }
        let stamp_s = time_s + late_s;
        let step_s = sensor.stamp_step_s;
        let stamp_s = if step_s > 0.0 { (stamp_s / step_s).round() * step_s } else { stamp_s };
        // A stamp that repeats, or goes back, is none.
        if missing || time_s < self.gap_until_s || stamp_s <= self.last_stamp_s {
            return None;
        }
        self.last_stamp_s = stamp_s;
        Some(stamp_s)
    }

    /// The reading as it is logged.
    pub(crate) fn wrapped(&self, reading: f64) -> f64 {
        let turn = self.sensor.turn;
        if turn > 0.0 { reading - turn * (reading / turn).round() } else { reading }
    }
}
