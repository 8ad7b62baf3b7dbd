//! The proofs of the orbit theorems as files: written after a search, checked without one.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::{CommandError, Outcome};
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
    let fault = |path: &Path| {
        let path = path.to_owned();
        |source| CommandError::Write { path, source }
    };
    std::fs::create_dir_all(folder).map_err(fault(folder))?;
    for theorem in theorems() {
        if let Ok(proofs) = theorem.prove() {
            let path = file(folder, theorem);
            std::fs::write(&path, Proofs(proofs).to_string()).map_err(fault(&path))?;
        }
    }
    Ok(())
}

/// A line for each theorem: accepted, or why not.
pub(super) fn check(folder: &Path, output: &mut impl Write) -> Result<Outcome, CommandError> {
    let width = theorems().map(|theorem| theorem.id.len()).max().unwrap_or(0);
    let mut outcome = Outcome::Done;
    for theorem in theorems() {
        let path = file(folder, theorem);
        let text = std::fs::read_to_string(&path).map_err(|source| CommandError::Certificate { path, source })?;
        let checked = text.parse().and_then(|Proofs(proofs)| {
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
