//! Characteristics and their describing functions over arrays.

use std::cell::RefCell;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use selfosc::describing::{Boxed, DescribingError, DescribingFunction, Entry, Setting};
use selfosc::nonlinearity::{Branch, Custom, Sinusoid};

use crate::failure;

/// `F_0`, `P`, `Q`, one array each.
type Arrays<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);
/// A number or points, as Python gives them.
#[derive(FromPyObject)]
enum Given {
    Number(f64),
    Points(Vec<(f64, f64)>),
}

impl From<Given> for Setting {
    fn from(given: Given) -> Self {
        match given {
            Given::Number(number) => Self::Number(number),
            Given::Points(points) => Self::Points(points),
        }
    }
}

/// A characteristic of the catalogue.
#[pyclass(frozen)]
pub(crate) struct Characteristic {
    entry: &'static Entry,
    values: Vec<f64>,
}

impl Characteristic {
    fn build(&self, py: Python<'_>) -> PyResult<Boxed<f64>> {
        self.entry.build(&self.values).map_err(|error| failure::library(py, error))
    }
}

#[pymethods]
impl Characteristic {
    #[new]
    fn new(py: Python<'_>, name: &str, settings: Vec<(String, Given)>) -> PyResult<Self> {
        let settings: Vec<(String, Setting)> = settings.into_iter().map(|(key, given)| (key, given.into())).collect();
        let entry = Entry::find(name).map_err(|error| failure::library(py, error))?;
        let values = entry.values(&settings).map_err(|error| failure::library(py, error))?;
        let characteristic = Self { entry, values };
        characteristic.build(py)?;
        Ok(characteristic)
    }

    /// Each parameter with its value: a number, or points as text.
    fn settings(&self) -> Vec<(&'static str, String)> {
        self.entry.settings(&self.values).into_iter().map(|(name, value)| (name, value.to_string())).collect()
    }

    /// Whether the output depends on the way of the input.
    fn has_memory(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.build(py)?.has_memory())
    }

    /// `F_0`, `P`, `Q` for arrays of one length, or of length one. Where `skip` is set, what has none is NaN.
    fn describing_function<'py>(
        &self,
        py: Python<'py>,
        amplitude: PyReadonlyArray1<'py, f64>,
        bias: PyReadonlyArray1<'py, f64>,
        skip: bool,
    ) -> PyResult<Arrays<'py>> {
        let (entry, values) = (self.entry, &self.values[..]);
        let (amplitude, bias) = (amplitude.as_slice()?, bias.as_slice()?);
        let found = py.detach(|| {
            let characteristic = entry.build::<f64>(values).map_err(|error| (0, error.into()))?;
            over(amplitude, bias, skip, |sweep| characteristic.describing_function(sweep))
        });
        arrays(py, found)
    }

    /// The outputs on the way up and on the way down, for the sweeps of these biases and amplitudes.
    fn branches(&self, py: Python<'_>, x: f64, bias: f64, amplitude: f64) -> PyResult<(f64, f64)> {
        let characteristic = self.build(py)?;
        let sweep = Sinusoid::new(bias, amplitude).map_err(|error| failure::library(py, error))?;
        let output = |branch| characteristic.output(x, branch, &sweep);
        Ok((output(Branch::Rising), output(Branch::Falling)))
    }

    /// The outputs of one without memory.
    fn outputs<'py>(&self, py: Python<'py>, x: PyReadonlyArray1<'py, f64>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let characteristic = self.build(py)?;
        // Without memory the sweep does not matter.
        let sweep = Sinusoid::new(0.0, 1.0).map_err(|error| failure::library(py, error))?;
        let output = |x: &f64| characteristic.output(*x, Branch::Rising, &sweep);
        Ok(x.as_slice()?.iter().map(output).collect::<Vec<_>>().into_pyarray(py))
    }
}

/// Columns of results, or the place of the first that has none and why.
type Found = Result<[Vec<f64>; 3], (usize, selfosc::Error)>;

fn over(
    amplitude: &[f64],
    bias: &[f64],
    skip: bool,
    describing: impl Fn(&Sinusoid<f64>) -> Result<DescribingFunction<f64>, DescribingError>,
) -> Found {
    let count = amplitude.len().max(bias.len());
    let at = |values: &[f64], index: usize| if values.len() == 1 { values[0] } else { values[index] };
    let mut columns = [(); 3].map(|()| Vec::with_capacity(count));
    for index in 0..count {
        let sweep = Sinusoid::new(at(bias, index), at(amplitude, index)).map_err(|error| (index, error.into()))?;
        let values = match describing(&sweep) {
            Ok(DescribingFunction { f0, p, q }) => [f0, p, q],
            Err(_) if skip => [f64::NAN; 3],
            Err(error) => return Err((index, error.into())),
        };
        for (column, value) in columns.iter_mut().zip(values) {
            column.push(value);
        }
    }
    Ok(columns)
}

fn arrays(py: Python<'_>, found: Found) -> PyResult<Arrays<'_>> {
    let [f0, p, q] = found.map_err(|(_, error)| failure::library(py, error))?;
    Ok((f0.into_pyarray(py), p.into_pyarray(py), q.into_pyarray(py)))
}

/// `F_0`, `P`, `Q` of a Python function by quadrature between its kinks. The function gets the input and whether it rises.
#[pyfunction]
pub(crate) fn by_quadrature<'py>(
    py: Python<'py>,
    function: Bound<'py, PyAny>,
    kinks: Vec<f64>,
    amplitude: PyReadonlyArray1<'py, f64>,
    bias: PyReadonlyArray1<'py, f64>,
) -> PyResult<Arrays<'py>> {
    let fault: RefCell<Option<PyErr>> = RefCell::new(None);
    let output = |x: f64, branch: Branch| {
        if fault.borrow().is_some() {
            return 0.0;
        }
        let value = py.check_signals().and_then(|()| function.call1((x, branch == Branch::Rising))?.extract());
        value.unwrap_or_else(|error| {
            *fault.borrow_mut() = Some(error);
            0.0
        })
    };
    let custom = Custom::new(output, &kinks);
    let found = over(amplitude.as_slice()?, bias.as_slice()?, false, |sweep| {
        selfosc::describing::by_quadrature(&custom, sweep)
    });
    match fault.take() {
        Some(error) => Err(error),
        None => arrays(py, found),
    }
}
