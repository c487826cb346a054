//! The first line of a journal: what a run is of. Two runs that have it in common find the same in the
//! same files.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use fovqa_frame::source::Source;
use fovqa_io::{id_of, open_regular_file};
use fovqa_plan::{Experiment, Eye, Plan};
use fovqa_vision::BandEdges;
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::JOURNAL;
use crate::found::{FoundInputs, FoundView};
use crate::scoring::scene_bands;
use crate::share::{Shard, shares};

/// Name and version of the format.
const SCHEMA: &str = "fovqa.journal/2";

/// What a run is of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    // In front, where folders are told by it.
    schema: String,
    pub(crate) version: String,
    pub(crate) experiment_sha256: String,
    /// The file's name.
    pub(crate) experiment_file: String,
    pub(crate) experiment_text: String,
    /// Only these of each scene's frames.
    pub(crate) frames: Option<String>,
    /// The folder of maps, where some are made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) maps: Option<String>,
    /// `None`: all of it.
    pub(crate) shard: Option<Shard>,
    pub(crate) views: Vec<ViewFiles>,
}

/// The files of a view.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct ViewFiles {
    pub(crate) scene: String,
    pub(crate) eye: Option<Eye>,
    /// How many pairs are to be scored.
    pub(crate) pairs: usize,
    /// SHA-256 of which files are paired with which, and of bands that other files decide.
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

/// The files of an eye's view of a scene; `None` where none were found.
pub(crate) fn view_files(
    plan: &Plan,
    found: &FoundInputs,
    scene: usize,
    eye: usize,
) -> Option<ViewFiles> {
    let view = found.views.iter().find(|view| (view.scene, view.eye) == (scene, eye))?;
    Some(ViewFiles::of(plan, found, view))
}

impl Header {
    /// That of a run of an experiment, whose frames were found, or of a shard of it.
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
            frames: plan.frames.map(|frames| frames.to_string()),
            maps: None,
            shard,
            views: views.collect(),
        }
    }

    /// The same of a run that writes maps into a folder.
    #[must_use]
    pub fn with_maps(self, maps: Option<&Path>) -> Self {
        Self { maps: maps.map(|folder| folder.to_string_lossy().into_owned()), ..self }
    }

    /// What the run, or its shard, has of each view.
    pub(super) fn shares(&self) -> BTreeMap<(&str, Option<Eye>), Range<usize>> {
        let pairs: Vec<usize> = self.views.iter().map(|view| view.pairs).collect();
        let views = self.views.iter().map(|view| (view.scene.as_str(), view.eye));
        views.zip(shares(self.shard, &pairs)).collect()
    }

    /// The name of the experiment's file.
    pub fn experiment_file(&self) -> &str {
        &self.experiment_file
    }

    /// The text of the experiment.
    pub fn experiment_text(&self) -> &str {
        &self.experiment_text
    }

    /// Which frames of each scene, as on the command line.
    pub fn frames(&self) -> Option<&str> {
        self.frames.as_deref()
    }

    /// That of the whole run of which this is of a shard, with these maps.
    #[must_use]
    pub(crate) fn of_all(&self, maps: Option<String>) -> Self {
        Self { shard: None, maps, ..self.clone() }
    }

    /// A line of a journal as its first; `None` where it is something else.
    pub(super) fn parse(line: &[u8]) -> Option<Self> {
        let header: Self = serde_json::from_slice(line).ok()?;
        let whole = sha256(header.experiment_text.as_bytes()) == header.experiment_sha256;
        (header.schema == SCHEMA && whole).then_some(header)
    }

    /// The format of a line that is the first of a journal of another version.
    pub(super) fn other_format(line: &[u8]) -> Option<String> {
        let header: serde_json::Value = serde_json::from_slice(line).ok()?;
        let schema = header.get("schema")?.as_str()?;
        (schema.starts_with("fovqa.journal/") && schema != SCHEMA).then(|| schema.to_owned())
    }
}

/// The shard that a folder holds.
pub fn shard_in(folder: &Path) -> Option<Shard> {
    /// An experiment is no longer than 4 MiB, and its text grows a little in JSON.
    const LONGEST: u64 = 64 << 20;
    let file = open_regular_file(&folder.join(JOURNAL)).ok()?;
    let mut line = Vec::new();
    BufReader::new(file.take(LONGEST)).read_until(b'\n', &mut line).ok()?;
    let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&line);
    Header::parse(line)?.shard
}

fn files(view: &FoundView, bands: Option<&BandEdges>) -> String {
    let sources = &view.sources;
    let label = |source: &dyn Source, at: usize| source.listing().label(at);
    let guide = |source: &Option<Arc<dyn Source>>, at: Option<usize>| {
        source.as_ref().zip(at).map(|(source, at)| label(&**source, at))
    };
    let frames = view.frames.iter().map(|frame| {
        let test =
            |(method, at): &(usize, usize)| json!([method, label(sources.test(*method), *at)]);
        let tests: Vec<_> = frame.tests.iter().map(test).collect();
        let guides = [
            guide(&sources.motion, frame.guides.motion),
            guide(&sources.depth, frame.guides.depth),
        ];
        let reference = label(&*sources.reference, frame.reference);
        json!([frame.number, frame.position, reference, guides, tests])
    });
    let frames: serde_json::Value = frames.collect();
    let bands: Option<Vec<(f64, f64)>> = bands.map(|bands| bands.iter().collect());
    sha256(json!([frames, bands]).to_string().as_bytes())
}

fn sha256(bytes: &[u8]) -> String {
    // Reading from memory does not fail.
    id_of(bytes).map(|id| id.sha256).unwrap_or_default()
}
