//! The results of two eyes.

use crate::report::{Failure, ScoreReport};

/// The results of each eye, and of both together.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StereoReport {
    /// The left eye.
    pub left: ScoreReport,
    /// The right eye.
    pub right: ScoreReport,
    /// Both eyes together, in the frames that both have.
    pub both: ScoreReport,
}

impl StereoReport {
    /// The results with the names that rows of tables have: `left`, `right` and `both`.
    pub fn named(&self) -> [(&'static str, &ScoreReport); 3] {
        [("left", &self.left), ("right", &self.right), ("both", &self.both)]
    }

    /// The frames that could not be scored, with the name of the eye.
    pub fn failures(&self) -> impl Iterator<Item = (&'static str, &Failure)> {
        let eyes = [("left", &self.left), ("right", &self.right)].into_iter();
        eyes.flat_map(|(eye, report)| report.failures.iter().map(move |failure| (eye, failure)))
    }
}
