//! The hat as a weight in time, and its integral against a step that comes late by an exponentially distributed time:
//! of a step of the command through a first-order lag T.
//!
//! With `r(x) = max(x, 0)` the hat is `K(t) = sum_p w_p r(p - t)` over its corners p. A function g with `g'' = K` and
//! its mean over an exponential distribution are evaluated by the same weights.

use crate::numeric::{Interval, Real};

/// A share of the lag's memory below this counts as gone.
const GONE: f64 = 1e-14;

/// A hat in time: zero at its ends, 1 at its peak.
pub(super) struct Hat {
    pub(super) l: Interval,
    m: Interval,
    pub(super) r: Interval,
}

impl Hat {
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

    /// All heights over a range of instants.
    pub(super) fn height(&self, instants: Interval) -> Interval {
        let ends = self.height_at(instants.lower()).hull(self.height_at(instants.upper()));
        if self.m.is_subset_of(instants) { ends.hull(Interval::ONE) } else { ends }
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

    /// `sum_p w_p g(r(p - instant))`.
    fn corners(&self, instant: Interval, g: impl Fn(Interval) -> Interval) -> Interval {
        let (left, right) = (Interval::ONE / self.left(), Interval::ONE / self.right());
        let corners = [(self.l, left), (self.m, -left - right), (self.r, right)];
        let sum = |sum, (p, weight): (Interval, Interval)| sum + weight * g((p - instant).max(Interval::ZERO));
        corners.into_iter().fold(Interval::ZERO, sum)
    }

    /// `exp(-(l - instant)/T)`: the share of the lag's memory that the hat still sees.
    fn memory(&self, instant: f64, lag_s: Interval) -> Interval {
        let ahead = (self.l - Interval::point(instant)).max(Interval::ZERO) / lag_s;
        (-ahead).exp()
    }

    /// `int K (1 - exp(-(t - instant)/T))` after the instant: the area that sees a step. It falls with the instant and with T.
    pub(super) fn lagged_area(&self, instant: f64, lag_s: Interval) -> Interval {
        let (memory, half) = (self.memory(instant, lag_s), Interval::point(0.5));
        let least = self.area() * (Interval::ONE - memory).max(Interval::ZERO);
        let likely = if instant < self.l.lower() { least.hull(self.area()) } else { Interval::ZERO.hull(self.area()) };
        if memory.upper() < GONE {
            return likely;
        }
        let mean = self.corners(Interval::point(instant), |x| {
            half * x.square() - x * lag_s - lag_s.square() * (-x / lag_s).exp_m1()
        });
        mean.intersection(likely).unwrap_or(likely)
    }
}
