//! Writing a journal.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fovqa_metrics::Layout;
use fovqa_plan::Plan;
use fovqa_results::{FileError, Input, write_whole_with};
use serde::Serialize;
use serde_json::json;

use super::JOURNAL;
use super::header::Header;
use super::records::{ErrorRecord, FrameRecord, KeysRecord, SettledRecord};
use super::seal::sealed;
use crate::error::EngineError;
use crate::findings::{Entry, Findings, Finished, Named};

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    lines: Lines,
    /// When its bytes were last brought to the disk.
    synced: Instant,
}

/// Frames are brought to the disk one by one, but no more often than this: a loss of power costs no more
/// than that, and waiting for the disk next to nothing.
const BETWEEN_SYNCS: Duration = Duration::from_secs(1);

impl Journal {
    /// Begins a journal in place of the one that may be there: first what it is of, then what is known
    /// of it already. The old one stays until the new one has all of that.
    ///
    /// # Errors
    /// When the file cannot be made.
    pub fn begin(
        folder: &Path,
        header: &Header,
        plan: &Plan,
        known: &Findings,
    ) -> Result<Self, EngineError> {
        let path = folder.join(JOURNAL);
        let failed = |error| EngineError::Journal { path: path.clone(), error };
        let lines = write_in_order(&path, header, plan, known, Stage::Begun)?;
        let file = File::options().append(true).open(&path).map_err(failed)?;
        Ok(Self { path, file, lines, synced: Instant::now() })
    }

    /// Takes something down.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&mut self, entry: Entry<'_>) -> Result<(), EngineError> {
        let line = self.lines.of(entry);
        self.append(&line)?;
        if matches!(entry, Entry::Pair(_)) && self.synced.elapsed() >= BETWEEN_SYNCS {
            self.sync();
        }
        Ok(())
    }

    /// What cannot be brought to the disk is written all the same: the system does so in its own time.
    fn sync(&mut self) {
        let _ = self.file.sync_data();
        self.synced = Instant::now();
    }

    /// Puts another in its place once the run, or its shard, is finished: with the same lines in one order,
    /// however they came about. That of a shard says that it is done.
    ///
    /// # Errors
    /// When it cannot be written. This one stays then.
    pub fn finish(
        self,
        header: &Header,
        plan: &Plan,
        findings: &Findings,
    ) -> Result<(), EngineError> {
        write_in_order(&self.path, header, plan, findings, Stage::Finished).map(|_| ())
    }

    fn append(&mut self, line: &[u8]) -> Result<(), EngineError> {
        let failed = |error| EngineError::Journal { path: self.path.clone(), error };
        self.file.write_all(line).map_err(failed)
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        self.sync();
    }
}

/// How far a run has come.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Begun,
    Finished,
}

/// Writes a journal whole, line by line, with what was found of the pairs that its header has.
fn write_in_order(
    path: &Path,
    header: &Header,
    plan: &Plan,
    findings: &Findings,
    stage: Stage,
) -> Result<Lines, EngineError> {
    let shares = header.shares();
    let has = |entry: &Entry<'_>| match entry {
        // A source that goes on behind its last pair is an error of no pair.
        Entry::Pair(pair) => {
            let share = shares.get(&(pair.named.scene, pair.named.eye));
            share.is_some_and(|share| share.contains(&pair.step))
        }
        _ => true,
    };
    let failed = |error| EngineError::Journal { path: path.to_owned(), error };
    let mut lines = Lines::default();
    let written = write_whole_with(path, |out| {
        out.write_all(&line(header))?;
        let written = findings.record(plan, &mut |entry| {
            let written = if has(&entry) { out.write_all(&lines.of(entry)) } else { Ok(()) };
            written.map_err(|error| EngineError::Journal { path: PathBuf::new(), error })
        });
        written.map_err(|error| match error {
            EngineError::Journal { error, .. } => error,
            other => std::io::Error::other(other),
        })?;
        match (stage, header.shard) {
            (Stage::Finished, Some(_)) => out.write_all(&line(&json!({ "done": true }))),
            _ => Ok(()),
        }
    });
    written.map_err(|error| match error {
        FileError::Write { error, .. } | FileError::Read { error, .. } => failed(error),
        FileError::Format { detail, .. } => failed(std::io::Error::other(detail)),
    })?;
    Ok(lines)
}

/// The lines of a journal without its first, as text.
pub(crate) fn lines_of(plan: &Plan, findings: &Findings) -> String {
    let (mut lines, mut text) = (Lines::default(), Vec::new());
    let written = findings.record(plan, &mut |entry| {
        text.extend(lines.of(entry));
        Ok(())
    });
    if let Err(error) = written {
        unreachable!("writing to memory does not fail: {error}");
    }
    String::from_utf8_lossy(&text).into_owned()
}

/// The lines of a journal, and which keys those before have named.
#[derive(Debug, Default)]
pub(super) struct Lines(Vec<Layout>);

impl Lines {
    /// The line of an entry, behind a line of keys where its values are of others than any before.
    pub(super) fn of(&mut self, entry: Entry<'_>) -> Vec<u8> {
        match entry {
            Entry::Input(Input { path, bytes, sha256 }) => {
                line(&json!({ "input": path, "bytes": bytes, "sha256": sha256 }))
            }
            Entry::Pair(finished) => self.pair(&finished),
            Entry::Before(named, failure) => {
                line(&ErrorRecord { before: true, ..ErrorRecord::of(named, failure) })
            }
            Entry::Problem(named, failure) => line(&ErrorRecord::of(named, failure)),
            Entry::ViewFailed(scene, eye, failure) => {
                let named = Named { scene, method: "", eye };
                line(&ErrorRecord { method: None, ..ErrorRecord::of(named, failure) })
            }
            Entry::Settled(scene, eye, settled, methods) => {
                line(&json!({ "settled": SettledRecord::of(scene, eye, settled, methods) }))
            }
        }
    }

    fn pair(&mut self, finished: &Finished<'_>) -> Vec<u8> {
        let result = match finished.result {
            Ok(result) => result,
            Err(failure) => {
                let step = Some(finished.step);
                return line(&ErrorRecord { step, ..ErrorRecord::of(finished.named, failure) });
            }
        };
        let layout = result.rows.layout();
        let known = self.0.iter().position(|known| known.is(layout));
        let number = known.unwrap_or(self.0.len());
        let mut lines = Vec::new();
        if known.is_none() {
            self.0.push(layout.clone());
            lines = line(&json!({ "keys": KeysRecord::of(number, layout) }));
        }
        lines.extend(line(&FrameRecord::of(finished, result, number)));
        lines
    }
}

fn line(record: &impl Serialize) -> Vec<u8> {
    match serde_json::to_vec(record) {
        Ok(object) => sealed(object),
        Err(error) => unreachable!("names and numbers are JSON: {error}"),
    }
}
