//! What is scored: scenes, methods and metrics, and how each eye sees.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fovqa_io::sequence::{FrameRange, shown};
use fovqa_metrics::{Metric, ParamSet};
use fovqa_params::Words;
use serde::{Deserialize, Serialize};

use crate::crops::CropRegion;
use crate::eye::Eye;
use crate::report::WantedPictures;
use crate::settings::Settings;
use crate::source::SourceSpec;
use crate::sweep::Sweep;

/// The choice of metrics.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MetricChoice {
    /// [`Metric::DEFAULT`], without the metrics that do not fit.
    #[default]
    Default,
    /// The listed metrics. A metric that does not fit is an error.
    Named(Vec<Metric>),
}

impl MetricChoice {
    /// The chosen metrics, before those that do not fit are left out.
    pub fn metrics(&self) -> &[Metric] {
        match self {
            Self::Default => &Metric::DEFAULT,
            Self::Named(named) => named,
        }
    }
}

/// What one eye sees of a scene: one reference, and the test of each method.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct EyeView {
    /// The eye; `None` if the scene has one image per frame.
    pub eye: Option<Eye>,
    /// The reference.
    pub reference: SourceSpec,
    /// The tests, each with the index of its method in [`Plan::methods`], in ascending order.
    pub tests: Vec<(usize, SourceSpec)>,
    /// The colour layer of a method's tests, by the index of the method, if it differs from that of
    /// `settings.read`.
    pub test_layers: BTreeMap<usize, String>,
    /// How frames are read and seen.
    pub settings: Settings,
}

/// A scene with one or two views.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Scene {
    /// Name of the scene; empty if there is only one.
    pub name: String,
    /// The selected frames; `None` for all.
    pub frames: Option<FrameRange>,
    /// Whether frames without a partner are ignored.
    pub allow_missing: bool,
    /// Frames per second.
    pub fps: Option<f64>,
    /// One view, or the views of the left and the right eye.
    pub eyes: Vec<EyeView>,
}

/// A comparison: all methods in all scenes, measured in the same way.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Plan {
    /// The folder in which relative paths of the experiment start. Results show paths relative to
    /// it.
    pub base: PathBuf,
    /// The scenes.
    pub scenes: Vec<Scene>,
    /// Names of the methods; one empty name if there is only one method. Each point of a sweep is a
    /// method of its own.
    pub methods: Vec<String>,
    /// The methods that are swept.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sweeps: Vec<Sweep>,
    /// The metrics.
    pub metrics: MetricChoice,
    /// Parameters of the metrics.
    pub params: ParamSet,
    /// The selected frames of each scene; `None` for all.
    pub frames: Option<FrameRange>,
    /// Whether the size and hash of every input are recorded.
    pub hash_inputs: bool,
    /// Whether to make maps for the metrics that have one.
    pub maps: bool,
    /// Regions of frames that figures show.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub crops: Vec<CropRegion>,
    /// The pairs whose pictures and maps are handed over.
    #[serde(default, skip_serializing_if = "WantedPictures::is_empty")]
    pub pictures: WantedPictures,
}

impl Plan {
    /// A path as results show it: relative to the experiment's folder if it is inside, otherwise
    /// unchanged. Folders are separated by `/`, and bytes that are not UTF-8 are shown as `\\xff`.
    pub fn shown(&self, path: &Path) -> String {
        shown(&self.base, path)
    }

    /// The swept method of which a method is a point, and the parameters of the point; `None` if it is
    /// not swept.
    pub fn swept(&self, method: usize) -> Option<(&str, String)> {
        let sweep = self.sweeps.iter().find(|sweep| sweep.methods().contains(&method))?;
        Some((&sweep.method, sweep.parameters(method - sweep.first)))
    }

    /// A source as results show it.
    pub fn shown_source(&self, source: &SourceSpec) -> String {
        match source {
            SourceSpec::Files(path) => self.shown(path),
            SourceSpec::Given(name) => name.clone(),
            SourceSpec::Builtin(frames) => format!("builtin:{}", frames.spec.scene.word()),
            SourceSpec::Emulated(emulation) => emulation.in_words(),
        }
    }
}
