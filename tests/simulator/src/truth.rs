//! What is true of a record, in the words of the model family, and what a tool is told.

use serde::Serialize;

use crate::experiment::Run;
use crate::scenario::Logged;
use crate::vehicle::Lag;

/// True parameters. `None` where the vehicle's structure gives the parameter no single meaning.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Truth {
    /// Inertia with added mass; in the middle of the record, if it drifts.
    pub alpha: f64,
    /// Linear drag, the mean of both sides.
    pub beta: f64,
    /// Quadratic drag, the mean of both sides.
    pub beta_quadratic: f64,
    /// Cubic drag.
    pub beta_cubic: f64,
    /// Restoring force per output, a tether's included.
    pub stiffness: f64,
    /// Time constant of the actuator in s; `None` for a lag of higher order.
    pub lag_s: Option<f64>,
    /// Largest rate of an actuator whose rate is limited behind the logged input.
    pub rate_limit: Option<f64>,
    /// Constant force; `None` where the force changes with time.
    pub delta: Option<f64>,
    /// Delay of the whole loop in s: of the actuator and of the reading.
    pub delay_s: f64,
}

impl Truth {
    /// The truth of a run.
    #[must_use]
    pub fn of(run: &Run) -> Self {
        let (vehicle, sensor) = (&run.scenario.vehicle, &run.scenario.sensor);
        let (drag, actuator, force) = (&vehicle.drag, &vehicle.actuator, &vehicle.force);
        let lag_s = match (actuator.motor, actuator.thrust) {
            (Lag::None, Lag::None) => Some(0.0),
            (Lag::First { tau_s }, Lag::None) | (Lag::None, Lag::First { tau_s }) => Some(tau_s),
            _ => None,
        };
        let steady = force.sine == 0.0 && force.walk == 0.0 && force.ornstein_uhlenbeck == 0.0 && force.anchor == 0.0;
        Self {
            alpha: vehicle.alpha,
            beta: drag.linear,
            beta_quadratic: drag.quadratic,
            beta_cubic: drag.cubic,
            stiffness: vehicle.stiffness + force.tether,
            lag_s,
            rate_limit: actuator.rate_limit.filter(|_| run.scenario.logged == Logged::Order),
            delta: steady.then_some(vehicle.delta),
            delay_s: actuator.delay_s + sensor.latency_s,
        }
    }
}

/// What a tool is told beside the records. It is never told the drag law, the terms, or the sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Known {
    /// The delay of the loop in s as the user believes it, right or wrong; `None` if it is to be estimated.
    pub delay_s: Option<f64>,
    /// Readings jump by this much where they wrap; `None` if they do not wrap.
    pub turn: Option<f64>,
}
