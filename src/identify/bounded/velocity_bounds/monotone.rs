//! Monotone velocities between two switchings, whatever the parameters.
//!
//! Under a constant command and without lag or spring, `v' = a(v)` is autonomous and scalar: its solutions are monotone. The output is convex
//! or concave, and the velocity at a sample is between a mean velocity before it and a mean velocity after it.

use super::super::answer::Contradicting;
use super::super::linear_relaxation::half_line;
use super::super::problem::Problem;
use super::super::record::Readings;
use super::super::vector_field::FieldTerm;
use crate::numeric::Interval;

/// Spans of the mean velocities, in samples: Fibonacci numbers, so that every length has one near.
pub(super) const SPANS: [usize; 8] = [1, 2, 3, 5, 8, 13, 21, 34];

/// First and last sample of a time in which the command certainly does not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Constant {
    pub(super) first: usize,
    pub(super) last: usize,
}

impl Problem {
    /// Whether the rate of the velocity depends on the velocity alone.
    pub(super) fn is_autonomous(&self) -> bool {
        [FieldTerm::LagRate, FieldTerm::Stiffness].into_iter().all(|term| self.unknowns.place_of(term).is_none())
    }
}

impl Readings {
    /// The velocities at the samples of such a time if they rise, or fall. `None` where neither is possible.
    pub(super) fn monotone(&self, span: Constant, velocities: &mut [Interval]) -> Option<()> {
        let own = &velocities[span.first..=span.last];
        let turned: Vec<Interval> = own.iter().map(|velocity| -*velocity).collect();
        let rising = self.rising(span, own.to_vec(), Interval::ONE);
        let falling = self.rising(span, turned, -Interval::ONE);
        for (offset, velocity) in velocities[span.first..=span.last].iter_mut().enumerate() {
            *velocity = match (&rising, &falling) {
                (Some(rising), Some(falling)) => rising[offset].hull(-falling[offset]),
                (Some(rising), None) => rising[offset],
                (None, Some(falling)) => -falling[offset],
                (None, None) => return None,
            };
        }
        Some(())
    }

    /// The velocities, all times `sign`, if they rise: none is below a mean before it, nor above a mean after it.
    fn rising(&self, span: Constant, mut velocities: Vec<Interval>, sign: Interval) -> Option<Vec<Interval>> {
        for (velocity, [least, most]) in velocities.iter_mut().zip(self.means(span, sign)) {
            *velocity = velocity.intersection(Interval::new(least.end, most.end)?)?;
        }
        for sample in 1..velocities.len() {
            velocities[sample] = velocities[sample].intersection(half_line(velocities[sample - 1].lower(), false))?;
        }
        for sample in (1..velocities.len()).rev() {
            velocities[sample - 1] =
                velocities[sample - 1].intersection(half_line(velocities[sample].upper(), true))?;
        }
        Some(velocities)
    }

    /// For every sample of such a time, at least the largest of the means that end with it, at most the least of those that begin with it.
    fn means(&self, span: Constant, sign: Interval) -> Vec<[Mean; 2]> {
        let none = |end| Mean { end, first: span.first, last: span.first };
        let mut means = vec![[none(f64::NEG_INFINITY), none(f64::INFINITY)]; span.last - span.first + 1];
        for samples in SPANS {
            for first in span.first..(span.last + 1).saturating_sub(samples) {
                let last = first + samples;
                let mean = sign * self.mean_velocity(first, last);
                let [least, _] = &mut means[last - span.first];
                if mean.lower() > least.end {
                    *least = Mean { end: mean.lower(), first, last };
                }
                let [_, most] = &mut means[first - span.first];
                if mean.upper() < most.end {
                    *most = Mean { end: mean.upper(), first, last };
                }
            }
        }
        means
    }

    /// Readings of such a time that no monotone velocity satisfies; empty where there are none.
    pub(super) fn contradiction(&self, record: usize, span: Constant) -> Vec<Contradicting> {
        let mut readings = Vec::new();
        for turned in [false, true] {
            let means = self.means(span, if turned { -Interval::ONE } else { Interval::ONE });
            let mut least = means[0][0];
            let found = means.iter().find_map(|[own, most]| {
                if own.end > least.end {
                    least = *own;
                }
                (least.end > most.end).then_some((least, *most))
            });
            let Some((fast, slow)) = found else { return Vec::new() };
            // The faster mean comes first: its end is too high, and that of the slower one too low.
            for (mean, faster) in [(fast, true), (slow, false)] {
                let share = 0.25 / (mean.last - mean.first) as f64;
                for (sample, last) in [(mean.first, false), (mean.last, true)] {
                    readings.push(Contradicting { record, sample, model_above: (faster == last) == turned, share });
                }
            }
        }
        Contradicting::normalised(readings)
    }
}

/// An end of a mean velocity's range, and the samples between which it is.
#[derive(Clone, Copy, Debug)]
struct Mean {
    end: f64,
    first: usize,
    last: usize,
}
