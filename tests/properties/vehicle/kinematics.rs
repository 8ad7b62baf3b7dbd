//! Eq. 4 by Euler angles and by quaternions.

use nalgebra::{Matrix3, UnitQuaternion, Vector3, Vector4, Vector6};
use proptest::prelude::*;
use selfosc::vehicle::{EulerAngles, Pose, VehicleError};

use super::bodies::{angles, vector6};
use crate::tolerance::{QUATERNION_RATE, VEHICLE_ALGEBRA};

/// The zyx rotation as the product of its three turns.
fn turns(angles: &EulerAngles) -> Matrix3<f64> {
    let turn = |axis: Vector3<f64>, angle: f64| {
        // Rodrigues: I + sin S + (1 - cos) S^2.
        let s = axis.cross_matrix();
        Matrix3::identity() + s * angle.sin() + s * s * (1.0 - angle.cos())
    };
    turn(Vector3::z(), angles.yaw_rad) * turn(Vector3::y(), angles.pitch_rad) * turn(Vector3::x(), angles.roll_rad)
}

/// The quaternion's rate when the Euler angles change at these rates, by central difference.
fn rate_by_angles(angles: &EulerAngles, rates: &Vector3<f64>) -> Vector4<f64> {
    const H: f64 = 1e-5;
    let here = Pose::new(Vector3::zeros(), *angles).attitude;
    let at = |t: f64| {
        let moved = EulerAngles {
            roll_rad: angles.roll_rad + t * rates.x,
            pitch_rad: angles.pitch_rad + t * rates.y,
            yaw_rad: angles.yaw_rad + t * rates.z,
        };
        let there = Pose::new(Vector3::zeros(), moved).attitude.coords;
        // q and -q are one rotation.
        if there.dot(&here.coords) < 0.0 { -there } else { there }
    };
    (at(H) - at(-H)) / (2.0 * H)
}

/// Eq. 4: velocity over the ground, and Euler rates.
fn pose_rate(angles: &EulerAngles, nu: &Vector6<f64>) -> Result<[Vector3<f64>; 2], VehicleError> {
    let [linear, angular] = [0, 3].map(|from| nu.fixed_rows::<3>(from).into_owned());
    Ok([angles.rotation() * linear, angles.rate_matrix()? * angular])
}

proptest! {
    #![proptest_config(crate::sampling::recorded(256))]

    #[test]
    fn both_forms_agree(angles in angles(), nu in vector6(2.0)) {
        let pose = Pose::new(Vector3::new(1.0, 2.0, 3.0), angles);
        let [linear, rates] = pose_rate(&angles, &nu).unwrap();
        let (velocity, spin) = pose.rate(&nu);
        prop_assert!((linear - velocity).amax() < VEHICLE_ALGEBRA);
        prop_assert!((linear - turns(&angles) * nu.fixed_rows::<3>(0)).amax() < VEHICLE_ALGEBRA);
        let scale = 1.0 + rates.norm().powi(3);
        prop_assert!((rate_by_angles(&angles, &rates) - spin).amax() < QUATERNION_RATE * scale);
        // The quaternion stays of unit length.
        prop_assert!(spin.dot(&pose.attitude.coords).abs() < VEHICLE_ALGEBRA);
        // False variant: body rates taken for Euler rates.
        let body = nu.fixed_rows::<3>(3).into_owned();
        let wrong = (rate_by_angles(&angles, &body) - spin).amax();
        prop_assert!(wrong > QUATERNION_RATE * scale || (body - rates).norm() < 1e-3 * scale);
    }

    #[test]
    fn only_the_euler_form_has_a_singularity(angles in angles(), offset in -1e-4..1e-4_f64, up: bool, nu in vector6(2.0)) {
        let pitch_rad = std::f64::consts::FRAC_PI_2.copysign(if up { 1.0 } else { -1.0 }) + offset;
        let steep = EulerAngles { pitch_rad, ..angles };
        let limit = EulerAngles::LEAST_COS_PITCH;
        prop_assert_eq!(steep.rate_matrix().unwrap_err(), VehicleError::PitchSingular { pitch_rad, limit });
        let (velocity, spin) = Pose::new(Vector3::zeros(), steep).rate(&nu);
        // Speeds over the ground are those over the body, spin is half the angular speed.
        prop_assert!((velocity.norm() - nu.fixed_rows::<3>(0).norm()).abs() < VEHICLE_ALGEBRA);
        prop_assert!((spin.norm() - 0.5 * nu.fixed_rows::<3>(3).norm()).abs() < VEHICLE_ALGEBRA);
        // Short of the limit both exist.
        let short = EulerAngles { pitch_rad: (std::f64::consts::FRAC_PI_2 - 2.0 * limit).copysign(pitch_rad), ..angles };
        prop_assert!(short.rate_matrix().is_ok());
    }

    #[test]
    fn angles_survive_the_quaternion(angles in angles()) {
        let back = Pose::new(Vector3::zeros(), angles).angles();
        let differences = [back.roll_rad - angles.roll_rad, back.pitch_rad - angles.pitch_rad, back.yaw_rad - angles.yaw_rad];
        prop_assert!(differences.iter().all(|difference| difference.abs() < VEHICLE_ALGEBRA * 100.0));
    }
}

#[test]
fn angles_that_are_no_numbers_are_refused() {
    let broken = EulerAngles { yaw_rad: f64::NAN, ..EulerAngles::default() };
    assert!(matches!(broken.rate_matrix(), Err(VehicleError::OutOfDomain { .. })));
    assert_eq!(Pose::new(Vector3::zeros(), EulerAngles::default()).attitude, UnitQuaternion::identity());
}
