//! Velocities from readings alone: while the command does not change, a drag axis goes to its steady speed, and its velocity one way.
//!
//! The equation is autonomous then, and of the velocity only, so that two motions never pass each other, nor one its own
//! shifted in time: the velocity rises throughout, or falls throughout, whatever the parameters. So the output is convex or
//! concave, and mean velocities before and after a sample enclose the velocity there.

use super::bounds::Contradicting;
use super::contract::Model;
use super::field::Term;
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// Spans over which the mean speed is taken, in samples.
pub(super) const SPANS: [usize; 8] = [1, 2, 3, 5, 8, 13, 21, 34];

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
        for (speed, [least, most]) in speeds.iter_mut().zip(self.means(record, even, sign)) {
            *speed = speed.intersection(Interval::new(least.end, f64::INFINITY)?)?;
            *speed = speed.intersection(Interval::new(f64::NEG_INFINITY, most.end)?)?;
        }
        for sample in 1..speeds.len() {
            let before = Interval::new(speeds[sample - 1].lower(), f64::INFINITY)?;
            speeds[sample] = speeds[sample].intersection(before)?;
        }
        for sample in (1..speeds.len()).rev() {
            let after = Interval::new(f64::NEG_INFINITY, speeds[sample].upper())?;
            speeds[sample - 1] = speeds[sample - 1].intersection(after)?;
        }
        Some(speeds)
    }

    /// For every sample of an even time, at least the largest of the means that end with it, at most the least of those that begin with it.
    fn means(&self, record: usize, even: Even, sign: Interval) -> Vec<[Mean; 2]> {
        let none = |end| Mean { end, first: even.first, last: even.first };
        let mut means = vec![[none(f64::NEG_INFINITY), none(f64::INFINITY)]; even.last - even.first + 1];
        for span in SPANS {
            for first in even.first..(even.last + 1).saturating_sub(span) {
                let last = first + span;
                let mean = sign * self.mean(record, first, last);
                let [least, _] = &mut means[last - even.first];
                if mean.lower() > least.end {
                    *least = Mean { end: mean.lower(), first, last };
                }
                let [_, most] = &mut means[first - even.first];
                if mean.upper() < most.end {
                    *most = Mean { end: mean.upper(), first, last };
                }
            }
        }
        means
    }

    /// Readings of an even time that no motion meets, whatever its parameters: they go neither one way nor the other. Empty where there
    /// are none such.
    pub(super) fn clash(&self, record: usize, even: Even) -> Vec<Contradicting> {
        let mut readings = Vec::new();
        for turned in [false, true] {
            let means = self.means(record, even, if turned { -Interval::ONE } else { Interval::ONE });
            let mut least = means[0][0];
            let clash = means.iter().find_map(|[own, most]| {
                if own.end > least.end {
                    least = *own;
                }
                (least.end > most.end).then_some((least, *most))
            });
            let Some((fast, slow)) = clash else { return Vec::new() };
            // The faster mean comes first: its end is too high, and that of the slower one too low.
            for (mean, faster) in [(fast, true), (slow, false)] {
                let share = 0.25 / (mean.last - mean.first) as f64;
                for (sample, last) in [(mean.first, false), (mean.last, true)] {
                    readings.push(Contradicting { record, sample, model_above: (faster == last) == turned, share });
                }
            }
        }
        let sum: f64 = readings.iter().map(|part| part.share).sum();
        readings.iter_mut().for_each(|part| part.share /= sum);
        readings.sort_by_key(|part| (part.record, part.sample));
        readings
    }
}

/// An end of a mean velocity's range, and the samples between which it is.
#[derive(Clone, Copy, Debug)]
struct Mean {
    end: f64,
    first: usize,
    last: usize,
}
