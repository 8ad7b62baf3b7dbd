//! A whole experiment: vehicle, commander, sensor, duration, and units.

use serde::Serialize;

use crate::command::Commander;
use crate::sensor::Sensor;
use crate::vehicle::Vehicle;

/// What the input column of the log holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Logged {
    /// The order.
    #[default]
    Order,
    /// The rudder behind its rate limit.
    Rudder,
}

/// An experiment to simulate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scenario {
    /// The vehicle.
    pub vehicle: Vehicle,
    /// Who gives orders.
    pub commander: Commander,
    /// Sensor and logger.
    pub sensor: Sensor,
    /// Input column.
    pub logged: Logged,
    /// Length of the record in s.
    pub duration_s: f64,
    /// The experiment runs for so long before the record begins, in s.
    pub lead_s: f64,
    /// Stamp of the beginning of the record, in s.
    pub first_stamp_s: f64,
    /// Position at the start.
    pub position: f64,
    /// Speed at the start.
    pub speed: f64,
    /// Whether the relay starts at its positive level.
    pub starts_high: bool,
}

impl Scenario {
    /// The same experiment in other units: forces and commands `force` times, outputs `output` times as large in number.
    #[must_use]
    pub fn in_units(&self, force: f64, output: f64) -> Self {
        let mut scaled = self.clone();
        let vehicle = &mut scaled.vehicle;
        let per_output = force / output;
        vehicle.alpha *= per_output;
        vehicle.drag.linear *= per_output;
        vehicle.drag.quadratic *= per_output / output;
        vehicle.drag.cubic *= per_output / (output * output);
        vehicle.drag.power *= force / output.powf(vehicle.drag.exponent);
        vehicle.drag.coulomb *= force;
        vehicle.stiffness *= per_output;
        vehicle.delta *= force;
        vehicle.memory.gain *= per_output;
        let outside = &mut vehicle.force;
        outside.sine *= force;
        outside.walk *= force;
        outside.ornstein_uhlenbeck *= force;
        outside.tether *= per_output;
        outside.anchor *= output;
        let actuator = &mut vehicle.actuator;
        actuator.rate_limit = actuator.rate_limit.map(|limit| limit * force);
        actuator.dead_zone *= force;
        actuator.reference *= force;
        match &mut scaled.commander {
            Commander::Relay { levels, half_width, centre, .. } => {
                levels.iter_mut().for_each(|(_, level)| *level *= force);
                *half_width *= output;
                *centre *= output;
            }
            Commander::Sequence { changes } => changes.iter_mut().for_each(|(_, level)| *level *= force),
        }
        let sensor = &mut scaled.sensor;
        for value in [
            &mut sensor.quantum,
            &mut sensor.grid_offset,
            &mut sensor.noise,
            &mut sensor.walk,
            &mut sensor.outlier,
            &mut sensor.turn,
            &mut scaled.position,
            &mut scaled.speed,
        ] {
            *value *= output;
        }
        scaled
    }
}
