//! Kinds inside the plain model.

use crate::command::Commander;
use crate::plan::{DEGREE, Law, Plan, Wanted};
use crate::random::Random;
use crate::scenario::Logged;

pub(super) const KINDS: &[(&str, fn(&mut Random) -> Plan)] = &[
    ("linear, 1 degree", |r| Plan::new(r, Law::Linear).rounded(1.0)),
    ("linear, noise", |r| Plan::new(r, Law::Linear).noisy(0.5)),
    ("linear, noise, delay unknown", |r| Plan::new(r, Law::Linear).noisy(0.5).delay_unknown()),
    ("quadratic, 1 degree", |r| Plan::new(r, Law::Quadratic).rounded(1.0)),
    ("quadratic, 1 degree, delay unknown", |r| Plan::new(r, Law::Quadratic).rounded(1.0).delay_unknown()),
    ("quadratic, noise", |r| Plan::new(r, Law::Quadratic).noisy(0.5)),
    ("quadratic, noise, delay unknown", |r| Plan::new(r, Law::Quadratic).noisy(0.5).delay_unknown()),
    ("mixed, 1 degree", |r| Plan::new(r, Law::Mixed).rounded(1.0)),
    ("mixed, 1 degree, delay unknown", |r| Plan::new(r, Law::Mixed).rounded(1.0).delay_unknown()),
    ("mixed, noise", |r| Plan::new(r, Law::Mixed).noisy(0.5)),
    ("mixed, noise, delay unknown", |r| Plan::new(r, Law::Mixed).noisy(0.5).delay_unknown()),
    ("mixed, linear part 1 to 8 %", |r| Plan::new(r, Law::MinorLinear).any_sensor(r)),
    ("mixed, quadratic part 1 to 8 %", |r| Plan::new(r, Law::MinorQuadratic).any_sensor(r)),
    ("negative linear and quadratic", |r| Plan::new(r, Law::Unstable).any_sensor(r)),
    ("negative linear and quadratic, delay unknown", |r| Plan::new(r, Law::Unstable).any_sensor(r).delay_unknown()),
    ("0.1 degree", |r| Plan::new(r, Law::Any).rounded(0.1)),
    ("2 degrees", |r| Plan::new(r, Law::Any).rounded(2.0)),
    ("1 degree with noise 0.3, grid offset", |r| {
        let plan = Plan::new(r, Law::Any).rounded(1.0).noisy(0.3);
        plan.with(|s| s.sensor.grid_offset = r.uniform(0.0, 1.0) * DEGREE)
    }),
    ("5 Hz", |r| Plan::new(r, Law::Any).any_sensor(r).with(|s| s.sensor.rate_hz = 5.0)),
    ("20 Hz", |r| Plan::new(r, Law::Any).any_sensor(r).with(|s| s.sensor.rate_hz = 20.0)),
    ("20 s", |r| Plan::new(r, Law::Any).any_sensor(r).with(|s| s.duration_s = 20.0)),
    ("200 s", |r| Plan::new(r, Law::Any).any_sensor(r).with(|s| s.duration_s = 200.0)),
    ("locked cycles", |r| {
        let plan = Plan::new(r, Law::Any).rounded(1.0).with(|s| s.lead_s = 20.0);
        Plan { wanted: Wanted::Locked, ..plan }
    }),
    ("locked cycles, delay unknown", |r| {
        let plan = Plan::new(r, Law::Any).rounded(1.0).delay_unknown().with(|s| s.lead_s = 20.0);
        Plan { wanted: Wanted::Locked, ..plan }
    }),
    ("ideal relay", |r| {
        Plan::new(r, Law::Any).any_sensor(r).with(|s| {
            if let Commander::Relay { ideal, .. } = &mut s.commander {
                *ideal = true;
            }
        })
    }),
    ("relay at 50 Hz, log at 10 Hz", |r| {
        Plan::new(r, Law::Any).any_sensor(r).with(|s| s.sensor.readings_per_sample = 5)
    }),
    ("strong constant force", |r| {
        let plan = Plan::new(r, Law::Any).any_sensor(r);
        plan.with(|s| s.vehicle.delta = r.sign() * r.uniform(0.3, 0.5))
    }),
    ("two levels in one record", |r| {
        let plan = Plan::new(r, Law::Any).any_sensor(r);
        plan.with(|s| s.relay(|levels, _| levels.push((30.0, 0.5))))
    }),
    ("pseudo-random binary command", |r| {
        let plan = Plan::new(r, Law::Any).any_sensor(r);
        plan.with(|s| s.sequence(r, &[-1.0, 1.0], (0.4, 2.5)))
    }),
    ("steps of several levels", |r| {
        let plan = Plan::new(r, Law::Any).any_sensor(r);
        plan.with(|s| s.sequence(r, &[-1.0, -0.6, -0.3, 0.3, 0.6, 1.0], (1.0, 3.0)))
    }),
    ("zig-zag, rudder logged", |r| {
        let plan = Plan::new(r, Law::Any).any_sensor(r);
        plan.with(|s| {
            s.vehicle.actuator.rate_limit = Some(r.uniform(1.0, 4.0));
            s.logged = Logged::Rudder;
        })
    }),
    ("irregular samples", |r| Plan::new(r, Law::Any).any_sensor(r).with(|s| s.sensor.irregular_s = 0.03)),
    ("wrapped heading", |r| {
        let plan = Plan::new(r, Law::Any).any_sensor(r);
        plan.with(|s| {
            s.sensor.turn = 360.0 * DEGREE;
            if let Commander::Relay { centre, .. } = &mut s.commander {
                *centre = r.uniform(160.0, 200.0) * DEGREE;
                s.position += *centre;
            }
        })
    }),
];
