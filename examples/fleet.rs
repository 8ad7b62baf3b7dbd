//! Many records of many vehicles, on all cores: `cargo run --release --example fleet LOG.csv...`, or with a number for as many
//! simulated records.
//!
//! Each record is read, fitted and forgotten where a core is free, so that memory does not grow with their number.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::fs::File;

use rayon::prelude::*;

use selfosc::experiment::{Columns, Record, Sensor, SimulatedExperiment};
use selfosc::identify::{Delay, Method, Session, Settings};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::DragAxis;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    println!("record,trust,drag,alpha,low,high");
    match arguments.first().map_or(Ok(3), |first| first.parse::<u64>()) {
        Ok(count) => (0..count).into_par_iter().for_each(|number| print(&number.to_string(), simulated(number))),
        Err(_) => arguments.par_iter().for_each(|path| print(path, logged(path))),
    }
    Ok(())
}

/// One line for each record, in the order in which they are done.
fn print(name: &str, record: Result<Record, Failure>) {
    match record.and_then(identify) {
        Ok(found) => println!("{name},{found}"),
        Err(refused) => println!("{name},{refused},,,,"),
    }
}

fn identify(record: Record) -> Result<String, Failure> {
    let settings = Settings { method: Method::Fit, delay: Delay::KnownS(0.1), ..Settings::default() };
    let found = Session::new(settings).record("record", record).identify()?;
    let reported = found.reported().ok_or("no fit")?;
    let spread = reported.alpha.spread.ok_or("no interval")?;
    let (low, high) = (spread.low, spread.high);
    Ok(format!("{},{},{:.4},{low:.4},{high:.4}", reported.trust.name(), reported.drag.name(), reported.alpha.value))
}

fn logged(path: &str) -> Result<Record, Failure> {
    Ok(Columns::default().read(File::open(path)?)?.record)
}

/// A minute at 10 Hz, rounded to a degree.
#[allow(clippy::cast_precision_loss, reason = "a remainder")]
fn simulated(number: u64) -> Result<Record, Failure> {
    let axis = DragAxis::quadratic(0.5 + 0.01 * (number % 100) as f64, 0.5)?.with_delay_s(0.1)?;
    let sensor = Sensor { quantum: 1f64.to_radians(), ..Sensor::default() };
    let experiment = SimulatedExperiment::new(axis, RelayHysteresis::new(1.0, 0.3, 0.0)?, 10.0)?.held();
    Ok(experiment.with_sensor(sensor)?.with_seed(number).run(60.0)?)
}
