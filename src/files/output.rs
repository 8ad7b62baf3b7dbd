//! What is written.

use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

use super::{FileError, name, parent};

/// A place to write to, which [`Files`](super::Files) has found to be neither an input nor a second output.
#[derive(Debug)]
pub struct Output {
    pub(super) name: String,
    /// Where every link ends.
    pub(super) place: PathBuf,
}

impl Output {
    /// Writes a file whole or not at all: beside its place, synced, then renamed. A pipe or a device is written as it stands.
    ///
    /// # Errors
    /// [`FileError::Unwritable`]; the file is then as it was.
    pub fn write(self, content: &[u8]) -> Result<(), FileError> {
        let written = replace(&self.place, content);
        written.map_err(|error| FileError::Unwritable { name: self.name, reason: error.to_string() })
    }
}

impl Output {
    /// Opens the file to be written piece by piece: written bytes stay on disk, however this process ends.
    ///
    /// # Errors
    /// [`FileError::Unwritable`].
    pub fn stream(self) -> Result<File, FileError> {
        let opened = File::create(&self.place);
        opened.map_err(|error| FileError::Unwritable { name: self.name, reason: error.to_string() })
    }
}

/// Makes a folder to write to, where it is not there.
///
/// # Errors
/// [`FileError::Unwritable`].
pub fn folder(path: &Path) -> Result<(), FileError> {
    let made = fs::create_dir_all(path);
    made.map_err(|error| FileError::Unwritable { name: name(path), reason: error.to_string() })
}

fn replace(place: &Path, content: &[u8]) -> io::Result<()> {
    let permissions = match fs::metadata(place) {
        Ok(before) if !before.is_file() => return fs::write(place, content),
        Ok(before) => {
            // A read-only file is not replaced.
            File::options().write(true).open(place)?;
            Some(before.permissions())
        }
        Err(_) => None,
    };
    let folder = parent(place);
    renamed(&folder, permissions.clone().or_else(usual), place, |beside| {
        beside.write_all(content)?;
        if let Some(permissions) = permissions {
            // Permissions of a new file are masked; a replaced file keeps its own.
            beside.as_file().set_permissions(permissions)?;
        }
        beside.as_file().sync_all()
    })?;
    // The new name outlasts a loss of power, too, where folders can be synced.
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

/// Those of any new file, before the mask.
#[cfg(unix)]
fn usual() -> Option<Permissions> {
    Some(std::os::unix::fs::PermissionsExt::from_mode(0o666))
}

#[cfg(not(unix))]
fn usual() -> Option<Permissions> {
    None
}

/// Files of this process that are not yet whole, which neither an error nor a signal leaves behind.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes a file under a unique name, and renames it to `place`.
fn renamed(
    folder: &Path,
    permissions: Option<Permissions>,
    place: &Path,
    write: impl FnOnce(&mut NamedTempFile) -> io::Result<()>,
) -> io::Result<()> {
    let mut builder = Builder::new();
    builder.prefix(".selfosc-").suffix(".part");
    permissions.map(|permissions| builder.permissions(permissions));
    // A signal finds every file that is there: none is made while it looks.
    let mut file = {
        let mut unfinished = unfinished();
        let file = builder.tempfile_in(folder)?;
        unfinished.push(file.path().to_owned());
        file
    };
    let beside = file.path().to_owned();
    // Dropped on an error, the file is removed.
    let done = write(&mut file).and_then(|()| file.persist(place).map(drop).map_err(io::Error::from));
    unfinished().retain(|path| *path != beside);
    done
}

/// Called by the first signal instead of ending this process.
static INSTEAD: Mutex<Option<Box<dyn FnOnce() + Send>>> = Mutex::new(None);

/// The first SIGINT, SIGTERM or SIGHUP from now on calls `act` and lets this process end by itself; the second ends it.
pub(crate) fn on_signal(act: impl FnOnce() + Send + 'static) {
    *INSTEAD.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(act));
}

/// From now on SIGINT, SIGTERM and SIGHUP remove unfinished files before they end this process. An ignored signal, as
/// under `nohup`, stays ignored.
#[cfg(unix)]
pub(crate) fn remove_on_signal() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ignored = ignored_signals();
    let ending = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let Ok(mut signals) = signal_hook::iterator::Signals::new(ending) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            if let Some(act) = INSTEAD.lock().unwrap_or_else(PoisonError::into_inner).take() {
                act();
                continue;
            }
            let unfinished = unfinished();
            for path in &*unfinished {
                let _ = fs::remove_file(path);
            }
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

#[cfg(not(unix))]
pub(crate) fn remove_on_signal() {}

/// A bit for each signal that this process inherited as ignored; zero where the system does not report them.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
