//! The results folder of a run. It accepts one run at a time, and problems with it are reported
//! before any scoring.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use fovqa_io::read_head;
use fovqa_results::{
    CURVES_CSV, CURVES_JSON, INDEX_HTML, INPUTS_CSV, LIMITS_CSV, LIMITS_JSON, OPINIONS_CSV,
    REPORT_HTML, REPORT_JSON, RESULTS_CSV, RESULTS_PARQUET, RUN_JSON, STUDY_JSON, SUMMARY_JSON,
    VALUES_PARQUET, make_folder, sweep, take_away, try_writing,
};
use thiserror::Error;

use crate::journal::JOURNAL;

/// Name of the lock file. The lock on the file counts, not its existence.
const LOCK: &str = ".fovqa.lock";

/// The files that a run writes, and the figures at the top level of its folder.
const OURS: [&str; 19] = [
    RESULTS_CSV,
    RESULTS_PARQUET,
    VALUES_PARQUET,
    INPUTS_CSV,
    SUMMARY_JSON,
    RUN_JSON,
    JOURNAL,
    REPORT_JSON,
    CURVES_CSV,
    CURVES_JSON,
    LIMITS_CSV,
    LIMITS_JSON,
    STUDY_JSON,
    OPINIONS_CSV,
    INDEX_HTML,
    REPORT_HTML,
    "table.csv",
    "table.md",
    "table.tex",
];

/// Whether a folder contains the results of a run, or the remains of a run that was killed or had
/// no disk space.
fn is_ours(path: &Path) -> bool {
    begins(path, RUN_JSON, "fovqa.run")
        || begins(path, JOURNAL, "fovqa.journal")
        || begins(path, REPORT_JSON, "fovqa.report")
        || begins(path, CURVES_JSON, "fovqa.curves")
        || begins(path, LIMITS_JSON, "fovqa.limits")
        || begins(path, STUDY_JSON, STUDIES)
}

/// The schema of the results of a study file. `fovqa study` writes those of a single analysis, which have
/// another schema, into any folder.
const STUDIES: &str = "fovqa.studies";

/// Whose results a folder holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Run,
    Curves,
    Limits,
    Study,
}

/// The files that tell whose results a folder holds, with the beginning of their schemas and the
/// command that writes them.
const KINDS: [(Kind, &str, &str, &str); 5] = [
    (Kind::Run, RUN_JSON, "fovqa.run", "`fovqa run`"),
    (Kind::Run, JOURNAL, "fovqa.journal", "`fovqa run`"),
    (Kind::Curves, CURVES_JSON, "fovqa.curves", "`fovqa curves`"),
    (Kind::Limits, LIMITS_JSON, "fovqa.limits", "`fovqa limit`"),
    (Kind::Study, STUDY_JSON, STUDIES, "`fovqa study`"),
];

/// Whether a file in a folder begins like a file with the given schema.
fn begins(path: &Path, file: &str, schema: &str) -> bool {
    const HEAD_BYTES: u64 = 256;
    let head = read_head(&path.join(file), HEAD_BYTES).unwrap_or_default();
    String::from_utf8_lossy(&head).contains(&format!("\"{schema}/"))
}

/// Whether a file contains data that could be lost. (A full disk leaves empty files.)
fn has_content(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|file| !file.is_file() || file.len() > 0)
}

/// Whether a folder is locked while results are written to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Locking {
    /// The folder is locked: only one process at a time writes to it.
    #[default]
    Locked,
    /// The folder is not locked: the caller ensures that only one process writes. Some network file
    /// systems have no locks.
    Unlocked,
}

/// A results folder, locked for as long as this value lives.
#[derive(Debug)]
pub struct ResultsFolder {
    path: PathBuf,
    /// The operating system releases the lock when the process ends, in whatever way it ends.
    _lock: Option<File>,
}

/// A folder that cannot be written to.
#[derive(Debug, Error)]
pub enum FolderError {
    /// The operating system refuses.
    #[error("{}: cannot write results to this folder: {error}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// The file system has no locks, or refuses this one.
    #[error("{}: cannot lock this folder: {error}", path.display())]
    Lock {
        /// The folder.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// Another process writes to it.
    #[error("{}: another run is writing to this folder", .0.display())]
    Busy(PathBuf),
    /// It contains results of another kind: of a run, of curves, of a search for limits, or of a study.
    #[error("{}: the folder contains the results of {of}", path.display())]
    Other {
        /// The folder.
        path: PathBuf,
        /// What the results belong to.
        of: &'static str,
    },
    /// It contains files that a run would replace and that do not belong to a run.
    #[error("{}: the folder contains a {file} that no run of fovqa has written", path.display())]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// The file.
        file: &'static str,
    },
}

impl FolderError {
    /// How to correct the error.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Io { .. } => "give a writable folder with {output}",
            Self::Lock { .. } => {
                "write to a local disk with {output}, or use --no-lock and make sure that nothing else writes \
                 to the folder"
            }
            Self::Busy(_) => "wait until it has finished, or give another folder with {output}",
            Self::Other { .. } | Self::Foreign { .. } => {
                "move it away, or give another folder with {output}"
            }
        }
    }
}

/// The lock file of a folder, locked.
fn locked(folder: &Path) -> Result<File, FolderError> {
    let failed = |error| FolderError::Io { path: folder.to_owned(), error };
    let path = folder.join(LOCK);
    // Opening a pipe would wait for its other end.
    if fs::metadata(&path).is_ok_and(|file| !file.is_file()) {
        let error = io::Error::other(format!("{LOCK} is not a regular file"));
        return Err(failed(error));
    }
    let file = File::options().create(true).append(true).open(&path).map_err(failed)?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(error) => Err(not_locked(folder, error)),
    }
}

/// Why a folder is not locked.
fn not_locked(folder: &Path, error: TryLockError) -> FolderError {
    let path = folder.to_owned();
    match error {
        TryLockError::WouldBlock => FolderError::Busy(path),
        TryLockError::Error(error) => FolderError::Lock { path, error },
    }
}

impl ResultsFolder {
    /// Creates the folder of a run and locks it.
    ///
    /// # Errors
    /// If the folder cannot be created or written to, another process uses it, or its files do not
    /// belong to a run.
    pub fn open(path: &Path, locking: Locking) -> Result<Self, FolderError> {
        Self::of_one(path, Kind::Run, locking)
    }

    /// Creates the folder of curves and locks it.
    ///
    /// # Errors
    /// If the folder cannot be created or written to, another process uses it, or its files do not
    /// belong to curves.
    pub fn open_for_curves(path: &Path, locking: Locking) -> Result<Self, FolderError> {
        Self::of_one(path, Kind::Curves, locking)
    }

    /// Creates the folder of a search for limits and locks it.
    ///
    /// # Errors
    /// If the folder cannot be created or written to, another process uses it, or its files do not
    /// belong to such a search.
    pub fn open_for_limits(path: &Path, locking: Locking) -> Result<Self, FolderError> {
        Self::of_one(path, Kind::Limits, locking)
    }

    /// Creates the folder of a study file and locks it.
    ///
    /// # Errors
    /// If the folder cannot be created or written to, another process uses it, or its files do not
    /// belong to a study.
    pub fn open_for_study(path: &Path, locking: Locking) -> Result<Self, FolderError> {
        Self::of_one(path, Kind::Study, locking)
    }

    fn of_one(path: &Path, kind: Kind, locking: Locking) -> Result<Self, FolderError> {
        let other = KINDS.into_iter().filter(|(other, ..)| *other != kind);
        let mut other = other.filter(|(_, file, schema, _)| begins(path, file, schema));
        match other.next() {
            Some((.., of)) => Err(FolderError::Other { path: path.to_owned(), of }),
            None => Self::of_any(path, locking),
        }
    }

    fn of_any(path: &Path, locking: Locking) -> Result<Self, FolderError> {
        let failed = |error| FolderError::Io { path: path.to_owned(), error };
        make_folder(path).map_err(failed)?;
        // Beside a journal that a full disk has left empty, a shard may have its values.
        let is_of_shard = |file: &str| file == VALUES_PARQUET && path.join(JOURNAL).exists();
        let is_foreign = |file: &&str| !is_of_shard(file) && has_content(&path.join(file));
        if !is_ours(path)
            && let Some(file) = OURS.into_iter().find(is_foreign)
        {
            return Err(FolderError::Foreign { path: path.to_owned(), file });
        }
        let lock = match locking {
            Locking::Locked => Some(locked(path)?),
            Locking::Unlocked => None,
        };
        // The lock file may be older than the cause that now prevents new files.
        try_writing(path).map_err(failed)?;
        for folder in [path, &path.join("plots")] {
            sweep(folder);
        }
        Ok(Self { path: path.to_owned(), _lock: lock })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Removes the results of an earlier run, so that they cannot be mistaken for the results of
    /// this one. The old journal stays until a new one begins, so that the folder can always be
    /// recognised as the folder of a run.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub fn clear(&self) -> Result<(), FolderError> {
        let files = [
            RESULTS_CSV,
            RESULTS_PARQUET,
            VALUES_PARQUET,
            INPUTS_CSV,
            SUMMARY_JSON,
            RUN_JSON,
            CURVES_CSV,
            CURVES_JSON,
            LIMITS_CSV,
            LIMITS_JSON,
            STUDY_JSON,
            OPINIONS_CSV,
        ];
        for file in files {
            take_away(&self.path.join(file))
                .map_err(|error| FolderError::Io { path: self.path.clone(), error })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(path: &Path) -> Result<ResultsFolder, FolderError> {
        ResultsFolder::open(path, Locking::Locked)
    }

    #[test]
    fn a_file_system_without_locks_is_said_and_can_do_without() {
        let folder = tempfile::tempdir().unwrap();
        for kind in [io::ErrorKind::Unsupported, io::ErrorKind::Other] {
            let error = not_locked(folder.path(), TryLockError::Error(kind.into()));
            assert!(matches!(error, FolderError::Lock { .. }), "{error}");
            assert!(error.help().contains("--no-lock"));
        }
        let first = open(folder.path()).unwrap();
        ResultsFolder::open(folder.path(), Locking::Unlocked).unwrap();
        drop(first);
        fs::remove_file(folder.path().join(LOCK)).unwrap();
        fs::create_dir(folder.path().join(LOCK)).unwrap();
        assert!(open(folder.path()).is_err());
        ResultsFolder::open(folder.path(), Locking::Unlocked).unwrap();
    }

    #[test]
    fn one_run_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let first = open(folder.path()).unwrap();
        assert!(matches!(open(folder.path()), Err(FolderError::Busy(_))));
        drop(first);
        open(folder.path()).unwrap();
    }

    #[test]
    fn what_a_killed_writer_left_is_taken_away() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("plots")).unwrap();
        let ours = [".fovqa-0123456789abcdef.tmp", "plots/.fovqa-00000000000000ff.tmp"];
        let others = [".index.html.12.tmp", ".fovqa-mine.tmp", "a.csv.1.tmp", "plots/a.png"];
        for file in ours.iter().chain(&others) {
            fs::write(folder.path().join(file), "half").unwrap();
        }
        drop(open(folder.path()).unwrap());
        assert!(ours.iter().all(|file| !folder.path().join(file).exists()));
        assert!(others.iter().all(|file| folder.path().join(file).exists()));
    }

    #[test]
    fn files_of_others_are_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(RESULTS_CSV), "mine").unwrap();
        let error = open(folder.path()).unwrap_err();
        assert!(matches!(error, FolderError::Foreign { .. }));
        fs::remove_file(folder.path().join(RESULTS_CSV)).unwrap();
        drop(open(folder.path()).unwrap());
        fs::write(folder.path().join(RUN_JSON), "{\"my\": \"run\"}").unwrap();
        let error = open(folder.path()).unwrap_err();
        assert!(matches!(error, FolderError::Foreign { file: RUN_JSON, .. }), "{error}");
        fs::write(folder.path().join(RUN_JSON), "{\n  \"schema\": \"fovqa.run/1\"").unwrap();
        fs::write(folder.path().join(RESULTS_CSV), "old").unwrap();
        let ours = open(folder.path()).unwrap();
        ours.clear().unwrap();
        assert!(!folder.path().join(RESULTS_CSV).exists());
        drop(ours);
        // An empty file, which a full disk leaves, contains nothing that could be lost.
        let values = folder.path().join(VALUES_PARQUET);
        fs::write(&values, "values").unwrap();
        let error = open(folder.path()).unwrap_err();
        assert!(matches!(error, FolderError::Foreign { file: VALUES_PARQUET, .. }), "{error}");
        fs::write(folder.path().join(JOURNAL), "").unwrap();
        drop(open(folder.path()).unwrap());
        fs::remove_file(values).unwrap();
        fs::write(folder.path().join("table.md"), "mine").unwrap();
        assert!(open(folder.path()).is_err());
        fs::write(folder.path().join(REPORT_JSON), "{\n  \"schema\": \"fovqa.report/1\"").unwrap();
        open(folder.path()).unwrap();
    }
}
