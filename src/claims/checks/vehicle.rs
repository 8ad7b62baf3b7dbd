//! The vehicle in six degrees of freedom and its uncoupled axes: eqs. 4-6, Table 2.

use nalgebra::{Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3, Vector6};

use super::vehicle_proofs::{six_axes, uncoupled_axis};
use super::{Case, ClaimPart, Draw, claim, tolerance};
use crate::vehicle::{Axis, EulerAngles, Pose, Vehicle, VehicleParameters};

/// A vector with entries up to `bound`.
fn vector3(draw: &mut Draw, bound: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| draw.unrecorded(-bound, bound))
}

fn vector6(draw: &mut Draw, bound: f64) -> Vector6<f64> {
    Vector6::from_fn(|_, _| draw.unrecorded(-bound, bound))
}

/// Any roll and yaw, pitch within `steepest_rad` of level.
fn angles(draw: &mut Draw, steepest_rad: f64) -> EulerAngles {
    EulerAngles {
        roll_rad: draw.uniform("roll_rad", -3.0, 3.0),
        pitch_rad: draw.uniform("pitch_rad", -steepest_rad, steepest_rad),
        yaw_rad: draw.uniform("yaw_rad", -3.0, 3.0),
    }
}

claim! {
    KINEMATICS = "kinematics" Identity
    "J1 is a rotation, J2 the inverse of the matrix from Euler rates to body rates; both agree with quaternions";
    printed Holds kinematics(EulerAngles::rate_matrix);
    // Body rates taken for Euler rates.
    false kinematics(|_| Ok(Matrix3::identity()));
    needs "not-upright" upright();
    not_proved "rotations come from a library that has floats alone";
}

type RateMatrix = fn(&EulerAngles) -> Result<Matrix3<f64>, crate::vehicle::VehicleError>;

fn kinematics(draw: &mut Draw, rate_matrix: RateMatrix) -> Option<Case> {
    let (angles, omega) = (angles(draw, 1.4), vector3(draw, 2.0));
    let Ok(to_rates) = rate_matrix(&angles) else { return Some(Case::truth(false)) };
    let rotation = *angles.rotation().matrix();
    let (yaw, pitch) = (turn(Vector3::z(), angles.yaw_rad), turn(Vector3::y(), angles.pitch_rad));
    let product = yaw * pitch * turn(Vector3::x(), angles.roll_rad);
    // How the product of the three turns changes while the angles do.
    let rates = to_rates * omega;
    let spin = |axis: Vector3<f64>| axis.cross_matrix();
    let moving = spin(Vector3::z()) * product * rates.z
        + yaw * spin(Vector3::y()) * yaw.transpose() * product * rates.y
        + product * spin(Vector3::x()) * rates.x;
    // How the quaternion's rotation does: q v q* differentiated.
    let pose = Pose::new(Vector3::zeros(), angles);
    let (_, quaternion_rate) = pose.rate(&Vector6::new(0.0, 0.0, 0.0, omega.x, omega.y, omega.z));
    let (q, q_rate) = (pose.attitude.into_inner(), Quaternion::from_vector(quaternion_rate));
    let carried = |v: Vector3<f64>| {
        let v = Quaternion::from_imag(v);
        (q_rate * v * q.conjugate() + q * v * q_rate.conjugate()).imag()
    };
    let by_quaternion = Matrix3::from_columns(&[Vector3::x(), Vector3::y(), Vector3::z()].map(carried));
    let scale = 1.0 + rates.norm();
    let equations = [
        ("orthogonal", (rotation * rotation.transpose() - Matrix3::identity()).amax(), 0.0, scale),
        ("three_turns", (rotation - product).amax(), 0.0, scale),
        ("euler_rates", (moving - rotation * spin(omega)).amax(), 0.0, scale),
        ("quaternion", (by_quaternion - rotation * spin(omega)).amax(), 0.0, scale),
        ("determinant", rotation.determinant(), 1.0, 1.0),
    ];
    Some(draw.equations(equations, tolerance::ROUNDING))
}

/// Rodrigues' formula.
fn turn(axis: Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let s = axis.cross_matrix();
    Matrix3::identity() + s * libm::sin(angle) + s * s * (1.0 - libm::cos(angle))
}

/// At pitch +-90 degrees there is no rate matrix.
fn upright(draw: &mut Draw) -> Option<Case> {
    let side = if draw.index("down", 2) == 0 { 1.0 } else { -1.0 };
    let pitch_rad = draw.note("pitch_rad", side * core::f64::consts::FRAC_PI_2);
    Some(Case::truth(EulerAngles { pitch_rad, ..angles(draw, 1.4) }.rate_matrix().is_ok()))
}

/// A vehicle with every term of eq. 5: a body of eight points, and water and drag as sums of squares.
fn parameters(draw: &mut Draw) -> VehicleParameters {
    let points: [(f64, Vector3<f64>); 8] = core::array::from_fn(|_| (draw.unrecorded(0.1, 1.0), vector3(draw, 0.3)));
    let mass_kg: f64 = points.iter().map(|(mass, _)| mass).sum();
    let inertia =
        |(mass, r): &(f64, Vector3<f64>)| (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *mass;
    let mut square = || {
        let half = Matrix6::from_fn(|_, _| draw.unrecorded(-1.0, 1.0));
        let product = half * half.transpose();
        (product + product.transpose()) * 0.5
    };
    VehicleParameters {
        mass_kg,
        inertia_kg_m2: points.iter().map(inertia).sum(),
        centre_of_gravity_m: points.iter().map(|(mass, r)| r * *mass).sum::<Vector3<f64>>() / mass_kg,
        added_mass: square(),
        linear_drag: square(),
        centre_of_buoyancy_m: vector3(draw, 0.1),
        buoyancy_n: draw.uniform("buoyancy_n", 0.0, 80.0),
        quadratic_drag: vector6(draw, 5.0).abs(),
    }
}

claim! {
    SIX_AXES = "six-axes" Identity
    "M is symmetric positive definite, C(nu) does no work, D(nu) takes energy, and eq. 5 balances";
    printed Holds structure(|_| {}, |coriolis| coriolis);
    // A block of C with the wrong sign.
    false structure(|_| {}, |mut coriolis| { coriolis.fixed_view_mut::<3, 3>(0, 3).neg_mut(); coriolis });
    needs "inertia-of-a-body" structure(|p| p.centre_of_gravity_m.x += 3.0, |coriolis| coriolis);
    needs "added-mass-symmetric" structure(|p| p.added_mass[(0, 1)] += 0.1, |coriolis| coriolis);
    needs "drag-coefficients-dissipate"
        structure(|p| p.linear_drag -= Matrix6::identity() * 20.0, |coriolis| coriolis);
    proof |distortion| six_axes(&ClaimPart::WHOLE, distortion);
}

/// A vehicle that is refused, with the reason that its matrices do not allow it, fails.
fn structure(
    draw: &mut Draw,
    change: fn(&mut VehicleParameters),
    coriolis: fn(Matrix6<f64>) -> Matrix6<f64>,
) -> Option<Case> {
    let mut parameters = parameters(draw);
    change(&mut parameters);
    let Ok(vehicle) = Vehicle::new(parameters) else { return Some(Case::truth(false)) };
    let (mass, nu, tau) = (vehicle.mass(), vector6(draw, 2.0), vector6(draw, 20.0));
    let attitude = UnitQuaternion::from_rotation_matrix(&angles(draw, 1.4).rotation());
    let (c, drag) = (coriolis(vehicle.coriolis(&nu)), vehicle.drag(&nu) * nu);
    let rate = vehicle.acceleration(&attitude, &nu, &tau);
    let rest = mass * rate + c * nu + drag + vehicle.restoring(&attitude) - tau;
    let scale = mass.amax() * (nu.norm_squared() + rate.amax()) + drag.amax() + tau.amax();
    let (asymmetry, work) = ((mass - mass.transpose()).amax(), nu.dot(&(c * nu)));
    let energy = Case::truth(vehicle.kinetic_energy_j(&nu) > 0.0 && nu.dot(&drag) > 0.0);
    let equations = [
        ("asymmetry", asymmetry, 0.0, mass.amax()),
        ("work_of_c", work, 0.0, scale * nu.norm()),
        ("balance", rest.amax(), 0.0, scale),
    ];
    Some(draw.equations(equations, tolerance::ROUNDING).and(energy))
}

claim! {
    UNCOUPLED_AXIS = "uncoupled-axis" Theorem
    "Of a symmetric, level vehicle whose other axes are at rest, an axis accelerates by eq. 5 as by eq. 6";
    printed Holds reduction(&Assumed::ALL);
    // Inertia without the water's.
    false reduction(&Assumed { water: 0.0, ..Assumed::ALL });
    needs "others-at-rest" reduction(&Assumed { others: 1.0, ..Assumed::ALL });
    needs "level" reduction(&Assumed { tilt_rad: 0.3, ..Assumed::ALL });
    needs "gravity-at-origin" reduction(&Assumed { offset: 1.0, ..Assumed::ALL });
    needs "axes-of-inertia" reduction(&Assumed { products: 1.0, ..Assumed::ALL });
    needs "water-uncoupled" reduction(&Assumed { coupling: 1.0, ..Assumed::ALL });
    proof |distortion| uncoupled_axis(&ClaimPart::WHOLE, distortion);
}

/// Sizes of the terms that the reduction omits.
struct Assumed {
    others: f64,
    tilt_rad: f64,
    offset: f64,
    products: f64,
    coupling: f64,
    /// Share of the added mass that the axis is given.
    water: f64,
}

impl Assumed {
    const ALL: Self = Self { others: 0.0, tilt_rad: 0.0, offset: 0.0, products: 0.0, coupling: 0.0, water: 1.0 };
}

/// The diagonal, and a share of the rest.
fn partly<const N: usize>(matrix: nalgebra::SMatrix<f64, N, N>, share: f64) -> nalgebra::SMatrix<f64, N, N> {
    matrix.map_with_location(|row, column, entry| if row == column { entry } else { share * entry })
}

fn reduction(draw: &mut Draw, assumed: &Assumed) -> Option<Case> {
    let full = parameters(draw);
    let parameters = VehicleParameters {
        centre_of_gravity_m: full.centre_of_gravity_m * assumed.offset,
        inertia_kg_m2: partly(full.inertia_kg_m2, assumed.products),
        added_mass: partly(full.added_mass, assumed.coupling),
        ..full
    };
    let vehicle = Vehicle::new(parameters).ok()?;
    let axis = Axis::ALL[draw.index("axis", Axis::ALL.len())];
    let i = axis.index();
    let (speed, force) = (draw.uniform("speed", -2.0, 2.0), draw.uniform("force", -20.0, 20.0));
    let (mut nu, mut tau) = (vector6(draw, 1.0) * assumed.others, Vector6::zeros());
    (nu[i], tau[i]) = (speed, force);
    let disturbance = vector6(draw, 5.0);
    let attitude =
        UnitQuaternion::from_euler_angles(assumed.tilt_rad, assumed.tilt_rad, draw.uniform("yaw_rad", -3.0, 3.0));
    // Table 2 in its own terms.
    let inertia = if axis == Axis::Yaw { parameters.inertia_kg_m2[(2, 2)] } else { parameters.mass_kg };
    let alpha = inertia + assumed.water * parameters.added_mass[(i, i)];
    let beta = parameters.linear_drag[(i, i)] + parameters.quadratic_drag[i] * speed.abs();
    let surplus = if axis == Axis::Heave { vehicle.weight_n() - parameters.buoyancy_n } else { 0.0 };
    let by_eq_6 = (force + disturbance[i] + surplus - beta * speed) / alpha;
    let mut external = Vector6::zeros();
    external[i] = disturbance[i];
    let by_eq_5 = vehicle.acceleration(&attitude, &nu, &(tau + external))[i];
    Some(draw.equal(("by_eq_5", by_eq_5), by_eq_6, 150.0 / alpha, tolerance::ROUNDING))
}
