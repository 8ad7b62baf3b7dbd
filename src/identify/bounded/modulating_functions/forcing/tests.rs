//! Forces under hats, each with a false variant that is caught.

use super::Forcing;
use crate::identify::bounded::modulating_functions::tests::integral;
use crate::identify::bounded::modulating_functions::weight::Hat;
use crate::identify::bounded::problem::Problem;
use crate::identify::bounded::simulated::{HALF_PERIOD, LINEAR, SAMPLE_S, record};
use crate::identify::bounded::{BoundedModel, DelayBound};
use crate::numeric::{Interval, Real};

/// Room for the error of a sum of midpoints: a piece at a jump.
const MISSED: f64 = 0.01 * SAMPLE_S;

/// The record's command after a delay.
fn command(t: f64, delay_s: f64) -> f64 {
    if ((t - delay_s) / (SAMPLE_S * HALF_PERIOD as f64)).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 }
}

fn holds(range: Interval, value: f64) -> bool {
    range.inflate(MISSED).contains(value)
}

fn problem(delays: [f64; 2], lag: bool) -> Problem {
    let model = BoundedModel { lag, delay: DelayBound::WithinS(delays), ..LINEAR.model(true) };
    Problem::new(&[&record(&LINEAR.motion(150))], &model).expect("a problem")
}

#[test]
fn the_force_of_every_delay_is_enclosed_and_by_the_middle_slope_it_is_not() {
    let delays = [0.2, 0.9];
    let (problem, range) = (problem(delays, false), Interval::new(delays[0], delays[1]).expect("ordered"));
    let (mut missed, mut tried) = (0, 0);
    for first in 20..100 {
        let instants = [first, first + 9, first + 15].map(|sample| f64::from(sample) * SAMPLE_S);
        let Forcing { force, by_delay } = problem.forcing(0, &Hat::of(instants), range);
        for share in [0.0, 0.3, 0.8, 1.0] {
            let delay_s = delays[0] + share * (delays[1] - delays[0]);
            let exact = integral(instants, |t| command(t, delay_s));
            let later = Interval::point(delay_s) - Interval::point(range.midpoint());
            tried += 1;
            assert!(holds(force + by_delay * later, exact), "{instants:?} {delay_s}");
            missed += usize::from(!holds(force + Interval::point(by_delay.midpoint()) * later, exact));
        }
    }
    assert!(missed > tried / 10, "{missed} of {tried}");
}

/// The force behind a lag at an instant, from nothing at the time zero: from switching to switching.
fn lagged(t: f64, lag_s: f64, delay_s: f64) -> f64 {
    let half_period_s = SAMPLE_S * HALF_PERIOD as f64;
    let switched = (0..).map(|edge| delay_s + half_period_s * f64::from(edge)).take_while(|at| *at < t);
    let (mut force, mut from) = (0.0, 0.0);
    for to in switched.chain([t]) {
        let u = command(0.5 * (from + to), delay_s);
        (force, from) = (u + (force - u) * ((from - to) / lag_s).exp(), to);
    }
    force
}

#[test]
fn the_force_behind_every_lag_is_enclosed_and_by_the_middles_it_is_not() {
    let (mut missed, mut tried) = (0, 0);
    for (delays, lags) in [([0.2, 0.3], [0.15, 0.2]), ([0.0, 0.9], [0.05, 1.5]), ([0.4, 0.4], [0.4, 0.42])] {
        let (problem, delay) = (problem(delays, true), Interval::new(delays[0], delays[1]).expect("ordered"));
        let rate = Interval::new(1.0 / lags[1], 1.0 / lags[0]).expect("ordered");
        let middles = [delay, rate].map(|range| Interval::point(range.midpoint()));
        for (first, half) in (10..100).step_by(7).flat_map(|first| [(first, 3), (first, 9)]) {
            let instants = [first, first + half, first + half + 6].map(|sample| f64::from(sample) * SAMPLE_S);
            let hat = Hat::of(instants);
            let force = problem.lagged_forcing(0, &hat, delay, rate).force;
            let narrow = problem.lagged_forcing(0, &hat, middles[0], middles[1]).force;
            for (share, other) in [(0.0, 0.0), (0.0, 1.0), (0.3, 0.5), (1.0, 0.0), (1.0, 1.0)] {
                let delay_s = delays[0] + share * (delays[1] - delays[0]);
                let lag_s = lags[0] + other * (lags[1] - lags[0]);
                let exact = integral(instants, |t| lagged(t, lag_s, delay_s));
                tried += 1;
                assert!(holds(force, exact), "{exact} not in {force:?}, {instants:?} {delay_s} {lag_s}");
                missed += usize::from(!holds(narrow, exact));
            }
        }
    }
    assert!(missed > tried / 10, "by the middles {missed} of {tried} are missed");
}
