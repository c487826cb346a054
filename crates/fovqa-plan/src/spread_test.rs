//! The test of a rule against the spread of repeated runs.

use std::fmt;

use fovqa_params::Words;
use fovqa_statistics::adjust::Adjustment;
use serde::{Deserialize, Serialize};

/// Compares the repeated runs of a build with those of a baseline: a rule fails if its values are worse
/// than can be explained by the spread of the runs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpreadTest {
    /// The probability that the rule fails for an unchanged build, above 0 and at most 0.5.
    pub alpha: f64,
    /// How the probability is corrected for the number of tests of the rule.
    #[serde(default)]
    pub adjust: Adjustment,
}

impl fmt::Display for SpreadTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not worse than the repeated runs of the baseline at alpha {}", self.alpha)?;
        match self.adjust {
            Adjustment::None => Ok(()),
            adjust => write!(f, ", {}", adjust.word()),
        }
    }
}
