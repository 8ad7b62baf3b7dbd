//! Every claim checked, and the traceability between the claims and their files, both ways.

use std::collections::BTreeSet;
use std::path::Path;

use rayon::prelude::*;
use selfosc::claims::{
    AsPrinted, Budget, CLAIMS, Claim, ClaimDomain, ClaimPart, ClaimVariable, Evidence, Finding, Verdict, Witness, Word,
};

/// The claim's verdicts are the stated ones, its false variant is refuted, and so is the statement without each
/// hypothesis.
fn check(claim: &Claim) {
    let budget = Budget { cases: 200, ..Budget::default() };
    let finding = claim.check(budget);
    assert!(finding.expected, "{}: {finding:?}", claim.id);
    let whole = matches!(finding.word(), Word::Proved | Word::Exhausted);
    assert_eq!(
        claim.not_proved.is_none(),
        whole,
        "{}: {}, and the reason is {:?}",
        claim.id,
        finding.word(),
        claim.not_proved
    );
    let stream = claim.stream(budget);
    let falsified = (claim.falsified)(stream);
    assert!(falsified.is_refuted(), "{}: the false variant is not refuted: {falsified:?}", claim.id);
    for hypothesis in claim.hypotheses {
        let verdict = (hypothesis.counterexample)(stream);
        assert!(verdict.is_refuted(), "{}: without {}: {verdict:?}", claim.id, hypothesis.id);
    }
}

#[test]
fn every_claim_is_as_stated_and_its_false_variant_is_refuted() {
    CLAIMS.par_iter().for_each(check);
}

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
            AsPrinted::Holds(_) => "holds",
            AsPrinted::Refuted(_) => "refuted",
            AsPrinted::Approximate(_) => "approximate",
            AsPrinted::Absent => "not-applicable",
        };
        let corrected = if claim.corrected.is_some() { "holds" } else { "not-applicable" };
        assert_eq!(header(claim, "id"), claim.id);
        assert!(!claim.equation().is_empty(), "{}", claim.id);
        assert_eq!(header(claim, "printed"), printed, "{}", claim.id);
        assert_eq!(header(claim, "corrected"), corrected, "{}", claim.id);
        let domain = claim.domain();
        let parts: Vec<_> = domain.parts.iter().map(|part| part.name.as_ref()).collect();
        assert_eq!(list(header(claim, "domain")), parts, "{}", claim.id);
        let hypotheses = list(header(claim, "hypotheses"));
        assert!(claim.hypotheses.iter().all(|needed| hypotheses.contains(&needed.id)), "{}", claim.id);
    }
}

#[test]
fn files_explain_every_hypothesis() {
    for claim in CLAIMS {
        for hypothesis in list(header(claim, "hypotheses")) {
            assert!(claim.spec.contains(&format!("- `{hypothesis}`: ")), "{}: {hypothesis}", claim.id);
            let without = format!("without `{hypothesis}`");
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
        for dependency in claim.depends() {
            assert!(CLAIMS[..place].iter().any(|earlier| earlier.id == dependency), "{}: {dependency}", claim.id);
        }
    }
}

/// The items under a heading of a claim's file.
fn items<'a>(claim: &'a Claim, heading: &str) -> Vec<&'a str> {
    let Some((_, after)) = claim.spec.split_once(&format!("**{heading}**\n\n")) else { return Vec::new() };
    after.lines().map_while(|line| line.strip_prefix("- ")).collect()
}

#[test]
fn files_list_the_parts_of_the_domain_as_they_are_read() {
    for claim in CLAIMS {
        let part = |part: &ClaimPart| {
            let sides: Vec<_> = part.variables.iter().map(ToString::to_string).collect();
            let semicolon = if sides.is_empty() { "" } else { "; " };
            format!("`{}`: {}{semicolon}{}", part.name, part.text, sides.join(", "))
        };
        let parts: Vec<_> = claim.domain().parts.iter().map(part).collect();
        assert!(!parts.is_empty(), "{}", claim.id);
        assert_eq!(items(claim, "Domain"), parts, "{}", claim.id);
    }
}

/// Steps that speak of the program, which no proof about real numbers replaces.
const ABOUT_THE_PROGRAM: [&str; 5] = [
    "the cases of sign that are proved are all that the code accepts, and limits of them",
    "the command turns at the samples that the decisions name and at no others",
    "three outcomes, each with its comparisons, are all there are",
    "a vehicle is refused unless its inertia is positive definite and its linear drag takes no less than nothing",
    "solving by Cholesky's factors inverts the inertia",
];

#[test]
fn kernel_checked_claims_and_theories_name_each_other() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/formal");
    let mut marked = BTreeSet::new();
    for claim in CLAIMS {
        let Some(checked) = claim.kernel_checked() else {
            assert_eq!(items(claim, "Checked by a kernel"), [""; 0], "{}", claim.id);
            continue;
        };
        let item = format!("`{}`, `{}`: {}", checked.file, checked.theorem, checked.covers);
        assert_eq!(items(claim, "Checked by a kernel"), [item], "{}", claim.id);
        let theory = std::fs::read_to_string(folder.join(checked.file)).unwrap();
        assert!(theory.contains(&format!("\nTheorem {} ", checked.theorem)), "{}: {}", claim.id, checked.file);
        assert!(theory.contains(&format!("Print Assumptions {}.", checked.theorem)), "{}", checked.file);
        if checked.covers == "whole" {
            assert!(claim.by_hand().all(|step| ABOUT_THE_PROGRAM.contains(&step)), "{}", claim.id);
        }
        marked.insert(checked.file.to_owned());
    }
    let theories: BTreeSet<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.starts_with("Claim_") && name.ends_with(".v"))
        .collect();
    assert_eq!(marked, theories);
    for table in ["claims.tsv", "claims_b.tsv"] {
        let rows = std::fs::read_to_string(folder.join(table)).unwrap();
        for row in rows.lines().filter(|row| !row.starts_with('#')) {
            let id = row.split('\t').next().unwrap();
            assert!(Claim::find(id).is_some_and(|claim| claim.kernel_checked().is_some()), "{table}: {id}");
        }
    }
}

#[test]
fn the_formulas_of_the_theories_are_the_programs() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("spec/formal/Formulas.v");
    let kept = std::fs::read_to_string(file).unwrap();
    assert!(
        kept == selfosc::claims::formulas(),
        "run `selfosc verify --formulas spec/formal`, then spec/formal/check.sh"
    );
}

#[test]
fn the_page_of_verification_names_its_checkers_and_counts() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(root.join("spec/verification.md")).unwrap();
    let whole = |claim: &&Claim| claim.kernel_checked().is_some_and(|checked| checked.covers == "whole");
    let (checked, by_hand) =
        (CLAIMS.iter().filter(whole).count(), CLAIMS.iter().map(|claim| claim.by_hand().count()).sum::<usize>());
    let counts = format!(
        "Of {} claims Coq's kernel accepts {checked} as a whole; {by_hand} steps by hand are left in all.",
        CLAIMS.len()
    );
    assert!(page.contains(&counts), "{counts}");
    let rows: Vec<_> = page.lines().filter(|line| line.starts_with("| ")).skip(1).collect();
    assert!(rows.len() > 15);
    for row in rows {
        let checkers = row.trim_end_matches(" |").rsplit(" | ").next().unwrap();
        let paths: Vec<_> = checkers.split('`').skip(1).step_by(2).collect();
        assert!(!paths.is_empty(), "{row}");
        for path in paths {
            assert!(root.join(path).exists(), "spec/verification.md: {path}");
        }
    }
}

/// Parts with one side `x` between two ends.
fn boxes(ends: &[[f64; 2]]) -> ClaimDomain {
    let part = |[from, to]: &[f64; 2]| ClaimPart {
        variables: vec![ClaimVariable::number("x", *from, *to)].into(),
        ..ClaimPart::whole("part", "")
    };
    ClaimDomain { parts: ends.iter().map(part).collect() }
}

#[test]
fn words_follow_from_the_domains() {
    let word = |claimed: &ClaimDomain, proved: ClaimDomain| {
        Verdict::Holds(Evidence { proved, ..Evidence::default() }).word(claimed)
    };
    let claimed = boxes(&[[0.0, 1.0]]);
    assert_eq!(word(&claimed, boxes(&[[0.0, 1.0]])), Word::Proved);
    assert_eq!(word(&claimed, boxes(&[[0.5, 2.0], [-1.0, 0.5]])), Word::Proved);
    assert_eq!(word(&claimed, boxes(&[[0.0, 0.4], [0.5, 1.0]])), Word::ProvedInPart);
    assert_eq!(word(&claimed, boxes(&[[0.0, 1.0_f64.next_down()]])), Word::ProvedInPart);
    assert_eq!(word(&claimed, ClaimDomain::default()), Word::Sampled);
    assert_eq!(word(&boxes(&[[0.0, f64::INFINITY]]), boxes(&[[0.0, 1e300]])), Word::ProvedInPart);
    // A claim without a domain is never proved, nor is another part's proof of use.
    assert_eq!(word(&ClaimDomain::default(), boxes(&[[0.0, 1.0]])), Word::ProvedInPart);
    assert_eq!(word(&ClaimPart::whole("other", "").into(), boxes(&[[0.0, 1.0]])), Word::ProvedInPart);
    // A proof at one value of a variable that the claim leaves open restricts it.
    assert_eq!(word(&ClaimPart::whole("part", "").into(), boxes(&[[0.0, 1.0]])), Word::ProvedInPart);
    // Of two parts one, and another one of the same variable.
    let other = ClaimPart { name: "other".into(), ..claimed.parts[0].clone() };
    let two = ClaimDomain { parts: vec![claimed.parts[0].clone(), other.clone()].into() };
    assert_eq!(word(&two, claimed.clone()), Word::ProvedInPart);
    assert_eq!(word(&claimed, other.into()), Word::ProvedInPart);
    let exhausted = Evidence { exhausted: boxes(&[[0.0, 1.0]]), ..Evidence::default() };
    assert_eq!(Verdict::Holds(exhausted).word(&claimed), Word::Exhausted);
}

/// A square with a hole is not a square; four strips about a hole and its filling are.
#[test]
fn boxes_of_two_variables_cover() {
    let part = |[x, y]: [[f64; 2]; 2]| ClaimPart {
        variables: vec![ClaimVariable::number("x", x[0], x[1]), ClaimVariable::new("y", "s", y[0], y[1])].into(),
        ..ClaimPart::whole("square", "")
    };
    let square = part([[0.0, 3.0], [0.0, 3.0]]);
    let mut parts = vec![
        part([[0.0, 3.0], [0.0, 1.0]]),
        part([[0.0, 3.0], [2.0, 3.0]]),
        part([[0.0, 1.0], [1.0, 2.0]]),
        part([[2.0, 3.0], [1.0, 2.0]]),
    ];
    assert!(!square.is_covered_by(&parts));
    parts.insert(1, part([[0.9, 2.1], [0.9, 2.1]]));
    assert!(square.is_covered_by(&parts));
    // Another unit is another variable.
    let metres = vec![ClaimVariable::number("x", 0.0, 3.0), ClaimVariable::new("y", "m", 0.0, 3.0)];
    assert!(!square.is_covered_by(&[ClaimPart { variables: metres.into(), ..ClaimPart::whole("square", "") }]));
}

#[test]
fn findings_go_through_json() {
    fn plain<T: Send + Sync + Clone + serde::Serialize + serde::de::DeserializeOwned + PartialEq + std::fmt::Debug>(
        x: &T,
    ) {
        let text = serde_json::to_string(x).unwrap();
        assert_eq!(&serde_json::from_str::<T>(&text).unwrap(), x, "{text}");
    }
    for id in ["relay-q", "sine", "lemma-1", "on-board-abort", "quantisation-alpha", "orbit-linear"] {
        let finding: Finding = Claim::find(id).unwrap().check(Budget { cases: 5, seed: 2 });
        plain(&finding);
        plain(&finding.domain);
    }
    plain(&Witness { numbers: vec![("x".into(), 0.1), ("y".into(), -3e300)] });
    plain(&Word::ProvedInPart);
    plain(&boxes(&[[f64::NEG_INFINITY, f64::INFINITY]]));
}
