//! Foundations of the bounds, each with a false variant that is caught.

use super::BoundedModel;
use super::contraction::Contractor;
use super::linear_relaxation::{Disjoint, Span, midpoints, points};
use super::problem::Problem;
use super::simulated::{Known, LINEAR, VehicleTerms};
use super::unknowns::Shooting;
use crate::experiment::Record;
use crate::numeric::{Interval, Real};

#[test]
fn velocities_by_the_intervals_beside_them_hold_the_truth_and_the_fastest_is_refused() {
    let known = Known::of(&LINEAR, 150, true);
    let (problem, mut at) = (&known.problem, known.about(0.0, 0.02));
    let mut contractor = Contractor::new(problem.clone());
    contractor.modulate(&mut at).expect("not empty: the truth is inside");
    let centre = midpoints(&at);
    let Ok(Some(mut relaxation)) = problem.shoot(&mut at, centre) else { panic!("no enclosure") };
    let (unknowns, before) = (&problem.unknowns, at.clone());
    contractor.refine_states(&mut relaxation, &mut at).expect("not empty: the truth is inside");
    for interval in 1..unknowns.shooting.len() {
        let velocity = unknowns.start(interval, 1);
        assert!(at[velocity].contains(known.truth[velocity]), "interval {interval}");
        assert!(at[velocity].width() < 0.5 * before[velocity].width(), "interval {interval}: {:?}", at[velocity]);
        assert_eq!(relaxation.deviations[velocity], at[velocity] - Interval::point(relaxation.centre[velocity]));
    }
    // A velocity that was possible by the readings of one interval alone.
    let velocity = unknowns.start(2, 1);
    let mut other = before;
    other[velocity] = Interval::point(other[velocity].upper());
    let centre = midpoints(&other);
    let possible = match problem.shoot(&mut other, centre) {
        Ok(Some(mut relaxation)) => contractor.refine_states(&mut relaxation, &mut other).is_ok(),
        Ok(None) => panic!("no enclosure"),
        Err(Disjoint) => false,
    };
    assert!(!possible, "an interval that begins with the fastest velocity");
}

#[test]
fn a_shooting_interval_may_end_within_a_change_of_sign() {
    for vehicle in [LINEAR, VehicleTerms { linear: 0.0, quadratic: 0.5, ..LINEAR }] {
        let known = Known::of(&vehicle, 100, true);
        // The slowest turns round long before the fastest.
        let mut at = known.about(0.0, 0.01)[..known.problem.unknowns.parameters()].to_vec();
        at.extend([Interval::symmetric(0.01), Interval::point(-0.4).inflate(0.3)]);
        let centre = midpoints(&at);
        for last in 1..100 {
            let unknowns = known.problem.unknowns.with_shooting(vec![Shooting { record: 0, first: 0, last }]);
            let problem = Problem { unknowns, ..known.problem.clone() };
            let motion = problem.motion(Span::single(0), &at, &centre);
            assert!(motion.is_some(), "no enclosure up to sample {last}");
        }
    }
}

#[test]
fn velocities_are_known_from_the_first_shooting_interval_on_and_are_less_than_those_searched() {
    let vehicle = VehicleTerms { delayed: 80, ..LINEAR };
    let known = Known::of(&vehicle, 200, true);
    let velocities = known.problem.velocities(0, &known.about(0.0, 0.1)).expect("velocities");
    assert_eq!(velocities.known, known.problem.unknowns.shooting[0].first);
    assert!(velocities.fastest() < 0.7 * known.problem.fastest, "{}", velocities.fastest());
}

/// `v' = u - v / 2` from a velocity of 1, u being -1 until it is switched and 1 after that; before the first instant, too.
fn braked(t: f64, switched_s: f64) -> [f64; 2] {
    let from = |[x, v]: [f64; 2], u: f64, t: f64| {
        let left = (-0.5 * t).exp();
        [x + 2.0 * u * t + 2.0 * (v - 2.0 * u) * (1.0 - left), 2.0 * u + (v - 2.0 * u) * left]
    };
    let before = from([0.0, 1.0], -1.0, t.min(switched_s));
    if t < switched_s { before } else { from(before, 1.0, t - switched_s) }
}

#[test]
fn a_reading_may_be_from_beyond_what_is_followed_of_the_motion_and_from_beyond_the_next_sample() {
    for (interval_s, jitter_s) in [(0.1, 0.05), (0.5, 2.5)] {
        for late in [-1.0, 1.0] {
            let stamp = |sample: usize| interval_s * sample as f64;
            let time_s: Vec<f64> = (0..30).map(stamp).collect();
            let output = time_s.iter().map(|at| braked(at + late * jitter_s, stamp(15))[0]).collect();
            let input = (0..30).map(|sample| if sample < 15 { -1.0 } else { 1.0 }).collect();
            let record = Record::new(time_s, output, input).expect("a record");
            let model = BoundedModel { quantum: Some(0.0), error: 1e-6, jitter_s, ..LINEAR.model(true) };
            let problem = Problem::new(&[&record], &model).expect("a problem");
            // With the instant at which the command was switched.
            let mut truth = vec![1.0, 0.5, 0.0, stamp(15)];
            let shooting = &problem.unknowns.shooting;
            truth.extend(shooting.iter().flat_map(|interval| braked(stamp(interval.first), stamp(15))));
            let at = points(&truth);
            let spans = (0..shooting.len()).map(Span::single).chain([Span { from: 0, to: shooting.len() }]);
            for span in spans {
                let motion = problem.motion(span, &at, &truth).expect("a motion");
                let mut relaxation = problem.about(&at, truth.clone());
                problem.add_motion(span, &motion, false, &mut relaxation);
                let least = relaxation.inequalities.limits.iter().copied().fold(f64::INFINITY, f64::min);
                assert!(least >= 0.0, "{jitter_s} s, {late}, {span:?}: the truth is {least} outside");
            }
        }
    }
}
