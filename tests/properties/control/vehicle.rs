//! A depth step in six degrees of freedom: vertical thruster with dead zone and delay, buoyancy as disturbance, rough sensor.

use nalgebra::Vector6;
use selfosc::control::{Answer, Controller, Structure, Tuning};
use selfosc::plant::DragAxis;
use selfosc::vehicle::{Axis, Simulation, State, pool_thrusters, pool_vehicle};

const INTERVAL_S: f64 = 0.1;
const STEP_M: f64 = 2.0;

/// A step of the depth, read to a centimetre at 10 Hz.
fn dive(mut controller: Controller<f64>) -> Answer {
    let thrusters = pool_thrusters().unwrap();
    let vertical = *thrusters[2].thruster();
    let mut pool = Simulation::new(pool_vehicle().unwrap(), thrusters.to_vec(), 0.01, State::at_rest()).unwrap();
    let (mut time_s, mut depth_m) = (Vec::new(), Vec::new());
    for sample in 0..600 {
        let depth = pool.state().pose.position_m.z;
        time_s.push(f64::from(sample) * INTERVAL_S);
        depth_m.push(depth);
        let reading = (depth * 100.0).round() / 100.0;
        let force = controller.step(STEP_M, reading, INTERVAL_S).command;
        let command = vertical.command_clamped(force).unwrap().command;
        for _ in 0..10 {
            pool.step(&[0.0, 0.0, command], |_| Vector6::zeros()).unwrap();
        }
    }
    Answer::of(&time_s, &depth_m, 0.0, STEP_M)
}

/// Identified within the 5 % that an experiment is held to, I-PD settles the depth and carries the buoyancy; a guess of a third of the inertia
/// that knows nothing of drag and delay does not settle.
#[test]
fn depth_step_with_the_identified_axis() {
    let truth = pool_vehicle().unwrap().axis(Axis::Heave, &Vector6::zeros());
    let within_5_percent =
        DragAxis::mixed(1.05 * truth.alpha, 0.95 * truth.linear_drag, 1.05 * truth.quadratic_drag).unwrap();
    // The thruster's delay and half the hold.
    let axis = within_5_percent.with_delay_s(0.15).unwrap();
    let tuning = Tuning::new(&axis, Structure::Ipd, 0.5).unwrap();
    let tuned = dive(Controller::new(tuning.gains()).with_limits(-2.5, 2.5).unwrap());
    let guess = DragAxis::linear(3.0 * truth.alpha, 0.0).unwrap();
    let guessed = Tuning::new(&guess, Structure::Ipd, 1.5).unwrap();
    let guessed = dive(Controller::new(guessed.gains()).with_limits(-2.5, 2.5).unwrap());
    println!("tuned {tuned:?}\nguessed {guessed:?}");
    assert!(tuned.settling_s.is_some_and(|time| time < 20.0) && tuned.overshoot_percent < 5.0, "{tuned:?}");
    assert!(tuned.final_error.abs() < 0.02);
    assert!(guessed.settling_s.is_none_or(|time| time > 2.0 * tuned.settling_s.unwrap()), "{guessed:?}");
}
