//! One row of the table of all values, and its columns.

use std::fmt;

use fovqa_metrics::Image;

/// The columns, in order.
pub(super) const COLUMNS: [&str; 12] = [
    "scene",
    "method",
    "parameters",
    "eye",
    "frame",
    "image",
    "metric",
    "statistic",
    "level",
    "from_deg",
    "to_deg",
    "value",
];

/// The metric of a row that stands for something that could not be scored.
pub const ERROR: &str = "error";

/// The metric of rows that say how far the gaze has moved since the frame before, degrees.
pub const GAZE_STEP: &str = "gaze_step_deg";

/// A row of the table. The column `parameters` is always empty: it is reserved for sweeps.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct TableRow<'a> {
    /// The scene.
    pub scene: &'a str,
    /// The method.
    pub method: &'a str,
    /// `left`, `right` or `both`; empty in a scene with one picture a frame.
    pub eye: &'a str,
    /// The frame; `None`: of the whole sequence.
    pub frame: Option<i64>,
    /// Of which picture.
    pub image: Image,
    /// What is measured or counted, or [`ERROR`].
    pub metric: &'a str,
    /// Which statistic of it; empty for the metric's own value.
    pub statistic: &'a str,
    /// The level, from 1 on.
    pub level: Option<usize>,
    /// Edges of the band, degrees; `None`: the whole frame.
    pub band: Option<[f64; 2]>,
    /// The value; `None` where there is nothing to have one of.
    pub value: Option<Value>,
}

/// A cell of the last column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// Measured: it keeps its point.
    Measured(f64),
    /// Counted: whole.
    Count(u64),
}

impl Value {
    /// The number.
    pub fn number(self) -> f64 {
        match self {
            Value::Measured(value) => value,
            Value::Count(count) => count as f64,
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // As readers of CSV know it.
            Value::Measured(value) if value.is_nan() => f.write_str("nan"),
            Value::Measured(value) => write!(f, "{value:?}"),
            Value::Count(count) => write!(f, "{count}"),
        }
    }
}
