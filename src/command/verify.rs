//! `selfosc verify`: the claims, checked.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::{CommandError, Outcome, certificates, write_json};
use crate::claims::{Budget, CLAIMS, Claim, Evidence, Finding, Verdict};

/// Checks every claim of the theory, as printed and as corrected, and says on what evidence.
///
/// Sampled means true of every case drawn; proved means enclosed over the whole stated domain. A claim that the paper
/// states and that is false as printed is refuted with the numbers that refute it. Exit status 1 when a verdict is not the
/// one that the claim's file states.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc verify
  selfosc verify --claim lemma-1 --claim lemma-2 --cases 100000 --seed 7
  selfosc verify --certificates proofs
  selfosc verify --check proofs
  selfosc verify --json")]
pub(super) struct Arguments {
    /// Only this claim; repeat or list several
    #[arg(long = "claim", value_name = "ID", num_args = 1..)]
    claims: Vec<String>,
    /// Cases drawn by each sampled check
    #[arg(long, value_name = "N", default_value_t = Budget::default().cases, value_parser = cases)]
    cases: usize,
    /// Seed of the cases
    #[arg(long, value_name = "S", default_value_t = Budget::default().seed)]
    seed: u64,
    /// Writes the proofs of the orbit theorems to this folder, one file a theorem, with every box
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Checks such files, without searching for anything, in place of the claims
    #[arg(long, value_name = "DIR", conflicts_with_all = ["claims", "cases", "seed", "certificates", "json"])]
    check: Option<PathBuf>,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

fn cases(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) => Err("0 cases check nothing; give 1 or more".to_owned()),
        Ok(cases) if cases > 10_000_000 => Err(format!("{cases} cases are above the limit of 10000000")),
        other => other.map_err(|_| format!("`{text}` is not a whole number of 1 or more")),
    }
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    if let Some(folder) = &arguments.check {
        return certificates::check(folder, output);
    }
    let chosen = chosen(&arguments.claims)?;
    if let Some(folder) = &arguments.certificates {
        certificates::write(folder)?;
    }
    let budget = Budget { cases: arguments.cases, seed: arguments.seed };
    let findings: Vec<(&Claim, Finding)> = chosen.into_iter().map(|claim| (claim, claim.check(budget))).collect();
    if arguments.json {
        write_json(output, &document(&findings))?;
    } else {
        table(&findings, output)?;
    }
    let expected = findings.iter().all(|(_, finding)| finding.expected);
    Ok(if expected { Outcome::Done } else { Outcome::No })
}

fn chosen(ids: &[String]) -> Result<Vec<&'static Claim>, CommandError> {
    if ids.is_empty() {
        return Ok(CLAIMS.iter().collect());
    }
    let find = |id: &String| {
        Claim::find(id).ok_or_else(|| CommandError::UnknownClaim {
            id: id.clone(),
            known: CLAIMS.iter().map(|claim| claim.id).collect::<Vec<_>>().join(", "),
        })
    };
    ids.iter().map(find).collect()
}

/// One word for a verdict, or for the lack of one.
fn word(verdict: Option<&Verdict>) -> &'static str {
    verdict.map_or("not-applicable", Verdict::word)
}

/// The verdict that carries the claim: of the corrected statement where there is one.
fn carrying(finding: &Finding) -> Option<&Verdict> {
    finding.corrected.as_ref().or(finding.printed.as_ref())
}

fn evidence(finding: &Finding) -> String {
    match carrying(finding) {
        Some(Verdict::Holds(Evidence::Proved { domain, bound, boxes })) => {
            format!("{domain}: bound {bound:.1e}, {boxes} boxes")
        }
        Some(Verdict::Holds(Evidence::Exhausted { domain, states })) => format!("{domain}: all {states} states"),
        Some(Verdict::Holds(Evidence::Sampled { cases, margin })) => format!("{cases} cases, margin {margin:.2}"),
        Some(Verdict::Refuted(witness)) => format!("refuted by {witness}"),
        Some(Verdict::Undecided { spent }) => spent.clone(),
        None => String::new(),
    }
}

fn table(findings: &[(&Claim, Finding)], output: &mut impl Write) -> Result<(), CommandError> {
    let width = findings.iter().map(|(claim, _)| claim.id.len()).max().unwrap_or(0);
    writeln!(output, "{:width$}  {:14}  {:14}  evidence", "claim", "as printed", "as corrected")?;
    for (claim, finding) in findings {
        let (printed, corrected) = (word(finding.printed.as_ref()), word(finding.corrected.as_ref()));
        let (printed, corrected) = (printed.replace("not-applicable", "-"), corrected.replace("not-applicable", "-"));
        writeln!(output, "{:width$}  {printed:14}  {corrected:14}  {}", claim.id, evidence(finding))?;
        if let Some(Verdict::Refuted(witness)) = &finding.printed {
            writeln!(output, "{:width$}  as printed, refuted by {witness}", "")?;
        }
        if !finding.expected {
            writeln!(output, "{:width$}  NOT AS STATED in spec/claims/{}.md", "", claim.id)?;
        }
    }
    let count = |word: &str| findings.iter().filter(|(_, f)| carrying(f).is_some_and(|v| v.word() == word)).count();
    let refuted = findings.iter().filter(|(_, f)| f.printed.as_ref().is_some_and(Verdict::is_refuted)).count();
    let wrong = findings.iter().filter(|(_, f)| !f.expected).count();
    writeln!(
        output,
        "\n{} claims: {} proved, {} sampled; {refuted} refuted as printed; {wrong} not as stated",
        findings.len(),
        count("proved"),
        count("sampled"),
    )?;
    Ok(())
}

fn document(findings: &[(&Claim, Finding)]) -> Value {
    let claim = |(claim, finding): &(&Claim, Finding)| {
        let (cases, margin) = match carrying(finding) {
            Some(Verdict::Holds(Evidence::Sampled { cases, margin })) => (json!(cases), json!(margin)),
            Some(Verdict::Holds(Evidence::Proved { boxes, bound, .. })) => (json!(boxes), json!(bound)),
            Some(Verdict::Holds(Evidence::Exhausted { states, .. })) => (json!(states), Value::Null),
            _ => (Value::Null, Value::Null),
        };
        let witness = [&finding.printed, &finding.corrected].into_iter().flatten().find_map(|verdict| match verdict {
            Verdict::Refuted(witness) => Some(witness),
            _ => None,
        });
        let witness = witness.map(|witness| {
            witness
                .numbers
                .iter()
                .map(|(name, value)| ((*name).to_owned(), json!(value)))
                .collect::<serde_json::Map<_, _>>()
        });
        json!({
            "id": claim.id,
            "equation": claim.equation,
            "kind": claim.kind.word(),
            "statement": claim.statement,
            "as_printed": word(finding.printed.as_ref()),
            "as_corrected": word(finding.corrected.as_ref()),
            "evidence": evidence(finding),
            "cases": cases,
            "margin": margin,
            "witness": witness,
            "as_stated": finding.expected,
        })
    };
    let count = |word: &str| findings.iter().filter(|(_, f)| carrying(f).is_some_and(|v| v.word() == word)).count();
    json!({
        "claims": findings.iter().map(claim).collect::<Vec<_>>(),
        "summary": {
            "claims": findings.len(),
            "proved": count("proved"),
            "sampled": count("sampled"),
            "undecided": count("undecided"),
            "refuted": count("refuted"),
            "refuted_as_printed": findings.iter().filter(|(_, f)| f.printed.as_ref().is_some_and(Verdict::is_refuted)).count(),
            "not_as_stated": findings.iter().filter(|(_, f)| !f.expected).count(),
        },
    })
}
