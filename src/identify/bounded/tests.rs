//! What the bounds rest on, each with a false variant that is caught.

use super::contraction::Contractor;
use super::linear_relaxation::{Disjoint, Relaxation, Span, midpoints, points};
use super::problem::Problem;
use super::simulated::VehicleTerms;
use super::unknowns::Shooting;
use super::{BoundedModel, DelayBound};
use crate::experiment::{Record, Sensor, SimulatedExperiment};
use crate::identify::DragLaw;
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Interval, Real};
use crate::plant::DragAxis;

pub(super) const ALPHA: f64 = 1.3;
pub(super) const BETA: f64 = 0.6;
pub(super) const DELTA: f64 = 0.1;
pub(super) const STEP: f64 = 0.02;
pub(super) const TURN_S: f64 = 2.0;

/// Linear drag under a square wave, by the solution in closed form: time, position, velocity and command at every sample.
pub(super) fn motion(samples: usize) -> Vec<[f64; 4]> {
    let (mut x, mut v) = (0.0f64, 0.2f64);
    let h = 0.1;
    let advance = |sample: usize| {
        let now = sample as f64 * h;
        // Just after a switching instant, however the product rounds.
        let u = if ((now + 1e-9) / TURN_S).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let here = [now, x, v, u];
        let (rate, terminal) = (BETA / ALPHA, (u + DELTA) / BETA);
        let decay = (-rate * h).exp();
        x += terminal * h + (v - terminal) * (1.0 - decay) / rate;
        v = terminal + (v - terminal) * decay;
        here
    };
    (0..samples).map(advance).collect()
}

/// The same, rounded to steps of `STEP`.
pub(super) fn record(samples: usize) -> Record {
    let motion = motion(samples);
    let of = |value: &dyn Fn(&[f64; 4]) -> f64| motion.iter().map(value).collect();
    Record::new(of(&|[now, ..]| *now), of(&|[_, x, ..]| (x / STEP).round() * STEP), of(&|[.., u]| *u))
        .expect("a record")
}

/// A box about the truth, of this relative half-width, with everything that a search over it needs.
pub(super) fn problem(width: f64) -> (Problem, Vec<Interval>) {
    let model = BoundedModel { quantum: Some(STEP), ..BoundedModel::new(DragLaw::Linear, DelayBound::KnownS(0.0)) };
    let problem = Problem::new(&[&record(150)], &model).expect("a problem");
    let truth = [1.0 / ALPHA, BETA / ALPHA, DELTA / ALPHA];
    let mut at = problem.search.clone();
    for (side, value) in at.iter_mut().zip(truth) {
        *side = Interval::new(value * (1.0 - width), value * (1.0 + width)).expect("ordered");
    }
    Contractor::new(problem.clone()).modulate(&mut at).expect("not empty: the truth is inside");
    (problem, at)
}

/// Whether the truth meets every row: whether some element of every slope does.
pub(super) fn satisfies(linear: &Relaxation, truth: &[f64]) -> bool {
    linear.inequalities.coefficients.iter().zip(&linear.inequalities.limits).all(|(slopes, limit)| {
        let sum = slopes.iter().fold(Interval::ZERO, |sum, (place, slope)| {
            sum + *slope * (Interval::point(truth[*place]) - Interval::point(linear.centre[*place]))
        });
        sum.lower() <= *limit
    })
}

/// All unknowns of the true motion, which at each window's beginning is the one before carried on.
pub(super) fn truth(problem: &Problem) -> Vec<f64> {
    let mut all = vec![1.0 / ALPHA, BETA / ALPHA, DELTA / ALPHA];
    let rate = BETA / ALPHA;
    for window in &problem.unknowns.shooting {
        let (mut x, mut v) = (0.0f64, 0.2f64);
        for sample in 0..window.first {
            let u = if ((sample as f64 * 0.1 + 1e-9) / TURN_S).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 };
            let (terminal, decay) = ((u + DELTA) / BETA, (-rate * 0.1f64).exp());
            x += terminal * 0.1 + (v - terminal) * (1.0 - decay) / rate;
            v = terminal + (v - terminal) * decay;
        }
        all.extend([x, v]);
    }
    all
}

#[test]
fn velocities_by_the_windows_beside_them_hold_the_truth_and_the_fastest_is_refused() {
    let (problem, mut at) = problem(0.02);
    let contractor = Contractor::new(problem.clone());
    let centre = midpoints(&at);
    let Ok(Some(mut linear)) = problem.shoot(&mut at, centre) else { panic!("no enclosure") };
    let truth = truth(&problem);
    let layout = &problem.unknowns;
    for window in 0..layout.shooting.len() {
        let beside = linear.beside(window);
        assert!(satisfies(&beside, &truth));
        let first = layout.start(window.saturating_sub(1), 0);
        let last = layout.start(window + 1, layout.state_size() - 1);
        let own = |place: &usize| *place < layout.parameters() || (first..=last).contains(place);
        let places = beside.inequalities.coefficients.iter().flatten().map(|(place, _)| place);
        assert!({ places }.all(own), "window {window}");
    }
    let before = at.clone();
    contractor.refine_states(&mut linear, &mut at).expect("not empty: the truth is inside");
    for window in 1..layout.shooting.len() {
        let velocity = layout.start(window, 1);
        assert!(Interval::point(truth[velocity]).is_subset_of(at[velocity]), "window {window}");
        assert!(at[velocity].width() < 0.5 * before[velocity].width(), "window {window}: {:?}", at[velocity]);
        assert_eq!(linear.deviations[velocity], at[velocity] - Interval::point(linear.centre[velocity]));
    }
    // A velocity that was possible by the readings of one window alone.
    let velocity = layout.start(2, 1);
    let mut other = before;
    other[velocity] = Interval::point(other[velocity].upper());
    let centre = midpoints(&other);
    let possible = match problem.shoot(&mut other, centre) {
        Ok(Some(mut linear)) => contractor.refine_states(&mut linear, &mut other).is_ok(),
        Ok(None) => panic!("no enclosure"),
        Err(Disjoint) => false,
    };
    assert!(!possible, "a window that begins with the fastest velocity");
}

/// A self-oscillation from rest, rounded to steps of `STEP`.
pub(super) fn oscillation(axis: DragAxis<f64>, samples_per_s: f64, lasted_s: f64) -> Record {
    let relay = RelayHysteresis::new(1.0, 0.4, 0.0).expect("a relay");
    let sensor = Sensor { quantum: STEP, ..Sensor::default() };
    let experiment = SimulatedExperiment::new(axis, relay, samples_per_s).expect("an experiment");
    experiment.held().with_sensor(sensor).expect("a sensor").run(lasted_s).expect("a record")
}

#[test]
fn a_window_may_end_within_a_change_of_sign() {
    let laws = [DragLaw::Linear, DragLaw::Quadratic].into_iter().zip([DragAxis::linear, DragAxis::quadratic]);
    for (law, axis) in laws {
        let record = oscillation(axis(1.2, 0.8).expect("an axis"), 50.0, 10.0);
        let whole = Problem::new(&[&record], &settings(law)).expect("a problem");
        // The vehicle turns round after every switching; over the box while the point still goes backwards.
        let about = |value: f64, room: f64| Interval::point(value).inflate(room);
        let mut at = vec![about(1.0 / 1.2, 0.01), about(0.8 / 1.2, 0.01), about(0.0, 0.001)];
        at.extend([about(0.0, 0.01), about(0.0, 0.3)]);
        let centre = midpoints(&at);
        for last in 10..300 {
            let unknowns = whole.unknowns.with_shooting(vec![Shooting { record: 0, first: 0, last }]);
            let problem = Problem { unknowns, ..whole.clone() };
            let motion = problem.motion(Span::single(0), &at, &centre);
            assert!(motion.is_some(), "{law:?}: no enclosure up to sample {last}");
        }
    }
}

pub(super) fn settings(law: DragLaw) -> BoundedModel {
    BoundedModel { quantum: Some(STEP), ..BoundedModel::new(law, DelayBound::KnownS(0.0)) }
}

/// A box about parameters off the truth by a share, of this relative half-width.
pub(super) fn off(problem: &Problem, share: f64, width: f64) -> Vec<Interval> {
    let mut at = problem.search.clone();
    for (side, truth) in at.iter_mut().zip([1.0 / ALPHA, BETA / ALPHA, DELTA / ALPHA]) {
        *side = Interval::point((1.0 + share) * truth).inflate(width * truth);
    }
    at
}

#[test]
fn velocities_are_known_from_the_first_shooting_interval_on_and_are_less_than_those_searched() {
    let vehicle = VehicleTerms { gain: 1.0, linear: 0.5, delayed: 80, ..VehicleTerms::default() };
    let motion = vehicle.motion(200);
    let model = BoundedModel { either_sign: true, ..vehicle.model(true, STEP) };
    let problem = Problem::new(&[&VehicleTerms::record(&motion, STEP)], &model).expect("a problem");
    let mut at = problem.search.clone();
    (at[0], at[1]) = (Interval::point(1.0).inflate(0.1), Interval::point(0.5).inflate(0.1));
    at[2] = Interval::symmetric(0.1);
    let velocities = problem.velocities(0, &at).expect("velocities");
    assert_eq!(velocities.known, problem.unknowns.shooting[0].first);
    assert!(velocities.fastest() < 0.7 * problem.fastest, "{} of {}", velocities.fastest(), problem.fastest);
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
            let model = BoundedModel { quantum: Some(0.0), error: 1e-6, jitter_s, ..settings(DragLaw::Linear) };
            let problem = Problem::new(&[&record], &model).expect("a problem");
            let layout = &problem.unknowns;
            // With the instant at which the command was switched.
            let mut truth = vec![1.0, 0.5, 0.0, stamp(15)];
            for window in &layout.shooting {
                truth.extend(braked(stamp(window.first), stamp(15)));
            }
            let at = points(&truth);
            let windows = layout.shooting.len();
            let spans = (0..windows).map(Span::single).chain([Span { from: 0, to: windows }]);
            for span in spans {
                let motion = problem.motion(span, &at, &truth).expect("a motion");
                let mut linear = problem.about(&at, truth.clone());
                problem.add_motion(span, &motion, false, &mut linear);
                let least = linear.inequalities.limits.iter().copied().fold(f64::INFINITY, f64::min);
                assert!(least >= 0.0, "{jitter_s} s, {late}, {span:?}: the truth is {least} outside");
            }
        }
    }
}
