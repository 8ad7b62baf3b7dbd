//! A case that refutes.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Deserializer, Serialize};

/// A case that refutes, as numbers that a reader can put in again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Witness {
    /// Names and values, SI units unless the name has a unit. A value that is no number is null in JSON.
    #[serde(deserialize_with = "numbers")]
    pub numbers: Vec<(Cow<'static, str>, f64)>,
}

/// A number that JSON cannot hold is null, and comes back as no number.
fn numbers<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(Cow<'static, str>, f64)>, D::Error> {
    let numbers = Vec::<(_, Option<f64>)>::deserialize(from)?;
    Ok(numbers.into_iter().map(|(name, value)| (name, value.unwrap_or(f64::NAN))).collect())
}

impl Witness {
    pub(crate) fn new<N: Into<Cow<'static, str>>>(numbers: impl IntoIterator<Item = (N, f64)>) -> Self {
        Self { numbers: numbers.into_iter().map(|(name, value)| (name.into(), value)).collect() }
    }
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (name, value)) in self.numbers.iter().enumerate() {
            let separator = if place == 0 { "" } else { ", " };
            write!(f, "{separator}{name} = {}", short(*value))?;
        }
        Ok(())
    }
}

/// Six digits, and no more of them than there are.
fn short(value: f64) -> String {
    let rounded = format!("{value:.6e}").parse::<f64>().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) { format!("{rounded:e}") } else { rounded.to_string() }
}
