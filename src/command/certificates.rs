//! The proofs of the orbit theorems as files: written after a search, checked without one.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::{CommandError, Outcome, files};
use crate::claims::{CLAIMS, Claim};
use crate::orbit::theorem::Theorem;
use crate::proof::inequality::{Proofs, Refusal};

fn theorems() -> impl Iterator<Item = &'static Theorem> {
    CLAIMS.iter().filter_map(Claim::theorem)
}

fn file(folder: &Path, theorem: &Theorem) -> PathBuf {
    folder.join(theorem.id).with_extension("proof")
}

/// One file `ID.proof` for each theorem that is proved.
pub(super) fn write(folder: &Path) -> Result<(), CommandError> {
    std::fs::create_dir_all(folder).map_err(|source| CommandError::Write { path: folder.to_owned(), source })?;
    for theorem in theorems() {
        if let Ok(proofs) = theorem.prove() {
            files::write(&file(folder, theorem), &Proofs(proofs).to_string())?;
        }
    }
    Ok(())
}

/// A line for each theorem: accepted, or why not.
pub(super) fn check(folder: &Path, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let width = theorems().map(|theorem| theorem.id.len()).max().unwrap_or(0);
    let mut outcome = Outcome::Done;
    for theorem in theorems() {
        let checked = files::read(&file(folder, theorem))?.parse().and_then(|Proofs(proofs)| {
            theorem.check(&proofs)?;
            Ok::<usize, Refusal>(proofs.iter().map(|proof| proof.boxes.len()).sum())
        });
        match checked {
            Ok(boxes) => writeln!(output, "{:width$}  accepted  {boxes} boxes; {}", theorem.id, theorem.domain)?,
            Err(refusal) => {
                writeln!(output, "{:width$}  refused   {refusal}", theorem.id)?;
                outcome = Outcome::No;
            }
        }
    }
    Ok(outcome)
}
