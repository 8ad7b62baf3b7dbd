//! Tables, figures and one-file reports.
//!
//! A [`Table`] has several formats: Markdown, CSV, LaTeX, JSON, HTML and text for a terminal. A [`Figure`] is
//! data with labelled axes, drawn as SVG; the same data give the same bytes. A [`Document`] puts both into one HTML file that
//! needs no network.

mod characteristics;
mod error;
mod figure;
mod html;
pub mod identification;
mod nyquist;
pub mod paper;
mod process;
mod table;
mod uncertain;

pub use characteristics::{characteristic, characteristics};
pub use error::ReportError;
pub use figure::{Figure, Mark, Panel, Series};
pub use html::{Document, Section};
pub use nyquist::nyquist;
pub use process::ProcessPage;
pub use table::{Cell, Table};

pub(crate) use uncertain::Uncertain;
