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
}
