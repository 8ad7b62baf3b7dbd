//! Kinds of which one level of the command cannot tell: thrust is another function of the command than the identity, and
//! every parameter comes out in its scale.

use super::Entry;
use crate::plan::{Law, Plan};

pub(super) const KINDS: &[Entry] = &[
    ("dead zone 0.15 C, one level", |r| {
        Plan::new(r, Law::Any).any_sensor(r).with(|s| s.vehicle.actuator.dead_zone = 0.15)
    }),
    ("thrust 1 : 0.8, one level", |r| {
        Plan::new(r, Law::Any).any_sensor(r).with(|s| s.vehicle.actuator.gain_negative = 0.8)
    }),
    ("thrust 0.9 of the nominal", |r| {
        Plan::new(r, Law::Any).any_sensor(r).with(|s| {
            s.vehicle.actuator.gain_positive = 0.9;
            s.vehicle.actuator.gain_negative = 0.9;
        })
    }),
];
