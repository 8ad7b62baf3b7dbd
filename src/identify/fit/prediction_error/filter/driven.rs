//! Direct effect of a parameter on the motion within a step.

use super::transition::LateSpeed;
use crate::identify::fit::prediction_error::actuator::Force;
use crate::identify::fit::prediction_error::model::Parameter;
use crate::identify::fit::prediction_error::motion::{Dynamics, MotionStep, Point};

/// A step, and its inputs.
pub(super) struct Drives<'a> {
    pub(super) dynamics: &'a Dynamics,
    pub(super) step: &'a MotionStep,
    pub(super) begin: &'a Point,
    pub(super) forces: &'a [Force; 3],
    pub(super) late: Option<LateSpeed>,
    /// Factor of the drag by the late speed.
    pub(super) memory: f64,
    pub(super) h_s: f64,
}

impl Drives<'_> {
    /// Derivatives, by the parameter, of position and velocity at the end of the step, and of the position half-way.
    pub(super) fn by(&self, parameter: Parameter) -> [f64; 3] {
        if matches!(parameter, Parameter::FilterS | Parameter::PauseS | Parameter::Position | Parameter::Velocity) {
            return [0.0; 3];
        }
        let Self { dynamics, step, begin, forces, late, memory, h_s } = self;
        let late = |k: usize| late.map_or((0.0, 0.0), |late| (late.values[k], late.by_time[k]));
        let by = |point: &Point, force: &Force, (late, late_by_time): (f64, f64)| {
            let side = 1.0 + dynamics.skew * point.velocity.signum();
            match parameter {
                Parameter::Alpha => -point.acceleration,
                Parameter::LinearDrag => -side * point.velocity,
                Parameter::QuadraticDrag => -side * point.velocity * point.velocity.abs(),
                Parameter::CubicDrag => -side * point.velocity.powi(3),
                Parameter::Skew => -dynamics.even_drag(point.velocity.abs()),
                Parameter::Stiffness => -point.position,
                Parameter::Memory => -late,
                Parameter::MemoryS => -memory * late_by_time,
                Parameter::Disturbance => 1.0,
                Parameter::DelayS => force.by_delay,
                Parameter::LagS => force.by_lag,
                Parameter::RampS => force.by_ramp,
                Parameter::FilterS | Parameter::PauseS | Parameter::Position | Parameter::Velocity => 0.0,
            }
        };
        let per_alpha = 1.0 / dynamics.alpha;
        let [first, second, third] = [(*begin, 0), (&step.middle, 1), (&step.end, 2)]
            .map(|(point, k)| by(point, &forces[k], late(k)) * per_alpha);
        [
            step.begin_weight[0] * first + step.middle_weight[0] * second,
            step.begin_weight[1] * first + step.middle_weight[1] * second + step.end_weight * third,
            0.25 * h_s * h_s * (first / 3.0 + second / 6.0),
        ]
    }
}
