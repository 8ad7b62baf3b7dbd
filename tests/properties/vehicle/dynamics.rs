//! The structure of eq. 5.

use nalgebra::{Matrix6, Vector3, Vector6};
use proptest::prelude::*;
use selfosc::vehicle::{Vehicle, VehicleError, VehicleParameters, coriolis};

use super::bodies::{PointMass, attitude, parameters, points, potential_energy_j, rigid_body, vector6, vehicle};
use crate::tolerance::VEHICLE_ALGEBRA;

fn halves(nu: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (Vector3::new(nu[0], nu[1], nu[2]), Vector3::new(nu[3], nu[4], nu[5]))
}

fn joined(a: Vector3<f64>, b: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// Energy of points that move as one body.
fn energy_of_points(points: &[PointMass], nu: &Vector6<f64>) -> f64 {
    let (linear, angular) = halves(nu);
    points.iter().map(|(mass, place)| 0.5 * mass * (linear + angular.cross(place)).norm_squared()).sum()
}

/// Power of a Coriolis matrix, relative to the size of its force.
fn power(matrix: &Matrix6<f64>, nu: &Vector6<f64>) -> f64 {
    nu.dot(&(matrix * nu)).abs() / (matrix.amax() * nu.norm_squared())
}

/// Difference from the momentum laws of Kirchhoff: `p' = p x omega`, `h' = h x omega + p x v` without force.
fn kirchhoff_error(mass: &Matrix6<f64>, matrix: &Matrix6<f64>, nu: &Vector6<f64>) -> f64 {
    let ((linear, angular), (p, h)) = (halves(nu), halves(&(mass * nu)));
    let momentum_rate = joined(p.cross(&angular), h.cross(&angular) + p.cross(&linear));
    (momentum_rate + matrix * nu).amax() / (mass.amax() * nu.norm_squared())
}

/// The upper right block with the wrong sign.
fn half_flipped(mut matrix: Matrix6<f64>) -> Matrix6<f64> {
    matrix.fixed_view_mut::<3, 3>(0, 3).neg_mut();
    matrix
}

proptest! {
    #![proptest_config(crate::sampling::recorded(256))]

    #[test]
    fn rigid_body_inertia_is_that_of_its_points(points in points(), nu in vector6(2.0)) {
        let vehicle = Vehicle::new(rigid_body(&points)).unwrap();
        let truth = energy_of_points(&points, &nu);
        prop_assert!((vehicle.kinetic_energy_j(&nu) / truth - 1.0).abs() < VEHICLE_ALGEBRA);
        // False variant: the centre of gravity mirrored.
        let mut mirrored = rigid_body(&points);
        mirrored.centre_of_gravity_m.neg_mut();
        let coupling = (nu.fixed_rows::<3>(0).cross(&nu.fixed_rows::<3>(3))).dot(&mirrored.centre_of_gravity_m);
        if let Ok(wrong) = Vehicle::new(mirrored) {
            prop_assert!((wrong.kinetic_energy_j(&nu) / truth - 1.0).abs() > VEHICLE_ALGEBRA || coupling.abs() < 1e-6);
        }
    }

    #[test]
    fn inertia_is_symmetric_positive_definite(vehicle in vehicle(), x in vector6(1.0)) {
        let mass = vehicle.mass();
        prop_assert!((mass - mass.transpose()).amax() <= 1e-12 * mass.amax());
        prop_assert!(x.dot(&(mass * x)) > 0.0);
        // M_RB and M_A each are at least semi-definite here.
        prop_assert!(x.dot(&(vehicle.rigid_body_mass() * x)) > 0.0);
    }

    #[test]
    fn coriolis_force_does_no_work(vehicle in vehicle(), nu in vector6(2.0)) {
        let matrix = vehicle.coriolis(&nu);
        prop_assert_eq!(matrix, -matrix.transpose());
        prop_assert!(power(&matrix, &nu) < VEHICLE_ALGEBRA);
        prop_assert!(power(&half_flipped(matrix), &nu) > VEHICLE_ALGEBRA);
        // Body and water apart add up.
        let water = coriolis(&vehicle.parameters().added_mass, &nu);
        let both = coriolis(vehicle.rigid_body_mass(), &nu) + water;
        prop_assert!((both - matrix).amax() < VEHICLE_ALGEBRA * matrix.amax());
    }

    #[test]
    fn coriolis_force_is_the_momentum_law_in_turning_axes(vehicle in vehicle(), nu in vector6(2.0)) {
        let (mass, matrix) = (vehicle.mass(), vehicle.coriolis(&nu));
        prop_assert!(kirchhoff_error(&mass, &matrix, &nu) < VEHICLE_ALGEBRA);
        // Wrong sign throughout is skew-symmetric too: only this law notices.
        prop_assert!(kirchhoff_error(&mass, &-matrix, &nu) > VEHICLE_ALGEBRA);
        prop_assert!(kirchhoff_error(&mass, &half_flipped(matrix), &nu) > VEHICLE_ALGEBRA);
    }

    #[test]
    fn drag_dissipates(vehicle in vehicle(), nu in vector6(3.0)) {
        prop_assert!(nu.dot(&(vehicle.drag(&nu) * nu)) >= -VEHICLE_ALGEBRA * nu.norm_squared());
        let thrice = vehicle.drag(&(nu * 3.0)) - vehicle.drag(&nu);
        let quadratic = Matrix6::from_diagonal(&vehicle.parameters().quadratic_drag.component_mul(&(nu.abs() * 2.0)));
        prop_assert!((thrice - quadratic).amax() < VEHICLE_ALGEBRA * 100.0);
    }

    #[test]
    fn restoring_force_is_the_slope_of_potential_energy(
        vehicle in vehicle(), attitude in attitude(), nu in vector6(1.0),
    ) {
        // Power of g by eq. 5 against the change of potential energy along the motion.
        let h = 1e-5;
        let energy = |t: f64| {
            let (linear, angular) = halves(&(nu * t));
            let turned = attitude * nalgebra::UnitQuaternion::from_scaled_axis(angular);
            potential_energy_j(&vehicle, (attitude * linear).z, &turned)
        };
        let slope = (energy(h) - energy(-h)) / (2.0 * h);
        let power = nu.dot(&vehicle.restoring(&attitude));
        let scale = (vehicle.weight_n() + vehicle.parameters().buoyancy_n) * nu.norm();
        prop_assert!((slope - power).abs() < 1e-8 * scale, "{slope} {power}");
        prop_assert!((slope + power).abs() > 1e-8 * scale || power.abs() < 1e-6 * scale);
    }

    #[test]
    fn acceleration_balances_eq_5_and_its_power(
        vehicle in vehicle(), attitude in attitude(), nu in vector6(2.0), tau in vector6(20.0),
    ) {
        let rate = vehicle.acceleration(&attitude, &nu, &tau);
        let (inertia, drag) = (vehicle.mass() * rate, vehicle.drag(&nu) * nu);
        let rest = inertia + vehicle.coriolis(&nu) * nu + drag + vehicle.restoring(&attitude) - tau;
        let scale = inertia.amax() + drag.amax() + tau.amax() + 1000.0;
        prop_assert!(rest.amax() < VEHICLE_ALGEBRA * scale);
        // d/dt of kinetic energy: what comes in less what drag takes, no matter how it turns.
        let came_in = nu.dot(&(tau - drag - vehicle.restoring(&attitude)));
        prop_assert!((nu.dot(&inertia) - came_in).abs() < VEHICLE_ALGEBRA * scale * nu.norm());
        // False variant: a Coriolis matrix with one block's sign wrong makes power from nothing.
        let wrong = half_flipped(vehicle.coriolis(&nu)) * nu;
        let invented = nu.dot(&(inertia + vehicle.coriolis(&nu) * nu - wrong)) - came_in;
        prop_assert!(invented.abs() > VEHICLE_ALGEBRA * scale * nu.norm());
    }

    #[test]
    fn a_vehicle_that_could_drive_itself_is_refused(mut good in parameters(), axis in 0..6_usize) {
        let refused = |bad: VehicleParameters| matches!(Vehicle::new(bad), Err(VehicleError::Indefinite { .. }));
        let drives = VehicleParameters { linear_drag: good.linear_drag - Matrix6::identity() * 20.0, ..good };
        prop_assert!(refused(drives));
        let weightless = VehicleParameters { added_mass: good.added_mass - Matrix6::identity() * 50.0, ..good };
        prop_assert!(refused(weightless));
        let mut lopsided = good;
        lopsided.added_mass[(axis, (axis + 1) % 6)] += 0.1;
        prop_assert!(refused(lopsided));
        let far = VehicleParameters { centre_of_gravity_m: Vector3::new(3.0, 0.0, 0.0), ..good };
        prop_assert!(refused(far));
        good.quadratic_drag[axis] = -1.0;
        prop_assert!(Vehicle::new(good).is_err());
        good.quadratic_drag[axis] = f64::NAN;
        prop_assert!(Vehicle::new(good).is_err());
    }
}
