//! Writes a journal.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use fovqa_metrics::Layout;
use fovqa_plan::Plan;
use fovqa_results::{FileError, Input, write_whole_with};
use serde::Serialize;
use serde_json::json;

use super::JOURNAL;
use super::header::Header;
use super::order::Order;
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
    order: Order,
    /// When the bytes were last flushed to the disk.
    synced: Instant,
}

/// Shortest time between two flushes. Every frame is flushed, but not more often than this. A power
/// failure then loses no more than this interval, and waiting for the disk takes almost no time.
const BETWEEN_SYNCS: Duration = Duration::from_secs(1);

impl Journal {
    /// Starts a journal that replaces an existing one. It writes the header first and then the
    /// findings that are known already. The old journal stays until the new one contains all of
    /// that.
    ///
    /// # Errors
    /// If the file cannot be created.
    pub fn begin(
        folder: &Path,
        header: &Header,
        plan: &Plan,
        known: &Findings,
    ) -> Result<Self, EngineError> {
        let path = folder.join(JOURNAL);
        let failed = |error| EngineError::Journal { path: path.clone(), error };
        let (lines, order) = write_in_order(&path, header, plan, known, Stage::Begun)?;
        let file = File::options().read(true).append(true).open(&path).map_err(failed)?;
        Ok(Self { path, file, lines, order, synced: Instant::now() })
    }

    /// Records an entry.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&mut self, entry: Entry<'_>) -> Result<(), EngineError> {
        let line = self.lines.of(entry);
        self.append(&line)?;
        self.order.add(&entry, line.len());
        if matches!(entry, Entry::Pair(_)) && self.synced.elapsed() >= BETWEEN_SYNCS {
            self.sync();
        }
        Ok(())
    }

    /// Flushes the file to the disk. A failure is ignored, because the data was written and the
    /// system flushes it later.
    fn sync(&mut self) {
        let _ = self.file.sync_data();
        self.synced = Instant::now();
    }

    /// Replaces this journal when the run, or its shard, is finished. The new one contains the same
    /// lines in a fixed order, however they were produced. The journal of a shard is marked as
    /// finished.
    ///
    /// # Errors
    /// If it cannot be written. The present journal then stays.
    pub fn finish(
        self,
        header: &Header,
        plan: &Plan,
        findings: &Findings,
    ) -> Result<(), EngineError> {
        let Some(ranges) = self.order.ranges_of(own_pairs(header, plan, findings)) else {
            return write_in_order(&self.path, header, plan, findings, Stage::Finished).map(|_| ());
        };
        // The lines are in order already: copying them is faster than making them again.
        replace(&self.path, header, Stage::Finished, |out| {
            let mut lines = Lines::default();
            findings.record_inputs(plan, &mut |entry| to(out, &lines.of(entry)))?;
            copy(&self.file, ranges, out).map_err(write_error)
        })
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

/// How far a run has progressed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Begun,
    Finished,
}

/// Writes a whole journal, line by line, with the findings about the pairs in its header.
fn write_in_order(
    path: &Path,
    header: &Header,
    plan: &Plan,
    findings: &Findings,
    stage: Stage,
) -> Result<(Lines, Order), EngineError> {
    let steps = header.steps();
    // The step after the last pair of a view is that of a source that continues, which is an error.
    let is_end = |scene: &str, eye, step| {
        header.views.iter().any(|v| v.scene == scene && v.eye == eye && v.pairs == step)
    };
    let has = |entry: &Entry<'_>| match entry {
        Entry::Pair(pair) => {
            let (scene, eye) = (pair.named.scene, pair.named.eye);
            let is_own = steps.get(&(scene, eye)).is_some_and(|steps| steps.contains(&pair.step));
            is_own && (pair.result.is_err() || !is_end(scene, eye, pair.step))
        }
        _ => true,
    };
    let (mut lines, mut order) = (Lines::default(), Order::new(plan, line(header).len()));
    replace(path, header, stage, |out| {
        findings.record(plan, &mut |entry| {
            if !has(&entry) {
                return Ok(());
            }
            let line = lines.of(entry);
            order.add(&entry, line.len());
            to(out, &line)
        })
    })?;
    Ok((lines, order))
}

/// How many pairs were found of those that a header has.
fn own_pairs(header: &Header, plan: &Plan, findings: &Findings) -> usize {
    let steps = header.steps();
    let views = findings.views.iter().filter_map(|(&(scene, eye), view)| {
        let scene = &plan.scenes[scene];
        let steps = steps.get(&(scene.name.as_str(), scene.eyes[eye].eye))?;
        Some(view.pairs.range(steps.clone()).count())
    });
    views.sum()
}

/// Puts a journal in the place of another: its first line, then what `write` writes.
fn replace(
    path: &Path,
    header: &Header,
    stage: Stage,
    write: impl FnOnce(&mut dyn Write) -> Result<(), EngineError>,
) -> Result<(), EngineError> {
    let written = write_whole_with(path, |out| {
        out.write_all(&line(header))?;
        write(out).map_err(|error| match error {
            EngineError::Journal { error, .. } => error,
            other => io::Error::other(other),
        })?;
        match (stage, header.shard) {
            (Stage::Finished, Some(_)) => out.write_all(&line(&json!({ "done": true }))),
            _ => Ok(()),
        }
    });
    let failed = |error| EngineError::Journal { path: path.to_owned(), error };
    written.map_err(|error| match error {
        FileError::Write { error, .. } | FileError::Read { error, .. } => failed(error),
        FileError::Format { detail, .. } => failed(io::Error::other(detail)),
    })
}

fn to(out: &mut dyn Write, line: &[u8]) -> Result<(), EngineError> {
    out.write_all(line).map_err(write_error)
}

/// The error of a journal, without its path, which the caller knows.
fn write_error(error: io::Error) -> EngineError {
    EngineError::Journal { path: PathBuf::new(), error }
}

/// Copies parts of a file, which come in order. Only few bytes lie between them, so the file is read in large
/// pieces.
fn copy(file: &File, ranges: &[Range<u64>], out: &mut dyn Write) -> io::Result<()> {
    const PIECE: usize = 64 << 10;
    let mut file = BufReader::with_capacity(PIECE, file);
    let mut at = file.seek(SeekFrom::Start(0))?;
    for range in ranges {
        file.seek_relative(range.start as i64 - at as i64)?;
        at = range.start;
        while at < range.end {
            let piece = file.fill_buf()?;
            let length = piece.len().min((range.end - at) as usize);
            if length == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            out.write_all(&piece[..length])?;
            file.consume(length);
            at += length as u64;
        }
    }
    Ok(())
}

/// The lines of a journal after the first, as text.
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

/// Writes the lines of a journal and remembers which keys were written already.
#[derive(Debug, Default)]
pub(super) struct Lines(Vec<Layout>);

impl Lines {
    /// The line of an entry. A line of keys comes before it if no earlier line has the keys of its
    /// values.
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
