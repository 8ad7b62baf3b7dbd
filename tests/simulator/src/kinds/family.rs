//! Kinds with terms of the model family.

use super::Entry;
use crate::plan::{DEGREE, Law, Plan};
use crate::random::Random;
use crate::vehicle::{Force, Lag, Memory, Vehicle};

fn any(r: &mut Random) -> Plan {
    Plan::new(r, Law::Any).any_sensor(r)
}

/// Errors of the readings that are rounding alone.
fn rounded(r: &mut Random, mut change: impl FnMut(&mut Vehicle)) -> Plan {
    Plan::new(r, Law::Any).rounded(1.0).with(|s| change(&mut s.vehicle))
}

fn vehicle(r: &mut Random, mut change: impl FnMut(&mut Vehicle)) -> Plan {
    any(r).with(|s| change(&mut s.vehicle))
}

fn lag(r: &mut Random, tau_s: f64) -> Plan {
    vehicle(r, |v| v.actuator.thrust = Lag::First { tau_s })
}

fn force(r: &mut Random, force: Force) -> Plan {
    vehicle(r, |v| v.force = force)
}

fn sine(r: &mut Random) -> Force {
    Force {
        sine: 0.05,
        sine_period_s: 40.0,
        sine_phase_rad: r.uniform(0.0, core::f64::consts::TAU),
        ..Force::default()
    }
}

const fn walk(walk: f64) -> Force {
    Force { walk, ..NONE }
}

const NONE: Force = Force {
    sine: 0.0,
    sine_period_s: 0.0,
    sine_phase_rad: 0.0,
    walk: 0.0,
    ornstein_uhlenbeck: 0.0,
    ornstein_uhlenbeck_time_s: 0.0,
    tether: 0.0,
    anchor: 0.0,
    anchor_time_s: 0.0,
};

const COLOURED: Force = Force { ornstein_uhlenbeck: 0.05, ornstein_uhlenbeck_time_s: 5.0, ..NONE };

pub(super) const KINDS: &[Entry] = &[
    ("lag 0.05 s", |r| lag(r, 0.05)),
    ("lag 0.1 s", |r| lag(r, 0.1)),
    ("lag 0.2 s", |r| lag(r, 0.2)),
    ("lag 0.3 s", |r| lag(r, 0.3)),
    ("lag 0.1 s, delay unknown", |r| lag(r, 0.1).delay_unknown()),
    ("lag 0.2 s, delay unknown", |r| lag(r, 0.2).delay_unknown()),
    ("lag 0.3 s, delay unknown", |r| lag(r, 0.3).delay_unknown()),
    ("rate limit 4 C/s", |r| vehicle(r, |v| v.actuator.rate_limit = Some(4.0))),
    ("rate limit 4 C/s, delay unknown", |r| vehicle(r, |v| v.actuator.rate_limit = Some(4.0)).delay_unknown()),
    ("rate limit 10 C/s", |r| vehicle(r, |v| v.actuator.rate_limit = Some(10.0))),
    ("stiffness 0.006 C/rad", |r| vehicle(r, |v| v.stiffness = 0.006)),
    ("stiffness 0.02 C/rad", |r| vehicle(r, |v| v.stiffness = 0.02)),
    ("stiffness 0.1 C/rad", |r| vehicle(r, |v| v.stiffness = 0.1)),
    ("stiffness 0.02 C/rad, delay unknown", |r| vehicle(r, |v| v.stiffness = 0.02).delay_unknown()),
    ("stiffness 0.1 C/rad, delay unknown", |r| vehicle(r, |v| v.stiffness = 0.1).delay_unknown()),
    ("linear and cubic", |r| Plan::new(r, Law::Cubic).any_sensor(r)),
    ("linear and cubic, delay unknown", |r| Plan::new(r, Law::Cubic).any_sensor(r).delay_unknown()),
    ("negative linear and cubic", |r| Plan::new(r, Law::Norrbin).any_sensor(r)),
    ("negative linear and cubic, delay unknown", |r| Plan::new(r, Law::Norrbin).any_sensor(r).delay_unknown()),
    ("current 0.05 C, 40 s", |r| {
        let current = sine(r);
        force(r, current)
    }),
    ("current 0.05 C, 40 s, delay unknown", |r| {
        let current = sine(r);
        force(r, current).delay_unknown()
    }),
    ("tether", |r| {
        let tether = Force { tether: 0.03, anchor: 60.0 * DEGREE, anchor_time_s: 20.0, ..NONE };
        force(r, tether)
    }),
    ("random-walk force 0.01", |r| force(r, walk(0.01))),
    ("random-walk force 0.05", |r| force(r, walk(0.05))),
    ("random-walk force 0.01, delay unknown", |r| force(r, walk(0.01)).delay_unknown()),
    ("Ornstein-Uhlenbeck force 0.05 C, 5 s", |r| force(r, COLOURED)),
    ("Ornstein-Uhlenbeck force 0.05 C, 5 s, delay unknown", |r| force(r, COLOURED).delay_unknown()),
    ("autoregressive noise 0.9", |r| Plan::new(r, Law::Any).noisy(0.5).with(|s| s.sensor.noise_correlation = 0.9)),
    ("autoregressive noise 0.6, delay unknown", |r| {
        Plan::new(r, Law::Any).noisy(0.5).with(|s| s.sensor.noise_correlation = 0.6).delay_unknown()
    }),
    ("heading walk 0.1 degree", |r| any(r).with(|s| s.sensor.walk = 0.1 * DEGREE)),
    ("stamps late by up to 60 ms", |r| any(r).with(|s| s.sensor.late_s = 0.06)),
    ("stamps late by up to 30 ms, delay unknown", |r| any(r).with(|s| s.sensor.late_s = 0.03).delay_unknown()),
    ("10 % missing", |r| any(r).with(|s| s.sensor.missing_share = 0.1)),
    ("30 % missing", |r| any(r).with(|s| s.sensor.missing_share = 0.3)),
    ("10 % missing, delay unknown", |r| any(r).with(|s| s.sensor.missing_share = 0.1).delay_unknown()),
    ("gaps of 0.7 s", |r| {
        any(r).with(|s| {
            s.sensor.gap_every_s = 8.0;
            s.sensor.gap_s = 0.7;
        })
    }),
    ("delay given 0 for 0.2", |r| any(r).with(|s| s.vehicle.actuator.delay_s = 0.2).delay_wrong(-0.2)),
    ("delay given 0.1 for 0.2", |r| any(r).with(|s| s.vehicle.actuator.delay_s = 0.2).delay_wrong(-0.1)),
    ("delay given 0.3 for 0.2", |r| any(r).with(|s| s.vehicle.actuator.delay_s = 0.2).delay_wrong(0.1)),
    ("heading stamped 0.1 s late", |r| any(r).with(|s| s.sensor.latency_s = 0.1).delay_wrong(-0.1)),
    ("rounding alone, stiffness 0.02 C/rad", |r| rounded(r, |v| v.stiffness = 0.02)),
    ("rounding alone, lag 0.1 s", |r| rounded(r, |v| v.actuator.thrust = Lag::First { tau_s: 0.1 })),
    ("rounding alone, linear and cubic", |r| Plan::new(r, Law::Cubic).rounded(1.0)),
    ("rounding alone, current 0.05 C, 40 s", |r| {
        let current = sine(r);
        rounded(r, |v| v.force = current)
    }),
    ("lag 0.2 s, stiffness 0.05 C/rad", |r| lag(r, 0.2).with(|s| s.vehicle.stiffness = 0.05)),
    ("lag 0.2 s, random-walk force 0.02", |r| lag(r, 0.2).with(|s| s.vehicle.force = walk(0.02))),
    ("lag 0.2 s, 10 % missing", |r| lag(r, 0.2).with(|s| s.sensor.missing_share = 0.1)),
    ("stiffness 0.05 C/rad, autoregressive noise 0.8", |r| {
        Plan::new(r, Law::Any).noisy(0.5).with(|s| {
            s.sensor.noise_correlation = 0.8;
            s.vehicle.stiffness = 0.05;
        })
    }),
    ("zig-zag, orders logged", |r| {
        let plan = any(r);
        plan.with(|s| s.vehicle.actuator.rate_limit = Some(r.uniform(1.0, 4.0)))
    }),
    ("sensor filter 0.2 s", |r| any(r).with(|s| s.sensor.filter_s = 0.2)),
    ("sensor filter 0.5 s, delay unknown", |r| any(r).with(|s| s.sensor.filter_s = 0.5).delay_unknown()),
    ("entrained water, 1 s", |r| vehicle(r, |v| v.memory = Memory { gain: 0.2 * v.alpha, time_s: 1.0 })),
    ("Coulomb friction 0.03 C", |r| vehicle(r, |v| v.drag.coulomb = 0.03)),
    ("Coulomb friction 0.1 C", |r| vehicle(r, |v| v.drag.coulomb = 0.1)),
    ("drag 10 % larger to one side", |r| vehicle(r, |v| v.drag.asymmetry = 0.05)),
    ("drag 30 % larger to one side", |r| vehicle(r, |v| v.drag.asymmetry = 0.15)),
    ("lag 0.15 s, Coulomb friction 0.05 C", |r| {
        vehicle(r, |v| {
            v.actuator.thrust = Lag::First { tau_s: 0.15 };
            v.drag.coulomb = 0.05;
        })
    }),
    ("sensor filter 0.3 s, lag 0.15 s", |r| {
        any(r).with(|s| {
            s.sensor.filter_s = 0.3;
            s.vehicle.actuator.thrust = Lag::First { tau_s: 0.15 };
        })
    }),
];
