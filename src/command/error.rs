//! Errors that end a subcommand.

use std::path::PathBuf;

use super::suggestion;
use crate::describing::{CATALOGUE, CatalogueError};
use crate::error::Error;
use crate::orbit::OrbitError;

/// Why a subcommand could not answer.
#[derive(Debug, thiserror::Error)]
pub(super) enum CommandError {
    /// Standard output cannot be written.
    #[error("cannot write the answer: {0}; free the output or redirect it elsewhere")]
    Output(#[from] std::io::Error),
    /// A refusal of the library.
    #[error("{}", in_context(.0))]
    Library(Error),
    /// A refusal of a number given by a flag.
    #[error("{flag}: {}", words(.error))]
    Given { flag: &'static str, error: Error },
    /// Arguments that contradict each other.
    #[error("{reason}")]
    Usage { reason: String },
    /// A file that is no proof.
    #[error("{} is no certificate: {reason}; write one with `--certificate` of `selfosc identify` or `selfosc predict`, or `selfosc verify --certificates`", path.display())]
    NoCertificate { path: PathBuf, reason: String },
    /// A proof that was not found.
    #[error("no certificate: {reason}")]
    Proof { reason: String },
    /// An id that no claim has.
    #[error("there is no claim `{id}`{}; `selfosc verify` without --claim lists them all", meant(*.nearest))]
    UnknownClaim { id: String, nearest: Option<&'static str> },
    /// A model that cannot be used.
    #[error("{flag}: cannot use {}: {reason}", path.display())]
    Model { flag: &'static str, path: PathBuf, reason: String },
}

crate::numeric::codes! { pub(super) CommandError {
    Library.0, Given.error, Usage => "usage", UnknownClaim => "usage", Model => "model", Proof => "proof",
    NoCertificate => "proof", Output => "files",
} }

impl<E: Into<Error>> From<E> for CommandError {
    fn from(error: E) -> Self {
        Self::Library(error.into())
    }
}

/// A result of a flag's value: an error names the flag.
pub(super) trait Given<T> {
    fn given(self, flag: &'static str) -> Result<T, CommandError>;
}

impl<T, E: Into<Error>> Given<T> for Result<T, E> {
    fn given(self, flag: &'static str) -> Result<T, CommandError> {
        self.map_err(|error| CommandError::Given { flag, error: error.into() })
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
        "delay_s" | "delay" | "longest delay" => "--delay",
        "upper level" | "lower level" => "--relay",
        "reference" => "--reference",
        "shortest period" | "longest period" => "--periods",
        "relay level" => "--relay",
        "half-width" => "--half-width",
        "quantum" | "step of the sensor" => "--quantum",
        "largest error of a reading" => "--error",
        "largest error of a stamp" => "--jitter",
        "size of a source of error" => "--assume",
        "noise" => "--noise",
        "rate" | "sampling rate" | "number of samples" => "--rate",
        "cycles" => "--cycles",
        "bandwidth" => "--bandwidth",
        "size of the step" => "--step",
        "top speed" => "--top-speed",
        "amplitude" => "--amplitude",
        "bias" => "--bias",
        "gain" => "--gain",
        "largest relay level" => "--level",
        "time limit" => "--time",
        "largest amplitude" => "--largest-amplitude",
        _ => return None,
    })
}

/// The flags that change the quantity of an error without a number.
fn flags(error: &Error) -> Option<&'static str> {
    Some(match (error, error.code()) {
        (Error::Orbit(_), "no-drag") => "--beta, --beta-quadratic",
        (Error::Orbit(_), "no-hysteresis") => "--half-width, --delay",
        (Error::Orbit(_), "drifts-away") => "--relay, --delta",
        (Error::Orbit(OrbitError::Plant(_)), _) | (Error::Orbit(_), "crowded-poles") => "--num, --den",
        (Error::Orbit(_), _) => "--alpha, --beta, --half-width",
        (Error::Plant(_), _) => "--num, --den",
        (Error::Balance(_), _) => "--num, --den, --delay",
        (Error::Describing(_) | Error::Nonlinearity(_), _) => "--amplitude, --bias, --set",
        (Error::Control(_), "overdamped") => "--bandwidth",
        (Error::Control(_), "too-fast") => "--bandwidth, --delay",
        (Error::Control(_), "no-bandwidth") => "--delay",
        (Error::Identification(_), "condition-40") => "--half-width, --delay",
        _ => return None,
    })
}

/// The error in the words of a subcommand: a number by its flag, a name with the nearest known name.
pub(super) fn in_context(error: &Error) -> String {
    match error.out_of_domain().and_then(|fault| flag(fault.quantity)) {
        Some(flag) => format!("{flag}: {error}"),
        None => words(error),
    }
}

fn words(error: &Error) -> String {
    let said = error.to_string();
    match error {
        Error::Catalogue(CatalogueError::UnknownName { name, .. }) => {
            let nearest = suggestion::nearest(name, CATALOGUE.iter().map(|entry| entry.name));
            let known = "`selfosc df --list` shows every one with its parameters; give one of these";
            format!("unknown characteristic `{name}`{}\n  {known}", meant(nearest))
        }
        Error::Catalogue(_) => format!("{said}\n  `selfosc df --list` shows every characteristic with its parameters"),
        // Of a record that is simulated, not read.
        Error::Experiment(_) if error.out_of_domain().is_none() => {
            let fault = said.split("; ").next().unwrap_or(&said);
            format!("{fault}; give more samples (--cycles, --rate), or units in which the numbers are nearer to 1")
        }
        _ if error.out_of_domain().is_some() => said,
        _ => {
            let flags = flags(error).map_or_else(String::new, |flags| format!(" ({flags})"));
            format!("{}{said}{flags}", if matches!(error, Error::Orbit(_)) { "no limit cycle: " } else { "" })
        }
    }
}
