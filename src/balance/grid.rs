//! Points on a curve over a logarithmic range, closer where the curve moves faster.

use core::ops::RangeInclusive;

use super::BalanceError;
use crate::numeric::domain;

/// Points in a decade before refinement.
const PER_DECADE: f64 = 24.0;
/// Halvings of a gap: the edge of a domain is found to 1e-7 of its place.
const DEPTH: u32 = 20;
/// Halvings where the curve is defined on both sides.
const SMOOTH_DEPTH: u32 = 12;
/// The most points of a curve.
const POINTS: usize = 100_000;

/// The sampled quantity, for errors.
pub(super) struct Axis {
    pub(super) quantity: &'static str,
    pub(super) range: RangeInclusive<f64>,
}

impl Axis {
    /// Amplitudes of the characteristic's input.
    pub(super) fn amplitude(range: &RangeInclusive<f64>) -> Result<Self, BalanceError> {
        domain::ascending(["lowest amplitude", "highest amplitude"], range, "input units")?;
        Ok(Self { quantity: "amplitude", range: range.clone() })
    }
    /// Frequencies, rad/s.
    pub(super) fn frequency(range: &RangeInclusive<f64>) -> Result<Self, BalanceError> {
        domain::ascending(["lowest frequency", "highest frequency"], range, "rad/s")?;
        Ok(Self { quantity: "frequency", range: range.clone() })
    }

    /// Samples `curve`; halves every gap between two points that are not `close`, and every edge of its domain.
    pub(super) fn sample<V: Clone>(
        &self,
        mut curve: impl FnMut(f64) -> Option<V>,
        close: impl Fn(&V, &V) -> bool,
    ) -> Result<Vec<(f64, Option<V>)>, BalanceError> {
        let (from, to) = (*self.range.start(), *self.range.end());
        let gaps = (libm::log10(to / from) * PER_DECADE).ceil().max(1.0);
        let too_many = BalanceError::TooManyPoints { quantity: self.quantity, from, to, limit: POINTS };
        if gaps >= POINTS as f64 {
            return Err(too_many);
        }
        let mut points: Vec<(f64, Option<V>)> = vec![(from, curve(from))];
        for index in 1..=gaps as usize {
            let end = if index == gaps as usize { to } else { from * libm::pow(to / from, index as f64 / gaps) };
            // Ends of the gaps still to be checked, the nearest on top.
            let mut stack = vec![(end, curve(end), 0)];
            while let Some((x, value, depth)) = stack.pop() {
                let Some((last, before)) = points.last() else { break };
                let (gap_is_fine, limit) = match (before, &value) {
                    (Some(a), Some(b)) => (close(a, b), SMOOTH_DEPTH),
                    (None, None) => (true, 0),
                    _ => (false, DEPTH),
                };
                if gap_is_fine || depth >= limit {
                    points.push((x, value));
                    continue;
                }
                if points.len() + stack.len() >= POINTS {
                    return Err(too_many);
                }
                let middle = (last * x).sqrt();
                stack.push((x, value, depth + 1));
                stack.push((middle, curve(middle), depth + 1));
            }
        }
        Ok(points)
    }
}
