//! Cases of two or three records.
//!
//! Where thrust is not the command, alpha is the one in units of the nominal thrust: the mean of both sides, unit slope beyond
//! a dead zone, the larger level's thrust under an exponent.

use super::Entry;
use crate::plan::{Law, Plan};
use crate::random::Random;
use crate::scenario::Scenario;

fn any(r: &mut Random) -> Plan {
    Plan::new(r, Law::Any).any_sensor(r)
}

/// The relay at another level and half-width.
fn at(level: f64, half_width: f64) -> impl FnOnce(&mut Scenario) {
    move |s| {
        s.relay(|levels, width| {
            *levels = vec![(0.0, level)];
            *width *= half_width;
        });
    }
}

/// Two vehicles whose inertia differs by this ratio.
fn apart(r: &mut Random, ratio: f64) -> Plan {
    any(r).again(r, |s| s.vehicle.alpha *= ratio)
}

pub(super) const KINDS: &[Entry] = &[
    ("two records", |r| any(r).again(r, |_| ())),
    ("two records of two levels", |r| any(r).again(r, at(0.5, 0.8))),
    ("two records of two levels, delay unknown", |r| any(r).again(r, at(0.5, 0.8)).delay_unknown()),
    ("three records, one with late stamps", |r| any(r).again(r, at(1.0, 0.7)).again(r, |s| s.sensor.late_s = 0.03)),
    ("lag 0.2 s, two half-widths", |r| {
        let lag = crate::vehicle::Lag::First { tau_s: 0.2 };
        any(r).with(|s| s.vehicle.actuator.thrust = lag).again(r, at(1.0, 0.6))
    }),
    ("dead zone 0.15 C, two levels", |r| any(r).with(|s| s.vehicle.actuator.dead_zone = 0.15).again(r, at(0.5, 0.8))),
    ("thrust 1 : 0.8 about the nominal, two levels", |r| {
        let plan = any(r).with(|s| {
            s.vehicle.actuator.gain_positive = 1.0 / 0.9;
            s.vehicle.actuator.gain_negative = 0.8 / 0.9;
        });
        plan.again(r, at(0.5, 0.8))
    }),
    ("thrust exponent 1.5, two levels", |r| any(r).with(|s| s.vehicle.actuator.exponent = 1.5).again(r, at(0.5, 0.8))),
    ("dead zone 0.15 C, three levels", |r| {
        any(r).with(|s| s.vehicle.actuator.dead_zone = 0.15).again(r, at(0.5, 0.8)).again(r, at(0.25, 0.6))
    }),
    ("thrust exponent 1.5, three levels", |r| {
        any(r).with(|s| s.vehicle.actuator.exponent = 1.5).again(r, at(0.5, 0.8)).again(r, at(0.25, 0.6))
    }),
    ("drag 30 % larger to one side, forces to both", |r| {
        let plan = any(r).with(|s| {
            s.vehicle.drag.asymmetry = 0.15;
            s.vehicle.delta = 0.3;
        });
        plan.again(r, |s| s.vehicle.delta = -0.3)
    }),
    ("two vehicles, 15 % apart, two levels", |r| {
        any(r).again(r, |s| {
            s.vehicle.alpha *= 1.15;
            at(0.5, 0.8)(s);
        })
    }),
    ("two vehicles, 2 % apart", |r| apart(r, 1.02)),
    ("two vehicles, 5 % apart", |r| apart(r, 1.05)),
    ("two vehicles, 15 % apart", |r| apart(r, 1.15)),
];
