//! The folder a run writes to: one run at a time, found wanting before any scoring.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use fovqa_results::{CURVES_CSV, CURVES_JSON, REPORT_JSON, RESULTS_CSV, RUN_JSON, SUMMARY_JSON};
use thiserror::Error;

use crate::journal::JOURNAL;

/// Its lock is what counts, not that it is there.
const LOCK: &str = ".fovqa.lock";

/// What a run writes, and what is drawn of it at its top.
const OURS: [&str; 11] = [
    RESULTS_CSV,
    SUMMARY_JSON,
    RUN_JSON,
    JOURNAL,
    REPORT_JSON,
    CURVES_CSV,
    CURVES_JSON,
    "index.html",
    "table.csv",
    "table.md",
    "table.tex",
];

/// Whether a folder has the results of a run, or what one that was killed, or had no room, has left.
fn is_ours(path: &Path) -> bool {
    begins(path, RUN_JSON, "fovqa.run")
        || begins(path, JOURNAL, "fovqa.journal")
        || begins(path, REPORT_JSON, "fovqa.report")
        || begins(path, CURVES_JSON, "fovqa.curves")
}

/// Whether a file in a folder begins as one of a schema does.
fn begins(path: &Path, file: &str, schema: &str) -> bool {
    let mut head = [0; 256];
    let read = File::open(path.join(file)).and_then(|mut file| file.read(&mut head));
    let head = String::from_utf8_lossy(&head[..read.unwrap_or(0)]).into_owned();
    head.contains(&format!("\"{schema}/"))
}

/// Whether there is something to lose. (A full disk leaves empty files.)
fn has_content(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|file| file.is_dir() || file.len() > 0)
}

/// Takes away what writers that were killed have left under temporary names. Nobody writes there now.
fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if is_temporary(&entry.file_name().to_string_lossy()) {
            // Where it cannot be taken away, it is in nobody's way.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether a name is `.NAME.PROCESS.tmp`, of a file that a run or a drawing writes.
fn is_temporary(name: &str) -> bool {
    const ENDINGS: [&str; 8] = ["csv", "json", "jsonl", "html", "md", "tex", "svg", "png"];
    let inner = name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp"));
    inner.and_then(|inner| inner.rsplit_once('.')).is_some_and(|(of, process)| {
        let ours = of == "fovqa" || of.rsplit_once('.').is_some_and(|(_, e)| ENDINGS.contains(&e));
        ours && !process.is_empty() && process.bytes().all(|b| b.is_ascii_digit())
    })
}

/// A folder of results, locked for as long as this lives.
#[derive(Debug)]
pub struct ResultsFolder {
    path: PathBuf,
    /// The system releases it with the process, however that ends.
    _lock: File,
}

/// A folder that cannot be written to.
#[derive(Debug, Error)]
pub enum FolderError {
    /// The system refuses.
    #[error("{}: results cannot be written there: {error}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// Another process writes to it.
    #[error("{}: another run is writing there", .0.display())]
    Busy(PathBuf),
    /// It has results of the other kind: of a run, or of curves.
    #[error("{}: it has the results of {of}", path.display())]
    Other {
        /// The folder.
        path: PathBuf,
        /// Whose they are.
        of: &'static str,
    },
    /// It has files that a run would replace, and that are of no run.
    #[error("{}: it has a {file} that is of no run", path.display())]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// The file.
        file: &'static str,
    },
}

impl FolderError {
    /// How to mend it.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Io { .. } => "give a folder that can be written to with {output}",
            Self::Busy(_) => "wait until it is done, or give another folder with {output}",
            Self::Other { .. } | Self::Foreign { .. } => {
                "move it away, or give another folder with {output}"
            }
        }
    }
}

impl ResultsFolder {
    /// Makes the folder of a run, and locks it.
    ///
    /// # Errors
    /// When it cannot be made or written to, another process has it, or its files are not those of a
    /// run.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        if begins(path, CURVES_JSON, "fovqa.curves") {
            return Err(FolderError::Other { path: path.to_owned(), of: "`fovqa curves`" });
        }
        Self::of_any(path)
    }

    /// The same of curves.
    ///
    /// # Errors
    /// When it cannot be made or written to, another process has it, or its files are not those of
    /// curves.
    pub fn open_for_curves(path: &Path) -> Result<Self, FolderError> {
        if begins(path, RUN_JSON, "fovqa.run") || begins(path, JOURNAL, "fovqa.journal") {
            return Err(FolderError::Other { path: path.to_owned(), of: "`fovqa run`" });
        }
        Self::of_any(path)
    }

    fn of_any(path: &Path) -> Result<Self, FolderError> {
        let failed = |error| FolderError::Io { path: path.to_owned(), error };
        fs::create_dir_all(path).map_err(failed)?;
        if !is_ours(path)
            && let Some(file) = OURS.into_iter().find(|file| has_content(&path.join(file)))
        {
            return Err(FolderError::Foreign { path: path.to_owned(), file });
        }
        let lock = path.join(LOCK);
        let lock = File::options().create(true).append(true).open(&lock).map_err(failed)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(FolderError::Busy(path.to_owned())),
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        // The lock file may be older than what now keeps others from being made.
        let probe = path.join(format!(".fovqa.{}.tmp", std::process::id()));
        let made = File::create(&probe).and_then(|mut file| file.write_all(b"fovqa"));
        let removed = fs::remove_file(&probe);
        made.and(removed).map_err(failed)?;
        for folder in [path, &path.join("plots")] {
            sweep(folder);
        }
        Ok(Self { path: path.to_owned(), _lock: lock })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Takes away the results of an earlier run, so that they cannot be taken for this one's. Its
    /// journal stays until another is begun: the folder is ours all the while.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn clear(&self) -> Result<(), FolderError> {
        for file in [RESULTS_CSV, SUMMARY_JSON, RUN_JSON, CURVES_CSV, CURVES_JSON] {
            match fs::remove_file(self.path.join(file)) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return Err(FolderError::Io { path: self.path.clone(), error });
                }
                _ => {}
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_run_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let first = ResultsFolder::open(folder.path()).unwrap();
        assert!(matches!(ResultsFolder::open(folder.path()), Err(FolderError::Busy(_))));
        drop(first);
        ResultsFolder::open(folder.path()).unwrap();
    }

    #[test]
    fn what_a_killed_writer_left_is_taken_away() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("plots")).unwrap();
        let ours = [".index.html.123.tmp", ".journal.jsonl.7.tmp", "plots/.a.b.svg.9.tmp"];
        let others =
            [".index.html.tmp", ".mine.12.tmp", "a.csv.1.tmp", ".a.csv.x.tmp", "plots/a.png"];
        for file in ours.iter().chain(&others) {
            fs::write(folder.path().join(file), "half").unwrap();
        }
        drop(ResultsFolder::open(folder.path()).unwrap());
        assert!(ours.iter().all(|file| !folder.path().join(file).exists()));
        assert!(others.iter().all(|file| folder.path().join(file).exists()));
    }

    #[test]
    fn files_of_others_are_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(RESULTS_CSV), "mine").unwrap();
        let error = ResultsFolder::open(folder.path()).unwrap_err();
        assert!(matches!(error, FolderError::Foreign { .. }));
        fs::remove_file(folder.path().join(RESULTS_CSV)).unwrap();
        drop(ResultsFolder::open(folder.path()).unwrap());
        fs::write(folder.path().join(RUN_JSON), "{\"my\": \"run\"}").unwrap();
        let error = ResultsFolder::open(folder.path()).unwrap_err();
        assert!(matches!(error, FolderError::Foreign { file: RUN_JSON, .. }), "{error}");
        fs::write(folder.path().join(RUN_JSON), "{\n  \"schema\": \"fovqa.run/1\"").unwrap();
        fs::write(folder.path().join(RESULTS_CSV), "old").unwrap();
        let ours = ResultsFolder::open(folder.path()).unwrap();
        ours.clear().unwrap();
        assert!(!folder.path().join(RESULTS_CSV).exists());
        drop(ours);
        // What a full disk leaves is nobody's loss.
        fs::write(folder.path().join(JOURNAL), "").unwrap();
        drop(ResultsFolder::open(folder.path()).unwrap());
        fs::write(folder.path().join("table.md"), "mine").unwrap();
        assert!(ResultsFolder::open(folder.path()).is_err());
        fs::write(folder.path().join(REPORT_JSON), "{\n  \"schema\": \"fovqa.report/1\"").unwrap();
        ResultsFolder::open(folder.path()).unwrap();
    }
}
