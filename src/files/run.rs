//! The files of one run, none of which may overwrite another.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::{FileError, Input, LONGEST_NAME, Output, Place, cut, identity, name, parent, place};

/// Inputs and outputs so far. An output is refused that is an input, another output or standard output, by device and inode.
///
/// ```
/// use selfosc::files::Files;
/// # let path = std::env::temp_dir().join(format!("selfosc-files-{}", std::process::id()));
/// std::fs::write(&path, "time_s,output,input\n")?;
/// let mut files = Files::default();
/// let log = files.read(&path, 1 << 20)?;
/// assert_eq!(files.output(&path).unwrap_err().code(), "output-is-input");
/// files.output(&path.with_extension("html"))?.write(b"<!DOCTYPE html>")?;
/// # std::fs::remove_file(path.with_extension("html"))?;
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Files {
    /// Name of each in messages.
    known: Vec<(String, Option<Place>)>,
    digests: Vec<String>,
}

impl Files {
    /// Reads an input.
    ///
    /// # Errors
    /// As [`Input::open`]; [`FileError::Taken`] where standard output goes to it.
    pub fn read(&mut self, path: &Path, most: u64) -> Result<Input, FileError> {
        self.add(Input::open(path, most)?)
    }

    /// Reads standard input, once.
    ///
    /// # Errors
    /// As [`read`](Self::read); [`FileError::Unreadable`] where it has been read before.
    pub fn read_standard(&mut self, most: u64) -> Result<Input, FileError> {
        let input = Input::standard(most)?;
        if self.known.iter().any(|(known, _)| known.strip_prefix("the input ") == Some(input.name())) {
            let (name, reason) = (input.name().to_owned(), "it is named twice and can be read once".to_owned());
            return Err(FileError::Unreadable { name, reason });
        }
        self.add(input)
    }

    fn add(&mut self, input: Input) -> Result<Input, FileError> {
        let other = format!("the input {}", cut(input.name(), LONGEST_NAME));
        // A log that grows while it is read is none.
        if input.place.is_some() && input.place == standard_output() {
            return Err(FileError::Taken { name: "standard output".to_owned(), other });
        }
        self.digests.push(format!("{}: SHA-256 {:x}", input.name(), Sha256::digest(input.bytes())));
        self.known.push((other, input.place.clone()));
        Ok(input)
    }

    /// Counts a file as an input that another program reads.
    pub fn protect(&mut self, path: &Path) {
        self.known.push((format!("the input {}", name(path)), place(path)));
    }

    /// An output for this path, not yet written.
    ///
    /// # Errors
    /// [`FileError::Taken`]; [`FileError::Unwritable`] where it is a folder, or there is no folder for it.
    pub fn output(&mut self, path: &Path) -> Result<Output, FileError> {
        let unwritable = |reason: String| FileError::Unwritable { name: name(path), reason };
        let end = target(path).map_err(|error| unwritable(error.to_string()))?;
        let there = match fs::metadata(&end) {
            Ok(about) if about.is_dir() => return Err(unwritable("it is a folder".to_owned())),
            Ok(_) => place(&end),
            Err(_) => {
                let (folder, file) = (parent(&end), end.file_name().unwrap_or_default());
                let about = fs::metadata(&folder).map_err(|error| unwritable(error.to_string()))?;
                identity(&folder, &about)
                    .map(|(device, inode, folder)| (device, inode, Path::new(&folder).join(file).into()))
            }
        };
        let standard = [("standard output".to_owned(), standard_output())];
        match self.known.iter().chain(&standard).find(|(_, other)| there.is_some() && *other == there) {
            Some((other, _)) => Err(FileError::Taken { name: name(path), other: other.clone() }),
            None => {
                self.known.push((format!("the output {}", name(path)), there));
                Ok(Output { name: name(path), place: end })
            }
        }
    }

    /// A line for each input read: its name and the SHA-256 of its bytes, in the format of `sha256sum`.
    #[must_use]
    pub fn digests(&self) -> &[String] {
        &self.digests
    }
}

fn standard_output() -> Option<Place> {
    place(Path::new("/dev/stdout"))
}

/// The plain file that a path ends at, through every link, whether it is there or not.
fn target(path: &Path) -> std::io::Result<PathBuf> {
    match (fs::canonicalize(path), fs::read_link(path)) {
        (Ok(end), _) if end.is_file() => Ok(end),
        (Err(error), Ok(next)) if error.kind() == ErrorKind::NotFound => target(&parent(path).join(next)),
        (Err(error), Ok(_)) => Err(error),
        _ => Ok(path.to_owned()),
    }
}
