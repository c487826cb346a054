//! How far methods can foveate before a rule fails: the record of `fovqa limit`, as JSON and as CSV.

use fovqa_plan::{FigureSettings, Quantity};
use serde::{Deserialize, Serialize};

use crate::json::Number;

/// Name and version of the format.
pub const LIMITS_SCHEMA: &str = "fovqa.limits/1";

/// What a search found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LimitsRecord {
    /// [`LIMITS_SCHEMA`].
    pub schema: String,
    /// The version of fovqa.
    pub version: String,
    /// Name of the experiment.
    pub experiment: String,
    /// What was varied: `budget`, or a parameter.
    pub vary: String,
    /// Which samples a budget counts: `buffer` or `on_screen`; for a parameter none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget_of: Option<String>,
    /// How exactly limits are known, as a share of them.
    pub tolerance: f64,
    /// The rules.
    pub rules: Vec<LimitRule>,
    /// What was found, ordered by rule, scene, method and eye.
    pub limits: Vec<LimitRecord>,
    /// How figures are printed.
    #[serde(default, skip_serializing_if = "FigureSettings::is_default")]
    pub figures: FigureSettings,
}

/// A rule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LimitRule {
    /// Its name, or a description of it.
    pub name: String,
    /// What it judges.
    pub quantity: Quantity,
    /// The smallest value that it allows.
    pub at_least: Option<f64>,
    /// The largest value that it allows.
    pub at_most: Option<f64>,
}

/// What was found for a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LimitState {
    /// There is a limit.
    Found,
    /// The rule holds in the whole range.
    Always,
    /// The rule holds nowhere in the range.
    Never,
    /// There are no values.
    NotScored,
}

impl LimitState {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::Always => "always",
            Self::Never => "never",
            Self::NotScored => "not_scored",
        }
    }
}

/// The limit of a rule for a method in a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LimitRecord {
    /// Index of the rule.
    pub rule: usize,
    /// The scene.
    pub scene: String,
    /// The method.
    pub method: String,
    /// `both`, or the eye that the rule names; empty if the scene has one image per frame.
    pub eye: String,
    /// What was found.
    pub state: LimitState,
    /// The range that was searched.
    pub range: [f64; 2],
    /// The last value of what was varied at which the rule holds.
    pub limit: Option<f64>,
    /// The nearest value at which it fails.
    pub fails_at: Option<f64>,
    /// The value of the metric at the limit.
    pub value: Option<Number>,
    /// The samples there as a share of the frame's pixels, of rounded buffers.
    pub samples_share: Option<f64>,
    /// The same before sizes are rounded, if a budget was varied.
    pub ideal_share: Option<f64>,
    /// The parameter that the budget solved, and its value.
    pub parameter: Option<String>,
    /// Its value: one number, or those of a list.
    pub parameter_value: Vec<f64>,
    /// Whether the metric rises or falls throughout, and the rule changes only once.
    pub monotone: bool,
    /// Why there is no limit, if there is none.
    pub note: Option<String>,
    /// All that was measured, in ascending order.
    pub points: Vec<LimitPoint>,
}

/// What was measured at a value of what was varied.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LimitPoint {
    /// The value of what was varied.
    pub at: f64,
    /// The value of the metric.
    pub value: Number,
    /// Whether it was measured to come closer to the limit, after the first steps.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub closer: bool,
}

impl LimitsRecord {
    /// All measured values as CSV: `rule,scene,method,eye,VARIED,value`.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        // Writing to memory does not fail, and all rows have the same length.
        let _ = writer.write_record(["rule", "scene", "method", "eye", &self.vary, "value"]);
        for limit in &self.limits {
            let rule = self.rules.get(limit.rule).map_or("", |rule| rule.name.as_str());
            for point in &limit.points {
                let [at, value] = [point.at, point.value.0].map(|number| format!("{number:?}"));
                let LimitRecord { scene, method, eye, .. } = limit;
                let _ = writer.write_record([rule, scene, method, eye, &at, &value]);
            }
        }
        String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}
