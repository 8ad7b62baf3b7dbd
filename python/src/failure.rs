//! Refusals as Python exceptions.

use pyo3::prelude::*;
use selfosc::Error;
use selfosc::identify::Refusal;
use selfosc::numeric::OutOfDomain;

/// The exception of a refusal, with code, text, quantity, value, unit, limit and remedy.
pub(crate) fn raised(py: Python<'_>, code: &str, text: &str, fault: Option<&OutOfDomain>) -> PyErr {
    exception(py, code, text, fault, false)
}

/// The exception that Python's side makes of this.
fn exception(py: Python<'_>, code: &str, text: &str, fault: Option<&OutOfDomain>, record: bool) -> PyErr {
    let number =
        fault.map(|fault| (fault.quantity, fault.value, fault.unit, fault.limit.to_string(), fault.remedy.to_owned()));
    let exception =
        py.import("selfosc.errors").and_then(|errors| errors.getattr("of")?.call1((code, text, number, record)));
    exception.map_or_else(|error| error, PyErr::from_value)
}

/// What a Python text or path is to the system; the package's own error where that has no such name.
pub(crate) fn named<'py, T: FromPyObjectOwned<'py>>(py: Python<'py>, text: &Bound<'py, PyAny>) -> PyResult<T> {
    text.extract().map_err(|error: T::Error| {
        let error: PyErr = error.into();
        raised(
            py,
            "usage",
            &format!("{text:?} must be text or a path that the system can name ({error}); write it so"),
            None,
        )
    })
}

/// Any error of the library.
pub(crate) fn library(py: Python<'_>, error: impl Into<Error>) -> PyErr {
    let error = error.into();
    let record = match &error {
        Error::Identification(refusal) => !matches!(refusal, Refusal::Settings(_)),
        Error::Experiment(_) | Error::Features(_) | Error::Identify(_) => true,
        _ => false,
    };
    exception(py, error.code(), &error.to_string(), error.out_of_domain(), record)
}
