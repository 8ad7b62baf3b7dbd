//! The command `selfosc`: arguments in, answers out.
//!
//! Answers go to standard output, everything else to standard error. Exit status: 0 done, 1 the answer is no, 2 usage or
//! unreadable input.

mod autotune;
mod axis;
mod balance;
#[cfg(feature = "theory")]
mod certificates;
mod design;
mod df;
mod error;
mod existence;
mod files;
mod gain;
mod identify;
mod known;
mod lines;
mod log;
mod manual;
mod number;
mod orbits;
mod predict;
#[cfg(feature = "theory")]
mod reproduce;
mod run;
mod simulate;
mod suggestion;
mod terminal;
mod tune;
#[cfg(feature = "theory")]
mod verify;

use std::ffi::{OsStr, OsString};
use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};

use serde_json::json;

use crate::error::Error;
use crate::files::{LONGEST_WORD, cut};
use crate::numeric::OutOfDomain;
use error::CommandError;
use terminal::Shown;

/// Self-oscillations under a relay: the paper reproduced, its theory checked, vehicles identified.
#[derive(Debug, Parser)]
#[command(name = "selfosc", version, max_term_width = 100)]
#[command(
    after_help = "Start with:  selfosc identify LOG.csv   a vehicle under a relay\n             selfosc autotune LOG.csv   a heater, a tank, an axis\nExit status: 0 done, 1 the answer is no, 2 usage or unreadable input."
)]
struct Command {
    #[command(subcommand)]
    action: Action,
    /// When help and errors are coloured
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto, display_order = 900)]
    color: ColorChoice,
}

#[derive(Debug, Subcommand)]
enum Action {
    #[cfg(feature = "theory")]
    Reproduce(reproduce::Arguments),
    #[cfg(feature = "theory")]
    Verify(verify::Arguments),
    Df(df::Arguments),
    Balance(balance::Arguments),
    Predict(predict::Arguments),
    Simulate(simulate::Arguments),
    Design(design::Arguments),
    Run(run::Arguments),
    Identify(identify::Arguments),
    Tune(tune::Arguments),
    Autotune(autotune::Arguments),
    Completions(manual::Completions),
    Man(manual::Manual),
}

impl Action {
    fn run(&self, output: &mut impl Write) -> Result<Outcome, CommandError> {
        match self {
            #[cfg(feature = "theory")]
            Self::Reproduce(arguments) => reproduce::run(arguments, output),
            #[cfg(feature = "theory")]
            Self::Verify(arguments) => verify::run(arguments, output),
            Self::Df(arguments) => df::run(arguments, output),
            Self::Balance(arguments) => balance::run(arguments, output),
            Self::Predict(arguments) => predict::run(arguments, output),
            Self::Simulate(arguments) => simulate::run(arguments, output),
            Self::Design(arguments) => design::run(arguments, output),
            Self::Run(arguments) => run::run(arguments, output),
            Self::Identify(arguments) => identify::run(arguments, output),
            Self::Tune(arguments) => tune::run(arguments, output),
            Self::Autotune(arguments) => autotune::run(arguments, output),
            Self::Completions(arguments) => manual::completions(arguments, output),
            Self::Man(arguments) => manual::manual(arguments),
        }
    }
}

/// The outcome of a subcommand without error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Done.
    Done,
    /// Done, and the answer is no.
    No,
}

/// Reads the process's arguments, acts, and returns the exit status.
///
/// Does not return for `--help`, `--version` and unusable arguments: they end the process with status 0 or 2.
#[must_use]
pub fn run() -> ExitCode {
    crate::files::remove_on_signal();
    let (stdout, stderr) = (io::stdout(), io::stderr());
    let mut complaints = Shown { terminal: stderr.is_terminal(), to: stderr };
    let mut output = Shown { terminal: stdout.is_terminal(), to: io::BufWriter::new(stdout.lock()) };
    let outcome = match parsed(std::env::args_os().collect()) {
        Ok(command) => command.action.run(&mut output),
        Err(usage) if usage.use_stderr() => {
            let _ = usage.print();
            return ExitCode::from(2);
        }
        Err(help) => help.print().map(|()| Outcome::Done).map_err(CommandError::from),
    };
    match outcome.and_then(|outcome| output.flush().map(|()| outcome).map_err(CommandError::from)) {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::No) => ExitCode::from(1),
        // A reader that has seen enough, as `head` does, is no failure.
        Err(CommandError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(complaints, "selfosc: {error}");
            ExitCode::from(2)
        }
    }
}

/// The output of a subcommand, for a program that calls it without a process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Standard output.
    pub text: String,
    /// Whether the answer is no: exit status 1.
    pub no: bool,
}

/// Why a subcommand gives no answer: exit status 2.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Short name for scripts: the library's, or `usage`, `model`, `proof` or `files`.
    pub code: &'static str,
    /// Text of standard error.
    pub text: String,
    /// The number outside its domain, if that is the reason.
    pub out_of_domain: Option<OutOfDomain>,
}

impl Failure {
    fn usage(error: &clap::Error) -> Self {
        Self { code: "usage", text: error.to_string(), out_of_domain: None }
    }
}

impl From<CommandError> for Failure {
    fn from(error: CommandError) -> Self {
        Self { code: error.code(), text: error.to_string(), out_of_domain: error.out_of_domain().copied() }
    }
}

/// The answer to arguments as a shell would pass them, without the command's own name.
///
/// # Errors
/// [`Failure`] for unusable arguments and unreadable input, and for `--help`, whose text it has.
///
/// ```
/// let answer = selfosc::command::answer(["df", "relay", "--amplitude", "2", "--json"]).unwrap();
/// assert!(answer.text.contains("\"p\": 0.6366197723675814"));
/// assert_eq!(selfosc::command::answer(["df", "relay", "--amplitude", "-2"]).unwrap_err().code, "out-of-domain");
/// ```
pub fn answer<T: Into<OsString>>(arguments: impl IntoIterator<Item = T>) -> Result<Answer, Failure> {
    let arguments = std::iter::once("selfosc".into()).chain(arguments.into_iter().map(Into::into));
    let command = parsed(arguments.collect()).map_err(|error| Failure::usage(&error))?;
    let mut output = Vec::new();
    let outcome = command.action.run(&mut output)?;
    Ok(Answer { text: String::from_utf8_lossy(&output).into_owned(), no: outcome == Outcome::No })
}

/// The experiment that `selfosc run` makes of its arguments.
///
/// # Errors
/// As those of [`answer`].
///
/// ```
/// let protocol = ["--coordinate=heading-rad", "--relay=0.02", "--half-width=0.2", "--interval=0.1"];
/// let mut experiment = selfosc::command::experiment(protocol).unwrap();
/// assert_eq!(experiment.step(0.0, 0.0).command, 0.02);
/// ```
pub fn experiment<T: Into<OsString>>(
    arguments: impl IntoIterator<Item = T>,
) -> Result<crate::on_board::Experiment<f64>, Failure> {
    let arguments = ["selfosc".into(), "run".into()].into_iter().chain(arguments.into_iter().map(Into::into));
    let command = parsed(arguments.collect()).map_err(|error| Failure::usage(&error))?;
    match command.action {
        Action::Run(arguments) => arguments.experiment().map_err(Failure::from),
        _ => {
            let text = "must be flags of `selfosc run`; give no other subcommand".to_owned();
            Err(Failure { code: "usage", text, out_of_domain: None })
        }
    }
}

/// The command that these arguments ask for.
fn parsed(arguments: Vec<OsString>) -> Result<Command, clap::Error> {
    let mut parser = Command::command().color(wanted_color(&arguments));
    let matches = parser.try_get_matches_from_mut(&arguments);
    let found = matches.and_then(|mut matches| Command::from_arg_matches_mut(&mut matches));
    found.map_err(|mut error| {
        if error.kind() == ErrorKind::InvalidUtf8 {
            // Each with the flag before it.
            let wrong = arguments.windows(2).filter(|pair| pair[1].to_str().is_none());
            let said = |pair: &[OsString]| terminal::escaped(&pair.join(OsStr::new(" ")).to_string_lossy());
            let wrong: Vec<_> = wrong.map(said).collect();
            let text = format!("{}: must be UTF-8 unless it names a file; write it in UTF-8", wrong.join(", "));
            return parser.error(ErrorKind::InvalidUtf8, text);
        }
        let shown = |(kind, value): (ContextKind, &ContextValue)| match value {
            ContextValue::String(text) => Some((kind, terminal::escaped(&cut(text, LONGEST_WORD)))),
            _ => None,
        };
        for (kind, text) in error.context().filter_map(shown).collect::<Vec<_>>() {
            error.insert(kind, ContextValue::String(text));
        }
        error
    })
}

/// The choice of `--color`: help and errors of the parser are shown before the arguments are parsed.
fn wanted_color(given: &[OsString]) -> ColorChoice {
    let value =
        given.iter().enumerate().find_map(|(at, argument)| match argument.to_str()?.strip_prefix("--color")? {
            "" => given.get(at + 1)?.to_str(),
            rest => rest.strip_prefix('='),
        });
    value.and_then(|value| ColorChoice::from_str(value, false).ok()).unwrap_or(ColorChoice::Auto)
}

/// The answer no, with its reason.
fn refused(error: &Error, json: bool, output: &mut impl Write) -> Result<Outcome, CommandError> {
    if json {
        write_json(output, &json!({ "refused": { "code": error.code(), "text": error::in_context(error) } }))?;
    } else {
        writeln!(output, "refused ({}): {}", error.code(), error::in_context(error))?;
    }
    Ok(Outcome::No)
}

/// Writes a JSON document and a line end.
fn write_json(output: &mut impl Write, value: &impl serde::Serialize) -> Result<(), CommandError> {
    let text = serde_json::to_string_pretty(value).map_err(io::Error::from)?;
    writeln!(output, "{}", terminal::escaped_json(&text))?;
    Ok(())
}
