//! What can be wrong with a record, a log or a simulated experiment.

use core::fmt;

use crate::nonlinearity::NonlinearityError;
use crate::numeric::OutOfDomain;

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
    #[error("{samples} samples, at least {required} needed; log longer or faster")]
    TooShort {
        /// Samples found.
        samples: usize,
        /// Samples needed.
        required: usize,
    },
    /// NaN or an infinity.
    #[error("{place}: {column} = {value} must be finite; remove the line or log a number there")]
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
        "{place}: {column} = {value:e} must be at most {limit:e} in magnitude; remove the line or log another unit"
    )]
    TooLarge {
        /// Where.
        place: Place,
        /// Which of time, output and input.
        column: &'static str,
        /// The value.
        value: f64,
        /// The largest magnitude allowed.
        limit: f64,
    },
    /// A time that does not come after the one before it.
    #[error(
        "{place}: time {time_s} s must come after {previous_s} s; sort the log by time, remove repeated samples, or log \
         times with more digits"
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
        "{place}: no sample for {gap_s} s, at most {limit_s} s allowed; use the part before or after (--from, --to)"
    )]
    Gap {
        /// Where the gap ends.
        place: Place,
        /// Its duration, in s.
        gap_s: f64,
        /// The longest interval allowed, in s.
        limit_s: f64,
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
    #[error("no column {wanted} among {found}; name one of these")]
    UnknownColumn {
        /// The name, or the names tried.
        wanted: String,
        /// The names in the header.
        found: String,
    },
    /// Two columns of one name.
    #[error(
        "column {name} is there {count} times: name the one to read by its number, {name}#1 or another; or rename them"
    )]
    DuplicateColumn {
        /// The name.
        name: String,
        /// How often it is there.
        count: usize,
    },
    /// Times that make no sense in seconds.
    #[error(
        "samples are {interval_s} s apart in the middle, if times are in seconds: say the unit of the log, s, ms, us or ns \
         (--time-unit)"
    )]
    TimeUnit {
        /// The middle interval, in s.
        interval_s: f64,
    },
    /// A heading that no angle in radians reaches.
    #[error(
        "{place}: {column} = {value} is no heading in radians: say that it is in degrees (--degrees), or that it is in radians \
         all the same (--radians)"
    )]
    Degrees {
        /// Where.
        place: Place,
        /// Name of the column.
        column: String,
        /// The value.
        value: f64,
    },
    /// An output that jumps by a turn.
    #[error(
        "{place}: {column} jumps by {jump}, a turn: say that it is an angle (--wrap, with --degrees if it is in degrees)"
    )]
    Turns {
        /// Where.
        place: Place,
        /// Name of the column.
        column: String,
        /// The jump.
        jump: f64,
    },
    /// A command whose neutral is not zero.
    #[error(
        "{column} lies between {low} and {high} and never changes its sign: say which command is neutral (--neutral {middle}), \
         or that zero is (--neutral 0)"
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
    },
    /// A cell without a number.
    #[error("line {line}, column {column}: the cell is blank; fill it in or remove the line")]
    Blank {
        /// Line of the file.
        line: u64,
        /// Name of the column.
        column: String,
    },
    /// A cell that is not a number.
    #[error("line {line}, column {column}: {text:?} is not a number; correct the cell or remove the line")]
    NotANumber {
        /// Line of the file.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there, cut to a readable length.
        text: String,
    },
    /// More than is read.
    #[error("longer than {limit_mib} MiB; cut the log to the experiment, or thin it out")]
    TooLong {
        /// What is read at most, MiB.
        limit_mib: u64,
    },
    /// The reader failed.
    #[error("line {line}: {reason}; make every line as the header says")]
    Unreadable {
        /// Line of the file; zero before the first.
        line: u64,
        /// What the reader says.
        reason: String,
    },
    /// A setting of a simulated experiment outside its domain.
    #[error(transparent)]
    OutOfDomain(#[from] OutOfDomain),
    /// The relay of a simulated experiment is not one.
    #[error(transparent)]
    Relay(#[from] NonlinearityError),
}

impl ExperimentError {
    /// Short name for scripts; it does not change with the wording of the message.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Lengths { .. } => "unequal-columns",
            Self::TooShort { .. } => "too-short",
            Self::NotFinite { .. } => "not-finite",
            Self::TooLarge { .. } => "too-large",
            Self::TimeOrder { .. } => "time-order",
            Self::Gap { .. } => "gap",
            Self::Empty => "empty",
            Self::Binary { .. } => "not-text",
            Self::UnknownColumn { .. } => "unknown-column",
            Self::DuplicateColumn { .. } => "duplicate-column",
            Self::TimeUnit { .. } => "time-unit",
            Self::Degrees { .. } => "degrees",
            Self::Turns { .. } => "turns",
            Self::Neutral { .. } => "neutral",
            Self::Blank { .. } => "blank-cell",
            Self::NotANumber { .. } => "not-a-number",
            Self::TooLong { .. } => "too-long",
            Self::Unreadable { .. } => "unreadable",
            Self::OutOfDomain(_) => "setting",
            Self::Relay(_) => "relay",
        }
    }

    /// Whether the text itself could not be read, rather than the record in it be used.
    #[must_use]
    pub fn is_unreadable(&self) -> bool {
        matches!(
            self,
            Self::Empty
                | Self::Binary { .. }
                | Self::UnknownColumn { .. }
                | Self::Blank { .. }
                | Self::NotANumber { .. }
                | Self::TooLong { .. }
                | Self::Unreadable { .. }
        )
    }

    /// The number outside its domain, if that is the reason.
    #[must_use]
    pub fn out_of_domain(&self) -> Option<&OutOfDomain> {
        match self {
            Self::OutOfDomain(fault) => Some(fault),
            Self::Relay(error) => error.out_of_domain(),
            _ => None,
        }
    }
}
