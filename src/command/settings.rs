//! Parameters of a characteristic as JSON has them.

use serde_json::json;

use crate::describing::{Entry, Setting};

/// Values by the names of the parameters.
pub(super) fn parameters(entry: &Entry, values: &[f64]) -> serde_json::Map<String, serde_json::Value> {
    entry.settings(values).into_iter().map(|(name, value)| (name.to_owned(), plain(&value))).collect()
}

/// A number as a number, points as pairs.
fn plain(setting: &Setting) -> serde_json::Value {
    match setting {
        Setting::Number(number) => json!(number),
        Setting::Points(points) => json!(points),
    }
}
