//! `selfosc verify`: the claims, checked.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::sync::mpsc::{Sender, channel};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::error::Given;
use super::number::whole;
use super::{CommandError, Outcome, certificates, files, suggestion, write_json};
use crate::claims::{Budget, CLAIMS, Claim, Evidence, Finding, Verdict, Word, formulas};

/// Checks every claim of the theory, as printed and as corrected, and says on what evidence.
///
/// Proved means enclosed over the whole domain as stated, proved-in-part over the parts named, exhausted that every state of
/// a finite model was visited, sampled no more than true of every case drawn. A claim that the paper states and that is false
/// as printed is refuted with the numbers that refute it. Steps of a proof that no program checks are counted.
/// Kernel-checked means that the proof assistant Coq accepts the statement (spec/formal), which this command does not run. Exit status 1
/// when a verdict is not the one that the claim's file states, or a declared proof does not succeed.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  selfosc verify
  selfosc verify lemma-1 lemma-2 --cases 100000 --seed 7
  selfosc verify --certificates proofs
  selfosc verify --check proofs
  selfosc verify --formulas spec/formal
  selfosc verify --check bounds.json --log log.csv
  selfosc verify --json")]
pub(super) struct Arguments {
    /// Only these claims, by name or by the paper's: lemma-1, theorem-1
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Only this claim; repeat or list several
    #[arg(long = "claim", value_name = "ID", num_args = 1..)]
    claims: Vec<String>,
    /// Cases drawn by each sampled check
    #[arg(long, value_name = "N", default_value_t = Budget::default().cases, value_parser = cases, allow_negative_numbers = true)]
    cases: usize,
    /// Seed of the cases
    #[arg(long, value_parser = whole::<u64>, value_name = "S", default_value_t = Budget::default().seed, allow_negative_numbers = true)]
    seed: u64,
    /// Writes the proofs of all orbit theorems to this folder, one file a theorem, with every box; --claim does not choose them
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Writes the program's formulas to `Formulas.v` in this folder, as definitions of the proof assistant Coq; checks nothing
    #[arg(long, value_name = "DIR", conflicts_with_all = ["ids", "claims", "cases", "seed", "certificates", "check", "json"])]
    formulas: Option<PathBuf>,
    /// Checks such files, or one that `identify --certificate` wrote, without searching for anything, in place of the claims
    #[arg(long, value_name = "DIR|FILE", conflicts_with_all = ["ids", "claims", "cases", "seed", "certificates", "json"])]
    check: Option<PathBuf>,
    /// Compares the stamps, readings and commands in the file of bounds with those of these logs
    #[arg(long, value_name = "LOG", num_args = 1.., requires = "check")]
    log: Vec<PathBuf>,
    /// Shows on a terminal which claim is being checked
    #[arg(long)]
    progress: bool,
    /// Prints one JSON document
    #[arg(long)]
    json: bool,
}

/// Most cases of a check.
const MOST_CASES: usize = 10_000_000;

fn cases(text: &str) -> Result<usize, String> {
    let cases = text.parse().ok().filter(|cases| (1..=MOST_CASES).contains(cases));
    cases.ok_or_else(|| format!("must be a whole number from 1 to {MOST_CASES}; write it in digits"))
}

pub(super) fn run(arguments: &Arguments, output: &mut impl Write) -> Result<Outcome, CommandError> {
    if let Some(folder) = &arguments.formulas {
        crate::files::folder(folder).given("--formulas")?;
        files::write(&folder.join("Formulas.v"), &formulas()).given("--formulas")?;
        return Ok(Outcome::Done);
    }
    if let Some(folder) = &arguments.check {
        return certificates::check(folder, &arguments.log, output);
    }
    let chosen = chosen(&[&arguments.ids[..], &arguments.claims].concat())?;
    let written = arguments.certificates.as_deref().map(certificates::write).transpose()?;
    let budget = Budget { cases: arguments.cases, seed: arguments.seed };
    let findings = check(&chosen, budget, arguments, output)?;
    if arguments.json {
        write_json(output, &document(&findings))?;
    } else {
        summary(&findings, output)?;
        if let Some(folder) = &arguments.certificates {
            writeln!(output, "proofs of all orbit theorems in {}; --claim does not choose them", folder.display())?;
        }
    }
    let expected = findings.iter().all(|(_, finding)| finding.expected);
    Ok(if expected { written.unwrap_or(Outcome::Done) } else { Outcome::No })
}

/// Checks the claims side by side; for people, prints a claim's lines when it and those before it have ended.
fn check(
    chosen: &[&'static Claim],
    budget: Budget,
    arguments: &Arguments,
    output: &mut impl Write,
) -> Result<Vec<(&'static Claim, Finding)>, CommandError> {
    // Drawn on standard error, and only where that is a terminal.
    let progress = if arguments.progress { ProgressBar::new(chosen.len() as u64) } else { ProgressBar::hidden() };
    progress.set_style(ProgressStyle::with_template("{pos}/{len} {msg}").unwrap_or(ProgressStyle::default_bar()));
    let mut findings = Vec::with_capacity(chosen.len());
    let (ended, endings) = channel();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let check =
                |ended: &mut Sender<_>, (place, claim): (usize, &&Claim)| ended.send((place, claim.check(budget)));
            // An error means that nobody listens any more, as where the output was closed.
            chosen.par_iter().enumerate().try_for_each_with(ended, check)
        });
        let mut waiting = BTreeMap::new();
        for (place, finding) in endings {
            waiting.insert(place, finding);
            progress.set_message(chosen[place].id);
            progress.inc(1);
            while let Some(finding) = waiting.remove(&findings.len()) {
                let claim = chosen[findings.len()];
                if !arguments.json {
                    progress.suspend(|| lines(claim, &finding, output))?;
                    output.flush()?;
                }
                findings.push((claim, finding));
            }
        }
        progress.finish_and_clear();
        Ok(findings)
    })
}

fn chosen(ids: &[String]) -> Result<Vec<&'static Claim>, CommandError> {
    if ids.is_empty() {
        return Ok(CLAIMS.iter().collect());
    }
    let mut found = Vec::new();
    for id in ids {
        let before = found.len();
        let printed = as_printed(id);
        found.extend(CLAIMS.iter().filter(|claim| claim.id == id || as_printed(claim.equation()) == printed));
        if found.len() == before {
            let nearest = suggestion::nearest(id, CLAIMS.iter().map(|claim| claim.id));
            return Err(CommandError::UnknownClaim { id: id.clone(), nearest });
        }
    }
    Ok(found)
}

/// The paper's name of a result, however it is typed: `Theorem 1`, `theorem-1`.
fn as_printed(name: &str) -> String {
    name.to_lowercase().replace('-', " ")
}

/// What was found of the parts that are established, then the numbers, in the order of the fields.
fn evidence(claim: &Claim, finding: &Finding) -> String {
    let evidence = match finding.carrying() {
        Some(Verdict::Holds(evidence)) => evidence,
        Some(Verdict::Refuted(witness) | Verdict::Approximate(witness)) => return format!("refuted by {witness}"),
        Some(Verdict::Undecided { spent }) => return spent.clone(),
        None => return String::new(),
    };
    let Evidence { proved, exhausted, cases, boxes, residual_bound, margin } = evidence;
    let mut said = Vec::new();
    said.extend((!proved.parts.is_empty()).then(|| format!("on {proved}")));
    said.extend((!exhausted.parts.is_empty()).then(|| format!("all states of {exhausted}")));
    said.extend(
        residual_bound
            .map(|bound| if bound == 0.0 { "residual 0".to_owned() } else { format!("residual {bound:.1e}") }),
    );
    said.extend(boxes.map(|boxes| format!("{boxes} boxes")));
    said.extend(cases.map(|cases| format!("{cases} cases")));
    said.extend(margin.map(|margin| {
        format!("margin {}", if margin < 0.01 { format!("{margin:.1e}") } else { format!("{margin:.2}") })
    }));
    let by_hand = finding.by_hand.len();
    said.extend((by_hand > 0).then(|| format!("{by_hand} by hand")));
    said.extend(claim.kernel_checked().map(|checked| checked.to_string()));
    said.join(", ")
}

/// The finding on a claim: where it stands and the words for it, its statement, the case against it, the evidence.
fn lines(claim: &Claim, finding: &Finding, output: &mut impl Write) -> Result<(), CommandError> {
    let words = match (finding.as_printed(), finding.as_corrected()) {
        // The paper does not say it.
        (Word::NotApplicable, word) => word.to_string(),
        (word, Word::NotApplicable) => format!("{word} as printed"),
        (printed, corrected) => format!("{printed} as printed, {corrected} as corrected"),
    };
    writeln!(output, "\n{} ({}): {words}", claim.id, place(claim))?;
    writeln!(output, "    {}.", claim.statement)?;
    match &finding.printed {
        Some(Verdict::Refuted(witness)) => {
            let case = claim.counterexample().map_or_else(String::new, |case| format!("    Counterexample: {case}.\n"));
            writeln!(output, "{case}    As printed, refuted by {witness}")?;
        }
        Some(Verdict::Approximate(witness)) => writeln!(output, "    As printed, approximate: off at {witness}")?,
        _ => {}
    }
    let evidence = evidence(claim, finding);
    if !evidence.is_empty() {
        writeln!(output, "    Evidence: {evidence}")?;
    }
    if let Some(why) = claim.not_proved {
        writeln!(output, "    Not proved as a whole: {why}")?;
    }
    if !finding.expected {
        writeln!(output, "    NOT AS STATED in spec/claims/{}.md", claim.id)?;
    }
    Ok(())
}

/// Where the paper has a claim: equations are numbers there.
fn place(claim: &Claim) -> String {
    let place = claim.equation();
    let numbered = place.starts_with(|c: char| c.is_ascii_digit());
    let several = place.contains('-');
    format!("{}{place}", if numbered { if several { "eqs. " } else { "eq. " } } else { "" })
}

/// What the words of the evidence mean.
const LEGEND: &str = "\
proved          enclosed over the whole domain as stated; `on` names its parts
proved-in-part  enclosed over the parts named
exhausted       every state of a finite model was visited
sampled         true of every case drawn
boxes           parts that the domain was divided into, each enclosed by interval arithmetic
residual        bound of the difference between both sides of an equation
margin          distance from failure: 1 is exact, 0 the limit; of a proved inequality, its least slack
by hand         steps of the proof that no program checks
kernel-checked  the proof assistant Coq accepts the statement: whole, or the part named";

fn summary(findings: &[(&Claim, Finding)], output: &mut impl Write) -> Result<(), CommandError> {
    let words = [Word::Proved, Word::ProvedInPart, Word::Exhausted, Word::Sampled];
    let words = words.map(|word| format!("{} {word}", count(findings, word))).join(", ");
    let (refuted, wrong) = (refuted_as_printed(findings), not_as_stated(findings));
    let (claims, checked) = (findings.len(), kernel_checked(findings));
    let noun = if claims == 1 { "claim" } else { "claims" };
    writeln!(
        output,
        "\n{LEGEND}\n\n{claims} {noun}: {words}; {checked} kernel-checked as a whole; {refuted} refuted as printed; {wrong} not as stated"
    )?;
    Ok(())
}

fn count(findings: &[(&Claim, Finding)], word: Word) -> usize {
    findings.iter().filter(|(_, finding)| finding.word() == word).count()
}

fn kernel_checked(findings: &[(&Claim, Finding)]) -> usize {
    let whole = |claim: &Claim| claim.kernel_checked().is_some_and(|checked| checked.covers == "whole");
    findings.iter().filter(|(claim, _)| whole(claim)).count()
}

fn refuted_as_printed(findings: &[(&Claim, Finding)]) -> usize {
    findings.iter().filter(|(_, finding)| finding.as_printed() == Word::Refuted).count()
}

fn not_as_stated(findings: &[(&Claim, Finding)]) -> usize {
    findings.iter().filter(|(_, finding)| !finding.expected).count()
}

fn document(findings: &[(&Claim, Finding)]) -> Value {
    let claim = |(claim, finding): &(&Claim, Finding)| {
        let found = match finding.carrying() {
            Some(Verdict::Holds(evidence)) => evidence.clone(),
            _ => Evidence::default(),
        };
        let witness = [&finding.printed, &finding.corrected].into_iter().flatten().find_map(|verdict| match verdict {
            Verdict::Refuted(witness) | Verdict::Approximate(witness) => Some(witness),
            _ => None,
        });
        let witness = witness.map(|witness| {
            let numbers = witness.numbers.iter().map(|(name, value)| (name.clone().into_owned(), json!(value)));
            numbers.collect::<serde_json::Map<_, _>>()
        });
        let proof = !found.proved.parts.is_empty();
        let established: Vec<_> = found.proved.parts.iter().chain(found.exhausted.parts.iter()).collect();
        let parts = finding.domain.parts.iter().map(|part| json!({ "part": part.name, "text": part.text }));
        json!({
            "id": claim.id,
            "equation": claim.equation(),
            "kind": claim.kind,
            "statement": claim.statement,
            "as_printed": finding.as_printed(),
            "as_corrected": finding.as_corrected(),
            "evidence": evidence(claim, finding),
            "kernel_checked": claim.kernel_checked().map(|checked| checked.covers),
            "cases": found.cases,
            "boxes": found.boxes,
            "residual_bound": found.residual_bound,
            "margin": found.margin,
            "by_hand": proof.then_some(&finding.by_hand),
            "not_proved": claim.not_proved,
            "domain": parts.collect::<Vec<_>>(),
            "established": established,
            "witness": witness,
            "as_stated": finding.expected,
        })
    };
    json!({
        "claims": findings.iter().map(claim).collect::<Vec<_>>(),
        "summary": {
            "claims": findings.len(),
            "proved": count(findings, Word::Proved),
            "proved_in_part": count(findings, Word::ProvedInPart),
            "exhausted": count(findings, Word::Exhausted),
            "sampled": count(findings, Word::Sampled),
            "kernel_checked": kernel_checked(findings),
            "undecided": count(findings, Word::Undecided),
            "refuted": count(findings, Word::Refuted),
            "refuted_as_printed": refuted_as_printed(findings),
            "not_as_stated": not_as_stated(findings),
        },
    })
}
