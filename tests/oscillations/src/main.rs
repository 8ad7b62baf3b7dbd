//! Draws relay loops, asks the command `selfosc` about them and judges its answers; the same for describing-function loops.

use std::fs::File;
use std::io::{BufRead, BufReader, Write, stdin, stdout};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use rayon::prelude::*;
use selfosc_oscillations::ask::{ask, ask_balance};
use selfosc_oscillations::describing::counterexamples::counterexamples;
use selfosc_oscillations::describing::judge::truths;
use selfosc_oscillations::describing::loops::loops;
use selfosc_oscillations::describing::truth::{Truth, truth};
use selfosc_oscillations::describing::{self, answer};
use selfosc_oscillations::relay::answer::Line;
use selfosc_oscillations::relay::draw::{FIRST_REPORT_SEED, draw};
use selfosc_oscillations::relay::judge::{judge, own_listing};
use selfosc_oscillations::relay::report::{markdown, totals};
use serde::Serialize;
use serde::de::DeserializeOwned;

type Failure = Box<dyn std::error::Error + Send + Sync>;

#[derive(Parser)]
#[command(about, version)]
struct Arguments {
    #[command(subcommand)]
    action: Action,
    /// Threads
    #[arg(long, default_value_t = 2, global = true)]
    threads: usize,
}

#[derive(Subcommand)]
enum Action {
    /// Exact orbits of linear plants with dead time under a two-level relay
    #[command(subcommand)]
    Relay(Relay),
    /// Oscillations of linear plants with dead time and a static characteristic
    #[command(subcommand)]
    Describing(Describing),
}

#[derive(Subcommand)]
enum Describing {
    /// Prints thirty loops and what is true of each: a table, or JSON for other programs
    Truth {
        /// Prints one JSON document
        #[arg(long)]
        json: bool,
    },
    /// Prints the loops against Theorems 2 and 3 with the figures of their oscillations
    Counterexamples,
    /// Asks `selfosc balance` about the thirty loops; prints JSON lines with its answers
    Ask {
        /// The command
        #[arg(long, default_value = "target/release/selfosc")]
        selfosc: PathBuf,
    },
    /// Judges answers; prints a table and every contradiction. Exit status 1 where there is one
    Judge {
        /// JSON lines; `-` is standard input
        file: PathBuf,
    },
}

#[derive(Subcommand)]
enum Relay {
    /// Prints loops as JSON lines, without answers
    Draw(Seeds),
    /// Asks `selfosc predict` about loops; prints JSON lines with its answers
    Ask {
        #[command(flatten)]
        seeds: Seeds,
        /// The command
        #[arg(long, default_value = "target/release/selfosc")]
        selfosc: PathBuf,
    },
    /// Prints the judge's own listing of each loop of a file as its answer
    Own {
        /// JSON lines; `-` is standard input
        file: PathBuf,
    },
    /// Judges answers; prints a table and every contradiction. Exit status 1 where there is one
    Judge {
        /// JSON lines; `-` is standard input
        file: PathBuf,
        /// Leaves out the search for orbits that no start reaches
        #[arg(long)]
        reached_only: bool,
    },
}

#[derive(clap::Args, Clone, Copy)]
struct Seeds {
    /// First seed. Development uses seeds below 1000, reports those from 1000000 on
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Loops
    #[arg(long, default_value_t = 300)]
    loops: u64,
}

impl Seeds {
    fn all(self) -> Vec<u64> {
        if self.seed + self.loops > FIRST_REPORT_SEED {
            eprintln!("seeds from {FIRST_REPORT_SEED} on are for reports: do not develop on these loops");
        }
        (self.seed..self.seed + self.loops).collect()
    }
}

fn lines<T: DeserializeOwned>(file: &Path) -> Result<Vec<T>, Failure> {
    let reader: Box<dyn BufRead> =
        if file.as_os_str() == "-" { Box::new(stdin().lock()) } else { Box::new(BufReader::new(File::open(file)?)) };
    let mut lines = Vec::new();
    for (number, text) in reader.lines().enumerate() {
        let text = text?;
        if text.trim().is_empty() {
            continue;
        }
        lines.push(
            serde_json::from_str(&text).map_err(|why| format!("{}, line {}: {why}", file.display(), number + 1))?,
        );
    }
    Ok(lines)
}

/// Lines with loops that can be simulated.
fn relay_lines(file: &Path) -> Result<Vec<Line>, Failure> {
    let lines: Vec<Line> = lines(file)?;
    for line in &lines {
        line.control_loop.check().map_err(|why| format!("seed {}: {why}", line.seed))?;
    }
    Ok(lines)
}

fn print<T: Serialize>(lines: &[T]) -> Result<(), Failure> {
    let mut output = stdout().lock();
    for line in lines {
        serde_json::to_writer(&mut output, line)?;
        writeln!(output)?;
    }
    Ok(())
}

fn relay(action: Relay) -> Result<ExitCode, Failure> {
    let drawn = |seed: u64| Line { seed, control_loop: draw(seed), seconds: None, answer: None, refused: None };
    match action {
        Relay::Draw(seeds) => print(&seeds.all().into_iter().map(drawn).collect::<Vec<_>>())?,
        // One after the other: the answers are timed.
        Relay::Ask { seeds, selfosc } => {
            for seed in seeds.all() {
                print(&[ask(&selfosc, seed, draw(seed))?])?;
            }
        }
        Relay::Own { file } => {
            let answered = |line: Line| -> Result<Line, Failure> {
                Ok(Line { answer: Some(serde_json::to_value(own_listing(&line))?), ..line })
            };
            print(&relay_lines(&file)?.into_par_iter().map(answered).collect::<Result<Vec<_>, _>>()?)?;
        }
        Relay::Judge { file, reached_only } => {
            let lines = relay_lines(&file)?;
            // Loops take milliseconds or minutes: each is a task of its own.
            let judgements: Vec<_> = lines.par_iter().with_max_len(1).map(|line| judge(line, !reached_only)).collect();
            print!("{}", markdown(&judgements));
            let wrong = judgements.iter().any(|judgement| !judgement.contradictions.is_empty());
            return Ok(if wrong || totals(&judgements).faults > 0 { ExitCode::FAILURE } else { ExitCode::SUCCESS });
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn describing(action: Describing) -> Result<ExitCode, Failure> {
    match action {
        Describing::Truth { json } => {
            let found: Vec<Truth> = loops().into_par_iter().with_max_len(1).map(|one| truth(&one)).collect();
            if json {
                serde_json::to_writer_pretty(stdout().lock(), &found)?;
                println!();
            } else {
                print!("{}", truths(&found));
            }
        }
        Describing::Counterexamples => {
            for one in counterexamples() {
                let figures = one.figures().ok_or_else(|| format!("{}: no oscillation", one.name))?;
                println!("{}", serde_json::to_string_pretty(&figures)?);
            }
        }
        // One after the other: the answers are timed.
        Describing::Ask { selfosc } => {
            for one in loops() {
                print(&[ask_balance(&selfosc, one)?])?;
            }
        }
        Describing::Judge { file } => {
            let lines: Vec<answer::Line> = lines(&file)?;
            let judgements: Vec<_> = lines.par_iter().with_max_len(1).map(describing::judge::judge).collect();
            print!("{}", describing::judge::markdown(&judgements));
            let wrong = judgements.iter().any(|judgement| !judgement.contradictions.is_empty());
            return Ok(if wrong { ExitCode::FAILURE } else { ExitCode::SUCCESS });
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn main() -> Result<ExitCode, Failure> {
    let Arguments { action, threads } = Arguments::parse();
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    match action {
        Action::Relay(action) => relay(action),
        Action::Describing(action) => describing(action),
    }
}
