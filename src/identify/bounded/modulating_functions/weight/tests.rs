//! What comes late, against sums over many latenesses.

use super::Hat;
use crate::numeric::Interval;

const HAT: [f64; 3] = [2.0, 2.9, 3.5];
/// Latenesses of a sum.
const PIECES: usize = 4000;
/// What a sum over them misses.
const MISSED: f64 = 1e-5;

/// The mean of `f(X)`, X distributed exponentially with the mean one, where f is zero from `most` on.
fn mean(most: f64, f: impl Fn(f64) -> f64) -> f64 {
    let piece = most / PIECES as f64;
    (0..PIECES).map(|k| (k as f64 + 0.5) * piece).map(|x| f(x) * (-x).exp() * piece).sum()
}

fn height(t: f64) -> f64 {
    let [l, m, r] = HAT;
    ((t - l) / (m - l)).min((r - t) / (r - m)).max(0.0)
}

/// The area after an instant.
fn area(t: f64) -> f64 {
    let [l, m, r] = HAT;
    let below =
        if t < m { (t - l).max(0.0).powi(2) / (m - l) } else { (m - l) + (r - m) - (r - t).max(0.0).powi(2) / (r - m) };
    0.5 * (r - l - below)
}

fn holds(range: Interval, value: f64) -> bool {
    range.lower() - MISSED <= value && value <= range.upper() + MISSED
}

#[test]
fn all_that_comes_late_is_enclosed_and_by_the_middles_it_is_not() {
    let shape = Hat::of(HAT);
    let (mut missed, mut tried) = (0, 0);
    for step in 0..40 {
        let from = 0.1 * f64::from(step);
        for (width, lags) in [(0.0, [0.3, 0.3]), (0.4, [0.2, 0.3]), (0.1, [0.05, 0.9])] {
            let instants = Interval::new(from, from + width).expect("ordered");
            let late_s = Interval::new(lags[0], lags[1]).expect("ordered");
            let middles = [instants, late_s].map(|range| Interval::point(range.midpoint()));
            for (a, b) in [(0.0, 0.0), (0.0, 1.0), (0.5, 0.5), (1.0, 0.0), (1.0, 1.0)] {
                let (s, late) = (from + a * width, lags[0] + b * (lags[1] - lags[0]));
                let mean = |f: &dyn Fn(f64) -> f64| mean((HAT[2] - s).max(0.0) / late, f);
                let [high, levered] = [mean(&|x| height(s + x * late)), mean(&|x| x * height(s + x * late))];
                assert!(holds(shape.lagged_height(instants, late_s), high), "height {high} at {s}, {late}");
                assert!(holds(shape.lagged_lever(instants, late_s), levered), "lever {levered} at {s}, {late}");
                let after = mean(&|x| area(s + x * late));
                assert!(holds(shape.lagged_area(s, Interval::point(late)), after), "area {after} at {s}, {late}");
                tried += 1;
                missed += usize::from(!holds(shape.lagged_lever(middles[0], middles[1]), levered));
                missed += usize::from(!holds(shape.lagged_height(middles[0], middles[1]), high));
            }
        }
    }
    assert!(missed > tried / 4, "by the middles {missed} of {tried} are missed");
}
