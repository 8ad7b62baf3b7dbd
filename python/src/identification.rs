//! From logs to a model.

use std::fs::File;

use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use selfosc::experiment::{Columns, Log};
use selfosc::identify::{Refusal, Session, Settings};
use serde::de::DeserializeOwned;

use crate::{failure, work};

/// One vehicle identified: its documents are made when they are asked for.
#[pyclass(frozen)]
pub(crate) struct Identification(selfosc::identify::Identification);

#[pymethods]
impl Identification {
    /// What `selfosc identify --json` prints.
    fn document(&self) -> PyResult<String> {
        written(&self.0.conclusion())
    }

    /// Everything, with records, fitted outputs and residuals.
    fn full(&self) -> PyResult<String> {
        written(&self.0)
    }

    /// The report, one HTML file.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        selfosc::report::identification::document(&self.0).html().map_err(|error| failure::library(py, error))
    }
}

fn written(document: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(document).map_err(|error| PyValueError::new_err(error.to_string()))
}

pub(crate) fn parsed<T: DeserializeOwned>(py: Python<'_>, text: &str) -> PyResult<T> {
    serde_json::from_str(text).map_err(|error| failure::raised(py, "usage", &error.to_string(), None))
}

/// The places of time, output and input among these columns.
#[pyfunction]
pub(crate) fn choose_columns(py: Python<'_>, columns: &str, names: Vec<String>) -> PyResult<[usize; 3]> {
    parsed::<Columns>(py, columns)?.choose(&names).map_err(|error| failure::library(py, error))
}

/// A log: a path, or a table's name, its three columns' names, and the columns.
#[derive(FromPyObject)]
pub(crate) enum Source<'py> {
    Path(String),
    Table(String, [String; 3], [PyReadonlyArray1<'py, f64>; 3]),
}

/// The same, out of Python's reach.
pub(crate) enum Read {
    Path(String),
    Table(String, [String; 3], [Vec<f64>; 3]),
}

impl Source<'_> {
    pub(crate) fn read(self) -> PyResult<Read> {
        Ok(match self {
            Self::Path(path) => Read::Path(path),
            Self::Table(name, names, columns) => {
                let [time, output, input] = columns;
                let values = |column: PyReadonlyArray1<'_, f64>| column.as_slice().map(<[f64]>::to_vec);
                Read::Table(name, names, [values(time)?, values(output)?, values(input)?])
            }
        })
    }
}

impl Read {
    /// The log with its name.
    pub(crate) fn log(self, columns: &Columns) -> Result<(String, Log), Refusal> {
        let (name, log) = match self {
            Self::Path(name) => match File::open(&name) {
                Ok(file) => (name, columns.read(file)),
                Err(error) => return Err(Refusal::File { name, reason: error.to_string() }),
            },
            Self::Table(name, names, values) => (name, columns.table(names, values)),
        };
        match log {
            Ok(log) => Ok((name, log)),
            Err(source) => Err(Refusal::Record { name, source }),
        }
    }
}

/// One vehicle from its logs, and the logs in files that are predicted and take no part. Settings and columns are the documents of `Settings` and `Columns`.
#[pyfunction]
pub(crate) fn identify(
    py: Python<'_>,
    sources: Vec<Source<'_>>,
    validation: Vec<String>,
    settings: &str,
    columns: &str,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Identification> {
    let settings: Settings = parsed(py, settings)?;
    let columns: Columns = parsed(py, columns)?;
    let sources = sources.into_iter().map(Source::read).collect::<PyResult<Vec<_>>>()?;
    let found = work::interruptible(py, progress.as_ref(), move |stage| {
        settings.check()?;
        let mut session = Session::new(settings).with_columns(columns.clone());
        for source in sources {
            let (name, log) = source.log(&columns)?;
            session = session.record(name, log);
        }
        let session = validation.into_iter().try_fold(session, Session::validation)?;
        session.identify_with(|next| stage(next.to_string()))
    })?;
    found.map(Identification).map_err(|refusal: Refusal| failure::library(py, refusal))
}
