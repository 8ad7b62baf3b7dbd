//! What the Python package `selfosc` calls: the command's documents, describing functions over arrays, logs to models,
//! certificates. Arguments are checked and results are shaped in Python, numbers are found here.

mod bounds;
mod describing;
mod failure;
mod identification;
mod on_board;
mod work;

use std::ffi::OsString;

use pyo3::prelude::*;

/// The answer of a subcommand to arguments as a shell would pass them: whether it is no, and its text.
#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<Bound<'_, PyAny>>) -> PyResult<(bool, String)> {
    let arguments = arguments.iter().map(|one| failure::named(py, one)).collect::<PyResult<Vec<OsString>>>()?;
    let answer = work::interruptible(py, None, |_| selfosc::command::answer(arguments))?;
    answer
        .map(|answer| (answer.no, answer.text))
        .map_err(|why| failure::raised(py, why.code, &why.text, why.out_of_domain.as_ref()))
}

/// The native half of the package `selfosc`.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::bounds::bounds;
    #[pymodule_export]
    use super::describing::{Characteristic, by_quadrature};
    #[pymodule_export]
    use super::identification::{Identification, choose_columns, identify};
    #[pymodule_export]
    use super::on_board::{Controller, Experiment, axis_of_outcome};
    #[pymodule_export]
    use super::run;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
