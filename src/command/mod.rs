//! The command `selfosc`: arguments in, answers out.
//!
//! Answers go to standard output, everything else to standard error. Exit status: 0 done, 1 the answer is no, 2 usage or
//! unreadable input.

mod axis;
mod balance;
mod certificates;
mod design;
mod df;
mod error;
mod files;
mod identify;
mod predict;
mod reproduce;
mod simulate;
mod terminal;
mod tune;
mod verify;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use error::CommandError;

/// Self-oscillations under a relay: the paper reproduced, its theory checked, vehicles identified.
#[derive(Debug, Parser)]
#[command(name = "selfosc", version, max_term_width = 100)]
#[command(
    after_help = "Start with:  selfosc reproduce\nExit status: 0 done, 1 the answer is no, 2 usage or unreadable input."
)]
struct Command {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    Reproduce(reproduce::Arguments),
    Verify(verify::Arguments),
    Df(df::Arguments),
    Balance(balance::Arguments),
    Predict(predict::Arguments),
    Simulate(simulate::Arguments),
    Design(design::Arguments),
    Identify(identify::Arguments),
    Tune(tune::Arguments),
}

/// What a subcommand found, when nothing went wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Done.
    Done,
    /// Done, and the answer is no.
    No,
}

/// Reads the process's arguments, acts, and says how it went.
///
/// Does not return for `--help`, `--version` and unusable arguments: they end the process with status 0 or 2.
#[must_use]
pub fn run() -> ExitCode {
    let command = Command::parse();
    let mut output = terminal::Shown(io::BufWriter::new(io::stdout().lock()));
    let outcome = match &command.action {
        Action::Reproduce(arguments) => reproduce::run(arguments, &mut output),
        Action::Verify(arguments) => verify::run(arguments, &mut output),
        Action::Df(arguments) => df::run(arguments, &mut output),
        Action::Balance(arguments) => balance::run(arguments, &mut output),
        Action::Predict(arguments) => predict::run(arguments, &mut output),
        Action::Simulate(arguments) => simulate::run(arguments, &mut output),
        Action::Design(arguments) => design::run(arguments, &mut output),
        Action::Identify(arguments) => identify::run(arguments, &mut output),
        Action::Tune(arguments) => tune::run(arguments, &mut output),
    };
    match outcome.and_then(|outcome| output.flush().map(|()| outcome).map_err(CommandError::from)) {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::No) => ExitCode::from(1),
        // A reader that has seen enough, as `head` does, is no failure.
        Err(CommandError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            drop(output);
            let _ = writeln!(terminal::Shown(io::stderr()), "selfosc: {error}");
            error.status()
        }
    }
}

/// Writes one JSON document and a line end.
fn write_json(output: &mut impl Write, value: &impl serde::Serialize) -> Result<(), CommandError> {
    serde_json::to_writer_pretty(&mut *output, value).map_err(io::Error::from)?;
    writeln!(output)?;
    Ok(())
}
