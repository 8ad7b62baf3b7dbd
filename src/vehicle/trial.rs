//! The experiment on board, carried out on the model with six degrees of freedom.

use super::error::WHOLE;
use crate::numeric::{Limit, domain};
use std::collections::VecDeque;

use nalgebra::Vector6;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::{Axis, BodyState, Simulation, VehicleError};
use crate::experiment::{Record, Sensor};
use crate::on_board::{Coordinate, Experiment, Phase, Protocol};

/// A relay experiment on one axis of a simulated vehicle: yaw by its heading (eq. 36), heave by its depth (eq. 43), surge and
/// sway by the integral of their speed (eq. 44).
///
/// ```
/// # use selfosc::vehicle::{Allocation, Axis, Compensation, Simulation, BodyState, Trial, pool_thrusters, pool_vehicle};
/// # use nalgebra::Vector6;
/// use selfosc::experiment::Sensor;
/// use selfosc::identify::DragLaw;
/// use selfosc::on_board::Protocol;
/// let thrusters = pool_thrusters()?;
/// let pair = [*thrusters[0].thruster(), *thrusters[1].thruster()];
/// let chain = Compensation::new(Allocation::pair(0.08)?, pair);
/// // A compass of one degree, read 0.1 s late; the thrusters are 0.1 s late too.
/// let compass = Sensor { delay_s: 0.1, quantum: 1f64.to_radians(), noise: 0.0 };
/// let protocol = Protocol { resolution: compass.quantum, ..Protocol::heading_rad(0.06, 0.3, 0.1) };
/// let pool = Simulation::new(pool_vehicle()?, thrusters.to_vec(), 0.01, BodyState::at_rest())?;
/// let run = Trial::new(Axis::Yaw, protocol, compass)?.run(
///     pool,
///     |moment, _| chain.commands(&[0.0, moment]).map(|[port, starboard]| vec![port, starboard, 0.0]),
///     |_, _| Vector6::zeros(),
/// )?;
/// let outcome = run.experiment.outcome().ok_or("not done")?;
/// let truth = pool_vehicle()?.axis(Axis::Yaw, &Vector6::zeros());
/// assert!((outcome.exact(DragLaw::Quadratic, 0.2)?.alpha() / truth.alpha - 1.0).abs() < 0.1);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    axis: Axis,
    protocol: Protocol<f64>,
    sensor: Sensor,
    seed: u64,
}

/// Result of a trial.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct TrialRun {
    /// The experiment as it ended.
    pub experiment: Experiment<f64>,
    /// What the relay saw, and the force (moment) that it asked for on the axis.
    pub time_s: Vec<f64>,
    /// Coordinate that the relay saw: heading without jumps, depth, integrated speed.
    pub position: Vec<f64>,
    /// Force or moment asked for on the axis.
    pub force: Vec<f64>,
    /// The vehicle's true state at each sample.
    pub states: Vec<BodyState>,
}

impl TrialRun {
    /// The samples as a record.
    ///
    /// # Errors
    /// Those of [`Record::new`]: too few samples.
    pub fn record(&self) -> Result<Record, crate::experiment::ExperimentError> {
        Record::new(self.time_s.clone(), self.position.clone(), self.force.clone())
    }
}

impl Trial {
    /// An experiment on an axis through a sensor of its coordinate (heading, depth) or of its speed (surge, sway), read every
    /// `protocol.interval_s`.
    ///
    /// # Errors
    /// A coordinate that is not the axis's own, a delay, step or noise of the sensor that is negative.
    pub fn new(axis: Axis, protocol: Protocol<f64>, sensor: Sensor) -> Result<Self, VehicleError> {
        let fits = match axis {
            Axis::Yaw => matches!(protocol.coordinate, Coordinate::HeadingRad | Coordinate::HeadingDegrees),
            Axis::Heave => protocol.coordinate == Coordinate::Position,
            Axis::Surge | Axis::Sway => protocol.coordinate == Coordinate::Speed,
        };
        let number = axis.index() as f64;
        let limit = Limit::Words("observed by heading (yaw), position (heave), speed (others)");
        let remedy = "give the protocol the coordinate of its axis";
        domain::require_that(fits, "axis of the trial", number, "", limit, remedy)?;
        domain::non_negative("sensor delay", sensor.delay_s, "s")?;
        domain::non_negative("quantum of the sensor", sensor.quantum, "coordinate units")?;
        domain::non_negative("noise of the sensor", sensor.noise, "coordinate units")?;
        Ok(Self { axis, protocol, sensor, seed: 0 })
    }

    /// The same trial with other noise.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Runs until the experiment has ended. `commands` turns a force (moment) on the axis into thruster commands, once for each
    /// sample; by the state it may hold the other axes. `disturbance` is `tau_E` by time and state.
    ///
    /// # Errors
    /// A protocol that is refused, a sampling interval or sensor delay that is not a whole number of the simulation's steps,
    /// and whatever commands and simulation refuse.
    pub fn run(
        &self,
        mut simulation: Simulation,
        commands: impl Fn(f64, &BodyState) -> Result<Vec<f64>, VehicleError>,
        disturbance: impl Fn(f64, &BodyState) -> Vector6<f64>,
    ) -> Result<TrialRun, VehicleError> {
        let steps = |quantity, time_s: f64| {
            let steps = time_s / simulation.step_s();
            let whole = |s: f64| (s - s.round()).abs() < 1e-6;
            let remedy = "choose an integration step that divides it";
            let checked = domain::require_that(whole(steps), quantity, steps, "integration steps", WHOLE, remedy);
            checked.map(|steps| steps.round() as usize)
        };
        let each = steps("sampling interval", self.protocol.interval_s)?.max(1);
        let late = steps("sensor delay", self.sensor.delay_s)?;
        let experiment = Experiment::new(self.protocol)?;
        let mut run =
            TrialRun { experiment, time_s: Vec::new(), position: Vec::new(), force: Vec::new(), states: Vec::new() };
        let mut random = Pcg64Mcg::seed_from_u64(self.seed);
        let mut under_way: VecDeque<f64> = std::iter::repeat_n(self.observe(simulation.state()), late + 1).collect();
        loop {
            let thrust = commands(run.experiment.command(), simulation.state())?;
            for _ in 0..if run.time_s.is_empty() { 0 } else { each } {
                let time_s = simulation.time_s();
                simulation.step(&thrust, |state| disturbance(time_s, state))?;
                under_way.push_back(self.observe(simulation.state()));
                under_way.pop_front();
            }
            let time_s = simulation.time_s();
            let force = run.experiment.command();
            let step = run.experiment.step(self.sensor.read(under_way[0], &mut random), time_s);
            run.time_s.push(time_s);
            run.position.push(run.experiment.position().unwrap_or(self.protocol.reference));
            run.states.push(*simulation.state());
            if step.phase != Phase::Running {
                // The neutral command after the end never acts on this record.
                run.force.push(force);
                return Ok(run);
            }
            run.force.push(step.command);
        }
    }

    /// What the sensor is to measure.
    fn observe(&self, state: &BodyState) -> f64 {
        match self.axis {
            Axis::Yaw => {
                let heading_rad = state.pose.attitude.euler_angles().2;
                if self.protocol.coordinate == Coordinate::HeadingDegrees {
                    heading_rad.to_degrees()
                } else {
                    heading_rad
                }
            }
            Axis::Heave => state.pose.position_m.z,
            Axis::Surge | Axis::Sway => state.nu[self.axis.index()],
        }
    }
}
