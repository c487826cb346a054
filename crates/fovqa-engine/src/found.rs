//! What was found for a plan before any pixel is read: frames, gaze, and inputs that cannot be scored.

use fovqa_plan::{Plan, Scene};
use fovqa_vision::GazeAt;

use crate::error::EngineError;
use crate::found_frame::FoundFrame;
use crate::view_sources::ViewSources;

/// The frames of a plan, and what is wrong with its inputs.
#[derive(Debug)]
pub struct FoundInputs {
    /// One a scene and eye, in the order of the plan.
    pub views: Vec<FoundView>,
    /// Inputs that cannot be scored.
    pub problems: Vec<Problem>,
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
    /// Frames a second: those of the scene, else what the reference or a test says of itself.
    pub fps: Option<f64>,
    /// The gaze of each frame, where it comes from a trace.
    pub trace: Option<Vec<GazeAt>>,
    /// Files without a partner that the plan says to pass over.
    pub passed_over: usize,
    /// What the user should know of the frames that were found: a sentence each.
    pub remarks: Vec<String>,
}

impl FoundView {
    /// How many tests there are to score.
    pub fn pairs(&self) -> usize {
        self.frames.iter().map(|frame| frame.tests.len()).sum()
    }
}

/// An input that cannot be scored.
#[derive(Debug)]
pub struct Problem {
    /// Index of the scene.
    pub scene: usize,
    /// Index of the eye's view in it.
    pub eye: usize,
    /// Index of the method; `None`: all of them.
    pub method: Option<usize>,
    /// What is wrong.
    pub error: EngineError,
}

/// Whether both the plan and the scene ask for a frame.
pub(crate) fn is_wanted(plan: &Plan, scene: &Scene, number: i64) -> bool {
    [scene.frames, plan.frames].into_iter().flatten().all(|range| range.contains(number))
}
