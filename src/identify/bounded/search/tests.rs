use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::*;
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::identify::bounded::{BoundedModel, DelayBound};

const QUANTUM: f64 = 0.01;
const SAMPLE_S: f64 = 0.1;
/// Steps of a sample's interval.
const STEPS: usize = 20;
/// What the integration below may be off.
const OFF: f64 = 1e-7;
const BOXES: usize = 30;

/// Terms over inertia, and what is constant.
#[derive(Clone, Copy, Default)]
struct Vehicle {
    gain: f64,
    linear: f64,
    quadratic: f64,
    cubic: f64,
    stiffness: f64,
    lag_rate: f64,
    disturbance: f64,
    /// Delay in steps.
    delayed: usize,
}

impl Vehicle {
    /// Position, velocity and force at every sample under a square wave, by the classical method of Runge and Kutta; and the command.
    fn motion(&self, samples: usize) -> Vec<([f64; 3], f64)> {
        let command = |sample: usize| if (sample / 16).is_multiple_of(2) { 1.0 } else { -1.0 };
        let h = SAMPLE_S / STEPS as f64;
        let lagged = self.lag_rate > 0.0;
        let (mut state, mut all) = ([0.0, -0.4, -0.7], Vec::new());
        for sample in 0..samples {
            all.push((state, command(sample)));
            for step in 0..STEPS {
                let u = command((sample * STEPS + step).saturating_sub(self.delayed) / STEPS);
                let rate = |[x, v, f]: [f64; 3]| {
                    let force = self.gain * if lagged { f } else { u } + self.disturbance;
                    let drag = self.linear * v + self.quadratic * v * v.abs() + self.cubic * v * v * v;
                    [v, force - drag - self.stiffness * x, self.lag_rate * (u - f)]
                };
                let more = |a: [f64; 3], by: f64, b: [f64; 3]| core::array::from_fn(|k| a[k] + by * b[k]);
                let first = rate(state);
                let second = rate(more(state, 0.5 * h, first));
                let third = rate(more(state, 0.5 * h, second));
                let fourth = rate(more(state, h, third));
                state = core::array::from_fn(|k| {
                    state[k] + h / 6.0 * (first[k] + 2.0 * second[k] + 2.0 * third[k] + fourth[k])
                });
            }
        }
        all
    }

    fn model(&self, delay_known: bool) -> BoundedModel {
        let law = match (self.linear != 0.0, self.quadratic != 0.0) {
            (true, true) => DragLaw::Mixed,
            (false, true) => DragLaw::Quadratic,
            _ => DragLaw::Linear,
        };
        let delay = if delay_known { DelayBound::KnownS(self.delay_s()) } else { DelayBound::Unknown };
        BoundedModel {
            cubic: self.cubic != 0.0,
            stiffness: self.stiffness != 0.0,
            lag: self.lag_rate > 0.0,
            quantum: Some(QUANTUM),
            ..BoundedModel::new(law, delay)
        }
    }

    fn delay_s(&self) -> f64 {
        self.delayed as f64 * SAMPLE_S / STEPS as f64
    }

    /// All unknowns of the search.
    fn truth(&self, setup: &Setup, motion: &[([f64; 3], f64)]) -> Vec<f64> {
        let layout = &setup.layout;
        let mut truth = vec![0.0; setup.search.len()];
        for (place, term) in layout.terms().iter().enumerate() {
            truth[place] = match term {
                Term::Gain => self.gain,
                Term::Linear => self.linear + 2.0 * setup.middle_speed * self.quadratic,
                Term::Quadratic => self.quadratic,
                Term::Cubic => self.cubic,
                Term::Stiffness => self.stiffness,
                Term::LagRate => self.lag_rate,
                Term::Disturbance => self.disturbance,
            };
        }
        if let Some(place) = layout.delay() {
            truth[place] = self.delay_s();
        }
        truth[layout.disturbance(0)] = self.disturbance;
        let offset = setup.records[0].time_s[0];
        for (index, window) in layout.windows().iter().enumerate() {
            let at_s = setup.records[0].time_s[window.first];
            let sample = (at_s / SAMPLE_S).round() as usize;
            assert!((at_s - SAMPLE_S * sample as f64).abs() < 1e-9, "{at_s} s from {offset} s is no sample");
            for component in 0..layout.state_size() {
                truth[layout.start(index, component)] = motion[sample].0[component];
            }
        }
        truth
    }
}

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
    let record = Record::new(
        (0..motion.len()).map(|sample| SAMPLE_S * sample as f64).collect(),
        motion.iter().map(|([x, ..], _)| (x / QUANTUM).round() * QUANTUM).collect(),
        motion.iter().map(|(_, u)| *u).collect(),
    )
    .expect("a record");
    let setup = Setup::new(&[&record], &vehicle.model(delay_known)).expect("a problem");
    let truth = vehicle.truth(&setup, &motion);
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut followed = 0;
    for number in 0..BOXES {
        let mut at = about(&truth, &setup, &mut random);
        let mut search = Search::new(&setup);
        let left = search.contract(&mut at).unwrap_or_else(|empty| panic!("box {number} by {:?}", empty.method));
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
