//! What a run of `score` found.

use fovqa_metrics::{Metric, PairScores};

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
    pub eccentricity: &'static str,
    /// Edges of the bands, `(from_deg, to_deg)` each.
    pub bands_deg: Vec<(f64, f64)>,
}

/// The scores of one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameResult {
    /// Frame number.
    pub frame: u64,
    /// Reference file, `/` between folders.
    pub reference: String,
    /// Test file.
    pub test: String,
    /// Gaze, where it comes from a trace.
    pub gaze_px: Option<[f64; 2]>,
    /// The scores.
    pub scores: PairScores,
}

/// A frame that could not be scored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// Frame number.
    pub frame: u64,
    /// Reference file.
    pub reference: String,
    /// Test file.
    pub test: String,
    /// What is wrong, and where.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

/// Everything one run found.
#[derive(Debug, Clone, PartialEq)]
pub struct ScoreReport {
    /// Version of fovqa.
    pub version: String,
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
}
