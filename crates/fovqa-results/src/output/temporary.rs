//! Temporary files, and the removal of those that remain when a process is killed.
//!
//! The name is `.fovqa-`, 16 random hexadecimal digits and `.tmp`. A process that writes such a
//! file holds a lock on it, and the lock is released when the process ends. If the file can be
//! locked, its process no longer exists.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

const BEFORE: &str = ".fovqa-";
const BEHIND: &str = ".tmp";
const DIGITS: usize = 16;

/// A name that cannot be predicted: the keys of the hasher come from the random numbers of the
/// operating system.
fn name() -> String {
    format!("{BEFORE}{:0DIGITS$x}{BEHIND}", RandomState::new().hash_one(()))
}

/// Whether a file with this name is certainly a temporary file.
fn is_temporary(name: &str) -> bool {
    let digits = name.strip_prefix(BEFORE).and_then(|name| name.strip_suffix(BEHIND));
    digits.is_some_and(|digits| {
        let is_digit = |byte: u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte);
        digits.len() == DIGITS && digits.bytes().all(is_digit)
    })
}

/// A new file with a temporary name. It is removed when this value is dropped, unless it was
/// renamed to its final name.
pub(super) struct Temporary {
    pub(super) file: File,
    /// The path; `None` after the file was renamed or removed.
    path: Option<PathBuf>,
}

impl Temporary {
    pub(super) fn new(folder: &Path) -> io::Result<Self> {
        /// Maximum number of attempts. A file can only be removed by a sweep in the moment before
        /// it is locked.
        const MOST_TRIES: usize = 100;
        for _ in 0..MOST_TRIES {
            let path = folder.join(name());
            let file = match File::options().write(true).create_new(true).open(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                made => made?,
            };
            let lock = file.try_lock();
            let temporary = Self { file, path: Some(path.clone()) };
            match lock {
                Err(TryLockError::WouldBlock) => {}
                // A sweep may have removed the file before it was locked.
                Ok(()) if fs::symlink_metadata(&path).is_err() => {}
                // If there are no locks, no sweep removes files that others may be writing.
                Ok(()) | Err(TryLockError::Error(_)) => return Ok(temporary),
            }
        }
        Err(io::Error::other("temporary files are taken away as soon as they are made"))
    }

    /// Flushes the bytes to the disk, and then renames the file to its final name, replacing an
    /// existing file. The name itself is flushed with its folder.
    pub(super) fn become_file(mut self, path: &Path) -> io::Result<()> {
        sync(&self.file)?;
        if let Some(temporary) = &self.path {
            fs::rename(temporary, path)?;
        }
        self.path = None;
        Ok(())
    }

    pub(super) fn take_away(mut self) -> io::Result<()> {
        self.path.take().map_or(Ok(()), fs::remove_file)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            // If it cannot be removed, the next run that uses the folder tries again.
            let _ = fs::remove_file(path);
        }
    }
}

fn sync(file: &File) -> io::Result<()> {
    use io::ErrorKind::{InvalidInput, Unsupported};
    match file.sync_all() {
        // Some file systems do not support flushing.
        Err(error) if matches!(error.kind(), InvalidInput | Unsupported) => Ok(()),
        synced => synced,
    }
}

/// Flushes a folder to the disk. The file exists even if this fails.
#[cfg(unix)]
pub(super) fn sync_folder(folder: &Path) {
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}

#[cfg(not(unix))]
pub(super) fn sync_folder(_: &Path) {}

/// Which other processes may be writing to a folder.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Others {
    /// Any process may be writing.
    Maybe,
    /// No other process: the folder belongs to this one.
    Nobody,
}

/// Removes the temporary files of killed processes from a folder to which no other process writes
/// at present.
pub fn sweep(folder: &Path) {
    sweep_beside(folder, Others::Nobody);
}

/// Removes the temporary files of killed processes from any folder, when this process first writes
/// there.
pub(super) fn sweep_once(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let new = |folder: PathBuf| {
        let mut swept = SWEPT.lock().unwrap_or_else(PoisonError::into_inner);
        swept.insert(folder)
    };
    if folder.canonicalize().is_ok_and(new) {
        sweep_beside(folder, Others::Maybe);
    }
}

fn sweep_beside(folder: &Path, others: Others) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let names = entries.flatten();
    for entry in names.filter(|entry| is_temporary(&entry.file_name().to_string_lossy())) {
        // Opening something other than a file might block.
        if entry.file_type().is_ok_and(|kind| kind.is_file()) {
            take_away_left(&entry.path(), others);
        }
    }
}

/// Removes a file, unless a process has locked it.
fn take_away_left(path: &Path, others: Others) {
    let Ok(file) = File::options().write(true).open(path) else { return };
    let is_left = match file.try_lock() {
        Ok(()) => true,
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => others == Others::Nobody,
    };
    if is_left {
        // If it cannot be removed, it does no harm.
        let _ = fs::remove_file(path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_from_all_others() {
        let (one, other) = (name(), name());
        assert!(is_temporary(&one) && is_temporary(&other));
        assert_ne!(one, other);
        for name in [
            ".fovqa-0123456789abcde.tmp",
            ".fovqa-0123456789abcdef0.tmp",
            ".fovqa-0123456789abcdeF.tmp",
            "fovqa-0123456789abcdef.tmp",
            ".fovqa-0123456789abcdef.tmp~",
            ".fovqa.lock",
            ".index.html.123.tmp",
        ] {
            assert!(!is_temporary(name), "{name}");
        }
    }

    #[test]
    fn what_is_left_is_swept_and_what_is_being_written_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let left = folder.path().join(name());
        for sweep in [sweep, sweep_once] {
            fs::write(&left, "half").unwrap();
            fs::write(folder.path().join(".index.html.tmp"), "mine").unwrap();
            let written = Temporary::new(folder.path()).unwrap();
            sweep(folder.path());
            assert!(!left.exists());
            let (path, target) = (written.path.clone().unwrap(), folder.path().join("a"));
            assert!(path.exists() && folder.path().join(".index.html.tmp").exists());
            written.become_file(&target).unwrap();
            assert!(target.exists() && !path.exists());
        }
        // The sweep runs only once per folder.
        fs::write(&left, "half").unwrap();
        sweep_once(folder.path());
        assert!(left.exists());
    }

    #[test]
    fn writers_and_sweepers_do_not_meet() {
        let folder = tempfile::tempdir().unwrap();
        let done = std::sync::atomic::AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(std::sync::atomic::Ordering::Relaxed) {
                    sweep_beside(folder.path(), Others::Maybe);
                }
            });
            for file in 0..500 {
                let temporary = Temporary::new(folder.path()).unwrap();
                fs::rename(temporary.path.as_ref().unwrap(), folder.path().join("a"))
                    .unwrap_or_else(|error| panic!("{file}: {error}"));
            }
            done.store(true, std::sync::atomic::Ordering::Relaxed);
        });
    }
}
