//! `selfosc simulate`: a record of a relay experiment.

use std::io::Write;

use clap::Args;

use super::axis::AxisArguments;
use super::number::{number, whole};
use super::{CommandError, Outcome, write_json};
use crate::experiment::{Sensor, SimulatedExperiment};
use crate::numeric::domain::positive;
use crate::orbit::limit_cycle;

/// A record of a relay experiment as CSV: time_s,output,input.
///
/// The axis starts at rest at zero with the positive command. Its motion is in closed form between switchings.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc simulate --alpha 1 --beta-quadratic 0.5 --relay 1 --half-width 0.3 --delay 0.2 > log.csv
  selfosc simulate --alpha 1 --beta 1 --relay 1 --half-width 0.3 --hold --quantum 0.0175 --noise 0.005 --degrees")]
pub(super) struct Arguments {
    #[command(flatten)]
    axis: AxisArguments,
    /// Cycles of the limit cycle that the record lasts
    #[arg(long, value_parser = number, value_name = "N", default_value_t = 10.0, allow_negative_numbers = true)]
    cycles: f64,
    /// Samples per second
    #[arg(long, value_parser = number, value_name = "HZ", default_value_t = 10.0, allow_negative_numbers = true)]
    rate: f64,
    /// Readings are rounded to whole multiples of this, output units (with --degrees still radians)
    #[arg(long, value_parser = number, value_name = "Q", default_value_t = 0.0, allow_negative_numbers = true)]
    quantum: f64,
    /// Standard deviation of the noise on a reading before it is rounded, output units
    #[arg(long, value_parser = number, value_name = "SD", default_value_t = 0.0, allow_negative_numbers = true)]
    noise: f64,
    /// Samples the relay at the rate too, and holds its command in between
    #[arg(long)]
    hold: bool,
    /// Seed of the noise
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = 0, allow_negative_numbers = true)]
    seed: u64,
    /// Takes the output for radians and writes it in degrees, as a column heading_deg
    #[arg(long)]
    degrees: bool,
    /// Prints one JSON document with the three columns as arrays
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let (axis, relay) = (arguments.axis.axis()?, arguments.axis.relay()?);
    let cycles = positive("cycles", arguments.cycles, "")?;
    let duration_s = cycles * limit_cycle(&axis, &relay)?.period_s;
    let sensor = Sensor { delay_s: 0.0, quantum: arguments.quantum, noise: arguments.noise };
    let experiment =
        SimulatedExperiment::new(axis, relay, arguments.rate)?.with_sensor(sensor)?.with_seed(arguments.seed);
    let experiment = if arguments.hold { experiment.held() } else { experiment };
    let record = experiment.run(duration_s)?;
    let scale = if arguments.degrees { 1f64.to_degrees() } else { 1.0 };
    let name = if arguments.degrees { "heading_deg" } else { "output" };
    if arguments.json {
        let scaled: Vec<f64> = record.output().iter().map(|reading| reading * scale).collect();
        write_json(output, &serde_json::json!({ "time_s": record.time_s(), name: scaled, "input": record.input() }))?;
        return Ok(Outcome::Done);
    }
    writeln!(output, "time_s,{name},input")?;
    for ((time_s, reading), input) in record.time_s().iter().zip(record.output()).zip(record.input()) {
        writeln!(output, "{time_s},{},{input}", reading * scale)?;
    }
    Ok(Outcome::Done)
}
