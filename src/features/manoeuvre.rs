//! Whether a record is of a relay experiment: two cycles of a command that is held, and an output that follows it.

use serde::{Deserialize, Serialize};

use super::orders::{LevelPassage, NEAR_LEVEL, SAME_RATE};
use crate::experiment::Record;

/// The fewest changes of side of two full cycles.
const FEWEST_SWITCHINGS: usize = 4;
/// The command has changed side beyond this part of its range from the middle: a level below a fifth of the strongest counts as none.
const BEYOND_MIDDLE: f64 = 0.1;
/// Share of the samples that make a value a level. A ramp has 2 [`NEAR_LEVEL`] of them near any value.
const A_LEVEL: f64 = 0.05;
/// Share of the samples at a level, or on the way between levels. A sinusoid has 0.4, a saturated one 0.8.
const HELD: f64 = 0.9;
/// Share of the time in half-periods at whose end the output moves with the command. Chance has a half.
const FOLLOWED: f64 = 0.75;
/// Part of a half-period, and the fewest samples, that show which way the output moves at its end.
const END: usize = 4;
const FEWEST_SAMPLES: usize = 3;

/// Why a record is not of a relay experiment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum NotAnExperiment {
    /// Fewer than two full cycles.
    #[error(
        "the command changes side {switchings} times, and must at least {FEWEST_SWITCHINGS} times for two full cycles: it looks \
         like {}; log for at least three periods (--from, --to)",
        if *.switchings < 2 { "a single step" } else { "a part of an experiment" }
    )]
    FewCycles {
        /// Changes of side.
        switchings: usize,
    },
    /// The command is neither held nor on its way at the one rate of a rudder.
    #[error(
        "only {percent:.0} % of the command are at a level or on the way between levels at one rate, and must be at least {:.0} %: \
         it looks like the command of a controller or of a joystick; let a relay command the vehicle (`selfosc run`), or choose its column (--input COL)",
        100.0 * HELD
    )]
    NotHeld {
        /// Share of the samples, in percent.
        percent: f64,
    },
    /// The output does not move with the command.
    #[error(
        "the output moves with the command at the end of {percent:.0} % of the half-periods, and must in at least {:.0} %: it looks \
         like another output, an angle with jumps (--wrap), or a vehicle that is held; choose the column (--output COL)",
        100.0 * FOLLOWED
    )]
    NotFollowed {
        /// Share of the time, in percent.
        percent: f64,
    },
}

crate::numeric::codes! { pub NotAnExperiment {
    FewCycles => "few-cycles", NotHeld => "not-held", NotFollowed => "not-followed",
} }

impl NotAnExperiment {
    /// What is missing in a record; `None` for a record of a relay experiment. An output that moves against the command throughout
    /// follows it: its sign is another question.
    ///
    /// ```
    /// use selfosc::{experiment::Record, features::NotAnExperiment};
    /// let time_s: Vec<f64> = (0..200).map(|k| 0.1 * f64::from(k)).collect();
    /// let step = time_s.iter().map(|t| if *t < 5.0 { 0.0 } else { 1.0 }).collect();
    /// let answer = time_s.iter().map(|t| (t - 5.0).max(0.0)).collect();
    /// let found = NotAnExperiment::find(&Record::new(time_s, answer, step)?);
    /// assert_eq!(found, Some(NotAnExperiment::FewCycles { switchings: 1 }));
    /// # Ok::<(), selfosc::experiment::ExperimentError>(())
    /// ```
    #[must_use]
    pub fn find(record: &Record) -> Option<Self> {
        let command = record.input();
        let low = command.iter().copied().fold(f64::INFINITY, f64::min);
        let high = command.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sides = sides(command, f64::midpoint(low, high), BEYOND_MIDDLE * (high - low));
        let half_periods = sides.chunk_by(|one, next| one == next).count();
        if half_periods <= FEWEST_SWITCHINGS {
            return Some(Self::FewCycles { switchings: half_periods.saturating_sub(1) });
        }
        let held = held(record, NEAR_LEVEL * (high - low));
        if held < HELD {
            return Some(Self::NotHeld { percent: 100.0 * held });
        }
        let followed = followed(record, &sides);
        (followed.max(1.0 - followed) < FOLLOWED).then_some(Self::NotFollowed { percent: 100.0 * followed })
    }
}

/// Whether the command is above the middle, or was when it last was `beyond` from it.
fn sides(command: &[f64], middle: f64, beyond: f64) -> Vec<bool> {
    let far = |value: &f64| ((value - middle).abs() > beyond).then_some(*value > middle);
    let first = command.iter().find_map(far).unwrap_or(true);
    let mut side = first;
    command
        .iter()
        .map(|value| {
            side = far(value).unwrap_or(side);
            side
        })
        .collect()
}

/// Share of the samples at a level, or between levels on a straight line with the rate of the others.
#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn held(record: &Record, near: f64) -> f64 {
    let (time_s, input) = (record.time_s(), record.input());
    let levels = levels(input, near);
    let at_level = |value: f64| levels.iter().any(|level| (value - level).abs() <= near);
    let held: Vec<bool> = input.iter().map(|value| at_level(*value)).collect();
    // Samples and rate of each passage.
    let mut passages: Vec<(usize, Option<f64>)> = Vec::new();
    let mut begin = 0;
    for run in held.chunk_by(|one, next| one == next) {
        let end = begin + run.len();
        if !run[0] {
            let passage = LevelPassage { time_s: &time_s[begin..end], input: &input[begin..end] };
            passages.push((
                run.len(),
                if run.len() > 1 { passage.line(input[begin], near).map(|line| line.rate) } else { None },
            ));
        }
        begin = end;
    }
    let mut rates: Vec<f64> = passages.iter().filter_map(|passage| passage.1).collect();
    rates.sort_by(f64::total_cmp);
    let usual = rates.get(rates.len() / 2).copied().unwrap_or(0.0);
    // A single sample on the way has no rate of its own.
    let straight = |(samples, rate): &(usize, Option<f64>)| {
        *samples == 1 || rate.is_some_and(|rate| (rate - usual).abs() <= SAME_RATE * usual)
    };
    let on_the_way: usize = passages.iter().filter(|passage| straight(passage)).map(|passage| passage.0).sum();
    (held.iter().filter(|held| **held).count() + on_the_way) as f64 / input.len() as f64
}

/// The values that many samples are near, the most frequent first.
#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn levels(input: &[f64], near: f64) -> Vec<f64> {
    let mut sorted = input.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut levels = Vec::new();
    loop {
        let within = |value: f64| {
            let from = sorted.partition_point(|other| *other < value - near);
            (from, sorted.partition_point(|other| *other <= value + near))
        };
        let count = |(from, to): (usize, usize)| to - from;
        let Some((level, range)) =
            sorted.iter().map(|value| (*value, within(*value))).max_by_key(|(_, range)| count(*range))
        else {
            break;
        };
        if (count(range) as f64) < A_LEVEL * input.len() as f64 {
            break;
        }
        levels.push(level);
        sorted.drain(range.0..range.1);
    }
    levels
}

/// Share of the time in half-periods at whose end the output moves with the command.
#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn followed(record: &Record, sides: &[bool]) -> f64 {
    let (mut begin, mut followed) = (0, 0);
    for half_period in sides.chunk_by(|one, next| one == next) {
        let end = begin + half_period.len();
        let from = end.saturating_sub((half_period.len() / END).max(FEWEST_SAMPLES));
        if rising(&record.time_s()[from..end], &record.output()[from..end]) == half_period[0] {
            followed += half_period.len();
        }
        begin = end;
    }
    followed as f64 / sides.len() as f64
}

/// Whether the line of least squares rises.
#[allow(clippy::cast_precision_loss, reason = "a count of samples")]
fn rising(time_s: &[f64], output: &[f64]) -> bool {
    let middle_s = time_s.iter().sum::<f64>() / time_s.len() as f64;
    time_s.iter().zip(output).map(|(t, y)| (t - middle_s) * (y - output[0])).sum::<f64>() > 0.0
}
