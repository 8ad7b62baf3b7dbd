//! Why a part of the paper cannot be regenerated.

use crate::experiment::ExperimentError;
use crate::identify::IdentifyError;
use crate::nonlinearity::NonlinearityError;
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

crate::numeric::codes! { pub PaperError {
    Cell => "fixture-cell", Row => "fixture-row", Missing => "fixture-missing", Experiment.cause, Identify.0,
    Nonlinearity.0, NoQuadraticFit => "no-quadratic-fit", Plant.0, Simulation.0, Vehicle.0,
} }
