//! A depth step in six degrees of freedom: vertical thruster with dead zone and delay, buoyancy as disturbance, rough
//! sensor.

use nalgebra::Vector6;
use selfosc::control::{Answer, Controller, Structure, Tuning};
use selfosc::plant::DragAxis;
use selfosc::vehicle::{Axis, BodyState, Simulation, pool_thrusters, pool_vehicle};

const INTERVAL_S: f64 = 0.1;
const STEP_M: f64 = 2.0;
/// Half a centimetre of it.
const READING: f64 = 0.0025;

/// A step of the depth, read to a centimetre at 10 Hz.
fn dive(mut controller: Controller<f64>) -> Answer {
    let thrusters = pool_thrusters().unwrap();
    let vertical = *thrusters[2].thruster();
    let mut pool = Simulation::new(pool_vehicle().unwrap(), thrusters.to_vec(), 0.01, BodyState::at_rest()).unwrap();
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

/// With the axis known to the 5 % that an experiment is held to, I-PD settles the depth and carries the buoyancy; PD
/// leaves the depth that buoyancy over the proportional gain makes, half a reading more or less.
#[test]
fn depth_step_with_the_identified_axis() {
    let truth = pool_vehicle().unwrap().axis(Axis::Heave, &Vector6::zeros());
    let near = DragAxis::mixed(1.05 * truth.alpha, 0.95 * truth.linear_drag, 1.05 * truth.quadratic_drag).unwrap();
    // The thruster's delay and half the hold.
    let axis = near.with_delay_s(0.15).unwrap();
    let tuned = |structure| Tuning::new(&axis, structure, 0.5).unwrap();
    let dive = |tuning: &Tuning<f64>| dive(Controller::new(tuning.gains()).with_limits(-2.5, 2.5).unwrap());
    let with_integral = dive(&tuned(Structure::Ipd));
    println!("I-PD {with_integral:?}");
    assert!(with_integral.settling_s.is_some_and(|time| time < 15.0) && with_integral.overshoot_percent < 5.0);
    assert!(with_integral.final_error.abs() < READING);
    let pd = tuned(Structure::Pd);
    let left = truth.disturbance / pd.gains().proportional() / STEP_M;
    let without = dive(&pd);
    println!("PD {without:?}, expected to leave {left:.4}");
    assert!((without.final_error - left).abs() < READING && left.abs() > 3.0 * READING);
}
