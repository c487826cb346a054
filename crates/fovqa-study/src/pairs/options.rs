//! Options of pairwise comparisons.

use crate::options::Ties;

/// Options of the analysis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// How ties count.
    pub ties: Ties,
    /// The first methods in their order; the others follow by first appearance.
    pub order: Vec<String>,
    /// The method whose score is 0, instead of the mean of all scores.
    pub reference: Option<String>,
    /// Votes that are added to both sides of each pair with votes, for the scores; 0 or more.
    pub pseudo_votes: f64,
}
