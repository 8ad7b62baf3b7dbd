//! The equation of motion weighed over stretches of a record: inequalities linear in the terms, good over any box.
//!
//! For a hat K, one at a sample and falling to zero at two others, `int K x''` is a difference of two mean velocities, so that three
//! readings give it to within their errors. The equation makes it a combination of the terms, whose coefficients follow
//! from the command and the readings between.

use super::contract::{Hat, Linear, Model, Origin};
use super::field::{Term, signed_square};
use super::speeds::Speeds;
use crate::numeric::{Interval, Real};

/// Half-widths of the hats, as shares of the time between switchings.
const SHARES: [f64; 5] = [0.2, 0.4, 0.8, 1.4, 2.2];
/// Hats of one width, at most.
const MOST_HATS: usize = 60;

/// Hats all along a record with the mean time between switchings `swing_s`.
pub(super) fn hats(time_s: &[f64], swing_s: f64) -> Vec<Hat> {
    let mut hats = Vec::new();
    let interval = (time_s[time_s.len() - 1] - time_s[0]) / (time_s.len() - 1) as f64;
    let mut before = 0;
    for share in SHARES {
        let half = ((share * swing_s / interval).round() as usize).max(1);
        if half == before || 2 * half >= time_s.len() {
            continue;
        }
        before = half;
        let room = time_s.len() - 1 - 2 * half;
        let count = (2 * room / half + 1).clamp(1, MOST_HATS);
        for index in 0..count {
            let first = room * index / count.max(2).saturating_sub(1).max(1);
            hats.push([first, first + half, first + 2 * half]);
        }
    }
    hats.dedup();
    hats
}

impl Model<'_> {
    /// `int K u`, the command delayed by anything in `delay_s` and each switching anywhere in its span.
    fn pushed(&self, record: usize, [l, m, r]: [f64; 3], delay_s: Interval) -> Interval {
        let command = &self.records[record].command;
        let [l, m, r] = [l, m, r].map(Interval::point);
        // The hat's area up to an instant.
        let area = |t: f64| -> Interval {
            let t = Interval::point(t);
            let half = Interval::point(0.5);
            if t.upper() <= l.lower() {
                Interval::ZERO
            } else if t.upper() <= m.lower() {
                half * (t - l).square() / (m - l)
            } else if t.upper() < r.upper() {
                half * (r - l) - half * (r - t).square() / (r - m)
            } else {
                half * (r - l)
            }
        };
        let whole = Interval::point(0.5) * (r - l);
        let mut sum = Interval::point(command.levels()[0]) * whole;
        for edge in 0..command.edges() {
            let (open, close) = command.window(edge, delay_s);
            if open >= r.upper() {
                break;
            }
            // What comes after the switching; the area falls as it comes later.
            let after = (whole - area(open)).hull(whole - area(close));
            sum -= command.drop_at(edge) * after;
        }
        sum
    }

    /// Inequalities for all `hats` of a record over a box; `speeds` enclose the velocity at its samples.
    pub(super) fn weigh(&self, record: usize, hats: &[Hat], at: &[Interval], speeds: &Speeds, linear: &mut Linear) {
        let readings = &self.records[record];
        let delay_s = self.delay_s(at);
        let fastest = speeds.between.iter().fold(0.0f64, |fastest, speed| fastest.max(speed.magnitude()));
        let lagged = self.layout.lagged();
        for hat in hats {
            let [l, m, r] = hat.map(|sample| readings.time_s[sample]);
            // The hat starts once every command that acts is in the log.
            if Interval::point(l).lower() < readings.time_s[0] + delay_s.upper() {
                continue;
            }
            let [left, right] = [Interval::point(m) - Interval::point(l), Interval::point(r) - Interval::point(m)];
            let y = hat.map(|sample| Interval::point(readings.value[sample]));
            let second = (y[2] - y[1]) / right - (y[1] - y[0]) / left;
            let share = Interval::ONE / right + Interval::ONE / left;
            let stray = Interval::point(readings.jitter_s) * Interval::point(fastest);
            let error = Interval::two() * (Interval::point(readings.error) + stray) * share;
            let whole = Interval::point(0.5) * (left + right);
            let peak = |sample: usize| -> Interval {
                let t = Interval::point(readings.time_s[sample]);
                if sample <= hat[1] { (t - Interval::point(l)) / left } else { (Interval::point(r) - t) / right }
            };
            let (mut velocity, mut drag, mut cube, mut place) =
                (Interval::ZERO, Interval::ZERO, Interval::ZERO, Interval::ZERO);
            for sample in hat[0]..hat[2] {
                let lasted = Interval::point(readings.time_s[sample + 1]) - Interval::point(readings.time_s[sample]);
                let (here, next) = (peak(sample), peak(sample + 1));
                let middle = Interval::point(0.5) * (here + next);
                let range = speeds.between[sample];
                let way = Interval::point(readings.value[sample + 1]) - Interval::point(readings.value[sample]);
                // What is left when the hat is taken at its middle weighs both halves oppositely.
                let off = Interval::point(0.25) * (here - next).abs() * lasted;
                velocity += middle * way + off * Interval::symmetric(range.radius());
                let weight = middle * lasted;
                drag += weight * signed_square(range);
                cube += weight * range * range.square();
                place += weight
                    * (Interval::point(readings.value[sample]).hull(Interval::point(readings.value[sample + 1])))
                    + weight * Interval::symmetric(readings.error + range.magnitude() * lasted.upper());
            }
            // The readings' errors in the way sum up by the hat's own rise and fall.
            velocity += Interval::symmetric((Interval::two() * (Interval::point(readings.error) + stray)).upper());
            drag = drag
                .intersection(square_by_mean(velocity, whole, range_over(&speeds.between[hat[0]..hat[2]])))
                .unwrap_or(drag);
            let force = if lagged {
                whole * Interval::symmetric(readings.command.largest())
            } else {
                self.pushed(record, [l, m, r], delay_s)
            };
            let mut slopes: Vec<(usize, Interval)> = Vec::new();
            for (unknown, term) in self.layout.terms().iter().enumerate() {
                let slope = match term {
                    Term::Gain => force,
                    Term::Linear => -velocity,
                    Term::Quadratic => Interval::point(2.0 * self.middle_speed) * velocity - drag,
                    Term::Cubic => -cube,
                    Term::Stiffness => -place,
                    Term::Disturbance | Term::LagRate => continue,
                };
                slopes.push((unknown, slope));
            }
            slopes.push((self.layout.disturbance(record), whole));
            linear.pair(slopes.into_iter(), -second, error, |above| Origin::Hat { record, samples: *hat, above });
        }
    }
}

fn range_over(ranges: &[Interval]) -> Interval {
    ranges.iter().copied().reduce(Interval::hull).unwrap_or(Interval::ENTIRE)
}

/// `int K v |v|` from `int K v`, for a velocity of one sign: not below the mean's square, nor above the chord over the range.
fn square_by_mean(velocity: Interval, whole: Interval, range: Interval) -> Interval {
    if range.upper() <= 0.0 {
        return -square_by_mean(-velocity, whole, -range);
    }
    if !(range.lower() >= 0.0) {
        return Interval::ENTIRE;
    }
    let (low, high) = (Interval::point(range.lower()), Interval::point(range.upper()));
    let velocity = Interval::new(velocity.lower().max(0.0), velocity.upper().max(0.0)).unwrap_or(velocity);
    let least = velocity.square() / whole;
    let most = (low + high) * velocity - low * high * whole;
    Interval::new(least.lower(), most.upper()).unwrap_or(Interval::ENTIRE)
}
