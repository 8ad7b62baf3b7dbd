//! What ends a subcommand early.

use std::path::PathBuf;
use std::process::ExitCode;

use super::suggestion;
use crate::describing::{CATALOGUE, CatalogueError};
use crate::error::Error;
use crate::numeric::OutOfDomain;

/// Why a subcommand could not answer.
#[derive(Debug, thiserror::Error)]
pub(super) enum CommandError {
    /// Standard output cannot be written.
    #[error("cannot write the answer: {0}; free the output or redirect it elsewhere")]
    Output(#[from] std::io::Error),
    /// What the library refuses.
    #[error("{}", in_context(.0))]
    Library(Error),
    /// The same of a number that one flag gave.
    #[error("{flag}: {error}")]
    Given {
        /// The flag.
        flag: &'static str,
        /// What the library says.
        error: Error,
    },
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
    /// A file that would be replaced by what is made from it.
    #[error("{} is one of the logs; choose another name for what is written", path.display())]
    OutputIsInput {
        /// The file.
        path: PathBuf,
    },
    /// A proof that cannot be opened.
    #[error("cannot read {}: {source}; write the proofs with `selfosc verify --certificates DIR`", path.display())]
    Certificate {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A proof that was not found.
    #[error("no certificate: {reason}")]
    Proof {
        /// Why, and the remedy.
        reason: String,
    },
    /// An id that no claim has.
    #[error("there is no claim `{id}`{}; `selfosc verify` without --claim lists them all", meant(*.nearest))]
    UnknownClaim {
        /// The id given.
        id: String,
        /// The claim that was perhaps meant.
        nearest: Option<&'static str>,
    },
    /// Numbers that contradict each other.
    #[error("{reason}")]
    Contradiction {
        /// Which ones, and the remedy.
        reason: String,
    },
    /// A model that cannot be used.
    #[error("cannot use {}: {reason}", path.display())]
    Model {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, and the remedy.
        reason: String,
    },
}

impl CommandError {
    /// All of them are input that cannot be used.
    pub(super) fn status(&self) -> ExitCode {
        ExitCode::from(2)
    }

    /// Short name for scripts.
    pub(super) fn code(&self) -> &'static str {
        match self {
            Self::Library(error) | Self::Given { error, .. } => error.code(),
            Self::Usage { .. } | Self::UnknownClaim { .. } | Self::Contradiction { .. } => "usage",
            Self::Model { .. } => "model",
            Self::Proof { .. } => "proof",
            Self::Output(_) | Self::Write { .. } | Self::OutputIsInput { .. } | Self::Certificate { .. } => "files",
        }
    }

    /// The number outside its domain, if that is the reason.
    pub(super) fn out_of_domain(&self) -> Option<&OutOfDomain> {
        match self {
            Self::Library(error) | Self::Given { error, .. } => error.out_of_domain(),
            _ => None,
        }
    }
}

impl<E: Into<Error>> From<E> for CommandError {
    fn from(error: E) -> Self {
        Self::Library(error.into())
    }
}

/// ` (did you mean ...)` where a name was probably meant.
fn meant(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!(" (did you mean `{name}`?)"))
}

/// The flag by which a quantity is given.
fn flag(quantity: &str) -> Option<&'static str> {
    Some(match quantity {
        "alpha" => "--alpha",
        "linear_drag" => "--beta",
        "quadratic_drag" => "--beta-quadratic",
        "disturbance" => "--delta",
        "delay_s" => "--delay",
        "quantum" => "--quantum",
        "noise" => "--noise",
        "rate" => "--rate",
        "duration" => "--cycles",
        "bandwidth" => "--bandwidth",
        "size of the step" => "--step",
        "amplitude" => "--amplitude",
        "bias" => "--bias",
        _ => return None,
    })
}

/// The error in the words of a subcommand: a number by its flag, a name with the one that was probably meant.
fn in_context(error: &Error) -> String {
    let given = error.out_of_domain().and_then(|fault| flag(fault.quantity));
    if let Some(flag) = given {
        return format!("{flag}: {error}");
    }
    match error {
        Error::Catalogue(CatalogueError::UnknownName { name, .. }) => {
            let nearest = suggestion::nearest(name, CATALOGUE.iter().map(|entry| entry.name));
            format!(
                "unknown characteristic `{name}`{}\n  `selfosc df --list` shows every one with its parameters",
                meant(nearest)
            )
        }
        Error::Catalogue(_) => {
            format!("{error}\n  `selfosc df --list` shows every characteristic with its parameters")
        }
        Error::Orbit(_) => format!("no limit cycle: {error}"),
        _ => error.to_string(),
    }
}
