//! Every option of every subcommand that takes a value, with values that it cannot use: what is said names the value, the limit,
//! the remedy and the flag.

use std::ffi::OsString;
use std::panic::catch_unwind;
use std::process::{Command, Stdio};

use assert_cmd::cargo::CommandCargoExt;
use selfosc::command::{Answer, answer};

/// A call of each subcommand that works, and does little.
const CALLS: [&str; 18] = [
    "predict --alpha 1 --beta 1 --beta-quadratic 0 --delta 0 --delay 0 --relay 1 --half-width 0.2",
    "predict --num 1 --den 1,1 --delay 0 --relay 1,-1 --half-width 0.2 --reference 0 --periods 0.1,10",
    "simulate --alpha 1 --beta 1 --beta-quadratic 0 --delta 0 --delay 0 --relay 1 --half-width 0.2 --cycles 3 --rate 10 --quantum 0 --noise 0 --seed 0",
    "df relay-hysteresis --set half_width=0.2 --amplitude 1 --bias 0 --method closed-form",
    "df relay-dead-zone --set dead_zone=0.5 --gain 1 --bias 0",
    "df --fit FOLDER/gains.csv --bias 0",
    "df --list --page FOLDER/page.html",
    "balance --num 8 --den 1,2,2,1 --delay 0 --nonlinearity saturation --set breakpoint=1 --bias 0 --svg FOLDER/nyquist.svg --certificates FOLDER/proofs",
    "tune --alpha 1 --beta 0.5 --beta-quadratic 0 --bandwidth 0.5 --structure pd --delay 0.1 --step 1 --limit 9 --top-speed 1 --alpha-interval 0.9,1.1 --beta-interval 0.4,0.6 --beta-quadratic-interval 0,0.1 --delay-interval 0,0.2",
    "tune --model FOLDER/model.json --bandwidth 0.5",
    "tune --alpha 1 --beta 0.5 --delay 0.1 --delta 0.1 --ms 1.5 --format ardusub --full-command 1",
    "tune --alpha 1 --beta 0.5 --delay 0.1 --phase-margin 45",
    "design --alpha 1 --beta 1 --beta-quadratic 0 --delta 0 --delay 0.1 --level 1 --time 60 --rate 10 --quantum 0.01 --noise 0 --largest-amplitude 9 --proposals 1",
    "identify FOLDER/log.csv --method iso --time time_s --output output --input input --relay 1 --half-width 0.2 --delay 0 --drag linear --assume clock=0.5 --time-unit s --neutral 0 --from 0 --to 90 --part 1 --validate FOLDER/log.csv --report FOLDER/report.html --samples FOLDER/samples.csv --progress",
    "identify FOLDER/log.csv --method bounded --delay 0 --drag linear --error 0.01 --quantum 0.01 --jitter 0 --outliers 0 --budget 1",
    "autotune FOLDER/log.csv --time time_s --output output --input input --time-unit s --ms 1.6 --pi --derivative-filter 10 --interval 0.05 --from 0 --to 15 --part 1 --form klipper --full-power 1 --report FOLDER/report.html",
    "run --coordinate position --relay 1 --half-width 0.2 --interval 0.1 --excursion 1 --reference 0 --neutral 0 --offset 0 --lowest -2 --highest 2 --wrong-way 0.4 --dwell 0.4 --resolution 0 --largest-rate 1 --unchanged 5 --patience 20 --duration 300 --cycles 3 --spread 0.1 --most-cycles 12 --attempts 3 --factor 1.5 --timeout 1 --log FOLDER/run.csv --json FOLDER/run.json",
    "verify --claim lemma-1 --cases 1 --seed 1 --certificates FOLDER/proofs",
];
/// Other options, each with the test that holds it.
const ELSEWHERE: [&str; 9] = [
    "color",       // an enumeration of the parser's
    "only",        // the same
    "out",         // files.rs
    "formulas",    // claims.rs
    "check",       // files.rs
    "certificate", // files.rs
    "log",         // forgeries.rs
    "claim",       // bad_inputs.txt
    "set",         // bad_inputs.txt
];

/// The answer of the command; of one that reads lines, as a process whose standard input is empty.
fn ask(arguments: Vec<OsString>) -> Result<Answer, String> {
    if arguments[0] != "run" {
        return answer(arguments).map_err(|failure| failure.text);
    }
    let process = Command::cargo_bin("selfosc").unwrap().args(arguments).stdin(Stdio::null()).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    match process.status.code() {
        Some(1) => Ok(Answer { text: text(&process.stdout), no: false }),
        _ => Err(text(&process.stderr)),
    }
}

/// Nothing that an option takes for a number, a name or a path.
fn bad_values() -> Vec<String> {
    let plain = [
        "nan",
        "inf",
        "-inf",
        "-1",
        "-0.5",
        "0",
        "1e308",
        "-1e308",
        "1e-320",
        "1e999",
        "x",
        "",
        " ",
        "1,2",
        "3,1",
        "0x10",
        "1 0",
        "\u{661}",
        "no/such/folder/file",
        "18446744073709551616",
        "-",
        "--",
        "=",
        "\u{1b}[2J",
    ];
    let long = ["9".repeat(300), format!("0.{}1", "0".repeat(300)), "long".repeat(2000)];
    plain.into_iter().map(str::to_owned).chain(long).collect()
}

/// The options of a subcommand that take a value, as its help has them.
fn options(subcommand: &str) -> Vec<String> {
    let help = answer([subcommand, "--help"]).unwrap_err().text;
    let flags = help.lines().filter_map(|line| line.trim_start().strip_prefix("--").map(|rest| rest.to_owned()));
    let takes = |line: &String| line.contains(" <");
    flags.filter(takes).map(|line| line.split([' ', '=']).next().unwrap().to_owned()).collect()
}

/// What is missing in what is said of a value. Where a combination is refused, one of its flags and numbers is enough.
fn missing(said: &str, options: &[String], value: &str) -> Vec<&'static str> {
    let number = value.trim().parse::<f64>().ok();
    let shown = number.map(|number| [number.to_string(), format!("{number:e}")]);
    let cut: String = value.trim().chars().take(12).collect();
    let given = said.contains(&cut)
        || said.contains(&cut.escape_debug().to_string())
        || shown.iter().flatten().any(|shown| said.contains(shown));
    let another = value.chars().any(|c| c.is_ascii_digit()) && said.chars().any(|c| c.is_ascii_digit());
    let any = |words: &[&str]| words.iter().any(|word| said.contains(word));
    // The parser's words for no value at all.
    let none = any(&["a value is required"]);
    let longest_word = said.split_whitespace().map(|word| word.chars().count()).max().unwrap_or(0);
    let has = [
        ("flag", options.iter().any(|option| said.contains(&format!("--{option}")))),
        ("value", given || another),
        (
            "limit",
            none || any(&[
                "must ",
                "possible values",
                "at most",
                "at least",
                "up to",
                "from ",
                "above 0",
                "none is named",
                "cannot",
                "is a folder",
                "unknown",
            ]),
        ),
        ("remedy", none || any(&["; ", "(--", "possible values", ": say"])),
        ("cut", longest_word < 250 && said.chars().filter(char::is_ascii_digit).count() < 200 && said.len() < 1500),
    ];
    has.into_iter().filter(|(_, has)| !has).map(|(part, _)| part).collect()
}

#[test]
fn every_refused_value_is_named_with_its_limit_its_remedy_and_its_flag() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().to_str().unwrap();
    let record = "simulate --alpha 1 --beta 1 --relay 1 --half-width 0.2 --cycles 10 --rate 20 --hold --quantum 0.01";
    let log = answer(record.split(' ')).unwrap().text;
    let model =
        r#"{"reported": {"trust": "good", "alpha": {"value": 1}, "beta": {"value": 0.5, "low": 0.4, "high": 0.6}}}"#;
    let gains = "amplitude,p\n1,1.2\n2,0.6\n4,0.3\n";
    for (name, text) in [("log.csv", &log[..]), ("model.json", model), ("gains.csv", gains)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    std::fs::create_dir(folder.path().join("bad")).unwrap();
    let mut wrong = Vec::new();
    let mut refused = 0;
    let mut seen = std::collections::BTreeMap::new();
    for call in CALLS {
        let call: Vec<String> = call.split(' ').map(|word| word.replace("FOLDER", place)).collect();
        let plain = ask(call.iter().map(OsString::from).collect());
        assert!(plain.is_ok(), "{call:?}: {plain:?}");
        let all = options(&call[0]);
        for option in &all {
            let known = seen.entry(format!("{} --{option}", call[0])).or_insert(ELSEWHERE.contains(&option.as_str()));
            let flag = format!("--{option}");
            let Some(at) = call.iter().position(|word| *word == flag).filter(|_| !ELSEWHERE.contains(&option.as_str()))
            else {
                continue;
            };
            *known = true;
            for value in bad_values() {
                let mut arguments: Vec<OsString> = call.iter().map(OsString::from).collect();
                // Files only where they are thrown away.
                let path = call[at + 1].starts_with(place) && !value.is_empty();
                let value = if path { format!("{place}/bad/{value}") } else { value };
                arguments.splice(at..at + 2, [OsString::from(format!("{flag}={value}"))]);
                let said = match catch_unwind(|| ask(arguments)) {
                    Ok(Ok(answer)) if !answer.no || answer.text.starts_with("no oscillation") => continue,
                    Ok(Ok(answer)) => answer.text,
                    Ok(Err(text)) => text,
                    Err(_) => "PANIC".to_owned(),
                };
                refused += 1;
                let lacks = missing(&said, &all, &value);
                if !lacks.is_empty() {
                    let cut: String = said.chars().take(400).collect();
                    wrong.push(format!("{} {flag}={:.30}: no {}: {cut}", call[0], value, lacks.join(", ")));
                }
            }
        }
    }
    let untried: Vec<_> = seen.iter().filter(|(_, tried)| !**tried).collect();
    assert!(untried.is_empty(), "no call has {untried:?}");
    assert!(refused > 1500, "{refused}");
    assert!(wrong.is_empty(), "{} of them:\n{}", wrong.len(), wrong.join("\n"));
}
