//! Writes simulated records with their truth to files, or lists the kinds.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Parser, Subcommand};
use selfosc_simulator::experiment::Record;
use selfosc_simulator::kinds::{Case, FIRST_REPORT_SEED, Kind};

type Failure = Box<dyn std::error::Error>;

#[derive(Parser)]
#[command(about)]
struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Lists the kinds: group, then name.
    Kinds,
    /// Writes records as `time_s,output,input`, and beside each case its truth as JSON.
    Write {
        /// Folder; it is created.
        folder: PathBuf,
        /// Name of the kind; every kind that contains it where none has it exactly.
        #[arg(long, default_value = "")]
        kind: String,
        /// Cases of each kind.
        #[arg(long, default_value_t = 10)]
        records: u64,
        /// First seed. Seeds from 1000000 on are for reports: do not develop on them.
        #[arg(long, default_value_t = 1)]
        seed: u64,
    },
}

fn main() -> Result<(), Failure> {
    match Arguments::parse().action {
        Action::Kinds => {
            for kind in Kind::all() {
                println!("{:<12}{}", format!("{:?}", kind.group).to_lowercase(), kind.name);
            }
        }
        Action::Write { folder, kind, records, seed } => {
            fs::create_dir_all(&folder)?;
            if seed + records > FIRST_REPORT_SEED {
                eprintln!("seeds from {FIRST_REPORT_SEED} on are for reports: do not develop on these records");
            }
            for kind in Kind::matching(&kind)? {
                for seed in seed..seed + records {
                    write(&folder, &kind.case(seed))?;
                }
            }
        }
    }
    Ok(())
}

/// A name for files.
fn slug(name: &str) -> String {
    let words = name.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.')).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-").to_lowercase()
}

fn write(folder: &Path, case: &Case) -> Result<(), Failure> {
    let name = format!("{}-{}", slug(case.kind.name), case.seed);
    let mut files = Vec::new();
    for (index, run) in case.runs.iter().enumerate() {
        let file = if case.runs.len() == 1 { format!("{name}.csv") } else { format!("{name}-{}.csv", index + 1) };
        table(&folder.join(&file), &run.record)?;
        files.push(file);
    }
    let truth = serde_json::json!({
        "kind": case.kind.name,
        "group": case.kind.group,
        "seed": case.seed,
        "files": files,
        "known": case.known,
        "truth": case.truths,
        "scenario": case.runs.iter().map(|run| &run.scenario).collect::<Vec<_>>(),
        "reference_std_alpha": case.reference_std_alpha(),
    });
    fs::write(folder.join(format!("{name}.json")), serde_json::to_string_pretty(&truth)?)?;
    Ok(())
}

fn table(path: &Path, record: &Record) -> Result<(), Failure> {
    let mut table = csv::Writer::from_path(path)?;
    table.write_record(["time_s", "output", "input"])?;
    for ((time_s, output), input) in record.time_s.iter().zip(&record.output).zip(&record.input) {
        table.serialize((time_s, output, input))?;
    }
    table.flush()?;
    Ok(())
}
