//! From the log of a relay experiment to a model: `cargo run --example pool_log LOG.csv`.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::io::Read;

use selfosc::identify::{Identification, Session};

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: pool_log LOG.csv")?;
    show(&Session::default().log(path)?.identify()?)
}

/// The same from any reader.
pub fn identify(log: impl Read) -> Result<(), Box<dyn std::error::Error>> {
    show(&Session::default().reader("log", log)?.identify()?)
}

/// Prints the answer, whether to trust it, and why not simply.
fn show(found: &Identification) -> Result<(), Box<dyn std::error::Error>> {
    for features in found.sources().iter().filter_map(|source| Some(source.features.as_ref()?.features)) {
        let (period_s, amplitude) = (features.period_s.mean, features.amplitude.mean);
        println!("{} cycles of {period_s:.2} s, amplitude {amplitude:.4}", features.cycles);
    }
    let answer = found.reported().ok_or("no fit to these records")?;
    println!("{} drag, trust: {}", answer.drag.name(), answer.trust.name());
    let parameters = [
        ("alpha", answer.alpha),
        ("beta", answer.beta),
        ("beta_quadratic", answer.beta_quadratic),
        ("delay_s", answer.delay_s),
        ("delta", answer.deltas[0]),
    ];
    for (name, estimate) in parameters {
        match estimate.spread {
            Some(spread) => println!("{name} {:.4}, 95 % from {:.4} to {:.4}", estimate.value, spread.low, spread.high),
            None => println!("{name} {:.4}", estimate.value),
        }
    }
    for reason in &answer.reasons {
        println!("{}: {reason}", reason.code());
    }
    for caution in found.cautions() {
        println!("warning: {}", caution.text);
    }
    Ok(())
}
