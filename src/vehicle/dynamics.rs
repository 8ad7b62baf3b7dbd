//! Motion in six degrees of freedom (eq. 5).

use crate::numeric::domain;
use nalgebra::{Cholesky, Matrix3, Matrix6, U6, UnitQuaternion, Vector3, Vector6};

use super::VehicleError;
use super::kinematics::{halves, joined};

/// Acceleration of gravity by convention, m/s^2.
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// What eq. 5 needs to know of a vehicle; moments about the origin of the body axes, hydrodynamic terms with positive sign
/// (`added_mass` holds `-X_udot`, `linear_drag` holds `-X_u`, `quadratic_drag` holds `-X_uu`, and so on).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VehicleParameters {
    /// Mass in kg.
    pub mass_kg: f64,
    /// Inertia about the body origin, kg m^2.
    pub inertia_kg_m2: Matrix3<f64>,
    /// Centre of gravity in body axes, m.
    pub centre_of_gravity_m: Vector3<f64>,
    /// Centre of buoyancy in body axes, m.
    pub centre_of_buoyancy_m: Vector3<f64>,
    /// Buoyancy in N; weight is mass times [`STANDARD_GRAVITY`].
    pub buoyancy_n: f64,
    /// Added mass, kg, kg m, kg m^2.
    pub added_mass: Matrix6<f64>,
    /// Force per speed.
    pub linear_drag: Matrix6<f64>,
    /// Force per speed times its magnitude, axis by axis.
    pub quadratic_drag: Vector6<f64>,
}

/// A vehicle whose inertia is positive definite and whose drag dissipates.
///
/// `(M_RB + M_A) nu' + (C_RB(nu) + C_A(nu)) nu + D(nu) nu + g(attitude) = tau`
///
/// ```
/// # use selfosc::vehicle::{VehicleError, pool_vehicle};
/// # use nalgebra::{UnitQuaternion, Vector6};
/// let vehicle = pool_vehicle()?;
/// let ahead = Vector6::new(2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// let acceleration = vehicle.acceleration(&UnitQuaternion::identity(), &Vector6::zeros(), &ahead);
/// assert!(acceleration[0] > 0.3 && acceleration[5] == 0.0);
/// # Ok::<(), VehicleError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Vehicle {
    parameters: VehicleParameters,
    rigid_body_mass: Matrix6<f64>,
    mass: Cholesky<f64, U6>,
}

impl Vehicle {
    /// Asymmetry and negative eigenvalues below this fraction of the largest entry are rounding.
    const TOLERANCE: f64 = 1e-12;

    /// A vehicle from its parameters.
    ///
    /// # Errors
    /// Numbers that are not finite, mass not positive, buoyancy or quadratic drag negative; [`VehicleError::Indefinite`] for
    /// inertia (with or without water) that is not symmetric positive definite, added mass that is not symmetric, or linear
    /// drag that could drive.
    pub fn new(parameters: VehicleParameters) -> Result<Self, VehicleError> {
        let p = &parameters;
        domain::positive("mass", p.mass_kg, "kg")?;
        domain::non_negative("buoyancy", p.buoyancy_n, "N")?;
        for &drag in &p.quadratic_drag {
            domain::non_negative("quadratic drag", drag, "N s^2/m^2, N m s^2")?;
        }
        let matrices = p.inertia_kg_m2.iter().chain(&p.added_mass).chain(&p.linear_drag);
        for &entry in matrices.chain(&p.centre_of_gravity_m).chain(&p.centre_of_buoyancy_m) {
            domain::finite("entry of a vehicle matrix or centre", entry, "")?;
        }
        let rigid_body_mass = rigid_body_mass(p);
        symmetric("the rigid-body inertia", &rigid_body_mass)?;
        symmetric("the added mass", &p.added_mass)?;
        positive("the rigid-body inertia", &rigid_body_mass)?;
        semi_definite("the linear drag", &p.linear_drag)?;
        let mass = positive("the inertia with added mass", &(rigid_body_mass + p.added_mass))?;
        Ok(Self { parameters, rigid_body_mass, mass })
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &VehicleParameters {
        &self.parameters
    }

    /// Weight in N.
    #[must_use]
    pub fn weight_n(&self) -> f64 {
        self.parameters.mass_kg * STANDARD_GRAVITY
    }

    /// `M_RB`.
    #[must_use]
    pub fn rigid_body_mass(&self) -> &Matrix6<f64> {
        &self.rigid_body_mass
    }

    /// `M_RB + M_A`.
    #[must_use]
    pub fn mass(&self) -> Matrix6<f64> {
        self.rigid_body_mass + self.parameters.added_mass
    }

    /// `C_RB(nu) + C_A(nu)`.
    #[must_use]
    pub fn coriolis(&self, nu: &Vector6<f64>) -> Matrix6<f64> {
        coriolis(&self.mass(), nu)
    }

    /// `D(nu)`.
    #[must_use]
    pub fn drag(&self, nu: &Vector6<f64>) -> Matrix6<f64> {
        self.parameters.linear_drag + Matrix6::from_diagonal(&self.parameters.quadratic_drag.component_mul(&nu.abs()))
    }

    /// `g(attitude)`: minus weight and buoyancy with their moments, in body axes.
    #[must_use]
    pub fn restoring(&self, attitude: &UnitQuaternion<f64>) -> Vector6<f64> {
        let down = attitude.inverse() * Vector3::z();
        let (weight, buoyancy) = (down * self.weight_n(), down * -self.parameters.buoyancy_n);
        let p = &self.parameters;
        let moment = p.centre_of_gravity_m.cross(&weight) + p.centre_of_buoyancy_m.cross(&buoyancy);
        -joined(&(weight + buoyancy), &moment)
    }

    /// `nu'` under a force `tau` (thrusters and disturbance) in body axes.
    #[must_use]
    pub fn acceleration(&self, attitude: &UnitQuaternion<f64>, nu: &Vector6<f64>, tau: &Vector6<f64>) -> Vector6<f64> {
        self.mass.solve(&(tau - self.coriolis(nu) * nu - self.drag(nu) * nu - self.restoring(attitude)))
    }

    /// Kinetic energy of body and water, J.
    #[must_use]
    pub fn kinetic_energy_j(&self, nu: &Vector6<f64>) -> f64 {
        0.5 * nu.dot(&(self.mass() * nu))
    }
}

/// The Coriolis and centripetal matrix of an inertia matrix, in the skew-symmetric form
/// `[[0, -S(p)], [-S(p), -S(h)]]` with `(p, h) = M nu` the linear and angular momentum and `S(a) b = a x b`.
#[must_use]
pub fn coriolis(mass: &Matrix6<f64>, nu: &Vector6<f64>) -> Matrix6<f64> {
    let (linear, angular) = halves(&(mass * nu));
    let (by_linear, by_angular) = (-linear.cross_matrix(), -angular.cross_matrix());
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&by_linear);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&by_linear);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&by_angular);
    matrix
}

/// `M_RB = [[m I, -m S(r_g)], [m S(r_g), I_o]]`.
fn rigid_body_mass(parameters: &VehicleParameters) -> Matrix6<f64> {
    let offset = parameters.centre_of_gravity_m.cross_matrix() * parameters.mass_kg;
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(parameters.mass_kg);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&-offset);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&offset);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&parameters.inertia_kg_m2);
    matrix
}

fn symmetric(name: &'static str, matrix: &Matrix6<f64>) -> Result<(), VehicleError> {
    let (asymmetry, limit) = ((matrix - matrix.transpose()).amax(), Vehicle::TOLERANCE * matrix.amax());
    if asymmetry > limit {
        return Err(VehicleError::Indefinite { matrix: name, property: "symmetric", value: -asymmetry, limit: -limit });
    }
    Ok(())
}

fn positive(name: &'static str, matrix: &Matrix6<f64>) -> Result<Cholesky<f64, U6>, VehicleError> {
    let value = matrix.symmetric_eigenvalues().min();
    matrix.cholesky().filter(|_| value > 0.0).ok_or(VehicleError::Indefinite {
        matrix: name,
        property: "positive definite",
        value,
        limit: 0.0,
    })
}

fn semi_definite(name: &'static str, matrix: &Matrix6<f64>) -> Result<(), VehicleError> {
    let value = ((matrix + matrix.transpose()) * 0.5).symmetric_eigenvalues().min();
    let limit = -Vehicle::TOLERANCE * matrix.amax();
    if value < limit {
        return Err(VehicleError::Indefinite { matrix: name, property: "positive semi-definite", value, limit });
    }
    Ok(())
}
