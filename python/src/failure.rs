//! Refusals as Python exceptions.

use pyo3::prelude::*;
use selfosc::numeric::OutOfDomain;

/// The exception that Python's side makes of a refusal, with code, text, quantity, value, unit, limit and remedy.
pub(crate) fn raised(py: Python<'_>, code: &str, text: &str, fault: Option<&OutOfDomain>) -> PyErr {
    let number =
        fault.map(|fault| (fault.quantity, fault.value, fault.unit, fault.limit.to_string(), fault.remedy.to_owned()));
    let exception = py.import("selfosc.errors").and_then(|errors| errors.getattr("of")?.call1((code, text, number)));
    exception.map_or_else(|error| error, PyErr::from_value)
}

/// Any error of the library.
pub(crate) fn library(py: Python<'_>, error: impl Into<selfosc::Error>) -> PyErr {
    let error = error.into();
    raised(py, error.code(), &error.to_string(), error.out_of_domain())
}
