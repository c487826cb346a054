//! Planning of studies: the trials that pairwise comparisons need, and the precision of staircases.

mod pairs;
mod staircase;

pub use self::pairs::{PairsOptions, PairsPlan, plan_pairs};
pub use self::staircase::{First, StaircaseOptions, StaircasePlan, plan_staircase};

use serde::Serialize;

use crate::json::SCHEMA;

/// The result of a plan. It has no groups: its values stand at the top.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan<T> {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// `plan`.
    pub analysis: &'static str,
    /// What is planned: `pairs` or `staircase`.
    pub plan: &'static str,
    /// No participant can be left out of a plan.
    pub excluded: [String; 0],
    /// The results.
    #[serde(flatten)]
    pub result: T,
}

impl<T> Plan<T> {
    fn new(plan: &'static str, result: T) -> Self {
        Self { schema: SCHEMA, analysis: "plan", plan, excluded: [], result }
    }
}
