//! Velocities of a motion that is known, each way of enclosing them with a false variant that is caught.

use super::Constant;
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::identify::bounded::problem::Problem;
use crate::identify::bounded::tests::{ALPHA, BETA, DELTA, STEP, TURN_S, motion, record};
use crate::identify::bounded::{BoundedModel, DelayBound};
use crate::numeric::Interval;

const SAMPLES: usize = 150;

fn problem(jitter_s: f64) -> Problem {
    let model = BoundedModel::new(DragLaw::Linear, DelayBound::KnownS(0.0));
    let model = BoundedModel { quantum: Some(STEP), jitter_s, ..model };
    Problem::new(&[&record(SAMPLES)], &model).expect("a problem")
}

fn velocities() -> Vec<f64> {
    motion(SAMPLES).iter().map(|[_, _, v, _]| *v).collect()
}

/// A box about the truth.
fn near(problem: &Problem, width: f64) -> Vec<Interval> {
    let mut at = problem.search.clone();
    for (side, value) in at.iter_mut().zip([1.0 / ALPHA, BETA / ALPHA, DELTA / ALPHA]) {
        *side = Interval::new(value * (1.0 - width), value * (1.0 + width)).expect("ordered");
    }
    at
}

#[test]
fn between_switchings_velocities_go_one_way_and_across_them_they_do_not() {
    let problem = problem(0.0);
    let turn = (TURN_S / 0.1).round() as usize;
    let truth = velocities();
    let mut missed = 0;
    for first in (turn..SAMPLES - 2 * turn).step_by(turn) {
        let mut speeds = vec![Interval::ENTIRE; SAMPLES];
        problem.records[0].monotone(Constant { first, last: first + turn }, &mut speeds).expect("one way");
        let own = first..=first + turn;
        assert!(own.clone().all(|k| speeds[k].contains(truth[k])), "{first}");
        // In the middle the readings tell it, to the roundings of two over the time between.
        assert!(speeds[first + turn / 2].width() < 0.5, "{first}: {}", speeds[first + turn / 2]);

        let across = Constant { first: first + turn / 2, last: first + turn + turn / 2 };
        let mut speeds = vec![Interval::ENTIRE; SAMPLES];
        let met = problem.records[0].monotone(across, &mut speeds);
        missed += usize::from(met.is_none() || (across.first..=across.last).any(|k| !speeds[k].contains(truth[k])));
    }
    assert!(missed > 3, "{missed} times across");
}

#[test]
fn readings_that_go_to_and_fro_clash_and_those_of_a_motion_do_not() {
    let mut problem = problem(0.0);
    let at = problem.search.clone();
    assert!(problem.contradiction(&at).is_empty());
    problem.records[0].value[45] += 3.0 * STEP;
    let clashing = problem.contradiction(&at);
    assert!(clashing.iter().any(|part| part.sample == 45), "{clashing:?}");
    // The reading is too high: the model stays below it.
    assert!(clashing.iter().filter(|part| part.sample == 45).all(|part| !part.model_above), "{clashing:?}");
    assert!((clashing.iter().map(|part| part.share).sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn velocities_are_enclosed_and_accelerations_turned_round_miss_them() {
    let problem = problem(0.0);
    let truth = velocities();
    for width in [0.02, 0.2, 0.6] {
        let speeds = problem.velocities(0, &near(&problem, width)).expect("speeds");
        assert!(truth.iter().zip(&speeds.at_samples).all(|(v, speed)| speed.contains(*v)), "{width}");
        // The velocity is monotone between samples.
        let between = truth.windows(2).zip(&speeds.between);
        assert!({ between }.all(|(pair, speed)| pair.iter().all(|v| speed.contains(*v))), "{width}");
    }
    let mut speeds = problem.velocities(0, &near(&problem, 0.02)).expect("speeds");
    speeds.rates.iter_mut().for_each(|rate| *rate = -*rate);
    let turned = problem.accelerated(0, &mut speeds);
    assert!(turned.is_none() || truth.iter().zip(&speeds.at_samples).any(|(v, speed)| !speed.contains(*v)));
}

#[test]
fn late_stamps_are_granted_and_on_time_they_would_miss_the_velocity() {
    let fine = motion(SAMPLES * 5);
    // Every fifth place, the reading of one earlier, of itself, or of one later.
    let taken = |k: usize| if k == 0 { 0 } else { (5 * k + 1).saturating_sub(k % 3) };
    let places: Vec<usize> = (0..SAMPLES).collect();
    let time_s = places.iter().map(|k| fine[5 * k][0]).collect();
    let output = places.iter().map(|k| (fine[taken(*k)][1] / STEP).round() * STEP).collect();
    let record = Record::new(time_s, output, places.iter().map(|k| fine[5 * k][3]).collect()).expect("a record");
    let missed = |jitter_s: f64| {
        let model = BoundedModel::new(DragLaw::Linear, DelayBound::KnownS(0.0));
        let model = BoundedModel { quantum: Some(STEP), jitter_s, ..model };
        let problem = Problem::new(&[&record], &model).expect("a problem");
        let speeds = problem.velocities(0, &near(&problem, 0.1))?;
        let inside = |k: usize, speed: &Interval| speed.contains(fine[5 * k][2]);
        let between = |k: usize, speed: &Interval| (5 * k..=5 * k + 5).all(|place| speed.contains(fine[place][2]));
        let samples = speeds.at_samples.iter().enumerate().filter(|(k, speed)| !inside(*k, speed)).count();
        Some(samples + speeds.between.iter().enumerate().filter(|(k, speed)| !between(*k, speed)).count())
    };
    assert_eq!(missed(0.101), Some(0));
    assert!(missed(0.0).is_none_or(|missed| missed > 10), "{:?}", missed(0.0));
}
