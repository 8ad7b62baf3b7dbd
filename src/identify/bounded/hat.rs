//! Hats, as weights in time, and what they see of what comes late.

use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// A lag's memory of which less is left shows no more.
const GONE: f64 = 1e-14;

/// A hat in time: zero at its ends, one at its peak.
pub(super) struct Shape {
    pub(super) l: Interval,
    m: Interval,
    pub(super) r: Interval,
}

impl Shape {
    pub(super) fn of(instants: [f64; 3]) -> Self {
        let [l, m, r] = instants.map(Interval::point);
        Self { l, m, r }
    }
    pub(super) fn left(&self) -> Interval {
        self.m - self.l
    }
    pub(super) fn right(&self) -> Interval {
        self.r - self.m
    }
    pub(super) fn area(&self) -> Interval {
        Interval::point(0.5) * (self.r - self.l)
    }

    pub(super) fn height_at(&self, t: f64) -> Interval {
        let t = Interval::point(t);
        if t.upper() <= self.l.lower() || t.lower() >= self.r.upper() {
            Interval::ZERO
        } else if t.upper() <= self.m.lower() {
            (t - self.l) / self.left()
        } else {
            (self.r - t) / self.right()
        }
    }

    /// All heights from one instant to another.
    pub(super) fn height(&self, from: f64, to: f64) -> Interval {
        let ends = self.height_at(from).hull(self.height_at(to));
        let peak = from <= self.m.lower() && self.m.upper() <= to;
        if peak { ends.hull(Interval::ONE) } else { ends }
    }

    /// The area up to an instant.
    pub(super) fn area_to(&self, t: f64) -> Interval {
        let t = Interval::point(t);
        let half = Interval::point(0.5);
        if t.upper() <= self.l.lower() {
            Interval::ZERO
        } else if t.upper() <= self.m.lower() {
            half * (t - self.l).square() / self.left()
        } else if t.upper() < self.r.upper() {
            self.area() - half * (self.r - t).square() / self.right()
        } else {
            self.area()
        }
    }

    /// The steepest slope.
    pub(super) fn steepness(&self) -> Interval {
        (Interval::ONE / self.left()).max(Interval::ONE / self.right())
    }

    /// A sum over the corners p of what is `p - instant`, weighed so that the rests of it, `(p - instant)+`, add up to the height.
    fn corners(&self, instant: Interval, f: impl Fn(Interval) -> Interval) -> Interval {
        let (left, right) = (Interval::ONE / self.left(), Interval::ONE / self.right());
        let corners = [(self.l, left), (self.m, -left - right), (self.r, right)];
        let sum = |sum, (p, weight): (Interval, Interval)| sum + weight * f((p - instant).max(Interval::ZERO));
        corners.into_iter().fold(Interval::ZERO, sum)
    }

    /// What is in two enclosures of the same number.
    fn meet(a: Interval, b: Interval) -> Interval {
        a.intersection(b).unwrap_or(b)
    }

    /// What is left of one after as many mean latenesses as there are between an instant and the hat.
    fn left_before(&self, instant: f64, late_s: Interval) -> Interval {
        let ahead = (self.l - Interval::point(instant)).max(Interval::ZERO) / late_s;
        (-ahead).exp()
    }

    /// The area after an instant that comes late by a time with an exponential distribution of the mean `late_s`, in the mean: what a
    /// hat sees of a step at the instant through a first-order lag. It falls with both.
    pub(super) fn late_area(&self, instant: f64, late_s: Interval) -> Interval {
        let (left, half) = (self.left_before(instant, late_s), Interval::point(0.5));
        let least = self.area() * (Interval::ONE - left).max(Interval::ZERO);
        let likely = if instant < self.l.lower() { least.hull(self.area()) } else { Interval::ZERO.hull(self.area()) };
        if left.upper() < GONE {
            return likely;
        }
        let mean = self.corners(Interval::point(instant), |x| {
            half * x.square() - x * late_s - late_s.square() * (-x / late_s).exp_m1()
        });
        Self::meet(mean, likely)
    }

    /// The height at an instant that comes late likewise, in the mean, for all instants and latenesses within ranges.
    pub(super) fn late_height(&self, instants: Interval, late_s: Interval) -> Interval {
        let most = self.left_before(instants.upper(), late_s).hull(Interval::ZERO);
        if most.upper() < GONE {
            return most;
        }
        let (instant, late, off) = Self::middles(instants, late_s);
        let mean = self.corners(instant, |x| x + late * (-x / late).exp_m1());
        let [by_instant, by_late] = off;
        Self::meet(mean + Interval::symmetric((self.steepness() * (by_instant + by_late)).upper()), most)
    }

    /// The same weighed with how late it comes, in mean latenesses.
    pub(super) fn late_lever(&self, instants: Interval, late_s: Interval) -> Interval {
        let left = self.left_before(instants.upper(), late_s);
        let ahead = (self.l - Interval::point(instants.upper())).max(Interval::ZERO) / late_s;
        let most = ((Interval::ONE + ahead) * left).hull(Interval::ZERO);
        if left.upper() < GONE {
            return most;
        }
        let (instant, late, off) = Self::middles(instants, late_s);
        let mean = self.corners(instant, |x| {
            let gone = (-x / late).exp_m1();
            x * (Interval::two() + gone) + Interval::two() * late * gone
        });
        let [by_instant, by_late] = off;
        let room = self.steepness() * (by_instant + Interval::two() * by_late);
        Self::meet(mean + Interval::symmetric(room.upper()), most)
    }

    /// A middle instant and lateness, and how far from them the others are at most.
    fn middles(instants: Interval, late_s: Interval) -> (Interval, Interval, [Interval; 2]) {
        let [instant, late] = [instants, late_s].map(|range| Interval::point(range.midpoint()));
        (instant, late, [(instants - instant).abs(), (late_s - late).abs()])
    }
}
