//! Certificates as files: written after a search, checked without one.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::error::Given;
use super::{CommandError, Outcome, files};
use crate::claims::{CLAIMS, Certificate, Claim};
use crate::identify::bounded::certificate as bounded;
use crate::proof::inequality::Refusal;

fn theorems() -> impl Iterator<Item = &'static Claim> {
    CLAIMS.iter().filter(|claim| claim.theorem().is_some())
}

fn file(folder: &Path, claim: &Claim) -> PathBuf {
    folder.join(format!("{}.json", claim.id))
}

/// One file `ID.json` for each theorem; the answer is no where one is not proved.
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

/// A file of guaranteed bounds: accepted, with what is left in the coordinates of the search, or why not.
fn check_bounds(path: &Path, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let read = files::read(path)?;
    match bounded::Certificate::read(&read).and_then(|certificate| certificate.check()) {
        Ok(shown) => {
            let bounded::Shown { statement, searched, left, fastest, excluded, enclosures, readings } = shown;
            writeln!(output, "accepted  {statement}")?;
            writeln!(output, "          {readings} readings, {enclosures} enclosures, {excluded} boxes excluded")?;
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
            Ok(Outcome::Done)
        }
        Err(unproved) => {
            writeln!(output, "refused   {}: {unproved}", unproved.code())?;
            Ok(Outcome::No)
        }
    }
}

/// A line for each theorem, accepted or why not; or what a file of guaranteed bounds shows.
pub(super) fn check(folder: &Path, output: &mut impl Write) -> Result<Outcome, CommandError> {
    if folder.is_file() {
        return check_bounds(folder, output);
    }
    let width = theorems().map(|claim| claim.id.len()).max().unwrap_or(0);
    let mut outcome = Outcome::Done;
    for claim in theorems() {
        let text = files::read(&file(folder, claim))?;
        let checked = text.parse().and_then(|certificate: Certificate| {
            if certificate.claim != claim.id {
                return Err(Refusal::Other { found: certificate.claim, expected: claim.id });
            }
            certificate.check()?;
            Ok(certificate)
        });
        match checked {
            Ok(certificate) => {
                let boxes: usize = certificate.inequalities.iter().map(|shown| shown.proof.boxes.len()).sum();
                writeln!(output, "{:width$}  accepted  {boxes} boxes; {}", claim.id, certificate.domain)?;
            }
            Err(refusal) => {
                writeln!(output, "{:width$}  refused   {refusal}", claim.id)?;
                outcome = Outcome::No;
            }
        }
    }
    Ok(outcome)
}
