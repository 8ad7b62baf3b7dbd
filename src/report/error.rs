//! Why there is no report.

use crate::numeric::OutOfDomain;
use crate::paper::PaperError;

/// Why there is no report.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The data are not to be had.
    #[error(transparent)]
    Paper(#[from] PaperError),
    /// A page of the catalogue without a usable example.
    #[error(transparent)]
    Catalogue(#[from] crate::describing::CatalogueError),
    /// A figure cannot be drawn.
    #[error("figure {figure}: {reason}; give it series with finite points")]
    Figure {
        /// Its name.
        figure: &'static str,
        /// Message of the drawing library.
        reason: String,
    },
    /// A table cannot be written as text.
    #[error("table {table}: {reason}; give every row one cell for each column")]
    Table {
        /// Its name.
        table: &'static str,
        /// What is wrong.
        reason: String,
    },
}

impl ReportError {
    /// Short name for scripts; it does not change with the wording of the message.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Paper(error) => error.code(),
            Self::Catalogue(error) => error.code(),
            Self::Figure { .. } => "figure",
            Self::Table { .. } => "table",
        }
    }

    /// The number outside its domain, if that is the reason.
    #[must_use]
    pub fn out_of_domain(&self) -> Option<&OutOfDomain> {
        match self {
            Self::Paper(error) => error.out_of_domain(),
            Self::Catalogue(error) => error.out_of_domain(),
            _ => None,
        }
    }
}
