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
    identify_files(&[("log.csv", log)], &["log.csv"], flags)
}

/// Writes files and identifies from some of them.
fn identify_files(files: &[(&str, &str)], records: &[&str], flags: &[&str]) -> (Option<i32>, Value) {
    let folder = tempfile::tempdir().unwrap();
    for (name, log) in files {
        std::fs::write(folder.path().join(name), log).unwrap();
    }
    let output = Command::cargo_bin("selfosc")
        .unwrap()
        .current_dir(&folder)
        .arg("identify")
        .args(records)
        .args(["--method", "fit", "--json"])
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

/// What a pool gives beside: each refused by name, and mended by the flag that the refusal names.
#[test]
fn dirty() {
    let log = Log::simulated();
    let header = "time_s,output,command";
    let plain = |[t, x, u]: [f64; 3]| format!("{t:.1},{x:.5},{u}");
    let with = |rows: &dyn Fn(usize, [f64; 3]) -> String| log.text(header, |n, cells| Some(rows(n, cells)));
    let burst = |n: usize| (n / 10) as f64 + 0.002 * (n % 10) as f64;
    // The same motion with a sixteenth of the turn: sixteen times the inertia.
    let turn_deg = 0.0625f64.to_degrees();
    let entries = [
        entry(
            "stamps of arrival, ten readings at once",
            &with(&|n, [_, x, u]| format!("{:.3},{x:.5},{u}", burst(n))),
            &[],
            &["--even-stamps"],
            1.0,
        ),
        entry(
            "a small heading in degrees",
            &log.text("time_s,yaw,command", |_, [t, x, u]| Some(format!("{t:.1},{:.3},{u}", turn_deg * x))),
            &[],
            &["--degrees"],
            16.0,
        ),
        entry(
            "a row of units",
            &with(&|n, row| if n == 0 { "s,rad,N".to_owned() } else { plain(row) }),
            &[],
            &["--skip-bad-rows"],
            1.0,
        ),
        entry(
            "a second header",
            &with(&|n, row| if n == 200 { header.to_owned() } else { plain(row) }),
            &[],
            &["--skip-bad-rows"],
            1.0,
        ),
        entry(
            "a clock that starts again: its first part",
            &with(&|n, [t, x, u]| plain([if n < 400 { t } else { t - 40.0 }, x, u])),
            &[],
            &["--part", "1"],
            1.0,
        ),
        entry(
            "a clock that is set back by ten seconds: its second part",
            &with(&|n, [t, x, u]| plain([if n < 200 { t } else { t - 10.0 }, x, u])),
            &[],
            &["--part", "2"],
            1.0,
        ),
        entry(
            "33 rows without a reading",
            &with(&|n, [t, x, u]| if n % 14 == 5 && n < 462 { format!("{t:.1},nan,{u}") } else { plain([t, x, u]) }),
            &[],
            &["--skip-bad-rows"],
            1.0,
        ),
        entry(
            "blank cells",
            &with(&|n, [t, x, u]| if n % 14 == 5 { format!("{t:.1},,{u}") } else { plain([t, x, u]) }),
            &[],
            &["--skip-bad-rows"],
            1.0,
        ),
        entry(
            "output and command in turn",
            &log.text(header, |_, [t, x, u]| Some(format!("{:.3},,{u}\n{t:.1},{x:.5},", t - 0.001))),
            &[],
            &["--hold-command"],
            1.0,
        ),
        entry(
            "dates",
            &log.text(header, |_, [t, x, u]| Some(format!("2026-11-29 12:00:{t:04.1},{x:.5},{u}"))),
            &[],
            &[],
            1.0,
        ),
        entry(
            "rows cut short",
            &with(&|n, [t, x, u]| if n % 14 == 5 { format!("{t:.1},{x:.2}") } else { plain([t, x, u]) }),
            &[],
            &["--skip-bad-rows"],
            1.0,
        ),
        entry(
            "stamps 2 ms before the one before",
            &with(&|n, [t, x, u]| format!("{:.3},{x:.5},{u}", if n % 25 == 7 { t - 0.102 } else { t })),
            &[],
            &["--skip-bad-rows"],
            1.0,
        ),
        entry(
            "words after the experiment",
            &with(&|n, row| if n < 420 { plain(row) } else { format!("{:.1},out of the water,0", row[0]) }),
            &[],
            &["--to", "41"],
            1.0,
        ),
        entry(
            "a third of the rows without a reading",
            &with(&|n, [t, x, u]| if n % 2 == 1 && n > 180 { format!("{t:.1},nan,{u}") } else { plain([t, x, u]) }),
            &["--skip-bad-rows"],
            &["--to", "18"],
            1.0,
        ),
        entry(
            "one column for two things",
            &log.text("time_s,depth,command,output", |_, [t, x, u]| Some(format!("{t:.1},{x:.5},{u},0"))),
            &["--output", "depth", "--input", "depth"],
            &["--output", "depth"],
            1.0,
        ),
        entry(
            "names that the default does not know",
            &log.text("clock,Z,thrust", |_, row| Some(plain(row))),
            &[],
            &["--time", "clock", "--output", "z", "--input", "Thrust"],
            1.0,
        ),
        entry(
            "names in upper case, with a unit",
            &log.text("Timestamp_MS,Heading,PWM", |_, [t, x, u]| Some(format!("{:.0},{x:.5},{u}", 1e3 * t))),
            &[],
            &[],
            1.0,
        ),
        entry("a temperature", &log.text("timestamp,Temperature,duty", |_, row| Some(plain(row))), &[], &[], 1.0),
    ];
    golden!("dirty", entries.join("\n"));
}

/// An axis and its thrusters, integrated by Runge and Kutta's method in steps of a millisecond, under a relay with hysteresis
/// that looks at every reading; after each reversal thrust pauses. Columns: time in s, reading, command.
fn experiment(
    [alpha, beta, quadratic]: [f64; 3],
    [ahead, astern]: [f64; 2],
    [level, half_width, delay_s, pause_s]: [f64; 4],
    [rate_hz, step]: [f64; 2],
    duration_s: f64,
) -> Vec<[f64; 3]> {
    let dt = 1e-3;
    let per_sample = (1.0 / rate_hz / dt).round() as usize;
    let late = (delay_s / dt).round() as usize;
    let (mut x, mut v, mut command) = (0.0f64, 0.0f64, level);
    let mut commands = vec![level; late + 1];
    let mut since_reversal_s = f64::INFINITY;
    let mut rows = Vec::new();
    for tick in 0..(duration_s / dt).round() as usize {
        if tick % per_sample == 0 {
            let reading = (x / step).round() * step;
            command = if reading > half_width {
                -level
            } else if reading < -half_width {
                level
            } else {
                command
            };
            rows.push([tick as f64 * dt, reading, command]);
        }
        commands.push(command);
        let u = commands[commands.len() - 1 - late];
        let reversed = u * commands[commands.len() - 2 - late] < 0.0;
        since_reversal_s = if reversed { 0.0 } else { since_reversal_s + dt };
        let gain = if u > 0.0 { ahead } else { astern };
        let force = if since_reversal_s < pause_s { 0.0 } else { gain * u };
        let slope = |v: f64| (force - beta * v - quadratic * v * v.abs()) / alpha;
        let (a1, v1) = (slope(v), v);
        let (a2, v2) = (slope(v + 0.5 * dt * a1), v + 0.5 * dt * a1);
        let (a3, v3) = (slope(v + 0.5 * dt * a2), v + 0.5 * dt * a2);
        let (a4, v4) = (slope(v + dt * a3), v + dt * a3);
        x += dt / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        v += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    rows
}

fn number(answer: &Value, parameter: &str, part: &str) -> f64 {
    answer["reported"][parameter][part].as_f64().unwrap()
}

/// Thrusters that push 28 N ahead and 22 N astern for each unit of the command are symmetric ones of 25 N and a constant force of
/// 0.12 of the level: exactly.
#[test]
fn thrusters_that_push_unevenly_are_a_constant_force() {
    let rows = experiment([21.0, 4.0, 35.0], [28.0, 22.0], [0.4, 0.1, 0.3, 0.0], [20.0, 0.004], 80.0);
    let (status, answer) =
        identify(&Log(rows).text("time_s,depth_m,command", |_, [t, x, u]| Some(format!("{t:.2},{x:.3},{u}"))), &[]);
    assert_eq!(status, Some(0), "{answer}");
    assert_ne!(answer["reported"]["trust"], "doubtful", "{}", answer["reported"]);
    for (parameter, truth) in [("alpha", 21.0 / 25.0), ("delta", 0.12 * 0.4)] {
        let value = number(&answer, parameter, "value");
        assert!((value / truth - 1.0).abs() < 0.01, "{parameter}: {value} for {truth}");
    }
}

/// A command that is logged five times slower than the readings: the answer is not `good`, its practical interval holds the inertia, and
/// the delay is that of the command as it is logged.
#[test]
fn a_command_logged_slowly_widens_the_answer() {
    let rows = experiment([0.05, 0.02, 0.04], [1.0, 1.0], [0.07, 0.35, 0.1, 0.0], [50.0, 0.0017], 60.0);
    let slow: Vec<f64> = (0..rows.len()).map(|n| rows[n - n % 5][2]).collect();
    let (status, answer) =
        identify(&Log(rows).text("time_s,yaw,command", |n, [t, x, _]| Some(format!("{t:.2},{x:.4},{}", slow[n]))), &[]);
    assert_eq!(status, Some(0), "{answer}");
    assert_eq!(answer["reported"]["trust"], "widened");
    let alpha = &answer["reported"]["alpha"];
    assert!((number(&answer, "alpha", "value") / 0.05 - 1.0).abs() < 0.02, "{alpha}");
    let [low, high] = ["low", "high"].map(|end| alpha["combined"][end].as_f64().unwrap());
    assert!((low..=high).contains(&0.05), "{alpha}");
    assert!((0.0..=0.1).contains(&number(&answer, "delay_s", "value")), "{}", answer["reported"]["delay_s"]);
}

/// A speed controller that waits a quarter of a second at each reversal is named, and the inertia is right: from one record, and from two
/// together. The answer predicts the other record, and its practical interval holds the pause.
#[test]
fn a_pause_of_the_thrust_at_a_reversal_is_named() {
    let vehicle = [0.04, 0.02, 0.05];
    let [first, second] = [(0.25, 60.0), (0.4, 45.0)].map(|(half_width, duration_s)| {
        let rows = experiment(vehicle, [1.0, 1.0], [0.1, half_width, 0.1, 0.25], [20.0, 0.0017], duration_s);
        Log(rows).text("time_s,yaw,command", |_, [t, x, u]| Some(format!("{t:.2},{x:.4},{u}")))
    });
    let files = [("first.csv", first.as_str()), ("second.csv", second.as_str())];
    for records in [&["first.csv"][..], &["first.csv", "second.csv"]] {
        let (status, answer) = identify_files(&files, records, &["--validate", "second.csv"]);
        assert_eq!(status, Some(0), "{answer}");
        let reasons = answer["reported"]["reasons"].as_array().unwrap();
        assert!(reasons.iter().any(|reason| reason["code"] == "reversal-pause"), "{reasons:?}");
        assert_ne!(answer["reported"]["trust"], "doubtful");
        assert!((number(&answer, "alpha", "value") / 0.04 - 1.0).abs() < 0.01, "{}", answer["reported"]["alpha"]);
        let pause_s = &answer["reported"]["pause_s"];
        assert!((pause_s["value"].as_f64().unwrap() - 0.25).abs() < 0.02, "{pause_s}");
        let [low, high] = ["low", "high"].map(|end| pause_s["combined"][end].as_f64().unwrap());
        assert!((low..=high).contains(&0.25), "{pause_s}");
        let fit_percent = answer["validation"][0]["prediction"]["fit_percent"].as_f64().unwrap();
        assert!(fit_percent > 99.0, "{}", answer["validation"]);
    }
}
