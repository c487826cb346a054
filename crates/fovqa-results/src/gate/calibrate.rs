//! Proposes limits from repeated renders of one build. The natural variation of a value determines
//! how far the limit must be from it.

use std::fmt::Write as _;

use fovqa_metrics::Better;
use fovqa_plan::{GateRule, Quantity};

use super::values::{ComparisonName, Lacking, RunValues};
use super::verdict::is_of;

/// Proposed limits for a gate, from repeated runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Calibration {
    /// Number of runs.
    pub runs: usize,
    /// One proposal per rule and comparison.
    pub proposals: Vec<Proposal>,
}

/// A proposed limit for a value of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    /// Scene, method and eye.
    pub place: ComparisonName,
    /// The value.
    pub quantity: Quantity,
    /// Whether the rule compares the value with a baseline.
    pub relative: bool,
    /// Smallest value among the runs.
    pub min: f64,
    /// Largest value among the runs.
    pub max: f64,
    /// Standard deviation over the runs (divisor n - 1).
    pub deviation: f64,
}

/// Proposes limits for rules from the values of repeated runs. Each run has a name.
///
/// # Errors
/// If a run lacks a value.
pub fn calibrate(rules: &[GateRule], runs: &[(String, RunValues)]) -> Result<Calibration, Lacking> {
    let mut proposals: Vec<Proposal> = Vec::new();
    let Some((_, first)) = runs.first() else { return Ok(Calibration { runs: 0, proposals }) };
    for rule in rules {
        for place in first.places().filter(|place| is_of(rule, place)) {
            let value = |(name, run): &(String, RunValues)| {
                let found = run.of(place, &rule.quantity).map(|found| found.value);
                found.map_err(|lacking| lacking.within(&format!("{name}: {}", named(place))))
            };
            let values: Vec<f64> = runs.iter().map(value).collect::<Result<_, _>>()?;
            let proposal = Proposal::new(rule, place, &values);
            if !proposals.contains(&proposal) {
                proposals.push(proposal);
            }
        }
    }
    Ok(Calibration { runs: runs.len(), proposals })
}

fn named((scene, method, eye): &ComparisonName) -> String {
    let eye = if eye.is_empty() { String::new() } else { format!(", {eye}") };
    format!("{scene}, {method}{eye}")
}

impl Proposal {
    fn new(rule: &GateRule, place: &ComparisonName, values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squared: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        Self {
            place: place.clone(),
            quantity: rule.quantity.clone(),
            relative: rule.needs_baseline(),
            min: values.iter().copied().fold(f64::INFINITY, f64::min),
            max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            deviation: if values.len() > 1 { (squared / (count - 1.0)).sqrt() } else { 0.0 },
        }
    }

    /// The observed range: the largest value minus the smallest.
    pub fn spread(&self) -> f64 {
        if self.min.to_bits() == self.max.to_bits() { 0.0 } else { self.max - self.min }
    }

    /// The smallest value to allow: the smallest observed value, minus the observed range as a
    /// margin.
    fn at_least(&self) -> f64 {
        rounded(self.min - self.spread(), self.spread(), f64::floor)
    }

    fn at_most(&self) -> f64 {
        rounded(self.max + self.spread(), self.spread(), f64::ceil)
    }

    /// The allowed difference between two renders: twice the observed range.
    fn allowance(&self) -> f64 {
        rounded(2.0 * self.spread(), self.spread(), f64::ceil)
    }

    /// The lines with the limits. There are none if a value is infinite, because it has no distance
    /// from other values.
    fn limits(&self) -> Vec<String> {
        if !self.min.is_finite() || !self.max.is_finite() {
            return Vec::new();
        }
        let number = |key: &str, value: f64| format!("{key} = {value:?}");
        match (self.quantity.better(), self.relative) {
            (Better::Higher, false) => vec![number("at_least", self.at_least())],
            (Better::Lower, false) => vec![number("at_most", self.at_most())],
            (Better::Higher, true) => vec![number("max_drop", self.allowance())],
            (Better::Lower, true) => vec![number("max_rise", self.allowance())],
            (Better::Neither, _) => {
                vec![number("at_least", self.at_least()), number("at_most", self.at_most())]
            }
        }
    }
}

/// Rounds a value to the second significant digit of its range. A value with zero range is not
/// rounded.
fn rounded(value: f64, spread: f64, round: impl Fn(f64) -> f64) -> f64 {
    if spread == 0.0 || !value.is_finite() {
        return value;
    }
    let digits = 1 - libm::floor(libm::log10(spread)) as i32;
    // Dividing by a power of ten above one gives quotients that print with few digits.
    let power = libm::pow(10.0, f64::from(digits.abs()));
    if power.is_infinite() {
        return value;
    }
    // A number that differs from an integer only by rounding errors counts as that integer.
    let round = |value: f64| {
        let whole = value.round();
        if (value - whole).abs() < 1e-6 { whole } else { round(value) }
    };
    if digits >= 0 { round(value * power) / power } else { round(value / power) * power }
}

impl Calibration {
    /// The limits as tables of an experiment file, each with a comment that states its source.
    pub fn toml(&self) -> String {
        let runs = self.runs;
        let mut text = format!(
            "# Limits from {runs} repeated runs: the worst value, with the observed range as a margin.\n"
        );
        for proposal in &self.proposals {
            let Proposal { place, quantity, min, max, deviation, .. } = proposal;
            let limits = proposal.limits();
            if limits.is_empty() {
                let place = comment(&named(place));
                let _ = write!(
                    text,
                    "\n# {place}: {quantity} {min} to {max} in {runs} runs: an infinite value gives no limit\n"
                );
                continue;
            }
            let _ = write!(
                text,
                "\n# {}: {quantity} {min} to {max} in {runs} runs (spread {}, standard deviation {deviation:.2e})\n",
                comment(&named(place)),
                proposal.spread(),
            );
            let (scene, method, eye) = place;
            let _ = writeln!(text, "[[gate]]\nmetric = {}", quoted(&quantity.metric));
            let mut key = |key: &str, value: &str| {
                let _ = writeln!(text, "{key} = {value}");
            };
            key("scene", &quoted(scene));
            key("method", &quoted(method));
            if !eye.is_empty() {
                key("eye", &quoted(eye));
            }
            if !quantity.statistic.is_empty() {
                key("statistic", &quoted(&quantity.statistic));
            }
            if quantity.image != "pair" {
                key("image", &quoted(&quantity.image));
            }
            if let Some(level) = quantity.level {
                key("level", &level.to_string());
            }
            if let Some([from, to]) = quantity.band_deg {
                key("band_deg", &format!("[{from}, {to}]"));
            }
            if let Some(aggregate) = quantity.aggregate {
                key("aggregate", &quoted(&aggregate.to_string()));
            }
            for limit in limits {
                let _ = writeln!(text, "{limit}");
            }
        }
        text
    }
}

/// A text in TOML quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A name for use in a comment: it must not contain a line break.
fn comment(text: &str) -> String {
    text.replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_keep_as_far_as_values_spread() {
        let proposal = Proposal {
            place: ("s".to_owned(), "m".to_owned(), String::new()),
            quantity: Quantity::of(fovqa_metrics::Metric::Psnr, fovqa_plan::Aggregate::Min),
            relative: false,
            min: 28.613,
            max: 28.702,
            deviation: 0.03,
        };
        assert!((proposal.at_least() - 28.524).abs() < 1e-9, "{}", proposal.at_least());
        assert!((proposal.at_most() - 28.791).abs() < 1e-9);
        assert!((proposal.allowance() - 0.178).abs() < 1e-9);
        assert_eq!(proposal.limits(), ["at_least = 28.524"]);
        let relative = Proposal { relative: true, ..proposal.clone() };
        assert_eq!(relative.limits(), ["max_drop = 0.178"]);
        let same = Proposal { max: 28.613, ..proposal };
        assert_eq!(same.limits(), ["at_least = 28.613"]);
        assert!((rounded(123_456.0, 5000.0, f64::floor) - 123_400.0).abs() < 1e-9);
        assert!((rounded(1e-310, 1e-320, f64::floor) - 1e-310).abs() < 1e-315, "no power of ten");
    }
}
