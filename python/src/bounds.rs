//! Guaranteed bounds of a model's parameters.

use pyo3::prelude::*;
use selfosc::Error;
use selfosc::experiment::Columns;
use selfosc::files::Files;
use selfosc::identify::bounded::{BoundedModel, DelayBound, enclose};
use selfosc::identify::{DragLaw, Refusal};
use serde_json::Value;

use crate::identification::{Source, parsed};
use crate::{failure, work};

/// What records leave of a model's parameters, as a JSON document. The model's document names only what is not the default.
#[pyfunction]
pub(crate) fn bounds(py: Python<'_>, sources: Vec<Source<'_>>, columns: &str, model: &str) -> PyResult<String> {
    let columns: Columns = parsed(py, columns)?;
    let model = model_of(py, model)?;
    let sources = sources.into_iter().map(Source::read).collect::<PyResult<Vec<_>>>()?;
    let found = work::interruptible(py, None, move |_| -> Result<_, Error> {
        let logs = sources
            .into_iter()
            .map(|source| source.log(&columns, &mut Files::default()))
            .collect::<Result<Vec<_>, Refusal>>()?;
        let records: Vec<_> = logs.iter().map(|(_, log)| &log.record).collect();
        Ok(enclose(&records, &model)?)
    })?;
    let found = found.map_err(|error| failure::library(py, error))?;
    serde_json::to_string(&found).map_err(|error| failure::raised(py, "usage", &error.to_string(), None))
}

/// Over linear drag and a delay of which nothing is known, what the document says.
fn model_of(py: Python<'_>, document: &str) -> PyResult<BoundedModel> {
    let usage = |error: serde_json::Error| failure::raised(py, "usage", &error.to_string(), None);
    let given: serde_json::Map<String, Value> = parsed(py, document)?;
    let mut whole = serde_json::to_value(BoundedModel::new(DragLaw::Linear, DelayBound::Unknown)).map_err(usage)?;
    for (name, value) in given {
        match whole.get_mut(&name) {
            Some(place) => *place = value,
            None => {
                let known = whole.as_object().map(|fields| fields.keys().cloned().collect::<Vec<_>>().join(", "));
                let text = format!("a model has no {name}; it has {}", known.unwrap_or_default());
                return Err(failure::raised(py, "usage", &text, None));
            }
        }
    }
    serde_json::from_value(whole).map_err(usage)
}
