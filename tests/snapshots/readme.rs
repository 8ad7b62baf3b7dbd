//! What the README and the guide show is what happens: their commands run as typed, and picture and printed answer are the program's.

use std::path::Path;
use std::process::Command;

const PAGES: &str = concat!(include_str!("../../README.md"), include_str!("../../spec/guide.md"));

/// Lines of the blocks in a language.
fn blocks(language: &str) -> impl Iterator<Item = &'static str> {
    let fence = format!("```{language}\n");
    let starts: Vec<usize> = PAGES.match_indices(&fence).map(|(at, _)| at + fence.len()).collect();
    starts.into_iter().map(|start| PAGES[start..].split("```").next().unwrap_or_default())
}

/// A shell in an empty folder that has the fixtures, with the command on its path.
fn shell(line: &str, folder: &Path) -> std::process::Output {
    let program = assert_cmd::cargo::cargo_bin("selfosc");
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    Command::new("sh").args(["-c", line]).current_dir(folder).env("PATH", path).output().unwrap()
}

fn folder_with_fixtures() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let pool = folder.path().join("fixtures/pool");
    std::fs::create_dir_all(&pool).unwrap();
    std::fs::copy("fixtures/heater.csv", folder.path().join("fixtures/heater.csv")).unwrap();
    // The other logs that they speak of stand for records of one vehicle.
    for place in [
        pool.join("heading.csv"),
        folder.path().join("first.csv"),
        folder.path().join("second.csv"),
        folder.path().join("third.csv"),
    ] {
        std::fs::copy("fixtures/pool/heading.csv", place).unwrap();
    }
    folder
}

/// All claims at once, and all of the paper, are other tests'.
fn is_long(line: &str) -> bool {
    line.starts_with("selfosc verify\n")
        || line == "selfosc verify"
        || line.contains("--certificates")
        || line.contains("--out paper")
}

#[test]
fn commands_run_as_typed() {
    let folder = folder_with_fixtures();
    let lines: Vec<&str> = blocks("sh").flat_map(str::lines).filter(|line| line.starts_with("selfosc ")).collect();
    assert!(lines.len() > 12, "{lines:?}");
    for line in lines.into_iter().filter(|line| !is_long(line)) {
        let output = shell(line, folder.path());
        assert!(output.status.success(), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
        assert!(output.stderr.is_empty(), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    for made in ["report.html", "model.json", "log.csv", "proof.json"] {
        assert!(std::fs::metadata(folder.path().join(made)).unwrap().len() > 0, "{made}");
    }
}

/// Experiment, model and gains by one pipe of less than ten lines; the vehicle at the other end is the one that is simulated.
#[test]
fn the_pipe_gives_gains() {
    let pipe = PAGES.split("```").find(|block| block.contains("mkfifo")).unwrap();
    let (_, pipe) = pipe.split_once('\n').unwrap();
    assert!(pipe.lines().filter(|line| !line.trim().is_empty()).count() < 10, "{pipe}");
    let folder = folder_with_fixtures();
    let output = shell(&format!("set -e\n{pipe}"), folder.path());
    let answer = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{answer}\n{}", String::from_utf8_lossy(&output.stderr));
    for row in ["proportional gain", "margins", "largest sensitivity", "step: settling"] {
        assert!(answer.contains(row), "{row} in\n{answer}");
    }
    let model = std::fs::read(folder.path().join("model.json")).unwrap();
    let model: serde_json::Value = serde_json::from_slice(&model).unwrap();
    assert!((model["reported"]["alpha"]["value"].as_f64().unwrap() / 0.033 - 1.0).abs() < 0.02);
}

#[test]
fn the_first_answer_is_the_one_shown() {
    let folder = folder_with_fixtures();
    let output = shell("selfosc identify fixtures/pool/heading.csv", folder.path());
    let answer = String::from_utf8(output.stdout).unwrap();
    let shown = blocks("text").next().unwrap();
    for line in shown.lines().filter(|line| !line.trim().is_empty()) {
        assert!(answer.lines().any(|one| one == line), "README shows\n{line}\nand the answer is\n{answer}");
    }
}

/// With `SELFOSC_WRITE_TABLES=1` the pictures are written instead. The first is README's, too.
#[test]
fn the_gallery_is_the_program_s() {
    let folder = folder_with_fixtures();
    let between = |text: &str, from: &str, to: &str| {
        text.split_once(from).and_then(|(_, rest)| rest.split_once(to)).unwrap().0.to_owned()
    };
    for part in include_str!("../../spec/gallery.md").split("\n## ").skip(1) {
        let command = between(part, "```sh\n", "\n");
        let output = shell(&command, folder.path());
        assert!(output.status.success(), "{command}\n{}", String::from_utf8_lossy(&output.stderr));
        let page = std::fs::read_to_string(folder.path().join(command.rsplit(' ').next().unwrap())).unwrap();
        let title = between(part, "![", "]");
        let titled = |svg: &&str| svg.contains(&format!("aria-label=\"{title}"));
        let drawn = page.split("<svg").find(titled).and_then(|svg| svg.split_once("</svg>"));
        let picture = format!("<svg{}</svg>\n", drawn.unwrap_or_else(|| panic!("no figure {title}")).0);
        let file = format!("spec/{}", between(part, "](", ")"));
        if std::env::var_os("SELFOSC_WRITE_TABLES").is_some() {
            std::fs::write(&file, &picture).unwrap();
        }
        assert!(std::fs::read_to_string(&file).unwrap() == picture, "{file} is another picture");
    }
}

/// The sample log is what the command beside it makes.
#[test]
fn the_sample_log_is_simulated() {
    let made = shell(include_str!("../../fixtures/pool/make.sh"), Path::new("."));
    assert!(String::from_utf8(made.stdout).unwrap() == include_str!("../../fixtures/pool/heading.csv"));
}
