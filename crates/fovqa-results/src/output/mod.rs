//! Writes files so that a reader sees the old file or the new one, never a part of either, and that
//! files survive a power failure.

mod target;
mod temporary;

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::Serialize;

use crate::files::FileError;
use target::{Target, open_again, open_special};
pub use temporary::sweep;
use temporary::{Temporary, sweep_once, sync_folder};

/// Files that are written together. Each file has its bytes on the disk before it gets its name. The names
/// are flushed to the disk once for all files, by [`flush`](Self::flush) or when this value is dropped.
#[derive(Debug, Default)]
pub struct Batch {
    /// The folders with names that were not flushed yet.
    folders: Mutex<BTreeSet<PathBuf>>,
}

impl Batch {
    /// Writes a file of a run completely: under a temporary name in the same folder, which is then
    /// renamed.
    ///
    /// A symbolic link stays, and the file that it points to is replaced or created. Anything else
    /// at this path is replaced.
    ///
    /// # Errors
    /// If the operating system refuses. In that case nothing is left behind, and the old file
    /// stays.
    pub fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
        self.write_with(path, |out| out.write_all(bytes))
    }

    /// Like [`write`](Self::write), for a file that is too large for memory.
    ///
    /// # Errors
    /// See [`write`](Self::write).
    pub fn write_with(
        &self,
        path: &Path,
        write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), FileError> {
        let written = Target::file_at(path).and_then(|file| replace(&file, write));
        let folder = written.map_err(|error| FileError::Write { path: path.to_owned(), error })?;
        self.folders.lock().unwrap_or_else(PoisonError::into_inner).insert(folder);
        Ok(())
    }

    /// Writes a value as indented JSON with a newline at its end.
    ///
    /// # Errors
    /// See [`write`](Self::write).
    pub fn write_json(&self, path: &Path, value: &impl Serialize) -> Result<(), FileError> {
        self.write_with(path, |mut out| {
            serde_json::to_writer_pretty(&mut out, value)?;
            out.write_all(b"\n")
        })
    }

    /// Flushes the names of the files so far. A file that is written afterwards never survives a
    /// power failure without them.
    pub fn flush(&self) {
        let mut folders = self.folders.lock().unwrap_or_else(PoisonError::into_inner);
        for folder in std::mem::take(&mut *folders) {
            sync_folder(&folder);
        }
    }
}

impl Drop for Batch {
    fn drop(&mut self) {
        self.flush();
    }
}

/// Writes a file of a run alone: see [`Batch::write`].
///
/// # Errors
/// See [`Batch::write`].
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    Batch::default().write(path, bytes)
}

/// Like [`write_whole`], for a file that is too large for memory.
///
/// # Errors
/// See [`Batch::write`].
pub fn write_whole_with(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> Result<(), FileError> {
    Batch::default().write_with(path, write)
}

/// Writes a value as indented JSON with a newline at its end.
///
/// # Errors
/// See [`Batch::write`].
pub fn write_json_file(path: &Path, value: &impl Serialize) -> Result<(), FileError> {
    Batch::default().write_json(path, value)
}

/// Writes an output file that the user has named. A file is replaced as by [`write_whole`]; a
/// device or a pipe is written to.
///
/// # Errors
/// See [`write_whole`].
pub fn write_output(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let written = Target::of(path).and_then(|target| {
        let mut out = match target {
            Target::File(file) => {
                sync_folder(&replace(&file, |out| out.write_all(bytes))?);
                return Ok(());
            }
            Target::Special(path) => open_special(&path)?,
            Target::Open(path, stream) => open_again(&path, stream)?,
        };
        out.write_all(bytes)?;
        out.flush()
    });
    written.map_err(|error| FileError::Write { path: path.to_owned(), error })
}

/// Like [`write_output`], for a value that is written as JSON.
///
/// # Errors
/// See [`write_whole`].
pub fn write_json_output(path: &Path, value: &impl Serialize) -> Result<(), FileError> {
    write_output(path, &json(path, value)?)
}

fn json(path: &Path, value: &impl Serialize) -> Result<Vec<u8>, FileError> {
    let mut bytes = serde_json::to_vec_pretty(value)
        .map_err(|error| FileError::Write { path: path.to_owned(), error: error.into() })?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Whether an output would replace an existing file.
pub fn replaces(path: &Path) -> bool {
    Target::of(path).is_ok_and(|target| match target {
        Target::File(file) => file.exists(),
        Target::Special(_) | Target::Open(..) => false,
    })
}

/// Removes a file of a run. If the path is a symbolic link, the link stays and the file that it
/// points to is removed.
///
/// # Errors
/// If the operating system refuses. A file that does not exist is not an error.
pub fn take_away(path: &Path) -> io::Result<()> {
    match fs::remove_file(Target::file_at(path)?) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Creates a folder and its parent folders. If a symbolic link points to a folder that does not
/// exist, that folder is created.
///
/// # Errors
/// If the operating system refuses.
pub fn make_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(if path.is_dir() { path.to_owned() } else { Target::file_at(path)? })
}

/// Checks that files can be written in a folder.
///
/// # Errors
/// If the operating system refuses.
pub fn try_writing(folder: &Path) -> io::Result<()> {
    let temporary = Temporary::new(folder)?;
    (&temporary.file).write_all(b"fovqa")?;
    temporary.take_away()
}

/// Size of the buffer in front of a file: large enough for few system calls.
const BUFFER: usize = 64 << 10;

/// Replaces a file. Returns its folder, whose names are not flushed to the disk yet.
fn replace(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<PathBuf> {
    let folder = folder_of(path);
    sweep_once(&folder);
    let temporary = Temporary::new(&folder)?;
    let mut out = BufWriter::with_capacity(BUFFER, &temporary.file);
    write(&mut out)?;
    out.flush()?;
    drop(out);
    temporary.become_file(path)?;
    Ok(folder)
}

/// The folder that contains a file.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests;
