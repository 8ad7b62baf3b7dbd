//! `selfosc identify`: from logs to a model with its errors.

use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use indicatif::ProgressBar;

use super::error::Given;
use super::log::LogArguments;
use super::number::{count, finite, non_negative, positive, whole};
use super::{CommandError, Outcome, files, refused, write_json};
use crate::experiment::Columns;
use crate::files::{FileError, Files, Input};
use crate::identify::document::RefusalDocument;
use crate::identify::{
    Assumptions, Delay, DragLaw, ErrorSource, Identification, Method, Refusal, Session, Settings, Stage,
};
use crate::report::identification as page;

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
  selfosc identify weak.csv strong.csv --json
  selfosc identify log.csv --assume heading-error=1
  selfosc identify log.csv --method bounded --delay 0.2
  selfosc identify zigzag.csv --method fit --output yaw_deg --input rudder")]
pub(super) struct Arguments {
    /// Delimiter-separated text with a header; - is standard input
    #[arg(value_name = "LOG", required = true)]
    logs: Vec<PathBuf>,
    /// Column of times in s [default: the first of time_s, time, t, timestamp, also with _ms, _us or _ns]
    #[arg(long, value_name = "COL")]
    time: Option<String>,
    /// Column of the output [default: the first of heading_deg, yaw_deg, heading, yaw, depth_m, position_m, position, output, y, depth, temperature]
    #[arg(long, value_name = "COL")]
    output: Option<String>,
    /// Column of the command [default: the first of command, input, u, pwm, duty]
    #[arg(long, value_name = "COL")]
    input: Option<String>,
    #[command(flatten)]
    reading: LogArguments,
    /// Relay level C; a command logged in other units is scaled to it [default: as logged]
    #[arg(long, value_name = "C", value_parser = positive, allow_negative_numbers = true)]
    relay: Option<f64>,
    /// Level at which the command switched, output units (with --degrees still radians) [default: as logged]
    #[arg(long, value_name = "XA", value_parser = positive, allow_negative_numbers = true)]
    half_width: Option<f64>,
    /// Delay of the whole loop in s, or `estimate`; one that is given is checked
    #[arg(long, value_name = "S|estimate", default_value = "estimate", value_parser = delay, allow_negative_numbers = true)]
    delay: Delay,
    /// Drag law
    #[arg(long, default_value = "auto", value_parser = law())]
    drag: Law,
    /// How parameters are found
    #[arg(long, default_value = "all")]
    method: Method,
    /// Take a log of any manoeuvre: the answer is doubtful, or widened where the command moves the vehicle through two cycles
    #[arg(long)]
    any_input: bool,
    /// Size of a source of error that no residual shows, of the practical intervals, or `none` for no source: sensor-gain (%)
    /// [default: 0.5], clock (%) [0.25], heading-error (degrees, of headings) [0.333], thrust-dynamics (%) [1]
    #[arg(long, value_name = "NAME=SIZE|none", value_parser = assumption, allow_negative_numbers = true)]
    assume: Vec<Assumption>,
    /// Bounded: largest error of a reading beside its rounding, output units (with --degrees still radians)
    #[arg(long, value_name = "E", default_value_t = 0.0, value_parser = non_negative, allow_negative_numbers = true)]
    error: f64,
    /// Bounded: step of the sensor, output units (with --degrees still radians) [default: found in the record]
    #[arg(long, value_name = "Q", value_parser = positive, allow_negative_numbers = true)]
    quantum: Option<f64>,
    /// Bounded: largest error of a stamp, in s, of every row, those in which the command changes among them
    #[arg(long, value_name = "T", default_value_t = 0.0, value_parser = non_negative, allow_negative_numbers = true)]
    jitter: f64,
    /// Bounded: so many readings may be in error by any amount, whichever they are
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<usize>, allow_negative_numbers = true)]
    outliers: usize,
    /// Bounded: work that may be spent, counted in passes over the records; of 600 samples 3000 take some 10 s,
    /// 600 some 2 s [default: 3000]
    #[arg(long, value_name = "PASSES", value_parser = count, allow_negative_numbers = true)]
    budget: Option<NonZeroUsize>,
    /// Bounded: the model has a restoring force proportional to the coordinate
    #[arg(long)]
    stiffness: bool,
    /// Bounded: the force follows the command with a first-order lag, of at most a quarter of the mean time between
    /// switchings
    #[arg(long)]
    lag: bool,
    /// Bounded: the drag has a part proportional to the cube of speed
    #[arg(long)]
    cubic: bool,
    /// Bounded: the part of the drag proportional to speed may drive
    #[arg(long)]
    either_sign: bool,
    /// Bounded: writes the proof to this file, which `selfosc verify --check FILE` checks without a search
    #[arg(long, value_name = "FILE", conflicts_with = "outliers")]
    certificate: Option<PathBuf>,
    /// The output is in degrees; a column ending in _deg always is. Every result is in radians
    #[arg(long)]
    degrees: bool,
    /// The output is in radians, whatever its column looks like
    #[arg(long, conflicts_with = "degrees")]
    radians: bool,
    /// The output is an angle that jumps by a turn; a heading or yaw column always is
    #[arg(long)]
    wrap: bool,
    /// The command that does nothing, as logged; it is taken off [default: 0]
    #[arg(long, value_name = "U", value_parser = finite, allow_negative_numbers = true)]
    neutral: Option<f64>,
    /// The command is logged with the opposite sign
    #[arg(long)]
    invert: bool,
    /// Logs that are predicted and take no part in the estimate; where an answer explains less than half of the variance of one, it is
    /// doubtful
    #[arg(long, value_name = "LOG", num_args = 1..)]
    validate: Vec<PathBuf>,
    /// Writes one HTML file with figures, which needs no network
    #[arg(long, value_name = "OUT.html")]
    report: Option<PathBuf>,
    /// Writes the samples with the reported model's outputs and its residuals as CSV, angles in rad
    #[arg(long, value_name = "OUT.csv")]
    samples: Option<PathBuf>,
    /// Says each stage in a line on standard error
    #[arg(long)]
    progress: bool,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

/// A drag law, or the question which.
type Law = Option<DragLaw>;

fn law() -> impl TypedValueParser<Value = Law> {
    let named = [
        ("linear", "Force proportional to speed"),
        ("quadratic", "Force proportional to speed squared"),
        ("mixed", "The sum of both"),
        ("auto", "The likeliest of the three"),
    ];
    PossibleValuesParser::new(named.map(|(name, help)| PossibleValue::new(name).help(help)))
        .map(|given| DragLaw::ALL.into_iter().find(|law| law.name() == given))
}

fn delay(text: &str) -> Result<Delay, String> {
    if text == "estimate" {
        return Ok(Delay::Estimated);
    }
    non_negative(text).map(Delay::KnownS).map_err(|why| format!("{why}, or `estimate`"))
}

/// A source of error and its size; without one, no source at all.
type Assumption = Option<(ErrorSource, f64)>;

fn assumption(text: &str) -> Result<Assumption, String> {
    if text == "none" {
        return Ok(None);
    }
    let names = ErrorSource::ALL.map(ErrorSource::name).join(", ");
    let (name, size) =
        text.split_once('=').ok_or_else(|| format!("must be NAME=SIZE or `none`; NAME is one of {names}"))?;
    let source = ErrorSource::ALL.into_iter().find(|source| source.name() == name);
    let source = source.ok_or_else(|| {
        format!("`{name}` is no source of error: NAME must be one of {names}; `none` is for no source")
    })?;
    non_negative(size).map(|size| Some((source, size)))
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let mut known = Files::default();
    let read = |known: &mut Files, paths: &[PathBuf]| -> Result<Vec<Input>, FileError> {
        paths.iter().map(|path| files::input(known, path, Columns::LONGEST)).collect()
    };
    let logs = match read(&mut known, &arguments.logs) {
        Ok(logs) => logs,
        Err(error) => return arguments.refuse(error.into(), output),
    };
    let validation = read(&mut known, &arguments.validate).given("--validate")?;
    let report = arguments.report.as_ref().map(|path| known.output(path)).transpose().given("--report")?;
    let certificate =
        arguments.certificate.as_ref().map(|path| known.output(path)).transpose().given("--certificate")?;
    let samples = arguments.samples.as_ref().map(|path| known.output(path)).transpose().given("--samples")?;
    let found = match arguments.identify(&logs, &validation) {
        Ok(found) => found,
        Err(refusal) => return arguments.refuse(refusal, output),
    };
    if let Some(report) = report {
        let document = page::document(&found).from_where(files::provenance(&known));
        report.write(document.html()?.as_bytes()).given("--report")?;
    }
    if let Some(samples) = samples {
        samples.write(page::samples(&found).as_bytes()).given("--samples")?;
    }
    let proof = found.bounded().and_then(|bounded| bounded.certificate());
    let written = match (certificate, proof) {
        (Some(certificate), Some(Ok(proof))) => {
            certificate.write(proof.to_string().as_bytes()).given("--certificate")?;
            arguments.certificate.as_ref().map(Ok)
        }
        (_, Some(Err(unproved))) => Some(Err(unproved)),
        _ => None,
    };
    if arguments.json {
        write_json(output, &found.conclusion())?;
    } else {
        show(&found, output)?;
        if let Some(path) = &arguments.report {
            writeln!(output, "\nreport in {}", path.display())?;
        }
        if let Some(Ok(path)) = written {
            writeln!(output, "\nproof in {}", path.display())?;
        }
    }
    match written {
        Some(Err(unproved)) => Err(CommandError::Proof { reason: unproved.to_string() }),
        _ => Ok(Outcome::Done),
    }
}

impl Arguments {
    fn identify(&self, logs: &[Input], validation: &[Input]) -> Result<Identification, Refusal> {
        let settings = self.settings();
        settings.check()?;
        // Drawn on standard error, and only where that is a terminal.
        let progress = if self.progress { ProgressBar::hidden() } else { ProgressBar::new_spinner() };
        if !progress.is_hidden() {
            // By a thread, which a browser has not.
            progress.enable_steady_tick(Duration::from_millis(100));
        }
        let say =
            |stage: Stage| if self.progress { eprintln!("{stage}") } else { progress.set_message(stage.to_string()) };
        let session = Session::new(settings).with_columns(self.columns());
        let session = logs.iter().try_fold(session, |session, log| session.reader(log.name(), log.bytes()));
        let session = session.and_then(|session| {
            validation.iter().try_fold(session, |session, log| session.validation_reader(log.name(), log.bytes()))
        });
        let found = session.and_then(|session| session.identify_with(say));
        progress.finish_and_clear();
        found
    }

    fn settings(&self) -> Settings {
        Settings {
            method: self.method,
            drag: self.drag,
            delay: self.delay,
            relay_level: self.relay,
            half_width: self.half_width,
            error: self.error,
            quantum: self.quantum,
            jitter_s: self.jitter,
            outliers: self.outliers,
            budget: self.budget,
            stiffness: self.stiffness,
            lag: self.lag,
            cubic: self.cubic,
            either_sign: self.either_sign,
            certificate: self.certificate.is_some(),
            any_input: self.any_input,
            assume: self.assume.iter().fold(Assumptions::default(), |sizes, given| match given {
                Some((source, size)) => sizes.with(*source, *size),
                None => Assumptions::NONE,
            }),
        }
    }

    fn columns(&self) -> Columns {
        self.reading.of(Columns {
            time: self.time.clone(),
            output: self.output.clone(),
            input: self.input.clone(),
            neutral: self.neutral,
            invert: self.invert,
            radians: self.radians,
            degrees: self.degrees,
            wrap: self.wrap,
            ..Columns::default()
        })
    }

    fn refuse(&self, refusal: Refusal, output: &mut impl Write) -> Result<Outcome, CommandError> {
        if matches!(refusal, Refusal::Settings(_)) {
            return Err(refusal.into());
        }
        // A script gets its document even where the status says unreadable.
        if self.json {
            write_json(output, &RefusalDocument::from(&refusal))?;
        }
        if refusal.is_usage() {
            return Err(refusal.into());
        }
        if self.json { Ok(Outcome::No) } else { refused(&refusal.into(), false, output) }
    }
}

fn show(found: &Identification, output: &mut impl Write) -> Result<(), CommandError> {
    for source in found.sources() {
        writeln!(output, "{}\n", page::summary(source))?;
        if let Some(table) = page::feature_table(source) {
            writeln!(output, "{}", table.text())?;
        }
    }
    for table in page::method_tables(found).into_iter().chain(page::answer_tables(found)) {
        writeln!(output, "{}", table.text())?;
    }
    if let Some(bounded) = found.bounded() {
        for table in page::bounds_tables(found, bounded) {
            writeln!(output, "{}", table.text())?;
        }
        writeln!(output, "{}", page::bounds_verdict(bounded))?;
    } else {
        writeln!(output, "{}", page::verdict(found))?;
    }
    for reason in page::reasons(found) {
        writeln!(output, "{}: {}", reason.code, reason.text)?;
    }
    for refused in found.refused() {
        writeln!(output, "no model by {} ({}): {}", refused.method, refused.code, refused.text)?;
    }
    for caution in found.cautions() {
        writeln!(output, "warning: {}: {}", caution.code, caution.text)?;
    }
    Ok(())
}
