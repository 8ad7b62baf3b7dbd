//! Reasons for which a certificate is refused, or not written.

/// Why a certificate is not accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unproved {
    /// It is no certificate.
    #[error(
        "not a certificate of guaranteed bounds: {text}; write one with `selfosc identify LOG --method bounded --certificate FILE`"
    )]
    Foreign {
        /// What is wrong.
        text: String,
    },
    /// A file of another program.
    #[error("format {found}, where this program reads format {expected}; write it anew with `identify --certificate`")]
    Format {
        /// Its own.
        found: u32,
        /// This program's.
        expected: u32,
    },
    /// Its parts do not make up a problem and a proof.
    #[error("{text}")]
    Malformed {
        /// What is wrong.
        text: String,
    },
    /// A range does not follow from the records and the model.
    #[error("the {what} is not the one that the file's records and its model lead to")]
    Ranges {
        /// Of what.
        what: &'static str,
    },
    /// Other logs.
    #[error("{found} logs, where the file has {expected}; give the logs in the order in which they were identified")]
    Logs {
        /// Logs given.
        found: usize,
        /// Records in the file.
        expected: usize,
    },
    /// A row is not the log's.
    #[error("row {row} of log {log}: the {what} is {found} in the log and {expected} in the file")]
    Row {
        /// Number of the log, from 1.
        log: usize,
        /// Number of the row among those used, from 1.
        row: usize,
        /// Stamp, reading or command.
        what: &'static str,
        /// In the log, or that it has no such row.
        found: String,
        /// In the file.
        expected: String,
    },
    /// The witness omits readings.
    #[error("the witness begins at row {first} of record {record}, and has to meet every reading from row {most} on")]
    Late {
        /// Number of the record, from 1.
        record: usize,
        /// Its first row, from 1.
        first: usize,
        /// The last with which it may begin.
        most: usize,
    },
    /// A step's statement does not follow.
    #[error("step {step} of stage {stage}: {what}")]
    Step {
        /// Number of the stage.
        stage: usize,
        /// Number of the step.
        step: usize,
        /// The statement.
        what: &'static str,
    },
    /// Boxes without a step, or steps without a box.
    #[error("the steps of stage {stage} do not deal with the whole box")]
    Incomplete {
        /// Its number.
        stage: usize,
    },
    /// The witness does not meet a reading.
    #[error("the witness misses a reading by {misfit:.4} times its largest error")]
    Witness {
        /// The largest misfit over its largest error, at most.
        misfit: f64,
    },
    /// The statement is not shown by the steps.
    #[error("the statement is not what the steps show: {expected}")]
    Statement {
        /// What they show.
        expected: String,
    },
    /// Readings may be in error by any amount, which no certificate covers.
    #[error("no proof is written where {allowed} readings may be in error by any amount; leave them out of the log")]
    Outliers {
        /// So many.
        allowed: usize,
    },
    /// None was found within the budget.
    #[error("no proof was found within {steps} steps; the bounds printed do not depend on one")]
    NotFound {
        /// At most.
        steps: usize,
    },
}

crate::numeric::codes! { pub Unproved {
    Foreign => "foreign", Format => "format", Malformed => "malformed", Ranges => "ranges", Logs => "log",
    Row => "log", Late => "late", Step => "step", Incomplete => "incomplete", Witness => "witness",
    Statement => "statement", Outliers => "outliers", NotFound => "not-found",
} }

pub(super) fn malformed(text: &str) -> Unproved {
    Unproved::Malformed { text: text.to_owned() }
}
