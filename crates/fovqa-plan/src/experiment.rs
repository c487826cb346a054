//! An experiment: a plan, and the output that is made from its results.

use std::path::PathBuf;

use fovqa_metrics::Metric;

use crate::figures::FigureSettings;
use crate::gates::GateRule;
use crate::output::OutputSettings;
use crate::plan::Plan;
use crate::plots::Plot;
use crate::report::{ReportSettings, WantedPictures};
use crate::study::OpinionScores;

/// The content of an experiment file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Experiment {
    /// Name of the experiment.
    pub name: String,
    /// Description of what it shows.
    pub about: Option<String>,
    /// Path of its file.
    pub path: PathBuf,
    /// Text of the file.
    pub text: String,
    /// The plan: what is scored.
    pub plan: Plan,
    /// How the results are written.
    pub output: OutputSettings,
    /// The metrics in the order of the file; empty if the file names none.
    pub metric_order: Vec<Metric>,
    /// Tables and figures; if empty, all that fit are made.
    pub plots: Vec<Plot>,
    /// How figures are printed if the file requests none.
    pub figures: FigureSettings,
    /// What the report shows of the frames.
    pub report: ReportSettings,
    /// Mean opinion scores that its metrics are compared with.
    pub study: Option<OpinionScores>,
    /// The rules of its gate.
    pub gates: Vec<GateRule>,
    /// The baselines of its gate, of which the best match counts.
    pub baselines: Vec<PathBuf>,
}

impl Experiment {
    /// The pictures that may be needed, as far as that is known before anything is scored. Of a swept
    /// method, the report shows the best point alone.
    pub fn wanted_pictures(&self) -> WantedPictures {
        let plan = &self.plan;
        let is_swept = |method: &usize| plan.swept(*method).is_some();
        WantedPictures {
            frames: self.report.frames.clone(),
            methods: (0..plan.methods.len()).filter(|method| !is_swept(method)).collect(),
        }
    }
}
