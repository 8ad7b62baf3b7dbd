//! An axis as `tune` knows it: each parameter with its interval, given or identified.

use std::path::Path;

use serde_json::Value;

use super::CommandError;
use crate::numeric::Interval;

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
            if given.is_some_and(|interval| !interval.contains(part.value)) {
                let reason = format!("{flag} does not contain the value {}; give an interval around it", part.value);
                return Err(CommandError::Contradiction { reason });
            }
            part.interval = given.or(part.interval);
        }
        Ok(Self::from_parts(parts))
    }

    /// What `selfosc identify --json` reported.
    pub(super) fn read(path: &Path) -> Result<Self, CommandError> {
        let unusable = |reason: String| CommandError::Model { path: path.to_owned(), reason };
        let text = std::fs::read_to_string(path).map_err(|error| unusable(error.to_string()))?;
        let found: Value = serde_json::from_str(&text)
            .map_err(|error| unusable(format!("{error}; write it by `selfosc identify LOG --json > RESULT.json`")))?;
        let reported = &found["reported"];
        if reported.is_null() {
            return Err(unusable("it reports no model; identify again, or give --alpha and the others".to_owned()));
        }
        if reported["trust"] == "doubtful" {
            let reasons: Vec<&str> = reported["reasons"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(|reason| reason["code"].as_str())
                .collect();
            let reasons = reasons.join(", ");
            return Err(unusable(format!(
                "the model is doubtful ({reasons}); identify from a better record, or give --alpha and the others on your own account"
            )));
        }
        for term in ["beta_cubic", "skew", "coulomb", "memory", "stiffness", "lag_s", "ramp_s", "filter_s"] {
            if reported[term]["value"].as_f64().is_some_and(|value| value != 0.0) {
                return Err(unusable(format!(
                    "it has the term {term}, which `tune` does not know; give --alpha and the others of an axis without it"
                )));
            }
        }
        let part = |name: &str, needed: bool| {
            let number = |field: &str| reported[name][field].as_f64();
            match number("value") {
                None if needed => Err(unusable(format!(
                    "reported.{name}.value is no number; write the file by `selfosc identify LOG --json`"
                ))),
                None => Ok(Known { value: 0.0, interval: None }),
                // The interval of a drag may reach below zero, where no axis is.
                Some(value) => Ok(Known {
                    value,
                    interval: number("low")
                        .zip(number("high"))
                        .and_then(|(low, high)| Interval::new(low.max(0.0).min(value), high.max(value))),
                }),
            }
        };
        Ok(Self {
            alpha: part("alpha", true)?,
            beta: part("beta", false)?,
            beta_quadratic: part("beta_quadratic", false)?,
            delay_s: part("delay_s", false)?,
        })
    }
}
