//! Scores an identification on simulated records: `cargo run --release -p selfosc-trust -- --records 100 --out spec/trust.md`.
//!
//! Records and scoring are the simulator's; each file beside this one binds one identification to them.

mod prediction_error;
mod reading;
mod single_law;

use clap::{Parser, ValueEnum};
use selfosc_simulator::answer::Answer;
use selfosc_simulator::kinds::Case;
use selfosc_simulator::score::{Selection, Table};

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// The identification to score.
    #[arg(long, value_enum, default_value_t = Tool::PredictionError)]
    tool: Tool,
    #[command(flatten)]
    selection: Selection,
}

#[derive(Clone, Copy, ValueEnum)]
enum Tool {
    /// Prediction errors of a Kalman filter, terms found and models averaged
    PredictionError,
    /// The likeliest of three drag laws by maximum likelihood, trusted unless a warning speaks against it
    SingleLaw,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Arguments { tool, selection } = Arguments::parse();
    let identify: fn(&Case) -> Answer = match tool {
        Tool::PredictionError => prediction_error::identify,
        Tool::SingleLaw => single_law::identify,
    };
    Table::of(&selection, identify)?.publish(&selection)?;
    Ok(())
}
