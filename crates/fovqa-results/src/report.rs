//! The results of `score` and of a run.

use std::collections::BTreeMap;
use std::sync::Arc;

use fovqa_metrics::{FrameRows, Metric};
use fovqa_vision::EccentricityKind;
use serde::{Deserialize, Serialize};

use crate::inputs::Inputs;

/// The view under which the frames were scored.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewResult {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Focal length in pixels, along x and y.
    pub focal_px: [f64; 2],
    /// Gaze in pixels. If the gaze moves, this is the gaze of the first frame.
    pub gaze_px: [f64; 2],
    /// `angular` or `planar`.
    pub eccentricity: EccentricityKind,
    /// Edges of the bands in degrees, as `(from_deg, to_deg)`.
    pub bands_deg: Vec<(f64, f64)>,
}

/// The scores of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameResult {
    /// Frame number.
    pub frame: i64,
    /// Reference file, with `/` between folders.
    pub reference: Arc<str>,
    /// Test file.
    pub test: Arc<str>,
    /// Gaze in pixels, if it comes from a trace.
    pub gaze_px: Option<[f64; 2]>,
    /// How far the gaze has moved since the previous frame, in degrees, if it comes from a trace.
    pub gaze_step_deg: Option<f64>,
    /// Why the pair may not be what was to be compared.
    pub doubts: Vec<Doubt>,
    /// The measured values.
    pub rows: FrameRows,
}

/// A likely mistake in a pair that was scored nevertheless.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Doubt {
    /// The check, as `plausibility` names it, such as `exposure`.
    pub check: String,
    /// What was seen, with numbers.
    pub message: String,
}

/// The source of the motion or depth that temporal metrics use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GuideSource {
    /// There is no source.
    #[default]
    None,
    /// The reference, which is also used for the test.
    Reference,
    /// Reference and test each have their own.
    Test,
}

/// The motion and depth that temporal metrics use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct GuideSources {
    /// Source of the motion vectors.
    pub motion: GuideSource,
    /// Source of the depth.
    pub depth: GuideSource,
}

/// The viewing conditions of FovVideoVDP for a sequence, and results for the sequence as a whole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FvvdpViewing {
    /// Pixels per degree at the centre of the display.
    pub pixels_per_degree: f64,
    /// Luminance of white in cd/m².
    pub peak_cd_m2: f64,
    /// Luminance of black in cd/m².
    pub black_cd_m2: f64,
    /// Whether sensitivity decreases with eccentricity.
    pub foveated: bool,
    /// Frequencies of the bands at the centre of the display, in cycles per degree, beginning with
    /// the highest.
    pub frequencies_cpd: Vec<f64>,
    /// Frames per second; `None` for a still image.
    pub fps: Option<f64>,
    /// Why the sequence has no value.
    pub missing: Option<String>,
    /// JOD of the left and of the right eye, if this is the result of both eyes.
    pub eyes_jod: Option<[f64; 2]>,
}

/// A frame that could not be scored, or a whole comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Frame number; `None` if the whole comparison failed.
    pub frame: Option<i64>,
    /// Reference file of the frame.
    pub reference: String,
    /// Test file of the frame.
    pub test: String,
    /// What is wrong, and where.
    pub message: String,
    /// How to correct it.
    pub help: String,
}

/// The results of one comparison: a test sequence against its reference.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScoreReport {
    /// The view; `None` if none was given.
    pub view: Option<ViewResult>,
    /// The metrics, in the order of tables.
    pub metrics: Vec<Metric>,
    /// Scored frames, in order.
    pub frames: Vec<FrameResult>,
    /// Frames that could not be scored.
    pub failures: Vec<Failure>,
    /// Number of frames whose gaze was kept from an earlier frame; `None` without a trace.
    pub gaze_held: Option<usize>,
    /// The motion and depth that temporal metrics use.
    pub guide_sources: GuideSources,
    /// The number of frames that each temporal metric compares, the present one included.
    pub frames_needed: BTreeMap<Metric, usize>,
    /// The viewing conditions of FovVideoVDP, if the metric is requested.
    pub fvvdp: Option<FvvdpViewing>,
}

impl ScoreReport {
    /// The number of frames that a temporal metric compares, the present one included.
    pub fn frames_needed(&self, metric: Metric) -> usize {
        self.frames_needed.get(&metric).copied().unwrap_or(2)
    }

    /// Edges of the bands in degrees; empty without a view.
    pub fn edges(&self) -> &[(f64, f64)] {
        self.view.as_ref().map(|view| view.bands_deg.as_slice()).unwrap_or_default()
    }
}

/// A comparison of a run: one method in one scene, for one eye or both.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The scene.
    pub scene: String,
    /// The method; of a swept one, its name with the parameters of the point.
    pub method: String,
    /// The point of a sweep.
    pub swept: Option<Swept>,
    /// `left`, `right` or `both`; empty if the scene has one image per frame.
    pub eye: &'static str,
    /// The results.
    pub report: ScoreReport,
}

/// A point of a sweep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Swept {
    /// The method that is swept.
    pub method: String,
    /// The swept parameters with their values: `fx=0.1;fy=0.2`.
    pub parameters: String,
}

impl Comparison {
    /// The method as the experiment names it, and the parameters of a point of a sweep, as results
    /// write them.
    pub(crate) fn written(&self) -> (&str, &str) {
        match &self.swept {
            None => (&self.method, ""),
            Some(Swept { method, parameters }) => (method, parameters),
        }
    }
}

/// All results of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunResults {
    /// The comparisons, ordered by scene, then by method, then by eye.
    pub comparisons: Vec<Comparison>,
    /// The files that were read, if they were hashed.
    pub inputs: Inputs,
}
