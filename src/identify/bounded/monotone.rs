//! Velocities from readings alone: while the command does not change, a drag axis goes to its steady speed, and its velocity one way.
//!
//! The equation is autonomous then, and of the velocity only, so that two motions never pass each other, nor one its own
//! shifted in time: the velocity rises throughout, or falls throughout, whatever the parameters. So the output is convex or
//! concave, and mean velocities before and after a sample enclose the velocity there.

use super::contract::Model;
use super::field::Term;
use super::speeds::SPANS;
use crate::numeric::Interval;

/// Samples from the first to the last of a time in which the command certainly did not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Even {
    pub(super) first: usize,
    pub(super) last: usize,
}

impl Model<'_> {
    /// Whether the velocity by itself decides its own rate.
    pub(super) fn autonomous(&self) -> bool {
        !self.layout.lagged() && self.layout.place_of(Term::Stiffness).is_none()
    }

    /// The mean velocity between two samples.
    pub(super) fn mean(&self, record: usize, first: usize, last: usize) -> Interval {
        let readings = &self.records[record];
        let twice = Interval::symmetric(2.0 * readings.error);
        let way = Interval::point(readings.value[last]) - Interval::point(readings.value[first]) + twice;
        way / self.lasted(record, first, last)
    }

    /// What both ways leave of the velocities at the samples of an even time. `None` where neither is possible.
    pub(super) fn one_way(&self, record: usize, even: Even, speeds: &mut [Interval]) -> Option<()> {
        let own = &speeds[even.first..=even.last];
        // Falling, it rises where everything is turned round.
        let turned: Vec<Interval> = own.iter().map(|speed| -*speed).collect();
        let rising = self.rising(record, even, own.to_vec(), Interval::ONE);
        let falling = self.rising(record, even, turned, -Interval::ONE);
        for (offset, speed) in speeds[even.first..=even.last].iter_mut().enumerate() {
            *speed = match (&rising, &falling) {
                (Some(rising), Some(falling)) => rising[offset].hull(-falling[offset]),
                (Some(rising), None) => rising[offset],
                (None, Some(falling)) => -falling[offset],
                (None, None) => return None,
            };
        }
        Some(())
    }

    /// What is left of the velocities, all turned by `sign`, if they rise: none is below a mean before it, nor above one after it.
    fn rising(&self, record: usize, even: Even, mut speeds: Vec<Interval>, sign: Interval) -> Option<Vec<Interval>> {
        let above = |end: f64| Interval::new(end, f64::INFINITY);
        let below = |end: f64| Interval::new(f64::NEG_INFINITY, end);
        for span in SPANS {
            for first in even.first..(even.last + 1).saturating_sub(span) {
                let mean = sign * self.mean(record, first, first + span);
                let (before, after) = (first - even.first, first + span - even.first);
                speeds[before] = speeds[before].intersection(below(mean.upper())?)?;
                speeds[after] = speeds[after].intersection(above(mean.lower())?)?;
            }
        }
        for sample in 1..speeds.len() {
            speeds[sample] = speeds[sample].intersection(above(speeds[sample - 1].lower())?)?;
        }
        for sample in (1..speeds.len()).rev() {
            speeds[sample - 1] = speeds[sample - 1].intersection(below(speeds[sample].upper())?)?;
        }
        Some(speeds)
    }
}
