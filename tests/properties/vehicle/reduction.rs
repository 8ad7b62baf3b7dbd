//! Table 2 against eq. 5.

use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};
use proptest::prelude::*;
use selfosc::vehicle::{Axis, AxisParameters, Motion, Vehicle, VehicleParameters};

use super::bodies::{attitude, parameters, vector6, vehicle};
use crate::tolerance::VEHICLE_ALGEBRA;

/// Left side minus `tau` of the uncoupled axis, eq. 6.
fn uncoupled(axis: &AxisParameters, speed: f64, rate: f64) -> f64 {
    axis.alpha * rate + (axis.linear_drag + axis.quadratic_drag * speed.abs()) * speed - axis.disturbance
}

/// The same row of eq. 5.
fn row_of_eq_5(vehicle: &Vehicle, axis: Axis, motion: &Motion, disturbance: &Vector6<f64>) -> f64 {
    let nu = &motion.nu;
    let force = vehicle.mass() * motion.nu_rate + (vehicle.coriolis(nu) + vehicle.drag(nu)) * nu;
    (force + vehicle.restoring(&motion.attitude) - disturbance)[axis.index()]
}

/// A vehicle to which nothing that Table 2 neglects applies: centre of gravity at the origin, no couplings.
fn uncoupled_vehicle(mut parameters: VehicleParameters) -> Vehicle {
    parameters.centre_of_gravity_m = Vector3::zeros();
    parameters.inertia_kg_m2 = nalgebra::Matrix3::from_diagonal(&parameters.inertia_kg_m2.diagonal());
    parameters.added_mass = Matrix6::from_diagonal(&parameters.added_mass.diagonal());
    parameters.linear_drag = Matrix6::from_diagonal(&parameters.linear_drag.diagonal());
    Vehicle::new(parameters).unwrap()
}

proptest! {
    #![proptest_config(crate::sampling::recorded(256))]

    #[test]
    fn an_axis_and_what_it_neglects_are_eq_5(
        vehicle in vehicle(), attitude in attitude(), nu in vector6(2.0), nu_rate in vector6(2.0), tau_e in vector6(5.0),
    ) {
        let motion = Motion { attitude, nu, nu_rate };
        for axis in Axis::ALL {
            let (i, reduced) = (axis.index(), vehicle.axis(axis, &tau_e));
            let alone = uncoupled(&reduced, nu[i], nu_rate[i]);
            let neglected = vehicle.neglected(axis, &motion);
            let truth = row_of_eq_5(&vehicle, axis, &motion, &tau_e);
            prop_assert!((alone + neglected.total() - truth).abs() < VEHICLE_ALGEBRA * 1000.0, "{axis:?}");
            // False variant: the neglected terms left out.
            prop_assert!((alone - truth).abs() > VEHICLE_ALGEBRA * 1000.0, "{axis:?}");
        }
    }

    #[test]
    fn without_neglected_terms_an_axis_is_eq_5(
        parameters in parameters(), speed in -2.0..2.0_f64, rate in -2.0..2.0_f64, yaw in -3.0..3.0_f64, tau_e in vector6(5.0),
    ) {
        let vehicle = uncoupled_vehicle(parameters);
        for axis in Axis::ALL {
            let (mut nu, mut nu_rate) = (Vector6::zeros(), Vector6::zeros());
            (nu[axis.index()], nu_rate[axis.index()]) = (speed, rate);
            let attitude = UnitQuaternion::from_euler_angles(0.0, 0.0, yaw);
            let motion = Motion { attitude, nu, nu_rate };
            prop_assert!(vehicle.neglected(axis, &motion).total().abs() < VEHICLE_ALGEBRA);
            let reduced = vehicle.axis(axis, &tau_e);
            let truth = row_of_eq_5(&vehicle, axis, &motion, &tau_e);
            prop_assert!((uncoupled(&reduced, speed, rate) - truth).abs() < VEHICLE_ALGEBRA * 100.0);
            // False variant: buoyancy minus weight.
            let mistaken = AxisParameters { disturbance: 2.0 * tau_e[axis.index()] - reduced.disturbance, ..reduced };
            let wrong = (uncoupled(&mistaken, speed, rate) - truth).abs();
            prop_assert_eq!(wrong > VEHICLE_ALGEBRA * 100.0, axis == Axis::Heave);
        }
    }

    #[test]
    fn each_neglected_term_comes_from_its_cause(
        parameters in parameters(), attitude in attitude(), nu in vector6(2.0), nu_rate in vector6(2.0),
    ) {
        let plain = uncoupled_vehicle(parameters);
        let motion = Motion { attitude, nu, nu_rate };
        let upright = Motion { attitude: UnitQuaternion::identity(), ..motion };
        let still = Motion { nu: Vector6::zeros(), ..motion };
        let with = |change: &dyn Fn(&mut VehicleParameters)| {
            let mut changed = *plain.parameters();
            change(&mut changed);
            Vehicle::new(changed).unwrap()
        };
        let off_centre = with(&|p| p.centre_of_gravity_m = Vector3::new(0.01, -0.02, 0.03));
        let coupled_water = with(&|p| p.added_mass = parameters.added_mass);
        let coupled_drag = with(&|p| p.linear_drag = parameters.linear_drag);
        for axis in Axis::ALL {
            let terms = |vehicle: &Vehicle, motion| vehicle.neglected(axis, motion);
            let bare = terms(&plain, &motion);
            prop_assert_eq!((bare.added_mass_coupling, bare.centre_of_gravity, bare.drag_coupling), (0.0, 0.0, 0.0));
            prop_assert_eq!(terms(&plain, &upright).roll_and_pitch, 0.0);
            prop_assert_eq!(terms(&plain, &still).coriolis, 0.0);
            prop_assert!(terms(&off_centre, &motion).centre_of_gravity != 0.0);
            prop_assert_eq!(terms(&off_centre, &motion).coriolis, bare.coriolis);
            prop_assert!(terms(&coupled_water, &motion).added_mass_coupling != 0.0);
            prop_assert!(terms(&coupled_drag, &motion).drag_coupling != 0.0);
            prop_assert!(bare.coriolis != 0.0);
        }
    }
}

/// Table 2 by hand for the vehicle of the project.
#[test]
fn pool_vehicle_axes() {
    let vehicle = selfosc::vehicle::pool_vehicle().unwrap();
    let tau_e = Vector6::new(0.1, 0.2, 0.3, 0.0, 0.0, 0.04);
    let axes = Axis::ALL.map(|axis| vehicle.axis(axis, &tau_e));
    let expected = [(5.4, 1.0, 6.0, 0.1), (9.6, 3.0, 25.0, 0.2), (7.5, 3.0, 20.0, 0.1), (0.033, 0.010, 0.060, 0.04)];
    for (axis, (alpha, linear, quadratic, disturbance)) in axes.iter().zip(expected) {
        approx::assert_relative_eq!(axis.alpha, alpha, epsilon = 1e-12);
        assert_eq!((axis.linear_drag, axis.quadratic_drag), (linear, quadratic));
        approx::assert_relative_eq!(axis.disturbance, disturbance, epsilon = 1e-12);
    }
}
