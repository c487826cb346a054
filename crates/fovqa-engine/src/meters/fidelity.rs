//! The single pass over the signals of test and reference that several metrics share.

use fovqa_frame::PairSignal;
use fovqa_metrics::{Image, Metric, ScoreError, Scored, Scorer};
use fovqa_plan::{MetricChoice, Plan};

use super::Pair;
use crate::load::Fault;

/// Scores each pair independently of the others.
pub(super) struct Fidelity {
    scorer: Scorer,
}

impl Fidelity {
    pub(super) fn new(plan: &Plan, metrics: &[Metric]) -> Self {
        let scorer = Scorer::new(metrics.to_vec(), (*plan.params).clone());
        let lenient = plan.metrics == MetricChoice::Default;
        Self { scorer: if lenient { scorer.lenient() } else { scorer } }
    }

    /// Measures a pair.
    pub(super) fn measure(&self, pair: &Pair<'_>) -> Result<Scored, Fault> {
        if pair.maps {
            score(&self.scorer.clone().with_maps(true), pair)
        } else {
            score(&self.scorer, pair)
        }
    }

    /// Whether a pair can be measured.
    pub(super) fn check(&self, pair: &Pair<'_>) -> Result<(), Fault> {
        score(&self.scorer, pair).map(|_| ())
    }
}

fn score(scorer: &Scorer, pair: &Pair<'_>) -> Result<Scored, Fault> {
    let signal = PairSignal::new(&pair.reference.frame, &pair.test.frame, pair.tables);
    let scores = scorer.score(&signal, pair.regions, pair.retina.weight.as_ref());
    scores.map_err(|error| unscored(pair, &error))
}

pub(super) fn unscored(pair: &Pair<'_>, error: &ScoreError) -> Fault {
    let side = match error {
        ScoreError::Unfit { image: Image::Reference, .. } => pair.reference,
        _ => pair.test,
    };
    let help = score_help(error);
    let help = match error {
        // No metric can be scored.
        ScoreError::NothingLeft => help.to_owned(),
        _ => format!("leave the metric out of {{metrics}}, or {help}"),
    };
    Fault { message: format!("{}: {error}", side.file), help }
}

fn score_help(error: &ScoreError) -> &'static str {
    match error {
        ScoreError::TooSmall { .. } => "render larger frames",
        ScoreError::Masked { .. } => "score without a mask",
        ScoreError::NothingLeft | ScoreError::NoWindow { .. } | ScoreError::TooFew { .. } => {
            "check the mask: white pixels are scored"
        }
        ScoreError::NoView { .. } => "give a view",
        ScoreError::Unfit { help, .. } => help,
    }
}
