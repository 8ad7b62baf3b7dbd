//! The vehicle around the identified axis: thrusters, allocation, compensation, kinematics, dynamics, reduction to axes.
//!
//! Body axes are forward, starboard, down; the Earth's are north, east, down. A velocity `nu` is (u, v, w, p, q, r) in m/s
//! and rad/s, a force `tau` is (X, Y, Z, K, M, N) in N and N m, both in body axes.
//!
//! Thrusters, fixed-size allocation and the compensation chain need neither `std` nor a heap.
//!
//! | file | content | source |
//! |---|---|---|
//! | `thruster` | thrust by command and back: dead zone, saturation, asymmetry | eqs. 2, 3 |
//! | `bilinear_thruster` | thrust and torque in moving water | eq. 1 |
//! | `allocation` | forces by thrusts and back, closed form and pseudo-inverse | eq. 35 |
//! | `limited_allocation` | the same within thrust limits | |
//! | `compensation` | what stands between the controller and the thrusters | Fig. 11 |
//! | `thruster_map` | a thruster identified from dynamometer points | Fig. 9 |
//! | `kinematics` | Euler angles and quaternions | eq. 4 |
//! | `dynamics` | six degrees of freedom | eq. 5 |
//! | `simulation` | the same in time, with thrusters and delays | eq. 5 |
//! | `reduction` | uncoupled axes and what they neglect | eq. 6, Table 2 |
//! | `trial` | the experiment on board, carried out on all this | eqs. 36, 43, 44 |
//! | `pool_vehicle` | a small inspection vehicle to try all this on | |

mod allocation;
mod bilinear_thruster;
mod compensation;
#[cfg(feature = "std")]
mod dynamics;
mod error;
#[cfg(feature = "std")]
mod kinematics;
#[cfg(feature = "std")]
mod limited_allocation;
#[cfg(feature = "std")]
mod pool_vehicle;
#[cfg(feature = "std")]
mod reduction;
#[cfg(feature = "std")]
mod simulation;
#[cfg(all(test, feature = "std"))]
mod tests;
mod thruster;
#[cfg(feature = "std")]
mod thruster_map;
#[cfg(feature = "std")]
mod trial;

pub use allocation::Allocation;
pub use bilinear_thruster::BilinearThruster;
#[cfg(feature = "std")]
pub(crate) use bilinear_thruster::bilinear;
pub use compensation::Compensation;
#[cfg(feature = "std")]
pub use dynamics::{Vehicle, VehicleParameters};
internal! {
    #[cfg(feature = "std")]
    use dynamics::{STANDARD_GRAVITY, coriolis};
}
pub use error::VehicleError;
#[cfg(feature = "std")]
pub use kinematics::{EulerAngles, Pose};
#[cfg(feature = "std")]
pub use limited_allocation::{LimitedAllocation, LimitedThrusts};
#[cfg(feature = "std")]
pub use pool_vehicle::{pool_thrusters, pool_vehicle};
#[cfg(feature = "std")]
pub use reduction::{Axis, AxisParameters, Motion, Neglected};
#[cfg(feature = "std")]
pub use simulation::{BodyState, MountedThruster, Simulation};
pub use thruster::{Delivered, ThrustSide, Thruster};
#[cfg(feature = "std")]
pub use thruster_map::{DynamometerPoint, FittedSide, ThrusterMap};
#[cfg(feature = "std")]
pub use trial::{Trial, TrialRun};
