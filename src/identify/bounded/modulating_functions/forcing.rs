//! The integral of the force under a hat: of the command itself, or of the command behind a first-order lag.

use super::super::problem::Problem;
use super::weight::Hat;
use crate::numeric::{Interval, Real};

#[cfg(test)]
mod tests;

/// `int K f` of the force over its unit gain at the middle of the delay, and its derivative by the delay over its range.
pub(super) struct Forcing {
    pub(super) force: Interval,
    pub(super) by_delay: Interval,
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
        Forcing { force, by_delay }
    }

    /// Behind a lag whose reciprocal is in `rate`: the integral over all delays and lags.
    pub(super) fn lagged_forcing(&self, record: usize, hat: &Hat, delay_s: Interval, rate: Interval) -> Forcing {
        let readings = &self.records[record];
        let (command, lag_s) = (&readings.command, Interval::ONE / rate);
        let mut force = Interval::point(command.levels[0]) * hat.area();
        for (edge, over) in command.windows(delay_s).enumerate() {
            if over.lower() >= hat.r.upper() {
                break;
            }
            let after = |instant: f64, lag_s: f64| hat.lagged_area(instant, Interval::point(lag_s));
            force -=
                command.drop_at(edge) * after(over.lower(), lag_s.lower()).hull(after(over.upper(), lag_s.upper()));
        }
        // The force before the log is within the commands, and forgotten at the rate of the lag.
        let since = hat.l - (Interval::point(readings.time_s[0]) + delay_s);
        let forgotten = (-since.max(Interval::ZERO) / lag_s).exp() * hat.area();
        let unknown = Interval::symmetric((Interval::point(2.0 * command.largest()) * forgotten).upper());
        Forcing { force: force + unknown, by_delay: Interval::ZERO }
    }
}
