//! Files of subcommands without a log: proofs, tables, figures, pages.

use std::path::Path;

use super::CommandError;
use crate::files::{FileError, Files, Input};

/// Most bytes that are read of a proof, a model or a table.
pub(super) const LONGEST: u64 = 64 << 20;

/// Writes a file whole or not at all.
pub(super) fn write(path: &Path, content: &str) -> Result<(), FileError> {
    Files::default().output(path)?.write(content.as_bytes())
}

/// Reads an input; `-` is standard input.
pub(super) fn input(files: &mut Files, path: &Path, most: u64) -> Result<Input, FileError> {
    if path == Path::new("-") { files.read_standard(most) } else { files.read(path, most) }
}

/// Reads a text file of a size that a proof or a model may have; bytes that are no text are for its reader to refuse.
pub(super) fn text(path: &Path) -> Result<String, FileError> {
    let input = input(&mut Files::default(), path, LONGEST)?;
    Ok(String::from_utf8_lossy(input.bytes()).into_owned())
}

/// Reads a proof.
pub(super) fn read(path: &Path) -> Result<String, CommandError> {
    let hint = |error| format!("--check: {error}; `selfosc verify --certificates DIR` writes the proofs");
    text(path).map_err(|error| CommandError::Usage { reason: hint(error) })
}

/// When, by which command and from which bytes a file was made; the digests are those of `sha256sum`.
pub(super) fn provenance(files: &Files) -> Vec<String> {
    let command: Vec<_> = std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect();
    let now = humantime::format_rfc3339_seconds(std::time::SystemTime::now());
    let made = [format!("Command: {}", command.join(" ")), format!("Written at {now}")];
    made.into_iter().chain(files.digests().iter().cloned()).collect()
}
