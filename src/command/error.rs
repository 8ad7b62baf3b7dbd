//! What ends a subcommand early.

use std::path::PathBuf;
use std::process::ExitCode;

use crate::balance::BalanceError;
use crate::control::ControlError;
use crate::describing::{CatalogueError, DescribingError};
use crate::experiment::ExperimentError;
use crate::identify::Refusal;
use crate::nonlinearity::NonlinearityError;
use crate::orbit::OrbitError;
use crate::plant::PlantError;
use crate::report::ReportError;

/// Why a subcommand could not answer.
#[derive(Debug, thiserror::Error)]
pub(super) enum CommandError {
    /// Standard output cannot be written.
    #[error("cannot write the answer: {0}; free the output or redirect it elsewhere")]
    Output(#[from] std::io::Error),
    /// A name or a setting that the catalogue does not take.
    #[error("{0}\n  `selfosc df --list` shows every characteristic with its parameters")]
    Catalogue(#[from] CatalogueError),
    /// No describing function for this input.
    #[error(transparent)]
    Describing(#[from] DescribingError),
    /// A bad amplitude or bias.
    #[error(transparent)]
    Nonlinearity(#[from] NonlinearityError),
    /// A plant that is none.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// An experiment that cannot be simulated, or a log that cannot be read.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// A loop without a limit cycle, where one is needed.
    #[error("no limit cycle: {0}")]
    Orbit(#[from] OrbitError),
    /// Harmonic balance without an answer.
    #[error(transparent)]
    Balance(#[from] BalanceError),
    /// A controller that cannot be designed.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// A log that cannot be read, or settings that no method can meet.
    #[error(transparent)]
    Identify(#[from] Refusal),
    /// A table, a figure or a report that cannot be made.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// Arguments that contradict each other.
    #[error("{reason}")]
    Usage {
        /// What contradicts what, and the remedy.
        reason: &'static str,
    },
    /// A file that cannot be written.
    #[error("cannot write {}: {source}; choose a folder that you may write to", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A proof that cannot be opened.
    #[error("cannot read {}: {source}; write the proofs with `selfosc verify --certificates DIR`", path.display())]
    Certificate {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// An id that no claim has.
    #[error("there is no claim `{id}`; the claims are: {known}")]
    UnknownClaim {
        /// The id given.
        id: String,
        /// The ids there are.
        known: String,
    },
}

impl CommandError {
    /// All of them are input that cannot be used.
    pub(super) fn status(&self) -> ExitCode {
        ExitCode::from(2)
    }
}
