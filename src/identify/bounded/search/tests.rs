use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::simulated::Vehicle;
use super::*;

const QUANTUM: f64 = 0.01;
/// What the truth's integration may be off.
const OFF: f64 = 1e-7;
const BOXES: usize = 30;

/// Boxes that hold the truth somewhere, from wide ones to narrow ones; with the states at the windows' beginnings wherever they are looked
/// for.
fn about(truth: &[f64], setup: &Setup, random: &mut Pcg64Mcg) -> Vec<Interval> {
    let width = 10f64.powf(random.random_range(-4.0..0.0));
    let mut at = setup.search.clone();
    for (side, value) in at.iter_mut().zip(truth).take(setup.layout.parameters()) {
        let size = width * value.abs().max(0.1);
        let below = size * random.random_range(0.01..1.0);
        let own = Interval::new(value - below, value + size - below).expect("an interval");
        *side = side.intersection(own).expect("the truth is where it is looked for");
    }
    at
}

/// How many boxes about the truth of a vehicle are followed, of those that contraction leaves it in: all.
fn followed(vehicle: &Vehicle, delay_known: bool, seed: u64) -> usize {
    let motion = vehicle.motion(110);
    let model = vehicle.model(delay_known, QUANTUM);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &model).expect("a problem");
    let truth = vehicle.truth(&setup, &motion);
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut followed = 0;
    for number in 0..BOXES {
        let mut at = about(&truth, &setup, &mut random);
        let mut search = Search::new(&setup);
        let left = search.contract(&mut at, true).unwrap_or_else(|empty| panic!("box {number} by {:?}", empty.method));
        let mut slanted = None;
        if let Left::Followed { .. } = left {
            followed += 1;
            let left = search.contract_fine(&mut at, &mut slanted);
            left.unwrap_or_else(|empty| panic!("box {number} by {:?} at last", empty.method));
        }
        for (place, (side, value)) in at.iter().zip(&truth).enumerate() {
            let near = *side + Interval::symmetric(OFF);
            assert!(near.contains(*value), "box {number}: {place} is {value}, outside of {side:?}");
        }
    }
    followed
}

#[test]
fn contraction_of_a_box_leaves_the_true_motion_in_it() {
    let drag = Vehicle { gain: 0.9, linear: 0.5, quadratic: 0.4, disturbance: 0.08, ..Vehicle::default() };
    let cases = [
        (drag, true),
        (Vehicle { delayed: 5, ..drag }, false),
        (Vehicle { lag_rate: 5.0, ..drag }, true),
        (Vehicle { lag_rate: 5.0, quadratic: 0.0, delayed: 5, ..drag }, false),
        (Vehicle { stiffness: 0.3, ..drag }, true),
        (Vehicle { stiffness: 0.3, lag_rate: 8.0, linear: 0.0, delayed: 9, ..drag }, true),
        (Vehicle { cubic: 0.2, quadratic: 0.0, ..drag }, true),
    ];
    for (index, (vehicle, delay_known)) in cases.iter().enumerate() {
        let followed = followed(vehicle, *delay_known, 11 + index as u64);
        assert!(2 * followed > BOXES, "case {index}: only {followed} of {BOXES} were followed");
    }
}

#[test]
fn readings_speeds_are_taken_only_where_that_is_asked_for() {
    let vehicle = Vehicle { gain: 0.9, linear: 0.5, ..Vehicle::default() };
    let motion = vehicle.motion(110);
    let setup = Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &vehicle.model(true, QUANTUM)).expect("a problem");
    let truth = vehicle.truth(&setup, &motion);
    let at = about(&truth, &setup, &mut Pcg64Mcg::seed_from_u64(31));
    let weighed = |weighing: bool| {
        let mut search = Search::new(&setup);
        search.contract(&mut at.clone(), weighing).unwrap_or_else(|empty| panic!("excluded by {:?}", empty.method));
        search.weighed
    };
    assert!(weighed(true) > 0);
    assert_eq!(weighed(false), 0);
}

#[test]
fn parts_of_a_box_are_weighed_where_the_motion_was_not_followed_over_it() {
    let vehicle = Vehicle { gain: 0.9, linear: 0.5, quadratic: 0.4, disturbance: 0.08, ..Vehicle::default() };
    let motion = vehicle.motion(110);
    let problem = |delay_known: bool| {
        Setup::new(&[&Vehicle::record(&motion, QUANTUM)], &vehicle.model(delay_known, QUANTUM)).expect("a problem")
    };
    let weighed = |setup: &Setup, at: &[Interval]| {
        let (mut first, mut all) = (Search::new(setup), Search::new(setup));
        let left = first.contract(&mut at.to_vec(), true).expect("the truth is inside");
        all.search(at.to_vec(), 2000);
        (left, first.weighed, all.weighed, all.passes - first.passes)
    };
    let setup = problem(false);
    let (left, first, all, _) = weighed(&setup, &setup.search);
    assert!(matches!(left, Left::Wide(_)) && all > first, "{left:?}: {first} and {all}");
    let setup = problem(true);
    let truth = vehicle.truth(&setup, &motion);
    let mut narrow = setup.search.clone();
    for (side, value) in narrow.iter_mut().zip(&truth).take(setup.layout.parameters()) {
        let own = Interval::point(*value) + Interval::symmetric(0.2 * value.abs().max(0.1));
        *side = side.intersection(own).expect("it is looked for there");
    }
    let (left, first, all, divided) = weighed(&setup, &narrow);
    assert!(matches!(left, Left::Followed { slack, .. } if slack > 1.0) && divided > 2, "{left:?}, {divided}");
    assert_eq!(first, all);
}
