//! Controllers from identified models, judged on the vehicles that made the records:
//! `cargo run --release -p selfosc-trust --bin controllers -- --out spec/controller.md`.
//!
//! Record, model and gains go through the command as a user calls it; the vehicle's margins and the model's motion are computed here.

mod judge;
mod page;

use std::path::{Path, PathBuf};

use clap::Parser;
use judge::{Design, ModelMotion, TrueLoop};
use page::{Score, Tried};
use selfosc::command::answer;
use selfosc_simulator::command::Commander;
use selfosc_simulator::kinds::{Case, Kind};
use serde_json::Value;

/// Kinds of one record whose delay is told rightly or not at all. Kinds whose thrust is not proportional to the command, and those
/// whose headings wrap, are left out.
const KINDS: [&str; 35] = [
    "linear, 1 degree",
    "linear, noise",
    "quadratic, 1 degree",
    "quadratic, noise, delay unknown",
    "mixed, 1 degree",
    "mixed, noise, delay unknown",
    "mixed, linear part 1 to 8 %",
    "mixed, quadratic part 1 to 8 %",
    "negative linear and quadratic",
    "negative linear and quadratic, delay unknown",
    "strong constant force",
    "5 Hz",
    "20 s",
    "locked cycles",
    "irregular samples",
    "zig-zag, rudder logged",
    "lag 0.1 s",
    "lag 0.2 s",
    "lag 0.3 s, delay unknown",
    "rate limit 4 C/s",
    "rate limit 4 C/s, delay unknown",
    "stiffness 0.02 C/rad",
    "stiffness 0.1 C/rad, delay unknown",
    "linear and cubic",
    "negative linear and cubic",
    "current 0.05 C, 40 s",
    "tether",
    "autoregressive noise 0.9",
    "sensor filter 0.2 s",
    "sensor filter 0.5 s, delay unknown",
    "entrained water, 1 s",
    "Coulomb friction 0.03 C",
    "drag 30 % larger to one side",
    "lag 0.2 s, stiffness 0.05 C/rad",
    "drag of power 1.5",
];

/// Bandwidth asked for, rad/s; where it is refused, the one that the refusal names.
const BANDWIDTH_RAD_S: f64 = 0.8;

#[derive(Parser)]
#[command(about)]
struct Arguments {
    /// Trusted models to tune for.
    #[arg(long, default_value_t = 554)]
    models: usize,
    /// First seed. Seeds from 1000000 on are for reports: never develop on them.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only kinds with this in their name.
    #[arg(long, default_value = "")]
    kind: String,
    /// Markdown file to write, whose sections after the table stay; standard output without it.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Folder for the logs and models, by kind and seed; without it they are not kept.
    #[arg(long)]
    keep: Option<PathBuf>,
    /// Prints every model that is not accepted, and every margin that is overstated, with its seed.
    #[arg(long)]
    list: bool,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    let kinds: Vec<Kind> =
        KINDS.iter().filter(|name| name.contains(&arguments.kind)).filter_map(|name| Kind::named(name)).collect();
    let temporary = tempfile::tempdir()?;
    let folder = arguments.keep.as_deref().unwrap_or(temporary.path());
    let mut score = Score::default();
    'all: for seed in arguments.seed.. {
        for kind in &kinds {
            if score.models() >= arguments.models {
                break 'all;
            }
            let case = kind.case(seed);
            let stem = folder.join(format!("{} {seed}", kind.name.replace('/', " per ")));
            let Some(tried) = tried(&case, &stem)? else { continue };
            if arguments.list && tried.is_remarkable() {
                println!("{} {seed}: {tried:?}", kind.name);
            }
            score.count(kind.name, tried);
        }
    }
    match &arguments.out {
        Some(path) => {
            let before = std::fs::read_to_string(path).unwrap_or_default();
            let sections = before.find("\n## ").map_or("", |at| &before[at..]);
            std::fs::write(path, score.page(arguments.seed) + sections)?;
        }
        None => println!("{}", score.page(arguments.seed)),
    }
    Ok(())
}

/// What becomes of a case, whose log and model are written to files of this stem; `None` where its model is not trusted.
fn tried(case: &Case, stem: &Path) -> Result<Option<Tried>, Box<dyn std::error::Error>> {
    let file = |ending: &str| PathBuf::from(format!("{}.{ending}", stem.display()));
    let (log, model) = (file("csv"), file("json"));
    let record = &case.runs[0].record;
    let mut text = "time_s,position,input\n".to_owned();
    for ((time_s, output), input) in record.time_s.iter().zip(&record.output).zip(&record.input) {
        text.push_str(&format!("{time_s},{output},{input}\n"));
    }
    std::fs::write(&log, text)?;
    let mut call = vec!["identify".to_owned(), log.display().to_string(), "--json".to_owned()];
    call.extend(case.known.delay_s.map(|delay_s| format!("--delay={delay_s}")));
    let Ok(identified) = answer(call) else { return Ok(None) };
    let document: Value = serde_json::from_str(&identified.text)?;
    let reported = &document["reported"];
    if !matches!(reported["trust"].as_str(), Some("good" | "widened")) {
        return Ok(None);
    }
    std::fs::write(&model, identified.text)?;
    let scenario = &case.runs[0].scenario;
    let step = match &scenario.commander {
        Commander::Relay { half_width, .. } => *half_width,
        Commander::Sequence { .. } => 0.2 * record.output.iter().fold(0.0, |most: f64, x| most.max(x.abs())),
    };
    let mut tried = Tried::default();
    let mut bandwidth = BANDWIDTH_RAD_S;
    for _ in 0..4 {
        let call = ["tune", "--json", "--model"].map(str::to_owned).into_iter().chain([
            model.display().to_string(),
            format!("--bandwidth={bandwidth}"),
            format!("--step={step}"),
        ]);
        let (code, text) = match answer(call) {
            Ok(found) if !found.no => {
                let design = Design::read(&serde_json::from_str(&found.text)?)?;
                tried.accepted(bandwidth, &design);
                tried.true_phase_rad = TrueLoop::of(scenario, &design).phase_margin_rad();
                tried.simulated_offset = ModelMotion::of(reported, &design).offset();
                break;
            }
            Ok(refused) => {
                let refused: Value = serde_json::from_str(&refused.text)?;
                let part = |name: &str| refused["refused"][name].as_str().unwrap_or_default().to_owned();
                (part("code"), part("text"))
            }
            Err(failure) => (failure.code.to_owned(), failure.text),
        };
        tried.refusals.push(format!("{code} at {bandwidth:.3}"));
        bandwidth = match (code.as_str(), named(&text)) {
            ("too-fast", Some(most)) => 0.99 * most,
            ("overdamped", Some(least)) => 1.01 * least,
            ("unstable", Some(stabilised)) => stabilised,
            _ => break,
        };
    }
    Ok(Some(tried))
}

/// The bandwidth that a refusal tells to ask for.
fn named(text: &str) -> Option<f64> {
    let (_, rest) = text.split_once("ask for ")?;
    let (number, _) = rest.split_once(" rad/s")?;
    number.split_whitespace().last()?.parse().ok()
}
