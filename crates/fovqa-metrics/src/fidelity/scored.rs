//! The result of measuring a pair.

use crate::map::Map;
use crate::row::Rows;

/// The result of measuring a pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Scored {
    /// The values of all metrics.
    pub rows: Rows,
    /// The maps of metrics that have one, if they are asked for.
    pub maps: Vec<Map>,
    /// What the user must know about these values, each in a sentence. Those of all pairs are usually the
    /// same.
    pub warnings: Vec<&'static str>,
}

impl Scored {
    /// A result with neither maps nor warnings.
    pub(crate) fn of(rows: Rows) -> Self {
        Self { rows, maps: Vec::new(), warnings: Vec::new() }
    }
}
