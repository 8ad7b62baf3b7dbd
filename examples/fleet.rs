//! Many records of many vehicles, on all cores: `cargo run --release --example fleet LOG.csv...`, or with a number for as many
//! simulated records.
//!
//! Each record is read, fitted and forgotten where a core is free, so that memory does not grow with their number.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::fs::File;

use rayon::prelude::*;

use selfosc::experiment::{Columns, Record, Sensor, SimulatedExperiment};
use selfosc::identify::joint::{Delay, Parameter};
use selfosc::identify::select::likelihood::Choice;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::DragAxis;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    println!("record,drag,probability,alpha,std");
    match arguments.first().map_or(Ok(3), |first| first.parse::<u64>()) {
        Ok(count) => (0..count).into_par_iter().for_each(|number| print(&number.to_string(), simulated(number))),
        Err(_) => arguments.par_iter().for_each(|path| print(path, logged(path))),
    }
    Ok(())
}

/// One line for each record, in the order in which they are done.
fn print(name: &str, record: Result<Record, Failure>) {
    match record.and_then(|record| identify(&record)) {
        Ok(found) => println!("{name},{found}"),
        Err(refused) => println!("{name},{refused},,,"),
    }
}

fn identify(record: &Record) -> Result<String, Failure> {
    let choice = Choice::among_all(&[record], Delay::KnownS(0.1))?;
    let fit = choice.likeliest();
    let (law, alpha) = (fit.law(), fit.estimate(Parameter::Alpha));
    let std = alpha.spread.map_or_else(String::new, |spread| format!("{:.4}", spread.std));
    Ok(format!("{},{:.3},{:.4},{std}", law.name(), choice.probability(law), alpha.value))
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
