//! The JSON of a plan.

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
    /// The result of a kind of plan.
    pub(super) fn new(plan: &'static str, result: T) -> Self {
        Self { schema: SCHEMA, analysis: "plan", plan, excluded: [], result }
    }
}
