//! The JSON of a study, `fovqa.study/1`.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// The schema's name and version.
pub const SCHEMA: &str = "fovqa.study/1";

/// The result of an analysis, per group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Document<T> {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The name of the analysis.
    pub analysis: &'static str,
    /// Participants who were left out because of their validation trials.
    pub excluded: Vec<String>,
    /// The groups, by first appearance.
    pub groups: Vec<Group<T>>,
}

impl<T> Document<T> {
    /// The document of an analysis, without excluded participants.
    pub fn new(analysis: &'static str, groups: Vec<Group<T>>) -> Self {
        Self { schema: SCHEMA, analysis, excluded: Vec::new(), groups }
    }
}

/// The result of one group of rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Group<T> {
    /// What the rows of the group have in common.
    pub by: By,
    /// The results.
    #[serde(flatten)]
    pub result: T,
}

/// The columns of `--by` and their values in a group, in the order of the option.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct By(pub Vec<(String, String)>);

impl Serialize for By {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (column, value) in &self.0 {
            map.serialize_entry(column, value)?;
        }
        map.end()
    }
}

/// Writes a number of votes as a whole number where it is one. For `#[serde(serialize_with)]`.
///
/// # Errors
///
/// Those of the serializer.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
pub fn votes<S: Serializer>(votes: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if votes.fract() == 0.0 && votes.abs() < 9e15 {
        serializer.serialize_i64(*votes as i64)
    } else {
        serializer.serialize_f64(*votes)
    }
}

/// The number, if it is finite.
pub fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
