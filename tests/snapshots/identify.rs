//! `selfosc identify` as it is seen: help, answers, refusals.

use assert_cmd::Command;
use serde_json::Value;
use sha2::{Digest, Sha256};
use tempfile::TempDir;

use crate::golden;

const AXIS: &[&str] = &["--alpha", "1", "--beta-quadratic", "0.5", "--relay", "1", "--half-width", "0.3"];

fn selfosc(folder: &TempDir, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("selfosc").unwrap().current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// A folder with `log.csv`, simulated with a disturbance and a delay.
fn simulated(axis: &[&str], record: &[&str]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let common = ["--delta", "0.1", "--delay", "0.1", "--hold", "--seed", "1"];
    let arguments = [&["simulate"], axis, &common, record].concat();
    let (status, log, diagnostics) = selfosc(&folder, &arguments);
    assert_eq!((status, diagnostics.as_str()), (0, ""));
    std::fs::write(folder.path().join("log.csv"), log).unwrap();
    folder
}

fn written(log: impl AsRef<[u8]>) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("log.csv"), log).unwrap();
    folder
}

/// A log with an output and an input of the sample's number.
fn log(samples: usize, output: impl Fn(f64) -> f64, input: impl Fn(f64) -> f64) -> String {
    let times = (0..samples).map(|sample| 0.1 * f64::from(u32::try_from(sample).unwrap()));
    let lines: String = times.map(|time| format!("{time:.1},{},{}\n", output(time), input(time))).collect();
    format!("time_s,output,input\n{lines}")
}

fn json(folder: &TempDir, arguments: &[&str]) -> Value {
    let (status, answer, diagnostics) = selfosc(folder, &[&["identify", "log.csv", "--json"], arguments].concat());
    assert_eq!((status, diagnostics.as_str()), (0, ""), "{answer}");
    serde_json::from_str(&answer).unwrap()
}

/// Numbers to three significant digits: the last ones of a search depend on the machine's arithmetic.
fn rounded(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            *value = format!("{:.2e}", number.as_f64().unwrap()).parse::<f64>().unwrap().into();
        }
        Value::Array(values) => values.iter_mut().for_each(rounded),
        Value::Object(fields) => fields.values_mut().for_each(rounded),
        _ => {}
    }
}

/// Status, name and message of a refusal, after both ways of asking have said the same.
fn refusal(folder: &TempDir, arguments: &[&str]) -> String {
    let arguments = [&["identify", "log.csv"], arguments].concat();
    let (status, answer, diagnostics) = selfosc(folder, &arguments);
    let (same, document, _) = selfosc(folder, &[&arguments[..], &["--json"]].concat());
    assert_eq!(status, same);
    let document: Value = serde_json::from_str(&document).unwrap();
    let (code, text) = (document["refused"]["code"].as_str().unwrap(), document["refused"]["text"].as_str().unwrap());
    assert!(answer.contains(text) || diagnostics.contains(text), "{answer}{diagnostics}");
    format!("exit {status}, {code}\n{text}")
}

#[test]
fn help() {
    golden!("identify-help", selfosc(&tempfile::tempdir().unwrap(), &["identify", "--help"]).1);
}

#[test]
fn text() {
    let folder = simulated(AXIS, &["--quantum", "0.0175"]);
    let (status, answer, diagnostics) = selfosc(&folder, &["identify", "log.csv", "--delay", "0.1"]);
    assert_eq!((status, diagnostics.as_str()), (0, ""), "{answer}");
    insta::with_settings!({ filters => vec![(r"(\d\.\d\d\d)\d+", "$1")] }, { golden!("identify", answer) });
}

#[test]
fn document() {
    let folder = simulated(AXIS, &["--quantum", "0.0175"]);
    let mut document = json(&folder, &["--delay", "0.1"]);
    rounded(&mut document);
    golden!("identify-json", serde_json::to_string_pretty(&document).unwrap());
}

/// The truth lies within four standard deviations of the fit, which are small.
#[test]
fn simulated_parameters_come_back() {
    let fixed = ["--relay", "1", "--half-width", "0.3"];
    let laws: [(&str, f64, f64); 3] = [("linear", 0.8, 0.0), ("quadratic", 0.0, 0.5), ("mixed", 0.5, 0.5)];
    for (law, beta, quadratic) in laws {
        let (b, q) = (beta.to_string(), quadratic.to_string());
        let axis = [&["--alpha", "1", "--beta", &b, "--beta-quadratic", &q][..], &fixed].concat();
        let folder = simulated(&axis, &["--noise", "0.003", "--cycles", "20"]);
        let found = json(&folder, &["--delay", "estimate", "--drag", law]);
        let fit = found["estimates"].as_array().unwrap().iter().find(|model| model["method"] == "fit").unwrap();
        let truth = [("alpha", 1.0), ("beta", beta), ("beta_quadratic", quadratic), ("delta", 0.1), ("delay_s", 0.1)];
        for (name, truth) in truth {
            let estimate = &fit[name];
            if estimate.is_null() {
                assert_eq!(truth, 0.0, "{law}: {name}");
                continue;
            }
            let (value, std) = (estimate["value"].as_f64().unwrap(), estimate["std"].as_f64().unwrap());
            assert!((value - truth).abs() < 4.0 * std, "{law}: {name} = {value} +- {std}, truth {truth}");
            assert!(std < 0.15, "{law}: {name} +- {std}");
        }
    }
}

#[test]
fn report_needs_nothing_outside() {
    let folder = simulated(AXIS, &["--quantum", "0.0175"]);
    let (status, ..) = selfosc(&folder, &["identify", "log.csv", "--delay", "0.1", "--report", "out.html"]);
    assert_eq!(status, 0);
    let html = std::fs::read_to_string(folder.path().join("out.html")).unwrap();
    for part in ["Reported:", "Methods compared", "Cycles", "Record and model", "Residuals", "Phase portrait"] {
        assert!(html.contains(part), "no {part}");
    }
    let inside =
        html.replace("xmlns=\"http://www.w3.org/2000/svg\"", "").replace("href=\"#", "").replace("http-equiv", "");
    assert!(!inside.contains("http") && !inside.contains("src=") && !inside.contains("href="));
}

/// The page's policy allows its own script, by its hash, and no other.
#[test]
fn a_page_runs_its_own_script_alone() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(selfosc(&folder, &["df", "--list", "--page", "out.html"]).0, 0);
    let html = std::fs::read_to_string(folder.path().join("out.html")).unwrap();
    let between = |from: &str, to: &str| html.split(from).nth(1).unwrap().split(to).next().unwrap();
    let policy = between("http-equiv=\"Content-Security-Policy\" content=\"", "\"");
    assert!(policy.starts_with("default-src 'none'; ") && !policy.contains("script-src 'unsafe-inline'"), "{policy}");
    // The digest in base 64.
    let digits = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digest = Sha256::digest(between("<script>", "</script>"));
    let bits: Vec<u8> = digest.iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1)).collect();
    let digit = |six: &[u8]| digits[(0..6).fold(0, |value, bit| 2 * value + usize::from(*six.get(bit).unwrap_or(&0)))];
    let hash: String = bits.chunks(6).map(|six| char::from(digit(six))).collect();
    assert!(policy.contains(&format!("script-src 'sha256-{hash}='")), "{hash} in {policy}");
    assert_eq!(html.matches("<script").count(), 1);
}

#[test]
fn several_records_are_one_vehicle() {
    let folder = simulated(AXIS, &[]);
    let (_, strong, _) = selfosc(
        &folder,
        &[
            "simulate",
            "--alpha",
            "1",
            "--beta-quadratic",
            "0.5",
            "--relay",
            "2",
            "--half-width",
            "0.2",
            "--delay",
            "0.1",
            "--hold",
        ],
    );
    std::fs::write(folder.path().join("strong.csv"), strong).unwrap();
    let found = json(&folder, &["strong.csv", "--delay", "0.1"]);
    assert_eq!(found["choice"]["drag"], "quadratic");
    assert_ne!(found["reported"]["trust"], "doubtful", "{}", found["reported"]);
    assert!((found["reported"]["alpha"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-3);
    let fit = found["estimates"].as_array().unwrap().iter().find(|m| m["method"] == "fit" && m["drag"] == "quadratic");
    let fit = fit.unwrap();
    assert!((fit["alpha"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-3);
    let deltas: Vec<f64> = fit["deltas"].as_array().unwrap().iter().map(|d| d["value"].as_f64().unwrap()).collect();
    assert!((deltas[0] - 0.1).abs() < 1e-3 && deltas[1].abs() < 1e-3, "{deltas:?}");
    assert!(found["features"].is_null() && found["records"][1]["features"].is_object());
}

/// A record of the same vehicle at another level is predicted; one of a vehicle with three times the inertia is not, and no controller is
/// made of that answer.
#[test]
fn a_record_that_is_not_predicted_makes_the_answer_doubtful() {
    let folder = simulated(AXIS, &["--noise", "0.003"]);
    for (name, alpha, noise) in [("same.csv", "1", "0"), ("noisy.csv", "1", "0.4"), ("other.csv", "3", "0")] {
        let vehicle = ["simulate", "--alpha", alpha, "--beta-quadratic", "0.5", "--relay", "2", "--half-width", "0.2"];
        let (_, log, _) = selfosc(&folder, &[&vehicle[..], &["--delay", "0.1", "--hold", "--noise", noise]].concat());
        std::fs::write(folder.path().join(name), log).unwrap();
    }
    let same = json(&folder, &["--validate", "same.csv"]);
    assert_eq!(same["reported"]["trust"], "good", "{}", same["reported"]["reasons"]);
    // Noise that leaves most of the variance explained is no fault of the model.
    let noisy = json(&folder, &["--validate", "noisy.csv"]);
    let fit = noisy["validation"][0]["prediction"]["fit_percent"].as_f64().unwrap();
    assert!((30.0..85.0).contains(&fit) && noisy["reported"]["trust"] == "good", "{noisy}");
    let other = json(&folder, &["--validate", "same.csv", "other.csv"]);
    let reported = &other["reported"];
    assert_eq!((&reported["trust"], &reported["reasons"][0]["code"]), (&"doubtful".into(), &"does-not-predict".into()));
    assert_eq!(reported["alpha"], same["reported"]["alpha"]);
    std::fs::write(folder.path().join("model.json"), other.to_string()).unwrap();
    let (status, _, complaint) = selfosc(&folder, &["tune", "--model", "model.json", "--bandwidth", "0.5"]);
    assert!(status == 2 && complaint.contains("does-not-predict"), "{complaint}");
    golden!("identify-does-not-predict", reported["reasons"][0]["text"].as_str().unwrap());
}

/// An oscillation that is locked to the sampling repeats itself: further cycles bring no new reading, and the advice says so.
#[test]
fn a_locked_oscillation_asks_for_another_level() {
    let heading = |noise: &str| {
        let axis = ["simulate", "--alpha", "0.033", "--beta", "0.01", "--beta-quadratic", "0.06", "--delay", "0.2"];
        let record = ["--relay", "0.02", "--half-width", "0.2", "--hold", "--rate", "10", "--cycles", "5"];
        let folder = tempfile::tempdir().unwrap();
        let sensor = ["--degrees", "--quantum", "0.017453292519943295", "--noise", noise];
        let (_, log, _) = selfosc(&folder, &[&axis[..], &record, &sensor].concat());
        std::fs::write(folder.path().join("log.csv"), log).unwrap();
        let (_, text, _) = selfosc(&folder, &["identify", "log.csv"]);
        (text.contains(" locked: "), text.contains("record another relay level"))
    };
    assert_eq!(heading("0"), (true, true));
    assert_eq!(heading("0.01"), (false, false));
}

/// A record that is given twice is no second record, under whatever name.
#[test]
fn a_record_given_twice_is_named() {
    let folder = simulated(AXIS, &["--noise", "0.003", "--cycles", "8"]);
    std::fs::copy(folder.path().join("log.csv"), folder.path().join("copy.csv")).unwrap();
    let (_, text, _) = selfosc(&folder, &["identify", "log.csv", "copy.csv"]);
    let line = text.lines().find(|line| line.contains("same-record")).unwrap();
    assert!(line.contains("copy.csv has the samples of log.csv"), "{line}");
    assert!(!selfosc(&folder, &["identify", "log.csv"]).1.contains("same-record"));
    // The same command with other readings is another record.
    let csv = std::fs::read_to_string(folder.path().join("log.csv")).unwrap();
    let moved = csv.lines().map(|line| match line.split(',').collect::<Vec<_>>()[..] {
        [time, output, input] if output.parse::<f64>().is_ok() => {
            format!("{time},{},{input}\n", output.parse::<f64>().unwrap() + 1e-6)
        }
        _ => format!("{line}\n"),
    });
    std::fs::write(folder.path().join("copy.csv"), moved.collect::<String>()).unwrap();
    assert!(!selfosc(&folder, &["identify", "log.csv", "copy.csv"]).1.contains("same-record"));
}

/// A heading that passes north is one motion for `autotune` too, in the unit of its log.
#[test]
fn a_process_of_a_heading_has_no_jumps() {
    let pool = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/pool/heading.csv")).unwrap();
    let place = pool.lines().next().unwrap().split(',').position(|name| name == "heading_deg").unwrap();
    let wrapped = pool.lines().map(|line| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if let Ok(heading) = cells[place].parse::<f64>() {
            cells[place] = format!("{:.6}", (heading + 350.0).rem_euclid(360.0));
        }
        cells.join(",") + "\n"
    });
    let folder = written(wrapped.collect::<String>());
    std::fs::write(folder.path().join("pool.csv"), &pool).unwrap();
    let gain = |log: &str| {
        let (_, answer, _) = selfosc(&folder, &["autotune", log, "--output", "heading_deg", "--json"]);
        serde_json::from_str::<serde_json::Value>(&answer).unwrap()["gains"]["proportional"].as_f64().unwrap()
    };
    assert!((gain("log.csv") / gain("pool.csv") - 1.0).abs() < 1e-3);
}

/// Where terms are looked for in a part of the record only, the answer says so, and its interval is that of all samples.
#[test]
fn a_long_record_says_where_terms_were_looked_for() {
    let [short, long] = ["40", "100"].map(|cycles| {
        let folder = simulated(AXIS, &["--noise", "0.003", "--cycles", cycles]);
        let found = json(&folder, &["--method", "fit"]);
        let told: Vec<String> =
            found["warnings"].as_array().unwrap().iter().map(|one| one["code"].to_string()).collect();
        assert_eq!(found["reported"]["trust"], "good");
        let std = found["reported"]["alpha"]["std"].as_f64().unwrap();
        (found["record"]["samples"].as_u64().unwrap(), told, std)
    });
    assert!(short.0 <= 4000 && short.1.is_empty(), "{short:?}");
    assert!(long.0 > 4000 && long.1 == ["\"searched-in-part\""], "{long:?}");
    assert!(long.2 < 0.8 * short.2, "{short:?} {long:?}");
}

/// A depth is in m, and no autopilot's yaw loop takes its model.
#[test]
fn a_depth_has_no_yaw_loop() {
    let folder = simulated(AXIS, &["--noise", "0.003"]);
    let log = std::fs::read_to_string(folder.path().join("log.csv")).unwrap();
    std::fs::write(folder.path().join("log.csv"), log.replace("output", "depth_m")).unwrap();
    let found = json(&folder, &[]);
    assert_eq!(found["units"]["output"], "m");
    std::fs::write(folder.path().join("model.json"), found.to_string()).unwrap();
    let tuned = |format| selfosc(&folder, &["tune", "--model", "model.json", "--bandwidth", "0.5", "--format", format]);
    assert_eq!(["text", "json", "c", "ardusub", "px4"].map(|format| tuned(format).0), [0, 0, 0, 2, 2]);
    assert!(tuned("ardusub").2.contains("--format: the model's output is in m, and must be an angle"));
}

/// A firmware's gains are shares of full power, of which the relay used some.
#[test]
fn gains_of_a_firmware_are_shares_of_full_power() {
    let folder = tempfile::tempdir().unwrap();
    let whole = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/heater.csv")).unwrap();
    let halved = |line: &str| {
        let (before, command) = line.rsplit_once(',').unwrap();
        command.parse::<f64>().map_or(line.to_owned(), |command| format!("{before},{}", 0.5 * command))
    };
    std::fs::write(folder.path().join("whole.csv"), &whole).unwrap();
    std::fs::write(folder.path().join("half.csv"), whole.lines().map(halved).collect::<Vec<_>>().join("\n")).unwrap();
    let gains = |log: &str, more: &[&str]| {
        let (status, answer, _) = selfosc(&folder, &[&["autotune", log, "--form", "klipper"], more].concat());
        assert_eq!(status, 0, "{answer}");
        let of = |name: &str| answer.lines().find_map(|line| line.trim().strip_prefix(name)).unwrap().trim().to_owned();
        ["pid_Kp:", "pid_Ki:", "pid_Kd:"].map(|name| of(name).parse::<f64>().unwrap())
    };
    let expected = gains("whole.csv", &[]);
    // Klipper divides its gains by 255 and its power goes from 0 to 1 (klippy/extras/heaters.py).
    let (_, parallel, _) = selfosc(&folder, &["autotune", "whole.csv"]);
    let of = |name: &str| {
        parallel.lines().find_map(|line| line.trim().strip_prefix(name)?.split_whitespace().next()).unwrap()
    };
    for (gain, name) in expected.into_iter().zip(["Kp ", "Ki ", "Kd "]) {
        assert!((gain / 255.0 / of(name).parse::<f64>().unwrap() - 1.0).abs() < 1e-3, "{gain} for {name}{}", of(name));
    }
    for (full_power, factor) in [("0.5", 1.0), ("1", 0.5)] {
        for (gain, expected) in gains("half.csv", &["--full-power", full_power]).into_iter().zip(expected) {
            assert!((gain / (factor * expected) - 1.0).abs() < 1e-3, "{gain} for {factor} times {expected}");
        }
    }
    // The level of an inverted pin.
    let inverted = |line: &str| {
        let (before, command) = line.rsplit_once(',').unwrap();
        command.parse::<f64>().map_or(line.to_owned(), |command| format!("{before},{}", 1.0 - command))
    };
    let pin = whole.lines().map(inverted).collect::<Vec<_>>().join("\n");
    std::fs::write(folder.path().join("pin.csv"), pin).unwrap();
    let (status, _, message) = selfosc(&folder, &["autotune", "pin.csv", "--form", "marlin"]);
    assert!(status == 2 && message.contains("firmware takes no negative gains"), "{message}");
    let (status, _, message) = selfosc(&folder, &["autotune", "half.csv", "--form", "klipper"]);
    assert_eq!(status, 2);
    assert!(
        message.contains("0.5, is neither 1, 100 nor 255; give the command at full power (--full-power)"),
        "{message}"
    );
    assert_eq!(selfosc(&folder, &["autotune", "half.csv", "--form", "ideal"]).0, 0);
    let (status, _, message) = selfosc(&folder, &["autotune", "half.csv", "--form", "ideal", "--full-power", "1"]);
    assert_eq!(status, 2);
    assert!(message.contains("--full-power: this form has gains in units of the command"), "{message}");
}

/// A column of a heading without degrees is in radians, and its sensor is a compass.
#[test]
fn a_heading_in_radians_is_one() {
    let folder = simulated(AXIS, &["--noise", "0.003"]);
    let log = std::fs::read_to_string(folder.path().join("log.csv")).unwrap();
    let found = |column: &str| {
        std::fs::write(folder.path().join("log.csv"), log.replace("output", column)).unwrap();
        let found = json(&folder, &[]);
        let budget = found["reported"]["budget"].as_array().unwrap();
        (found["units"]["output"].clone(), budget.iter().any(|share| share["source"] == "heading-error"))
    };
    assert_eq!(found("heading"), ("rad".into(), true));
    assert_eq!(found("position"), ("output".into(), false));
    // The column of the experiment that counts in radians.
    assert_eq!(found(selfosc::on_board::Coordinate::HeadingRad.column()), ("rad".into(), true));
}

/// A neutral beside all commands would make a disturbance of them.
#[test]
fn a_neutral_far_from_the_commands_is_refused() {
    let folder = simulated(AXIS, &["--noise", "0.003"]);
    let (status, printed, message) = selfosc(&folder, &["identify", "log.csv", "--neutral", "1500"]);
    assert_eq!(status, 1);
    let message = printed + &message;
    assert!(message.contains("far from a neutral of 1500: say which command is neutral (--neutral 0)"), "{message}");
    assert_eq!(selfosc(&folder, &["identify", "log.csv", "--neutral", "0.5"]).0, 0);
}

/// A controller that holds its command for longer than the dead time is named; its gains hold the limit all the same.
#[test]
fn a_slow_controller_is_named() {
    let folder = simulated(AXIS, &["--noise", "0.003"]);
    let tuned = |interval: &str| -> Value {
        let (status, answer, _) = selfosc(&folder, &["autotune", "log.csv", "--interval", interval, "--json"]);
        assert_eq!(status, 0, "{answer}");
        serde_json::from_str(&answer).unwrap()
    };
    let [fast, slow] = ["0.02", "1"].map(tuned);
    let named =
        |answer: &Value| answer["reasons"].as_array().unwrap().iter().any(|one| one["code"] == "slow-controller");
    assert_eq!((named(&fast), named(&slow)), (false, true));
    // Half of the interval is half of the dead time where the interval is the dead time.
    let dead_s = fast["models"][0]["parameters"]["dead_time_s"]["value"].as_f64().unwrap();
    let around = [0.95, 1.05].map(|part| named(&tuned(&(part * dead_s).to_string())));
    assert_eq!(around, [false, true], "{dead_s} s");
    assert_eq!(fast["trust"], slow["trust"]);
    assert!(slow["sensitivity"]["proved_upper"].as_f64().unwrap() <= 1.4);
}

#[test]
fn refusals() {
    let square = |time: f64| if (time / 2.0).fract() < 0.5 { 1.0 } else { -1.0 };
    let wave = |time: f64| -(core::f64::consts::PI * time).cos();
    let steady = log(100, wave, square);
    let at_line_50 = |cell: &str| {
        let lines = steady.lines().enumerate();
        lines.map(|(n, line)| if n == 49 { format!("{cell}\n") } else { format!("{line}\n") }).collect::<String>()
    };
    let cases = [
        (
            "no full cycle",
            written(log(40, |t| t, |t| if t < 2.0 { 1.0 } else { -1.0 })),
            vec!["--method", "exact", "--delay", "0"],
        ),
        (
            "growing oscillation",
            written(log(200, |t| (0.03 * t).exp() * wave(t), square)),
            vec!["--method", "exact", "--delay", "0"],
        ),
        ("constant input", written(log(100, wave, |_| 1.0)), vec![]),
        ("non-finite cell", written(at_line_50("4.8,NaN,1")), vec![]),
        ("non-monotone time", written(at_line_50("4.6,0.5,1")), vec![]),
        ("no number", written(at_line_50("4.8,fast,1")), vec![]),
        ("unknown column", written(&steady), vec!["--output", "depth"]),
        ("empty file", written(""), vec![]),
        ("binary garbage", written([0x7f, b'E', b'L', b'F', 0, 1, 2, 0xff]), vec![]),
    ];
    let answers = cases.map(|(name, folder, arguments)| format!("{name}: {}\n", refusal(&folder, &arguments)));
    golden!("identify-refusals", answers.join("\n"));
}

#[test]
fn usage() {
    let folder = written(log(100, |time| time, |_| 1.0));
    let cases: [&[&str]; 3] =
        [&["absent.csv"], &["log.csv", "--delay", "-1"], &["log.csv", "--method", "iso", "--drag", "mixed"]];
    let answers = cases.map(|arguments| {
        let (status, answer, diagnostics) = selfosc(&folder, &[&["identify"], arguments].concat());
        assert_eq!((status, answer.as_str()), (2, ""));
        diagnostics
    });
    golden!("identify-usage", answers.join("\n"));
}

/// A report never replaces the log it is made from, by whatever name; nothing half-written stays.
#[test]
fn files_are_safe() {
    use std::fs;
    let folder = std::env::temp_dir().join(format!("selfosc-files-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let run = |arguments: &[&std::path::Path]| {
        let command =
            assert_cmd::Command::cargo_bin("selfosc").unwrap().arg("identify").args(arguments).output().unwrap();
        (command.status.code(), String::from_utf8(command.stdout).unwrap(), String::from_utf8(command.stderr).unwrap())
    };
    let log = folder.join("log.csv");
    fs::write(&log, "time_s,output,command\n0,0,1\n").unwrap();
    let roundabout = folder.join(".").join("log.csv");
    let (status, _, complaint) = run(&[&log, "--report".as_ref(), &roundabout]);
    assert!(status == Some(2) && complaint.contains("is the input"), "{complaint}");
    #[cfg(unix)]
    {
        let link = folder.join("report.html");
        fs::hard_link(&log, &link).unwrap();
        let (status, _, complaint) = run(&[&log, "--report".as_ref(), &link]);
        assert!(status == Some(2) && complaint.contains("is the input"), "{complaint}");
        let (status, answer, complaint) = run(&["/dev/zero".as_ref()]);
        assert!(status != Some(0) && (answer + &complaint).contains("longer than 256 MiB"), "{complaint}");
    }
    assert_eq!(fs::read_to_string(&log).unwrap(), "time_s,output,command\n0,0,1\n");
    fs::remove_dir_all(&folder).unwrap();
}

/// The samples hold the log, and residuals that are output less model, as small as the prediction of the same log says; an outlier has none.
#[test]
fn samples_hold_the_log_the_model_and_its_residuals() {
    let folder = simulated(AXIS, &["--cycles", "12", "--noise", "0.01"]);
    let clean = std::fs::read_to_string(folder.path().join("log.csv")).unwrap();
    let arguments = ["--validate", "log.csv", "--samples", "samples.csv", "--progress"];
    let (status, answer, stages) = selfosc(&folder, &[&["identify", "log.csv", "--json"], &arguments[..]].concat());
    assert_eq!(status, 0, "{stages}");
    assert_eq!(stages.lines().next(), Some("looking for cycles"));
    let answer: Value = serde_json::from_str(&answer).unwrap();
    let rms = answer["validation"][0]["prediction"]["rms"].as_f64().unwrap();
    let rows = |folder: &TempDir| -> Vec<Vec<Option<f64>>> {
        let text = std::fs::read_to_string(folder.path().join("samples.csv")).unwrap();
        assert_eq!(text.lines().next(), Some("record,time_s,output,input,model,residual"));
        text.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().ok()).collect()).collect()
    };
    let found = rows(&folder);
    let logged =
        clean.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().ok()).collect::<Vec<Option<f64>>>());
    assert!(logged.eq(found.iter().map(|row| row[1..4].to_vec())));
    let residuals: Vec<f64> = found.iter().filter_map(|row| row[5]).collect();
    assert!(found.iter().all(|row| row[4].is_none() || row[2].unwrap() - row[4].unwrap() == row[5].unwrap()));
    let own = (residuals.iter().map(|residual| residual * residual).sum::<f64>() / residuals.len() as f64).sqrt();
    approx::assert_relative_eq!(own, rms, max_relative = 1e-9);
    assert!(rms < 0.012 && residuals.len() + 10 > found.len());
    // One reading off by far.
    let mut lines: Vec<String> = clean.lines().map(str::to_owned).collect();
    let off = lines.len() / 2;
    let cells: Vec<&str> = lines[off].split(',').collect();
    lines[off] = format!("{},{},{}", cells[0], cells[1].parse::<f64>().unwrap() + 5.0, cells[2]);
    std::fs::write(folder.path().join("log.csv"), lines.join("\n")).unwrap();
    selfosc(&folder, &["identify", "log.csv", "--samples", "samples.csv"]);
    assert_eq!(rows(&folder)[off - 1][4..], [None, None]);
}
