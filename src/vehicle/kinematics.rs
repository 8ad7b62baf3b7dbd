//! Body velocity to motion over the ground (eq. 4), by Euler angles and by quaternions.

use crate::numeric::domain;
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3, Vector4, Vector6};

use super::VehicleError;

/// Roll, pitch and yaw in rad: the rotation from body to Earth is yaw about down, then pitch, then roll (zyx).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EulerAngles {
    /// Roll, about the forward axis.
    pub roll_rad: f64,
    /// Pitch, about the starboard axis; bow up is positive.
    pub pitch_rad: f64,
    /// Yaw, about the down axis: the heading.
    pub yaw_rad: f64,
}

impl EulerAngles {
    /// Least `abs(cos(pitch))` for which rates are given: about 0.06 degrees from the singularity.
    pub const LEAST_COS_PITCH: f64 = 1e-3;

    /// The rotation `J1` from body to Earth.
    #[must_use]
    pub fn rotation(&self) -> Rotation3<f64> {
        Rotation3::from_euler_angles(self.roll_rad, self.pitch_rad, self.yaw_rad)
    }

    /// The matrix `J2` from body rates (p, q, r) to Euler rates.
    ///
    /// # Errors
    /// [`VehicleError::PitchSingular`] near pitch = +-90 degrees, where it has no bound; angles that are not finite.
    pub fn rate_matrix(&self) -> Result<Matrix3<f64>, VehicleError> {
        for angle in [self.roll_rad, self.pitch_rad, self.yaw_rad] {
            domain::finite("Euler angle", angle, "rad")?;
        }
        let (sin_roll, cos_roll) = libm::sincos(self.roll_rad);
        let (sin_pitch, cos_pitch) = libm::sincos(self.pitch_rad);
        if cos_pitch.abs() < Self::LEAST_COS_PITCH {
            return Err(VehicleError::PitchSingular { pitch_rad: self.pitch_rad, limit: Self::LEAST_COS_PITCH });
        }
        let tan_pitch = sin_pitch / cos_pitch;
        #[rustfmt::skip]
        let matrix = Matrix3::new(
            1.0, sin_roll * tan_pitch, cos_roll * tan_pitch,
            0.0, cos_roll,             -sin_roll,
            0.0, sin_roll / cos_pitch, cos_roll / cos_pitch,
        );
        Ok(matrix)
    }
}

/// Position and attitude without a singularity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Position north, east, down, m.
    pub position_m: Vector3<f64>,
    /// Rotation from body to Earth.
    pub attitude: UnitQuaternion<f64>,
}

impl Pose {
    /// The pose at a position with Euler angles, which are always a rotation.
    #[must_use]
    pub fn new(position_m: Vector3<f64>, angles: EulerAngles) -> Self {
        Self { position_m, attitude: UnitQuaternion::from_rotation_matrix(&angles.rotation()) }
    }

    /// Euler angles of the attitude; roll and yaw are not unique at pitch = +-90 degrees.
    #[must_use]
    pub fn angles(&self) -> EulerAngles {
        let (roll_rad, pitch_rad, yaw_rad) = self.attitude.euler_angles();
        EulerAngles { roll_rad, pitch_rad, yaw_rad }
    }

    /// Velocity over the ground and the quaternion's rate `q omega / 2`, as (i, j, k, w), at any attitude.
    ///
    /// ```
    /// # use selfosc::vehicle::{EulerAngles, Pose};
    /// # use nalgebra::{Vector3, Vector6};
    /// let straight_up = EulerAngles { pitch_rad: std::f64::consts::FRAC_PI_2, ..EulerAngles::default() };
    /// let ahead = Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    /// assert!(straight_up.rate_matrix().is_err());
    /// let (velocity, _) = Pose::new(Vector3::zeros(), straight_up).rate(&ahead);
    /// assert!((velocity.z + 1.0).abs() < 1e-15); // it climbs
    /// ```
    #[must_use]
    pub fn rate(&self, nu: &Vector6<f64>) -> (Vector3<f64>, Vector4<f64>) {
        let (linear, angular) = halves(nu);
        let spin = self.attitude.into_inner() * Quaternion::from_imag(angular) * 0.5;
        (self.attitude * linear, spin.coords)
    }
}

/// The linear and the angular half.
pub(super) fn halves(vector: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (vector.fixed_rows::<3>(0).into_owned(), vector.fixed_rows::<3>(3).into_owned())
}

/// A six-vector from its linear and its angular half.
pub(super) fn joined(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}
