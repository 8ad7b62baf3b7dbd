//! Certificates as files: written after a search, checked without one.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::error::Given;
use super::{CommandError, Outcome, existence, files};
use crate::balance::ProvedOscillation;
use crate::claims::{CLAIMS, Certificate, Claim};
use crate::experiment::Record;
use crate::identify::bounded::certificate as bounded;
use crate::identify::{Session, Settings};
use crate::orbit::{OrbitCertificate, OrbitRefusal};
use crate::proof::inequality::Refusal;

fn theorems() -> impl Iterator<Item = &'static Claim> {
    CLAIMS.iter().filter(|claim| claim.theorem().is_some())
}

fn file(folder: &Path, claim: &Claim) -> PathBuf {
    folder.join(format!("{}.json", claim.id))
}

/// A file `ID.json` for each theorem; the answer is no if a theorem is not proved.
pub(super) fn write(folder: &Path) -> Result<Outcome, CommandError> {
    crate::files::folder(folder).given("--certificates")?;
    let mut outcome = Outcome::Done;
    for claim in theorems() {
        let path = file(folder, claim);
        match Certificate::of(claim) {
            Some(certificate) => files::write(&path, &certificate.to_string()).given("--certificates")?,
            None => outcome = Outcome::No,
        }
    }
    Ok(outcome)
}

/// The records of logs, read with the proof's settings.
fn records(proof: &bounded::Certificate, logs: &[PathBuf]) -> Result<Vec<Record>, CommandError> {
    let read_as = proof.reading().cloned();
    let settings = Settings { relay_level: read_as.as_ref().and_then(|own| own.relay_level), ..Settings::default() };
    let session = Session::new(settings).with_columns(read_as.map(|own| own.columns).unwrap_or_default());
    Ok(logs.iter().try_fold(session, Session::log)?.records()?)
}

/// A file of one proof. Guaranteed bounds are accepted with everything that they depend on and what is left in the coordinates of the
/// search.
fn check_file(path: &Path, logs: &[PathBuf], output: &mut impl Write) -> Result<Outcome, CommandError> {
    /// The claim of a theorem's proof, read even if the rest is faulty.
    #[derive(serde::Deserialize)]
    struct Named {
        claim: String,
    }
    /// Of a proof of another kind.
    #[derive(serde::Deserialize)]
    struct CertificateKind {
        certificate: String,
    }
    let text = files::read(path)?;
    let none = |reason| Err(CommandError::NoCertificate { path: path.to_owned(), reason });
    let without_log = || {
        let reason = "--log: a log is compared with guaranteed bounds alone; leave it out".to_owned();
        if logs.is_empty() { Ok(()) } else { Err(CommandError::Usage { reason }) }
    };
    if let Ok(Named { claim }) = serde_json::from_str(&text) {
        without_log()?;
        if claim == ProvedOscillation::CLAIM {
            return existence::check(path, &text, output);
        }
        let Some(claim) = theorems().find(|own| own.id == claim) else {
            return none(format!("there is no theorem `{claim}`"));
        };
        return match text.parse() {
            Err(Refusal::Malformed { text }) => none(text),
            proof => Ok(if shows(proof, claim.id, 0, output)? { Outcome::Done } else { Outcome::No }),
        };
    }
    if matches!(serde_json::from_str(&text), Ok(CertificateKind { certificate }) if certificate == OrbitCertificate::KIND)
    {
        without_log()?;
        let proof = text.parse::<OrbitCertificate>();
        return match proof.and_then(|proof| proof.check()) {
            Ok(orbits) => {
                writeln!(output, "accepted  {}", OrbitCertificate::STATEMENT)?;
                writeln!(output, "          {orbits} {}", if orbits == 1 { "orbit" } else { "orbits" })?;
                Ok(Outcome::Done)
            }
            Err(error @ (OrbitRefusal::Malformed { .. } | OrbitRefusal::Foreign { .. })) => none(error.to_string()),
            Err(refusal) => {
                writeln!(output, "refused   {}: {refusal}", refusal.code())?;
                Ok(Outcome::No)
            }
        };
    }
    let checked = match bounded::Certificate::read(&text) {
        Err(bounded::Unproved::Foreign { text }) => return none(text),
        Err(unproved) => Err(unproved),
        Ok(proof) if logs.is_empty() => proof.check(),
        Ok(proof) => proof.agrees(&records(&proof, logs)?).and_then(|()| proof.check()),
    };
    match checked {
        Ok(shown) => {
            let bounded::Shown { statement, ranges, searched, left, fastest, excluded, enclosures, readings } = shown;
            writeln!(output, "accepted  {statement}")?;
            writeln!(output, "          {readings} readings, {enclosures} enclosures, {excluded} boxes excluded")?;
            for range in ranges {
                writeln!(output, "assumed   {range}")?;
            }
            for (what, ranges) in [("searched", searched), ("left", left)] {
                for (quantity, [low, high]) in ranges {
                    if low == high {
                        writeln!(output, "{what:10}{quantity} = {low}")?;
                    } else {
                        writeln!(output, "{what:10}{low:.9e} <= {quantity} <= {high:.9e}")?;
                    }
                }
            }
            writeln!(output, "searched  speeds up to {fastest:.9e}")?;
            match logs.len() {
                0 => writeln!(output, "log       not compared; add --log LOG.csv...")?,
                _ => writeln!(output, "log       agrees in every stamp, reading and command")?,
            }
            Ok(Outcome::Done)
        }
        Err(unproved) => {
            writeln!(output, "refused   {}: {unproved}", unproved.code())?;
            Ok(Outcome::No)
        }
    }
}

/// A line for each theorem, accepted or why not; or the result of a file of guaranteed bounds on these logs.
pub(super) fn check(folder: &Path, logs: &[PathBuf], output: &mut impl Write) -> Result<Outcome, CommandError> {
    if folder.is_file() {
        return check_file(folder, logs, output);
    }
    let width = theorems().map(|claim| claim.id.len()).max().unwrap_or(0);
    let mut outcome = Outcome::Done;
    for claim in theorems() {
        let proof = files::read(&file(folder, claim))?.parse();
        if !shows(proof, claim.id, width, output)? {
            outcome = Outcome::No;
        }
    }
    Ok(outcome)
}

/// A line for a theorem: whether this is a proof of it.
fn shows(
    proof: Result<Certificate, Refusal>,
    claim: &'static str,
    width: usize,
    output: &mut impl Write,
) -> Result<bool, CommandError> {
    let checked = proof.and_then(|proof| {
        if proof.claim != claim {
            return Err(Refusal::Other { found: proof.claim, expected: claim });
        }
        proof.check().map(|()| proof)
    });
    match &checked {
        Ok(proof) => {
            let boxes: usize = proof.inequalities.iter().map(|shown| shown.proof.boxes.len()).sum();
            writeln!(output, "{claim:width$}  accepted  {boxes} boxes; {}", proof.domain)?;
        }
        Err(refusal) => writeln!(output, "{claim:width$}  refused   {refusal}")?,
    }
    Ok(checked.is_ok())
}
