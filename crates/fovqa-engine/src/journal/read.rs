//! Reads a journal.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use fovqa_io::open_regular_file;
use fovqa_metrics::{Layout, Layouts};
use fovqa_plan::{Eye, Plan};
use fovqa_results::{Identity, Input};
use serde::Deserialize;
use serde_json::Value;

use super::JOURNAL;
use super::header::{Header, place, with_end};
use super::records::{ErrorRecord, FrameRecord, KeysRecord, SettledRecord};
use super::seal::{Seal, seal_of};
use crate::findings::{Findings, Outcome, ViewFindings, ViewIndex};
use crate::share::shares;

/// What a folder contains in place of a journal.
pub(crate) enum Content {
    /// There is no journal.
    Nothing,
    /// The file is not a journal.
    Other,
    /// The journal has another version of the format, with this name.
    OtherFormat(String),
    /// A journal of this format.
    Journal(Box<Text>),
}

/// A journal of which only the first line was read. The other lines are read one by one when they are
/// interpreted: a long run has very many.
pub(crate) struct Text {
    pub(crate) header: Header,
    /// For each view of the header, the range of pairs that the journal has or should have.
    pub(crate) shares: Vec<Range<usize>>,
    /// Whether the first line was changed after it was written.
    is_changed: bool,
    path: PathBuf,
    /// Where the second line begins.
    rest: u64,
}

/// The content of a journal.
pub(crate) struct Said {
    pub(crate) findings: Findings,
    /// Whether the last line marks the journal as finished.
    pub(crate) done: bool,
    /// Whether a line could not be interpreted. Later lines are ignored.
    pub(crate) torn: bool,
    /// An input that was recorded with two different hashes.
    pub(crate) twice: Option<String>,
    /// Number of a line, counted from 1, that was changed after it was written. Later lines are
    /// ignored.
    pub(crate) changed: Option<usize>,
}

/// Maximum length of a line in bytes, longer than the text of any experiment or the values of any frame.
const LONGEST_LINE: u64 = 1 << 30;
/// The bytes that are read from a journal at a time.
const PIECE: usize = 64 << 10;
/// What an editor writes at the start of a file.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads the first line of the journal in a folder.
///
/// # Errors
/// If the operating system refuses.
pub(crate) fn read(folder: &Path) -> io::Result<Content> {
    let path = folder.join(JOURNAL);
    let file = match open_regular_file(&path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Content::Nothing),
        Err(error) => return Err(error),
    };
    let mut line = Vec::new();
    next_line(&mut BufReader::with_capacity(PIECE, file), &mut line)?;
    let rest = line.len() as u64;
    let line = line.strip_prefix(MARK).unwrap_or(&line);
    // The run was killed, or had no disk space, before it had written anything.
    if line.is_empty() {
        return Ok(Content::Nothing);
    }
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    let Some(header) = Header::parse(line) else {
        let other = Header::other_format(line);
        return Ok(other.map_or(Content::Other, Content::OtherFormat));
    };
    let pairs: Vec<usize> = header.views.iter().map(|view| view.pairs).collect();
    let shares = shares(header.shard, &pairs);
    let is_changed = seal_of(line) != Seal::Whole;
    Ok(Content::Journal(Box::new(Text { header, shares, is_changed, path, rest })))
}

/// Reads a line with its end in place of the last one. The last line of a file is empty.
fn next_line(file: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<()> {
    line.clear();
    file.take(LONGEST_LINE).read_until(b'\n', line)?;
    Ok(())
}

impl Text {
    /// Interprets the journal with `plan`, which must be the plan of its experiment.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub(crate) fn said(&self, plan: &Plan, shared: &mut Shared) -> io::Result<Said> {
        // A line about a view that is not in this journal, or about a pair outside its range, is
        // not accepted.
        let own = |(scene, eye): ViewIndex, step: Option<LineStep>| {
            let (scene, eye) = (&plan.scenes[scene].name, plan.scenes[scene].eyes[eye].eye);
            let mut views = self.header.views.iter();
            let index = views.position(|view| view.scene == *scene && view.eye == eye);
            index.is_some_and(|index| {
                let (share, pairs) = (&self.shares[index], self.header.views[index].pairs);
                step.is_none_or(|step| step.is_in(share, pairs))
            })
        };
        let mut file: File = open_regular_file(&self.path)?;
        file.seek(SeekFrom::Start(self.rest))?;
        let lines = BufReader::with_capacity(PIECE, file);
        let mut said = Lines { plan, own: &own }.said(lines, shared)?;
        // The header is line 1, so the other numbers move by one.
        said.changed = if self.is_changed { Some(1) } else { said.changed.map(|line| line + 1) };
        Ok(said)
    }
}

/// The findings in some lines, restricted to what `own` accepts; `None` if a line cannot be
/// interpreted.
pub(crate) fn findings_of(plan: &Plan, lines: &str, own: &Own<'_>) -> Option<Findings> {
    // Reading from memory does not fail.
    let said = Lines { plan, own }.said(lines.as_bytes(), &mut Shared::default()).ok()?;
    let whole = !said.torn && said.twice.is_none() && said.changed.is_none();
    whole.then_some(said.findings)
}

/// Whether a view, and optionally a pair in it, is allowed in the journal.
pub(crate) type Own<'a> = dyn Fn(ViewIndex, Option<LineStep>) -> bool + 'a;

/// The step of a line.
#[derive(Debug, Clone, Copy)]
pub(crate) enum LineStep {
    /// A pair that was scored.
    Scored(usize),
    /// A pair that could not be scored, or the end of the pairs.
    Failed(usize),
}

impl LineStep {
    /// Whether the step belongs to a range of the pairs of a view, which has so many pairs.
    pub(crate) fn is_in(self, share: &Range<usize>, pairs: usize) -> bool {
        match self {
            Self::Scored(step) => share.contains(&step),
            Self::Failed(step) => with_end(share.clone(), pairs).contains(&step),
        }
    }
}

/// What the frames of all journals share that are read one after another: their lists of keys, and the
/// temporary file for their values.
#[derive(Default)]
pub(crate) struct Shared {
    layouts: Vec<Layout>,
    pub(crate) values: Layouts,
}

impl Shared {
    fn layout(&mut self, layout: Layout) -> Layout {
        if let Some(known) = self.layouts.iter().find(|known| known.is(&layout)) {
            return known.clone();
        }
        self.layouts.push(layout.clone());
        layout
    }
}

/// What is needed to interpret lines.
struct Lines<'a> {
    plan: &'a Plan,
    own: &'a Own<'a>,
}

impl Lines<'_> {
    fn said(&self, mut lines: impl BufRead, shared: &mut Shared) -> io::Result<Said> {
        let findings = Findings::default();
        let mut said = Said { findings, done: false, torn: false, twice: None, changed: None };
        let mut layouts = BTreeMap::new();
        let (mut line, mut number) = (Vec::new(), 0);
        loop {
            next_line(&mut lines, &mut line)?;
            if line.is_empty() {
                break;
            }
            number += 1;
            let seal = seal_of(&line);
            if seal == Seal::Broken {
                (said.changed, said.done) = (Some(number), false);
                break;
            }
            let whole = line.last() == Some(&b'\n') && seal == Seal::Whole;
            // No line may follow the last one.
            if said.done || !whole || self.line(&line, &mut said, &mut layouts, shared).is_none() {
                (said.torn, said.done) = (true, false);
                break;
            }
        }
        Ok(said)
    }

    /// Interprets a line; `None` if that is not possible.
    fn line(
        &self,
        line: &[u8],
        said: &mut Said,
        layouts: &mut BTreeMap<usize, Layout>,
        shared: &mut Shared,
    ) -> Option<()> {
        let plan = self.plan;
        let value: Value = serde_json::from_slice(line).ok()?;
        let has = |key: &str| value.get(key).is_some();
        let findings = &mut said.findings;
        if has("input") {
            let Input { path, bytes, sha256 } = input(&value)?;
            let id = Identity::new(bytes, &sha256);
            if findings.inputs.get(&path).is_some_and(|known| *known != id) {
                said.twice.get_or_insert_with(|| path.clone());
            }
            findings.inputs.add(path.into(), id);
        } else if has("values") {
            let record: FrameRecord = from(value)?;
            let method = method(plan, &record.method)?;
            let (scene, eye, step) = (record.scene.clone(), record.eye, record.step);
            let step_of = Some(LineStep::Scored(step));
            let name = |name: String| findings.inputs.shared(&name).unwrap_or_else(|| name.into());
            let (frame, guides) = record.read(layouts, &mut shared.values, name)?;
            let view = self.view(findings, &scene, eye, step_of)?;
            view.pairs.insert(step, Box::new(Outcome { method, result: Ok(frame), guides }));
        } else if let Some(keys) = value.get("keys") {
            let record: KeysRecord = from(keys.clone())?;
            layouts.insert(record.number, shared.layout(record.read()?));
        } else if has("error") {
            self.error(findings, from(value)?)?;
        } else if has("settled") {
            let record: SettledRecord = from(value.get("settled")?.clone())?;
            let view = self.view(findings, &record.scene, record.eye, None)?;
            view.settled = Some(record.read(|name| method(plan, name))?);
        } else {
            said.done = value.get("done")?.as_bool()?;
        }
        Some(())
    }

    fn error(&self, findings: &mut Findings, record: ErrorRecord) -> Option<()> {
        let plan = self.plan;
        let Some(name) = &record.method else {
            let view = self.view(findings, &record.scene, record.eye, None)?;
            view.failed = Some(record.read());
            return Some(());
        };
        let method = method(plan, name)?;
        if let Some(step) = record.step {
            let step_of = Some(LineStep::Failed(step));
            let view = self.view(findings, &record.scene, record.eye, step_of)?;
            let (result, guides) = (Err(record.read()), fovqa_results::GuideSources::default());
            view.pairs.insert(step, Box::new(Outcome { method, result, guides }));
        } else if record.before {
            let view = self.view(findings, &record.scene, record.eye, None)?;
            view.before.push((method, record.read()));
        } else {
            let (scene, eye) = place(plan, &record.scene, record.eye)?;
            findings.problems.push(((scene, method, eye), record.read()));
        }
        Some(())
    }

    /// The findings of a view; `None` if there is no view with that name, or no such pair in it.
    fn view<'a>(
        &self,
        findings: &'a mut Findings,
        scene: &str,
        eye: Option<Eye>,
        step: Option<LineStep>,
    ) -> Option<&'a mut ViewFindings> {
        let place = place(self.plan, scene, eye).filter(|place| (self.own)(*place, step))?;
        Some(findings.views.entry(place).or_default())
    }
}

fn from<T: for<'de> Deserialize<'de>>(value: Value) -> Option<T> {
    serde_json::from_value(value).ok()
}

fn input(value: &Value) -> Option<Input> {
    let text = |key: &str| Some(value.get(key)?.as_str()?.to_owned());
    let bytes = value.get("bytes")?.as_u64()?;
    Some(Input { path: text("input")?, bytes, sha256: text("sha256")? })
}

fn method(plan: &Plan, name: &str) -> Option<usize> {
    plan.methods.iter().position(|method| method == name)
}
