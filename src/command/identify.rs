//! `selfosc identify`: from logs to a model with its errors.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, ValueEnum};
use indicatif::ProgressBar;
use serde_json::{Map, Value, json};

use super::{CommandError, Outcome, write_json};
use crate::experiment::{Columns, ExperimentError, Log};
use crate::features::RecordFeatures;
use crate::identify::DragLaw;
use crate::identify::joint::{Delay, Estimate};
use crate::report::identification::{Identification, Method, Model, Refusal, Settings};

/// A vehicle's inertia, drag, disturbance and delay from logs of relay experiments, with 95 % intervals.
///
/// The model is alpha x'' + beta x' + beta_quadratic |x'| x' = u(t - delay) + delta. Several logs of one vehicle are fitted
/// at once: parameters are common, delta and the initial state each log's own. The fit takes any sampled input, also a
/// rate-limited rudder; the other methods need a relay and steady cycles. Exit status 1 for a record that is refused, with
/// the reason.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc identify log.csv
  selfosc identify log.csv --delay 0.2 --report report.html
  selfosc identify weak.csv strong.csv --delay estimate --json
  selfosc identify zigzag.csv --method fit --output yaw_deg --input rudder")]
pub(super) struct Arguments {
    /// Delimiter-separated text with a header
    #[arg(value_name = "LOG", required = true)]
    logs: Vec<PathBuf>,
    /// Column of times in s [default: the first of time_s, time, t]
    #[arg(long, value_name = "COL")]
    time: Option<String>,
    /// Column of the output [default: the first of heading_deg, yaw_deg, heading, yaw, depth_m, position_m, position, output, y]
    #[arg(long, value_name = "COL")]
    output: Option<String>,
    /// Column of the command [default: the first of command, input, u]
    #[arg(long, value_name = "COL")]
    input: Option<String>,
    /// Relay level C; a command logged in other units is scaled to it [default: as logged]
    #[arg(long, value_name = "C", value_parser = positive, allow_negative_numbers = true)]
    relay: Option<f64>,
    /// Level at which the command switched, output units (with --degrees still radians) [default: as logged]
    #[arg(long, value_name = "XA", value_parser = positive, allow_negative_numbers = true)]
    half_width: Option<f64>,
    /// Delay of the whole loop in s, or `estimate`
    #[arg(long, value_name = "S|estimate", default_value = "0", value_parser = delay, allow_negative_numbers = true)]
    delay: Delay,
    /// Drag law
    #[arg(long, default_value = "auto")]
    drag: Drag,
    /// How parameters are found
    #[arg(long, default_value = "all")]
    method: Method,
    /// The output is in degrees; a column ending in _deg always is. Every result is in radians
    #[arg(long)]
    degrees: bool,
    /// The output is an angle that jumps by a turn; a heading or yaw column always is
    #[arg(long)]
    wrap: bool,
    /// Writes one HTML file with figures, which needs no network
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

/// A drag law, or the question which.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Drag {
    /// Force proportional to speed
    Linear,
    /// Force proportional to speed squared
    Quadratic,
    /// The sum of both
    Mixed,
    /// The likeliest of the three
    Auto,
}

impl Drag {
    fn law(self) -> Option<DragLaw> {
        match self {
            Self::Linear => Some(DragLaw::Linear),
            Self::Quadratic => Some(DragLaw::Quadratic),
            Self::Mixed => Some(DragLaw::Mixed),
            Self::Auto => None,
        }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| value.is_finite() && *value > 0.0);
    value.ok_or_else(|| "must be a finite number above 0".to_owned())
}

fn delay(text: &str) -> Result<Delay, String> {
    if text == "estimate" {
        return Ok(Delay::Estimated);
    }
    let value = text.parse().ok().filter(|value: &f64| value.is_finite() && *value >= 0.0);
    value.map(Delay::KnownS).ok_or_else(|| "must be `estimate` or a finite number of seconds, 0 or more".to_owned())
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let settings = arguments.settings()?;
    // Drawn on standard error, and only where that is a terminal.
    let progress = ProgressBar::new_spinner();
    progress.enable_steady_tick(Duration::from_millis(100));
    let logs = arguments.read(output);
    let identify = |logs| Identification::of(logs, &settings, |stage| progress.set_message(stage));
    let found = logs.map(|logs| logs.and_then(identify));
    progress.finish_and_clear();
    let found = match found? {
        Ok(found) => found,
        Err(refusal) if arguments.json => {
            write_json(output, &refused(refusal.code(), &refusal))?;
            return Ok(Outcome::No);
        }
        Err(refusal) => {
            writeln!(output, "refused ({}): {refusal}", refusal.code())?;
            return Ok(Outcome::No);
        }
    };
    if let Some(path) = &arguments.report {
        let html = found.document().html()?;
        fs::write(path, html).map_err(|source| CommandError::Write { path: path.clone(), source })?;
    }
    if arguments.json {
        write_json(output, &document(&found))?;
    } else {
        show(&found, output)?;
        if let Some(path) = &arguments.report {
            writeln!(output, "\nreport in {}", path.display())?;
        }
    }
    Ok(Outcome::Done)
}

impl Arguments {
    fn settings(&self) -> Result<Settings, CommandError> {
        let usage = |reason| Err(CommandError::Usage { reason });
        let drag = self.drag.law();
        if !self.method.fits() {
            if drag == Some(DragLaw::Mixed) {
                return usage("only the fit knows mixed drag; use --method fit, or another --drag");
            }
            if self.delay == Delay::Estimated {
                return usage("only the fit estimates a delay; use --method fit or all, or give the delay in seconds");
            }
        }
        Ok(Settings {
            method: self.method,
            drag,
            delay: self.delay,
            relay_level: self.relay,
            half_width: self.half_width,
        })
    }

    /// Every log; the reason where one was read but holds no record.
    fn read(&self, output: &mut impl Write) -> Result<Result<Vec<(String, Log)>, Refusal>, CommandError> {
        let columns = Columns {
            time: self.time.clone(),
            output: self.output.clone(),
            input: self.input.clone(),
            degrees: self.degrees,
            wrap: self.wrap,
        };
        let mut logs = Vec::with_capacity(self.logs.len());
        for path in &self.logs {
            let name = path.display().to_string();
            let file = File::open(path).map_err(|source| CommandError::Read { path: path.clone(), source })?;
            match columns.read(file) {
                Ok(log) => logs.push((name, log)),
                Err(source) if is_bad_record(&source) => return Ok(Err(Refusal::Record { name, source })),
                Err(source) => return Err(self.unreadable(path, source, output)?),
            }
        }
        Ok(Ok(logs))
    }

    /// A script gets its document even where the status says unreadable.
    fn unreadable(
        &self,
        path: &Path,
        source: ExperimentError,
        output: &mut impl Write,
    ) -> Result<CommandError, CommandError> {
        let code = source.code();
        let error = CommandError::Log { path: path.to_owned(), source };
        if self.json {
            write_json(output, &refused(code, &error))?;
        }
        Ok(error)
    }
}

/// Whether the file was read, and what it holds makes no record.
fn is_bad_record(error: &ExperimentError) -> bool {
    !matches!(error, ExperimentError::Unreadable { line: 0, .. })
}

fn refused(code: &str, reason: &impl ToString) -> Value {
    json!({ "refused": { "code": code, "text": reason.to_string() } })
}

fn show(found: &Identification, output: &mut impl Write) -> Result<(), CommandError> {
    for source in &found.sources {
        writeln!(output, "{}\n", source.summary())?;
        if let Some(table) = source.feature_table() {
            writeln!(output, "{}", table.text())?;
        }
    }
    for table in found.model_tables() {
        writeln!(output, "{}", table.text())?;
    }
    writeln!(output, "{}", found.verdict())?;
    for caution in &found.cautions {
        writeln!(output, "warning: {}: {}", caution.code, caution.text)?;
    }
    Ok(())
}

fn document(found: &Identification) -> Value {
    let records: Vec<Value> = found
        .sources
        .iter()
        .map(|source| {
            json!({
                "file": source.name,
                "samples": source.log.record.samples(),
                "duration_s": source.log.record.duration_s(),
                "cycles_used": source.features.as_ref().map(|found| found.features.cycles),
                "features": source.features.as_ref().map(features),
            })
        })
        .collect();
    let used: Vec<u32> = found.sources.iter().filter_map(|s| Some(s.features.as_ref()?.features.cycles)).collect();
    let (drag, confidence) = match found.choice() {
        Some((law, confidence)) => (Some(law.map_or("undecided", DragLaw::name)), Some(confidence)),
        None => (found.law_given().map(DragLaw::name), None),
    };
    let probabilities: Option<Map<String, Value>> =
        found.fits.as_ref().filter(|_| confidence.is_some()).map(|fits| {
            DragLaw::ALL.iter().map(|law| (law.name().to_owned(), json!(fits.probability(*law)))).collect()
        });
    let warnings: Vec<Value> =
        found.cautions.iter().map(|caution| json!({ "code": caution.code, "text": caution.text })).collect();
    json!({
        "record": {
            "samples": found.sources.iter().map(|source| source.log.record.samples()).sum::<usize>(),
            "duration_s": found.sources.iter().map(|source| source.log.record.duration_s()).sum::<f64>(),
            "cycles_used": (!used.is_empty()).then(|| used.iter().sum::<u32>()),
        },
        "features": if let [source] = &found.sources[..] { json!(source.features.as_ref().map(features)) } else { Value::Null },
        "estimates": found.models.iter().map(model).collect::<Vec<_>>(),
        "choice": { "drag": drag, "confidence": confidence, "probabilities": probabilities },
        "warnings": warnings,
        "records": records,
    })
}

/// Means, with the spreads over cycles beside them.
fn features(found: &RecordFeatures) -> Value {
    let f = &found.features;
    let named = [
        ("amplitude", f.amplitude),
        ("bias", f.bias),
        ("period_s", f.period_s),
        ("switch_level", f.switch_level),
        ("time_positive_s", f.time_positive_s),
        ("time_negative_s", f.time_negative_s),
    ];
    let mut fields: Map<String, Value> = named.iter().map(|(name, s)| ((*name).to_owned(), json!(s.mean))).collect();
    fields.insert("relay".to_owned(), json!(found.relay.level));
    fields.insert("std".to_owned(), named.iter().map(|(name, s)| ((*name).to_owned(), json!(s.std))).collect());
    Value::Object(fields)
}

fn model(model: &Model) -> Value {
    let deltas: Vec<Value> = model.deltas.iter().map(|delta| estimate(Some(*delta))).collect();
    json!({
        "method": model.method.name(),
        "drag": model.drag.name(),
        "record": model.record,
        "alpha": estimate(Some(model.alpha)),
        "beta": estimate(model.beta),
        "beta_quadratic": estimate(model.beta_quadratic),
        "delta": if let [delta] = &deltas[..] { delta.clone() } else { Value::Null },
        "deltas": deltas,
        "delay_s": estimate(Some(model.delay_s)),
        "fit_percent": model.fit_percent,
        "residual_rms": model.residual_rms,
    })
}

fn estimate(estimate: Option<Estimate>) -> Value {
    let Some(Estimate { value, spread }) = estimate else { return Value::Null };
    json!({
        "value": value,
        "std": spread.map(|spread| spread.std),
        "low": spread.map(|spread| spread.low),
        "high": spread.map(|spread| spread.high),
    })
}
