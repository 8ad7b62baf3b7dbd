//! One test a claim, and the traceability between the claims and their files, both ways.
#![allow(non_snake_case, reason = "a test is named after its claim's constant")]

use std::collections::BTreeSet;
use std::path::Path;

use selfosc::claims::{Budget, CLAIMS, Claim, Printed};

/// The claim's verdicts are the stated ones, its false variant is refuted, and so is the statement without each
/// hypothesis that has a counterexample.
fn check(claim: &Claim) {
    let budget = Budget { cases: 200, ..Budget::default() };
    let finding = claim.check(budget);
    assert!(finding.expected, "{}: {finding:?}", claim.id);
    let stream = claim.stream(budget);
    let falsified = (claim.falsified)(stream);
    assert!(falsified.is_refuted(), "{}: the false variant is not refuted: {falsified:?}", claim.id);
    for hypothesis in claim.hypotheses {
        if let Some(counterexample) = hypothesis.counterexample {
            let verdict = counterexample(stream);
            assert!(verdict.is_refuted(), "{}: without {}: {verdict:?}", claim.id, hypothesis.id);
        }
    }
}

macro_rules! one_test_each {
    ($($module:ident::$constant:ident),+ $(,)?) => {
        $(
            #[test]
            fn $constant() {
                check(&selfosc::claims::$module::$constant);
            }
        )+
    };
}
selfosc::for_each_claim!(one_test_each);

/// The value of a line `key: value` in the header of a claim's file.
fn header<'a>(claim: &'a Claim, key: &str) -> &'a str {
    let body = claim.spec.strip_prefix("```text\n").and_then(|rest| rest.split("```").next());
    let line = body.and_then(|header| header.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": ")));
    line.unwrap_or_else(|| panic!("spec/claims/{}.md has no `{key}` in its header", claim.id))
}

fn list(text: &str) -> Vec<&str> {
    if text == "none" { Vec::new() } else { text.split(", ").collect() }
}

#[test]
fn headers_say_what_the_registry_says() {
    for claim in CLAIMS {
        let printed = match claim.printed {
            Printed::Holds(_) => "holds",
            Printed::Refuted(_) => "refuted",
            Printed::Absent => "not-applicable",
        };
        let corrected = if claim.corrected.is_some() { "holds" } else { "not-applicable" };
        let hypotheses: Vec<_> = claim.hypotheses.iter().map(|hypothesis| hypothesis.id).collect();
        assert_eq!(header(claim, "id"), claim.id);
        assert_eq!(header(claim, "equation"), claim.equation, "{}", claim.id);
        assert_eq!(header(claim, "printed"), printed, "{}", claim.id);
        assert_eq!(header(claim, "corrected"), corrected, "{}", claim.id);
        assert_eq!(list(header(claim, "hypotheses")), hypotheses, "{}", claim.id);
        assert_eq!(list(header(claim, "depends")), claim.depends, "{}", claim.id);
    }
}

#[test]
fn files_explain_every_hypothesis() {
    for claim in CLAIMS {
        for hypothesis in claim.hypotheses {
            assert!(claim.spec.contains(&format!("- `{}`: ", hypothesis.id)), "{}: {}", claim.id, hypothesis.id);
            let without = format!("without `{}`", hypothesis.id);
            assert!(claim.spec.contains(&without), "spec/claims/{}.md must say what happens {without}", claim.id);
        }
    }
}

#[test]
fn every_file_has_a_claim_and_every_dependency_exists_before_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/claims");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    let ids: BTreeSet<String> = CLAIMS.iter().map(|claim| claim.id.to_owned()).collect();
    assert_eq!(files, ids);
    assert_eq!(ids.len(), CLAIMS.len(), "two claims of one id");
    for (place, claim) in CLAIMS.iter().enumerate() {
        for dependency in claim.depends {
            assert!(CLAIMS[..place].iter().any(|earlier| earlier.id == *dependency), "{}: {dependency}", claim.id);
        }
    }
}
