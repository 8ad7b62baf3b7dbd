//! What callers other than people read off an error: its code, and the number outside its domain.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use selfosc::Error;
use selfosc::control::UltimatePoint;
use selfosc::describing::Entry;
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::{RelayHysteresis, Sinusoid};
use selfosc::numeric::Limit;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;
use selfosc::vehicle::Thruster;

/// Codes that several enums give, each for one and the same reason.
const SHARED: [&str; 9] = [
    "below-switching",
    "condition-40",
    "foreign",
    "gap",
    "malformed",
    "not-finite",
    "out-of-domain",
    "time-order",
    "unreadable",
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let nested = |path: PathBuf| if path.is_dir() { sources(&path) } else { vec![path] };
    entries.flat_map(nested).filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

/// The short names of each enum in this source.
fn codes(source: &str) -> Vec<BTreeSet<&str>> {
    let tables = source.split("codes! { pub").skip(1).map(|rest| rest.split("\n} }\n").next().unwrap());
    tables.map(|table| table.split("=> \"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect()).collect()
}

#[test]
fn every_error_has_codes_of_its_own() {
    let mut owners: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for path in sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")) {
        let (source, file) = (std::fs::read_to_string(&path).unwrap(), path.display().to_string());
        // The error above all passes on what it wraps.
        let found = if source.contains("pub enum Error {") { Vec::new() } else { codes(&source) };
        let errors = source.matches("thiserror::Error)]").count();
        let apart = ["pub struct OutOfDomain", "enum CommandError", "pub enum Error {"];
        assert!(
            apart.iter().any(|name| source.contains(name)) || found.len() >= errors,
            "{file}: an error without `code`"
        );
        for code in found.into_iter().flatten() {
            assert!(!code.is_empty() && code.split('-').all(|word| !word.is_empty()), "{file}: {code:?}");
            assert!(code.chars().all(|c| c == '-' || c.is_ascii_lowercase() || c.is_ascii_digit()), "{file}: {code:?}");
            owners.entry(code.to_owned()).or_default().push(file.clone());
        }
    }
    assert!(owners.len() > 80, "{}", owners.len());
    for (code, files) in &owners {
        assert_eq!(files.len() > 1, SHARED.contains(&code.as_str()), "{code} in {files:?}");
    }
    for code in ["feature", "setting", "no-orbit", "condition-40", "not-a-relay", "unequal-columns", "overtime"] {
        assert!(owners.contains_key(code), "scripts know `{code}`");
    }
}

#[test]
fn errors_pass_between_threads_and_are_copied() {
    fn passes<T: std::error::Error + Send + Sync + Clone + PartialEq + 'static>() {}
    passes::<Error>();
}

#[test]
fn a_number_outside_its_domain_comes_through_every_layer() {
    let axis = DragAxis::linear(1.0, 0.1).unwrap();
    let relay = RelayHysteresis::new(1.0, 0.2, 0.0).unwrap();
    let row = |period_s| Oscillation {
        relay_level: 1.0,
        switch_level: 0.2,
        amplitude: 1.0,
        bias: 0.0,
        period_s,
        delay_s: 0.0,
    };
    let named = |settings: &[(String, f64)]| {
        let entry = Entry::find("relay-hysteresis")?;
        entry.build::<f64>(&entry.values(settings)?)
    };
    let setting = vec![("half_width".to_owned(), -1.0)];
    let refusals: [(Option<Error>, &str, &str, f64, Limit); 7] = [
        (DragAxis::linear(0.0, 0.1).err().map(Error::from), "out-of-domain", "alpha", 0.0, Limit::Positive),
        (axis.with_delay_s(-0.5).err().map(Error::from), "out-of-domain", "delay_s", -0.5, Limit::NonNegative),
        (Sinusoid::new(0.0, -2.0).err().map(Error::from), "out-of-domain", "amplitude", -2.0, Limit::Positive),
        (named(&setting).err().map(Error::from), "out-of-domain", "half_width", -1.0, Limit::NonNegative),
        (row(0.0).identify().err().map(Error::from), "feature", "period", 0.0, Limit::Positive),
        (
            UltimatePoint::new(1.0, -1.0).err().map(Error::from),
            "out-of-domain",
            "ultimate period",
            -1.0,
            Limit::Positive,
        ),
        (
            Thruster::affine(1.0, 0.0, 3.0, 2.0).err().map(Error::from),
            "out-of-domain",
            "largest command",
            2.0,
            Limit::Above(3.0),
        ),
    ];
    for (error, code, quantity, value, limit) in refusals {
        let error = error.unwrap_or_else(|| panic!("{quantity} = {value} accepted"));
        let fault = *error.out_of_domain().unwrap_or_else(|| panic!("{error}"));
        assert_eq!((error.code(), fault.quantity, fault.value, fault.limit), (code, quantity, value, limit));
        let text = error.to_string();
        let parts = [quantity.to_owned(), value.to_string(), fault.unit.to_owned(), limit.to_string()];
        for part in parts.iter().map(String::as_str).chain([fault.remedy]) {
            assert!(text.contains(part), "{text} lacks {part}");
        }
        assert!(!fault.remedy.is_empty(), "{text}");
    }
    let free = limit_cycle(&DragAxis::linear(1.0, 0.0).unwrap(), &relay).unwrap_err();
    assert_eq!((Error::from(free).code(), Error::from(free).out_of_domain()), ("no-drag", None));
}
