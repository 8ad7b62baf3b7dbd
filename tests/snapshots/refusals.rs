//! Bad inputs to every subcommand: each ends with status 1 or 2 and says what is wrong, word for word.

use assert_cmd::Command;

use crate::golden;

const BAD: &str = include_str!("bad_inputs.txt");

#[test]
fn every_bad_input_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("empty.csv", ""),
        ("header.csv", "time_s,heading_deg,command\n"),
        ("words.csv", "time_s,heading_deg,command\n0,north,1\n1,2,1\n"),
        ("ragged.csv", "time_s,heading_deg,command\n0,1,1\n1,2\n"),
        ("columns.csv", "a,b,c\n0,1,1\n1,2,1\n"),
        (
            "still.csv",
            &(0..600).fold("time_s,output,input\n".to_owned(), |text, i| text + &format!("{},0,1\n", i as f64 / 10.0)),
        ),
        (
            "back.csv",
            &(0..60).fold("time_s,output,input\n".to_owned(), |text, i| text + &format!("{},{},1\n", -i, i % 7)),
        ),
        ("model.json", "{\"reported\": null}"),
        (
            "doubtful.json",
            "{\"reported\": {\"alpha\": {\"value\": 1}, \"trust\": \"doubtful\", \"reasons\": [{\"code\": \"halves-disagree\"}]}}",
        ),
        ("broken.json", "{"),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let lines: Vec<&str> = BAD.lines().filter(|line| !line.is_empty()).collect();
    let mut table = String::new();
    for line in &lines {
        let output =
            Command::cargo_bin("selfosc").unwrap().args(line.split(' ')).current_dir(folder.path()).output().unwrap();
        let (status, said) = (output.status.code().unwrap(), [output.stdout, output.stderr].concat());
        let said = String::from_utf8(said).unwrap();
        assert!(
            matches!(status, 1 | 2) && said.trim().len() > 20 && !said.contains("panicked"),
            "{line}: {status} {said}"
        );
        table += &format!("selfosc {line}\n[{status}] {}\n\n", said.trim());
    }
    assert!(lines.len() >= 150, "{}", lines.len());
    golden!("bad-inputs", table);
}
