//! Velocities of a motion that is known, each way of enclosing them with a false variant that is caught.

use super::super::simulated::{HALF_PERIOD, Known, LINEAR, QUANTUM, VehicleTerms, record};
use super::*;
use crate::experiment::Record;
use crate::identify::bounded::BoundedModel;

const SAMPLES: usize = 150;

fn speeds(known: &Known) -> Vec<f64> {
    known.motion.iter().map(|([_, v, _], _)| *v).collect()
}

#[test]
fn between_switchings_velocities_go_one_way_and_across_them_they_do_not() {
    let known = Known::of(&LINEAR, SAMPLES, true);
    let (readings, truth) = (&known.problem.records[0], speeds(&known));
    let mut missed = 0;
    for first in (HALF_PERIOD..SAMPLES - 2 * HALF_PERIOD).step_by(HALF_PERIOD) {
        let mut speeds = vec![Interval::ENTIRE; SAMPLES];
        readings.monotone(Constant { first, last: first + HALF_PERIOD }, &mut speeds).expect("one way");
        assert!((first..=first + HALF_PERIOD).all(|k| speeds[k].contains(truth[k])), "{first}");
        // In the middle the readings tell it, to the roundings of two over the time between.
        let middle = first + HALF_PERIOD / 2;
        assert!(speeds[middle].width() < 0.5, "{first}: {}", speeds[middle]);

        let across = Constant { first: middle, last: middle + HALF_PERIOD };
        let mut speeds = vec![Interval::ENTIRE; SAMPLES];
        let met = readings.monotone(across, &mut speeds);
        missed += usize::from(met.is_none() || (across.first..=across.last).any(|k| !speeds[k].contains(truth[k])));
    }
    assert!(missed > 3, "{missed} times across");
}

#[test]
fn readings_that_go_to_and_fro_clash_and_those_of_a_motion_do_not() {
    let mut problem = Known::of(&LINEAR, SAMPLES, true).problem;
    let at = problem.search.clone();
    assert!(problem.contradiction(&at).is_empty());
    problem.records[0].value[45] += 3.0 * QUANTUM;
    let clashing = problem.contradiction(&at);
    assert!(clashing.iter().any(|part| part.sample == 45), "{clashing:?}");
    // The reading is too high: the model stays below it.
    assert!(clashing.iter().filter(|part| part.sample == 45).all(|part| !part.model_above), "{clashing:?}");
    assert!((clashing.iter().map(|part| part.share).sum::<f64>() - 1.0).abs() < 1e-12);
}

/// Velocities that are outside: at samples, and at either end of the times between.
fn missed(truth: &[f64], speeds: &Velocities) -> usize {
    let here = truth.iter().zip(&speeds.at_samples).filter(|(v, speed)| !speed.contains(**v));
    let between =
        truth.windows(2).zip(&speeds.between).filter(|(pair, speed)| !pair.iter().all(|v| speed.contains(*v)));
    here.count() + between.count()
}

#[test]
fn velocities_are_enclosed_and_accelerations_turned_round_or_a_prompt_force_miss_them() {
    let lagged = VehicleTerms { lag_rate: 3.0, delayed: 40, ..LINEAR };
    let other = VehicleTerms { quadratic: 0.3, cubic: 0.1, stiffness: 0.2, ..LINEAR };
    for vehicle in [LINEAR, lagged, other] {
        let known = Known::of(&vehicle, SAMPLES, true);
        for width in [0.02, 0.2, 0.6] {
            let found = known.problem.velocities(0, &known.about(0.0, width)).expect("velocities");
            assert_eq!(missed(&speeds(&known), &found), 0, "{width}");
        }
    }
    let known = Known::of(&LINEAR, SAMPLES, true);
    let mut turned = known.problem.velocities(0, &known.about(0.0, 0.02)).expect("velocities");
    turned.rates.iter_mut().for_each(|rate| *rate = -*rate);
    let met = known.problem.accelerated(0, &mut turned);
    assert!(met.is_none() || missed(&speeds(&known), &turned) > 0);
    let (known, prompt) = (Known::of(&lagged, SAMPLES, true), VehicleTerms { lag_rate: 0.0, ..lagged });
    let problem = Problem::new(&[&record(&known.motion)], &prompt.model(true)).expect("a problem");
    let found = problem.velocities(0, &Known::of(&prompt, SAMPLES, true).about(0.0, 0.01));
    assert!(found.is_none_or(|found| missed(&speeds(&known), &found) > 10));
}

#[test]
fn late_stamps_are_granted_and_on_time_they_would_miss_the_velocity() {
    let fine = LINEAR.motion(SAMPLES * 5);
    // Every fifth place, the reading of one earlier, of itself, or of one later.
    let taken = |k: usize| if k == 0 { 0 } else { (5 * k + 1).saturating_sub(k % 3) };
    let time_s = (0..SAMPLES).map(|k| 0.5 * k as f64).collect();
    let output = (0..SAMPLES).map(|k| (fine[taken(k)].0[0] / QUANTUM).round() * QUANTUM).collect();
    let record = Record::new(time_s, output, (0..SAMPLES).map(|k| fine[5 * k].1).collect()).expect("a record");
    let at = Known::of(&LINEAR, SAMPLES, true).about(0.0, 0.1);
    let missed = |jitter_s: f64| {
        let problem = Problem::new(&[&record], &BoundedModel { jitter_s, ..LINEAR.model(true) }).expect("a problem");
        let found = problem.velocities(0, &at)?;
        let inside =
            |speed: &Interval, from: usize, to: usize| fine[from..=to].iter().all(|own| speed.contains(own.0[1]));
        let samples = found.at_samples.iter().enumerate().filter(|(k, speed)| !inside(speed, 5 * k, 5 * k)).count();
        let between = found.between.iter().enumerate().filter(|(k, speed)| !inside(speed, 5 * k, 5 * k + 5));
        Some(samples + between.count())
    };
    assert_eq!(missed(0.101), Some(0));
    assert!(missed(0.0).is_none_or(|missed| missed > 10), "{:?}", missed(0.0));
}

/// Drag is odd: of speeds astern it takes as much as ahead. Motions by Euler's method in small steps.
#[test]
fn velocities_between_samples_hold_motions_ahead_and_astern() {
    let drag = [0.2, 1.0, 0.3];
    let lasted_s = 0.4;
    for from in [-1.5, -0.6, 0.0, 0.6, 1.5] {
        for force in [-1.0, 0.0, 1.0] {
            let range = passed(
                drag.map(Interval::point),
                Interval::point(from),
                Interval::point(force),
                Interval::ZERO.hull(Interval::point(lasted_s)),
            );
            let steps = 4000;
            let mut v: f64 = from;
            for _ in 0..steps {
                v += lasted_s / f64::from(steps) * (force - drag[0] * v - drag[1] * v * v.abs() - drag[2] * v * v * v);
                assert!(range.contains(v), "{v} from {from} under {force} is not in {range}");
            }
            assert!(range.width() < 4.0, "{from}, {force}: {range}");
        }
    }
}
