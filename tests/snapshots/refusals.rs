//! Bad inputs to every subcommand: each ends with status 1 or 2 and says what is wrong, word for word.

use std::path::Path;

use assert_cmd::Command;

use crate::golden;

/// A number and the arguments on each line.
const BAD: &str = include_str!("bad_inputs.txt");
/// The record that most of the files come from.
const GOOD: &str =
    "simulate --alpha 1 --beta 1 --relay 1 --half-width 0.3 --delay 0.2 --cycles 8 --hold --quantum 0.01";

fn selfosc(folder: &Path, arguments: &str) -> (i32, String) {
    let mut command = Command::cargo_bin("selfosc").unwrap();
    let output = command.args(arguments.split(' ')).current_dir(folder).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
}

/// The files that the arguments name.
fn write_files(folder: &Path) {
    let good = selfosc(folder, GOOD).1;
    let header = "time_s,output,input";
    let rows = || good.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse::<f64>().unwrap()));
    let log = |header: &str, row: fn(f64, [f64; 3]) -> [f64; 3]| {
        let line = |(k, mut row_of): (u32, _)| {
            let mut next = || Iterator::next(&mut row_of).unwrap();
            let [time, output, input] = row(f64::from(k), [next(), next(), next()]);
            format!("{time},{output},{input}\n")
        };
        format!("{header}\n{}", (0..).zip(rows()).map(line).collect::<String>())
    };
    let mended = |cells: &str| {
        let lines = good.lines().enumerate();
        lines.map(|(k, line)| format!("{}\n", if k == 20 { cells } else { line })).collect::<String>()
    };
    let reported = |alpha: &str| format!(r#"{{"reported": {{"trust": "good", "alpha": {alpha}}}}}"#);
    for (name, text) in [
        ("empty.csv", String::new()),
        ("header.csv", "time_s,heading_deg,command\n".to_owned()),
        ("words.csv", "time_s,heading_deg,command\n0,north,1\n1,2,1\n".to_owned()),
        ("ragged.csv", "time_s,heading_deg,command\n0,1,1\n1,2\n".to_owned()),
        ("columns.csv", "a,b,c\n0,1,1\n1,2,1\n".to_owned()),
        ("still.csv", log(header, |k, _| [k / 10.0, 0.0, 1.0])),
        ("back.csv", log(header, |k, _| [0.0 - k, k % 7.0, 1.0])),
        ("nan.csv", mended("1.9,nan,1")),
        ("infinite.csv", mended("1.9,inf,1")),
        ("huge.csv", mended("1.9,1e200,1")),
        ("blank.csv", mended("1.9,,1")),
        ("onerow.csv", good.lines().take(2).map(|line| format!("{line}\n")).collect()),
        ("crlf.csv", mended("1.9,0.x,1").replace('\n', "\r\n")),
        ("bom.csv", format!("\u{feff}{}", good.replace("output", "angle"))),
        ("duplicate.csv", good.replace("output,input", "heading_deg,heading_deg")),
        ("milliseconds.csv", log(header, |_, [time, output, input]| [1e3 * time, output, input])),
        ("microseconds.csv", log(header, |_, [time, output, input]| [1e6 * time, output, input])),
        ("heading.csv", log("time_s,heading,input", |_, [time, output, input]| [time, 57.3 * output, input])),
        ("pwm.csv", log(header, |_, [time, output, input]| [time, output, 1500.0 + 100.0 * input])),
        ("gap.csv", log(header, |k, [time, output, input]| [if k > 40.0 { time + 9.0 } else { time }, output, input])),
        (
            "restart.csv",
            log(header, |k, [time, output, input]| [if k < 60.0 { time } else { time - 5.0 }, output, input]),
        ),
        (
            "turns.csv",
            log(header, |k, [time, output, input]| [time, 57.3 * output + 360.0 * (k / 97.0).round(), input]),
        ),
        ("against.csv", log(header, |_, [time, output, input]| [time, output, -input])),
        ("step.csv", log(header, |k, [time, output, _]| [time, output, if k > 30.0 { 1.0 } else { -1.0 }])),
        ("joystick.csv", log(header, |_, [time, output, _]| [time, output, (0.7 * time).sin() + (1.9 * time).sin()])),
        ("exchanged.csv", good.replace("output,input", "input,output")),
        ("wide.csv", good.chars().flat_map(|letter| [letter, '\0']).collect()),
        ("model.json", r#"{"reported": null}"#.to_owned()),
        (
            "doubtful.json",
            r#"{"reported": {"alpha": {"value": 1}, "trust": "doubtful", "reasons": [{"code": "halves-disagree"}]}}"#
                .to_owned(),
        ),
        ("broken.json", "{".to_owned()),
        (
            "depth.json",
            r#"{"reported": {"trust": "good", "alpha": {"value": 1}}, "units": {"output": "m"}}"#.to_owned(),
        ),
        ("negative.json", reported(r#"{"value": -1}"#)),
        ("words.json", reported(r#"{"value": "heavy"}"#)),
        ("list.json", "[1, 2]".to_owned()),
        ("untrusted.json", reported(r#"{"value": 1}"#).replace("good", "certain")),
        ("reversed.json", reported(r#"{"value": 1, "low": 2, "high": 0.5}"#)),
        ("first-order.json", reported(r#"{"value": 0.1, "low": -0.1, "high": 0.3}"#)),
        ("good.csv", good.clone()),
    ] {
        std::fs::write(folder.join(name), text).unwrap();
    }
    std::fs::write(folder.join("binary.csv"), b"\x7fELF\0\x01\x02\xff").unwrap();
}

/// Numbers of more than four digits that the arguments do not have: a person reads three. Limits of counts are exact.
fn long_numbers<'a>(said: &'a str, arguments: &str) -> Vec<&'a str> {
    let numbers = said.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    let digits = |number: &str| number.replace('.', "").trim_matches('0').len();
    let counts = ["18446744073709551615", "10000000"];
    numbers
        .filter(|number| {
            digits(number) > 4 && !arguments.contains(number.trim_matches('.')) && !counts.contains(number)
        })
        .collect()
}

#[test]
fn every_bad_input_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    write_files(folder.path());
    let (mut table, mut count) = (String::new(), 0);
    for (number, line) in (1..).zip(BAD.lines()) {
        let line = line.strip_prefix(&format!("{number} ")).unwrap_or_else(|| panic!("{line} is not number {number}"));
        let (status, said) = selfosc(folder.path(), line);
        assert!(
            matches!(status, 1 | 2) && said.trim().len() > 20 && !said.contains("panicked"),
            "{line}: {status} {said}"
        );
        assert_eq!(long_numbers(&said, line), [""; 0], "{line}: {said}");
        let remedies = ["; ", ": say", "(--", "Usage", "possible values", "a value is required", "tip: "];
        assert!(line.ends_with("--json") || remedies.iter().any(|remedy| said.contains(remedy)), "{line}: {said}");
        table += &format!("selfosc {line}\n[{status}] {}\n\n", said.trim());
        count = number;
    }
    assert!(count >= 330, "{count}");
    golden!("bad-inputs", table);
}
