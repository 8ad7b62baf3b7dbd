//! `selfosc run`: the experiment on board as a coprocess.

mod display;
mod flags;

use std::fs::File;
use std::io::{IsTerminal, Write, stderr};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::{Value, json};

use super::error::Given;
use super::lines::{Event, Lines};
use super::number::positive;
use super::{CommandError, Outcome};
use crate::experiment::Columns;
use crate::files::{Files, Output};
use crate::identify::document::{RefusalDocument, UnitNames};
use crate::identify::{DragLaw, Session, Settings};
use crate::on_board::{Coordinate, Experiment, Phase, Protocol, Step};
use crate::report::Uncertain;
use display::Display;
use flags::{ProtocolArguments, in_words};

/// Runs a relay experiment for any program that reads a sensor and drives an actuator.
///
/// Reads lines `time_s reading` from standard input and answers each with a line `command phase`; the phase is running, done, aborted
/// or failed:CODE. The same state machine runs on board: it watches sensor and clock, finds steady cycles and ends at the
/// neutral command. So does the end of standard input, SIGINT, SIGTERM, and a time-out without a reading: a last line says
/// so. A line that holds no two numbers counts as a reading that is no number. Then the vehicle is identified from the record.
/// Exit status 1 where the experiment is not done or the record is refused.
#[derive(Debug, Args)]
#[command(after_help = "\
Example, a simulated vehicle at the other end (a bridge to an autopilot takes its place):
  mkfifo commands
  selfosc simulate --live --alpha 0.03 --beta 0.02 --delay 0.1 < commands |
    selfosc run --coordinate heading-rad --relay 0.02 --half-width 0.2 --interval 0.1 --log log.csv --json model.json > commands
  selfosc tune --model model.json --bandwidth 0.8")]
pub(super) struct Arguments {
    #[command(flatten)]
    protocol: ProtocolArguments,
    /// Time without a line after which the experiment fails, s on this computer's clock [default: 4 intervals, at least 1 s]
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    timeout: Option<f64>,
    /// Writes each sample to this file as it comes; `selfosc identify` reads it
    #[arg(long, value_name = "LOG.csv")]
    log: Option<PathBuf>,
    /// Writes the outcome and the identified model as one JSON document to this file; without a name, as the last line of standard output
    #[arg(long, value_name = "RESULT.json", num_args = 0..=1)]
    json: Option<Option<PathBuf>>,
    /// Shows coordinate, command, cycles and the running estimate on standard error
    #[arg(long)]
    watch: bool,
}

/// The samples so far as a log, in memory and in the file.
struct LiveLog {
    text: String,
    file: Option<File>,
}

impl LiveLog {
    fn new(coordinate: Coordinate, file: Option<File>) -> Self {
        let mut samples = Self { text: String::new(), file };
        samples.line(&format!("time_s,{},input\n", coordinate.column()));
        samples
    }

    /// A log that cannot be written does not stop an experiment: the record is in memory, too.
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        if self.file.as_mut().is_some_and(|file| file.write_all(line.as_bytes()).is_err()) {
            self.file = None;
            let _ = writeln!(
                stderr(),
                "selfosc: --log: cannot write on; the experiment goes on without a log: free the disk"
            );
        }
    }
}

/// Time and reading of a line. What is missing or no number is NaN, which the experiment calls a fault.
fn sample(line: &str) -> [f64; 2] {
    let mut words = line.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN));
    let sample = [words.next().unwrap_or(f64::NAN), words.next().unwrap_or(f64::NAN)];
    if words.next().is_some() { [f64::NAN; 2] } else { sample }
}

impl Arguments {
    /// What the flags of the protocol make.
    pub(super) fn experiment(&self) -> Result<Experiment<f64>, CommandError> {
        self.protocol.experiment()
    }
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let mut experiment = arguments.experiment()?;
    let protocol = *experiment.protocol();
    let mut files = Files::default();
    let log = arguments.log.as_ref().map(|path| files.output(path)).transpose().given("--log")?;
    let json = arguments.json.as_ref().and_then(Option::as_ref);
    let document = json.map(|path| files.output(path)).transpose().given("--json")?;
    let log = log.map(Output::stream).transpose().given("--log")?;
    let longest_s = (Protocol::<f64>::LONGEST_GAP * protocol.interval_s).max(1.0);
    let wait = Duration::try_from_secs_f64(arguments.timeout.unwrap_or(longest_s)).unwrap_or(Duration::MAX);
    let mut samples = LiveLog::new(protocol.coordinate, log);
    let mut display = arguments.watch.then(|| Display::new(&protocol, stderr().is_terminal()));

    let lines = Lines::of_standard_input();
    // The last reading's time, and when the next has to be there: comments and empty lines are none.
    let (mut last_s, mut due) = (None, None);
    while experiment.phase() == Phase::Running {
        let event = due.map_or_else(|| lines.next(), |due| lines.before(due));
        let step = match event {
            Event::Line(line) if line.is_empty() || line.starts_with('#') => continue,
            Event::Line(line) => {
                let [time_s, reading] = sample(&line);
                let step = experiment.step(reading, time_s);
                (last_s, due) = (Some(time_s), Instant::now().checked_add(wait));
                if let Some(position) = experiment.position().filter(|_| step.phase == Phase::Running) {
                    samples.line(&format!("{time_s},{position},{}\n", step.command));
                    if let Some(display) = &mut display {
                        display.sample(&experiment, [time_s, position, step.command]);
                    }
                }
                step
            }
            Event::TimeOut => {
                // The caller's patience ends before that of the protocol may: a gap all the same.
                let silent_s = wait.as_secs_f64().max(2.0 * Protocol::<f64>::LONGEST_GAP * protocol.interval_s);
                experiment.tick(last_s.unwrap_or(0.0) + silent_s)
            }
            Event::End | Event::Signal => {
                experiment.abort();
                Step { command: experiment.command(), phase: experiment.phase() }
            }
        };
        let told = writeln!(output, "{} {}", step.command, step.phase).and_then(|()| output.flush());
        if told.is_err() {
            // Nobody drives the actuator any more; the record stays.
            experiment.abort();
        }
    }
    if let Some(display) = &mut display {
        display.end(&experiment);
    }
    let (content, done) = conclusion(&experiment, &protocol, &samples.text);
    report(&experiment, &content);
    match (document, &arguments.json) {
        (Some(document), _) => document.write(format!("{content:#}\n").as_bytes()).given("--json")?,
        (None, Some(_)) => writeln!(output, "{content}")?,
        (None, None) => {}
    }
    Ok(if done { Outcome::Done } else { Outcome::No })
}

/// The outcome of the experiment beside the document of `identify --json`, and whether both are there.
fn conclusion(experiment: &Experiment<f64>, protocol: &Protocol<f64>, log: &str) -> (Value, bool) {
    let columns = Columns { neutral: Some(protocol.neutral_command), ..Columns::default() };
    let session = Session::new(Settings::default()).with_columns(columns).reader("the experiment", log.as_bytes());
    let (mut content, identified) = match session.and_then(Session::identify) {
        Ok(found) => (json!(found.conclusion()), found.reported().is_some()),
        Err(refusal) => {
            let mut document = RefusalDocument::from(&refusal);
            // The remedies of a log that is read do not help one that is made.
            let fault = document.refused.text.split("; ").next().unwrap_or_default();
            document.refused.text = format!(
                "{fault}; let the experiment run to its end, or longer (--duration), or read its log (--log) by `selfosc identify`"
            );
            (json!(document), false)
        }
    };
    let outcome = experiment.outcome();
    let fault = match experiment.phase() {
        Phase::Failed(fault) => json!({ "code": fault.code(), "text": in_words(fault) }),
        _ => Value::Null,
    };
    let exact = outcome.iter().flat_map(|outcome| {
        [DragLaw::Linear, DragLaw::Quadratic].into_iter().filter_map(|law| {
            let axis = outcome.exact(law, 0.0).ok()?;
            Some(json!({
                "drag": law.name(),
                "alpha": axis.alpha(),
                "beta": axis.linear_drag(),
                "beta_quadratic": axis.quadratic_drag(),
                // From the neutral command, as that of `reported`.
                "delta": axis.disturbance() - protocol.relay_offset,
            }))
        })
    });
    content["experiment"] = json!({
        "phase": experiment.phase().to_string(),
        "fault": fault,
        "attempts": experiment.attempt(),
        "units": UnitNames::with_output(protocol.coordinate.angle_unit().unwrap_or("output")),
        "outcome": outcome,
        "exact": exact.collect::<Vec<_>>(),
    });
    (content, identified && outcome.is_some())
}

/// How it ended, for a person: standard output belongs to the actuator.
fn report(experiment: &Experiment<f64>, content: &Value) {
    let why = match experiment.phase() {
        Phase::Failed(fault) => format!(": {}", in_words(fault)),
        _ => String::new(),
    };
    let model = match content["reported"].as_object() {
        Some(model) => {
            let alpha = &model["alpha"];
            let [value, low, high] = [&alpha["value"], &alpha["combined"]["low"], &alpha["combined"]["high"]]
                .map(|part| part.as_f64().unwrap_or(f64::NAN));
            let trust = model["trust"].as_str().unwrap_or("-");
            format!("inertia {} (practical, 95 %); trust: {trust}", Uncertain::between(value, low, high))
        }
        None => format!("no model: {}", content["refused"]["text"].as_str().unwrap_or("no method answers")),
    };
    let _ = writeln!(stderr(), "{}{why}\n{model}", experiment.phase());
}
