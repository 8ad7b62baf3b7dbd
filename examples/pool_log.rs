//! From the log of a relay experiment to a model: `cargo run --example pool_log LOG.csv`.
#![allow(clippy::print_stdout, reason = "an example shows its result")]

use std::io::Read;

use selfosc::identify::joint::Delay;
use selfosc::identify::{Identification, Session, Settings};

/// Runs it; an error is a failure.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("usage: pool_log LOG.csv")?;
    show(&session().log(path)?.identify()?)
}

/// The same from any reader.
pub fn identify(log: impl Read) -> Result<(), Box<dyn std::error::Error>> {
    show(&session().reader("log", log)?.identify()?)
}

fn session() -> Session {
    Session::new(Settings { delay: Delay::Estimated, ..Settings::default() })
}

/// Prints the likeliest drag law and its parameters.
fn show(found: &Identification) -> Result<(), Box<dyn std::error::Error>> {
    for features in found.sources().iter().filter_map(|source| Some(source.features.as_ref()?.features)) {
        let (period_s, amplitude) = (features.period_s.mean, features.amplitude.mean);
        println!("{} cycles of {period_s:.2} s, amplitude {amplitude:.4}", features.cycles);
    }
    let model = found.reported().ok_or("no fit to these records")?;
    println!("{} drag", model.drag.name());
    let parameters = [
        ("alpha", Some(model.alpha)),
        ("beta", model.beta),
        ("beta_quadratic", model.beta_quadratic),
        ("delay_s", Some(model.delay_s)),
        ("delta", model.delta()),
    ];
    for (name, estimate) in parameters {
        let Some(estimate) = estimate else { continue };
        match estimate.spread {
            Some(spread) => println!("{name} {:.4}, 95 % from {:.4} to {:.4}", estimate.value, spread.low, spread.high),
            None => println!("{name} {:.4}", estimate.value),
        }
    }
    for caution in found.cautions() {
        println!("warning: {}", caution.text);
    }
    Ok(())
}
