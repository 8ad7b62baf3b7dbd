//! What hats see of the command: at once, or through a lag.

use super::contract::Model;
use super::hat::Shape;
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// `int K f` of the force f over its unit gain, for the middles of what delay and lag can be; and its slopes by both.
pub(super) struct Impulse {
    pub(super) force: Interval,
    pub(super) by_delay: Interval,
    /// By the reciprocal of the lag.
    pub(super) by_lag_rate: Interval,
}

impl Model<'_> {
    /// Without a lag, each switching anywhere in its span.
    pub(super) fn pushed(&self, record: usize, shape: &Shape, delay_s: Interval) -> Impulse {
        let command = &self.records[record].command;
        let middle = Interval::point(delay_s.midpoint());
        let mut force = Interval::point(command.levels()[0]) * shape.area();
        let mut by_delay = Interval::ZERO;
        for edge in 0..command.edges() {
            let (open, close) = command.window(edge, delay_s);
            if open >= shape.r.upper() {
                break;
            }
            // What comes after the switching.
            let (first, last) = command.window(edge, middle);
            let after = (shape.area() - shape.area_to(first)).hull(shape.area() - shape.area_to(last));
            force -= command.drop_at(edge) * after;
            by_delay += command.drop_at(edge) * shape.height(open, close);
        }
        Impulse { force, by_delay, by_lag_rate: Interval::ZERO }
    }

    /// Through a lag whose reciprocal is in `rate`: a step of the force comes late by a time with an exponential distribution. Where
    /// slopes would leave more open than the range of the force itself, that stands for them.
    pub(super) fn pushed_behind(&self, record: usize, shape: &Shape, delay_s: Interval, rate: Interval) -> Impulse {
        let readings = &self.records[record];
        let command = &readings.command;
        let middle = Interval::point(delay_s.midpoint());
        let (late_s, late) = (Interval::ONE / rate, Interval::ONE / Interval::point(rate.midpoint()));
        let constant = Interval::point(command.levels()[0]) * shape.area();
        let (mut force, mut by_delay, mut by_late) = (constant, Interval::ZERO, Interval::ZERO);
        let mut range = constant;
        for edge in 0..command.edges() {
            let (open, close) = command.window(edge, delay_s);
            if open >= shape.r.upper() {
                break;
            }
            let drop = command.drop_at(edge);
            let (first, last) = command.window(edge, middle);
            force -= drop * shape.late_area(first, late).hull(shape.late_area(last, late));
            let most = shape.late_area(open, Interval::point(late_s.lower()));
            range -= drop * most.hull(shape.late_area(close, Interval::point(late_s.upper())));
            let instants = Interval::point(open).hull(Interval::point(close));
            by_delay += drop * shape.late_height(instants, late_s);
            by_late += drop * shape.late_lever(instants, late_s);
        }
        // What acted before the log is forgotten at the lag's rate.
        let since = shape.l - (Interval::point(readings.time_s[0]) + delay_s);
        let forgotten = (-since.max(Interval::ZERO) / late_s).exp() * shape.area();
        let unknown = Interval::symmetric((Interval::point(2.0 * command.largest()) * forgotten).upper());
        let by_lag_rate = -by_late * late_s.square();
        let slopes = by_delay.radius() * delay_s.radius() + by_lag_rate.radius() * rate.radius();
        if slopes < range.radius() {
            Impulse { force: force + unknown, by_delay, by_lag_rate }
        } else {
            Impulse { force: range + unknown, by_delay: Interval::ZERO, by_lag_rate: Interval::ZERO }
        }
    }
}
