//! The vehicle: one axis, its drag, its actuator, and the forces from outside.
//!
//! `alpha x'' + drag(x') + k x = thrust + delta + w(t)`. Every number is in the units of the scenario; zeros switch a part off.

use serde::Serialize;

use crate::integrate::Direction;

/// Drag force as a function of speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Drag {
    /// Coefficient of v, of either sign.
    pub linear: f64,
    /// Coefficient of v |v|.
    pub quadratic: f64,
    /// Coefficient of v^3.
    pub cubic: f64,
    /// Coefficient of sgn(v) |v|^exponent.
    pub power: f64,
    /// The exponent of the former.
    pub exponent: f64,
    /// Coulomb friction: a force of this size against any motion.
    pub coulomb: f64,
    /// Relative excess of the drag at positive speed over the mean of both sides (its lack at negative speed).
    pub asymmetry: f64,
}

impl Drag {
    /// The force at a speed; `direction` says of which side, where the speed itself is rounded to zero.
    #[must_use]
    pub fn force(&self, v: f64, direction: Direction) -> f64 {
        let side = direction.sign();
        let size = side * v;
        let power = if self.power == 0.0 { 0.0 } else { side * self.power * size.max(0.0).powf(self.exponent) };
        let smooth = (self.linear + self.quadratic * size + self.cubic * v * v) * v + power;
        smooth * (1.0 + self.asymmetry * side) + self.coulomb * side
    }

    /// Derivative of the force by speed, away from zero.
    #[must_use]
    pub fn slope(&self, v: f64) -> f64 {
        let power =
            if self.power == 0.0 { 0.0 } else { self.power * self.exponent * v.abs().powf(self.exponent - 1.0) };
        let slope = self.linear + 2.0 * self.quadratic * v.abs() + 3.0 * self.cubic * v * v + power;
        slope * (1.0 + self.asymmetry * v.signum())
    }
}

/// A linear lag of unit gain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lag {
    /// No lag.
    #[default]
    None,
    /// `tau y' = u - y`.
    First {
        /// The time constant in s.
        tau_s: f64,
    },
    /// `y'' = omega^2 (u - y) - 2 zeta omega y'`.
    Second {
        /// Natural angular frequency in rad/s.
        omega_rad_s: f64,
        /// Damping ratio.
        zeta: f64,
    },
}

impl Lag {
    /// What comes out.
    pub(crate) fn output(self, input: f64, state: [f64; 2]) -> f64 {
        if self == Self::None { input } else { state[0] }
    }

    /// Derivative of the state.
    pub(crate) fn derivative(self, input: f64, state: [f64; 2]) -> [f64; 2] {
        match self {
            Self::None => [0.0, 0.0],
            Self::First { tau_s } => [(input - state[0]) / tau_s, 0.0],
            Self::Second { omega_rad_s, zeta } => {
                [state[1], omega_rad_s * omega_rad_s * (input - state[0]) - 2.0 * zeta * omega_rad_s * state[1]]
            }
        }
    }
}

/// From order to thrust: rate limit, delay, lag of the motor, static characteristic, lag of the thrust, in this order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Actuator {
    /// Delay from order to actuator in s, any number of zero or more.
    pub delay_s: f64,
    /// The largest rate of the rudder in command units per s; `None` for an actuator that follows at once.
    pub rate_limit: Option<f64>,
    /// Lag before the characteristic.
    pub motor: Lag,
    /// Commands up to this size give no thrust, larger ones that much less.
    pub dead_zone: f64,
    /// Thrust over command at positive commands.
    pub gain_positive: f64,
    /// Thrust over command at negative commands.
    pub gain_negative: f64,
    /// Exponent of the thrust over the command; the gain holds at `reference`.
    pub exponent: f64,
    /// The command at which the exponent changes nothing.
    pub reference: f64,
    /// Lag behind the characteristic.
    pub thrust: Lag,
    /// Share of the thrust that is lost from the beginning of the record to its end, evenly (a battery).
    pub sag: f64,
}

impl Default for Actuator {
    fn default() -> Self {
        Self {
            delay_s: 0.0,
            rate_limit: None,
            motor: Lag::None,
            dead_zone: 0.0,
            gain_positive: 1.0,
            gain_negative: 1.0,
            exponent: 1.0,
            reference: 1.0,
            thrust: Lag::None,
            sag: 0.0,
        }
    }
}

impl Actuator {
    /// Thrust of a command, lags left out.
    #[must_use]
    pub fn characteristic(&self, command: f64) -> f64 {
        let effective = (command.abs() - self.dead_zone).max(0.0);
        let gain = if command < 0.0 { -self.gain_negative } else { self.gain_positive };
        let curved = if self.exponent == 1.0 {
            effective
        } else {
            self.reference * (effective / self.reference).powf(self.exponent)
        };
        gain * curved
    }
}

/// A force that follows the speed late: `-gain s`, `time_s s' = v - s` (entrained water, sway coupled to yaw).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Memory {
    /// Force per lagged speed.
    pub gain: f64,
    /// Time constant of the lag in s; zero for no such force.
    pub time_s: f64,
}

/// Forces that change with time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Force {
    /// Amplitude of a sine.
    pub sine: f64,
    /// Its period in s.
    pub sine_period_s: f64,
    /// Its phase at time zero in rad.
    pub sine_phase_rad: f64,
    /// A random walk: standard deviation of its change per square root of a second.
    pub walk: f64,
    /// An Ornstein-Uhlenbeck force: its stationary standard deviation.
    pub ornstein_uhlenbeck: f64,
    /// Its correlation time in s.
    pub ornstein_uhlenbeck_time_s: f64,
    /// A tether: force per distance from its anchor.
    pub tether: f64,
    /// Standard deviation of the anchor's wandering.
    pub anchor: f64,
    /// Correlation time of the wandering in s.
    pub anchor_time_s: f64,
}

/// Everything about the vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Vehicle {
    /// Inertia with added mass, in the middle of the record.
    pub alpha: f64,
    /// Relative change of the inertia from the beginning of the record to its end, evenly.
    pub alpha_drift: f64,
    /// Drag.
    pub drag: Drag,
    /// Restoring force per output, about zero.
    pub stiffness: f64,
    /// Constant force.
    pub delta: f64,
    /// Force that follows the speed late.
    pub memory: Memory,
    /// Forces that change with time.
    pub force: Force,
    /// Actuator.
    pub actuator: Actuator,
}

impl Default for Vehicle {
    fn default() -> Self {
        Self {
            alpha: 1.0,
            alpha_drift: 0.0,
            drag: Drag::default(),
            stiffness: 0.0,
            delta: 0.0,
            memory: Memory::default(),
            force: Force::default(),
            actuator: Actuator::default(),
        }
    }
}

/// Places of the state: position, speed, lags, lagged speed, filtered position.
pub(crate) const STATES: usize = 8;
/// The state of vehicle and sensor filter.
pub(crate) type State = [f64; STATES];
/// Position.
pub(crate) const POSITION: usize = 0;
/// Speed.
pub(crate) const SPEED: usize = 1;
const MOTOR: usize = 2;
const THRUST: usize = 4;
const MEMORY: usize = 6;
/// Output of the sensor's filter.
pub(crate) const FILTER: usize = 7;

/// What acts at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Acting {
    /// Command behind rate limit and delay.
    pub(crate) command: f64,
    /// Force from outside, the constant one left out.
    pub(crate) force: f64,
    /// Part of the record that has passed, from 0 to 1.
    pub(crate) elapsed: f64,
}

impl Vehicle {
    /// The state at a position and speed, the lags settled on a command.
    pub(crate) fn settled(&self, position: f64, speed: f64, command: f64) -> State {
        let thrust = self.actuator.characteristic(command);
        [position, speed, command, 0.0, thrust, 0.0, speed, position]
    }

    /// Sum of all forces but drag.
    fn push(&self, state: &State, acting: &Acting) -> f64 {
        let actuator = &self.actuator;
        let motor = actuator.motor.output(acting.command, [state[MOTOR], state[MOTOR + 1]]);
        let thrust = actuator.thrust.output(actuator.characteristic(motor), [state[THRUST], state[THRUST + 1]]);
        let memory = if self.memory.time_s > 0.0 { self.memory.gain * state[MEMORY] } else { 0.0 };
        let restoring = (self.stiffness + self.force.tether) * state[POSITION];
        thrust * (1.0 - actuator.sag * acting.elapsed) + self.delta + acting.force - restoring - memory
    }

    /// Which way a vehicle at rest sets off: nowhere, while Coulomb friction holds it.
    pub(crate) fn departure(&self, state: &State, acting: &Acting) -> Direction {
        let push = self.push(state, acting);
        if self.drag.coulomb > 0.0 && push.abs() <= self.drag.coulomb { Direction::Held } else { Direction::of(push) }
    }

    /// Derivative of the state, moving in a known direction.
    pub(crate) fn derivative(&self, state: &State, direction: Direction, acting: &Acting, filter_s: f64) -> State {
        let actuator = &self.actuator;
        let motor_state = [state[MOTOR], state[MOTOR + 1]];
        let motor = actuator.motor.output(acting.command, motor_state);
        let motor_rate = actuator.motor.derivative(acting.command, motor_state);
        let characteristic = actuator.characteristic(motor);
        let thrust_rate = actuator.thrust.derivative(characteristic, [state[THRUST], state[THRUST + 1]]);
        let speed = if direction == Direction::Held { 0.0 } else { state[SPEED] };
        let alpha = self.alpha * (1.0 + self.alpha_drift * (acting.elapsed - 0.5));
        let acceleration = if direction == Direction::Held {
            0.0
        } else {
            (self.push(state, acting) - self.drag.force(speed, direction)) / alpha
        };
        let memory = if self.memory.time_s > 0.0 { (speed - state[MEMORY]) / self.memory.time_s } else { 0.0 };
        let filter = if filter_s > 0.0 { (state[POSITION] - state[FILTER]) / filter_s } else { 0.0 };
        let [motor, motor_speed] = motor_rate;
        let [thrust, thrust_speed] = thrust_rate;
        [speed, acceleration, motor, motor_speed, thrust, thrust_speed, memory, filter]
    }
}
