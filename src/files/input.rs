//! What is read.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::{FileError, LONGEST_NAME, Place, cut, name, place};

/// A file's bytes, read once and within a limit: a pipe gives them only once, a device without end.
///
/// ```
/// use selfosc::files::Input;
/// # let path = std::env::temp_dir().join(format!("selfosc-input-{}", std::process::id()));
/// std::fs::write(&path, "time_s,output,input\n")?;
/// assert_eq!(Input::open(&path, 1 << 20)?.bytes().len(), 20);
/// assert_eq!(Input::open(&path, 19).unwrap_err().code(), "file-too-long");
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    name: String,
    bytes: Vec<u8>,
    pub(super) place: Option<Place>,
}

impl Input {
    /// Reads the file at a path.
    ///
    /// # Errors
    /// [`FileError`] where it is a folder or cannot be read, or has more than `most` bytes.
    pub fn open(path: &Path, most: u64) -> Result<Self, FileError> {
        let file = File::open(path).map_err(|error| unreadable(name(path), &error))?;
        Self::read(path.to_string_lossy().into_owned(), file, most, place(path))
    }

    /// Reads standard input.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn standard(most: u64) -> Result<Self, FileError> {
        Self::read("standard input".to_owned(), std::io::stdin(), most, place(Path::new("/dev/stdin")))
    }

    fn read(name: String, source: impl Read, most: u64, place: Option<Place>) -> Result<Self, FileError> {
        let mut bytes = Vec::new();
        let read = source.take(most.saturating_add(1)).read_to_end(&mut bytes);
        if read.map_err(|error| unreadable(cut(&name, LONGEST_NAME), &error))? as u64 > most {
            return Err(FileError::TooLong { name: cut(&name, LONGEST_NAME), limit_mib: most.div_ceil(1 << 20) });
        }
        Ok(Self { name, bytes, place })
    }

    /// Its path as text, or `standard input`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All of it.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

fn unreadable(name: String, error: &dyn core::fmt::Display) -> FileError {
    FileError::Unreadable { name, reason: error.to_string() }
}
