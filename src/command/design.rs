//! `selfosc design`: which experiment to make.

use std::io::Write;
use std::num::NonZeroUsize;

use clap::Args;
use serde_json::json;

use super::axis::MotionArguments;
use super::number::{count, number};
use super::{CommandError, Outcome, refused, write_json};
use crate::experiment::Sensor;
use crate::identify::Delay;
use crate::identify::design::{DesignError, Deviations, Proposal, Run, Situation};
use crate::numeric::significant;
use crate::report::{Cell, Table};

/// Which relay level and half-width determine the inertia best, and which second level tells the drag laws apart.
///
/// From a rough model, a sensor and a time limit: expected standard deviations of an estimate that knows neither drag law nor
/// constant force nor, unless --delay-known, the delay; and whether the cycle would lock to the sampling. Exit status 1 where
/// no relay makes the rough model oscillate within the limits.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc design --alpha 1 --beta-quadratic 0.5 --delay 0.1 --level 1 --time 60 --quantum 0.0175
  selfosc design --alpha 0.03 --beta 0.02 --delay 0.2 --level 0.08 --time 120 --noise 0.005 --largest-amplitude 0.8 --json")]
pub(super) struct Arguments {
    #[command(flatten)]
    motion: MotionArguments,
    /// Constant disturbance, command units
    #[arg(long, value_parser = number, value_name = "D", default_value_t = 0.0, allow_negative_numbers = true)]
    delta: f64,
    /// Rough delay of the whole loop in s
    #[arg(long, value_parser = number, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    delay: f64,
    /// The delay will be known
    #[arg(long)]
    delay_known: bool,
    /// The largest relay level, command units
    #[arg(long, value_parser = number, value_name = "C", allow_negative_numbers = true)]
    level: f64,
    /// Length of one record in s
    #[arg(long, value_parser = number, value_name = "S", allow_negative_numbers = true)]
    time: f64,
    /// Samples per second, of sensor and relay
    #[arg(long, value_parser = number, value_name = "HZ", default_value_t = 10.0, allow_negative_numbers = true)]
    rate: f64,
    /// Step of the sensor, output units
    #[arg(long, value_parser = number, value_name = "Q", default_value_t = 0.0, allow_negative_numbers = true)]
    quantum: f64,
    /// Standard deviation of the noise on a reading, output units
    #[arg(long, value_parser = number, value_name = "SD", default_value_t = 0.0, allow_negative_numbers = true)]
    noise: f64,
    /// The largest amplitude allowed, output units: 0.8 rad keeps a heading within a quarter turn [default: any]
    #[arg(long, value_parser = number, value_name = "X", default_value_t = f64::INFINITY, hide_default_value = true, allow_negative_numbers = true)]
    largest_amplitude: f64,
    /// Proposals shown
    #[arg(long, value_parser = count, value_name = "N", default_value = "5", allow_negative_numbers = true)]
    proposals: NonZeroUsize,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let axis = arguments.motion.axis()?.with_disturbance(arguments.delta)?.with_delay_s(arguments.delay)?;
    let situation = Situation {
        axis,
        sensor: Sensor { delay_s: 0.0, quantum: arguments.quantum, noise: arguments.noise },
        rate_hz: arguments.rate,
        time_limit_s: arguments.time,
        largest_level: arguments.level,
        largest_amplitude: arguments.largest_amplitude,
        delay: if arguments.delay_known { Delay::KnownS(arguments.delay) } else { Delay::Estimated },
    };
    let mut proposals = match situation.experiments() {
        Ok(proposals) => proposals,
        Err(refusal @ DesignError::NoExperiment { .. }) => return refused(&refusal.into(), arguments.json, output),
        Err(error) => return Err(error.into()),
    };
    proposals.truncate(arguments.proposals.get());
    if arguments.json {
        write_json(output, &json!({ "proposals": proposals }))?;
        return Ok(Outcome::Done);
    }
    show(&proposals, output)
}

fn cell(value: f64, digits: usize) -> Cell {
    if value.is_finite() { Cell::Text(significant(value, digits)) } else { Cell::Missing }
}

fn row(table: Table, name: &str, run: &Run, std: &Deviations) -> Table {
    let run_shown = [run.relay_level, run.half_width, run.amplitude, run.period_s].map(|value| cell(value, 3));
    let deviations = [std.alpha, std.beta, std.beta_quadratic, std.delay_s].map(|value| cell(value, 2));
    table.row(
        [Cell::Text(name.to_owned())].into_iter().chain(run_shown).chain(deviations).chain([Cell::Flag(run.locks)]),
    )
}

fn show(proposals: &[Proposal], output: &mut impl Write) -> Result<Outcome, CommandError> {
    let columns = [
        "record",
        "level",
        "half-width",
        "amplitude",
        "period (s)",
        "std alpha",
        "std beta",
        "std beta_quadratic",
        "std delay (s)",
        "locks",
    ];
    let table = Table::new("design", "Experiments, the best for the inertia first", &columns);
    let table = proposals.iter().enumerate().fold(table, |table, (number, proposal)| {
        let table = row(table, &format!("{}", number + 1), &proposal.first, &proposal.first.std);
        match &proposal.second {
            Some(second) => row(table, "  with", &second.run, &second.together),
            None => table,
        }
    });
    writeln!(output, "{}", table.text())?;
    if proposals.iter().any(|proposal| proposal.first.locks || proposal.second.is_some_and(|second| second.run.locks)) {
        writeln!(
            output,
            "A cycle that locks to the sampling repeats its roundings, which then do not average: its standard deviations are lower bounds."
        )?;
    }
    if let Some(second) = proposals.first().and_then(|proposal| proposal.second.as_ref()) {
        writeln!(
            output,
            "Record 1 with level {} and half-width {} beside it: linear drag shows by {:.1}, quadratic drag by {:.1} \
             standard deviations. Standard deviations in a line `with` are those of both records.",
            significant(second.run.relay_level, 3),
            significant(second.run.half_width, 3),
            second.linear_needed,
            second.quadratic_needed,
        )?;
    }
    Ok(Outcome::Done)
}
