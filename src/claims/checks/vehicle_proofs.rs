//! Eqs. 5 and 6 as the code has them, in whole numbers: doubles add and multiply these exactly, and a form linear in
//! each argument vanishes where it does for their units. The parameters of Table 2 are random whole numbers: no two
//! axes agree by chance.

use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::{ClaimPart, Distortion, Evidence, Verdict};
use crate::vehicle::{Axis, Vehicle, VehicleParameters, coriolis};

/// A body of mass, inertia and buoyancy in whole numbers, without water and drag.
fn body(mass_kg: f64) -> VehicleParameters {
    VehicleParameters {
        mass_kg,
        inertia_kg_m2: Matrix3::from_diagonal(&Vector3::new(8.0, 16.0, 32.0)),
        centre_of_gravity_m: Vector3::zeros(),
        centre_of_buoyancy_m: Vector3::zeros(),
        buoyancy_n: 0.0,
        added_mass: Matrix6::zeros(),
        linear_drag: Matrix6::zeros(),
        quadratic_drag: Vector6::zeros(),
    }
}

fn unit(place: usize) -> Vector6<f64> {
    Vector6::from_fn(|row, _| if row == place { 1.0 } else { 0.0 })
}

/// A basis of the symmetric matrices.
fn symmetric() -> impl Iterator<Item = Matrix6<f64>> {
    (0..6).flat_map(|i| (0..=i).map(move |j| unit(i) * unit(j).transpose() + unit(j) * unit(i).transpose()))
}

/// Numbers that should be zero; none where a vehicle is refused.
pub type Residuals = Option<Vec<f64>>;

/// Each is zero itself, not zero to rounding.
fn zero(part: ClaimPart, residuals: Residuals) -> Verdict {
    match residuals {
        Some(all) if all.iter().all(|residual| *residual == 0.0) => {
            Verdict::Holds(Evidence::identity(part, 0.0, all.len()))
        }
        _ => Verdict::undecided("whole numbers"),
    }
}

/// The inertia of a body, changed by its centre of gravity, its products of inertia and the water, is symmetric.
fn symmetry(factor: f64) -> Residuals {
    let mut found = Vec::new();
    for mass_kg in [1.0, 2.0] {
        for matrix in symmetric() {
            for place in 0..4 {
                let centre_of_gravity_m = Vector3::from_fn(|row, _| if row == place { 1.0 } else { 0.0 });
                let inertia_kg_m2 = body(mass_kg).inertia_kg_m2 + matrix.fixed_view::<3, 3>(3, 3);
                let parameters = VehicleParameters {
                    centre_of_gravity_m,
                    inertia_kg_m2,
                    added_mass: matrix + Matrix6::identity() * 8.0,
                    ..body(mass_kg)
                };
                let mass = Vehicle::new(parameters).ok()?.mass();
                found.extend((mass - mass.transpose() * factor).iter());
            }
        }
    }
    Some(found)
}

/// `C(nu)`, linear in inertia and velocity, is its transpose's negative: it does no work.
fn skew(factor: f64) -> Residuals {
    let pairs = symmetric().flat_map(|mass| (0..6).map(move |place| coriolis(&mass, &unit(place))));
    Some(pairs.flat_map(|c| (c + c.transpose() * factor).iter().copied().collect::<Vec<_>>()).collect())
}

/// `C(nu) nu` is the effect of turning axes on the momenta `(p, h) = M nu`: `omega x p` and `v x p + omega x h`
/// (Kirchhoff). Quadratic in the velocity: sums of two units decide.
fn turning_momenta(factor: f64) -> Residuals {
    let mut found = Vec::new();
    for (mass, i, j) in symmetric().flat_map(|mass| (0..36).map(move |pair| (mass, pair / 6, pair % 6))) {
        let nu = unit(i) + unit(j);
        let half = |vector: &Vector6<f64>, from| Vector3::new(vector[from], vector[from + 1], vector[from + 2]);
        let momentum = mass * nu;
        let ([v, omega], [p, h]) = ([half(&nu, 0), half(&nu, 3)], [half(&momentum, 0), half(&momentum, 3)]);
        let force = coriolis(&mass, &nu) * nu * factor;
        found.extend((half(&force, 0) - omega.cross(&p)).iter());
        found.extend((half(&force, 3) - v.cross(&p) - omega.cross(&h)).iter());
    }
    Some(found)
}

/// `D(nu)` is the linear drag, and on the diagonal the quadratic drag times the speed.
fn drag(factor: f64) -> Residuals {
    let mut found = Vec::new();
    for linear_drag in symmetric().map(|matrix| matrix + Matrix6::identity() * 8.0) {
        for place in 0..6 {
            let vehicle =
                Vehicle::new(VehicleParameters { linear_drag, quadratic_drag: unit(place), ..body(1.0) }).ok()?;
            for (axis, speed) in (0..6).flat_map(|axis| [-2.0, -1.0, 0.0, 1.0].map(|speed| (axis, speed))) {
                let mut expected = linear_drag;
                expected[(axis, axis)] += if axis == place { f64::abs(speed) } else { 0.0 };
                found.extend((vehicle.drag(&(unit(axis) * speed)) * factor - expected).iter());
            }
        }
    }
    Some(found)
}

/// Inertia times acceleration plus all further forces is the force given: the inertia is a power of two in each
/// axis, for an exact division.
fn balance(factor: f64) -> Residuals {
    let mut found = Vec::new();
    let parameters = VehicleParameters {
        linear_drag: Matrix6::identity(),
        quadratic_drag: Vector6::repeat(2.0),
        centre_of_buoyancy_m: Vector3::new(1.0, 2.0, 0.0),
        buoyancy_n: 16.0,
        ..body(4.0)
    };
    let vehicle = Vehicle::new(VehicleParameters { inertia_kg_m2: Matrix3::identity() * 4.0, ..parameters }).ok()?;
    let level = UnitQuaternion::identity();
    for (i, j, k) in (0..6).flat_map(|i| (0..6).flat_map(move |j| (0..6).map(move |k| (i, j, k)))) {
        let (nu, tau) = (unit(i) - unit(j) * 2.0, unit(k) * 3.0 + vehicle.restoring(&level));
        let rate = vehicle.acceleration(&level, &nu, &tau);
        let others = vehicle.coriolis(&nu) * nu + vehicle.drag(&nu) * nu - unit(k) * 3.0;
        found.extend((vehicle.mass() * rate * factor + others).iter());
    }
    Some(found)
}

/// Eq. 5.
pub(super) fn six_axes(part: &ClaimPart, distortion: Distortion) -> Verdict {
    let factor = distortion.factor();
    Verdict::all([symmetry, skew, turning_momenta, drag, balance].map(|proof| zero(part.clone(), proof(factor))))
}

/// Vehicles of Table 2's form, every parameter a random whole number; inertias of three axes that are those of a body.
fn table_2() -> impl Iterator<Item = VehicleParameters> {
    let mut generator = Pcg64::seed_from_u64(2);
    core::iter::repeat_with(move || {
        let mut whole = |below: u32| f64::from(generator.random_range(0..below));
        let [x, y, z] = [whole(50), whole(50), whole(50)].map(|square| square + 1.0);
        VehicleParameters {
            inertia_kg_m2: Matrix3::from_diagonal(&Vector3::new(y + z, x + z, x + y)),
            buoyancy_n: whole(200),
            added_mass: Matrix6::from_diagonal(&Vector6::from_fn(|_, _| whole(50))),
            linear_drag: symmetric().map(|matrix| matrix * whole(2)).sum::<Matrix6<f64>>() + Matrix6::identity() * 32.0,
            quadratic_drag: Vector6::from_fn(|_, _| whole(9)),
            centre_of_buoyancy_m: Vector3::new(1.0, -2.0, 3.0),
            ..body(1.0 + whole(40))
        }
    })
    .take(200)
}

/// With the other axes at rest and the vehicle level: no force by `C(nu)` in the axis, Table 2's inertia by itself, drag by its
/// own coefficients, and weight less buoyancy in heave alone.
pub(super) fn uncoupled_axis(part: &ClaimPart, distortion: Distortion) -> Verdict {
    zero(part.clone(), table_2_entries(distortion.factor(), 2))
}

/// `turning` is the axis whose moment of inertia yaw takes.
pub fn table_2_entries(factor: f64, turning: usize) -> Residuals {
    let mut found = Vec::new();
    for (axis, i) in Axis::ALL.map(|axis| (axis, axis.index())) {
        for place in 0..6 {
            let mass = Matrix6::from_diagonal(&unit(place));
            found.push((coriolis(&mass, &unit(i)) * unit(i))[i]);
        }
        for parameters in table_2() {
            let vehicle = Vehicle::new(parameters).ok()?;
            let p = vehicle.parameters();
            let inertia = if axis == Axis::Yaw { p.inertia_kg_m2[(turning, turning)] } else { p.mass_kg };
            let mass = vehicle.mass();
            found.push(mass[(i, i)] * factor - (inertia + p.added_mass[(i, i)]));
            found.extend((0..6).filter(|&j| j != i).map(|j| mass[(i, j)]));
            let surplus = if axis == Axis::Heave { vehicle.weight_n() - p.buoyancy_n } else { 0.0 };
            found.push(vehicle.restoring(&UnitQuaternion::identity())[i] + surplus);
            for speed in [-2.0, -1.0, 1.0, 2.0] {
                let nu = unit(i) * speed;
                let own = (p.linear_drag[(i, i)] + p.quadratic_drag[i] * f64::abs(speed)) * speed;
                found.push((vehicle.drag(&nu) * nu)[i] - own);
            }
        }
    }
    Some(found)
}
