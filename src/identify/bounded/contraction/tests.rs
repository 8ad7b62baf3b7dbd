use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::simulated::{Known, VehicleTerms};
use super::*;

/// Error of the integration of the truth.
const OFF: f64 = 1e-7;
const BOXES: usize = 30;

/// Boxes that contain the truth, from wide to narrow.
fn about(Known { problem, truth, .. }: &Known, random: &mut Pcg64Mcg) -> Vec<Interval> {
    let width = 10f64.powf(random.random_range(-4.0..0.0));
    let mut at = problem.search.clone();
    for (side, value) in at.iter_mut().zip(truth).take(problem.unknowns.parameters()) {
        let size = width * value.abs().max(0.1);
        let below = size * random.random_range(0.01..1.0);
        let own = Interval::new(value - below, value + size - below).expect("an interval");
        *side = side.intersection(own).expect("the truth is in the search box");
    }
    at
}

/// The number of boxes about the truth that are followed; contraction leaves the truth in each.
fn followed(vehicle: &VehicleTerms, delay_known: bool, seed: u64) -> usize {
    let known = Known::of(vehicle, 110, delay_known);
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut followed = 0;
    for number in 0..BOXES {
        let mut at = about(&known, &mut random);
        let mut contractor = Contractor::new(known.problem.clone());
        let left = contractor.contract(&mut at, true);
        let left = left.unwrap_or_else(|empty| panic!("box {number} by {:?}", empty.method));
        followed += usize::from(matches!(left, Contracted::Followed { .. }));
        for (place, (side, value)) in at.iter().zip(&known.truth).enumerate() {
            let near = *side + Interval::symmetric(OFF);
            assert!(near.contains(*value), "box {number}: {place} is {value}, outside of {side:?}");
        }
    }
    followed
}

#[test]
fn contraction_of_a_box_leaves_the_true_motion_in_it() {
    let drag = VehicleTerms { gain: 0.9, linear: 0.5, quadratic: 0.4, disturbance: 0.08, ..VehicleTerms::default() };
    let cases = [
        (drag, true),
        (VehicleTerms { delayed: 5, ..drag }, false),
        (VehicleTerms { lag_rate: 5.0, ..drag }, true),
        (VehicleTerms { lag_rate: 5.0, quadratic: 0.0, delayed: 5, ..drag }, false),
        (VehicleTerms { stiffness: 0.3, ..drag }, true),
        (VehicleTerms { stiffness: 0.3, lag_rate: 8.0, linear: 0.0, delayed: 9, ..drag }, true),
        (VehicleTerms { cubic: 0.2, quadratic: 0.0, ..drag }, true),
    ];
    for (index, (vehicle, delay_known)) in cases.iter().enumerate() {
        let followed = followed(vehicle, *delay_known, 11 + index as u64);
        assert!(2 * followed > BOXES, "case {index}: only {followed} of {BOXES} were followed");
    }
}
