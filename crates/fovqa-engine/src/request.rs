//! What `score` is asked to do.

use std::path::PathBuf;

use fovqa_frame::{Crop, SignalParams};
use fovqa_io::ReadOptions;
use fovqa_io::sequence::FrameRange;
use fovqa_metrics::{Metric, Params};
use fovqa_vision::{BandEdges, EccentricityKind, ViewSpec};

/// Where the eye looks.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Gaze {
    /// At the principal point.
    #[default]
    Centre,
    /// At a point in pixels.
    Point([f64; 2]),
    /// Along a trace.
    Trace {
        /// The CSV file.
        path: PathBuf,
        /// Whether frames beyond the trace keep its last gaze.
        hold: bool,
    },
}

/// What to do about NaN and infinity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Nonfinite {
    /// An error that names the first.
    #[default]
    Error,
    /// Leave the pixels out, in both pictures.
    Mask,
}

/// Which metrics.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum MetricChoice {
    /// [`Metric::DEFAULT`], less what does not fit.
    #[default]
    Default,
    /// These; one that does not fit is an error.
    Named(Vec<Metric>),
}

/// One reference against one test, frame by frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ScoreRequest {
    /// File, folder, glob or printf pattern of the reference.
    pub reference: PathBuf,
    /// The same of the test.
    pub test: PathBuf,
    /// Whether frames without a partner are passed over.
    pub allow_missing: bool,
    /// Which frames.
    pub frames: Option<FrameRange>,
    /// How files are read.
    pub read: ReadOptions,
    /// The visible part of each frame.
    pub crop: Option<Crop>,
    /// A picture that is white where pixels count.
    pub mask: Option<PathBuf>,
    /// How samples become the signal.
    pub signal: SignalParams,
    /// What to do about NaN and infinity.
    pub nonfinite: Nonfinite,
    /// The view.
    pub view: Option<ViewSpec>,
    /// The gaze.
    pub gaze: Gaze,
    /// How eccentricity is measured.
    pub eccentricity: EccentricityKind,
    /// The bands; `None`: the default ones.
    pub bands: Option<BandEdges>,
    /// Frames a second.
    pub fps: Option<f64>,
    /// The metrics.
    pub metrics: MetricChoice,
    /// Their parameters.
    pub params: Params,
}
