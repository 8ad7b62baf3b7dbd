//! Files of every subcommand: an input is never changed, an output is whole or not there, and nothing is left behind, whatever the
//! system does in between.
#![cfg(unix)]

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use assert_cmd::cargo::CommandCargoExt;
use sha2::{Digest, Sha256};
use tempfile::TempDir;

const AXIS: &str = "--alpha 1 --beta 1 --relay 1 --half-width 0.2";

/// From now on children begin with SIGINT, SIGTERM and SIGHUP that end them, even where this process was begun with these ignored, as a
/// shell's background job is: a handled signal is the default one after `exec`. This process still ends by them.
pub(crate) fn children_heed_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    for signal in [SIGINT, SIGTERM, SIGHUP] {
        let ends = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
        signal_hook::flag::register_conditional_default(signal, ends).unwrap();
    }
}

fn selfosc(folder: &TempDir) -> Command {
    let mut command = Command::cargo_bin("selfosc").unwrap();
    command.current_dir(folder).stdin(Stdio::null());
    command
}

fn run(folder: &TempDir, arguments: &str) -> Output {
    selfosc(folder).args(arguments.split_whitespace()).output().unwrap()
}

/// What both streams say.
fn said(output: &Output) -> String {
    [&output.stdout[..], &output.stderr].concat().iter().map(|byte| char::from(*byte)).collect()
}

/// Status and words of what is neither a panic nor silent.
fn refused(output: &Output) -> String {
    let said = said(output);
    assert!(
        output.status.code() == Some(2) && said.len() > 20 && !said.contains("panicked"),
        "{:?}: {said}",
        output.status
    );
    said
}

/// A folder with two logs of one axis, a model and a table of gains.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (log, level) in [("a.csv", "1"), ("b.csv", "2")] {
        let record = format!(
            "simulate {} --cycles 6 --rate 10 --hold --quantum 0.01",
            AXIS.replace("relay 1", &format!("relay {level}"))
        );
        let simulated = run(&folder, &record);
        assert_eq!(simulated.status.code(), Some(0), "{}", said(&simulated));
        fs::write(folder.path().join(log), simulated.stdout).unwrap();
    }
    fs::write(folder.path().join("gains.csv"), "amplitude,p\n1,1.2\n2,0.6\n4,0.3\n").unwrap();
    fs::write(
        folder.path().join("model.json"),
        r#"{"reported": {"trust": "good", "alpha": {"value": 1}, "beta": {"value": 0.5}}}"#,
    )
    .unwrap();
    folder
}

/// Names, bytes and inodes of what a folder holds.
fn holds(folder: &Path) -> Vec<(String, Vec<u8>, u64)> {
    let mut held: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|entry| {
            let path = entry.path();
            let about = fs::symlink_metadata(&path).unwrap();
            let bytes = if about.is_file() { fs::read(&path).unwrap() } else { Vec::new() };
            (entry.file_name().to_string_lossy().into_owned(), bytes, about.ino())
        })
        .collect();
    held.sort();
    held
}

/// A call of each subcommand that does little, those that write files with `OUT` in place of the file.
const CALLS: [&str; 18] = [
    "reproduce --only table3",
    "reproduce --only table3 --out OUT",
    "verify --claim lemma-1 --cases 1",
    "verify --claim lemma-1 --cases 1 --certificates OUT",
    "df relay --amplitude 1",
    "df --fit gains.csv",
    "df --list --page OUT",
    "balance --num 8 --den 1,2,2,1 --nonlinearity saturation --set breakpoint=1 --svg OUT",
    "predict --alpha 1 --beta 1 --relay 1 --half-width 0.2",
    "predict --num 1 --den 1,1 --relay 1 --half-width 0.2 --certificate OUT",
    "simulate --alpha 1 --beta 1 --relay 1 --half-width 0.2",
    "design --alpha 1 --beta 1 --level 1 --time 30",
    "identify a.csv --method iso --delay 0 --report OUT",
    "identify a.csv --method iso --delay 0 --samples OUT",
    "identify a.csv --method bounded --drag linear --delay 0 --budget 100 --certificate OUT",
    "tune --model model.json --bandwidth 0.5",
    "completions bash",
    "man OUT",
];

#[test]
fn no_output_is_an_input_or_another_output() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::hard_link(at("b.csv"), at("hard.html")).unwrap();
    symlink("b.csv", at("soft.html")).unwrap();
    symlink(folder.path(), at("round")).unwrap();
    symlink("nowhere.html", at("dangling.html")).unwrap();
    let before = holds(folder.path());
    for (arguments, other) in [
        ("identify a.csv --validate b.csv --report b.csv", "the input b.csv"),
        ("identify a.csv --validate b.csv --report round/b.csv", "the input b.csv"),
        ("identify a.csv b.csv --report hard.html", "the input b.csv"),
        ("identify a.csv b.csv --report soft.html", "the input b.csv"),
        ("identify b.csv --method bounded --report x --certificate x", "the output x"),
        ("identify b.csv --method bounded --report x --certificate round/./x", "the output x"),
        (
            "identify b.csv --method bounded --report nowhere.html --certificate dangling.html",
            "the output nowhere.html",
        ),
    ] {
        let said = refused(&run(&folder, arguments));
        let flag = arguments.rsplit("--").next().unwrap().split(' ').next().unwrap();
        assert!(said.contains(&format!("--{flag}: ")) && said.contains(other), "{arguments}: {said}");
        assert_eq!(holds(folder.path()), before, "{arguments}");
    }
    // Standard input and standard output are files, too.
    let own = || Stdio::from(File::open(at("a.csv")).unwrap());
    let end = || Stdio::from(File::options().append(true).open(at("a.csv")).unwrap());
    let redirected = selfosc(&folder).args(["identify", "-", "--report", "a.csv"]).stdin(own()).output().unwrap();
    assert!(refused(&redirected).contains("the input standard input"));
    let appended = selfosc(&folder).args(["identify", "a.csv"]).stdout(end()).output().unwrap();
    assert!(refused(&appended).contains("standard output is the input a.csv"));
    let both = selfosc(&folder).args(["df", "--list", "--page", "a.csv"]).stdout(end()).output().unwrap();
    assert!(refused(&both).contains("standard output"));
    let twice = selfosc(&folder).args(["identify", "-", "-"]).stdin(own()).output().unwrap();
    assert!(refused(&twice).contains("named twice"));
    assert_eq!(holds(folder.path()), before);
}

#[test]
fn a_link_stays_a_link_and_permissions_stay() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("elsewhere")).unwrap();
    fs::write(at("elsewhere/page.html"), "before").unwrap();
    fs::set_permissions(at("elsewhere/page.html"), PermissionsExt::from_mode(0o640)).unwrap();
    symlink("elsewhere/page.html", at("link.html")).unwrap();
    symlink("elsewhere/new.html", at("dangling.html")).unwrap();
    for name in ["link.html", "dangling.html", "plain.html"] {
        assert_eq!(run(&folder, &format!("df --list --page {name}")).status.code(), Some(0));
        assert!(fs::read_to_string(at(name)).unwrap().ends_with("</html>\n"), "{name}");
    }
    assert!(at("link.html").is_symlink() && at("dangling.html").is_symlink());
    let mode = |name: &str| fs::metadata(at(name)).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode("elsewhere/page.html"), 0o640);
    let masked = String::from_utf8(Command::new("sh").args(["-c", "umask"]).output().unwrap().stdout).unwrap();
    let mask = u32::from_str_radix(masked.trim(), 8).unwrap();
    assert_eq!((mode("plain.html"), mode("elsewhere/new.html")), (0o666 & !mask, 0o666 & !mask));
    assert_eq!(holds(&at("elsewhere")).len(), 2);
}

/// A pipe gives its bytes once: the report states the hash of what was read.
#[test]
fn the_report_states_what_was_read() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    assert!(Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
    let log = fs::read(at("a.csv")).unwrap();
    let writer = {
        let (pipe, log) = (at("pipe"), log.clone());
        std::thread::spawn(move || File::options().write(true).open(pipe).unwrap().write_all(&log).unwrap())
    };
    let found = run(&folder, "identify pipe --method iso --delay 0 --report report.html");
    writer.join().unwrap();
    assert_eq!(found.status.code(), Some(0), "{}", said(&found));
    let digest: String = Sha256::digest(&log).iter().map(|byte| format!("{byte:02x}")).collect();
    assert!(fs::read_to_string(at("report.html")).unwrap().contains(&format!("pipe: SHA-256 {digest}")));
    // And a pipe is written as it stands.
    let reader = {
        let pipe = at("pipe");
        std::thread::spawn(move || {
            let mut text = String::new();
            File::open(pipe).unwrap().read_to_string(&mut text).map(|_| text).unwrap()
        })
    };
    assert_eq!(run(&folder, "identify a.csv --method iso --delay 0 --report pipe").status.code(), Some(0));
    assert!(reader.join().unwrap().ends_with("</html>\n"));
}

/// Of a device without end no more is read than a log may have, with a gigabyte of memory.
#[test]
fn inputs_have_a_limit() {
    let folder = folder();
    for call in [
        "df --fit /dev/zero",
        "tune --bandwidth 1 --model /dev/zero",
        "identify /dev/zero",
        "identify a.csv --validate /dev/zero",
    ] {
        let binary = assert_cmd::cargo::cargo_bin("selfosc");
        let limited = format!("ulimit -v 1000000; exec {} {call}", binary.display());
        let output = Command::new("sh").args(["-c", &limited]).current_dir(&folder).output().unwrap();
        let said = refused(&output);
        assert!(
            said.contains("/dev/zero is longer than") && said.contains("MiB") && said.contains("; "),
            "{call}: {said}"
        );
    }
    for call in ["df --fit .", "tune --bandwidth 1 --model .", "identify ."] {
        let said = refused(&run(&folder, call));
        assert!(
            said.contains("cannot read .: Is a directory") && said.contains("; give the path of a file"),
            "{call}: {said}"
        );
    }
}

#[test]
fn a_full_disk_is_said_and_leaves_nothing() {
    let folder = folder();
    let before = holds(folder.path());
    for call in CALLS {
        let full = || Stdio::from(File::options().write(true).open("/dev/full").unwrap());
        let into = tempfile::tempdir().unwrap();
        let place = into.path().join("out").to_str().unwrap().to_owned();
        let output = selfosc(&folder).args(call.replace("OUT", &place).split(' ')).stdout(full()).output().unwrap();
        if !call.starts_with("man") {
            assert!(refused(&output).contains("cannot write the answer: No space left"), "{call}: {}", said(&output));
        }
        if call.contains("OUT") {
            let output = run(&folder, &call.replace("OUT", "/dev/full"));
            let said = refused(&output);
            assert!(said.contains("/dev/full") && said.contains("; choose a place"), "{call}: {said}");
        }
        for (name, ..) in holds(into.path()) {
            assert_eq!(name, "out", "{call}");
        }
        let help = selfosc(&folder).args([call.split(' ').next().unwrap(), "--help"]).stdout(full()).output().unwrap();
        assert!(refused(&help).contains("No space left"), "{call}");
    }
    assert_eq!(holds(folder.path()), before);
}

/// Standard output closed from the beginning, or by a reader that has seen enough: no failure, and no panic.
#[test]
fn closed_standard_output_is_no_failure() {
    let folder = folder();
    let binary = assert_cmd::cargo::cargo_bin("selfosc");
    for call in CALLS {
        let into = tempfile::tempdir().unwrap();
        let call = call.replace("OUT", into.path().join("out").to_str().unwrap());
        for ending in [">&-", ">&- 2>&-", "| head -c 1 >/dev/null"] {
            let piped = format!("{} {call} {ending}", binary.display());
            let output = Command::new("sh").args(["-c", &piped]).current_dir(&folder).output().unwrap();
            assert!(output.status.success() && !said(&output).contains("panicked"), "{piped}: {}", said(&output));
        }
    }
}

/// A byte that is no UTF-8: in the name of a file it works, elsewhere it is a named usage error.
#[test]
fn names_of_files_may_be_any_bytes() {
    let folder = folder();
    let strange = OsStr::from_bytes(b"\xff\x1b[2J\xe2\x80\xae.x");
    let log = OsStr::from_bytes(b"log\xff.csv");
    fs::copy(folder.path().join("a.csv"), folder.path().join(log)).unwrap();
    let with = |call: &[&OsStr]| selfosc(&folder).args(call).output().unwrap();
    let words = |text: &'static str| text.split(' ').map(OsStr::new).collect::<Vec<_>>();
    for call in [
        "df --list --page",
        "balance --num 8 --den 1,2,2,1 --nonlinearity saturation --set breakpoint=1 --svg",
        "man",
        "reproduce --only table3 --out",
    ] {
        let output = with(&[&words(call)[..], &[strange]].concat());
        assert_eq!(output.status.code(), Some(0), "{call}: {}", said(&output));
        let there = folder.path().join(strange);
        if there.is_dir() { fs::remove_dir_all(there).unwrap() } else { fs::remove_file(there).unwrap() }
    }
    let method = "--method iso --delay 0 --json --report";
    let output = with(&[&[OsStr::new("identify"), log][..], &words(method), &[strange]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["records"][0]["file"], "log\u{fffd}.csv");
    assert!(fs::read_to_string(folder.path().join(strange)).unwrap().contains("log\u{fffd}.csv: SHA-256"));
    // Everywhere else, in every place of every call.
    for call in CALLS {
        let words: Vec<&OsStr> = call.split(' ').map(OsStr::new).collect();
        for place in 0..=words.len() {
            let mut words = words.clone();
            words.insert(place, OsStr::from_bytes(b"1\xff"));
            let output = with(&words);
            let said = said(&output);
            assert!(!said.contains("panicked") && output.status.code() != Some(101), "{words:?}: {said}");
            // As the file that an output or a folder names it works.
            assert!(output.status.code() != Some(0) || call.contains("OUT"), "{words:?}: {said}");
            assert!(output.status.code() == Some(0) || said.len() > 20, "{words:?}: {said}");
        }
    }
    let said = refused(&with(&[OsStr::new("predict"), OsStr::new("--alpha"), OsStr::from_bytes(b"1\xff")]));
    assert!(
        said.contains("--alpha") && said.contains("must be UTF-8 unless it names a file; write it in UTF-8"),
        "{said}"
    );
}

/// JSON is JSON with any name in it, and no control character reaches it raw.
#[test]
fn a_json_answer_is_json_whatever_a_file_is_called() {
    let folder = folder();
    for name in
        ["\u{200f}", "\u{202e}", "\u{85}", "\u{7f}", "\u{9b}31m", "a\"b\\c", "\u{1b}[2J", "new\nline", "\u{2066}", "é"]
    {
        let name = format!("log {name}.csv");
        fs::copy(folder.path().join("a.csv"), folder.path().join(&name)).unwrap();
        let output =
            selfosc(&folder).args(["identify", &name, "--method", "iso", "--delay", "0", "--json"]).output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let document: serde_json::Value =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name:?}: {error}"));
        assert_eq!(document["records"][0]["file"], *name);
        assert!(
            !text.contains(|c: char| c.is_control() && c != '\n')
                && !text.contains(['\u{200f}', '\u{202e}', '\u{2066}'])
        );
        // Text for a pipe is as it is; escapes are for terminals.
        let output = selfosc(&folder).args(["identify", &name, "--method", "iso", "--delay", "0"]).output().unwrap();
        assert!(String::from_utf8(output.stdout).unwrap().contains(&name), "{name:?}");
    }
}

/// A reader of the file finds it whole at any time, and eight writers do not get in each other's way.
#[test]
fn many_writers_of_one_file() {
    let folder = folder();
    let page = folder.path().join("page.html");
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                for _ in 0..5 {
                    let written = run(&folder, "df --list --page page.html");
                    assert_eq!(written.status.code(), Some(0), "{}", said(&written));
                    assert!(fs::read_to_string(&page).unwrap().ends_with("</html>\n"));
                }
            });
        }
    });
    assert_eq!(holds(folder.path()).len(), 5);
}

/// A number that looks drawn, the same every time.
fn drawn(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

/// An interrupt at any moment leaves inputs as they were and no part of an output; what is there is whole.
#[test]
fn an_interrupt_leaves_nothing_behind() {
    children_heed_signals();
    let folder = folder();
    let before = holds(folder.path());
    let mut state = 51;
    let mut interrupted = 0;
    let calls = [
        "reproduce --only table2 table3 table4 --out OUT",
        "man OUT",
        "identify a.csv b.csv --delay 0 --report OUT/report.html",
        "verify --claim lemma-1 --cases 1 --certificates OUT",
    ];
    let command = |call: &str, into: &tempfile::TempDir| {
        let mut command = selfosc(&folder);
        let call = call.replace("OUT", into.path().to_str().unwrap());
        command.args(call.split(' ')).stdout(Stdio::null()).stderr(Stdio::piped());
        command
    };
    // How long it takes, that the moment falls inside.
    let lasts_us = calls.map(|call| {
        let begun = std::time::Instant::now();
        assert!(command(call, &tempfile::tempdir().unwrap()).status().unwrap().success(), "{call}");
        u64::try_from(begun.elapsed().as_micros()).unwrap()
    });
    for round in 0..20 {
        let into = tempfile::tempdir().unwrap();
        let (call, lasts_us) = (calls[round % calls.len()], lasts_us[round % calls.len()]);
        let child = command(call, &into).spawn().unwrap();
        std::thread::sleep(Duration::from_micros(drawn(&mut state) % lasts_us));
        let signal = ["INT", "TERM", "HUP"][round % 3];
        Command::new("kill").args([&format!("-{signal}"), &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        let by = output.status.signal();
        assert!(
            by.is_none_or(|by| [2, 15, 1][round % 3] == by) && !said(&output).contains("panicked"),
            "{call}: {by:?}"
        );
        interrupted += usize::from(by.is_some());
        for (name, bytes, _) in holds(into.path()) {
            assert!(!name.ends_with(".part") && !bytes.is_empty(), "{call}: {name} is left");
        }
        assert_eq!(holds(folder.path()), before, "{call}");
    }
    assert!(interrupted >= 10, "{interrupted} of 20 were interrupted");
}

/// What the parent has a process ignore stays ignored, as `nohup` wants it.
#[test]
fn an_ignored_signal_stays_ignored() {
    let folder = folder();
    let binary = assert_cmd::cargo::cargo_bin("selfosc");
    let ignoring = format!(
        "trap '' HUP; {} reproduce --only table3 --out out >/dev/null & kill -HUP $!; wait $!",
        binary.display()
    );
    let output = Command::new("sh").args(["-c", &ignoring]).current_dir(&folder).output().unwrap();
    assert!(output.status.success() && folder.path().join("out/report.html").is_file(), "{:?}", output.status);
}
