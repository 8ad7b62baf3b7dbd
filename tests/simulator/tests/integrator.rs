//! The integrator against closed forms that share no code with it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use nalgebra::{DMatrix, DVector};
use selfosc_simulator::command::Commander;
use selfosc_simulator::experiment::Run;
use selfosc_simulator::scenario::{Logged, Scenario};
use selfosc_simulator::sensor::Sensor;
use selfosc_simulator::vehicle::{Actuator, Drag, Force, Lag, Memory, Vehicle};

/// The error of a step of 2 ms over some ten seconds, in units near one, with room for a factor of a hundred.
const TOLERANCE: f64 = 1e-9;

/// From rest at zero under orders given in advance, a perfect sensor.
fn scenario(vehicle: Vehicle, changes: &[(f64, f64)]) -> Scenario {
    Scenario {
        vehicle,
        commander: Commander::Sequence { changes: changes.to_vec() },
        sensor: Sensor::default(),
        logged: Logged::Order,
        duration_s: 12.0,
        lead_s: 0.0,
        first_stamp_s: 0.0,
        position: 0.0,
        speed: 0.0,
        starts_high: true,
    }
}

fn compare(run: &Run, position: impl Fn(f64) -> f64, tolerance: f64) {
    for (time_s, output) in run.record.time_s.iter().zip(&run.record.output) {
        let expected = position(*time_s);
        assert!((output - expected).abs() < tolerance, "at {time_s} s: {output} for {expected}");
    }
}

#[test]
fn linear_drag() {
    let (alpha, beta, force) = (1.7, 0.6, 0.8);
    let drag = Drag { linear: beta, ..Drag::default() };
    let run = scenario(Vehicle { alpha, drag, delta: -0.2, ..Vehicle::default() }, &[(0.0, 1.0)]).run(1);
    let tau = alpha / beta;
    compare(&run, |t| force / beta * (t - tau * (1.0 - (-t / tau).exp())), TOLERANCE);
}

#[test]
fn quadratic_drag() {
    let (alpha, beta) = (0.8, 1.3_f64);
    let drag = Drag { quadratic: beta, ..Drag::default() };
    let run = scenario(Vehicle { alpha, drag, ..Vehicle::default() }, &[(0.0, -1.0)]).run(1);
    let rate = beta.sqrt() / alpha;
    compare(&run, |t| -alpha / beta * (rate * t).cosh().ln(), TOLERANCE);
}

/// Coasting: `v' = -(b v + c v^3)/alpha` has `v^-2 = (v0^-2 + c/b) exp(2 b t/alpha) - c/b`.
#[test]
fn cubic_drag_of_either_sign_of_the_linear_part() {
    for linear in [0.5, -0.2] {
        let (alpha, cubic, speed) = (1.2, 0.7, 0.4_f64);
        let drag = Drag { linear, cubic, ..Drag::default() };
        let coasting = Vehicle { alpha, drag, ..Vehicle::default() };
        let run = Scenario { speed, ..scenario(coasting, &[(0.0, 0.0)]) }.run(1);
        for (time_s, moving) in run.record.time_s.iter().zip(&run.speed) {
            let ratio = cubic / linear;
            let inverse_square = (speed.powi(-2) + ratio) * (2.0 * linear * time_s / alpha).exp() - ratio;
            let expected = inverse_square.powf(-0.5);
            assert!((moving - expected).abs() < TOLERANCE, "at {time_s} s: {moving} for {expected}");
        }
    }
}

#[test]
fn energy_of_a_spring_is_kept() {
    let vehicle = Vehicle { alpha: 1.3, stiffness: 2.1, ..Vehicle::default() };
    let run = Scenario { position: 0.5, duration_s: 60.0, ..scenario(vehicle, &[(0.0, 0.0)]) }.run(1);
    for (position, speed) in run.position.iter().zip(&run.speed) {
        let energy = 0.5 * (1.3 * speed * speed + 2.1 * position * position);
        assert!((energy - 0.5 * 2.1 * 0.25).abs() < TOLERANCE, "{energy}");
    }
}

/// `v` falls evenly at `force/alpha` until the vehicle stands, and it stays.
#[test]
fn coulomb_friction_stops_and_holds() {
    let (friction, speed, alpha) = (0.3, 0.7, 1.4);
    let drag = Drag { coulomb: friction, ..Drag::default() };
    let stopping = Vehicle { alpha, drag, delta: 0.1, ..Vehicle::default() };
    let run = Scenario { speed: -speed, ..scenario(stopping, &[(0.0, 0.0)]) }.run(1);
    let rate = (friction + 0.1) / alpha;
    let end_s = speed / rate;
    compare(
        &run,
        |t| {
            let t = t.min(end_s);
            -speed * t + 0.5 * rate * t * t
        },
        TOLERANCE,
    );
    assert_eq!(run.speed.last(), Some(&0.0));
}

/// Uneven drag: half the drag on one side, half as much again on the other, each in closed form.
#[test]
fn drag_of_each_side() {
    for direction in [1.0, -1.0] {
        let drag = Drag { linear: 0.8, asymmetry: 0.5, ..Drag::default() };
        let run = scenario(Vehicle { drag, ..Vehicle::default() }, &[(0.0, direction)]).run(1);
        let beta = 0.8 * (1.0 + 0.5 * direction);
        compare(&run, |t| direction / beta * (t - (1.0 - (-beta * t).exp()) / beta), TOLERANCE);
    }
}

#[test]
fn drag_of_a_power_has_its_terminal_speed() {
    let drag = Drag { power: 0.9, exponent: 1.5, ..Drag::default() };
    let run = Scenario { duration_s: 60.0, ..scenario(Vehicle { drag, ..Vehicle::default() }, &[(0.0, -1.0)]) }.run(1);
    let expected = -(1.0_f64 / 0.9).powf(1.0 / 1.5);
    assert!((run.speed.last().unwrap() - expected).abs() < TOLERANCE);
}

/// Inertia that changes evenly: `v = F/(alpha r) ln(1 + r t)` with the relative rate r.
#[test]
fn inertia_drifts_and_thrust_sags() {
    let (start, end) = (0.95, 1.05);
    let vehicle = Vehicle { alpha_drift: 0.1, ..Vehicle::default() };
    let run = scenario(vehicle, &[(0.0, 1.0)]).run(1);
    let rate = (end - start) / (12.0 * start);
    for (time_s, speed) in run.record.time_s.iter().zip(&run.speed) {
        assert!((speed - (1.0 + rate * time_s).ln() / (start * rate)).abs() < TOLERANCE);
    }
    let actuator = Actuator { sag: 0.12, ..Actuator::default() };
    let run = scenario(Vehicle { actuator, ..Vehicle::default() }, &[(0.0, 1.0)]).run(1);
    compare(&run, |t| t * t / 2.0 - 0.01 * t.powi(3) / 6.0, TOLERANCE);
}

#[test]
fn forces_that_change_with_time() {
    let force = Force { sine: 0.3, sine_period_s: 5.0, sine_phase_rad: 0.4, ..Force::default() };
    let run = scenario(Vehicle { force, ..Vehicle::default() }, &[(0.0, 0.0)]).run(1);
    let omega = core::f64::consts::TAU / 5.0;
    let expected =
        |t: f64| 0.3 / (omega * omega) * ((0.4_f64).sin() + omega * t * (0.4_f64).cos() - (omega * t + 0.4).sin());
    compare(&run, expected, TOLERANCE);
}

/// Order to ramp to thrust: delay, rate, and dead zone in closed form, piece by piece.
#[test]
fn rate_limit_and_delay() {
    for delay_s in [0.0, 0.2, 1.0 / 3.0, 0.123_456_789, core::f64::consts::FRAC_1_SQRT_2] {
        let actuator = Actuator { delay_s, rate_limit: Some(0.5), ..Actuator::default() };
        let run = scenario(Vehicle { actuator, ..Vehicle::default() }, &[(0.0, 0.0), (1.0, 0.8)]).run(1);
        let ramp_s = 0.8 / 0.5;
        let expected = |t: f64| {
            let t = t - 1.0 - delay_s;
            let (within, beyond) = (t.clamp(0.0, ramp_s), (t - ramp_s).max(0.0));
            let speed = 0.25 * ramp_s * ramp_s;
            0.5 * within.powi(3) / 6.0 + if beyond > 0.0 { speed * beyond + 0.4 * beyond * beyond } else { 0.0 }
        };
        compare(&run, expected, TOLERANCE);
    }
}

#[test]
fn an_order_that_changes_on_the_way_turns_the_rudder_there() {
    let actuator = Actuator { rate_limit: Some(1.0), ..Actuator::default() };
    let changes = [(0.0, 0.0), (1.0, 1.0), (1.5, -1.0)];
    let scenario =
        Scenario { logged: Logged::Rudder, ..scenario(Vehicle { actuator, ..Vehicle::default() }, &changes) };
    let run = scenario.run(1);
    for (time_s, rudder) in run.record.time_s.iter().zip(&run.record.input) {
        let expected = if *time_s < 1.5 { (time_s - 1.0).clamp(0.0, 0.5) } else { (2.0 - time_s).max(-1.0) };
        assert!((rudder - expected).abs() < 1e-12, "at {time_s} s: {rudder} for {expected}");
    }
}

#[test]
fn static_characteristic() {
    let actuator =
        Actuator { dead_zone: 0.2, gain_negative: 0.5, exponent: 2.0, reference: 0.8, ..Actuator::default() };
    assert!((actuator.characteristic(1.0) - 0.8).abs() < 1e-15);
    assert!((actuator.characteristic(0.6) - 0.2).abs() < 1e-15);
    assert!((actuator.characteristic(-1.0) + 0.4).abs() < 1e-15);
    assert_eq!(actuator.characteristic(0.2), 0.0);
    assert_eq!(actuator.characteristic(-0.1), 0.0);
}

#[test]
fn first_and_second_order_lag() {
    let lags = [Lag::First { tau_s: 0.3 }, Lag::Second { omega_rad_s: 4.0, zeta: 0.5 }];
    for (place, lag) in [(0, lags[0]), (1, lags[0]), (0, lags[1]), (1, lags[1])] {
        let mut actuator = Actuator::default();
        *(if place == 0 { &mut actuator.motor } else { &mut actuator.thrust }) = lag;
        // The lags start settled on the first order, zero.
        let run = scenario(Vehicle { actuator, ..Vehicle::default() }, &[(0.0, 0.0), (1.0, 1.0)]).run(1);
        for (time_s, speed) in run.record.time_s.iter().zip(&run.speed) {
            let t = (time_s - 1.0).max(0.0);
            // Integrals of the step responses.
            let expected = match lag {
                Lag::First { tau_s } => t - tau_s * (1.0 - (-t / tau_s).exp()),
                Lag::Second { omega_rad_s, zeta } => {
                    let root = (1.0 - zeta * zeta).sqrt();
                    let (damping, damped) = (zeta * omega_rad_s, omega_rad_s * root);
                    let decay = (-damping * t).exp();
                    let (sine, cosine) = (damped * t).sin_cos();
                    // Integral of exp(-damping t) (cos + damping/damped sin).
                    let square = omega_rad_s * omega_rad_s;
                    let ringing = decay * (-2.0 * damping * cosine + (damped - damping * damping / damped) * sine);
                    t - (2.0 * damping + ringing) / square
                }
                Lag::None => t,
            };
            assert!((speed - expected).abs() < TOLERANCE, "{lag:?} at {time_s} s: {speed} for {expected}");
        }
    }
}

/// Every linear part at once against the exponential of a matrix that is written down anew.
#[test]
fn linear_parts_together() {
    let (alpha, beta, k, gain, memory_s, tau_s, filter_s) = (1.4, 0.3, 0.5, 0.6, 0.9, 0.25, 0.35);
    let (omega, zeta) = (5.0, 0.6);
    let vehicle = Vehicle {
        alpha,
        drag: Drag { linear: beta, ..Drag::default() },
        stiffness: k,
        memory: Memory { gain, time_s: memory_s },
        actuator: Actuator {
            motor: Lag::Second { omega_rad_s: omega, zeta },
            thrust: Lag::First { tau_s },
            ..Actuator::default()
        },
        ..Vehicle::default()
    };
    let sensor = Sensor { filter_s, ..Sensor::default() };
    let run = Scenario { sensor, ..scenario(vehicle, &[(0.0, 0.0), (1.0, 1.0)]) }.run(1);
    // x, v, motor, its rate, thrust, lagged speed, filter; the last column is the order.
    #[rustfmt::skip]
    let system = DMatrix::from_row_slice(8, 8, &[
        0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        -k / alpha, -beta / alpha, 0.0, 0.0, 1.0 / alpha, -gain / alpha, 0.0, 0.0,
        0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, -omega * omega, -2.0 * zeta * omega, 0.0, 0.0, 0.0, omega * omega,
        0.0, 0.0, 1.0 / tau_s, 0.0, -1.0 / tau_s, 0.0, 0.0, 0.0,
        0.0, 1.0 / memory_s, 0.0, 0.0, 0.0, -1.0 / memory_s, 0.0, 0.0,
        1.0 / filter_s, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0 / filter_s, 0.0,
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ]);
    let start = DVector::from_fn(8, |row, _| if row == 7 { 1.0 } else { 0.0 });
    compare(
        &run,
        |t| {
            let state = (&system * (t - 1.0).max(0.0)).exp() * &start;
            state[6]
        },
        TOLERANCE,
    );
}

/// A relay that watches all the time.
fn ideal(vehicle: Vehicle, half_width: f64) -> Run {
    let commander = Commander::Relay { levels: vec![(0.0, 1.0)], half_width, centre: 0.0, ideal: true };
    let sensor = Sensor { rate_hz: 500.0, ..Sensor::default() };
    Scenario { commander, sensor, duration_s: 300.0, ..scenario(vehicle, &[]) }.run(1)
}

/// Period between the last two upward switchings, from the command's history, and the largest position between samples.
fn period_s(run: &Run) -> f64 {
    let segments = run.history.segments();
    let last = segments.len() - 1;
    segments[last].begin_s - segments[last - 2].begin_s
}

/// The largest output of the last cycles, by a parabola through the three samples about it.
fn amplitude(run: &Run) -> f64 {
    let output = &run.record.output[run.record.output.len() / 2..];
    let top = (1..output.len() - 1).max_by(|i, j| output[*i].total_cmp(&output[*j])).unwrap();
    let [left, middle, right] = [output[top - 1], output[top], output[top + 1]];
    middle - (right - left).powi(2) / (8.0 * (right - 2.0 * middle + left))
}

/// Half-cycle map of the switching speed under quadratic drag: `y = sqrt(1 - exp(-4 g))`.
#[test]
fn relay_cycle_under_quadratic_drag() {
    for (alpha, beta, level) in [(1.0, 0.5, 0.3), (0.6, 2.0, 0.4), (2.2, 0.3, 0.2)] {
        let drag = Drag { quadratic: beta, ..Drag::default() };
        let run = ideal(Vehicle { alpha, drag, ..Vehicle::default() }, level);
        let g: f64 = beta * level / alpha;
        let y = (1.0 - (-4.0 * g).exp()).sqrt();
        let expected_s = 2.0 * alpha / beta.sqrt() * (y.sqrt().atan() + y.sqrt().atanh());
        assert!((period_s(&run) - expected_s).abs() < 1e-8, "{} for {expected_s}", period_s(&run));
        let top = level + alpha / (2.0 * beta) * y.ln_1p();
        assert!((amplitude(&run) - top).abs() < 1e-8, "{} for {top}", amplitude(&run));
    }
}

#[test]
fn relay_cycle_under_linear_drag() {
    let (alpha, beta, level) = (1.3, 0.9, 0.35);
    let drag = Drag { linear: beta, ..Drag::default() };
    let run = ideal(Vehicle { alpha, drag, ..Vehicle::default() }, level);
    let g = level * beta * beta / alpha;
    // z - tanh z = g by bisection.
    let (mut low, mut high) = (0.0_f64, 10.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle - middle.tanh() < g { low = middle } else { high = middle }
    }
    let expected_s = 4.0 * alpha * low / beta;
    assert!((period_s(&run) - expected_s).abs() < 1e-8, "{} for {expected_s}", period_s(&run));
    let top = level + alpha / (beta * beta) * (low.tanh() - low.tanh().ln_1p());
    assert!((amplitude(&run) - top).abs() < 1e-8, "{} for {top}", amplitude(&run));
}

/// With a delay the cycle is the one of a wider relay: the place reached so long after the level is passed.
#[test]
fn relay_cycle_with_a_delay() {
    let (alpha, beta, level, delay_s) = (1.0, 0.8_f64, 0.3, 0.15);
    let drag = Drag { quadratic: beta, ..Drag::default() };
    let actuator = Actuator { delay_s, ..Actuator::default() };
    let run = ideal(Vehicle { alpha, drag, actuator, ..Vehicle::default() }, level);
    let rate = beta.sqrt() / alpha;
    let root = |wide: f64| (1.0 - (-4.0 * beta * wide / alpha).exp()).sqrt().sqrt();
    let before = |wide: f64| {
        let t = root(wide).atanh() / rate;
        wide - alpha / beta * ((rate * t).cosh() / (rate * (t - delay_s)).cosh()).ln()
    };
    let (mut low, mut high) = (level, level + 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if before(middle) < level { low = middle } else { high = middle }
    }
    let expected_s = 2.0 * alpha / beta.sqrt() * (root(low).atan() + root(low).atanh());
    assert!((period_s(&run) - expected_s).abs() < 1e-8, "{} for {expected_s}", period_s(&run));
}

#[test]
fn a_latency_of_the_sensor_shifts_what_is_read() {
    let drag = Drag { quadratic: 0.5, ..Drag::default() };
    let plain = scenario(Vehicle { drag, ..Vehicle::default() }, &[(0.0, 1.0)]);
    let late = Scenario { sensor: Sensor { latency_s: 0.13, ..plain.sensor }, ..plain.clone() };
    // Orders act upon the reading, which is 0.13 s old: the first stamp is 0.13 s behind the start.
    let (plain, late) = (plain.run(1), late.run(1));
    for (a, b) in plain.record.output.iter().zip(&late.record.output) {
        assert!((a - b).abs() < TOLERANCE);
    }
}

#[test]
fn half_the_step_gives_the_same_record() {
    for kind in selfosc_simulator::kinds::Kind::all() {
        for run in kind.case(5).runs {
            let fine = run.scenario.run_in_steps(run.seed, 0.001);
            let scale = run.position.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            for (a, b) in run.position.iter().zip(&fine.position) {
                assert!((a - b).abs() < 1e-6 * scale, "{}: {a} and {b}", kind.name);
            }
        }
    }
}
