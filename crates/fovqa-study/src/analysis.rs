//! The result of any analysis.

use serde::Serialize;

/// The result of an analysis, which serialises to the JSON of its schema.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Analysis {}
