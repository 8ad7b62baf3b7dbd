//! The log clinic: what logs of real vehicles suffer from, each named with the setting that mends it, before anything is fitted.
//!
//! Nothing is repaired in silence: a log whose values suggest another unit is refused until a setting names its unit.

use core::f64::consts::{PI, TAU};

use super::record::middle;
use super::{ExperimentError, Place};

/// Unit of the times in a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum TimeUnit {
    /// Hours.
    #[serde(rename = "h")]
    Hours,
    /// Minutes.
    #[serde(rename = "min")]
    Minutes,
    /// Seconds.
    #[serde(rename = "s")]
    Seconds,
    /// Milliseconds.
    #[serde(rename = "ms")]
    Milliseconds,
    /// Microseconds.
    #[serde(rename = "us")]
    Microseconds,
    /// Nanoseconds.
    #[serde(rename = "ns")]
    Nanoseconds,
}

impl TimeUnit {
    /// All of them, the longest first.
    pub const ALL: [Self; 6] =
        [Self::Hours, Self::Minutes, Self::Seconds, Self::Milliseconds, Self::Microseconds, Self::Nanoseconds];

    /// Name on the command line, and the end of a column's name after an underscore.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hours => "h",
            Self::Minutes => "min",
            Self::Seconds => "s",
            Self::Milliseconds => "ms",
            Self::Microseconds => "us",
            Self::Nanoseconds => "ns",
        }
    }

    /// How many of them a second has.
    #[must_use]
    pub fn per_second(self) -> f64 {
        match self {
            Self::Hours => 1.0 / 3600.0,
            Self::Minutes => 1.0 / 60.0,
            Self::Seconds => 1.0,
            Self::Milliseconds => 1e3,
            Self::Microseconds => 1e6,
            Self::Nanoseconds => 1e9,
        }
    }

    /// The unit that a column's name ends in.
    pub(super) fn of_column(name: &str) -> Option<Self> {
        let ends = |unit: &Self| name.to_lowercase().ends_with(&format!("_{}", unit.name()));
        Self::ALL.into_iter().find(ends)
    }
}

/// The longest middle interval of a record in which a relay's cycles could be seen, in s.
pub(super) const SLOWEST_S: f64 = 10.0;
/// The shortest, in s: an inertial sensor of 8 kHz is slower.
pub(super) const FASTEST_S: f64 = 1e-4;
/// Headings in radians count from -pi to pi or from 0 to 2 pi; this excess is attributed to rounding.
const HEADING_MARGIN_RAD: f64 = 0.01;
/// Distance of a command's middle from its neutral, in halves of its range, from which on another neutral is meant: 2.5 for the
/// pulses of a servo from 900 to 2100 us, its widest range.
const FAR_FROM_NEUTRAL: f64 = 2.5;

/// Refuses times that make no sense in seconds; slow ones only where no unit was given.
pub(super) fn seconds(time_s: &[f64], unit_given: bool) -> Result<(), ExperimentError> {
    let intervals = time_s.windows(2).map(|pair| pair[1] - pair[0]);
    // Repeated stamps and stamps out of order are named by the rows.
    let usable = intervals.filter(|interval| *interval > 0.0 && interval.is_finite());
    let Some(interval_s) = middle(usable.collect()) else { return Ok(()) };
    let senseless = interval_s < FASTEST_S || interval_s > SLOWEST_S && !unit_given;
    if senseless { Err(ExperimentError::TimeUnit { interval_s }) } else { Ok(()) }
}

/// Refuses headings that no angle in radians reaches.
pub(super) fn radians(column: &str, headings: &[f64]) -> Result<(), ExperimentError> {
    let (low, high) = range(headings);
    let within = |[least, most]: [f64; 2]| low >= least - HEADING_MARGIN_RAD && high <= most + HEADING_MARGIN_RAD;
    if low > high || within([-PI, PI]) || within([0.0, TAU]) {
        return Ok(());
    }
    Err(ExperimentError::Degrees { column: column.to_owned(), low, high })
}

/// The least and the largest of them.
fn range(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// Refuses an output that jumps by a turn, while its other changes are far smaller.
pub(super) fn turns(
    column: &str,
    output: &[f64],
    degrees: bool,
    place: impl Fn(usize) -> Place,
) -> Result<(), ExperimentError> {
    let mut sizes: Vec<f64> = output.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let unsorted = sizes.clone();
    let Some(most) = sizes.len().checked_sub(1 + sizes.len() / 20) else { return Ok(()) };
    let usual = *sizes.select_nth_unstable_by(most, f64::total_cmp).1;
    // The column is in radians by now; an undeclared column of degrees jumps by 360.
    let turn = if degrees { [TAU, TAU] } else { [TAU, 360.0] };
    // A jump is a turn less what the vehicle turned meanwhile.
    let is_turn =
        |jump: f64| turn.iter().any(|turn| (jump - turn).abs() <= (2.0 * usual).min(0.05 * turn) && jump > 8.0 * usual);
    match unsorted.iter().position(|jump| usual > 0.0 && is_turn(*jump)) {
        Some(before) => {
            let jump = output[before + 1] - output[before];
            Err(ExperimentError::Turns { place: place(before + 1), column: column.to_owned(), jump })
        }
        None => Ok(()),
    }
}

/// Refuses a command that stays far to one side of its neutral.
pub(super) fn neutral(column: &str, input: &[f64], neutral: f64) -> Result<(), ExperimentError> {
    let (low, high) = range(input);
    let (middle, half) = (f64::midpoint(low, high), 0.5 * (high - low));
    if half > 0.0 && middle.is_finite() && (middle - neutral).abs() >= FAR_FROM_NEUTRAL * half {
        return Err(ExperimentError::Neutral { column: column.to_owned(), low, high, middle, neutral });
    }
    Ok(())
}

/// Takes out jumps by more than half a `turn`; how many there were. Values that are not finite are left for the record to
/// refuse.
pub(super) fn unwrap(angles: &mut [f64], turn: f64) -> usize {
    let (mut turns, mut jumps) = (0.0, 0);
    let Some(mut previous) = angles.first().copied() else { return 0 };
    for angle in angles {
        let jump = *angle - previous;
        previous = *angle;
        if jump.abs() > 0.5 * turn && jump.is_finite() {
            turns -= (jump / turn).round();
            jumps += 1;
        }
        *angle += turns * turn;
    }
    jumps
}
