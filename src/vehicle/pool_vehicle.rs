//! A small inspection vehicle to try methods on.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::{MountedThruster, STANDARD_GRAVITY, ThrustSide, Thruster, Vehicle, VehicleError, VehicleParameters};

/// Mass as published for the vehicle of the paper, kg.
const MASS_KG: f64 = 3.5;
/// Distance of the horizontal thrusters from the middle, m.
const ARM_M: f64 = 0.08;
/// One hold of a 10 Hz command on its way, s (eq. 36).
const DELAY_S: f64 = 0.1;

/// A vehicle of the size and mass of a VideoRay (0.355 m long, 3.5 kg), a little buoyant, centre of gravity below the middle.
///
/// Apart from mass all numbers are this project's own: plausible for the size, with yaw inertia and drag of the order that
/// Table 4 identifies, small couplings between sway and yaw and between heave and pitch, and not measured on anything.
///
/// # Errors
/// None in practice; the parameters pass the checks every vehicle passes.
pub fn pool_vehicle() -> Result<Vehicle, VehicleError> {
    let mut added_mass = Matrix6::from_diagonal(&Vector6::new(1.9, 6.1, 4.0, 0.010, 0.020, 0.011));
    for (row, column, coupling) in [(1, 5, 0.05), (2, 4, -0.05)] {
        added_mass[(row, column)] = coupling;
        added_mass[(column, row)] = coupling;
    }
    Vehicle::new(VehicleParameters {
        mass_kg: MASS_KG,
        inertia_kg_m2: Matrix3::from_diagonal(&Vector3::new(0.017, 0.030, 0.022)),
        centre_of_gravity_m: Vector3::new(0.0, 0.0, 0.02),
        centre_of_buoyancy_m: Vector3::new(0.0, 0.0, -0.005),
        buoyancy_n: MASS_KG * STANDARD_GRAVITY + 0.2,
        added_mass,
        linear_drag: Matrix6::from_diagonal(&Vector6::new(1.0, 3.0, 3.0, 0.02, 0.03, 0.010)),
        quadratic_drag: Vector6::new(6.0, 25.0, 20.0, 0.01, 0.02, 0.060),
    })
}

/// Its thrusters: port and starboard at the arm of eq. 35, weaker astern than ahead, and a vertical thruster with thrust downwards;
/// commands from -200 to 200 with a dead zone of 15, delayed by 0.1 s. The numbers are this project's own.
///
/// # Errors
/// None in practice, as for [`pool_vehicle`].
pub fn pool_thrusters() -> Result<[MountedThruster; 3], VehicleError> {
    let horizontal = Thruster::asymmetric(
        ThrustSide::new(1.5e-4, 0.010, 15.0, 200.0)?,
        ThrustSide::new(1.0e-4, 0.008, 15.0, 200.0)?,
    );
    let vertical = Thruster::affine(5.0e-5, 0.005, 15.0, 200.0)?;
    Ok([
        MountedThruster::new(horizontal, Vector3::new(0.0, -ARM_M, 0.0), Vector3::x(), DELAY_S)?,
        MountedThruster::new(horizontal, Vector3::new(0.0, ARM_M, 0.0), Vector3::x(), DELAY_S)?,
        MountedThruster::new(vertical, Vector3::zeros(), Vector3::z(), DELAY_S)?,
    ])
}
