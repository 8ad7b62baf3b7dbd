//! `selfosc simulate`: a record of a relay experiment.

use std::io::Write;
use std::time::{Duration, Instant};

use clap::Args;

use super::axis::{AxisArguments, RelayArguments};
use super::lines::{Event, Lines};
use super::number::{number, whole};
use super::{CommandError, Outcome, write_json};
use crate::experiment::{LiveVehicle, Sensor, SimulatedExperiment};
use crate::numeric::domain::positive;
use crate::orbit::limit_cycle;

/// A record of a relay experiment as CSV: time_s,output,input.
///
/// The axis starts at rest at zero with the positive command. Its motion is in closed form between switchings.
/// With --live the axis obeys standard input instead of a relay: it writes a line `time_s reading`, waits for a line `command`,
/// holds that command for one interval, and ends with standard input or once a second word of the line is not `running`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc simulate --alpha 1 --beta-quadratic 0.5 --relay 1 --half-width 0.3 --delay 0.2 > log.csv
  selfosc simulate --alpha 1 --beta 1 --relay 1 --half-width 0.3 --hold --quantum 0.0175 --noise 0.005 --degrees
  selfosc simulate --live --alpha 1 --beta 1 --delay 0.2 < commands | selfosc run ... > commands")]
pub(super) struct Arguments {
    #[command(flatten)]
    axis: AxisArguments,
    #[command(flatten)]
    relay: Option<RelayArguments>,
    /// The axis obeys the commands of standard input
    #[arg(long, conflicts_with_all = ["relay", "half_width", "cycles", "hold", "json"])]
    live: bool,
    /// With --live: readings come at their times, and a command that is late acts late
    #[arg(long, requires = "live", conflicts_with_all = ["relay", "half_width"])]
    real_time: bool,
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
    let axis = arguments.axis.axis()?;
    let sensor = Sensor { delay_s: 0.0, quantum: arguments.quantum, noise: arguments.noise };
    let (scale, name) = if arguments.degrees { (1f64.to_degrees(), "heading_deg") } else { (1.0, "output") };
    if arguments.live {
        let vehicle = LiveVehicle::new(axis, sensor, arguments.rate, arguments.seed)?;
        return obey(vehicle, scale, arguments.real_time, output);
    }
    let Some(relay) = &arguments.relay else {
        let reason = "--relay and --half-width are missing; give both, or --live for an axis that obeys standard input";
        return Err(CommandError::Usage { reason: reason.to_owned() });
    };
    let relay = relay.relay()?;
    let cycles = positive("cycles", arguments.cycles, "")?;
    let duration_s = cycles * limit_cycle(&axis, &relay)?.period_s;
    let experiment =
        SimulatedExperiment::new(axis, relay, arguments.rate)?.with_sensor(sensor)?.with_seed(arguments.seed);
    let experiment = if arguments.hold { experiment.held() } else { experiment };
    let record = experiment.run(duration_s)?;
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

/// Readings out and commands in, in turn; in real time the latest command counts.
fn obey(
    mut vehicle: LiveVehicle,
    unit: f64,
    real_time: bool,
    output: &mut impl Write,
) -> Result<Outcome, CommandError> {
    let (lines, begun) = (Lines::of_standard_input(), Instant::now());
    loop {
        let (time_s, reading) = vehicle.reading();
        writeln!(output, "{time_s} {}", reading * unit)?;
        output.flush()?;
        let due = begun + Duration::try_from_secs_f64(vehicle.time_s()).unwrap_or(Duration::MAX);
        loop {
            let line = match if real_time { lines.before(due) } else { lines.next() } {
                Event::Line(line) => line,
                Event::TimeOut => break,
                Event::End | Event::Signal => return Ok(Outcome::Done),
            };
            let mut words = line.split_whitespace();
            if let Some(command) = words.next().and_then(|word| word.parse().ok()) {
                vehicle.command(command);
            }
            if words.next().is_some_and(|phase| phase != "running") {
                return Ok(Outcome::Done);
            }
            if !real_time {
                break;
            }
        }
    }
}
