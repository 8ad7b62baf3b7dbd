//! The critical point: from transfer functions against closed forms, from exact relay oscillations against the truth.

use std::f64::consts::{PI, TAU};

use selfosc::control::{ControlError, RelayTest, Rule, UltimatePoint, critical_point};
use selfosc::numeric::Interval;
use selfosc::orbit::{TwoLevelRelay, orbits};
use selfosc::plant::TransferFunction;

use crate::tolerance::PRINTED_TENTH;

fn process(num: &[f64], den: &[f64], delay_s: f64) -> TransferFunction {
    TransferFunction::new(num, den).unwrap().with_delay(delay_s).unwrap()
}

/// The exact oscillation of a process under a relay, as an experiment reads it.
fn experiment(process: &TransferFunction, half_width: f64) -> RelayTest<f64> {
    under_relay(process, &TwoLevelRelay::new(1.0, -1.0, half_width).unwrap())
}

/// The attracting oscillation under a relay whose levels differ by 2.
fn under_relay(process: &TransferFunction, relay: &TwoLevelRelay) -> RelayTest<f64> {
    let found = orbits(process, relay, Some(0.2..=60.0)).unwrap().orbits;
    let orbit = found.iter().find(|orbit| orbit.attracting == Some(true)).unwrap();
    let [amplitude, bias, period_s] = [orbit.amplitude(), orbit.bias(), orbit.period_s].map(Interval::midpoint);
    RelayTest { level: 1.0, half_width: relay.half_width, amplitude, bias, period_s }
}

#[test]
fn critical_points_in_closed_form() {
    let cases = [
        // (1 + jw)^n real: w = tan(pi/n), K = 1/cos(pi/n)^n.
        (process(&[1.0], &[1.0, 3.0, 3.0, 1.0], 0.0), 8.0, 3f64.sqrt()),
        (process(&[1.0], &[1.0, 4.0, 6.0, 4.0, 1.0], 0.0), 4.0, 1.0),
        (process(&[1.0], &[1.0, 0.0], 1.0), PI / 2.0, PI / 2.0),
        // 1/(s (s + 1)^2): w = 1, K = 2.
        (process(&[1.0], &[1.0, 2.0, 1.0, 0.0], 0.0), 2.0, 1.0),
    ];
    for (process, gain, omega) in cases {
        let found = critical_point(&process, 1e-3..=1e3).unwrap();
        assert!((found.gain() / gain - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.period_s() * omega / TAU - 1.0).abs() < 1e-12, "{found:?}");
    }
    let never = critical_point(&process(&[1.0], &[1.0, 1.0], 0.0), 1e-3..=1e3);
    assert!(matches!(never, Err(ControlError::NoCriticalPoint { .. })));
}

/// What ATV without hysteresis is off by, from exact oscillations. The figures of the documentation.
#[test]
fn error_of_the_describing_function() {
    let processes = [
        ("1/(s + 1)^3", process(&[1.0], &[1.0, 3.0, 3.0, 1.0], 0.0), -2.4, 1.4),
        ("1/(s + 1)^4", process(&[1.0], &[1.0, 4.0, 6.0, 4.0, 1.0], 0.0), -1.8, 0.7),
        ("exp(-s)/s", process(&[1.0], &[1.0, 0.0], 1.0), -18.9, 0.0),
        ("exp(-s)/(s + 1)", process(&[1.0], &[1.0, 1.0], 1.0), -10.9, -3.8),
        ("exp(-0.2 s)/(s (s + 1))", process(&[1.0], &[1.0, 1.0, 0.0], 0.2), -8.0, 5.5),
    ];
    for (name, process, gain_percent, period_percent) in processes {
        let truth = critical_point(&process, 1e-3..=1e3).unwrap();
        let found = experiment(&process, 0.0).ultimate().unwrap();
        let percent = |found: f64, truth: f64| 100.0 * (found / truth - 1.0);
        let (gain, period) = (percent(found.gain(), truth.gain()), percent(found.period_s(), truth.period_s()));
        println!("{name:24} K_u {gain:+.2} %, T_u {period:+.2} %");
        assert!(
            (gain - gain_percent).abs() < PRINTED_TENTH && (period - period_percent).abs() < PRINTED_TENTH,
            "{name}"
        );
    }
}

/// Hysteresis left out of account, and two experiments against it.
#[test]
fn hysteresis_is_accounted_for() {
    let process = process(&[1.0], &[1.0, 3.0, 3.0, 1.0], 0.0);
    let truth = critical_point(&process, 1e-3..=1e3).unwrap();
    let tests = [0.03, 0.06].map(|half_width| experiment(&process, half_width));
    let errors =
        |found: UltimatePoint<f64>| (found.gain() / truth.gain() - 1.0, found.period_s() / truth.period_s() - 1.0);
    let one = errors(tests[0].ultimate().unwrap());
    let both = errors(UltimatePoint::between(&tests[0].point().unwrap(), &tests[1].point().unwrap()).unwrap());
    println!("one experiment K_u {:+.3}, T_u {:+.3}; two K_u {:+.3}, T_u {:+.3}", one.0, one.1, both.0, both.1);
    assert!(both.0.abs() < 0.05 && both.1.abs() < 0.03);
    assert!(one.0.abs() > 3.0 * both.0.abs() && one.1.abs() > 3.0 * both.1.abs());
    // Each point lies near the curve itself, and the phase it has is that of the process there.
    for test in tests {
        let point = test.point().unwrap();
        let true_response = process.response(point.omega_rad_s).unwrap();
        assert!((point.magnitude / true_response.norm() - 1.0).abs() < 0.05);
        let above = (true_response.arg() + PI).rem_euclid(TAU);
        assert!((above - point.angle_above_critical).abs() < 0.05, "{above} {}", point.angle_above_critical);
    }
    assert!(matches!(
        UltimatePoint::between(&tests[0].point().unwrap(), &tests[0].point().unwrap()),
        Err(ControlError::OnePhase { .. })
    ));
}

/// A load makes the oscillation uneven: the bias in the describing function takes up most of it.
#[test]
fn bias_is_accounted_for() {
    let process = process(&[1.0], &[1.0, 3.0, 3.0, 1.0], 0.0);
    let biased = under_relay(&process, &TwoLevelRelay::new(1.4, -0.6, 0.02).unwrap());
    let truth = process.response(TAU / biased.period_s).unwrap().norm();
    let error = |test: RelayTest<f64>| test.point().unwrap().magnitude / truth - 1.0;
    let (with, without) = (error(biased), error(RelayTest { bias: 0.0, ..biased }));
    println!(
        "bias {:.3} of amplitude {:.3}: magnitude {with:+.3}, bias ignored {without:+.3}",
        biased.bias, biased.amplitude
    );
    assert!(with.abs() < without.abs());
}

#[test]
fn experiments_that_are_none() {
    let test = RelayTest { level: 1.0, half_width: 0.5, amplitude: 0.6, bias: 0.2, period_s: 3.0 };
    assert!(matches!(test.point(), Err(ControlError::BelowSwitching { .. })));
    assert!(RelayTest { level: 0.0, ..test }.point().is_err());
    assert!(RelayTest { period_s: f64::NAN, bias: 0.0, ..test }.point().is_err());
}

/// The rules in their published form, in `K_u` and `T_u`.
#[test]
fn rules_as_published() {
    let ultimate = UltimatePoint::new(10.0_f64, 4.0).unwrap();
    let published: [(Rule, f64, Option<f64>, f64); 7] = [
        (Rule::ZieglerNicholsP, 5.0, None, 0.0),
        (Rule::ZieglerNicholsPi, 4.5, Some(10.0 / 3.0), 0.0),
        (Rule::ZieglerNicholsPid, 6.0, Some(2.0), 0.5),
        (Rule::TyreusLuybenPi, 3.125, Some(8.8), 0.0),
        (Rule::TyreusLuybenPid, 10.0 / 2.2, Some(8.8), 4.0 / 6.3),
        (Rule::SomeOvershoot, 10.0 / 3.0, Some(2.0), 4.0 / 3.0),
        (Rule::NoOvershoot, 2.0, Some(2.0), 4.0 / 3.0),
    ];
    assert_eq!(published.map(|row| row.0), Rule::ALL);
    for (rule, gain, integral_s, derivative_s) in published {
        let gains = rule.gains(&ultimate).unwrap();
        assert!((gains.proportional() - gain).abs() < 1e-12, "{rule:?}");
        let expected = integral_s.map_or(0.0, |time| gain / time);
        assert!((gains.integral() - expected).abs() < 1e-12, "{rule:?}");
        assert!((gains.derivative() - gain * derivative_s).abs() < 1e-12, "{rule:?}");
    }
}
