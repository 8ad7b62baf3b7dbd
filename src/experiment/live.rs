//! A simulated vehicle that obeys commands as they come.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::simulation::SimulatedMotion;
use super::{ExperimentError, Sensor};
use crate::numeric::domain;
use crate::plant::{DragAxis, State};

/// An axis and its sensor, read at even times; each command holds until the next and acts after the axis' delay.
///
/// The motion is in closed form between commands. It starts at rest at zero under the command zero.
///
/// ```
/// use selfosc::experiment::{LiveVehicle, Sensor};
/// use selfosc::plant::DragAxis;
/// let mut vehicle = LiveVehicle::new(DragAxis::linear(1.0, 0.5)?, Sensor::default(), 10.0, 0)?;
/// let first = vehicle.reading();
/// vehicle.command(1.0);
/// let second = vehicle.reading();
/// assert_eq!(first, (0.0, 0.0));
/// assert!(second.0 == 0.1 && second.1 > 0.0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct LiveVehicle {
    motion: SimulatedMotion,
    sensor: Sensor,
    delay_s: f64,
    rate_hz: f64,
    random: Pcg64Mcg,
    samples: u64,
}

impl LiveVehicle {
    /// A vehicle that is read `rate_hz` times a second.
    ///
    /// # Errors
    /// [`ExperimentError::OutOfDomain`] unless the rate is positive and the sensor's numbers are finite, zero or more.
    pub fn new(axis: DragAxis<f64>, sensor: Sensor, rate_hz: f64, seed: u64) -> Result<Self, ExperimentError> {
        domain::positive("rate", rate_hz, "Hz")?;
        let sensor = sensor.checked()?;
        let delay_s = axis.delay_s() + sensor.delay_s;
        let motion = SimulatedMotion::new(axis, State { position: 0.0, velocity: 0.0 }, 0.0);
        Ok(Self { motion, sensor, delay_s, rate_hz, random: Pcg64Mcg::seed_from_u64(seed), samples: 0 })
    }

    /// Time of the next reading, s.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "exact below 2^53")]
    pub fn time_s(&self) -> f64 {
        self.samples as f64 / self.rate_hz
    }

    /// The next reading: its time in s, and the coordinate with noise, rounded.
    pub fn reading(&mut self) -> (f64, f64) {
        let now_s = self.time_s();
        self.samples += 1;
        self.motion.seen_s = now_s;
        (now_s, self.sensor.read(self.motion.at(now_s).position, &mut self.random))
    }

    /// A command given upon the last reading. One that is no finite number changes nothing.
    pub fn command(&mut self, command: f64) {
        if command.is_finite() {
            self.motion.command(self.motion.seen_s + self.delay_s, command);
        }
    }
}
