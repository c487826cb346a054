//! Options of rank tests.

use crate::options::{PairwiseTest, Ties};

/// Options of the analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The columns that make up a unit.
    pub unit: Vec<String>,
    /// The test of each pair of methods.
    pub pairwise: PairwiseTest,
    /// How ties count in pairwise comparisons.
    pub ties: Ties,
    /// The first methods in their order; the others follow by first appearance.
    pub order: Vec<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            unit: vec!["participant".to_owned()],
            pairwise: PairwiseTest::default(),
            ties: Ties::default(),
            order: Vec::new(),
        }
    }
}
