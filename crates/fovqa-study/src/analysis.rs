//! The result of any analysis.

use serde::Serialize;

use crate::anova::Anova;
use crate::json::Document;
use crate::pairs::Pairs;
use crate::ranks::Ranks;

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
}
