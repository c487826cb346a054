//! What was found for a plan before any pixel is read: frames, gaze, and inputs that cannot be
//! scored.

use fovqa_metrics::{LeadIn, Needs};
use fovqa_plan::{EyeView, Plan, Scene};
use fovqa_vision::GazeAt;

use crate::error::EngineError;
use crate::found_frame::FoundFrame;
use crate::view_sources::ViewSources;

/// The frames of a plan, and what is wrong with its inputs.
#[derive(Debug)]
pub struct FoundInputs {
    /// One entry per scene and eye, in the order of the plan.
    pub views: Vec<FoundView>,
    /// Inputs that cannot be scored.
    pub problems: Vec<Problem>,
}

impl FoundInputs {
    /// Whether scoring a frame reads frames before it: for a temporal metric, or to emulate a method.
    pub fn reads_frames_before(&self, plan: &Plan) -> bool {
        let emulations = self.views.iter().flat_map(|view| view.sources.emulations());
        let mut emulations = emulations.map(|(_, emulation)| emulation);
        Needs::of(plan.metrics.metrics()).lead_in > LeadIn::None
            || emulations.any(|of| of.is_temporal() || of.reproject().is_some())
    }
}

/// The frames of one eye's view of a scene.
#[derive(Debug)]
pub struct FoundView {
    /// Index of the scene.
    pub scene: usize,
    /// Index of the eye's view in it.
    pub eye: usize,
    /// Where the frames come from.
    pub sources: ViewSources,
    /// The frames, in order.
    pub frames: Vec<FoundFrame>,
    /// Frames per second: the rate of the scene, otherwise the rate that the reference or a test
    /// declares.
    pub fps: Option<f64>,
    /// The gaze for each frame, if it comes from a trace.
    pub trace: Option<Vec<GazeAt>>,
    /// Number of files without a partner, which the plan says to ignore.
    pub passed_over: usize,
    /// Remarks for the user about the frames that were found. Each is one sentence.
    pub remarks: Vec<String>,
}

impl FoundView {
    /// Width and height of its frames; `None` if they can be found out only when a frame is read.
    pub fn frame_size(&self, eye: &EyeView) -> Option<[usize; 2]> {
        frame_size(eye, &self.sources, &self.frames)
    }

    /// Number of tests to score.
    pub fn pairs(&self) -> usize {
        self.frames.iter().map(|frame| frame.tests.len()).sum()
    }
}

/// Width and height of the frames of a view; `None` if they can be found out only when a frame is read.
pub(crate) fn frame_size(
    eye: &EyeView,
    sources: &ViewSources,
    frames: &[FoundFrame],
) -> Option<[usize; 2]> {
    if let Some(crop) = eye.settings.crop {
        return Some([crop.width, crop.height]);
    }
    Some(sources.reference.size(frames.first()?.reference).ok()?.into())
}

/// An input that cannot be scored.
#[derive(Debug)]
pub struct Problem {
    /// Index of the scene.
    pub scene: usize,
    /// Index of the eye's view in it.
    pub eye: usize,
    /// Index of the method; `None` for all methods.
    pub method: Option<usize>,
    /// What is wrong.
    pub error: EngineError,
}

/// Whether both the plan and the scene ask for a frame.
pub(crate) fn is_wanted(plan: &Plan, scene: &Scene, number: i64) -> bool {
    [scene.frames, plan.frames].into_iter().flatten().all(|range| range.contains(number))
}
