//! From the log of a relay experiment to a model: `cargo run --example pool_log LOG.csv`.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::fs::File;
use std::io::Read;

use selfosc::experiment::Columns;
use selfosc::features::RecordFeatures;
use selfosc::identify::joint::{Delay, Parameter};
use selfosc::identify::select::likelihood::Choice;

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: pool_log LOG.csv")?;
    identify(File::open(path)?)
}

/// Prints the likeliest drag law and its parameters.
pub fn identify(log: impl Read) -> Result<(), Box<dyn std::error::Error>> {
    let record = Columns::default().read(log)?.record;
    let features = RecordFeatures::of(&record)?.features;
    println!("{} cycles of {:.2} s, amplitude {:.4}", features.cycles, features.period_s.mean, features.amplitude.mean);

    let choice = Choice::among_all(&[&record], Delay::Estimated)?;
    let fit = choice.likeliest();
    println!("{} drag, probability {:.3}", fit.law().name(), choice.probability(fit.law()));
    for parameter in [Parameter::Alpha, Parameter::LinearDrag, Parameter::QuadraticDrag, Parameter::DelayS] {
        let estimate = fit.estimate(parameter);
        if let Some(spread) = estimate.spread {
            println!("{parameter:?} {:.4}, 95 % from {:.4} to {:.4}", estimate.value, spread.low, spread.high);
        }
    }
    Ok(())
}
