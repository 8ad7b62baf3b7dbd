//! The ITF1788 vectors: every result contains the tightest one; how often it is the tightest stands in `spec/conformance.md`.

use std::collections::BTreeMap;
use std::fmt::Write;

use selfosc::numeric::{Interval, Real};

const VECTORS: &str = include_str!("../../fixtures/itf1788/vectors.csv");
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/spec/conformance.md");

/// Why an operation's results are not all the tightest.
const REASONS: [(&str, &str); 22] = [
    ("abs", "the entire line is sticky"),
    ("acos", "correction of a guess: a few roundings"),
    ("asin", "correction of a guess: a few roundings"),
    ("atan", "correction of a guess: a few roundings"),
    ("atanh", "logarithm of a quotient"),
    ("cos", "reduction and series; a long interval beyond 2^20 gives [-1, 1]"),
    ("cosh", "exponential and its reciprocal"),
    ("div", "a divisor with zero leaves the domain"),
    ("exp", "reduction and series"),
    ("expm1", "reduction and series"),
    ("log", "correction of a guess: a few roundings"),
    ("logp1", "correction of a guess; an argument that reaches minus one leaves the domain"),
    ("max", "the entire line is sticky"),
    ("min", "the entire line is sticky"),
    ("mul", "zero times the entire line is the entire line, which is sticky"),
    (
        "pow",
        "exponential of a product with a logarithm, whose rounding grows with the exponent; a base below zero leaves the domain",
    ),
    ("recip", "a divisor with zero leaves the domain"),
    ("sin", "reduction and series; a long interval beyond 2^20 gives [-1, 1]"),
    ("sinh", "exponential and its reciprocal"),
    ("sqrt", "an argument that reaches below zero leaves the domain"),
    ("tan", "quotient of sine and cosine; a pole within leaves the domain"),
    ("tanh", "quotient of exponentials"),
];

/// The operation by the vectors' name; `None` where the result is empty.
fn apply(operation: &str, a: Interval, b: Option<Interval>) -> Option<Interval> {
    let second = || b.unwrap_or_else(|| panic!("{operation} takes two"));
    Some(match operation {
        "neg" => -a,
        "sqr" => a.square(),
        "sqrt" => a.sqrt(),
        "recip" => Interval::ONE / a,
        "exp" => a.exp(),
        "expm1" => a.exp_m1(),
        "log" => a.ln(),
        "logp1" | "log1p" => a.ln_1p(),
        "sin" => a.sin(),
        "cos" => a.cos(),
        "tan" => a.tan(),
        "asin" => a.asin(),
        "acos" => a.acos(),
        "atan" => a.atan(),
        "sinh" => a.sinh(),
        "cosh" => a.cosh(),
        "tanh" => a.tanh(),
        "atanh" => a.atanh(),
        "abs" => a.abs(),
        "floor" => a.floor(),
        "add" => a + second(),
        "sub" => a - second(),
        "mul" => a * second(),
        "div" => a / second(),
        "pow" => a.pow(second()),
        "min" => a.min(second()),
        "max" => a.max(second()),
        "convexHull" => a.hull(second()),
        "intersection" => return a.intersection(second()),
        other => panic!("no operation {other}"),
    })
}

/// The two ends from a line's fields; `None` where they are blank.
fn ends(fields: &[&str]) -> Option<Interval> {
    let number = |text: &str| text.parse::<f64>().ok();
    Interval::new(number(fields[0])?, number(fields[1])?)
}

/// Doubles between two, of which the first is not above the second.
fn steps(lower: f64, upper: f64) -> u64 {
    let place = |x: f64| {
        let bits = (x + 0.0).to_bits().cast_signed();
        if bits < 0 { i64::MIN - bits } else { bits }
    };
    place(upper).abs_diff(place(lower))
}

#[derive(Default)]
struct Count {
    vectors: usize,
    tightest: usize,
    entire: usize,
    defined: usize,
    excess: Vec<u64>,
}

#[test]
fn vectors_are_contained_and_the_table_says_how_tightly() {
    let mut counts: BTreeMap<&str, Count> = BTreeMap::new();
    for line in VECTORS.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let (operation, a, b, expected) =
            (fields[1], ends(&fields[2..]).unwrap(), ends(&fields[4..]), ends(&fields[6..]));
        let found = apply(operation, a, b);
        let count = counts.entry(operation).or_default();
        count.vectors += 1;
        match (found, expected) {
            (found, expected) if found == expected => count.tightest += 1,
            (Some(Interval::ENTIRE), _) => count.entire += 1,
            (Some(found), Some(tightest)) => {
                assert!(tightest.is_subset_of(found), "{line}: {found}");
                let excess = steps(found.lower(), tightest.lower()).max(steps(tightest.upper(), found.upper()));
                count.excess.push(excess);
            }
            // Zero to the power zero is one here; the empty set lies in every interval.
            (Some(found), None) => {
                assert!(operation == "pow" && found.contains(1.0), "{line}: a value where there is none, {found}");
                count.defined += 1;
            }
            (None, _) => panic!("{line}: nothing where there is a value"),
        }
    }
    let table = table(&counts);
    if std::env::var_os("SELFOSC_WRITE_TABLES").is_some() {
        std::fs::write(TABLE, &table).unwrap();
    }
    let stored = std::fs::read_to_string(TABLE).unwrap_or_default();
    assert!(
        stored == table,
        "spec/conformance.md is not what the vectors give; write it with SELFOSC_WRITE_TABLES=1:\n{table}"
    );
}

fn table(counts: &BTreeMap<&str, Count>) -> String {
    let sum = |part: fn(&Count) -> usize| counts.values().map(part).sum::<usize>();
    let (vectors, tightest, entire) = (sum(|c| c.vectors), sum(|c| c.tightest), sum(|c| c.entire));
    let mut text = format!(
        "# Conformance of the interval arithmetic\n\n\
         Inclusion: for each of the {vectors} vectors of ITF1788 (`fixtures/itf1788`) of the implemented operations, the result contains the \
         tightest interval. {tightest} results are the tightest ({:.1} %); {entire} are the entire line, after a violated domain. The table \
         gives the excess width of the rest in doubles, at the worse end. `cargo test --test properties conformance` checks this page.\n\n\
         Differences from IEEE 1788:\n\n\
         - No decorations. A violated domain gives the entire line, which is sticky: every further operation keeps it. A partly defined \
         operation gives the entire line, where the standard gives the image of the defined part.\n\
         - No empty interval. An empty result is `None`.\n\n\
         | operation | vectors | tightest | entire line | 0^0 = 1 | wider | by at most | median | why |\n|---|---|---|---|---|---|---|---|---|\n",
        100.0 * tightest as f64 / vectors as f64
    );
    for (operation, Count { vectors, tightest, entire, defined, excess }) in counts {
        let mut excess = excess.clone();
        excess.sort_unstable();
        let number = |steps: Option<&u64>| match steps {
            None => "-".to_owned(),
            Some(steps) if *steps > 1_000_000 => "more than 1e6".to_owned(),
            Some(steps) => steps.to_string(),
        };
        let (most, median) = (number(excess.last()), number(excess.get(excess.len() / 2)));
        let why = REASONS.iter().find(|(name, _)| name == operation).map_or("", |(_, why)| why);
        let why = if tightest == vectors { "" } else { why };
        let wider = excess.len();
        writeln!(
            text,
            "| {operation} | {vectors} | {tightest} | {entire} | {defined} | {wider} | {most} | {median} | {why} |"
        )
        .unwrap();
    }
    text
}
