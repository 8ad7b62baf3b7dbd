//! Vehicles and motions to test with.

use nalgebra::{Matrix3, Matrix6, SMatrix, UnitQuaternion, Vector3, Vector6};
use proptest::collection::vec;
use proptest::prelude::*;
use selfosc::vehicle::{EulerAngles, STANDARD_GRAVITY, Vehicle, VehicleParameters};

/// A heavy point of a rigid body: mass and place.
pub(super) type PointMass = (f64, Vector3<f64>);

/// Rigid bodies made of points, which know their own energy and momentum.
pub(super) fn points() -> impl Strategy<Value = Vec<PointMass>> {
    let apart = |points: &Vec<PointMass>| Vehicle::new(rigid_body(points)).is_ok();
    vec((0.1..1.0_f64, vec(-0.3..0.3_f64, 3)), 8)
        .prop_map(|points| points.into_iter().map(|(mass, place)| (mass, Vector3::from_column_slice(&place))).collect())
        .prop_filter("points not all in one line", apart)
}

/// Matrices with entries up to one.
fn matrix6() -> impl Strategy<Value = Matrix6<f64>> {
    vec(-1.0..1.0_f64, 36).prop_map(|entries| Matrix6::from_column_slice(&entries))
}

pub(super) fn vector6(bound: f64) -> impl Strategy<Value = Vector6<f64>> {
    vec(-bound..bound, 6).prop_map(|entries| Vector6::from_column_slice(&entries))
}

pub(super) fn angles() -> impl Strategy<Value = EulerAngles> {
    (-3.0..3.0_f64, -1.4..1.4_f64, -3.0..3.0_f64).prop_map(|(roll_rad, pitch_rad, yaw_rad)| EulerAngles {
        roll_rad,
        pitch_rad,
        yaw_rad,
    })
}

pub(super) fn attitude() -> impl Strategy<Value = UnitQuaternion<f64>> {
    angles().prop_map(|angles| UnitQuaternion::from_rotation_matrix(&angles.rotation()))
}

/// Mass, centre of gravity and inertia of points, by their sums.
pub(super) fn rigid_body(points: &[PointMass]) -> VehicleParameters {
    let mass_kg: f64 = points.iter().map(|(mass, _)| mass).sum();
    let centre = points.iter().map(|(mass, place)| place * *mass).sum::<Vector3<f64>>() / mass_kg;
    let inertia = |(mass, r): &PointMass| (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *mass;
    VehicleParameters {
        mass_kg,
        inertia_kg_m2: points.iter().map(inertia).sum(),
        centre_of_gravity_m: centre,
        centre_of_buoyancy_m: Vector3::zeros(),
        buoyancy_n: 0.0,
        added_mass: Matrix6::zeros(),
        linear_drag: Matrix6::zeros(),
        quadratic_drag: Vector6::zeros(),
    }
}

/// Every term of eq. 5 present: full added mass, drag with a part that turns force without dissipating.
pub(super) fn parameters() -> impl Strategy<Value = VehicleParameters> {
    (points(), matrix6(), matrix6(), matrix6(), vector6(1.0), vec(-0.1..0.1_f64, 3), 0.0..80.0_f64).prop_map(
        |(points, added, drag, turning, quadratic, centre, buoyancy_n)| VehicleParameters {
            added_mass: gram(&added),
            linear_drag: gram(&drag) + (turning - turning.transpose()),
            quadratic_drag: quadratic.abs() * 5.0,
            centre_of_buoyancy_m: Vector3::from_column_slice(&centre),
            buoyancy_n,
            ..rigid_body(&points)
        },
    )
}

pub(super) fn vehicle() -> impl Strategy<Value = Vehicle> {
    parameters().prop_map(|parameters| Vehicle::new(parameters).unwrap())
}

/// `A A'`, symmetric to the last bit.
fn gram(matrix: &SMatrix<f64, 6, 6>) -> Matrix6<f64> {
    let product = matrix * matrix.transpose();
    (product + product.transpose()) * 0.5
}

/// Potential energy of weight and buoyancy at a depth, J; zero when both centres are at depth zero.
pub(super) fn potential_energy_j(vehicle: &Vehicle, depth_m: f64, attitude: &UnitQuaternion<f64>) -> f64 {
    let depth = |centre: &Vector3<f64>| depth_m + (attitude * centre).z;
    let p = vehicle.parameters();
    p.buoyancy_n * depth(&p.centre_of_buoyancy_m) - p.mass_kg * STANDARD_GRAVITY * depth(&p.centre_of_gravity_m)
}
