//! Proofs with something changed, of `fixtures/forgeries.json`: each is refused by name, within 500 MiB. The second checker is held to
//! refuse the same (`spec/checker/test_forgeries.py`).

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};

/// Stands for text that is no JSON.
const RAW: &str = "as it stands";

/// Runs with an address space of 500 MiB and 20 s of the processor.
fn run(folder: &Path, arguments: &str) -> Output {
    let command =
        format!("ulimit -v 512000 -t 20; exec {} {arguments}", assert_cmd::cargo::cargo_bin("selfosc").display());
    Command::new("bash").args(["-c", &command]).current_dir(folder).output().expect("a shell")
}

/// What a successful run prints.
fn done(folder: &Path, arguments: &str) -> String {
    let output = run(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {output:?}");
    String::from_utf8(output.stdout).expect("text")
}

/// A record rounded to a hundredth, with a delay that it has not, and one with an unknown delay.
fn write_proofs(folder: &Path) {
    let log = |name: &str, more: &str| {
        let loop_ = "simulate --alpha 1 --beta 0.5 --relay 1 --half-width 0.3 --hold --quantum 0.01 --cycles";
        fs::write(folder.join(name), done(folder, &format!("{loop_} {more}"))).expect("a log");
    };
    log("log.csv", "5");
    log("late.csv", "6 --delay 0.1");
    let identify = "--method bounded --drag linear --certificate";
    done(folder, &format!("identify log.csv {identify} consistent.json --delay 0"));
    done(folder, &format!("identify log.csv {identify} refuted.json --delay 0.02"));
    done(folder, &format!("identify late.csv {identify} late.json"));
    let heater = "predict --num 2 --den 30,1 --delay 4 --relay 1,0 --half-width 0.1 --reference 1.2";
    done(folder, &format!("{heater} --certificate heater.json"));
    done(folder, "verify --claim lemma-1 --cases 1 --certificates .");
}

/// The text of a proof after some changes; places are JSON pointers.
fn forged(proof: &Value, changes: &[Value]) -> String {
    let (mut whole, mut raw) = (proof.clone(), String::new());
    for change in changes {
        let at = change["at"].as_str().expect("a place");
        let number =
            |name: &str| change.get(name).and_then(Value::as_u64).map(|number| usize::try_from(number).expect("small"));
        if change.get("drop").is_some() {
            let (parent, last) = at.rsplit_once('/').expect("a part");
            match whole.pointer_mut(parent).expect("a place") {
                Value::Array(items) => _ = items.remove(last.parse().expect("a number")),
                Value::Object(fields) => _ = fields.remove(last),
                other => panic!("{at}: {other}"),
            }
            continue;
        }
        // A field that is not there yet.
        if let Some((parent, last)) = at.rsplit_once('/')
            && let Some(Value::Object(fields)) = whole.pointer_mut(parent)
        {
            fields.entry(last).or_insert(Value::Null);
        }
        let copied =
            change.get("copy").map(|other| whole.pointer(other.as_str().expect("a place")).expect("a part").clone());
        let place = whole.pointer_mut(at).expect("a place");
        if let Some(value) = change.get("to") {
            *place = value.clone();
        } else if let Some(factor) = change.get("times") {
            *place = json!(place.as_f64().expect("a number") * factor.as_f64().expect("a number"));
        } else if let Some(count) = number("keep") {
            place.as_array_mut().expect("a list").truncate(count);
        } else if let Some(count) = number("repeat") {
            *place = vec![change["of"].clone(); count].into();
        } else if let Some(copied) = copied {
            place.as_array_mut().expect("a list").push(copied);
        } else {
            *place = RAW.into();
            raw = number("nest").map_or_else(
                || change["raw"].as_str().expect("text").to_owned(),
                |depth| "[".repeat(depth) + &"]".repeat(depth),
            );
        }
    }
    whole.to_string().replace(&format!("\"{RAW}\""), &raw)
}

#[test]
fn every_forgery_is_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    write_proofs(folder);
    for (proof, log) in [("consistent", "log"), ("refuted", "log"), ("late", "late")] {
        let said = done(folder, &format!("verify --check {proof}.json --log {log}.csv"));
        assert!(said.starts_with("accepted") && said.contains("agrees in every stamp"), "{said}");
        // Every range on which the verdict depends.
        for range in [
            "drag, ",
            " delay",
            "within a factor of 100",
            "outlier",
            "rows, followed from row",
            "stamps within",
            "speeds up to",
            "1/alpha",
            "delta/alpha",
        ] {
            assert!(said.contains(range), "{proof}: no `{range}` in {said}");
        }
    }
    assert!(done(folder, "verify --check heater.json").starts_with("accepted"));
    let forgeries: Vec<Value> =
        serde_json::from_str(include_str!("../../fixtures/forgeries.json")).expect("a list of forgeries");
    let mut wrong = Vec::new();
    for forgery in &forgeries {
        let [name, of, code] = ["name", "of", "refused"].map(|field| forgery[field].as_str().expect("a text"));
        let proof =
            serde_json::from_slice(&fs::read(folder.join(format!("{of}.json"))).expect("a proof")).expect("JSON");
        fs::write(folder.join("forged.json"), forged(&proof, forgery["change"].as_array().expect("changes")))
            .expect("a file");
        let output = run(folder, "verify --check forged.json");
        let [said, complaint] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("text"));
        let refused = match code {
            // What is no certificate is an error of the input.
            "foreign" => output.status.code() == Some(2) && complaint.contains("is no certificate"),
            "refused" => output.status.code() == Some(1) && said.contains("refused") || output.status.code() == Some(2),
            code => output.status.code() == Some(1) && said.starts_with(&format!("refused   {code}: ")),
        };
        if !refused {
            wrong.push(format!("{name} ({code}): {:?} {said} {complaint}", output.status));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), forgeries.len(), wrong.join("\n"));
}

/// The first row that is not the log's is named.
#[test]
fn rows_of_another_log_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    write_proofs(folder);
    let log = fs::read_to_string(folder.join("log.csv")).expect("a log");
    let with = |row: usize, column: usize, value: &str| -> String {
        let rows = log.lines().enumerate().map(|(number, line)| {
            let mut fields: Vec<&str> = line.split(',').collect();
            if number == row {
                fields[column] = value;
            }
            fields.join(",") + "\n"
        });
        rows.collect()
    };
    for (column, value, what) in [(0, "0.41", "stamp"), (1, "0.29", "reading"), (2, "0.5", "command")] {
        fs::write(folder.join("other.csv"), with(5, column, value)).expect("a log");
        let output = run(folder, "verify --check consistent.json --log other.csv");
        let said = String::from_utf8(output.stdout).expect("text");
        assert!(output.status.code() == Some(1) && said.starts_with("refused   log: row 5 of log 1"), "{said}");
        assert!(said.contains(what), "{said}");
    }
    let output = run(folder, "verify --check consistent.json --log log.csv late.csv");
    assert!(String::from_utf8(output.stdout).expect("text").starts_with("refused   log: 2 logs"));
}
