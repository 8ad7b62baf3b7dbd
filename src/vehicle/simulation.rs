//! Eq. 5 in time: thrusters with delays, a disturbance, fixed steps.

use std::collections::VecDeque;

use nalgebra::{Quaternion, SVector, Unit, UnitQuaternion, Vector3, Vector6};

use super::error::WHOLE;
use super::kinematics::joined;
use super::{Pose, Thruster, Vehicle, VehicleError};
use crate::numeric::{domain, runge_kutta};

/// A thruster at its place on the vehicle, behind a transport delay.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MountedThruster {
    thruster: Thruster<f64>,
    /// Force and moment on the vehicle of one newton of thrust.
    column: Vector6<f64>,
    delay_s: f64,
}

impl MountedThruster {
    /// A thruster at `position_m` in body axes that pushes along `direction`, `delay_s` after its command.
    ///
    /// # Errors
    /// A direction without length, a negative delay, numbers that are not finite.
    pub fn new(
        thruster: Thruster<f64>,
        position_m: Vector3<f64>,
        direction: Vector3<f64>,
        delay_s: f64,
    ) -> Result<Self, VehicleError> {
        for &coordinate in &position_m {
            domain::finite("position of a thruster", coordinate, "m")?;
        }
        domain::positive("length of a thruster's direction", direction.norm(), "")?;
        domain::non_negative("thruster delay", delay_s, "s")?;
        let direction = Unit::new_normalize(direction).into_inner();
        Ok(Self { thruster, column: joined(&direction, &position_m.cross(&direction)), delay_s })
    }

    /// The thruster.
    #[must_use]
    pub fn thruster(&self) -> &Thruster<f64> {
        &self.thruster
    }

    /// Force and moment on the vehicle of one newton of thrust: its column of the allocation matrix.
    #[must_use]
    pub fn column(&self) -> &Vector6<f64> {
        &self.column
    }
}

/// Where the vehicle is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    /// Position and attitude.
    pub pose: Pose,
    /// Velocity in body axes.
    pub nu: Vector6<f64>,
}

impl BodyState {
    /// At rest at the origin, heading north.
    #[must_use]
    pub fn at_rest() -> Self {
        Self { pose: Pose { position_m: Vector3::zeros(), attitude: UnitQuaternion::identity() }, nu: Vector6::zeros() }
    }
}

/// Position, quaternion (i, j, k, w) and velocity in one column.
type StateColumn = SVector<f64, 13>;

/// A vehicle with thrusters, advanced by the classical fourth-order Runge-Kutta method.
///
/// Commands are held over a step and act after a whole number of steps. The error of a step is of fifth order except where a
/// speed with quadratic drag reverses or the disturbance is not smooth; compare with half the step for its size.
///
/// ```
/// # use selfosc::vehicle::{Simulation, BodyState, VehicleError, pool_thrusters, pool_vehicle};
/// # use nalgebra::Vector6;
/// let mut pool = Simulation::new(pool_vehicle()?, pool_thrusters()?.to_vec(), 0.01, BodyState::at_rest())?;
/// for _ in 0..300 {
///     pool.step(&[60.0, 60.0, 0.0], |_| Vector6::zeros())?;
/// }
/// assert!(pool.state().nu[0] > 0.2); // both propellers push ahead
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Simulation {
    vehicle: Vehicle,
    thrusters: Vec<MountedThruster>,
    step_s: f64,
    /// Commands under way to each thruster, the next to act first.
    pending: Vec<VecDeque<f64>>,
    state: BodyState,
    steps: u32,
}

impl Simulation {
    /// A simulation that starts from `state` with all commands at zero.
    ///
    /// # Errors
    /// A step that is not positive, or a delay that is not a whole number of steps (to 1e-6 of a step).
    pub fn new(
        vehicle: Vehicle,
        thrusters: Vec<MountedThruster>,
        step_s: f64,
        state: BodyState,
    ) -> Result<Self, VehicleError> {
        domain::positive("integration step", step_s, "s")?;
        let pending = thrusters
            .iter()
            .map(|mounted| {
                let steps = mounted.delay_s / step_s;
                let whole = |s: f64| (s - s.round()).abs() < 1e-6;
                let remedy = "choose an integration step that divides the delay";
                domain::require_that(whole(steps), "thruster delay", steps, "integration steps", WHOLE, remedy)?;
                Ok(std::iter::repeat_n(0.0, steps.round() as usize).collect())
            })
            .collect::<Result<_, VehicleError>>()?;
        Ok(Self { vehicle, thrusters, step_s, pending, state, steps: 0 })
    }

    /// The vehicle.
    #[must_use]
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// The state now.
    #[must_use]
    pub fn state(&self) -> &BodyState {
        &self.state
    }

    /// The integration step, s.
    #[must_use]
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Time since the start, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        f64::from(self.steps) * self.step_s
    }

    /// Advances one step with these commands and a disturbance `tau_E` in body axes; returns the force of the thrusters
    /// over this step.
    ///
    /// # Errors
    /// A number of commands other than of thrusters, commands that are not finite; [`VehicleError::Diverged`].
    pub fn step(
        &mut self,
        commands: &[f64],
        disturbance: impl Fn(&BodyState) -> Vector6<f64>,
    ) -> Result<Vector6<f64>, VehicleError> {
        let (count, needed) = (commands.len(), self.thrusters.len());
        if count != needed {
            return Err(VehicleError::Count { what: "thruster commands", count, needed });
        }
        for &command in commands {
            domain::finite("thruster command", command, "command units")?;
        }
        let mut force = Vector6::zeros();
        for ((mounted, queue), &command) in self.thrusters.iter().zip(&mut self.pending).zip(commands) {
            queue.push_back(command);
            let acting = queue.pop_front().unwrap_or(command);
            force += mounted.column * mounted.thruster.thrust(acting);
        }
        let rate = |column: &StateColumn| {
            let state = unpack(column);
            let (velocity, spin) = state.pose.rate(&state.nu);
            let acceleration =
                self.vehicle.acceleration(&state.pose.attitude, &state.nu, &(force + disturbance(&state)));
            pack(&velocity, spin.as_slice(), &acceleration)
        };
        let start = pack(&self.state.pose.position_m, self.state.pose.attitude.coords.as_slice(), &self.state.nu);
        let next = StateColumn::from(runge_kutta(start.into(), self.step_s, |column| rate(&column.into()).into()));
        self.steps += 1;
        if !next.iter().all(|value| value.is_finite()) {
            return Err(VehicleError::Diverged { time_s: self.time_s(), step_s: self.step_s });
        }
        self.state = unpack(&next);
        Ok(force)
    }
}

fn pack(position: &Vector3<f64>, quaternion: &[f64], nu: &Vector6<f64>) -> StateColumn {
    StateColumn::from_iterator(position.iter().chain(quaternion).chain(nu).copied())
}

/// The quaternion comes back to unit length, from which a step moves it by the method's error only.
fn unpack(column: &StateColumn) -> BodyState {
    let quaternion = Quaternion::from(column.fixed_rows::<4>(3).into_owned());
    BodyState {
        pose: Pose {
            position_m: column.fixed_rows::<3>(0).into_owned(),
            attitude: UnitQuaternion::new_normalize(quaternion),
        },
        nu: column.fixed_rows::<6>(7).into_owned(),
    }
}
