//! Kinds whose structure the model family has not.

use super::Entry;
use crate::plan::{DEGREE, Law, Plan};
use crate::random::Random;
use crate::vehicle::{Force, Lag, Vehicle};

fn any(r: &mut Random) -> Plan {
    Plan::new(r, Law::Any).any_sensor(r)
}

fn vehicle(r: &mut Random, mut change: impl FnMut(&mut Vehicle)) -> Plan {
    any(r).with(|s| change(&mut s.vehicle))
}

fn second_order(r: &mut Random, zeta: f64) -> Plan {
    vehicle(r, |v| v.actuator.thrust = Lag::Second { omega_rad_s: 12.0, zeta })
}

pub(super) const KINDS: &[Entry] = &[
    ("second-order lag, 12 rad/s, damping 0.7", |r| second_order(r, 0.7)),
    ("second-order lag, 12 rad/s, damping 0.7, delay unknown", |r| second_order(r, 0.7).delay_unknown()),
    ("two lags 0.15 s", |r| {
        vehicle(r, |v| {
            v.actuator.motor = Lag::First { tau_s: 0.15 };
            v.actuator.thrust = Lag::First { tau_s: 0.15 };
        })
    }),
    ("alpha drifts by 10 %", |r| vehicle(r, |v| v.alpha_drift = 0.1)),
    ("alpha drifts by 10 %, delay unknown", |r| vehicle(r, |v| v.alpha_drift = -0.1).delay_unknown()),
    ("thrust sags by 10 %", |r| {
        // The middle of the record has the nominal thrust.
        vehicle(r, |v| {
            v.actuator.sag = 0.1;
            v.actuator.gain_positive = 1.0 / 0.95;
            v.actuator.gain_negative = 1.0 / 0.95;
        })
    }),
    ("outliers 1 %", |r| {
        any(r).with(|s| {
            s.sensor.outlier_share = 0.01;
            s.sensor.outlier = 5.0 * DEGREE;
        })
    }),
    ("outliers 3 %, delay unknown", |r| {
        let plan = any(r).delay_unknown();
        plan.with(|s| {
            s.sensor.outlier_share = 0.03;
            s.sensor.outlier = 5.0 * DEGREE;
        })
    }),
    ("noise with heavy tails", |r| Plan::new(r, Law::Any).noisy(0.5).with(|s| s.sensor.noise_freedom = 3)),
    ("drag of power 1.5", |r| {
        vehicle(r, |v| {
            // As much force at the typical speed as the law drawn would have.
            let speed = (0.35 / v.alpha).sqrt();
            let force = v.drag.linear * speed + v.drag.quadratic * speed * speed;
            v.drag = crate::vehicle::Drag { power: force / speed.powf(1.5), exponent: 1.5, ..Default::default() };
        })
    }),
    ("waves 0.1 C, 4 s", |r| {
        let sine_phase_rad = r.uniform(0.0, core::f64::consts::TAU);
        vehicle(r, |v| v.force = Force { sine: 0.1, sine_period_s: 4.0, sine_phase_rad, ..Force::default() })
    }),
    ("sensor refreshed at 3.3 Hz", |r| any(r).with(|s| s.sensor.refresh_every = 3)),
    ("stamps to 50 ms of irregular samples", |r| {
        any(r).with(|s| {
            s.sensor.irregular_s = 0.03;
            s.sensor.stamp_step_s = 0.05;
        })
    }),
    ("outliers 1 %, stiffness 0.05 C/rad, 10 % missing", |r| {
        any(r).with(|s| {
            s.sensor.outlier_share = 0.01;
            s.sensor.outlier = 5.0 * DEGREE;
            s.sensor.missing_share = 0.1;
            s.vehicle.stiffness = 0.05;
        })
    }),
];
