//! Hats over a motion that is known, each with a false variant that is caught.

use super::weight::Hat;
use super::{Modulated, Tangent};
use crate::identify::bounded::record::Command;
use crate::identify::bounded::record::Readings;
use crate::identify::bounded::velocity_bounds::Velocities;
use crate::numeric::Interval;

/// Largest error of a reading.
const ERROR: f64 = 1e-6;
/// Between samples.
const STEP_S: f64 = 0.1;
/// By how much the speed is known too low, and too high.
const UNSURE: [f64; 2] = [0.6, 0.05];
/// Pieces of a step in which sums of midpoints stand for integrals.
const PIECES: usize = 400;
/// Room for what these sums miss.
const MISSED: f64 = 1e-8;

fn position(t: f64) -> f64 {
    (1.3 * t).sin()
}
fn speed(t: f64) -> f64 {
    1.3 * (1.3 * t).cos()
}

/// Readings of the motion, alternately too high and too low, and its speeds.
fn known() -> (Readings, Velocities) {
    let time_s: Vec<f64> = (0..60).map(|sample| f64::from(sample) * STEP_S).collect();
    let value =
        time_s.iter().enumerate().map(|(k, t)| position(*t) + if k % 2 == 0 { ERROR } else { -ERROR }).collect();
    let range = |t: f64| Interval::new(speed(t) - UNSURE[0], speed(t) + UNSURE[1]).expect("ordered");
    let at_samples: Vec<Interval> = time_s.iter().map(|t| range(*t)).collect();
    let between: Vec<Interval> = at_samples.windows(2).map(|pair| pair[0].hull(pair[1])).collect();
    let command = Command { levels: vec![1.0, -1.0], spans: vec![Interval::point(3.0)] };
    let rates = vec![Interval::symmetric(1.3 * 1.3); between.len()];
    (
        Readings { time_s, value, error: ERROR, jitter_s: 0.0, command },
        Velocities { at_samples, between, rates, known: 0 },
    )
}

/// `int K f` over a hat with its ends and its peak at these instants.
pub(super) fn integral([l, m, r]: [f64; 3], f: impl Fn(f64) -> f64) -> f64 {
    let half = |from: f64, to: f64, height: &dyn Fn(f64) -> f64| {
        let pieces = ((to - from) / STEP_S).round() as usize * PIECES;
        let step = (to - from) / pieces as f64;
        (0..pieces).map(|k| from + (k as f64 + 0.5) * step).map(|t| height(t) * f(t) * step).sum::<f64>()
    };
    half(l, m, &|t| (t - l) / (m - l)) + half(m, r, &|t| (r - t) / (r - m))
}

fn holds(range: Interval, value: f64) -> bool {
    range.intersection(Interval::symmetric(MISSED) + Interval::point(value)).is_some()
}

/// How many hats there are, and how many miss `int K f` of speed when it is weighed by this tangent.
fn missed(f: impl Fn(f64) -> f64, tangent: impl Fn(Interval) -> Tangent + Copy) -> (usize, usize) {
    let (readings, speeds) = known();
    let hats: Vec<[usize; 3]> = (0..40).map(|first| [first, first + 7, first + 19]).collect();
    let misses = hats.iter().filter(|support| {
        let instants = support.map(|sample| readings.time_s[sample]);
        let (hat, error) = (Hat::of(instants), Interval::point(ERROR));
        let modulated = Modulated { readings: &readings, velocities: &speeds, support, hat, error };
        !holds(modulated.drag(tangent), integral(instants, |t| f(speed(t))))
    });
    (hats.len(), misses.count())
}

#[test]
fn weighed_drag_is_enclosed_and_by_its_tangent_alone_it_is_not() {
    let middle = 0.4;
    assert_eq!(missed(|v| v, |_| Tangent::identity()).1, 0);
    let square = |range| Tangent::square(range, middle);
    assert_eq!(missed(|v| v * v.abs() - 2.0 * middle * v, square).1, 0);
    assert_eq!(missed(|v| v * v * v, Tangent::cube).1, 0);

    let alone = |tangent: Tangent| Tangent { rest: Interval::ZERO, ..tangent };
    let (hats, misses) = missed(|v| v * v.abs() - 2.0 * middle * v, |range| alone(square(range)));
    assert!(misses > hats / 2, "{misses} of {hats}");
    let (hats, misses) = missed(|v| v * v * v, |range| alone(Tangent::cube(range)));
    assert!(misses > hats / 2, "{misses} of {hats}");
}

#[test]
fn the_weighed_position_is_enclosed_and_by_chords_alone_it_is_not() {
    // A motion that comes back to the same place at every sample.
    let turns = 2.0 * core::f64::consts::PI / STEP_S;
    let (readings, speeds) = known();
    let readings = Readings { value: vec![0.0; readings.time_s.len()], ..readings };
    let within = |fastest: f64| Velocities {
        between: vec![Interval::symmetric(fastest); speeds.between.len()],
        ..speeds.clone()
    };
    let (moving, still) = (within(turns), within(0.0));
    for first in 0..40 {
        let support = [first, first + 7, first + 19];
        let instants = support.map(|sample| readings.time_s[sample]);
        let place = |velocities| {
            let (hat, error) = (Hat::of(instants), Interval::point(ERROR));
            Modulated { readings: &readings, velocities, support: &support, hat, error }.position()
        };
        let exact = integral(instants, |t| 1.0 - (turns * t).cos());
        assert!(holds(place(&moving), exact));
        assert!(!holds(place(&still), exact));
    }
}
