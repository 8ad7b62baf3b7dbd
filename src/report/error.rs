//! Why there is no report.

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

crate::numeric::codes! { pub ReportError {
    Paper.0, Catalogue.0, Figure => "figure", Table => "table",
} }
