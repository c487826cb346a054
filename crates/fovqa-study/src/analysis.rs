//! The result of any analysis.

use serde::Serialize;

use crate::anova::Anova;
use crate::json::Document;
use crate::metrics::Metrics;
use crate::pairs::Pairs;
use crate::plan::{PairsPlan, Plan, StaircasePlan};
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
    /// A plan of staircases.
    PlanStaircase(Plan<StaircasePlan>),
}
