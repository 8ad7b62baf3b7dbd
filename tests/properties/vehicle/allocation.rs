//! Allocation, with and without limits, and the compensation chain.

use nalgebra::{DMatrix, DVector};
use proptest::array::{uniform2, uniform3, uniform4};
use proptest::prelude::*;
use selfosc::numeric::Scalar;
use selfosc::vehicle::{Allocation, Compensation, LimitedAllocation, ThrustSide, Thruster, VehicleError};

use crate::tolerance::{ALLOCATION_COST, ALLOCATION_EFFORT, THRUST_ROUND_TRIP_F32, VEHICLE_ALGEBRA};

type Wide = [[f64; 4]; 3];

fn unit() -> std::ops::Range<f64> {
    -1.0..1.0
}

/// Three axes by four thrusters, well conditioned.
fn wide() -> impl Strategy<Value = Wide> {
    uniform3(uniform4(unit())).prop_filter("singular values above 0.05", |matrix| {
        DMatrix::from_fn(3, 4, |i, j| matrix[i][j]).singular_values().min() > 0.05
    })
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| most.max(value.abs()))
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn in_dead_zone(refusal: &VehicleError) -> bool {
    matches!(refusal, VehicleError::InDeadZone { .. })
}

fn thruster() -> Thruster<f64> {
    Thruster::asymmetric(
        ThrustSide::new(1.5e-4, 0.01, 15.0, 200.0).unwrap(),
        ThrustSide::new(1.0e-4, 0.008, 15.0, 200.0).unwrap(),
    )
}

/// Forces delivered less those asked for and the bias: zero up to rounding.
fn identity_error<T: Scalar, const AXES: usize, const THRUSTERS: usize>(
    chain: &Compensation<T, AXES, THRUSTERS>,
    forces: &[T; AXES],
    actual: &[Thruster<T>; THRUSTERS],
) -> Result<[T; AXES], VehicleError> {
    let (delivered, bias) = (chain.delivered(&chain.commands(forces)?, actual), chain.bias_forces());
    Ok(std::array::from_fn(|i| delivered[i] - bias[i] - forces[i]))
}

proptest! {
    #![proptest_config(crate::sampling::recorded(256))]

    #[test]
    fn the_pair_is_the_matrix_of_eq_35(arm in 0.01..1.0_f64, forces in uniform2(unit())) {
        let pair = Allocation::pair(arm).unwrap();
        let general = Allocation::from_matrix([[1.0, 1.0], [arm, -arm]]).unwrap();
        let (closed, pseudo) = (pair.thrusts(&forces), general.thrusts(&forces));
        prop_assert!(largest((0..2).map(|i| closed[i] - pseudo[i])) < VEHICLE_ALGEBRA / arm);
        let back = pair.forces(&closed);
        prop_assert!(largest((0..2).map(|i| back[i] - forces[i])) < VEHICLE_ALGEBRA);
        // False variant: port and starboard exchanged.
        let swapped = pair.forces(&[closed[1], closed[0]]);
        prop_assert!((swapped[1] - forces[1]).abs() > VEHICLE_ALGEBRA || forces[1].abs() < 1e-9);
    }

    #[test]
    fn more_thrusters_than_axes_meet_the_forces_with_least_effort(
        matrix in wide(), forces in uniform3(unit()), other in uniform4(unit()),
    ) {
        let allocation = Allocation::from_matrix(matrix).unwrap();
        let thrusts = allocation.thrusts(&forces);
        let back = allocation.forces(&thrusts);
        prop_assert!(largest((0..3).map(|i| back[i] - forces[i])) < 100.0 * VEHICLE_ALGEBRA);
        // Any other answer: add a vector that the allocation maps to nothing.
        let seen = allocation.thrusts(&allocation.forces(&other));
        let unseen: [f64; 4] = std::array::from_fn(|j| other[j] - seen[j]);
        let with_unseen: [f64; 4] = std::array::from_fn(|j| thrusts[j] + unseen[j]);
        prop_assert!(largest(allocation.forces(&unseen)) < 100.0 * VEHICLE_ALGEBRA);
        prop_assert!(norm(&with_unseen) >= norm(&thrusts) - VEHICLE_ALGEBRA);
        // False variant: the transpose is no inverse.
        let transposed = std::array::from_fn(|j| (0..3).map(|i| matrix[i][j] * forces[i]).sum());
        let wrong = allocation.forces(&transposed);
        prop_assert!(largest((0..3).map(|i| wrong[i] - forces[i])) > 1e-6 || norm(&forces) < 1e-3);
    }

    #[test]
    fn fewer_thrusters_than_axes_miss_by_what_no_thruster_sees(matrix in wide(), forces in uniform4(unit())) {
        let tall: [[f64; 3]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| matrix[j][i]));
        let allocation = Allocation::from_matrix(tall).unwrap();
        let given = allocation.forces(&allocation.thrusts(&forces));
        for row in matrix {
            let seen: f64 = (0..4).map(|i| row[i] * (forces[i] - given[i])).sum();
            prop_assert!(seen.abs() < 100.0 * VEHICLE_ALGEBRA);
        }
    }

    #[test]
    fn dependent_axes_are_named(matrix in wide(), mix in uniform2(unit())) {
        let dependent: [f64; 4] = std::array::from_fn(|j| mix[0] * matrix[0][j] + mix[1] * matrix[1][j]);
        let refused = Allocation::from_matrix([matrix[0], matrix[1], dependent]).unwrap_err();
        prop_assert!(matches!(refused, VehicleError::RankDeficient { rank: 2, needed: 3, .. }), "{}", refused);
    }

    #[test]
    fn limits_cost_least(
        matrix in wide(), demand in uniform3(-4.0..4.0_f64), weights in uniform3(0.1..10.0_f64),
        lower in uniform4(-1.0..0.2_f64), range in uniform4(0.1..2.0_f64),
    ) {
        let effort = 1e-4;
        let limits: [(f64, f64); 4] = std::array::from_fn(|j| (lower[j], lower[j] + range[j]));
        let allocation = Allocation::from_matrix(matrix).unwrap();
        let answer = LimitedAllocation::new(allocation, weights, limits, effort).unwrap().thrusts(&demand).unwrap();
        let cost = |thrusts: &[f64; 4]| {
            let forces = allocation.forces(thrusts);
            let misses: [f64; 3] = std::array::from_fn(|i| weights[i] * (forces[i] - demand[i]));
            norm(&misses).powi(2) + effort * norm(thrusts).powi(2)
        };
        let inside = |thrusts: &[f64; 4]| (0..4).all(|j| (limits[j].0..=limits[j].1).contains(&thrusts[j]));
        prop_assert!(inside(&answer.thrusts_n));
        prop_assert_eq!(answer.forces, allocation.forces(&answer.thrusts_n));
        // Oracle: every choice of free and held thrusters, by the normal equations.
        let best = best_of_all_active_sets(&matrix, &weights, &demand, &limits, effort);
        prop_assert!(cost(&answer.thrusts_n) <= cost(&best) * (1.0 + ALLOCATION_COST) + 1e-12);
        // False variant: clamping the unlimited answer is dearer, unless no limit matters.
        let clamped = allocation.thrusts(&demand);
        let clamped = std::array::from_fn(|j| clamped[j].clamp(limits[j].0, limits[j].1));
        prop_assert!(cost(&clamped) >= cost(&answer.thrusts_n) * (1.0 - ALLOCATION_COST));
    }

    #[test]
    fn wide_limits_change_nothing(matrix in wide(), forces in uniform3(unit())) {
        let allocation = Allocation::from_matrix(matrix).unwrap();
        let limited = LimitedAllocation::new(allocation, [1.0; 3], [(-100.0, 100.0); 4], 1e-10).unwrap();
        let (answer, free) = (limited.thrusts(&forces).unwrap(), allocation.thrusts(&forces));
        let scale = 1.0 + largest(free);
        prop_assert!(largest((0..4).map(|j| answer.thrusts_n[j] - free[j])) < ALLOCATION_EFFORT * scale);
        prop_assert_eq!(answer.saturated, [false; 4]);
    }

    #[test]
    fn compensation_is_the_identity_within_limits(surge in -4.0..6.0_f64, yaw in -0.3..0.3_f64) {
        let thrusters = [thruster(); 2];
        let chain = Compensation::new(Allocation::pair(0.08).unwrap(), thrusters);
        let error = |actual| identity_error(&chain, &[surge, yaw], &actual).map(largest);
        match error(thrusters) {
            Ok(error) => prop_assert!(error < VEHICLE_ALGEBRA),
            Err(VehicleError::Saturated { thrust_n, largest_n, .. }) => prop_assert!(thrust_n.abs() > largest_n.abs()),
            Err(other) => prop_assert!(in_dead_zone(&other), "{other}"),
        }
        // False variant: a thruster that is 1 % weaker than its map.
        let weaker = Thruster::affine(1.485e-4, 0.0099, 15.0, 200.0).unwrap();
        if let Ok(error) = error([weaker; 2]) {
            prop_assert!(error > 1e-4 || (surge.abs() < 0.02 && yaw.abs() < 0.02));
        }
    }

    #[test]
    fn the_offset_keeps_every_force_out_of_the_dead_zone(
        largest_yaw in 0.01..0.25_f64, fraction in prop_oneof![-1.0..1.0_f64, Just(-1.0), Just(1.0)], astern: bool,
    ) {
        let (thrusters, pair) = ([thruster(); 2], Allocation::pair(0.08).unwrap());
        let direction = if astern { [-1.0; 2] } else { [1.0; 2] };
        let chain = Compensation::against_dead_zone(pair, thrusters, direction, [0.0, largest_yaw]).unwrap();
        let commands = chain.commands(&[0.0, fraction * largest_yaw]).unwrap();
        prop_assert!(commands.iter().all(|command| command * direction[0] >= 15.0));
        let error = identity_error(&chain, &[0.0, fraction * largest_yaw], &thrusters).unwrap();
        prop_assert!(largest(error) < VEHICLE_ALGEBRA);
        // False variants: no offset near zero, and one step past the force it was made for.
        let bare = Compensation::new(pair, thrusters);
        prop_assert!(bare.commands(&[0.0, 1e-3]).is_err_and(|refusal| in_dead_zone(&refusal)));
        let beyond = chain.commands(&[0.0, largest_yaw * 1.01]);
        prop_assert!(beyond.is_err_and(|refusal| in_dead_zone(&refusal)));
    }
}

/// The chain as a microcontroller has it.
#[test]
fn compensation_in_single_precision() {
    let thrusters = [Thruster::affine(1.5e-4_f32, 0.01, 15.0, 200.0).unwrap(); 2];
    let pair = Allocation::pair(0.08_f32).unwrap();
    let chain = Compensation::against_dead_zone(pair, thrusters, [1.0; 2], [0.0, 0.2]).unwrap();
    for fraction in [-1.0, -0.3, 0.0, 0.7, 1.0] {
        let error = identity_error(&chain, &[0.0, 0.2 * fraction], &thrusters).unwrap();
        assert!(largest(error.map(f64::from)) < THRUST_ROUND_TRIP_F32, "{error:?}");
    }
}

/// The cheapest allocation over all 3^4 choices of free, lower and upper, each solved by its normal equations.
fn best_of_all_active_sets(
    matrix: &Wide,
    weights: &[f64; 3],
    demand: &[f64; 3],
    limits: &[(f64, f64); 4],
    effort: f64,
) -> [f64; 4] {
    let weighted = DMatrix::from_fn(3, 4, |i, j| weights[i] * matrix[i][j]);
    let target = DVector::from_fn(3, |i, _| weights[i] * demand[i]);
    let cost = |x: &DVector<f64>| (&weighted * x - &target).norm_squared() + effort * x.norm_squared();
    let mut best: Option<DVector<f64>> = None;
    for choice in 0..81_usize {
        let place = |j: usize| choice / 3_usize.pow(j as u32) % 3;
        let mut hessian = weighted.tr_mul(&weighted) + DMatrix::identity(4, 4) * effort;
        let mut right = weighted.tr_mul(&target);
        for j in (0..4).filter(|&j| place(j) > 0) {
            // The row of a held thruster says that it is held.
            hessian.row_mut(j).fill(0.0);
            hessian[(j, j)] = 1.0;
            right[j] = if place(j) == 1 { limits[j].0 } else { limits[j].1 };
        }
        let Some(point) = hessian.lu().solve(&right) else { continue };
        let feasible = (0..4).all(|j| point[j] >= limits[j].0 - 1e-12 && point[j] <= limits[j].1 + 1e-12);
        if feasible && best.as_ref().is_none_or(|other| cost(&point) < cost(other)) {
            best = Some(point);
        }
    }
    let best = best.unwrap();
    std::array::from_fn(|j| best[j])
}

/// Clamping the unlimited answer is not the best answer: else the search within limits would be needless.
#[test]
fn clamping_is_dearer_somewhere() {
    let pair = Allocation::pair(0.08).unwrap();
    let limited = LimitedAllocation::new(pair, [1.0, 100.0], [(-2.0, 4.0); 2], 1e-9).unwrap();
    let answer = limited.thrusts(&[0.0, 0.4]).unwrap();
    let clamped = pair.forces(&pair.thrusts(&[0.0, 0.4]).map(|thrust| thrust.clamp(-2.0, 4.0)));
    let cost = |forces: [f64; 2]| forces[0].powi(2) + (100.0 * (forces[1] - 0.4)).powi(2);
    assert!(cost(answer.forces) < 0.99 * cost(clamped), "{answer:?} against {clamped:?}");
}

#[test]
fn what_the_chain_cannot_do_is_refused_with_numbers() {
    let (pair, thrusters) = (Allocation::pair(0.08).unwrap(), [thruster(); 2]);
    let chain = Compensation::new(pair, thrusters);
    assert!(
        matches!(chain.commands(&[0.0, 1.0]), Err(VehicleError::Saturated { thruster: 1, largest_n, .. }) if largest_n < -5.5)
    );
    assert_eq!(chain.commands_clamped(&[0.0, 2.0]), Ok([200.0, -200.0]));
    assert!(matches!(chain.commands(&[f64::NAN, 0.0]), Err(VehicleError::OutOfDomain { .. })));
    let too_much = Compensation::against_dead_zone(pair, thrusters, [1.0; 2], [0.0, 1.0]);
    assert!(matches!(too_much, Err(VehicleError::Saturated { thruster: 0, .. })));
    assert!(Compensation::against_dead_zone(pair, thrusters, [1.0, 0.0], [0.0, 0.1]).is_err());
    assert!(Allocation::pair(0.0).is_err());
    let limited = LimitedAllocation::new(pair, [1.0; 2], [(-2.0, 4.0); 2], 1e-9).unwrap();
    assert!([f64::NAN, f64::MAX].iter().all(|&force| limited.thrusts(&[force, 0.0]).is_err()));
    assert!(matches!(Allocation::from_matrix([[0.0]]), Err(VehicleError::RankDeficient { rank: 0, needed: 1, .. })));
    assert!(Allocation::from_matrix([[f64::NAN, 1.0]]).is_err());
    // Opposed thrusters: the offset is felt by nobody.
    let opposed = Allocation::from_matrix([[1.0, -1.0]]).unwrap();
    let silent = Compensation::against_dead_zone(opposed, thrusters, [1.0; 2], [2.0]).unwrap();
    assert_eq!(silent.bias_forces(), [0.0]);
    assert!(identity_error(&silent, &[0.01], &thrusters).unwrap()[0].abs() < VEHICLE_ALGEBRA);
}
