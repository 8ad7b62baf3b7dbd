//! The equation of motion weighed over stretches of a record: inequalities linear in the terms, good over any box.
//!
//! For a hat K, one at a sample and falling to zero at two others, `int K x''` is a difference of two mean velocities, so that three
//! readings give it to within their errors. The equation makes it a combination of the terms, whose coefficients follow
//! from the command and the readings between.

use super::contract::{Hat, Linear, Model, Origin};
use super::field::{Term, cube, signed_square};
use super::hat::Shape;
use super::impulse::Impulse;
use super::problem::Readings;
use super::speeds::Speeds;
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// Half-widths of the hats, as shares of the time between switchings.
const SHARES: [f64; 5] = [0.2, 0.4, 0.8, 1.4, 2.2];
/// Hats of one width, at most.
const MOST_HATS: usize = 60;

/// Hats all along a record from a sample on, with the mean time between switchings `swing_s`.
pub(super) fn hats(time_s: &[f64], from: usize, swing_s: f64) -> Vec<Hat> {
    let (mut hats, time_s) = (Vec::new(), &time_s[from..]);
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
            let first = from + room * index / count.max(2).saturating_sub(1).max(1);
            hats.push([first, first + half, first + 2 * half]);
        }
    }
    hats.dedup();
    hats
}

/// A function of velocity about a point: `value + slope (v - point)`, and a range for what that leaves out.
struct Tangent {
    slope: f64,
    /// `value - slope point`.
    constant: Interval,
    rest: Interval,
}

impl Tangent {
    fn identity() -> Self {
        Self { slope: 1.0, constant: Interval::ZERO, rest: Interval::ZERO }
    }

    /// Of `v |v| - 2 middle v` over a range: its second derivative is two, with the sign of v.
    fn square(range: Interval, middle: f64) -> Self {
        let point = range.midpoint();
        let slope = 2.0 * (point.abs() - middle);
        let value = signed_square(Interval::point(point)) - Interval::point(2.0 * middle) * Interval::point(point);
        let far = (range - Interval::point(point)).square();
        let rest = if range.lower() >= 0.0 {
            far.hull(Interval::ZERO)
        } else if range.upper() <= 0.0 {
            (-far).hull(Interval::ZERO)
        } else {
            far.hull(-far)
        };
        Self { slope, constant: value - Interval::point(slope) * Interval::point(point), rest }
    }

    /// Of `v^3` over a range: `v^3 = p^3 + 3 p^2 (v - p) + (v - p)^2 (v + 2 p)`.
    fn cube(range: Interval) -> Self {
        let point = range.midpoint();
        let slope = 3.0 * point * point;
        let p = Interval::point(point);
        let rest = (range - p).square() * (range + Interval::two() * p);
        Self { slope, constant: cube(p) - Interval::point(slope) * p, rest }
    }
}

/// What one hat needs of the readings under it.
struct Under<'a> {
    readings: &'a Readings,
    speeds: &'a Speeds,
    hat: &'a Hat,
    shape: Shape,
    /// What a reading may be off, with its stamp.
    error: Interval,
}

impl Under<'_> {
    /// `int K f(v)`, where `f` is given about a point for every interval between samples.
    ///
    /// The way between two samples is what the readings say, to within their errors, which sum up by how the weights differ from
    /// one interval to the next.
    fn weigh(&self, f: impl Fn(Interval) -> Tangent) -> Interval {
        let (time, value) = (&self.readings.time_s, &self.readings.value);
        let (mut sum, mut errors, mut before) = (Interval::ZERO, Interval::ZERO, Interval::ZERO);
        for sample in self.hat[0]..self.hat[2] {
            let range = self.speeds.between[sample];
            let Tangent { slope, constant, rest } = f(range);
            let slope = Interval::point(slope);
            let lasted = Interval::point(time[sample + 1]) - Interval::point(time[sample]);
            let (here, next) = (self.shape.height_at(time[sample]), self.shape.height_at(time[sample + 1]));
            let height = Interval::point(0.5) * (here + next);
            let way = Interval::point(value[sample + 1]) - Interval::point(value[sample]);
            // The hat is not at its middle throughout: what it is more in one half it is less in the other.
            let off = Interval::point(0.25) * (here - next).abs() * lasted;
            let weight = slope * height;
            sum += weight * way + slope * off * Interval::symmetric(range.radius());
            sum += height * lasted * (constant + rest);
            sum += off * Interval::symmetric(rest.radius());
            errors += (weight - before).abs();
            before = weight;
        }
        errors += before.abs();
        sum + Interval::symmetric((self.error * errors).upper())
    }

    /// `int K x`: between two samples the output is off the chord by no more than the speeds allow.
    fn place(&self) -> Interval {
        let (time, value) = (&self.readings.time_s, &self.readings.value);
        let half = Interval::point(0.5);
        let mut sum = Interval::ZERO;
        for sample in self.hat[0]..self.hat[2] {
            let lasted = Interval::point(time[sample + 1]) - Interval::point(time[sample]);
            let (here, next) = (self.shape.height_at(time[sample]), self.shape.height_at(time[sample + 1]));
            let (a, b) = (Interval::point(value[sample]), Interval::point(value[sample + 1]));
            let bulge = half * Interval::point(self.speeds.between[sample].radius()) * lasted;
            let near = self.error + bulge;
            let off = Interval::point(0.25) * (here - next).abs() * lasted;
            sum += half * (here + next) * lasted * (half * (a + b) + Interval::symmetric(near.upper()));
            sum += off * Interval::symmetric((half * (b - a).abs() + near).upper());
        }
        sum
    }
}

impl Model<'_> {
    /// Inequalities for all `hats` of a record over a box; `speeds` enclose the velocity at its samples.
    pub(super) fn weigh(&self, record: usize, hats: &[Hat], at: &[Interval], speeds: &Speeds, linear: &mut Linear) {
        let readings = &self.records[record];
        let delay_s = self.delay_s(at);
        let stray = Interval::point(readings.jitter_s) * Interval::point(speeds.fastest());
        let error = Interval::point(readings.error) + stray;
        let rate = self.layout.place_of(Term::LagRate).map(|place| at[place]);
        for hat in hats {
            // The hat starts once every command that acts is in the log.
            if hat[0] < speeds.known {
                continue;
            }
            let shape = Shape::of(hat.map(|sample| readings.time_s[sample]));
            let under = Under { readings, speeds, hat, shape, error };
            let shape = &under.shape;
            let y = hat.map(|sample| Interval::point(readings.value[sample]));
            let second = (y[2] - y[1]) / shape.right() - (y[1] - y[0]) / shape.left();
            let share = Interval::ONE / shape.right() + Interval::ONE / shape.left();
            let Impulse { force, by_delay, by_lag_rate } = match rate {
                Some(rate) => self.pushed_behind(record, shape, delay_s, rate),
                None => self.pushed(record, shape, delay_s),
            };
            let mut slopes: Vec<(usize, Interval)> = Vec::new();
            for (unknown, term) in self.layout.terms().iter().enumerate() {
                let slope = match term {
                    Term::Gain => force,
                    Term::Linear => -under.weigh(|_| Tangent::identity()),
                    Term::Quadratic => -under.weigh(|range| Tangent::square(range, self.middle_speed)),
                    Term::Cubic => -under.weigh(Tangent::cube),
                    Term::Stiffness => -under.place(),
                    Term::LagRate => at[0] * by_lag_rate,
                    Term::Disturbance => continue,
                };
                slopes.push((unknown, slope));
            }
            // The command comes later by what the delay is more than its middle.
            slopes.extend(self.layout.delay().map(|delay| (delay, at[0] * by_delay)));
            slopes.push((self.layout.disturbance(record), shape.area()));
            let error = Interval::two() * error * share;
            linear.pair(slopes.into_iter(), -second, error, |above| Origin::Hat { record, samples: *hat, above });
        }
    }
}
