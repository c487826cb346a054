//! What was measured of a pair.

use crate::map::Map;
use crate::row::Rows;

/// What was measured of a pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Scored {
    /// The values.
    pub rows: Rows,
    /// The maps of metrics that have some, where they are asked for.
    pub maps: Vec<Map>,
}
