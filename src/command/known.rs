//! An axis as `tune` knows it: each parameter with its interval, given or identified.

use std::path::Path;

use serde_json::Value;

use super::error::Given;
use super::{CommandError, files};
use crate::control::{AxisModel, LinearProcess, NAMES, UncertainDrag};
use crate::files::{LONGEST_WORD, cut};
use crate::numeric::domain::{AtLeast, AtMost, Plain, require};
use crate::numeric::{Interval, Limit};
use crate::plant::DragAxis;

/// A parameter.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct KnownParameter {
    pub(super) value: f64,
    /// `None` where it counts as exactly the value.
    pub(super) interval: Option<Interval>,
}

impl KnownParameter {
    /// Its interval, or the value as a point interval.
    pub(super) fn range(&self) -> Interval {
        self.interval.unwrap_or(Interval::point(self.value))
    }
}

/// The parameters of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    pub(super) axis: AxisModel<KnownParameter>,
    /// How the coefficients of the drag vary together; `None` where their intervals count as independent.
    drag: Option<UncertainDrag>,
    /// Whether it is identified from a record.
    pub(super) identified: bool,
    /// Whether the log was in degrees; the model is in radians all the same.
    pub(super) degrees: bool,
    /// Whether the log's output is a length in m, hence no angle.
    pub(super) length: bool,
}

/// Where a model comes from.
const WRITTEN: &str = "write the file by `selfosc identify LOG --json > RESULT.json`";
/// The remedy for an axis without inertia.
pub(super) const FIRST_ORDER: &str = "must be above 0; an axis without inertia is of first order, as a speed, a rate or a \
                                      heater is: identify and tune it by `selfosc autotune LOG`";
/// Times, which are not negative.
const TIMES: [&str; 6] = ["memory_s", "lag_s", "ramp_s", "pause_s", "filter_s", "delay_s"];

impl Model {
    /// An axis that is given.
    pub(super) fn given(axis: &DragAxis<f64>) -> Self {
        let axis = AxisModel::from(axis).map(|value| KnownParameter { value, interval: None });
        Self { axis, drag: None, identified: false, degrees: false, length: false }
    }

    /// The same with intervals that replace those there are, each with the limit of its lower end.
    pub(super) fn with_intervals(
        mut self,
        given: [(&'static str, Option<Interval>, Limit); 4],
    ) -> Result<Self, CommandError> {
        let axis = &mut self.axis;
        let parts = [&mut axis.alpha, &mut axis.beta, &mut axis.beta_quadratic, &mut axis.delay_s];
        for (part, (flag, given, limit)) in parts.into_iter().zip(given) {
            if let Some(interval) = given.filter(|interval| !interval.contains(part.value)) {
                let value = Plain(part.value);
                let reason = format!("{flag}: {interval} must contain the value, {value}; give an interval around it");
                return Err(CommandError::Usage { reason });
            }
            let lower = given.map_or(1.0, |interval| interval.lower());
            require("lower end of the interval", lower, "", limit, "raise it").given(flag)?;
            part.interval = given.or(part.interval);
            if given.is_some() && flag.starts_with("--beta") {
                self.drag = None;
            }
        }
        Ok(self)
    }

    /// The values.
    pub(super) fn values(&self) -> AxisModel<f64> {
        self.axis.map(|known| known.value)
    }

    /// The intervals.
    pub(super) fn ranges(&self) -> AxisModel<Interval> {
        self.axis.map(|known| known.range())
    }

    /// Every linear process at speeds up to `top_speed`.
    pub(super) fn processes(&self, top_speed: f64) -> LinearProcess<Interval> {
        self.ranges().processes(self.slopes(top_speed))
    }

    /// Slopes of the drag at rest: the value, of a drag that drives none, and the least there may be.
    pub(super) fn slopes_at_rest(&self) -> [f64; 2] {
        [self.axis.beta.value.max(0.0), self.slopes(0.0).lower()]
    }

    /// Slopes of the drag at speeds up to `top_speed`. A record of an oscillation shows the force at speeds, not the slope of the drag at
    /// rest, which a law only extrapolates: down to none it is possible there.
    fn slopes(&self, top_speed: f64) -> Interval {
        let slopes = self.drag.map_or_else(|| self.ranges().slopes(top_speed), |drag| drag.slopes(top_speed));
        if self.identified { slopes.hull(Interval::ZERO) } else { slopes }
    }

    /// What `selfosc identify --json` reported.
    pub(super) fn read(path: &Path) -> Result<Self, CommandError> {
        let unusable = |reason: String| CommandError::Model { flag: "--model", path: path.to_owned(), reason };
        let text = files::text(path).given("--model")?;
        let found: Value = serde_json::from_str(&text).map_err(|error| unusable(format!("{error}; {WRITTEN}")))?;
        let reported = &found["reported"];
        if reported.is_null() {
            return Err(unusable(
                "it reports no model; identify again by `--method all` or `fit`, or give --alpha and the others"
                    .to_owned(),
            ));
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
        let part = |name: &'static str| {
            let number = |place: &Value, field: &str| match &place[field] {
                Value::Null => Ok(None),
                Value::Number(number) => Ok(number.as_f64()),
                other => Err(wrong(&format!("{name}.{field}"), other, "a number or null")),
            };
            let estimate = &reported[name];
            let Some(value) = number(estimate, "value")? else {
                let missing = || wrong("alpha.value", &Value::Null, "a number");
                return if name == "alpha" { Err(missing()) } else { Ok(KnownParameter::default()) };
            };
            // The practical interval, where there is one.
            let place = if estimate["combined"].is_null() { estimate } else { &estimate["combined"] };
            let interval = match number(place, "low")?.zip(number(place, "high")?) {
                Some((low, high)) if low > high => {
                    return Err(wrong(&format!("{name}.low"), &low.into(), &format!("{high} or less, its high")));
                }
                Some((low, high)) => {
                    let least = if TIMES.contains(&name) { low.max(0.0) } else { low };
                    Interval::new(least.min(value), high.max(value))
                }
                None => None,
            };
            Ok(KnownParameter { value, interval })
        };
        let mut parts = [KnownParameter::default(); NAMES.len()];
        for (place, name) in parts.iter_mut().zip(NAMES) {
            *place = part(name)?;
        }
        let drag = match &reported["drag_covariance"]["combined"] {
            Value::Null => None,
            found => Some(covariance(reported, found).ok_or_else(|| {
                let limit = "a 3 by 3 covariance with the squares of the drags' combined.std on its diagonal";
                wrong("drag_covariance.combined", found, limit)
            })?),
        };
        let inertia = parts[0].range();
        if !inertia.is_positive() {
            let (low, high) = (AtMost(inertia.lower()), AtLeast(inertia.upper()));
            return Err(unusable(format!("its inertia is from {low} to {high}: {FIRST_ORDER}")));
        }
        let [degrees, length] = ["rad", "m"].map(|unit| found["units"]["output"] == unit);
        let axis = AxisModel::from_parts(parts);
        let coefficients = [axis.beta, axis.beta_quadratic, axis.beta_cubic].map(|known| known.value);
        let drag = drag.map(|covariance| UncertainDrag { coefficients, covariance });
        Ok(Self { axis, drag, identified: true, degrees, length })
    }
}

/// The covariance of the drags' practical intervals; `None` where it is none, or of other intervals.
fn covariance(reported: &Value, found: &Value) -> Option<[[f64; 3]; 3]> {
    /// Relative difference that rounding may leave.
    const SAME: f64 = 1e-6;
    let covariance: [[f64; 3]; 3] = serde_json::from_value(found.clone()).ok()?;
    let variance =
        ["beta", "beta_quadratic", "beta_cubic"].map(|name| Some(reported[name]["combined"]["std"].as_f64()?.powi(2)));
    let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    let holds = |i: usize, j: usize| {
        let (entry, most) = (covariance[i][j], (covariance[i][i] * covariance[j][j]).sqrt());
        let own = i != j || variance[i].is_none_or(|variance| same(entry, variance));
        own && same(entry, covariance[j][i]) && entry.abs() <= (1.0 + SAME) * most
    };
    (0..9).all(|k| holds(k / 3, k % 3)).then_some(covariance)
}
