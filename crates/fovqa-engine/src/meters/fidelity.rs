//! The fused pass over the signals of test and reference.

use fovqa_config::{MetricChoice, Plan};
use fovqa_frame::PairSignal;
use fovqa_metrics::{Metric, ScoreError, Scored, Scorer};

use super::Pair;
use crate::load::Fault;

/// Scores pairs, each by itself.
pub(super) struct Fidelity(Scorer);

impl Fidelity {
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Self {
        let scorer = Scorer::new(metrics.to_vec(), plan.params.clone()).with_maps(plan.maps);
        Self(if plan.metrics == MetricChoice::Default { scorer.lenient() } else { scorer })
    }

    pub(super) fn measure(&self, pair: &Pair<'_>) -> Result<Scored, Fault> {
        let signal = PairSignal::new(&pair.reference.frame, &pair.test.frame, pair.tables);
        let scores = self.0.score(&signal, pair.regions, pair.retina.weight.as_ref());
        scores.map_err(|error| unscored(&pair.test.file, &error))
    }
}

pub(super) fn unscored(file: &str, error: &ScoreError) -> Fault {
    Fault {
        message: format!("{file}: {error}"),
        help: format!("leave it out of {{metrics}}, or {}", score_help(error)),
    }
}

fn score_help(error: &ScoreError) -> &'static str {
    match error {
        ScoreError::TooSmall { .. } => "render larger frames",
        ScoreError::Masked { .. } => "score without a mask",
        ScoreError::NothingLeft | ScoreError::NoWindow { .. } => "check the mask: white is visible",
        ScoreError::NoView { .. } => "give a view",
    }
}
