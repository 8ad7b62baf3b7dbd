//! An axis as `tune` knows it: each parameter with its interval, given or identified.

use std::path::Path;

use serde_json::Value;

use super::error::Given;
use super::{CommandError, files};
use crate::files::{LONGEST_WORD, cut};
use crate::numeric::Interval;
use crate::numeric::domain::Plain;

/// A parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub(super) value: f64,
    /// `None` where it counts as exactly the value.
    pub(super) interval: Option<Interval>,
}

impl Known {
    /// Its interval, or the value as one.
    pub(super) fn range(&self) -> Interval {
        self.interval.unwrap_or(Interval::point(self.value))
    }
}

/// The parameters of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    pub(super) alpha: Known,
    pub(super) beta: Known,
    pub(super) beta_quadratic: Known,
    pub(super) delay_s: Known,
}

/// Flags that give intervals, in the order of the fields.
const FLAGS: [&str; 4] = ["--alpha-interval", "--beta-interval", "--beta-quadratic-interval", "--delay-interval"];

/// Where a model comes from.
const WRITTEN: &str = "write the file by `selfosc identify LOG --json > RESULT.json`";

impl Model {
    /// Parameters without intervals, in the order of the fields.
    pub(super) fn of(values: [f64; 4]) -> Self {
        Self::from_parts(values.map(|value| Known { value, interval: None }))
    }

    fn from_parts([alpha, beta, beta_quadratic, delay_s]: [Known; 4]) -> Self {
        Self { alpha, beta, beta_quadratic, delay_s }
    }

    /// The same with intervals that replace those there are.
    pub(super) fn with_intervals(self, intervals: [Option<Interval>; 4]) -> Result<Self, CommandError> {
        let mut parts = [self.alpha, self.beta, self.beta_quadratic, self.delay_s];
        for ((part, given), flag) in parts.iter_mut().zip(intervals).zip(FLAGS) {
            if let Some(interval) = given.filter(|interval| !interval.contains(part.value)) {
                let value = Plain(part.value);
                let reason = format!("{flag}: {interval} must contain the value, {value}; give an interval around it");
                return Err(CommandError::Usage { reason });
            }
            part.interval = given.or(part.interval);
        }
        Ok(Self::from_parts(parts))
    }

    /// What `selfosc identify --json` reported.
    pub(super) fn read(path: &Path) -> Result<Self, CommandError> {
        let unusable = |reason: String| CommandError::Model { flag: "--model", path: path.to_owned(), reason };
        let text = files::text(path).given("--model")?;
        let found: Value = serde_json::from_str(&text).map_err(|error| unusable(format!("{error}; {WRITTEN}")))?;
        let reported = &found["reported"];
        if reported.is_null() {
            return Err(unusable("it reports no model; identify again, or give --alpha and the others".to_owned()));
        }
        let wrong = |field: &str, found: &Value, limit: &str| {
            let found = cut(&found.to_string(), LONGEST_WORD);
            unusable(format!("reported.{field} is {found}: must be {limit}; {WRITTEN}"))
        };
        match reported["trust"].as_str() {
            Some("good" | "widened") => {}
            Some("doubtful") => {
                let reasons = reported["reasons"].as_array().into_iter().flatten();
                let codes: Vec<&str> = reasons.filter_map(|reason| reason["code"].as_str()).collect();
                return Err(unusable(format!(
                    "the model is doubtful ({}); identify from a better record, or give --alpha and the others on your own account",
                    codes.join(", ")
                )));
            }
            _ => return Err(wrong("trust", &reported["trust"], "\"good\" or \"widened\"")),
        }
        let part = |name: &str| {
            let number = |field: &str| match &reported[name][field] {
                Value::Null => Ok(None),
                Value::Number(number) => Ok(number.as_f64()),
                other => Err(wrong(&format!("{name}.{field}"), other, "a number or null")),
            };
            let (value, interval) = (number("value")?, number("low")?.zip(number("high")?));
            match interval {
                Some((low, high)) if low > high => {
                    Err(wrong(&format!("{name}.low"), &low.into(), &format!("{high} or less, its high")))
                }
                // The interval of a drag may reach below zero, where no axis is.
                _ => Ok(value.map(|value| Known {
                    value,
                    interval: interval.and_then(|(low, high)| Interval::new(low.max(0.0).min(value), high.max(value))),
                })),
            }
        };
        for term in ["beta_cubic", "skew", "coulomb", "memory", "stiffness", "lag_s", "ramp_s", "filter_s"] {
            if part(term)?.is_some_and(|one| one.value != 0.0) {
                return Err(unusable(format!(
                    "it has the term {term}, which `tune` does not know; give --alpha and the others of an axis without it"
                )));
            }
        }
        let Some(alpha) = part("alpha")? else { return Err(wrong("alpha.value", &Value::Null, "a number")) };
        let or_zero = |name| part(name).map(|one| one.unwrap_or(Known { value: 0.0, interval: None }));
        Ok(Self::from_parts([alpha, or_zero("beta")?, or_zero("beta_quadratic")?, or_zero("delay_s")?]))
    }
}
