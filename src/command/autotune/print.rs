//! The answer for a person, and as a document.

use std::io::Write;

use serde_json::{Value, json};

use super::form::Form;
use super::{Autotuned, CommandError};
use crate::numeric::significant;

impl Autotuned {
    pub(super) fn json(&self, name: &str) -> Value {
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
        let gains = self.proved.map(|proved| {
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
            "sensitivity": { "limit": self.limit, "proved_upper": self.proved.map(|proved| proved.sensitivity) },
            "rules": rules,
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

    pub(super) fn print(&self, form: Form, output: &mut impl Write) -> Result<(), CommandError> {
        let input = self.log.record.input();
        let range =
            input.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b)) - input.iter().fold(f64::INFINITY, |a, b| a.min(*b));
        match &self.proved {
            Some(proved) => {
                match form.lines(&proved.gains, self.sign(), range, self.interval_s) {
                    Ok(lines) => writeln!(output, "{lines}")?,
                    Err(reason) => return Err(CommandError::Usage { reason: format!("--form: {reason}") }),
                }
                writeln!(
                    output,
                    "\nproved: the sensitivity of every process that the record leaves is at most {}",
                    significant(proved.sensitivity, 4)
                )?;
            }
            None => writeln!(output, "no gains")?,
        }
        writeln!(output, "trust: {}", self.trust())?;
        for (code, text) in self.reasons() {
            writeln!(output, "  {code}: {text}")?;
        }
        writeln!(
            output,
            "\nprocess, from {} samples and {} changes of the command",
            self.found.samples, self.found.changes
        )?;
        for model in &self.found.models {
            writeln!(output, "  {} ({} % of the evidence)", model.family.name(), significant(100.0 * model.weight, 3))?;
            for (name, one) in model.family.parameters().iter().zip(&model.parameters) {
                writeln!(
                    output,
                    "    {name:24}{:>12} +- {}",
                    significant(one.value, 5),
                    significant(1.96 * one.std, 2)
                )?;
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
