//! The log clinic: for each entry the damaged log, what is said of it, and the flag that mends it.

use assert_cmd::Command;
use serde_json::Value;

use crate::golden;

/// A record as columns of text: time in s, output in rad, command.
struct Log(Vec<[f64; 3]>);

impl Log {
    /// Inertia 1, quadratic drag 0.5, disturbance 0.05, delay 0.1 s, read to a tenth of a degree.
    fn simulated() -> Self {
        let arguments = "simulate --alpha 1 --beta-quadratic 0.5 --relay 1 --half-width 0.3 --delta 0.05 --delay 0.1 --hold \
                         --quantum 0.00175 --cycles 8";
        let output = Command::cargo_bin("selfosc").unwrap().args(arguments.split_whitespace()).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let row = |line: &str| {
            let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            [cells[0], cells[1], cells[2]]
        };
        Self(text.lines().skip(1).map(row).collect())
    }

    fn text(&self, header: &str, row: impl Fn(usize, [f64; 3]) -> Option<String>) -> String {
        let rows = self.0.iter().enumerate().filter_map(|(number, cells)| row(number, *cells));
        std::iter::once(header.to_owned()).chain(rows).map(|line| line + "\n").collect()
    }
}

fn identify(log: &str, flags: &[&str]) -> (Option<i32>, Value) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("log.csv"), log).unwrap();
    let output = Command::cargo_bin("selfosc")
        .unwrap()
        .current_dir(&folder)
        .args(["identify", "log.csv", "--method", "fit", "--json"])
        .args(flags)
        .output()
        .unwrap();
    (output.status.code(), serde_json::from_slice(&output.stdout).unwrap())
}

/// The first lines of the log, what is said, the flags, and whether inertia 1 comes back with them.
fn entry(name: &str, log: &str, before: &[&str], mended: &[&str], alpha: f64) -> String {
    let head: String = log.lines().take(4).map(|line| format!("    {line}\n")).collect();
    let (status, answer) = identify(log, before);
    let said = if answer["refused"].is_object() {
        format!(
            "refused ({}): {}",
            answer["refused"]["code"].as_str().unwrap(),
            answer["refused"]["text"].as_str().unwrap()
        )
    } else {
        let reasons = answer["reported"]["reasons"].as_array().unwrap();
        let codes: Vec<&str> = reasons.iter().map(|reason| reason["code"].as_str().unwrap()).collect();
        format!("{}: {}", answer["reported"]["trust"].as_str().unwrap(), codes.join(", "))
    };
    let (healed, answer) = identify(log, mended);
    assert_eq!(healed, Some(0), "{name}: {answer}");
    let found = answer["reported"]["alpha"]["value"].as_f64().unwrap();
    assert!((found / alpha - 1.0).abs() < 0.01, "{name}: alpha {found} for {alpha}");
    let [before, mended] = [before, mended].map(|flags| flags.join(" "));
    format!("{name}\n{head}identify {before}: exit {}, {said}\nmended by: identify {mended}\n", status.unwrap())
}

#[test]
fn clinic() {
    let log = Log::simulated();
    let scaled = |header: &str, time: f64, output: f64, input: f64, middle: f64| {
        log.text(header, |_, [t, x, u]| Some(format!("{:.6},{:.6},{}", time * t, output * x, middle + input * u)))
    };
    let wrapped = |turn: f64| {
        log.text("time_s,output,command", |_, [t, x, u]| {
            let angle = (x * turn / core::f64::consts::TAU).rem_euclid(turn);
            Some(format!("{t:.1},{angle:.5},{u}"))
        })
    };
    let header = "time_s,output,command";
    let degrees = 1f64.to_degrees();
    let entries = [
        entry(
            "time in milliseconds",
            &scaled("time,output,command", 1e3, 1.0, 1.0, 0.0),
            &[],
            &["--time-unit", "ms"],
            1.0,
        ),
        entry("time in nanoseconds", &scaled("t,output,command", 1e9, 1.0, 1.0, 0.0), &[], &["--time-unit", "ns"], 1.0),
        entry("unit in the column's name", &scaled("time_us,output,command", 1e6, 1.0, 1.0, 0.0), &[], &[], 1.0),
        entry(
            "degrees in a column not so named",
            &scaled("t,heading,u", 1.0, degrees, 1.0, 0.0),
            &[],
            &["--degrees"],
            1.0,
        ),
        entry("pulse widths about 1500", &scaled(header, 1.0, 1.0, 100.0, 1500.0), &[], &["--neutral", "1500"], 100.0),
        entry("command of the opposite sign", &scaled(header, 1.0, 1.0, -1.0, 0.0), &[], &["--invert"], 1.0),
        entry("an angle that jumps by a turn", &wrapped(core::f64::consts::TAU), &[], &["--wrap"], 1.0),
        entry("degrees that jump by a turn", &wrapped(360.0), &[], &["--wrap", "--degrees"], 1.0),
        entry(
            "two columns of one name",
            &log.text("time_s,output,output,command", |_, [t, x, u]| Some(format!("{t:.1},{x:.5},{x:.2},{u}"))),
            &[],
            &["--output", "output#1"],
            1.0,
        ),
        entry(
            "a hole in the log",
            &log.text(header, |n, [t, x, u]| {
                let t = if n > 400 { t + 60.0 } else { t };
                Some(format!("{t:.1},{x:.5},{u}"))
            }),
            &[],
            &["--to", "40"],
            1.0,
        ),
        entry(
            "a sample in six missing",
            &log.text(header, |n, [t, x, u]| ((n * 7919) % 6 != 0).then(|| format!("{t:.1},{x:.5},{u}"))),
            &[],
            &[],
            1.0,
        ),
        entry(
            "stamps late by up to 60 ms",
            &log.text(header, |n, [t, x, u]| Some(format!("{:.3},{x:.5},{u}", t + 0.001 * ((n * 7919) % 61) as f64))),
            &[],
            &[],
            1.0,
        ),
        entry(
            "the command as it acted, logged behind the delay",
            &log.text(header, |n, [t, x, _]| Some(format!("{t:.1},{x:.5},{}", log.0[n.saturating_sub(1)][2]))),
            &["--delay", "0.1"],
            &["--delay", "estimate"],
            1.0,
        ),
        entry(
            "readings on a grid that does not hold zero",
            &log.text(header, |_, [t, x, u]| Some(format!("{t:.1},{:.5},{u}", 0.0175 * (x / 0.0175).round() + 0.0061))),
            &[],
            &[],
            1.0,
        ),
    ];
    golden!("clinic", entries.join("\n"));
}
