//! Eq. 5 in time.

use nalgebra::{Vector3, Vector6};
use proptest::prelude::*;
use selfosc::vehicle::{
    BodyState, MountedThruster, Pose, STANDARD_GRAVITY, Simulation, Thruster, Vehicle, VehicleError, VehicleParameters,
    pool_thrusters, pool_vehicle,
};

use super::bodies::{angles, parameters, potential_energy_j, vector6};
use crate::tolerance::ENERGY_BALANCE;

const STEP_S: f64 = 2.5e-4;

/// Energy now, and the power that comes in from thrusters and disturbance less what drag takes.
fn energy_and_power(simulation: &Simulation, tau: &Vector6<f64>) -> (f64, f64, f64) {
    let (vehicle, state) = (simulation.vehicle(), simulation.state());
    let potential = potential_energy_j(vehicle, state.pose.position_m.z, &state.pose.attitude);
    let (nu, drag) = (&state.nu, vehicle.drag(&state.nu) * state.nu);
    (vehicle.kinetic_energy_j(nu) + potential, nu.dot(tau), -nu.dot(&drag))
}

/// Simpson's rule over equally spaced values, an odd number of them.
fn simpson(values: &[f64]) -> f64 {
    let weight = |i: usize| {
        if i == 0 || i == values.len() - 1 {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    values.iter().enumerate().map(|(i, value)| weight(i) * value).sum::<f64>() * STEP_S / 3.0
}

fn start(angles: selfosc::vehicle::EulerAngles, nu: Vector6<f64>) -> BodyState {
    BodyState { pose: Pose::new(Vector3::new(0.0, 0.0, 1.0), angles), nu }
}

proptest! {
    #![proptest_config(crate::sampling::recorded(24))]

    #[test]
    fn energy_is_kept_account_of(parameters in parameters(), angles in angles(), nu in vector6(1.0), tau in vector6(5.0)) {
        let vehicle = Vehicle::new(parameters).unwrap();
        let mut simulation = Simulation::new(vehicle, Vec::new(), STEP_S, start(angles, nu)).unwrap();
        let first = energy_and_power(&simulation, &tau);
        let (mut came_in, mut lost, mut last) = (vec![first.1], vec![first.2], first.0);
        for _ in 0..500 {
            simulation.step(&[], |_| tau).unwrap();
            let (energy, power, drag) = energy_and_power(&simulation, &tau);
            came_in.push(power);
            lost.push(drag);
            last = energy;
        }
        let (came_in, lost) = (simpson(&came_in), simpson(&lost));
        let turned_over = first.0.abs() + last.abs() + came_in.abs() + lost.abs();
        let error = |work: f64| (last - first.0 - work).abs() / turned_over;
        prop_assert!(error(came_in + lost) < ENERGY_BALANCE, "{}", error(came_in + lost));
        // False variant: drag forgotten.
        prop_assert!(error(came_in) > ENERGY_BALANCE);
    }

    #[test]
    fn momentum_over_ground_is_kept_without_force(parameters in parameters(), angles in angles(), nu in vector6(1.0)) {
        let weight_n = parameters.mass_kg * STANDARD_GRAVITY;
        let free = VehicleParameters {
            buoyancy_n: weight_n,
            centre_of_buoyancy_m: parameters.centre_of_gravity_m,
            linear_drag: nalgebra::Matrix6::zeros(),
            quadratic_drag: Vector6::zeros(),
            ..parameters
        };
        let vehicle = Vehicle::new(free).unwrap();
        let momentum = |state: &BodyState| {
            let both = vehicle.mass() * state.nu;
            let linear = state.pose.attitude * Vector3::new(both[0], both[1], both[2]);
            let about_body = state.pose.attitude * Vector3::new(both[3], both[4], both[5]);
            (linear, about_body + state.pose.position_m.cross(&linear))
        };
        let mut simulation = Simulation::new(vehicle.clone(), Vec::new(), STEP_S, start(angles, nu)).unwrap();
        let (linear, angular) = momentum(simulation.state());
        for _ in 0..1000 {
            simulation.step(&[], |_| Vector6::zeros()).unwrap();
        }
        let (linear_end, angular_end) = momentum(simulation.state());
        let scale = linear.norm() + angular.norm();
        prop_assert!((linear_end - linear).norm() < ENERGY_BALANCE * scale);
        prop_assert!((angular_end - angular).norm() < ENERGY_BALANCE * scale);
        // False variant: momentum in body axes is not kept.
        let body = |state: &BodyState| (vehicle.mass() * state.nu).fixed_rows::<3>(0).into_owned();
        let turned = (body(simulation.state()) - body(&start(angles, nu))).norm();
        prop_assert!(turned > ENERGY_BALANCE * scale);
    }
}

/// Halving the step divides the error by about sixteen.
#[test]
fn the_method_is_of_fourth_order() {
    // Quadratic drag bends where a speed reverses, and a bend costs order.
    let smooth = VehicleParameters { quadratic_drag: Vector6::zeros(), ..*pool_vehicle().unwrap().parameters() };
    let end = |step_s: f64| {
        let vehicle = Vehicle::new(smooth).unwrap();
        let nu = Vector6::new(0.5, -0.3, 0.2, 1.0, -1.5, 2.0);
        let angles = selfosc::vehicle::EulerAngles { roll_rad: 0.5, pitch_rad: -0.4, yaw_rad: 1.0 };
        let mut simulation = Simulation::new(vehicle, Vec::new(), step_s, start(angles, nu)).unwrap();
        for _ in 0..(1.0 / step_s).round() as usize {
            simulation.step(&[], |_| Vector6::zeros()).unwrap();
        }
        simulation.state().nu
    };
    let reference = end(1.0 / 3200.0);
    let errors = [100.0, 200.0].map(|steps| (end(1.0 / steps) - reference).norm());
    let ratio = errors[0] / errors[1];
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
}

/// A command acts after its delay, not a step sooner, and pushes where the thruster is.
#[test]
fn commands_act_after_the_delay() {
    let mut pool =
        Simulation::new(pool_vehicle().unwrap(), pool_thrusters().unwrap().to_vec(), 0.01, BodyState::at_rest())
            .unwrap();
    let forces: Vec<_> = (0..12).map(|_| pool.step(&[100.0, -100.0, 0.0], |_| Vector6::zeros()).unwrap()).collect();
    assert!(forces[..10].iter().all(|force| force.amax() == 0.0));
    // Eq. 35: X = tau_1 + tau_2, N = d (tau_1 - tau_2); 2.5 N ahead, 1.8 N astern at command 100.
    approx::assert_relative_eq!(forces[10][0], 0.7, epsilon = 1e-12);
    approx::assert_relative_eq!(forces[10][5], 0.08 * 4.3, epsilon = 1e-12);
    assert!(pool.state().nu[5] > 0.0);
    approx::assert_relative_eq!(pool.time_s(), 0.12, epsilon = 1e-12);
}

/// The speed at which drag takes all the thrust, by the quadratic formula.
#[test]
fn a_steady_run_ahead_has_the_speed_of_its_drag() {
    let level = |z_m: f64| Vector3::new(0.0, 0.0, z_m);
    // Centres in one vertical and thrust at its middle: pitch stays small but not zero, so only surge drag is compared.
    let mut parameters = *pool_vehicle().unwrap().parameters();
    parameters.centre_of_gravity_m = level(0.0);
    parameters.centre_of_buoyancy_m = level(0.0);
    parameters.buoyancy_n = parameters.mass_kg * STANDARD_GRAVITY;
    let vehicle = Vehicle::new(parameters).unwrap();
    let mut pool = Simulation::new(vehicle, pool_thrusters().unwrap().to_vec(), 0.01, BodyState::at_rest()).unwrap();
    for _ in 0..3000 {
        pool.step(&[100.0, 100.0, 0.0], |_| Vector6::zeros()).unwrap();
    }
    // u + 6 u^2 = 5 N.
    approx::assert_relative_eq!(pool.state().nu[0], (-1.0 + 121.0_f64.sqrt()) / 12.0, epsilon = 1e-9);
}

#[test]
fn what_cannot_be_simulated_is_refused() {
    let new = |step_s| {
        Simulation::new(pool_vehicle().unwrap(), pool_thrusters().unwrap().to_vec(), step_s, BodyState::at_rest())
    };
    assert!(matches!(new(0.03), Err(VehicleError::OutOfDomain { .. })), "0.1 s is no whole number of 0.03 s");
    assert!(new(0.0).is_err() && new(f64::NAN).is_err() && new(0.02).is_ok());
    let mut pool = new(0.01).unwrap();
    assert!(matches!(pool.step(&[0.0; 2], |_| Vector6::zeros()), Err(VehicleError::Count { count: 2, needed: 3, .. })));
    assert!(pool.step(&[f64::NAN, 0.0, 0.0], |_| Vector6::zeros()).is_err());
    let absurd = Vector6::repeat(1e200);
    let broken = (0..5).find_map(|_| pool.step(&[0.0; 3], |_| absurd).err());
    assert!(matches!(broken, Some(VehicleError::Diverged { .. })));
    let thruster = Thruster::affine(1.0, 0.0, 0.0, 1.0).unwrap();
    assert!(MountedThruster::new(thruster, Vector3::zeros(), Vector3::zeros(), 0.0).is_err());
    assert!(MountedThruster::new(thruster, Vector3::zeros(), Vector3::x(), -0.1).is_err());
}
