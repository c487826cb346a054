//! What a search for limits is asked for.

use std::path::PathBuf;

use fovqa_engine::Locking;
use fovqa_io::sequence::FrameRange;

/// What a search for limits varies, and where.
#[derive(Debug, Clone)]
pub struct LimitOptions {
    /// The folder for the results. `None` stands for `reports/NAME-limit` in the working directory, where
    /// NAME is the name of the experiment.
    pub output: Option<PathBuf>,
    /// What is varied: `budget`, or a parameter of the methods.
    pub vary: String,
    /// The lowest value; for budgets `None` is the lowest that the method can have, but at least 0.01.
    pub from: Option<f64>,
    /// The highest value; for budgets `None` is the highest that the method can have, but at most 1.
    pub to: Option<f64>,
    /// Number of values that are measured before the search.
    pub steps: usize,
    /// How exactly limits are found, as a share of them.
    pub tolerance: f64,
    /// Only these methods; empty for all that have what is varied.
    pub methods: Vec<String>,
    /// Scores only these frames of each scene.
    pub frames: Option<FrameRange>,
    /// Whether the results folder is locked.
    pub locking: Locking,
}

impl LimitOptions {
    /// What is varied by default.
    pub const BUDGET: &'static str = "budget";
    /// Number of values that are measured by default before the search.
    pub const STEPS: usize = 16;
    /// How exactly limits are found by default.
    pub const TOLERANCE: f64 = 0.001;
}
