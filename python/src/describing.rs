//! Characteristics and their describing functions over arrays.

use std::cell::RefCell;

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use selfosc::Error;
use selfosc::describing::{Boxed, DescribingError, DescribingFunction, Entry, Setting};
use selfosc::nonlinearity::{Branch, Custom, Sinusoid};

use crate::{failure, work};

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

    /// `F_0`, `P`, `Q`, a row each, for arrays of one length, or of length one. Where `skip` is set, what has none is NaN.
    fn describing_function<'py>(
        &self,
        py: Python<'py>,
        amplitude: PyReadonlyArray1<'py, f64>,
        bias: PyReadonlyArray1<'py, f64>,
        skip: bool,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (amplitude, bias) = (amplitude.as_slice()?, bias.as_slice()?);
        let count = amplitude.len().max(bias.len());
        // Memory from numpy, which asks for large pages.
        let array = PyArray2::zeros(py, [3, count], false);
        let mut rows = array.readwrite();
        let threads = if count > CHUNK { Some(work::threads(py)?) } else { None };
        let (f0, rest) = rows.as_slice_mut()?.split_at_mut(count);
        let (p, q) = rest.split_at_mut(count);
        for (block, ((f0, p), q)) in f0.chunks_mut(BLOCK).zip(p.chunks_mut(BLOCK)).zip(q.chunks_mut(BLOCK)).enumerate()
        {
            let (from, columns) = (block * BLOCK, [f0, p, q]);
            let fill = || match (bias, amplitude) {
                ([bias], _) => self.fill(|at| (*bias, amplitude[from + at]), skip, columns),
                (_, [amplitude]) => self.fill(|at| (bias[from + at], *amplitude), skip, columns),
                _ => self.fill(|at| (bias[from + at], amplitude[from + at]), skip, columns),
            };
            let fault = py.detach(|| match &threads {
                Some(threads) => threads.install(fill),
                None => fill(),
            });
            if let Some(error) = fault {
                return Err(failure::library(py, error));
            }
            py.check_signals()?;
        }
        drop(rows);
        Ok(array)
    }

    /// `F_0`, `P`, `Q` of one sweep, bit for bit those of [`Characteristic::describing_function`].
    fn of_sweep(&self, py: Python<'_>, amplitude: f64, bias: f64) -> PyResult<(f64, f64, f64)> {
        let of = |sweep| Ok::<_, Error>(self.entry.build(&self.values)?.describing_function(&sweep)?);
        let df = Sinusoid::new(bias, amplitude).map_err(|error| DescribingError::from(error).into()).and_then(of);
        let df = df.map_err(|error| failure::library(py, error))?;
        Ok((df.f0, df.p, df.q))
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

/// Elements between two questions whether Python was interrupted.
const BLOCK: usize = 1 << 20;
/// Elements that a thread takes at a time.
const CHUNK: usize = 1 << 12;

/// Parts of the three columns, as zipped.
type Columns<'a> = ((&'a mut [f64], &'a mut [f64]), &'a mut [f64]);

/// The element, or the only one.
fn part(values: &[f64], index: usize) -> f64 {
    if values.len() == 1 { values[0] } else { values[index] }
}

impl Characteristic {
    /// `F_0`, `P`, `Q` at the biases and amplitudes that `sweep` gives for each place; the first failure, if there is one. All threads
    /// take part, each with a characteristic of its own.
    fn fill(
        &self,
        sweep: impl Fn(usize) -> (f64, f64) + Sync,
        skip: bool,
        [f0, p, q]: [&mut [f64]; 3],
    ) -> Option<Error> {
        const NONE: DescribingFunction<f64> = DescribingFunction { f0: f64::NAN, p: f64::NAN, q: f64::NAN };
        let undefined = |error: DescribingError| if skip { Ok(NONE) } else { Err(error.into()) };
        let chunk = |(chunk, ((f0, p), q)): (usize, Columns<'_>)| -> Result<(), Error> {
            self.entry.over_sweeps(&self.values, |place| sweep(chunk * CHUNK + place), undefined, [f0, p, q])
        };
        if f0.len() <= CHUNK {
            return chunk((0, ((f0, p), q))).err();
        }
        let chunks = f0.par_chunks_mut(CHUNK).zip(p.par_chunks_mut(CHUNK)).zip(q.par_chunks_mut(CHUNK));
        chunks.enumerate().filter_map(|one| chunk(one).err()).find_first(|_| true)
    }
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
    let (amplitude, bias) = (amplitude.as_slice()?, bias.as_slice()?);
    let one = |index: usize| -> Result<_, Error> {
        let sweep = Sinusoid::new(part(bias, index), part(amplitude, index))?;
        Ok(selfosc::describing::by_quadrature(&custom, &sweep)?)
    };
    let found: Result<Vec<_>, Error> = (0..amplitude.len().max(bias.len())).map(one).collect();
    if let Some(error) = fault.take() {
        return Err(error);
    }
    let found = found.map_err(|error| failure::library(py, error))?;
    let column = |of: fn(&DescribingFunction<f64>) -> f64| found.iter().map(of).collect::<Vec<_>>().into_pyarray(py);
    Ok((column(|df| df.f0), column(|df| df.p), column(|df| df.q)))
}
