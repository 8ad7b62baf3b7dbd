//! Files of the command: never half-written, never one that was read, never more than fits in memory.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::CommandError;

/// Most bytes that are read of a proof.
const LONGEST: u64 = 64 << 20;

/// Writes a file whole or not at all: beside its place, synced, then renamed. What is no plain file, as `/dev/stdout`, is written
/// as it stands.
pub(super) fn write(path: &Path, content: &str) -> Result<(), CommandError> {
    replace(path, content.as_bytes()).map_err(|source| CommandError::Write { path: path.to_owned(), source })
}

/// When, by which command and from which bytes a file was made; the digests are those of `sha256sum`.
pub(super) fn provenance(inputs: &[PathBuf]) -> Vec<String> {
    let command: Vec<String> = std::env::args().collect();
    let now = humantime::format_rfc3339_seconds(std::time::SystemTime::now());
    let digest = |path: &PathBuf| {
        let bytes = fs::read(path).ok()?;
        let digest: String = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        Some(format!("{}: SHA-256 {digest}", path.display()))
    };
    [format!("Command: {}", command.join(" ")), format!("Written at {now}")]
        .into_iter()
        .chain(inputs.iter().filter_map(digest))
        .collect()
}

/// Refuses an output that is one of the inputs, by whatever name.
pub(super) fn distinct(output: &Path, inputs: &[PathBuf]) -> Result<(), CommandError> {
    let Ok(place) = fs::canonicalize(output) else { return Ok(()) };
    let same = |input: &&PathBuf| fs::canonicalize(input).is_ok_and(|input| input == place || linked(&input, &place));
    match inputs.iter().find(same) {
        Some(_) => Err(CommandError::OutputIsInput { path: output.to_owned() }),
        None => Ok(()),
    }
}

/// Reads a text file of a size that a proof may have.
pub(super) fn read(path: &Path) -> Result<String, CommandError> {
    let text = || {
        let mut text = String::new();
        File::open(path)?.take(LONGEST + 1).read_to_string(&mut text)?;
        if text.len() as u64 > LONGEST {
            let reason = format!("longer than {} MiB", LONGEST >> 20);
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, reason));
        }
        Ok(text)
    };
    text().map_err(|source| CommandError::Certificate { path: path.to_owned(), source })
}

fn replace(path: &Path, content: &[u8]) -> io::Result<()> {
    // A link stays one: what it names is replaced.
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let before = fs::metadata(&place).ok();
    if before.as_ref().is_some_and(|before| !before.is_file()) {
        return fs::write(&place, content);
    }
    let name = place.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let beside = place.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    let written = OpenOptions::new().write(true).create_new(true).open(&beside).and_then(|mut file| {
        file.write_all(content)?;
        if let Some(before) = before {
            file.set_permissions(before.permissions())?;
        }
        file.sync_all()?;
        fs::rename(&beside, &place)
    });
    if written.as_ref().is_err_and(|error| error.kind() != io::ErrorKind::AlreadyExists) {
        let _ = fs::remove_file(&beside);
    }
    written
}

/// Whether two paths are hard links to one file.
#[cfg(unix)]
fn linked(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |path| fs::metadata(path).map(|data| (data.dev(), data.ino())).ok();
    place(a).is_some() && place(a) == place(b)
}

#[cfg(not(unix))]
fn linked(_: &Path, _: &Path) -> bool {
    false
}
