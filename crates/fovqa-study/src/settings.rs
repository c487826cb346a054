//! Settings of all analyses.

use crate::adjust::Adjustment;

/// Settings that all analyses share.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Coverage of intervals, from 0 to 1, both excluded.
    pub confidence: f64,
    /// The adjustment for several tests.
    pub adjust: Adjustment,
    /// The number of bootstrap replicates.
    pub bootstrap: usize,
    /// The seed of all random numbers.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { confidence: 0.95, adjust: Adjustment::Holm, bootstrap: 1000, seed: 1 }
    }
}
