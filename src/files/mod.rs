//! Files of one run: an input is opened once and read within a limit; an output is neither an input nor another output, and is
//! there whole or not at all.

mod error;
mod input;
#[cfg(feature = "command")]
mod output;
#[cfg(feature = "command")]
mod run;

pub use error::FileError;
pub use input::Input;
#[cfg(feature = "command")]
pub use output::{Output, folder};
#[cfg(feature = "command")]
pub(crate) use output::{on_signal, remove_on_signal};
#[cfg(feature = "command")]
pub use run::Files;

use std::ffi::OsString;
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};

/// Characters of a word, and of a file's name, that a message shows.
pub(crate) const LONGEST_WORD: usize = 40;
const LONGEST_NAME: usize = 120;

/// A text of about `most` characters or fewer, cut in its middle.
pub(crate) fn cut(text: &str, most: usize) -> String {
    let whole: Vec<char> = text.chars().collect();
    let part = |chars: &[char]| chars.iter().collect::<String>();
    if whole.len() <= most {
        return text.to_owned();
    }
    format!("{}...{}", part(&whole[..most / 2]), part(&whole[whole.len() - most / 2..]))
}

/// The name of a file in messages.
fn name(path: &Path) -> String {
    if path.as_os_str().is_empty() { "the empty path".to_owned() } else { cut(&path.to_string_lossy(), LONGEST_NAME) }
}

/// Which file this is, by whatever name or link: device, inode, and of a file that is not there yet its folder's and its name.
/// Without inodes: the canonical path.
type Place = (u64, u64, OsString);

/// The place of a plain file. Pipes, terminals and other devices lose nothing when they are written.
fn place(path: &Path) -> Option<Place> {
    fs::metadata(path).ok().filter(Metadata::is_file).and_then(|about| identity(path, &about))
}

#[cfg(unix)]
#[allow(clippy::unnecessary_wraps, reason = "other systems may have none")]
fn identity(_: &Path, about: &Metadata) -> Option<Place> {
    use std::os::unix::fs::MetadataExt;
    Some((about.dev(), about.ino(), OsString::new()))
}

#[cfg(not(unix))]
fn identity(path: &Path, _: &Metadata) -> Option<Place> {
    fs::canonicalize(path).ok().map(|path| (0, 0, path.into_os_string()))
}

/// The folder that a path's last part is in.
fn parent(path: &Path) -> PathBuf {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned()
}
