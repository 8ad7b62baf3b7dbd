//! From six degrees of freedom to uncoupled axes (eq. 6, Table 2), with what that neglects.

use nalgebra::{Matrix6, UnitQuaternion, Vector6};

use super::{Vehicle, coriolis};
use crate::plant::{DragAxis, PlantError};

/// An axis that is identified on its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Ahead.
    Surge,
    /// To starboard.
    Sway,
    /// Down.
    Heave,
    /// Heading.
    Yaw,
}

impl Axis {
    /// Every axis, in the order of the velocity's components.
    pub const ALL: [Self; 4] = [Self::Surge, Self::Sway, Self::Heave, Self::Yaw];

    /// Position among the six components of velocity and force.
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Surge => 0,
            Self::Sway => 1,
            Self::Heave => 2,
            Self::Yaw => 5,
        }
    }
}

/// The uncoupled axis `alpha nu' + (linear_drag + quadratic_drag abs(nu)) nu = tau + disturbance`; yaw in rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisParameters {
    /// Inertia with added mass: kg, or kg m^2 for yaw.
    pub alpha: f64,
    /// Force ~ speed: N/(m/s), or N m/(rad/s).
    pub linear_drag: f64,
    /// Force ~ speed times its magnitude: N/(m/s)^2, or N m/(rad/s)^2.
    pub quadratic_drag: f64,
    /// Constant force: N, or N m; weight minus buoyancy is part of it in heave.
    pub disturbance: f64,
}

impl TryFrom<AxisParameters> for DragAxis<f64> {
    type Error = PlantError;

    /// The axis as a plant, without delay.
    ///
    /// # Errors
    /// Those of [`DragAxis::mixed`].
    fn try_from(axis: AxisParameters) -> Result<Self, PlantError> {
        Self::mixed(axis.alpha, axis.linear_drag, axis.quadratic_drag)?.with_disturbance(axis.disturbance)
    }
}

/// A motion at one instant, for which [`Neglected`] is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Rotation from body to Earth.
    pub attitude: UnitQuaternion<f64>,
    /// Velocity in body axes.
    pub nu: Vector6<f64>,
    /// Its rate of change.
    pub nu_rate: Vector6<f64>,
}

/// What eq. 5 has and the uncoupled axis has not, each in N (N m for yaw), on the left side of the equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neglected {
    /// Water accelerated by the other axes.
    pub added_mass_coupling: f64,
    /// Coriolis and centripetal force of the water and of a body with its centre of gravity at the origin.
    pub coriolis: f64,
    /// Centre of gravity away from the origin and products of inertia: other axes' acceleration, and centripetal force.
    pub centre_of_gravity: f64,
    /// Linear drag by the other axes' speeds.
    pub drag_coupling: f64,
    /// Weight and buoyancy through roll and pitch.
    pub roll_and_pitch: f64,
}

impl Neglected {
    /// The sum: the force an uncoupled axis would have to call a disturbance.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.added_mass_coupling + self.coriolis + self.centre_of_gravity + self.drag_coupling + self.roll_and_pitch
    }
}

impl Vehicle {
    /// The uncoupled axis under a constant disturbance `tau_E` (Table 2).
    ///
    /// It moves as eq. 5 does only as far as [`Self::neglected`] stays small against inertia and drag.
    ///
    /// ```
    /// # use selfosc::vehicle::{Axis, VehicleError, pool_vehicle};
    /// # use nalgebra::Vector6;
    /// let vehicle = pool_vehicle()?;
    /// let heave = vehicle.axis(Axis::Heave, &Vector6::zeros());
    /// assert_eq!(heave.disturbance, vehicle.weight_n() - vehicle.parameters().buoyancy_n);
    /// # Ok::<(), VehicleError>(())
    /// ```
    #[must_use]
    pub fn axis(&self, axis: Axis, disturbance: &Vector6<f64>) -> AxisParameters {
        let (i, p) = (axis.index(), self.parameters());
        AxisParameters {
            alpha: self.mass()[(i, i)],
            linear_drag: p.linear_drag[(i, i)],
            quadratic_drag: p.quadratic_drag[i],
            disturbance: disturbance[i] - self.restoring(&UnitQuaternion::identity())[i],
        }
    }

    /// The terms of eq. 5 that the uncoupled axis leaves out, for a motion. Together with the axis' own terms they are the
    /// axis' row of eq. 5, exactly up to rounding.
    ///
    /// ```
    /// # use selfosc::vehicle::{Axis, Motion, VehicleError, pool_vehicle};
    /// # use nalgebra::{UnitQuaternion, Vector6};
    /// // Surging and swaying while heading is identified: the water's unequal mass turns the vehicle.
    /// let nu = Vector6::new(0.1, 0.05, 0.0, 0.0, 0.0, 0.3);
    /// let motion = Motion { attitude: UnitQuaternion::identity(), nu, nu_rate: Vector6::zeros() };
    /// let neglected = pool_vehicle()?.neglected(Axis::Yaw, &motion);
    /// assert!((neglected.coriolis - 0.1 * (0.05 * (9.6 - 5.4) + 0.3 * 0.05)).abs() < 1e-12);
    /// # Ok::<(), VehicleError>(())
    /// ```
    #[must_use]
    pub fn neglected(&self, axis: Axis, motion: &Motion) -> Neglected {
        let (i, nu) = (axis.index(), &motion.nu);
        let added_mass = &self.parameters().added_mass;
        let centred = centred(self.rigid_body_mass());
        let row = |matrix: &Matrix6<f64>, column: &Vector6<f64>| (matrix * column)[i];
        let others = |matrix: &Matrix6<f64>, column: &Vector6<f64>| row(matrix, column) - matrix[(i, i)] * column[i];
        let offset = coriolis(self.rigid_body_mass(), nu) - coriolis(&centred, nu);
        let upright = self.restoring(&UnitQuaternion::identity());
        Neglected {
            added_mass_coupling: others(added_mass, &motion.nu_rate),
            coriolis: row(&coriolis(&(centred + added_mass), nu), nu),
            centre_of_gravity: others(self.rigid_body_mass(), &motion.nu_rate) + row(&offset, nu),
            drag_coupling: others(&self.parameters().linear_drag, nu),
            roll_and_pitch: (self.restoring(&motion.attitude) - upright)[i],
        }
    }
}

/// The rigid-body inertia without its off-diagonal terms.
fn centred(mass: &Matrix6<f64>) -> Matrix6<f64> {
    Matrix6::from_diagonal(&mass.diagonal())
}
