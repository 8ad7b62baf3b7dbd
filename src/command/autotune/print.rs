//! The answer for a person, and as a document.

use std::io::Write;

use serde_json::{Value, json};

use super::form::GainForm;
use super::{Autotuned, CommandError};
use crate::numeric::significant;
use crate::report::{Document, ProcessPage, Uncertain};

impl Autotuned {
    /// The gains to type in a form; `None` without gains.
    fn lines(&self, form: GainForm) -> Option<Result<String, &'static str>> {
        self.proved.as_ref().map(|proved| form.lines(&proved.gains, self.sign(), self.full_power, self.interval_s))
    }

    /// The page of `--report`.
    pub(super) fn page(&self, name: &str, form: GainForm) -> Document {
        let reasons: Vec<String> = self.reasons().into_iter().map(|(_, text)| text).collect();
        let lines = self.lines(form).and_then(Result::ok);
        let page = ProcessPage {
            name,
            log: &self.log,
            found: &self.found,
            proved: self.proved.as_ref(),
            curves: self.curves.as_ref(),
            lines: lines.as_deref(),
            trust: (self.trust(), reasons.as_slice()),
            rules: &self.rules,
        };
        page.document()
    }

    pub(super) fn json(&self, name: &str, form: GainForm) -> Value {
        let sign = self.sign();
        let estimate = |one: &crate::autotune::Ranged| json!(one);
        let models: Vec<Value> = self
            .found
            .models
            .iter()
            .map(|model| {
                let named = model.family.parameters().iter().zip(&model.parameters);
                let parameters: serde_json::Map<String, Value> =
                    named.map(|(name, one)| ((*name).to_owned(), estimate(one))).collect();
                json!({ "family": model.family.name(), "weight": model.weight, "parameters": parameters })
            })
            .collect();
        let integrates = self.found.models[0].family.integrates();
        let gains = self.proved.as_ref().map(|proved| {
            json!({
                "form": "parallel",
                "proportional": sign * proved.gains.proportional(),
                "integral": sign * proved.gains.integral(),
                "derivative": sign * proved.gains.derivative(),
                "filter_s": proved.gains.filter_s(),
            })
        });
        let ultimate = self.ultimate.map(|[gain, omega]| {
            let range = |side: crate::numeric::Interval| json!({ "low": side.lower(), "high": side.upper() });
            let best = crate::autotune::ultimate(&self.found.models[0].process()).unwrap_or([f64::NAN; 2]);
            let with = |value: f64, side| {
                let mut range = range(side);
                range["value"] = json!(value);
                range["std"] = Value::Null;
                range
            };
            json!({ "gain": with(best[0], gain), "omega_rad_s": with(best[1], omega) })
        });
        let rules: Vec<Value> = self
            .rules
            .iter()
            .map(|rule| {
                json!({
                    "name": rule.name,
                    "proportional": sign * rule.gains.proportional(),
                    "integral": sign * rule.gains.integral(),
                    "derivative": sign * rule.gains.derivative(),
                    "sensitivity": rule.sensitivity,
                })
            })
            .collect();
        json!({
            "trust": self.trust(),
            "reasons": self.reasons().iter().map(|(code, text)| json!({ "code": code, "text": text })).collect::<Vec<_>>(),
            "models": models,
            "gain": if integrates { Value::Null } else { self.ranged(|model| model.parameters.first().copied()) },
            "dead_time_s": self.ranged(|model| model.parameters.get(1).copied()),
            "ultimate": ultimate,
            "gains": gains,
            // In the form asked for, which may have no such gains.
            "lines": self.lines(form).and_then(Result::ok),
            "sensitivity": { "limit": self.limit, "proved_upper": self.proved.as_ref().map(|proved| proved.sensitivity) },
            "rules": rules,
            "curves": self.curves,
            "record": {
                "name": name,
                "columns": self.log.columns,
                "samples": self.found.samples,
                "changes": self.found.changes,
                "residual": self.found.residual,
                "interval_s": self.interval_s,
            },
            "version": env!("CARGO_PKG_VERSION"),
        })
    }

    pub(super) fn print(&self, form: GainForm, output: &mut impl Write) -> Result<(), CommandError> {
        match self.lines(form) {
            Some(Ok(lines)) => writeln!(output, "{lines}")?,
            Some(Err(reason)) => return Err(CommandError::Usage { reason: format!("--form: {reason}") }),
            None => writeln!(output, "no gains")?,
        }
        if let Some(proved) = &self.proved {
            writeln!(
                output,
                "\nproved: the sensitivity of every process of the confidence set is at most {}",
                significant(proved.sensitivity, 4)
            )?;
        }
        writeln!(output, "trust: {}", self.trust())?;
        for (code, text) in self.reasons() {
            writeln!(output, "  {code}: {text}")?;
        }
        writeln!(
            output,
            "\nprocess, with 95 % intervals, from {} samples and {} changes of the command",
            self.found.samples, self.found.changes
        )?;
        for model in &self.found.models {
            writeln!(output, "  {} ({} % of the evidence)", model.family.name(), significant(100.0 * model.weight, 3))?;
            for (name, one) in model.family.parameters().iter().zip(&model.parameters) {
                writeln!(output, "    {name:24}{}", Uncertain::between(one.value, one.low, one.high))?;
            }
        }
        writeln!(output, "\nrules of thumb on the likeliest process (parallel form)")?;
        writeln!(output, "  {:22}{:>12}{:>12}{:>12}{:>14}", "", "Kp", "Ki", "Kd", "sensitivity")?;
        for rule in &self.rules {
            let [p, i, d] = [rule.gains.proportional(), rule.gains.integral(), rule.gains.derivative()]
                .map(|gain| significant(self.sign() * gain, 4));
            let peak = rule.sensitivity.map_or_else(|| "not stable".to_owned(), |peak| significant(peak, 3));
            writeln!(output, "  {:22}{p:>12}{i:>12}{d:>12}{peak:>14}", rule.name)?;
        }
        Ok(())
    }
}
