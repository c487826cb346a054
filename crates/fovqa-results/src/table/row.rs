//! One row of the table of all values, and its columns.

use std::fmt;

use fovqa_metrics::Image;
use fovqa_plan::swept_label;

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

/// The metric name in a row for something that could not be scored.
pub const ERROR: &str = "error";

/// The metric name in rows that state how far the gaze has moved since the previous frame, in
/// degrees.
pub const GAZE_STEP: &str = "gaze_step_deg";

/// A row of the table.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct TableRow<'a> {
    /// The scene.
    pub scene: &'a str,
    /// The method.
    pub method: &'a str,
    /// The swept parameters with their values; empty if the method is not swept.
    pub parameters: &'a str,
    /// `left`, `right` or `both`; empty if the scene has one image per frame.
    pub eye: &'a str,
    /// Frame number; `None` for a value of the whole sequence.
    pub frame: Option<i64>,
    /// The image that the value belongs to.
    pub image: Image,
    /// Name of the metric or count, or [`ERROR`].
    pub metric: &'a str,
    /// Name of the statistic; empty for the metric's own value.
    pub statistic: &'a str,
    /// The level, counted from 1; of the spectrum the half octave, which may be negative.
    pub level: Option<i64>,
    /// Edges of the band in degrees; `None` for the whole frame.
    pub band: Option<[f64; 2]>,
    /// The value; `None` if nothing could be measured.
    pub value: Option<Value>,
}

impl TableRow<'_> {
    /// The name of the method among all methods of the run: with the parameters of a point of a sweep.
    pub fn label(&self) -> String {
        swept_label(self.method, self.parameters)
    }
}

/// A cell of the last column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A measured value, which keeps its decimal point.
    Measured(f64),
    /// A count, which is an integer.
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
            // The spelling that readers of CSV know.
            Value::Measured(value) if value.is_nan() => f.write_str("nan"),
            Value::Measured(value) => write!(f, "{value:?}"),
            Value::Count(count) => write!(f, "{count}"),
        }
    }
}
