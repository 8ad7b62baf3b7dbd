//! The orders behind a command of limited rate, such as a rudder angle.

use super::{FeatureError, RelayLevels};
use crate::experiment::Record;

/// Share of samples that must lie at the two extremes of a relay's command.
const AT_LEVEL: f64 = 0.95;
/// The same where it goes between them at a limited rate.
const AT_LEVEL_MOVING: f64 = 0.5;
/// How near to an extreme counts as there, and to the line between them as on it, against the range.
pub(super) const NEAR_LEVEL: f64 = 0.02;
/// Part of the way that is rounding.
const ROUNDING: f64 = 1e-6;
/// How far a rate may be from the mean, against it.
pub(super) const SAME_RATE: f64 = 0.25;

/// Orders of a relay, and how they are carried out.
pub(super) struct Orders {
    pub(super) relay: RelayLevels,
    /// The order at every sample.
    pub(super) input: Vec<f64>,
    /// Mean time from level to level in s; zero where the command is the order.
    pub(super) ramp_s: f64,
}

/// A passage of the command between its two levels.
pub(super) struct LevelPassage<'a> {
    /// Samples between the levels.
    pub(super) time_s: &'a [f64],
    pub(super) input: &'a [f64],
}

/// The straight line of a passage.
pub(super) struct Line {
    /// Magnitude of its rate, in units of the command per s.
    pub(super) rate: f64,
    /// When it leaves its level.
    begin_s: f64,
}

impl LevelPassage<'_> {
    /// The line through it from a level; `None` if a sample is farther than `near` from it.
    #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
    pub(super) fn line(&self, level: f64, near: f64) -> Option<Line> {
        let count = self.time_s.len() as f64;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
        let (middle_s, middle) = (mean(self.time_s), mean(self.input));
        let pairs = || self.time_s.iter().zip(self.input).map(|(t, u)| (t - middle_s, u - middle));
        let rate = pairs().map(|(t, u)| t * u).sum::<f64>() / pairs().map(|(t, _)| t * t).sum::<f64>();
        let line = Line { rate: rate.abs(), begin_s: middle_s + (level - middle) / rate };
        pairs().all(|(t, u)| (u - rate * t).abs() <= near).then_some(line)
    }
}

impl Orders {
    /// The orders of a two-valued command, or of a command that passes between two values at a constant rate.
    ///
    /// # Errors
    /// [`FeatureError::ConstantInput`], [`FeatureError::NotARelay`].
    pub(super) fn of(record: &Record) -> Result<Self, FeatureError> {
        let input = record.input();
        let low = input.iter().copied().fold(f64::INFINITY, f64::min);
        let high = input.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if low >= high {
            return Err(FeatureError::ConstantInput { value: low });
        }
        let relay = RelayLevels { level: (high - low) / 2.0, offset: f64::midpoint(low, high) };
        let near = NEAR_LEVEL * (high - low);
        let at = |value: f64| match value {
            value if value <= low + near => Some(false),
            value if value >= high - near => Some(true),
            _ => None,
        };
        let levels: Vec<Option<bool>> = input.iter().map(|value| at(*value)).collect();
        #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
        let share = levels.iter().flatten().count() as f64 / input.len() as f64;
        if share >= AT_LEVEL {
            return Ok(Self { relay, input: input.to_vec(), ramp_s: 0.0 });
        }
        let moving = if share >= AT_LEVEL_MOVING { moved(record, &levels, (low, high)) } else { None };
        let Some((rate, ordered)) = moving else {
            return Err(FeatureError::NotARelay { percent: 100.0 * share, required: 100.0 * AT_LEVEL });
        };
        let input = ordered.into_iter().map(|positive| if positive { high } else { low }).collect();
        Ok(Self { relay, input, ramp_s: (high - low) / rate })
    }
}

/// The mean rate, and the level that every sample is at or on its way to; `None` where it is not on its way to any, or the
/// rates are not one.
fn moved(record: &Record, levels: &[Option<bool>], (low, high): (f64, f64)) -> Option<(f64, Vec<bool>)> {
    let mut ordered: Vec<bool> = Vec::with_capacity(levels.len());
    let mut rates = Vec::new();
    for run in levels.chunk_by(|one, next| one == next) {
        let (begin, end) = (ordered.len(), ordered.len() + run.len());
        let level = match run[0] {
            Some(positive) => positive,
            None => {
                let before = begin.checked_sub(1).and_then(|last| levels[last]);
                let next = levels.get(end).copied().flatten();
                if before.is_some() && before == next {
                    return None;
                }
                if let Some(before) = before.filter(|_| run.len() > 1) {
                    let passage =
                        LevelPassage { time_s: &record.time_s()[begin..end], input: &record.input()[begin..end] };
                    let line = passage.line(if before { high } else { low }, NEAR_LEVEL * (high - low));
                    if next.is_some() {
                        rates.push(line.as_ref()?.rate);
                    }
                    // The first of it look as if they were at the level still. At the record's end it may come to rest anywhere.
                    let begin_s = line.map_or(f64::INFINITY, |line| line.begin_s - ROUNDING * (high - low) / line.rate);
                    let early = record.time_s()[..begin].iter().rev().take_while(|time| **time >= begin_s).count();
                    ordered[begin - early..].fill(!before);
                }
                next.or_else(|| before.map(|before| !before))?
            }
        };
        ordered.resize(end, level);
    }
    #[allow(clippy::cast_precision_loss, reason = "a count of passages")]
    let mean = rates.iter().sum::<f64>() / rates.len() as f64;
    let alike = rates.iter().all(|rate| (rate - mean).abs() <= SAME_RATE * mean);
    (alike && !rates.is_empty()).then_some((mean, ordered))
}
