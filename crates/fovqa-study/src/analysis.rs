//! The result of any analysis.

use serde::Serialize;

use crate::anova::Anova;
use crate::json::Document;
use crate::metrics::Metrics;
use crate::pairs::Pairs;
use crate::plan::{PairsPlan, Plan, PredictedPlan, StaircasePlan};
use crate::psychometric::Psychometric;
use crate::ranks::Ranks;
use crate::ratings::Ratings;
use crate::staircase::Staircases;

/// The result of an analysis, which serialises to the JSON of its schema.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Analysis {
    /// Pairwise comparisons.
    Pairs(Document<Pairs>),
    /// Rank tests.
    Ranks(Document<Ranks>),
    /// Analysis of variance.
    Anova(Document<Anova>),
    /// Psychometric functions.
    Psychometric(Document<Psychometric>),
    /// Thresholds of staircases.
    Staircase(Document<Staircases>),
    /// Ratings by level, or over a grid.
    Ratings(Document<Ratings>),
    /// Metrics against mean opinion scores.
    Metrics(Document<Metrics>),
    /// A plan of pairwise comparisons.
    PlanPairs(Plan<PairsPlan>),
    /// A plan of the pairwise comparisons of a run's methods.
    PlanPredicted(Plan<PredictedPlan>),
    /// A plan of staircases.
    PlanStaircase(Plan<StaircasePlan>),
}

impl Analysis {
    /// The participants who were left out because of their validation trials.
    pub fn excluded(&self) -> &[String] {
        match self {
            Self::Pairs(document) => &document.excluded,
            Self::Ranks(document) => &document.excluded,
            Self::Anova(document) => &document.excluded,
            Self::Psychometric(document) => &document.excluded,
            Self::Staircase(document) => &document.excluded,
            Self::Ratings(document) => &document.excluded,
            Self::Metrics(document) => &document.excluded,
            Self::PlanPairs(_) | Self::PlanPredicted(_) | Self::PlanStaircase(_) => &[],
        }
    }
}
