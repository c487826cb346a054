//! The first line of a journal, which describes the run. Two runs with the same header find the
//! same results in the same files.

use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader, BufWriter, Read};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use fovqa_frame::source::Source;
use fovqa_io::{IdWriter, id_of, open_regular_file};
use fovqa_plan::{Experiment, Eye, FigureSettings, Plan, Plot, ReportSettings, Resolved};
use fovqa_vision::BandEdges;
use serde::{Deserialize, Serialize, Serializer};

use super::JOURNAL;
use crate::findings::ViewIndex;
use crate::found::{FoundInputs, FoundView};
use crate::scoring::scene_bands;
use crate::share::{Shard, shares};
use crate::unit::Unit;

/// Name and version of the format.
const SCHEMA: &str = "fovqa.journal/2";

/// The description of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    // This field comes first, because folders are recognised by it.
    schema: String,
    pub(crate) version: String,
    pub(crate) experiment_sha256: String,
    /// Name of the experiment file.
    pub(crate) experiment_file: String,
    pub(crate) experiment_text: String,
    /// SHA-256 of what the experiment scores, which is independent of how results are shown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) scored_sha256: Option<String>,
    /// The selected frames of each scene; `None` for all frames.
    pub(crate) frames: Option<String>,
    /// The folder of maps, if maps are written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) maps: Option<String>,
    /// The shard that the run scores; `None` for the whole run.
    pub(crate) shard: Option<Shard>,
    pub(crate) views: Vec<ViewFiles>,
}

/// The files of a view.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct ViewFiles {
    pub(crate) scene: String,
    pub(crate) eye: Option<Eye>,
    /// Number of pairs to be scored.
    pub(crate) pairs: usize,
    /// SHA-256 of the pairing of files, and of bands that depend on other files.
    pub(crate) files: String,
}

impl ViewFiles {
    fn of(plan: &Plan, found: &FoundInputs, view: &FoundView) -> Self {
        let scene = &plan.scenes[view.scene];
        Self {
            scene: scene.name.clone(),
            eye: scene.eyes[view.eye].eye,
            pairs: view.pairs(),
            files: files(view, scene_bands(scene, found, view.scene).as_ref()),
        }
    }
}

/// The plots whose content comes from the frames, without the way they are printed.
fn plots_with_crops(experiment: &Experiment) -> Vec<Plot> {
    let plots = experiment.plots.iter().filter(|plot| !plot.regions.is_empty());
    let of = |plot: &Plot| Plot { regions: plot.regions.clone(), ..Plot::of(plot.kind) };
    plots.map(of).collect()
}

/// The SHA-256 of what an experiment scores: without its plots, figures, opinion scores, rules and description.
fn scored(experiment: &Experiment) -> String {
    let scored = Resolved {
        about: None,
        plots: plots_with_crops(experiment),
        study: None,
        figures: FigureSettings::default(),
        gates: Vec::new(),
        spreadsheet_safe: false,
        report: ReportSettings::default(),
        maps: Vec::new(),
        ..experiment.resolved()
    };
    let text = serde_json::to_string(&scored);
    sha256(text.unwrap_or_else(|_| experiment.text.clone()).as_bytes())
}

/// The steps that belong to a range of the pairs of a view: the pairs and, after the last pair of the view, one
/// step for a source that continues.
pub(super) fn with_end(share: Range<usize>, pairs: usize) -> Range<usize> {
    let has_end = !share.is_empty() && share.end == pairs;
    share.start..share.end + usize::from(has_end)
}

fn units_of(plan: &Plan, ranges: BTreeMap<(&str, Option<Eye>), Range<usize>>) -> Vec<Unit> {
    let units = ranges.into_iter().filter_map(|((scene, eye), pairs)| {
        let (scene, eye) = place(plan, scene, eye).filter(|_| !pairs.is_empty())?;
        Some(Unit { scene, eye, pairs })
    });
    units.collect()
}

/// The files of one eye's view of a scene; `None` if none were found.
pub(crate) fn view_files(
    plan: &Plan,
    found: &FoundInputs,
    scene: usize,
    eye: usize,
) -> Option<ViewFiles> {
    let view = found.views.iter().find(|view| (view.scene, view.eye) == (scene, eye))?;
    Some(ViewFiles::of(plan, found, view))
}

/// The index of the view with this scene name and eye.
pub(crate) fn place(plan: &Plan, scene: &str, eye: Option<Eye>) -> Option<ViewIndex> {
    let index = plan.scenes.iter().position(|of| of.name == scene)?;
    let eye = plan.scenes[index].eyes.iter().position(|view| view.eye == eye)?;
    Some((index, eye))
}

impl Header {
    /// The header of a run of an experiment, or of one of its shards, after its frames were found.
    pub fn new(experiment: &Experiment, found: &FoundInputs, shard: Option<Shard>) -> Self {
        let file = experiment.path.file_name().unwrap_or_default();
        let plan = &experiment.plan;
        let views = found.views.iter().map(|view| ViewFiles::of(plan, found, view));
        Self {
            schema: SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            experiment_sha256: sha256(experiment.text.as_bytes()),
            experiment_file: file.to_string_lossy().into_owned(),
            experiment_text: experiment.text.clone(),
            scored_sha256: Some(scored(experiment)),
            frames: plan.frames.map(|frames| frames.to_string()),
            maps: None,
            shard,
            views: views.collect(),
        }
    }

    /// The header of a run that writes maps into a folder.
    #[must_use]
    pub fn with_maps(self, maps: Option<&Path>) -> Self {
        Self { maps: maps.map(|folder| folder.to_string_lossy().into_owned()), ..self }
    }

    /// The steps of each view that may have a line: the pairs that the run or its shard scores and, if
    /// these are the last ones, the step after them, where a source continues although all pairs are over.
    pub(super) fn steps(&self) -> BTreeMap<(&str, Option<Eye>), Range<usize>> {
        let pairs = self.views.iter().map(|view| view.pairs);
        let shares = self.shares().into_iter();
        let views: BTreeMap<_, usize> =
            self.views.iter().map(|view| (view.scene.as_str(), view.eye)).zip(pairs).collect();
        shares.map(|(view, share)| (view, with_end(share, views[&view]))).collect()
    }

    /// The units of the run or of its shard, of all views that the plan has.
    pub(crate) fn units(&self, plan: &Plan) -> Vec<Unit> {
        units_of(plan, self.shares())
    }

    /// As [`units`](Self::units), with the step after the last pair of a view, where a source continues.
    pub(crate) fn units_with_ends(&self, plan: &Plan) -> Vec<Unit> {
        units_of(plan, self.steps())
    }

    /// The range of pairs of each view that the run or its shard scores.
    fn shares(&self) -> BTreeMap<(&str, Option<Eye>), Range<usize>> {
        let pairs: Vec<usize> = self.views.iter().map(|view| view.pairs).collect();
        let views = self.views.iter().map(|view| (view.scene.as_str(), view.eye));
        views.zip(shares(self.shard, &pairs)).collect()
    }

    /// The name of the experiment file.
    pub fn experiment_file(&self) -> &str {
        &self.experiment_file
    }

    /// The text of the experiment.
    pub fn experiment_text(&self) -> &str {
        &self.experiment_text
    }

    /// The selected frames of each scene, as on the command line.
    pub fn frames(&self) -> Option<&str> {
        self.frames.as_deref()
    }

    /// The header of the whole run that this shard belongs to.
    #[must_use]
    pub(crate) fn of_all(self) -> Self {
        Self { shard: None, ..self }
    }

    /// The header of a shard of this run.
    #[must_use]
    pub fn of_shard(&self, shard: Shard) -> Self {
        Self { shard: Some(shard), ..self.clone() }
    }

    /// Parses the first line of a journal; `None` if it is something else.
    pub(super) fn parse(line: &[u8]) -> Option<Self> {
        let header: Self = serde_json::from_slice(line).ok()?;
        let whole = sha256(header.experiment_text.as_bytes()) == header.experiment_sha256;
        (header.schema == SCHEMA && whole).then_some(header)
    }

    /// The format name in the first line of a journal that has another version.
    pub(super) fn other_format(line: &[u8]) -> Option<String> {
        let header: serde_json::Value = serde_json::from_slice(line).ok()?;
        let schema = header.get("schema")?.as_str()?;
        (schema.starts_with("fovqa.journal/") && schema != SCHEMA).then(|| schema.to_owned())
    }
}

/// The shard whose journal is in a folder.
pub fn shard_in(folder: &Path) -> Option<Shard> {
    /// Longest first line in bytes. An experiment has at most 4 MiB, and its text becomes a little
    /// longer in JSON.
    const LONGEST: u64 = 64 << 20;
    let file = open_regular_file(&folder.join(JOURNAL)).ok()?;
    let mut line = Vec::new();
    BufReader::new(file.take(LONGEST)).read_until(b'\n', &mut line).ok()?;
    let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&line);
    Header::parse(line)?.shard
}

fn files(view: &FoundView, bands: Option<&BandEdges>) -> String {
    let bands: Option<Vec<(f64, f64)>> = bands.map(|bands| bands.iter().collect());
    // Written to the hash frame by frame: as one text, a long sequence would need much memory.
    let mut id = BufWriter::new(IdWriter::default());
    let written = serde_json::to_writer(&mut id, &(PairedFrames(view), bands));
    match written.map_err(io::Error::from).and_then(|()| Ok(id.into_inner()?)) {
        Ok(id) => id.id().sha256,
        Err(error) => unreachable!("names are JSON, and a hash takes all bytes: {error}"),
    }
}

/// The frames of a view with the names of their files, as a list in JSON.
struct PairedFrames<'a>(&'a FoundView);

impl Serialize for PairedFrames<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (sources, frames) = (&self.0.sources, &self.0.frames);
        let label = |source: &dyn Source, at: usize| source.listing().label(at);
        let guide = |source: &Option<Arc<dyn Source>>, at: Option<usize>| {
            source.as_ref().zip(at).map(|(source, at)| label(&**source, at))
        };
        serializer.collect_seq(frames.iter().map(|frame| {
            let listing = sources.reference.listing();
            let test = |(method, at): &(usize, usize)| {
                (*method, sources.test(*method).label(listing, *at))
            };
            let tests: Vec<_> = frame.tests.iter().map(test).collect();
            let guides = [
                guide(&sources.motion, frame.guides.motion),
                guide(&sources.depth, frame.guides.depth),
            ];
            let reference = label(&*sources.reference, frame.reference);
            (frame.number, frame.position, reference, guides, tests)
        }))
    }
}

fn sha256(bytes: &[u8]) -> String {
    // Reading from memory does not fail.
    id_of(bytes).map(|id| id.sha256).unwrap_or_default()
}
