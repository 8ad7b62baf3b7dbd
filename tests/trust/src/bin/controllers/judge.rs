//! The vehicle's own margins, and the motion of a model under a controller, by means that share nothing with the design.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use nalgebra::Complex;
use selfosc_simulator::scenario::Scenario;
use selfosc_simulator::vehicle::Lag;
use serde_json::Value;

/// A PD controller and what is stated of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Design {
    proportional: f64,
    derivative: f64,
    filter_s: f64,
    double_pole_rad_s: f64,
    /// Least phase margin over the intervals, rad; `None` where none is proved.
    pub(crate) stated_phase_rad: Option<f64>,
    /// Speeds that the margins count.
    top_speed: f64,
    /// Where the constant force leaves the axis.
    pub(crate) stated_offset: f64,
}

impl Design {
    pub(crate) fn read(found: &Value) -> Result<Self, &'static str> {
        let number = |value: &Value| value.as_f64().ok_or("a number is missing");
        let worst = &found["worst_case"];
        let (margins, top_speed) = if worst.is_null() {
            (&found["margins"], &found["verified"]["step"]["top_speed"])
        } else {
            (&worst["at_least"], &worst["top_speed"])
        };
        let gains = &found["gains"];
        Ok(Self {
            proportional: number(&gains["proportional"])?,
            derivative: number(&gains["derivative"])?,
            filter_s: number(&gains["filter_s"])?,
            double_pole_rad_s: number(&found["double_pole_rad_s"])?,
            stated_phase_rad: margins["phase_rad"].as_f64().filter(|phase| *phase > 0.0),
            top_speed: number(top_speed)?,
            stated_offset: number(&found["offset"])?,
        })
    }
}

/// The vehicle that made a record, linear about speeds.
pub(crate) struct TrueLoop<'a> {
    scenario: &'a Scenario,
    design: &'a Design,
}

/// Frequencies of the grid, their ratio, and the lowest in units of the double pole.
const FREQUENCIES: usize = 6000;
const RATIO: f64 = 1.003;
const LOWEST: f64 = 1e-4;
/// Speeds between none and the top one, either way.
const SPEEDS: i32 = 16;

impl<'a> TrueLoop<'a> {
    pub(crate) fn of(scenario: &'a Scenario, design: &'a Design) -> Self {
        Self { scenario, design }
    }

    /// The least phase margin at any speed up to the top one; below zero where a loop is not stable.
    pub(crate) fn phase_margin_rad(&self) -> f64 {
        let vehicle = &self.scenario.vehicle;
        let drift = 0.5 * vehicle.alpha_drift.abs();
        let mut least = f64::INFINITY;
        for k in -SPEEDS..=SPEEDS {
            let speed = f64::from(k) / f64::from(SPEEDS) * self.design.top_speed;
            let slope = vehicle.drag.slope(speed);
            for alpha in [vehicle.alpha * (1.0 - drift), vehicle.alpha * (1.0 + drift)] {
                least = least.min(self.margin(alpha, slope));
            }
        }
        least
    }

    /// Numerator with the delay, and denominator, at a frequency.
    fn parts(&self, alpha: f64, slope: f64, omega: f64) -> [Complex<f64>; 2] {
        let (vehicle, sensor, design) = (&self.scenario.vehicle, &self.scenario.sensor, self.design);
        let (s, one) = (Complex::new(0.0, omega), Complex::new(1.0, 0.0));
        let lag = |lag: Lag| match lag {
            Lag::None => one,
            Lag::First { tau_s } => one + s * tau_s,
            Lag::Second { omega_rad_s, zeta } => {
                one + s * (2.0 * zeta / omega_rad_s) + s * s / (omega_rad_s * omega_rad_s)
            }
        };
        let delay_s = vehicle.actuator.delay_s + sensor.latency_s;
        let filter = one + s * design.filter_s;
        let water = one + s * vehicle.memory.time_s;
        let memory = if vehicle.memory.time_s > 0.0 { vehicle.memory.gain } else { 0.0 };
        let body = (s * s * alpha + s * slope + vehicle.stiffness + vehicle.force.tether) * water + s * memory;
        let controller = filter * design.proportional + s * design.derivative;
        let below =
            body * filter * lag(vehicle.actuator.motor) * lag(vehicle.actuator.thrust) * (one + s * sensor.filter_s);
        [controller * water * (-s * delay_s).exp(), below]
    }

    /// Order of the denominator.
    fn order(&self) -> i32 {
        let (vehicle, sensor) = (&self.scenario.vehicle, &self.scenario.sensor);
        let of = |lag: Lag| match lag {
            Lag::None => 0,
            Lag::First { .. } => 1,
            Lag::Second { .. } => 2,
        };
        let first = [self.design.filter_s, vehicle.memory.time_s, sensor.filter_s];
        let first = first.iter().map(|time_s| i32::from(*time_s > 0.0)).sum::<i32>();
        2 + first + of(vehicle.actuator.motor) + of(vehicle.actuator.thrust)
    }

    fn margin(&self, alpha: f64, slope: f64) -> f64 {
        let lowest = LOWEST * self.design.double_pole_rad_s;
        let (mut turned, mut least) = (0.0, f64::INFINITY);
        let mut before: Option<[Complex<f64>; 2]> = None;
        for k in 0..FREQUENCIES {
            let omega = lowest * RATIO.powi(k as i32);
            let [above, below] = self.parts(alpha, slope, omega);
            // A stable quasi-polynomial of this order turns as (1 + j omega)^order does (argument principle).
            let scale = (Complex::new(1.0, omega / self.design.double_pole_rad_s)).powi(self.order());
            let (sum, loop_gain) = ((above + below) / scale, above / below);
            if let Some([last_sum, last_gain]) = before {
                turned += (sum / last_sum).arg();
                if (last_gain.norm() - 1.0) * (loop_gain.norm() - 1.0) <= 0.0 {
                    let angle = (-loop_gain).arg().rem_euclid(TAU);
                    least = least.min(angle.min(TAU - angle));
                }
            }
            before = Some([sum, loop_gain]);
        }
        if turned.abs() < PI { least } else { -least }
    }
}

/// An identified model under a controller, from rest, by steps of a two-thousandth of the double pole's time.
pub(crate) struct ModelMotion<'a> {
    reported: &'a Value,
    design: &'a Design,
}

impl<'a> ModelMotion<'a> {
    pub(crate) fn of(reported: &'a Value, design: &'a Design) -> Self {
        Self { reported, design }
    }

    /// Where the model comes to rest for the reference zero; `None` for dry friction, which stops it anywhere.
    pub(crate) fn offset(&self) -> Option<f64> {
        let part = |name: &str| self.reported[name]["value"].as_f64().unwrap_or(0.0);
        if part("coulomb") != 0.0 {
            return None;
        }
        let design = self.design;
        let times = [part("lag_s"), part("filter_s"), part("memory_s"), design.filter_s];
        let shortest_s = times.into_iter().filter(|time| *time > 0.0).fold(f64::INFINITY, f64::min);
        let step_s = (5e-4 / design.double_pole_rad_s).min(0.2 * shortest_s);
        let steps = (80.0 / design.double_pole_rad_s / step_s) as usize;
        let late = ((part("delay_s") + 0.5 * part("ramp_s")) / step_s).round() as usize;
        let mut under_way: VecDeque<f64> = std::iter::repeat_n(0.0, late).collect();
        let [mut x, mut v, mut water, mut force, mut seen, mut slow] = [0.0_f64; 6];
        let follow = |now: &mut f64, target: f64, time_s: f64| {
            *now = if time_s > 0.0 { *now + step_s / time_s * (target - *now) } else { target };
        };
        for _ in 0..steps {
            follow(&mut seen, x, part("filter_s"));
            let before = slow;
            follow(&mut slow, seen, design.filter_s);
            let speed = if design.filter_s > 0.0 { (slow - before) / step_s } else { v };
            under_way.push_back(-design.proportional * seen - design.derivative * speed);
            let command = under_way.pop_front().unwrap_or(0.0);
            follow(&mut force, command, part("lag_s"));
            follow(&mut water, v, part("memory_s"));
            let side = 1.0 + part("skew") * v.signum();
            let drag = side * (part("beta") + part("beta_quadratic") * v.abs() + part("beta_cubic") * v * v) * v;
            let push = force + part("delta") - drag - part("memory") * water - part("stiffness") * x;
            v += step_s * push / part("alpha");
            x += step_s * v;
        }
        Some(x)
    }
}
