//! Kinds inside the plain model.

use super::Entry;
use crate::command::Commander;
use crate::plan::{DEGREE, Law, Plan, Wanted};
use crate::random::Random;
use crate::scenario::Logged;

/// Every law, 0.1 to 2 degrees, 5 to 20 Hz, 20 to 60 s: a record that is its own bound of errors.
fn rounding_alone(r: &mut Random) -> Plan {
    let law = r.pick(&[Law::Linear, Law::Quadratic, Law::Mixed, Law::Unstable]);
    let (degrees, rate_hz, duration_s) = (r.log_uniform(0.1, 2.0), r.pick(&[5.0, 10.0, 20.0]), r.uniform(20.0, 60.0));
    Plan::new(r, law).rounded(degrees).with(|s| {
        s.sensor.rate_hz = rate_hz;
        s.duration_s = duration_s;
    })
}

/// Without a constant force a relay sampled on rounded readings ends in cycles that repeat sample for sample: both halves last
/// the same whole number of samples, and nothing drifts.
fn locked(r: &mut Random) -> Plan {
    let plan = Plan::new(r, Law::Any).rounded(1.0).with(|s| {
        s.lead_s = 20.0;
        s.vehicle.delta = 0.0;
    });
    Plan { wanted: Wanted::Locked, ..plan }
}

pub(super) const KINDS: &[Entry] = &[
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
    ("locked cycles", locked),
    ("locked cycles, delay unknown", |r| locked(r).delay_unknown()),
    ("partly locked cycles", |r| {
        let delta = r.uniform(-0.005, 0.005);
        Plan { wanted: Wanted::Any, ..locked(r) }.with(|s| s.vehicle.delta = delta)
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
    ("rounding alone", rounding_alone),
    ("rounding alone, 280 s", |r| rounding_alone(r).with(|s| s.duration_s = 280.0)),
    ("rounding alone, delay unknown", |r| rounding_alone(r).delay_unknown()),
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
