//! Why a record identifies no process.

use crate::numeric::domain::Plain;

/// Why a record identifies no process.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProcessError {
    /// The command changes too seldom.
    #[error(
        "the command changes {changes} times, at least {} needed; record two periods of a relay or of a thermostat",
        Self::LEAST_CHANGES
    )]
    FewChanges {
        /// Changes found.
        changes: usize,
    },
    /// Too few samples.
    #[error("{samples} samples, at least {} needed; log faster or longer", Self::LEAST_SAMPLES)]
    FewSamples {
        /// Samples found.
        samples: usize,
    },
    /// Readings on board that are no record.
    #[error(
        "these are no readings: at most 256 of each, times that rise, all of them finite; give the buffer of one record"
    )]
    Readings,
    /// The output does not answer the command.
    #[error(
        "no structure explains the output by the command: {} of its variation is left; check the columns (--output, --input) \
         and record a relay's oscillation", Percent(*.left)
    )]
    NoAnswer {
        /// Share of the output's variance that no structure explains.
        left: f64,
    },
}

/// A share, printed in percent.
struct Percent(f64);

impl core::fmt::Display for Percent {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{} %", Plain(libm::round(100.0 * self.0)))
    }
}

crate::numeric::codes! { pub ProcessError {
    FewChanges => "few-changes", FewSamples => "few-samples", Readings => "readings", NoAnswer => "no-answer",
} }

impl ProcessError {
    /// Fewest changes of the command: less than that is a step, which tells gain from time constant only if it settles.
    pub const LEAST_CHANGES: usize = 3;
    /// Fewest samples.
    pub const LEAST_SAMPLES: usize = 24;
}
