//! What can be wrong with a record, a log or a simulated experiment.

use core::fmt;

use super::clinic::{FASTEST_S, SLOWEST_S};
use super::{Columns, Record};
use crate::nonlinearity::NonlinearityError;
use crate::numeric::OutOfDomain;
use crate::numeric::domain::{About, AtLeast, AtMost, Plain};

/// Where in a record something is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Number of the sample, from zero.
    Sample(usize),
    /// Line of the file, from one.
    Line(u64),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sample(sample) => write!(f, "sample {sample}"),
            Self::Line(line) => write!(f, "line {line}"),
        }
    }
}

/// Why there is no record. [`code`](Self::code) is the name that scripts see.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// The three columns do not belong together.
    #[error("{time} times, {output} outputs and {input} inputs must be as many; give one of each for every sample")]
    Lengths {
        /// Number of times.
        time: usize,
        /// Number of outputs.
        output: usize,
        /// Number of inputs.
        input: usize,
    },
    /// Too few samples for any identification.
    #[error(
        "{samples} samples, at least {} needed; cut less off (--from, --to), name a part that the log has (--part), or log longer or faster",
        Record::FEWEST_SAMPLES
    )]
    TooShort {
        /// Samples found.
        samples: usize,
    },
    /// NaN or an infinity.
    #[error("{place}: {column} = {value} must be finite; log a number there, or leave such rows out (--skip-bad-rows)")]
    NotFinite {
        /// Where.
        place: Place,
        /// Which of time, output and input.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// A number whose square leaves the arithmetic.
    #[error(
        "{place}: {column} = {value:e} must be at most {:e} in magnitude; log another unit, or leave such rows out \
         (--skip-bad-rows)",
        Record::LARGEST
    )]
    TooLarge {
        /// Where.
        place: Place,
        /// Which of time, output and input.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// A time that does not come after the one before it.
    #[error(
        "{place}: time {} s must come after {} s; log times in order and with more digits, leave such rows out \
         (--skip-bad-rows), or say that samples are evenly spaced (--even-stamps)",
        Plain(*.time_s), Plain(*.previous_s)
    )]
    TimeOrder {
        /// Where.
        place: Place,
        /// Time there, in s.
        time_s: f64,
        /// Time before it, in s.
        previous_s: f64,
    },
    /// Samples are missing: the input in between is not known.
    #[error(
        "{place}: no sample for {} s, at most {} s allowed; use the part before or after (--from, --to)",
        AtLeast(*.gap_s), AtMost(*.limit_s)
    )]
    Gap {
        /// Where the gap ends.
        place: Place,
        /// Its duration, in s.
        gap_s: f64,
        /// The longest interval allowed, in s.
        limit_s: f64,
    },
    /// Samples in bursts, with most of the time between them.
    #[error(
        "samples come in bursts: {count} gaps of {} s on average, the others {} s apart: such stamps are those of arrival; log \
         the time of each reading, or say that samples are evenly spaced (--even-stamps)",
        About(*.gap_s), About(*.interval_s)
    )]
    Bursts {
        /// Gaps.
        count: usize,
        /// Their mean duration, in s.
        gap_s: f64,
        /// The middle interval, in s.
        interval_s: f64,
    },
    /// A clock that starts again.
    #[error(
        "{place}: the clock falls from {} s to {} s, so the log has {parts} parts; choose one by its number (--part 1)",
        Plain(*.previous_s), Plain(*.time_s)
    )]
    Restart {
        /// Where.
        place: Place,
        /// Time there, in s.
        time_s: f64,
        /// Time before it, in s.
        previous_s: f64,
        /// Parts of the log.
        parts: usize,
    },
    /// More rows that cannot be used than may be left out.
    #[error(
        "{bad} of {rows} rows cannot be used, at most {} % may be left out (--skip-bad-rows); use a part with fewer (--from, \
         --to), or log again", 100.0 * Columns::MOST_SKIPPED
    )]
    TooManyBad {
        /// Rows that cannot be used.
        bad: usize,
        /// Rows inside of the cut.
        rows: usize,
    },
    /// A row with more or fewer cells than names.
    #[error(
        "line {line}: {cells} cells under {columns} names; mend the line, or leave such rows out (--skip-bad-rows)"
    )]
    Ragged {
        /// Line of the file.
        line: u64,
        /// Cells there.
        cells: usize,
        /// Names in the header.
        columns: usize,
    },
    /// Nothing to read.
    #[error("the log is empty; it needs a header line with column names and one line for each sample")]
    Empty,
    /// Not text.
    #[error("line {line}: not text (character {character:#04x}); export the log as delimiter-separated text")]
    Binary {
        /// Line of the file.
        line: u64,
        /// The character found.
        character: u32,
    },
    /// A column that is not there.
    #[error("no {role} column: none is named {wanted} among {found}; name one of these (--{role} COL)")]
    UnknownColumn {
        /// What it is wanted for: time, output or input.
        role: &'static str,
        /// The name, or the names tried.
        wanted: String,
        /// The names in the header.
        found: String,
    },
    /// A log that begins with numbers.
    #[error(
        "the log begins with numbers ({first}); put a line with the columns' names before them, such as time_s,heading_deg,command"
    )]
    NoHeader {
        /// The first row.
        first: String,
    },
    /// Two columns of one name.
    #[error(
        "column {name} is there {count} times: name the one to read by its number (--{role} {name}#1), or rename them"
    )]
    DuplicateColumn {
        /// What it is wanted for: time, output or input.
        role: &'static str,
        /// The name.
        name: String,
        /// How often it is there.
        count: usize,
    },
    /// A column is named for two quantities.
    #[error("column {name} is read as {} and as {}; name another for one of them (--{} COL, --{} COL)", roles[0], roles[1], roles[0], roles[1])]
    SameColumn {
        /// Its name.
        name: String,
        /// What it is read as: time, output or input.
        roles: [&'static str; 2],
    },
    /// Times that make no sense in seconds.
    #[error(
        "samples are {} s apart in the middle, and must be from {} to {} s: say the unit of the log's times, h, min, s, ms, us or ns \
         (--time-unit)", About(*.interval_s), Plain(FASTEST_S), Plain(SLOWEST_S)
    )]
    TimeUnit {
        /// The middle interval, in s.
        interval_s: f64,
    },
    /// A heading that no angle in radians reaches.
    #[error(
        "{column} goes from {} to {}, a heading in radians from -pi to pi or from 0 to 2 pi: say that it is in degrees \
         (--degrees), or in radians all the same (--radians)",
        About(*.low), About(*.high)
    )]
    Degrees {
        /// Name of the column.
        column: String,
        /// The least value.
        low: f64,
        /// The largest value.
        high: f64,
    },
    /// An output that jumps by a turn.
    #[error(
        "{place}: {column} jumps by {}, a turn: say that it is an angle (--wrap, with --degrees if it is in degrees)",
        About(*.jump)
    )]
    Turns {
        /// Where.
        place: Place,
        /// Name of the column.
        column: String,
        /// The jump.
        jump: f64,
    },
    /// A command far to one side of its neutral.
    #[error(
        "{column} lies between {} and {}, far from a neutral of {}: say which command is neutral (--neutral {}), or that zero \
         is (--neutral 0)", Plain(*.low), Plain(*.high), Plain(*.neutral), Plain(*.middle)
    )]
    Neutral {
        /// Name of the column.
        column: String,
        /// The least command.
        low: f64,
        /// The largest command.
        high: f64,
        /// Their middle.
        middle: f64,
        /// Neutral command, zero unless given.
        neutral: f64,
    },
    /// A cell without a number.
    #[error(
        "line {line}, column {column}: the cell is blank; fill it in, leave such rows out (--skip-bad-rows), or, where rows hold output and \
         command in turn, let the command hold (--hold-command)"
    )]
    Blank {
        /// Line of the file.
        line: u64,
        /// Name of the column.
        column: String,
    },
    /// A cell that is not a number.
    #[error(
        "line {line}, column {column}: {text:?} is not a number; correct the cell, or leave such rows out (--skip-bad-rows)"
    )]
    NotANumber {
        /// Line of the file.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there, cut to a readable length.
        text: String,
    },
    /// More than is read.
    #[error("longer than {} MiB; cut the log to the experiment, or thin it out", Columns::LONGEST >> 20)]
    TooLong,
    /// The reader failed.
    #[error("line {line}: {reason}; make every line as the header says")]
    Unreadable {
        /// Line of the file; zero before the first.
        line: u64,
        /// Message of the reader.
        reason: String,
    },
    /// A setting of a simulated experiment outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// The relay of a simulated experiment is not one.
    #[error(transparent)]
    Relay(#[from] NonlinearityError),
}

crate::numeric::codes! { pub ExperimentError {
    Lengths => "unequal-columns", TooShort => "too-short", NotFinite => "not-finite", TooLarge => "too-large",
    TimeOrder => "time-order", Gap => "gap", Bursts => "bursts", Restart => "clock-restarts",
    TooManyBad => "too-many-bad-rows", Ragged => "ragged-row", SameColumn => "same-column", Empty => "empty",
    Binary => "not-text", UnknownColumn => "unknown-column", NoHeader => "no-header",
    DuplicateColumn => "duplicate-column", TimeUnit => "time-unit", Degrees => "degrees", Turns => "turns",
    Neutral => "neutral", Blank => "blank-cell", NotANumber => "not-a-number", TooLong => "too-long",
    Unreadable => "unreadable", OutOfDomain.0 => "setting", Relay.0 => "relay",
} }

impl ExperimentError {
    /// Whether the text or its columns could not be read, rather than the record in it be used.
    #[must_use]
    pub fn is_unreadable(&self) -> bool {
        matches!(
            self,
            Self::Empty
                | Self::Binary { .. }
                | Self::UnknownColumn { .. }
                | Self::NoHeader { .. }
                | Self::SameColumn { .. }
                | Self::TooLong
                | Self::Unreadable { .. }
        )
    }
}
