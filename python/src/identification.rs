//! From logs to a model.

use std::ffi::OsString;
use std::path::{self, Path, PathBuf};

use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use selfosc::Error;
use selfosc::experiment::{Columns, Log};
use selfosc::files::Files;
use selfosc::identify::{Refusal, Session, Settings};
use selfosc::report::identification as page;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::{failure, work};

/// One vehicle identified: its documents are made when they are asked for.
#[pyclass(frozen)]
pub(crate) struct Identification {
    found: selfosc::identify::Identification,
    /// The logs, which no report replaces.
    files: Files,
    logs: Logs,
}

/// The logs in files as another process knows them: by name.
#[derive(Default, Serialize, Deserialize)]
pub(crate) struct Logs {
    paths: Vec<OsString>,
    digests: Vec<String>,
}

impl Logs {
    /// A log in a file, by its name from anywhere.
    fn add(&mut self, path: &Path) {
        self.paths.push(path::absolute(path).unwrap_or_else(|_| path.to_owned()).into_os_string());
    }
}

/// All of an identification, as one process gives it to another.
#[derive(Serialize, Deserialize)]
struct Travelling<Found, Names> {
    found: Found,
    logs: Names,
}

#[pymethods]
impl Identification {
    /// What `selfosc identify --json` prints.
    fn document(&self) -> PyResult<String> {
        written(&self.found.conclusion())
    }

    /// Everything, with records, fitted outputs and residuals.
    fn full(&self) -> PyResult<String> {
        written(&self.found)
    }

    /// Everything, for [`arrived`](Self::arrived) in another process.
    fn travelling(&self) -> PyResult<String> {
        written(&Travelling { found: &self.found, logs: &self.logs })
    }

    /// What [`travelling`](Self::travelling) wrote. The logs are protected by their names, since other systems number files in other ways.
    #[staticmethod]
    fn arrived(py: Python<'_>, text: &str) -> PyResult<Self> {
        let Travelling::<_, Logs> { found, logs } = parsed(py, text)?;
        let mut files = Files::default();
        logs.paths.iter().for_each(|path| files.protect(Path::new(path)));
        Ok(Self { found, files, logs })
    }

    /// Writes the report, one HTML file, whole or not at all; onto no log.
    fn report(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let path: PathBuf = failure::named(py, path)?;
        let written = || -> Result<(), Error> {
            let document = page::document(&self.found).from_where(self.logs.digests.iter().cloned());
            Ok(self.files.clone().output(&path)?.write(document.html()?.as_bytes())?)
        };
        written().map_err(|error| failure::library(py, error))
    }
}

pub(crate) fn written(document: &impl serde::Serialize) -> PyResult<String> {
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
    Table(String, [String; 3], [PyReadonlyArray1<'py, f64>; 3]),
    Path(PathBuf),
}

/// The same, out of Python's reach.
pub(crate) enum Read {
    Path(PathBuf),
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
    /// Its file, or the table's name, which may be the name of the file that held it.
    fn path(&self) -> &Path {
        match self {
            Self::Path(path) => path,
            Self::Table(name, ..) => Path::new(name),
        }
    }

    /// The log with its name, and its file among those read.
    pub(crate) fn log(self, columns: &Columns, files: &mut Files) -> Result<(String, Log), Refusal> {
        let (name, log) = match self {
            Self::Path(path) => {
                let input = files.read(&path, Columns::LONGEST)?;
                (input.name().to_owned(), columns.read(input.bytes()))
            }
            Self::Table(name, names, values) => {
                files.protect(Path::new(&name));
                (name, columns.table(names, values))
            }
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
    validation: Vec<Bound<'_, PyAny>>,
    settings: &str,
    columns: &str,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Identification> {
    let settings: Settings = parsed(py, settings)?;
    let columns: Columns = parsed(py, columns)?;
    let sources = sources.into_iter().map(Source::read).collect::<PyResult<Vec<_>>>()?;
    let validation = validation.iter().map(|path| failure::named(py, path)).collect::<PyResult<Vec<PathBuf>>>()?;
    let found = work::interruptible(py, progress.as_ref(), move |stage| -> Result<_, Refusal> {
        settings.check()?;
        let (mut files, mut logs) = (Files::default(), Logs::default());
        let mut session = Session::new(settings).with_columns(columns.clone());
        for source in sources {
            logs.add(source.path());
            let (name, log) = source.log(&columns, &mut files)?;
            session = session.record(name, log);
        }
        for path in validation {
            logs.add(&path);
            let input = files.read(&path, Columns::LONGEST)?;
            session = session.validation_reader(input.name(), input.bytes())?;
        }
        let found = session.identify_with(|next| stage(next.to_string()))?;
        logs.digests = files.digests().to_vec();
        Ok(Identification { found, files, logs })
    })?;
    found.map_err(|refusal| failure::library(py, refusal))
}
