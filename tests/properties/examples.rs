//! Every example runs to its end.
#![allow(unreachable_pub, reason = "an example's `main` is called from here")]
#![allow(dead_code, reason = "those of the pool are not")]

use std::collections::BTreeSet;
use std::path::Path;

use selfosc::experiment::SimulatedExperiment;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::plant::DragAxis;

#[path = "../../examples/describing_function.rs"]
mod describing_function;
#[path = "../../examples/fleet.rs"]
mod fleet;
#[path = "../../examples/fuzz_on_board.rs"]
mod fuzz_on_board;
#[path = "../../examples/limit_cycle.rs"]
mod limit_cycle;
#[path = "../../examples/nyquist_balance.rs"]
mod nyquist_balance;
#[path = "../../examples/pool_log.rs"]
mod pool_log;
#[path = "../../examples/pool_session.rs"]
mod pool_session;
#[path = "../../examples/proved_bias.rs"]
mod proved_bias;
#[path = "../../examples/true_in_the_paper.rs"]
mod true_in_the_paper;

/// The one that takes a file, here a simulated one.
#[test]
fn pool_log() {
    let (axis, relay) = (DragAxis::quadratic(1.0, 0.5).unwrap(), RelayHysteresis::new(1.0, 0.3, 0.0).unwrap());
    let record = SimulatedExperiment::new(axis, relay, 20.0).unwrap().run(60.0).unwrap();
    let rows = record.time_s().iter().zip(record.output()).zip(record.input());
    let lines: String = rows.map(|((time, output), input)| format!("{time},{output},{input}\n")).collect();
    pool_log::identify(format!("time_s,output,input\n{lines}").as_bytes()).unwrap();
}

/// The one that draws into a folder: identified within 5 %, and a heading step that only the identified axis settles.
#[test]
fn pool_session() {
    let folder = tempfile::tempdir().unwrap();
    let session = pool_session::run(folder.path()).unwrap();
    assert!((session.alpha_ratio - 1.0).abs() < 0.05, "{session:?}");
    assert!(session.before.settling_s.is_none() && session.before.overshoot_percent > 10.0, "{session:?}");
    assert!(session.after.settling_s.is_some_and(|time| time < 8.0), "{session:?}");
    assert!(session.after.overshoot_percent < 3.0, "{session:?}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
}

/// The one that runs as long as it is told: every kind of fault comes within the first steps already.
#[test]
fn fuzz_on_board() {
    let seen = fuzz_on_board::run(50_000, 2);
    assert!(seen.steps >= 50_000 && seen.driven > 0 && seen.controllers > 0 && seen.faults.len() > 5, "{seen:?}");
}

macro_rules! run {
    ($($name:ident),+ $(,)?) => {
        const LISTED: &[&str] = &[$(stringify!($name)),+];

        mod run {
            $(
                #[test]
                fn $name() {
                    super::$name::main().unwrap();
                }
            )+
        }
    };
}
run!(describing_function, fleet, limit_cycle, nyquist_balance, proved_bias, true_in_the_paper);

#[test]
fn none_is_left_out() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    // What is no Rust, the Python package's tests run.
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let names: BTreeSet<String> = files.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    assert_eq!(
        names,
        LISTED.iter().chain(&["fuzz_on_board", "pool_log", "pool_session"]).map(|&name| name.to_owned()).collect()
    );
}
