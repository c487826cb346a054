//! What a run of `score` found.

use fovqa_metrics::{FrameRows, Metric};
use fovqa_vision::EccentricityKind;
use serde::{Deserialize, Serialize};

/// The view the frames were scored under.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewResult {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// Focal length in pixels, along x and y.
    pub focal_px: [f64; 2],
    /// Gaze in pixels; of the first frame where it moves.
    pub gaze_px: [f64; 2],
    /// `angular` or `planar`.
    pub eccentricity: EccentricityKind,
    /// Edges of the bands, `(from_deg, to_deg)` each.
    pub bands_deg: Vec<(f64, f64)>,
}

/// The scores of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameResult {
    /// Frame number.
    pub frame: i64,
    /// Reference file, `/` between folders.
    pub reference: String,
    /// Test file.
    pub test: String,
    /// Gaze, where it comes from a trace.
    pub gaze_px: Option<[f64; 2]>,
    /// How far the gaze has moved since the frame before, degrees, where it comes from a trace.
    pub gaze_step_deg: Option<f64>,
    /// The values.
    pub rows: FrameRows,
}

/// Whose motion or depth a sequence was compared along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GuideSource {
    /// Nobody's: there is none.
    #[default]
    None,
    /// The reference's, for the test too.
    Reference,
    /// Each its own.
    Test,
}

/// What differences over time were taken along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct AtdGuides {
    /// Motion vectors.
    pub motion: GuideSource,
    /// Depth.
    pub depth: GuideSource,
}

/// How FovVideoVDP sees a sequence, and what came of it as a whole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FvvdpViewing {
    /// Pixels of the display in a degree at its centre.
    pub pixels_per_degree: f64,
    /// White, cd/m².
    pub peak_cd_m2: f64,
    /// Black, cd/m².
    pub black_cd_m2: f64,
    /// Whether sensitivity falls off with eccentricity.
    pub foveated: bool,
    /// Frequencies of its bands at the centre of the display, cycles per degree, the finest first.
    pub frequencies_cpd: Vec<f64>,
    /// Frames a second; `None` for a still.
    pub fps: Option<f64>,
    /// Why the sequence has no value.
    pub missing: Option<String>,
    /// JOD of the left and of the right eye, where this is of both.
    pub eyes_jod: Option<[f64; 2]>,
}

/// A frame that could not be scored, or a whole comparison.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Frame number; `None`: the whole comparison.
    pub frame: Option<i64>,
    /// Reference file, of a frame.
    pub reference: String,
    /// Test file, of a frame.
    pub test: String,
    /// What is wrong, and where.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

/// What one comparison found: a test sequence against its reference.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScoreReport {
    /// The view; `None` when none was given.
    pub view: Option<ViewResult>,
    /// The metrics, in the order of tables.
    pub metrics: Vec<Metric>,
    /// Scored frames, in order.
    pub frames: Vec<FrameResult>,
    /// Frames that could not be scored.
    pub failures: Vec<Failure>,
    /// Frames whose gaze was held over from an earlier one; `None` without a trace.
    pub gaze_held: Option<usize>,
    /// What differences over time were taken along.
    pub atd_guides: AtdGuides,
    /// How FovVideoVDP sees it, where it is asked for.
    pub fvvdp: Option<FvvdpViewing>,
}

impl ScoreReport {
    /// Edges of the bands, degrees; none without a view.
    pub fn edges(&self) -> &[(f64, f64)] {
        self.view.as_ref().map(|view| view.bands_deg.as_slice()).unwrap_or_default()
    }
}

/// A comparison of a run: one method in one scene, for one eye or both.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// `left`, `right` or `both`; empty in a scene with one picture a frame.
    pub eye: &'static str,
    /// What was found.
    pub report: ScoreReport,
}

/// An input of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// The file, from the experiment's folder.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// Its SHA-256, in hexadecimal digits.
    pub sha256: String,
}

/// Everything a run found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunResults {
    /// Scene by scene, within it method by method, within it eye by eye.
    pub comparisons: Vec<Comparison>,
    /// The files that were read, by path, where they were hashed.
    pub inputs: Vec<Input>,
}
