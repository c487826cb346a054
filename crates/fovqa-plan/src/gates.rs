//! The rules of a gate: conditions on the values of a run.

use std::fmt;

use fovqa_metrics::{Better, Key, Metric, Subject};
use serde::{Deserialize, Serialize};

use crate::spread_test::SpreadTest;

/// One rule. It passes if it passes in every comparison that it applies to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GateRule {
    /// Its line in the experiment file, counted from 1.
    pub line: usize,
    /// Its name; `None` if the rule is named after its content.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The value that is checked.
    pub quantity: Quantity,
    /// The scene it applies to; `None` for all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<String>,
    /// The method it applies to; `None` for all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<String>,
    /// The eye it applies to, in scenes with two; `None` for both together.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub eye: Option<String>,
    /// The smallest allowed value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The largest allowed value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// How far the value may fall below that of the baseline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_drop: Option<Allowance>,
    /// How far the value may rise above that of the baseline.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_rise: Option<Allowance>,
    /// The test against the spread of repeated runs. A rule with a test has no limits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<SpreadTest>,
}

impl GateRule {
    /// Whether the rule compares values with a baseline.
    pub fn needs_baseline(&self) -> bool {
        self.max_drop.is_some() || self.max_rise.is_some() || self.spread.is_some()
    }

    /// The limits in words.
    pub fn limits(&self) -> String {
        let limits = [
            self.at_least.map(|limit| format!("at least {limit}")),
            self.at_most.map(|limit| format!("at most {limit}")),
            self.max_drop.map(|drop| format!("at most {drop} below the baseline")),
            self.max_rise.map(|rise| format!("at most {rise} above the baseline")),
            self.spread.map(|test| test.to_string()),
        ];
        limits.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// A value of a comparison: a statistic of a metric over its frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// Key of the metric.
    pub metric: String,
    /// Name of the statistic; empty for the metric's own value.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub statistic: String,
    /// The image that it belongs to: `pair`, `reference`, `test` or `ratio`.
    pub image: String,
    /// Level of the wavelet, or spatial band of FovVideoVDP, counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub level: Option<i64>,
    /// Lower and upper edge of the band in degrees; `None` for the whole frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub band_deg: Option<[f64; 2]>,
    /// How the values of frames become one value; `None` for a value of the whole sequence, and for the
    /// values of single frames.
    pub aggregate: Option<Aggregate>,
    /// Whether each frame has to keep the rule.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub per_frame: bool,
}

impl Quantity {
    /// The statistic of a whole sequence that FovVideoVDP has.
    pub const JOD: &str = "jod";
    /// The statistic of FovVideoVDP that single frames have.
    pub const FRAME_JOD: &str = "frame_jod";
    /// The statistic of a whole sequence of metrics that pool their frames.
    pub const POOLED: &str = "pooled";

    /// A metric's own value over the frames.
    pub fn of(metric: Metric, aggregate: Aggregate) -> Self {
        Self {
            metric: metric.key().to_owned(),
            statistic: String::new(),
            image: "pair".to_owned(),
            level: None,
            band_deg: None,
            aggregate: Some(aggregate),
            per_frame: false,
        }
    }

    /// FovVideoVDP of the sequence.
    pub fn jod() -> Self {
        let metric = Metric::Fvvdp;
        Self {
            statistic: Self::JOD.to_owned(),
            aggregate: None,
            ..Self::of(metric, Aggregate::Mean)
        }
    }

    /// The values of single frames that this value describes.
    #[must_use]
    pub fn of_frames(&self) -> Self {
        let statistic = match self.statistic.as_str() {
            Self::JOD => Self::FRAME_JOD,
            Self::POOLED => "",
            statistic => statistic,
        };
        let statistic = statistic.to_owned();
        Self { statistic, aggregate: None, per_frame: true, ..self.clone() }
    }

    /// Whether higher or lower values are better.
    pub fn better(&self) -> Better {
        better(Metric::find(&self.metric), &self.statistic, &self.image)
    }
}

/// Whether higher or lower values of a statistic are better.
pub fn better(metric: Option<Metric>, statistic: &str, image: &str) -> Better {
    let Some(metric) = metric.filter(|_| image != "reference") else { return Better::Neither };
    let key = Key::named(Subject::Metric(metric), statistic);
    let own = key.and_then(|key| key.statistic().better);
    own.unwrap_or(metric.info().better)
}

impl fmt::Display for Quantity {
    /// Writes a text that identifies the quantity uniquely: `psnr min`, `haar energy ratio mean,
    /// level 2, 0° to 10°`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.metric)?;
        if !self.statistic.is_empty() {
            write!(f, " {}", self.statistic)?;
        }
        if self.image != "pair" {
            write!(f, " {}", self.image)?;
        }
        if let Some(aggregate) = self.aggregate {
            write!(f, " {aggregate}")?;
        }
        if self.per_frame {
            f.write_str(" per frame")?;
        }
        if let Some(level) = self.level {
            write!(f, ", level {level}")?;
        }
        if let Some([from, to]) = self.band_deg {
            write!(f, ", {from}° to {to}°")?;
        }
        Ok(())
    }
}

/// How the values of frames become one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Aggregate {
    /// The mean. For decibels, it is over the frames that differ from the reference.
    Mean,
    /// The smallest value.
    Min,
    /// The largest value.
    Max,
    /// A percentile, from 1 to 99, interpolated linearly between the nearest frames.
    Percentile(u8),
}

impl Aggregate {
    /// The aggregate with a given name: `mean`, `min`, `max`, `p01` to `p99`.
    pub fn find(word: &str) -> Option<Self> {
        match word {
            "mean" => Some(Self::Mean),
            "min" => Some(Self::Min),
            "max" => Some(Self::Max),
            word => {
                let digits = word.strip_prefix('p').filter(|digits| digits.len() == 2)?;
                // A number may have a sign, but a percentile may not.
                let plain = digits.bytes().all(|digit| digit.is_ascii_digit());
                let percent: u8 = digits.parse().ok()?;
                (plain && (1..=99).contains(&percent)).then_some(Self::Percentile(percent))
            }
        }
    }
}

impl fmt::Display for Aggregate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mean => f.write_str("mean"),
            Self::Min => f.write_str("min"),
            Self::Max => f.write_str("max"),
            Self::Percentile(percent) => write!(f, "p{percent:02}"),
        }
    }
}

impl TryFrom<String> for Aggregate {
    type Error = String;
    fn try_from(word: String) -> Result<Self, String> {
        Self::find(&word).ok_or_else(|| format!("{word:?} is not an aggregate"))
    }
}

impl From<Aggregate> for String {
    fn from(aggregate: Aggregate) -> Self {
        aggregate.to_string()
    }
}

/// The allowed distance from the value of the baseline.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Allowance {
    /// Distance in the metric's unit.
    Units(f64),
    /// Distance in percent of the baseline's value.
    Percent(f64),
}

impl Allowance {
    /// Parses a percentage, `2%` or `0.5 %`.
    pub fn percent(text: &str) -> Option<Self> {
        let number: f64 = text.trim().strip_suffix('%')?.trim().parse().ok()?;
        (0.0..=1000.0).contains(&number).then_some(Self::Percent(number))
    }

    /// The allowed distance for a given value of the baseline.
    pub fn of(self, baseline: f64) -> f64 {
        match self {
            Self::Units(units) => units,
            Self::Percent(percent) => baseline.abs() * percent / 100.0,
        }
    }
}

impl fmt::Display for Allowance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Units(units) => write!(f, "{units}"),
            Self::Percent(percent) => write!(f, "{percent} %"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aggregates_are_words() {
        for word in ["mean", "min", "max", "p01", "p50", "p99"] {
            assert_eq!(Aggregate::find(word).unwrap().to_string(), word);
        }
        for word in ["p00", "p1", "p100", "median", "P50", "p-1", "p+5", ""] {
            assert_eq!(Aggregate::find(word), None, "{word}");
        }
    }

    #[test]
    fn percent_is_of_the_baseline() {
        assert_eq!(Allowance::percent("2%"), Some(Allowance::Percent(2.0)));
        assert_eq!(Allowance::percent(" 0.5 % "), Some(Allowance::Percent(0.5)));
        for text in ["2", "%", "-1%", "nan%", "x%", "inf%"] {
            assert_eq!(Allowance::percent(text), None, "{text}");
        }
        assert!((Allowance::Percent(2.0).of(-30.0) - 0.6).abs() < 1e-12);
        assert!((Allowance::Units(0.5).of(30.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn quantities_have_names_of_their_own() {
        let psnr = Quantity::of(Metric::Psnr, Aggregate::Min);
        assert_eq!(psnr.to_string(), "psnr min");
        let banded = Quantity { band_deg: Some([0.0, 7.5]), ..psnr };
        assert_eq!(banded.to_string(), "psnr min, 0° to 7.5°");
        let haar = Quantity {
            statistic: "energy".to_owned(),
            image: "ratio".to_owned(),
            level: Some(2),
            ..Quantity::of(Metric::Haar, Aggregate::Percentile(5))
        };
        assert_eq!(haar.to_string(), "haar energy ratio p05, level 2");
        assert_eq!(Quantity::jod().to_string(), "fvvdp jod");
        assert_eq!(Quantity::jod().of_frames().to_string(), "fvvdp frame_jod per frame");
        assert_eq!(banded.of_frames().to_string(), "psnr per frame, 0° to 7.5°");
        assert_eq!((haar.better(), Quantity::jod().better()), (Better::Neither, Better::Higher));
    }
}
