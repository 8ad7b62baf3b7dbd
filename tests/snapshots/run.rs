//! The experiment as a coprocess: a pipe with a simulated vehicle, faults, signals, and lines that are none.
#![cfg(unix)]

use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};

use assert_cmd::cargo::CommandCargoExt;
use selfosc::experiment::{LiveVehicle, Sensor};
use selfosc::on_board::{Experiment, Phase, Protocol};
use selfosc::plant::DragAxis;
use tempfile::TempDir;

const RUN: [&str; 8] =
    ["run", "--coordinate", "heading-rad", "--relay", "0.02", "--half-width=0.2", "--interval", "0.1"];

fn selfosc(folder: &TempDir) -> Command {
    let mut command = Command::cargo_bin("selfosc").unwrap();
    command.current_dir(folder);
    command
}

/// Status, standard output and standard error upon these lines.
fn answers(arguments: &[&str], lines: &[u8]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let streams = [Stdio::piped(), Stdio::piped(), Stdio::piped()];
    let [input, output, error] = streams;
    let mut child =
        selfosc(&folder).args(RUN).args(arguments).stdin(input).stdout(output).stderr(error).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let lines = lines.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(&lines));
    let output = child.wait_with_output().unwrap();
    let _ = writer.join().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// An actuator that is off or full on, against a constant force: both answers count it from off.
#[test]
fn a_relay_about_an_offset() {
    let folder = tempfile::tempdir().unwrap();
    let program = Command::cargo_bin("selfosc").unwrap().get_program().to_owned();
    let script = "mkfifo commands
        \"$0\" simulate --live --alpha 0.033 --beta 0.03 --delta -0.018 < commands |
        \"$0\" run --relay 0.02 --offset 0.02 --lowest 0 --half-width 0.2 --interval 0.1 --log log.csv --json model.json > commands";
    let output = Command::new("sh").arg("-c").arg(script).arg(program).current_dir(&folder).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let log = std::fs::read_to_string(folder.path().join("log.csv")).unwrap();
    let commands: std::collections::BTreeSet<&str> =
        log.lines().skip(1).map(|line| line.rsplit(',').next().unwrap()).collect();
    assert_eq!(commands.into_iter().collect::<Vec<_>>(), ["0", "0.04"]);
    let model: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("model.json")).unwrap()).unwrap();
    for delta in [&model["reported"]["delta"]["value"], &model["experiment"]["exact"][0]["delta"]] {
        assert!((delta.as_f64().unwrap() + 0.018).abs() < 0.001, "{delta}");
    }
}

/// Limits that are not given hold the neutral command, which ends the experiment.
#[test]
fn the_neutral_command_is_within_the_usual_limits() {
    let (_, commands, _) = answers(&["--offset", "0.06"], b"0 0\n");
    let lines: Vec<&str> = commands.lines().collect();
    assert!(lines[0] == "0.08 running" && lines[lines.len() - 1].starts_with("0 "), "{lines:?}");
}

/// Numbers of the experiment have the unit of its readings.
#[test]
fn a_heading_in_degrees_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let flags =
        ["run", "--coordinate", "heading-deg", "--relay", "1", "--half-width", "2", "--interval", "0.1", "--json"];
    let output = selfosc(&folder).args(flags).stdin(Stdio::null()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let document: serde_json::Value = serde_json::from_str(text.lines().last().unwrap()).unwrap();
    assert_eq!(document["experiment"]["units"]["output"], "deg");
}

/// One shell pipe: experiment, model, gains.
#[test]
fn one_pipe_from_the_experiment_to_gains() {
    let folder = tempfile::tempdir().unwrap();
    let program = Command::cargo_bin("selfosc").unwrap().get_program().to_owned();
    let script = "mkfifo commands
        \"$0\" simulate --live --alpha 0.033 --beta 0.01 --beta-quadratic 0.06 --delta 0.004 --delay 0.2 --quantum 0.00175 < commands |
        \"$0\" run --coordinate heading-rad --relay 0.02 --half-width 0.2 --interval 0.1 --log log.csv --json model.json > commands &&
        \"$0\" tune --model model.json --ms 1.4 --json";
    let output = Command::new("sh").arg("-c").arg(script).arg(program).current_dir(&folder).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let tuned: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(tuned["sensitivity"]["proved_upper"].as_f64().unwrap() <= 1.4);
    let model: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("model.json")).unwrap()).unwrap();
    assert!((model["reported"]["alpha"]["value"].as_f64().unwrap() / 0.033 - 1.0).abs() < 0.02);
    assert_eq!(model["experiment"]["phase"], "done");
    assert_eq!(model["experiment"]["units"], model["units"]);
    let delta = model["reported"]["delta"]["value"].as_f64().unwrap();
    let offset = tuned["offset"].as_f64().unwrap();
    assert!((offset * tuned["gains"]["proportional"].as_f64().unwrap() - delta).abs() < 1e-15);
    // The log is what `identify` reads.
    let again = selfosc(&folder).args(["identify", "log.csv", "--json"]).output().unwrap();
    let again: serde_json::Value = serde_json::from_slice(&again.stdout).unwrap();
    assert_eq!(again["reported"], model["reported"]);
}

/// The same commands and the same outcome, bit for bit, as the library on board has with that vehicle.
#[test]
fn the_state_machine_is_that_on_board() {
    let vehicle = || {
        let axis = DragAxis::mixed(0.033, 0.01, 0.06).unwrap().with_delay_s(0.2).unwrap();
        LiveVehicle::new(axis, Sensor { delay_s: 0.0, quantum: 0.00175, noise: 0.001 }, 10.0, 3).unwrap()
    };
    let (mut here, mut experiment) = (vehicle(), Experiment::new(Protocol::heading_rad(0.02, 0.2, 0.1)).unwrap());
    let mut expected = Vec::new();
    while experiment.phase() == Phase::Running {
        let (time_s, reading) = here.reading();
        let step = experiment.step(reading, time_s);
        here.command(step.command);
        expected.push(step.command);
    }
    let folder = tempfile::tempdir().unwrap();
    let mut child = selfosc(&folder)
        .args(RUN)
        .args(["--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let (mut input, mut output) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()).lines());
    let mut there = vehicle();
    let mut commands = Vec::new();
    loop {
        let (time_s, reading) = there.reading();
        writeln!(input, "{time_s} {reading}").unwrap();
        let line = output.next().unwrap().unwrap();
        let (command, phase) = line.split_once(' ').unwrap();
        commands.push(command.parse::<f64>().unwrap());
        there.command(commands[commands.len() - 1]);
        if phase != "running" {
            assert_eq!(phase, "done");
            break;
        }
    }
    assert_eq!(commands, expected);
    let document: serde_json::Value = serde_json::from_str(&output.next().unwrap().unwrap()).unwrap();
    assert_eq!(document["experiment"]["outcome"], serde_json::to_value(experiment.outcome()).unwrap());
    assert!(child.wait().unwrap().success());
}

/// Whatever comes, the command stays within its limits, the last one is neutral, and nothing panics.
#[test]
fn lines_that_are_none() {
    let words =
        ["0", "-1e308", "nan", "inf", "0.1", "1e-320", "\u{202e}", "9e99", "", "x", "# note", "0.2 0.3 0.4", "\0"];
    let mut state = 7_u64;
    let mut pick = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        words[(state >> 33) as usize % words.len()]
    };
    for _ in 0..40 {
        let lines: String =
            (0..200).map(|k| format!("{} {}\n", if k % 3 == 0 { pick() } else { "0.1" }, pick())).collect();
        let (status, output, complaint) = answers(&[], lines.as_bytes());
        assert!(status == Some(1) && !complaint.contains("panicked"), "{status:?} {complaint}");
        let commands: Vec<f64> = output.lines().map(|line| line.split_once(' ').unwrap().0.parse().unwrap()).collect();
        assert!(commands.iter().all(|command| (-0.04..=0.04).contains(command)));
        assert_eq!(commands.last(), Some(&0.0), "{output}");
    }
}

/// Bits of Splitmix64 (Steele, Lea and Flood, 2014).
fn bits(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Lines of a sensor that swings, among them some of a broken one, of any bytes, or of any floats.
fn fuzzed(state: &mut u64) -> Vec<u8> {
    let mut below = |count: u64| bits(state) % count;
    let (swing, pace) = (below(40) as f64 / 60.0, 0.05 + below(30) as f64 / 100.0);
    let mut lines = Vec::new();
    for k in 0..below(600) {
        let time_s = k as f64 * 0.1;
        let line = match below(240) {
            0 => format!("{} {}", f64::from_bits(below(u64::MAX)), f64::from_bits(below(u64::MAX))).into_bytes(),
            1 => (0..below(9000)).map(|_| below(256) as u8).collect(),
            2 => format!("{time_s} {}", below(7) as f64).into_bytes(),
            3 => format!("{} 0.1", time_s - 1.0).into_bytes(),
            4 => vec![b' '; below(5000) as usize],
            5 => format!("# {time_s}").into_bytes(),
            6 => format!("\u{feff}{time_s},0.1").into_bytes(),
            _ => format!("{time_s} {}", swing * (pace * k as f64).sin()).into_bytes(),
        };
        lines.extend(line);
        lines.push(b'\n');
    }
    lines
}

/// No line ends it by a panic, drives it beyond its limits, or leaves the last command standing. `SELFOSC_FUZZ_LINES` says how many
/// lines are to be answered; `fixtures/fuzz_run.txt` has the longest run.
#[test]
fn fuzzed_lines_end_neutral() {
    let wanted = std::env::var("SELFOSC_FUZZ_LINES").map_or(4000, |count| count.parse().unwrap());
    let (mut state, mut answered, mut runs) = (20_261_127, 0, 0);
    let mut ends = std::collections::BTreeMap::new();
    while answered < wanted {
        let (status, output, complaint) = answers(&[], &fuzzed(&mut state));
        assert!(matches!(status, Some(0 | 1)) && !complaint.contains("panicked"), "{status:?} {complaint}");
        let lines: Vec<(f64, &str)> = output
            .lines()
            .map(|line| line.split_once(' ').unwrap())
            .map(|(command, phase)| (command.parse().unwrap(), phase))
            .collect();
        assert!(lines.iter().all(|(command, _)| (-0.04..=0.04).contains(command)), "{output}");
        let (command, phase) = lines[lines.len() - 1];
        assert!(command == 0.0 && phase != "running", "{output}");
        *ends.entry(phase.to_owned()).or_insert(0) += 1;
        (answered, runs) = (answered + lines.len(), runs + 1);
    }
    let _ = writeln!(std::io::stderr(), "{answered} lines in {runs} runs: {ends:#?}");
}

/// Named ends: of the input, of the time, of a reading, of the wrong way; each with neutral last.
#[test]
fn every_end_is_named() {
    let still: String = (0..200).map(|k| format!("{} 0\n", f64::from(k) * 0.1)).collect();
    for (lines, phase) in [
        ("0 0\n0.1 0.001\n", "aborted"),
        ("0 0\n0.1 0.1\n", "running"),
        ("0 0\n0.1 2.0\n", "failed:jump"),
        ("0 0\n0 0\n", "failed:time-order"),
        ("0 0\n9 0\n", "failed:gap"),
        ("0 0\n0.1 one\n", "failed:not-finite"),
        (still.as_str(), "failed:stuck"),
    ] {
        let (status, output, _) = answers(&[], lines.as_bytes());
        let last = output.lines().last().unwrap();
        let ends = if phase == "running" { "0 aborted".to_owned() } else { format!("0 {phase}") };
        assert!(status == Some(1) && last == ends, "{lines:?}: {output}");
    }
}

/// Comments are no readings: a bridge that only says that it lives is silent.
#[test]
fn comments_do_not_put_silence_off() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = selfosc(&folder)
        .args(RUN)
        .args(["--timeout", "0.3"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let (mut input, mut output) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()).lines());
    writeln!(input, "0 0").unwrap();
    assert_eq!(output.next().unwrap().unwrap(), "0.02 running");
    let writer = std::thread::spawn(move || {
        // Until nobody reads any more, or for a minute.
        (0..1200).find(|_| {
            std::thread::sleep(std::time::Duration::from_millis(50));
            writeln!(input, "# still here").is_err()
        })
    });
    assert_eq!(output.next().unwrap().unwrap(), "0 failed:gap");
    assert_eq!(child.wait().unwrap().code(), Some(1));
    assert!(writer.join().unwrap().is_some());
}

/// A signal ends at the neutral command with the log on disk; so does silence.
#[test]
fn a_signal_and_silence_end_neutral() {
    crate::files::children_heed_signals();
    for signal in [Some("-INT"), Some("-TERM"), None] {
        let folder = tempfile::tempdir().unwrap();
        let mut child = selfosc(&folder)
            .args(RUN)
            .args(["--log", "log.csv", "--timeout", if signal.is_some() { "60" } else { "0.3" }])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let (mut input, mut output) =
            (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()).lines());
        for k in 0..5 {
            writeln!(input, "{} {}", f64::from(k) * 0.1, f64::from(k) * 0.001).unwrap();
            assert_eq!(output.next().unwrap().unwrap(), "0.02 running");
        }
        if let Some(signal) = signal {
            assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        }
        let last = output.next().unwrap().unwrap();
        assert_eq!(last, if signal.is_some() { "0 aborted" } else { "0 failed:gap" });
        assert_eq!(child.wait().unwrap().code(), Some(1));
        assert_eq!(std::fs::read_to_string(folder.path().join("log.csv")).unwrap().lines().count(), 6);
    }
}
