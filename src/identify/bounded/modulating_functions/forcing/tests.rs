//! What hats see of a square wave, each with a false variant that is caught.

use super::Forcing;
use crate::experiment::Record;
use crate::identify::DragLaw;
use crate::identify::bounded::modulating_functions::weight::Hat;
use crate::identify::bounded::problem::Problem;
use crate::identify::bounded::{BoundedModel, DelayBound, tests};
use crate::numeric::Interval;

/// Between samples.
const STEP_S: f64 = 0.1;
/// Pieces of a sample's interval in which sums of midpoints stand for integrals.
const PIECES: usize = 400;

/// `int K f` over a hat with its ends and its peak at these instants, of a force in pieces from the time zero on.
fn integral([l, m, r]: [f64; 3], f: impl Fn(usize) -> f64) -> f64 {
    let piece = STEP_S / PIECES as f64;
    let from = (l / piece).round() as usize;
    let to = (r / piece).round() as usize;
    let height = |t: f64| ((t - l) / (m - l)).min((r - t) / (r - m));
    (from..to).map(|k| height((k as f64 + 0.5) * piece) * f(k) * piece).sum()
}

/// The record's command, which turns every two seconds, this late.
fn command(t: f64, delay_s: f64) -> f64 {
    if ((t - delay_s) / tests::TURN_S).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 }
}

/// Room for what a sum of midpoints misses: a piece at a jump.
const MISSED: f64 = 4.0 * STEP_S / PIECES as f64;

fn holds(range: Interval, value: f64) -> bool {
    range.intersection(Interval::symmetric(MISSED) + Interval::point(value)).is_some()
}

#[test]
fn the_push_of_every_delay_is_enclosed_and_by_the_middle_slope_it_is_not() {
    let delays = [0.2, 0.9];
    let model = BoundedModel { quantum: Some(0.02), ..BoundedModel::new(DragLaw::Linear, DelayBound::WithinS(delays)) };
    let problem = Problem::new(&[&tests::record(150)], &model).expect("a problem");
    let range = Interval::new(delays[0], delays[1]).expect("ordered");
    let (mut missed, mut tried) = (0, 0);
    for first in 20..100 {
        let instants = [first, first + 9, first + 15].map(|sample| f64::from(sample) * STEP_S);
        let Forcing { force, by_delay, .. } = problem.forcing(0, &Hat::of(instants), range);
        for share in [0.0, 0.3, 0.8, 1.0] {
            let delay_s = delays[0] + share * (delays[1] - delays[0]);
            let push = integral(instants, |k| command((k as f64 + 0.5) * STEP_S / PIECES as f64, delay_s));
            let later = Interval::point(delay_s) - Interval::point(range.midpoint());
            tried += 1;
            assert!(holds(force + by_delay * later, push), "{instants:?} {delay_s}");
            missed += usize::from(!holds(force + Interval::point(by_delay.midpoint()) * later, push));
        }
    }
    assert!(missed > tried / 10, "{missed} of {tried}");
}

/// The force behind a lag at every piece's middle, from nothing at the time zero: the exact solution from piece to piece.
fn behind(lag_s: f64, delay_s: f64, pieces: usize) -> Vec<f64> {
    let piece = STEP_S / PIECES as f64;
    let mut force = 0.0;
    let left = (-piece / lag_s).exp();
    let advance = |k: usize| {
        let u = command((k as f64 + 0.5) * piece, delay_s);
        let middle = u + (force - u) * left.sqrt();
        force = u + (force - u) * left;
        middle
    };
    (0..pieces).map(advance).collect()
}

#[test]
fn the_push_through_every_lag_is_enclosed_and_by_middle_slopes_or_without_what_came_before_it_is_not() {
    let (mut missed, mut tried, mut forgotten, mut sloped) = (0, 0, 0, 0);
    for (delays, lags) in [([0.2, 0.3], [0.15, 0.2]), ([0.0, 0.9], [0.05, 1.5]), ([0.4, 0.4], [0.4, 0.42])] {
        let model = BoundedModel {
            quantum: Some(0.02),
            lag: true,
            ..BoundedModel::new(DragLaw::Linear, DelayBound::WithinS(delays))
        };
        let problem = Problem::new(&[&tests::record(150)], &model).expect("a problem");
        let delay = Interval::new(delays[0], delays[1]).expect("ordered");
        let rate = Interval::new(1.0 / lags[1], 1.0 / lags[0]).expect("ordered");
        for share in [0.0, 0.3, 0.8, 1.0] {
            let delay_s = delays[0] + share * (delays[1] - delays[0]);
            for other in [0.0, 0.5, 1.0] {
                let lag_s = lags[0] + other * (lags[1] - lags[0]);
                let force_at = behind(lag_s, delay_s, 130 * PIECES);
                let later = Interval::point(delay_s) - Interval::point(delay.midpoint());
                let faster = Interval::point(1.0 / lag_s) - Interval::point(rate.midpoint());
                for (first, half) in (10..100).step_by(7).flat_map(|first| [(first, 3), (first, 9)]) {
                    let instants = [first, first + half, first + half + 6].map(|sample| f64::from(sample) * STEP_S);
                    let Forcing { force, by_delay, by_lag_rate } =
                        problem.lagged_forcing(0, &Hat::of(instants), delay, rate);
                    let push = integral(instants, |k| force_at[k]);
                    tried += 1;
                    let whole = force + by_delay * later + by_lag_rate * faster;
                    assert!(holds(whole, push), "{push} not in {whole:?}, {instants:?} {delay_s} {lag_s}");
                    let [a, b] = [by_delay, by_lag_rate].map(|slope| Interval::point(slope.midpoint()));
                    missed += usize::from(!holds(force + a * later + b * faster, push));
                    sloped += usize::from(by_lag_rate != Interval::ZERO);
                    let known = Interval::point(force.midpoint()) + by_delay * later + by_lag_rate * faster;
                    forgotten += usize::from(!holds(known, push));
                }
            }
        }
    }
    assert!(sloped > tried / 10, "{sloped} of {tried} have slopes");
    assert!(missed > 20, "by middle slopes {missed} of {tried} are missed");
    assert!(forgotten > 20, "without what is unknown {forgotten} of {tried} are missed");
}

#[test]
fn velocities_behind_a_lag_are_enclosed_and_those_of_a_prompt_force_are_not() {
    let (lag_s, delay_s, samples, piece) = (0.3, 0.2, 130, STEP_S / PIECES as f64);
    let (gain, rate, drift) = (1.0 / tests::ALPHA, tests::BETA / tests::ALPHA, tests::DELTA / tests::ALPHA);
    // Midpoint steps of the velocity, a thousandth of the rounding off at most.
    let (mut x, mut v) = (0.0, 0.2);
    let mut fine = vec![[x, v]];
    for force in behind(lag_s, delay_s, samples * PIECES) {
        let acceleration = |v: f64| gain * force + drift - rate * v;
        let middle = v + 0.5 * piece * acceleration(v);
        (x, v) = (x + piece * middle, v + piece * acceleration(middle));
        fine.push([x, v]);
    }
    let at_sample = |k: usize| fine[k * PIECES];
    let times: Vec<f64> = (0..samples).map(|k| k as f64 * STEP_S).collect();
    let output = (0..samples).map(|k| (at_sample(k)[0] / tests::STEP).round() * tests::STEP).collect();
    let record = Record::new(times.clone(), output, times.iter().map(|t| command(t + 1e-9, 0.0)).collect());
    let record = record.expect("a record");
    let missed = |lag: bool, width: f64| {
        let model = BoundedModel::new(DragLaw::Linear, DelayBound::KnownS(delay_s));
        let problem = Problem::new(&[&record], &BoundedModel { quantum: Some(tests::STEP), lag, ..model }).ok()?;
        let mut at = problem.search.clone();
        let truth = [gain, rate].into_iter().chain(lag.then_some(1.0 / lag_s)).chain([drift]);
        for (side, value) in at.iter_mut().zip(truth) {
            *side = Interval::new(value * (1.0 - width), value * (1.0 + width))?;
        }
        let speeds = problem.velocities(0, &at)?;
        Some((0..samples).filter(|k| !speeds.at_samples[*k].contains(at_sample(*k)[1])).count())
    };
    for width in [0.01, 0.1, 0.5] {
        assert_eq!(missed(true, width), Some(0), "{width}");
    }
    assert!(missed(false, 0.01).is_none_or(|missed| missed > 10), "{:?}", missed(false, 0.01));
}
