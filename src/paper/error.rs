//! Why a part of the paper cannot be regenerated.

use crate::experiment::ExperimentError;
use crate::identify::IdentifyError;
use crate::nonlinearity::NonlinearityError;
use crate::numeric::OutOfDomain;
use crate::plant::PlantError;
use crate::vehicle::VehicleError;

/// Why a part of the paper cannot be regenerated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PaperError {
    /// A cell outside its column's domain.
    #[error(
        "{fixture}, line {line}, column {column}: `{cell}` is not {required}; restore the file as it was published"
    )]
    Cell {
        /// File name.
        fixture: &'static str,
        /// Line in the file, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        cell: String,
        /// The required content.
        required: &'static str,
    },
    /// A row that cannot be taken apart.
    #[error("{fixture}, line {line}, column {column}: {reason}; restore the file as it was published")]
    Row {
        /// File name.
        fixture: &'static str,
        /// Line in the file, from 1.
        line: u64,
        /// The last column present, or the first missing.
        column: String,
        /// What is wrong.
        reason: String,
    },
    /// A row that the other files or the formulas rely on is missing.
    #[error("{fixture} has no {missing}; restore the file as it was published")]
    Missing {
        /// File name.
        fixture: &'static str,
        /// The missing item.
        missing: String,
    },
    /// A row of Table 4 that the method does not take.
    #[error("experiment {experiment}: {cause}")]
    Experiment {
        /// Its number.
        experiment: u32,
        /// Why not.
        cause: IdentifyError,
    },
    /// A formula outside its domain.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A characteristic outside its domain.
    #[error(transparent)]
    Nonlinearity(#[from] NonlinearityError),
    /// No axis to simulate Figs. 12 and 13 with.
    #[error("no quadratic drag at the paper's delay among {rows} joint estimates; pass all of them")]
    NoQuadraticFit {
        /// Estimates given.
        rows: usize,
    },
    /// An axis outside its domain.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// An experiment that cannot be simulated.
    #[error(transparent)]
    Simulation(#[from] ExperimentError),
    /// A thruster outside its domain.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
}

impl PaperError {
    /// Short name for scripts; it does not change with the wording of the message.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Cell { .. } => "fixture-cell",
            Self::Row { .. } => "fixture-row",
            Self::Missing { .. } => "fixture-missing",
            Self::Experiment { cause, .. } => cause.code(),
            Self::Identify(error) => error.code(),
            Self::Nonlinearity(error) => error.code(),
            Self::NoQuadraticFit { .. } => "no-quadratic-fit",
            Self::Plant(error) => error.code(),
            Self::Simulation(error) => error.code(),
            Self::Vehicle(error) => error.code(),
        }
    }

    /// The number outside its domain, if that is the reason.
    #[must_use]
    pub fn out_of_domain(&self) -> Option<&OutOfDomain> {
        match self {
            Self::Experiment { cause: error, .. } | Self::Identify(error) => error.out_of_domain(),
            Self::Nonlinearity(error) => error.out_of_domain(),
            Self::Plant(error) => error.out_of_domain(),
            Self::Simulation(error) => error.out_of_domain(),
            Self::Vehicle(error) => error.out_of_domain(),
            _ => None,
        }
    }
}
