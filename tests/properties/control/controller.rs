//! What runs: circle, limits, integral, filter, faults.

use std::f64::consts::TAU;

use proptest::prelude::*;
use selfosc::control::{
    Answer, AxisModel, ControlFault, Controller, FeedForward, Gains, StepResponse, Structure, Tuning,
};
use selfosc::plant::DragAxis;

use crate::sampling::{recorded, seeded};
use crate::tolerance::{self, ROUNDING_MARGIN, SINGLE};

fn gains(structure: Structure) -> Gains<f64> {
    let integral = if structure == Structure::Pd { 0.0 } else { 0.3 };
    Gains::new(structure, 1.2, integral, 0.8, 0.05).unwrap()
}

const STRUCTURES: [Structure; 3] = [Structure::Pd, Structure::Pid, Structure::Ipd];

/// Whatever comes in, what goes out is a number within the limits.
#[test]
fn never_leaves_its_limits() {
    fn holds(samples: Vec<(f64, f64, f64)>, bits: Vec<(u64, u64, u64)>) -> bool {
        let wild = bits.iter().map(|(a, b, c)| (f64::from_bits(*a), f64::from_bits(*b), f64::from_bits(*c)));
        let axis = DragAxis::mixed(1.0, 0.2, 0.3).unwrap();
        STRUCTURES.iter().all(|structure| {
            let feed_forward = FeedForward::new(&axis, 1.0, Some(2.0)).unwrap();
            let plain = Controller::new(&gains(*structure)).with_limits(-0.7, 0.4).unwrap();
            let all = plain.on_circle(TAU).unwrap().with_feed_forward(feed_forward);
            [plain, all].iter_mut().all(|controller| {
                samples.iter().copied().chain(wild.clone()).chain(samples.iter().map(|s| (s.0, s.1, 0.1))).all(
                    |(r, x, dt)| {
                        let step = controller.step(r, x, dt);
                        let usable = r.is_finite() && x.is_finite() && dt.is_finite() && dt > 0.0;
                        (-0.7..=0.4).contains(&step.command) && (usable || step.fault.is_some())
                    },
                )
            })
        })
    }
    seeded().quickcheck(holds as fn(_, _) -> bool);
}

proptest! {
    #![proptest_config(recorded(128))]

    #[test]
    fn whole_turns_change_nothing(
        path in prop::collection::vec((-3.0..3.0_f64, -3.0..3.0_f64, -4..4_i32, -4..4_i32), 2..40),
        which in 0..3_usize,
    ) {
        let mut plain = Controller::new(&gains(STRUCTURES[which])).on_circle(TAU).unwrap();
        let mut turned = plain;
        for (reference, measurement, a, b) in path {
            let expected = plain.step(reference, measurement, 0.1).command;
            let shifted = turned.step(reference + f64::from(a) * TAU, measurement + f64::from(b) * TAU, 0.1).command;
            // An error of just half a turn may go either way.
            prop_assume!(((reference - measurement).rem_euclid(TAU) - TAU / 2.0).abs() > 1e-9);
            prop_assert!((shifted - expected).abs() < 1e3 * ROUNDING_MARGIN * (1.0 + expected.abs()), "{} {}", shifted, expected);
        }
    }

    /// From rest on the reference, PID and I-PD are the same to a disturbance: one loop.
    #[test]
    fn a_disturbance_meets_one_loop(path in prop::collection::vec(-3.0..3.0_f64, 2..60)) {
        let mut pair = [Structure::Pid, Structure::Ipd].map(|structure| Controller::new(&gains(structure)));
        for measurement in [0.0].into_iter().chain(path) {
            let [pid, ipd] = pair.each_mut().map(|controller| controller.step(0.0, measurement, 0.1).command);
            prop_assert!((pid - ipd).abs() < 1e2 * ROUNDING_MARGIN * (1.0 + pid.abs()), "{} {}", pid, ipd);
        }
    }

    #[test]
    fn single_precision_agrees(path in prop::collection::vec(-1.0..1.0_f32, 2..60)) {
        let wide = gains(Structure::Pid);
        let narrow = Gains::new(Structure::Pid, 1.2_f32, 0.3, 0.8, 0.05).unwrap();
        let (mut wide, mut narrow) = (Controller::new(&wide), Controller::new(&narrow));
        for measurement in path {
            let expected = wide.step(0.5, f64::from(measurement), 0.125).command;
            let found = f64::from(narrow.step(0.5, measurement, 0.125).command);
            prop_assert!((found - expected).abs() < SINGLE * 20.0, "{} {}", found, expected);
        }
    }
}

/// Term by term against the textbook's difference equations on a short path.
#[test]
fn difference_equations() {
    let (kp, ki, kd, tau, dt) = (1.2, 0.3, 0.8, 0.05, 0.1);
    let path = [0.0, 0.1, 0.25, 0.3, 0.28];
    let mut controller = Controller::new(&gains(Structure::Pid));
    let (mut integral, mut speed) = (0.0, 0.0);
    for (k, x) in path.iter().enumerate() {
        let raw = if k == 0 { 0.0 } else { (x - path[k - 1]) / dt };
        // Backward Euler of tau v' + v = raw.
        speed = (tau * speed + dt * raw) / (tau + dt);
        integral += ki * (1.0 - x) * dt;
        let expected = kp * (1.0 - x) + integral - kd * speed;
        assert!((controller.step(1.0, *x, dt).command - expected).abs() < 1e-14);
    }
}

/// The answer of an axis with every smooth term is that of its equations by the midpoint rule, two hundred steps a sample.
#[test]
fn further_terms_are_simulated() {
    let model = AxisModel {
        alpha: 1.0,
        beta: 0.4,
        beta_quadratic: 0.5,
        beta_cubic: 0.2,
        skew: 0.1,
        stiffness: 0.3,
        memory: 0.2,
        memory_s: 1.5,
        lag_s: 0.3,
        ramp_s: 0.2,
        pause_s: 0.12,
        filter_s: 0.25,
        delta: 0.05,
        delay_s: 0.34,
        ..AxisModel::default()
    };
    let (controller, dt_s, steps) = (Controller::new(&gains(Structure::Pd)), 0.02, 200);
    let response = StepResponse::simulate(model, controller, 1.0, 1.0 / dt_s, 12.0).unwrap();
    let rates = |[x, v, late, force, _]: [f64; 5], read: f64, command: f64| {
        let drag = (1.0 + 0.1 * v.signum()) * (0.4 + 0.5 * v.abs() + 0.2 * v * v) * v;
        let acceleration = force + 0.05 - drag - 0.2 * late - 0.3 * x;
        [v, acceleration, (v - late) / 1.5, (command - force) / 0.3, (x - read) / 0.25]
    };
    // The delay, half of the ramp and half of the pause are 0.5 s: twenty-five samples.
    let (mut controller, mut state, mut commands, mut farthest) = (controller, [0.0; 5], vec![0.0; 25], 0.0_f64);
    for output in response.output() {
        farthest = farthest.max((state[0] - output).abs());
        commands.push(controller.step(1.0, state[4], dt_s).command);
        let command = commands[commands.len() - 26];
        for _ in 0..steps {
            let h_s = dt_s / f64::from(steps);
            let along = |rates: [f64; 5], h_s: f64| core::array::from_fn(|k| state[k] + h_s * rates[k]);
            let middle: [f64; 5] = along(rates(state, state[4], command), 0.5 * h_s);
            state = along(rates(middle, middle[4], command), h_s);
        }
    }
    assert!(farthest < tolerance::ANOTHER_RULE, "{farthest}");
}

/// A step with a limit that holds for long: an integral that winds up overshoots, one led back does not.
#[test]
fn the_integral_does_not_wind_up() {
    let axis = DragAxis::linear(1.0, 0.4).unwrap().with_delay_s(0.1).unwrap();
    let tuning = Tuning::new(&axis, Structure::Pid, 0.8).unwrap();
    let limited = Controller::new(tuning.gains()).with_limits(-0.5, 0.5).unwrap();
    let led_back = StepResponse::simulate(&axis, limited, 10.0, 50.0, 120.0).unwrap();
    assert!(led_back.command().iter().all(|command| command.abs() <= 0.5));
    // The same with the limit behind the controller's back.
    let mut unaware = Controller::new(tuning.gains());
    let (mut state, mut output, mut under_way) =
        (selfosc::plant::State { position: 0.0, velocity: 0.0 }, Vec::new(), [0.0; 5]);
    for _ in 0..6000 {
        output.push(state.position);
        let command = unaware.step(10.0, state.position, 0.02).command.clamp(-0.5, 0.5);
        state = axis.advance(state, under_way[0], 0.02);
        under_way.rotate_left(1);
        under_way[4] = command;
    }
    let wound_up = Answer::of(led_back.time_s(), &output, 0.0, 10.0);
    let (better, worse) = (led_back.answer().overshoot_percent, wound_up.overshoot_percent);
    println!("overshoot led back {better:.1} %, wound up {worse:.1} %");
    assert!(better < 0.5 * worse, "{better} {worse}");
    assert!(led_back.answer().final_error.abs() < 1e-3);
}

/// The integral removes a constant disturbance; PD alone leaves `delta/K_p`; feed-forward of a known one removes it.
#[test]
fn constant_disturbance() {
    let known = DragAxis::mixed(1.0, 0.4, 0.2).unwrap();
    let pushed = known.with_disturbance(0.3).unwrap();
    for structure in STRUCTURES {
        let tuning = Tuning::new(&known, structure, 0.6).unwrap();
        let plain = Controller::new(tuning.gains());
        let end =
            |controller| StepResponse::simulate(&pushed, controller, 1.0, 100.0, 300.0).unwrap().answer().final_error;
        let expected = if structure == Structure::Pd { 0.3 / tuning.gains().proportional() } else { 0.0 };
        assert!((end(plain) - expected).abs() < 1e-9, "{structure:?} {}", end(plain));
        let feed_forward = FeedForward::new(&pushed, tuning.double_pole_rad_s(), None).unwrap();
        assert!(end(plain.with_feed_forward(feed_forward)).abs() < 1e-9);
    }
}

/// With the right model, feed-forward alone leads along the reference: feedback has next to nothing to do.
#[test]
fn feed_forward_follows_the_reference_model() {
    let axis = DragAxis::mixed(1.0, 0.4, 2.0).unwrap();
    let tuning = Tuning::new(&axis, Structure::Pd, 0.6).unwrap();
    let w = tuning.double_pole_rad_s();
    let error = |axis_known: &DragAxis<f64>| {
        let feed_forward = FeedForward::new(axis_known, w, None).unwrap();
        let controller = Controller::new(tuning.gains()).with_feed_forward(feed_forward);
        let response = StepResponse::simulate(&axis, controller, 1.0, 1000.0, 20.0).unwrap();
        // A double pole's answer to a step.
        let model = |t: f64| 1.0 - (1.0 + w * t) * (-w * t).exp();
        response.time_s().iter().zip(response.output()).map(|(t, x)| (x - model(*t)).abs()).fold(0.0, f64::max)
    };
    let (right, wrong) = (error(&axis), error(&DragAxis::linear(1.0, 0.4).unwrap()));
    println!("largest distance from the reference model {right:.1e}, without quadratic drag {wrong:.1e}");
    assert!(right < 2e-3 && wrong > 10.0 * right, "{right} {wrong}");
}

#[test]
fn a_top_speed_is_kept() {
    let axis = DragAxis::mixed(1.0, 0.4, 2.0).unwrap();
    let tuning = Tuning::new(&axis, Structure::Pd, 0.6).unwrap();
    let feed_forward = FeedForward::new(&axis, 1.0, Some(0.2)).unwrap();
    let controller = Controller::new(tuning.gains()).with_feed_forward(feed_forward);
    let response = StepResponse::simulate(&axis, controller, 4.0, 200.0, 60.0).unwrap();
    assert!(response.top_speed() < 0.21);
    assert!(response.answer().overshoot_percent < 0.1 && response.answer().settling_s.unwrap() > 18.0);
}

#[test]
fn faults_are_named_and_hold_the_command() {
    let mut controller = Controller::new(&gains(Structure::Pid));
    let good = controller.step(1.0, 0.0, 0.1);
    assert_eq!(good.fault, None);
    let before = controller;
    for (reference, measurement, dt, fault) in [
        (1.0, f64::NAN, 0.1, ControlFault::Measurement),
        (f64::INFINITY, 0.0, 0.1, ControlFault::Reference),
        (1.0, 0.0, 0.0, ControlFault::Interval),
        (1.0, 0.0, -0.1, ControlFault::Interval),
        (f64::MAX, -f64::MAX, 0.1, ControlFault::Overflow),
    ] {
        let step = controller.step(reference, measurement, dt);
        assert_eq!((step.command, step.fault), (good.command, Some(fault)));
    }
    // Measurement, reference and overflow lasted 0.1 s each, and so, for want of another number, did the two bad intervals.
    let mut waited = before;
    let (late, expected) = (controller.step(1.0, 0.02, 0.1), waited.step(1.0, 0.02, 0.6));
    assert!((late.command - expected.command).abs() < ROUNDING_MARGIN, "{late:?} {expected:?}");
}

/// At constant speed along a moving reference, readings are lost and come back: the command is the undisturbed one's.
#[test]
fn lost_readings_do_not_multiply_the_speed() {
    for structure in STRUCTURES {
        for lost in [1, 5, 20] {
            let mut undisturbed = Controller::new(&gains(structure));
            let mut disturbed = undisturbed;
            let (speed, dt_s) = (0.3, 0.1);
            let mut last = (0.0, 0.0);
            for sample in 0..80 {
                let measurement = speed * dt_s * f64::from(sample);
                let reference = measurement + 0.5;
                let seen = if (50..50 + lost).contains(&sample) { f64::NAN } else { measurement };
                last = (
                    undisturbed.step(reference, measurement, dt_s).command,
                    disturbed.step(reference, seen, dt_s).command,
                );
                if sample == 50 + lost {
                    assert!((last.1 / last.0 - 1.0).abs() < 0.05, "{structure:?} after {lost}: {last:?}");
                }
            }
            assert!((last.1 / last.0 - 1.0).abs() < 0.05, "{structure:?} at the end: {last:?}");
        }
    }
}

/// A hold is as long as chosen, in f32 too; then the command is neutral, and the next start is one.
#[test]
fn a_hold_ends_at_the_neutral_command() {
    fn ends<T: selfosc::numeric::Scalar>() {
        let number = T::from_f64;
        let gains = Gains::new(Structure::Pid, number(1.0), number(0.5), number(0.5), number(0.125)).unwrap();
        let fresh = Controller::new(&gains).with_longest_hold(number(0.5), number(0.25)).unwrap();
        for (reference, measurement, dt) in
            [(1.0, f64::NAN, 0.125), (f64::INFINITY, 0.0, 0.125), (1.0, 0.0, f64::NAN), (1.0, 0.0, -1.0)]
        {
            let mut controller = fresh;
            let held = controller.step(number(1.0), number(0.0), number(0.125)).command;
            for sample in 1..=20 {
                let command = controller.step(number(reference), number(measurement), number(dt)).command;
                assert_eq!(command, if sample <= 4 { held } else { number(0.25) });
            }
            let mut anew = fresh;
            let again = [&mut controller, &mut anew].map(|it| it.step(number(1.0), number(3.0), number(0.125)).command);
            assert_eq!(again[0], again[1]);
        }
        assert!(Controller::new(&gains).with_longest_hold(number(-1.0), T::zero()).is_err());
        assert!(Controller::new(&gains).with_longest_hold(T::zero(), number(f64::NAN)).is_err());
    }
    ends::<f32>();
    ends::<f64>();
}
