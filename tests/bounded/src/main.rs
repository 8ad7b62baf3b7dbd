//! Scores guaranteed bounds on simulated records: `cargo run --release -p selfosc-bounded -- --records 100 --out spec/bounded-figures.md`.
//!
//! Records, truth and the width to compare with are the simulator's, which shares no code with what is scored.

mod case;
mod table;

use clap::Parser;
use rayon::prelude::*;
use selfosc::identify::bounded::BoundedModel;
use selfosc_simulator::kinds::Kind;

use case::{Outcome, Terms};
use table::Table;

#[derive(Parser)]
#[command(about = "Scores guaranteed bounds on simulated records")]
struct Arguments {
    /// Cases of each kind.
    #[arg(long, default_value_t = 10)]
    records: u64,
    /// First seed. Seeds from 1000000 on are for reports: never develop on them.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Kinds with this in their name; may be given several times.
    #[arg(long, default_value = "rounding alone")]
    kind: Vec<String>,
    /// What the model has.
    #[arg(long, value_enum, default_value_t = Terms::Right)]
    terms: Terms,
    /// Passes over a record that may be spent.
    #[arg(long)]
    budget: Option<usize>,
    /// Factor by which parameters are looked for on either side of their order of magnitude.
    #[arg(long)]
    reach: Option<f64>,
    /// A second start, with this factor: how far its bounds of alpha are apart from the first one's is printed with each case.
    #[arg(long)]
    near: Option<f64>,
    /// Readings that may be in error by any amount.
    #[arg(long, default_value_t = 0)]
    outliers: usize,
    /// Readings of each case that are moved by three to a hundred steps of the sensor.
    #[arg(long, default_value_t = 0)]
    glitches: usize,
    /// Threads.
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Folder for a certificate of each case; each is checked, and its cost printed with the case.
    #[arg(long)]
    certificates: Option<std::path::PathBuf>,
    /// Prints every case.
    #[arg(long)]
    list: bool,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    rayon::ThreadPoolBuilder::new().num_threads(arguments.threads).build_global()?;
    let mut kinds = Vec::new();
    for name in &arguments.kind {
        kinds.extend(Kind::matching(name)?);
    }
    let mut table = Table::default();
    for kind in kinds {
        let seeds: Vec<u64> = (arguments.seed..arguments.seed + arguments.records).collect();
        let outcomes: Vec<Outcome> = seeds
            .into_par_iter()
            .map(|seed| {
                let (case, terms, glitches) = (kind.case(seed), arguments.terms, arguments.glitches);
                let change = |model: &mut BoundedModel| {
                    model.budget = arguments.budget.unwrap_or(model.budget);
                    model.outliers = arguments.outliers;
                    model.reach = arguments.reach.unwrap_or(model.reach);
                };
                let outcome = Outcome::of(&case, terms, glitches, arguments.certificates.as_deref(), change);
                if arguments.list {
                    eprintln!("{} {seed}: {outcome}", kind.name);
                }
                if let Some(near) = arguments.near {
                    let second = Outcome::of(&case, terms, glitches, None, |model| {
                        change(model);
                        model.reach = near;
                    });
                    match outcome.apart(&second) {
                        Some(apart) => eprintln!(
                            "{} {seed}: {:.2} % of the width from those of the near start",
                            kind.name,
                            100.0 * apart
                        ),
                        None => eprintln!("{} {seed}: from the near start: {second}", kind.name),
                    }
                }
                outcome
            })
            .collect();
        table.add(kind.name, &outcomes);
    }
    print!("{table}");
    Ok(())
}
