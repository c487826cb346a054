//! What is to be scored: scenes, methods, metrics, and how each eye sees.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fovqa_io::sequence::{FrameRange, shown};
use fovqa_metrics::{Metric, ParamSet};
use fovqa_params::{Words, words};
use serde::{Deserialize, Serialize};

use crate::settings::Settings;
use crate::source::SourceSpec;

/// Which metrics.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MetricChoice {
    /// [`Metric::DEFAULT`], less what does not fit.
    #[default]
    Default,
    /// These; one that does not fit is an error.
    Named(Vec<Metric>),
}

impl MetricChoice {
    /// The metrics, before any is left out because it does not fit.
    pub fn metrics(&self) -> &[Metric] {
        match self {
            Self::Default => &Metric::DEFAULT,
            Self::Named(named) => named,
        }
    }
}

words! {
    /// One eye of a scene with two.
    pub enum Eye {
        /// The left eye.
        Left "left" "The left eye";
        /// The right eye.
        Right "right" "The right eye";
    }
}

impl Eye {
    /// Both.
    pub const BOTH: [Eye; 2] = [Eye::Left, Eye::Right];

    /// Its name in files: what `{eye}` stands for.
    pub fn name(self) -> &'static str {
        self.word()
    }
}

/// What one eye sees of a scene: one reference, and the test of each method.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EyeView {
    /// The eye; `None` in a scene with one picture a frame.
    pub eye: Option<Eye>,
    /// The reference.
    pub reference: SourceSpec,
    /// Each test, with the index of its method in [`Plan::methods`], which rises.
    pub tests: Vec<(usize, SourceSpec)>,
    /// The colour layer of the tests of a method, by its index, where it is another than that of
    /// `settings.read`.
    pub test_layers: BTreeMap<usize, String>,
    /// How frames are read and seen.
    pub settings: Settings,
}

/// A scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Scene {
    /// Its name; empty where there is but one.
    pub name: String,
    /// Which frames.
    pub frames: Option<FrameRange>,
    /// Whether frames without a partner are passed over.
    pub allow_missing: bool,
    /// Frames a second.
    pub fps: Option<f64>,
    /// One view, or the left and the right eye's.
    pub eyes: Vec<EyeView>,
}

/// A comparison: each method of each scene, measured alike.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Plan {
    /// Folder in which relative paths of the experiment begin; results show paths from there.
    pub base: PathBuf,
    /// The scenes.
    pub scenes: Vec<Scene>,
    /// Names of the methods; one empty name where there is but one.
    pub methods: Vec<String>,
    /// The metrics.
    pub metrics: MetricChoice,
    /// Their parameters.
    pub params: ParamSet,
    /// Only these of each scene's frames.
    pub frames: Option<FrameRange>,
    /// Whether size and hash of every input are taken.
    pub hash_inputs: bool,
    /// Whether maps are made of the metrics that have some.
    pub maps: bool,
}

impl Plan {
    /// A path as results show it: from the experiment's folder where it begins there, else as it
    /// is; `/` between folders, and bytes that are not UTF-8 as `\\xff`.
    pub fn shown(&self, path: &Path) -> String {
        shown(&self.base, path)
    }

    /// A source as results show it.
    pub fn shown_source(&self, source: &SourceSpec) -> String {
        match source {
            SourceSpec::Files(path) => self.shown(path),
            SourceSpec::Given(name) => name.clone(),
        }
    }
}
