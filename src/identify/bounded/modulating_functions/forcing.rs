//! The integral of the force under a hat: of the command itself, or of the command behind a first-order lag.

use super::super::problem::Problem;
use super::weight::Hat;
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// `int K f` of the force over its unit gain at the middles of delay and lag rate, and its derivatives by both over their ranges.
pub(super) struct Forcing {
    pub(super) force: Interval,
    pub(super) by_delay: Interval,
    pub(super) by_lag_rate: Interval,
}

impl Problem {
    /// Without a lag, each switching anywhere in its range. A switching takes `u_before - u_after` off the area after it.
    pub(super) fn forcing(&self, record: usize, hat: &Hat, delay_s: Interval) -> Forcing {
        let command = &self.records[record].command;
        let middle = Interval::point(delay_s.midpoint());
        let mut force = Interval::point(command.levels[0]) * hat.area();
        let mut by_delay = Interval::ZERO;
        for (edge, (over, own)) in command.windows(delay_s).zip(command.windows(middle)).enumerate() {
            if over.lower() >= hat.r.upper() {
                break;
            }
            let after = (hat.area() - hat.area_to(own.lower())).hull(hat.area() - hat.area_to(own.upper()));
            force -= command.drop_at(edge) * after;
            by_delay += command.drop_at(edge) * hat.height(over);
        }
        Forcing { force, by_delay, by_lag_rate: Interval::ZERO }
    }

    /// Behind a lag whose reciprocal is in `rate`. Where the derivatives leave a wider range than that of the integral over all delays and
    /// lags, the latter is used.
    pub(super) fn lagged_forcing(&self, record: usize, hat: &Hat, delay_s: Interval, rate: Interval) -> Forcing {
        let readings = &self.records[record];
        let command = &readings.command;
        let middle = Interval::point(delay_s.midpoint());
        let (lag_s, lag) = (Interval::ONE / rate, Interval::ONE / Interval::point(rate.midpoint()));
        let constant = Interval::point(command.levels[0]) * hat.area();
        let (mut force, mut by_delay, mut by_lag) = (constant, Interval::ZERO, Interval::ZERO);
        let mut range = constant;
        for (edge, (over, own)) in command.windows(delay_s).zip(command.windows(middle)).enumerate() {
            if over.lower() >= hat.r.upper() {
                break;
            }
            let drop = command.drop_at(edge);
            force -= drop * hat.lagged_area(own.lower(), lag).hull(hat.lagged_area(own.upper(), lag));
            let most = hat.lagged_area(over.lower(), Interval::point(lag_s.lower()));
            range -= drop * most.hull(hat.lagged_area(over.upper(), Interval::point(lag_s.upper())));
            by_delay += drop * hat.lagged_height(over, lag_s);
            by_lag += drop * hat.lagged_lever(over, lag_s);
        }
        // The force before the log is within the commands, and forgotten at the rate of the lag.
        let since = hat.l - (Interval::point(readings.time_s[0]) + delay_s);
        let forgotten = (-since.max(Interval::ZERO) / lag_s).exp() * hat.area();
        let unknown = Interval::symmetric((Interval::point(2.0 * command.largest()) * forgotten).upper());
        // d/d(1/T) = -T^2 d/dT.
        let by_lag_rate = -by_lag * lag_s.square();
        let by_derivatives = by_delay.radius() * delay_s.radius() + by_lag_rate.radius() * rate.radius();
        if by_derivatives < range.radius() {
            Forcing { force: force + unknown, by_delay, by_lag_rate }
        } else {
            Forcing { force: range + unknown, by_delay: Interval::ZERO, by_lag_rate: Interval::ZERO }
        }
    }
}
