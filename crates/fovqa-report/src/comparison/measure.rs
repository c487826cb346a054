//! What a table shows of each method: a metric, or another measure.

use fovqa_metrics::{Better, Metric, MetricKind};

/// A measure, and how its values are written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measure {
    /// Label that people read.
    pub(crate) label: String,
    /// Its unit; empty for a plain number.
    pub(crate) unit: &'static str,
    /// Whether higher or lower values are better.
    pub(crate) better: Better,
    /// Name in CSV files.
    pub(crate) key: String,
    /// What it means, in sentences.
    pub(crate) about: String,
    pub(super) digits: Digits,
}

/// How the digits of numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Digits {
    Decibels,
    Thousandths,
    Scientific,
    Share,
    Percent,
}

impl Measure {
    /// The measure of a metric's own values.
    pub(crate) fn of(metric: Metric) -> Self {
        let info = metric.info();
        let digits = match metric {
            Metric::Mse => Digits::Scientific,
            Metric::Fvvdp => Digits::Thousandths,
            metric if metric.is_decibel() => Digits::Decibels,
            _ => Digits::Share,
        };
        Self {
            label: info.label.to_owned(),
            unit: info.unit,
            better: info.better,
            key: info.key.to_owned(),
            about: meaning(metric, info.unit, info.better),
            digits,
        }
    }

    /// The measure of a metric's value in tables and bars: temporal metrics are percentages of those of
    /// the reference.
    pub(crate) fn of_value(metric: Metric) -> Self {
        let info = metric.info();
        if !metric.is(MetricKind::Temporal) {
            return Self::of(metric);
        }
        Self::ratio(metric, info.label.to_owned(), format!("{}_percent", info.key), info.better)
    }

    /// The measure of a spectrum's cut-off frequency.
    pub(crate) fn cutoff(metric: Metric) -> Self {
        Self {
            label: "Cut-off".to_owned(),
            unit: "cpd",
            better: Better::Higher,
            key: format!("{}_cutoff_cpd", metric.key()),
            about: "Frequency up to which the test has at least half of the reference's power."
                .to_owned(),
            digits: Digits::Decibels,
        }
    }

    /// The measure of the samples of emulated methods.
    pub(crate) fn samples() -> Self {
        Self {
            label: "Samples".to_owned(),
            unit: "% of pixels",
            better: Better::Neither,
            key: "samples_percent".to_owned(),
            about: "Samples that an emulated method shades, in percent of the frame's pixels."
                .to_owned(),
            digits: Digits::Percent,
        }
    }

    /// The measure of the quads of emulated methods.
    pub(crate) fn quads() -> Self {
        Self {
            label: "Quads".to_owned(),
            unit: "% of the frame's",
            better: Better::Neither,
            key: "quads_percent".to_owned(),
            about:
                "Blocks of 2x2 samples of its buffers that a rasteriser shades, in percent of the \
                    frame's."
                    .to_owned(),
            digits: Digits::Percent,
        }
    }

    /// The measure of a metric's percentages of the reference's value.
    pub(crate) fn ratio(metric: Metric, label: String, key: String, better: Better) -> Self {
        let unit = "% of reference";
        let about = meaning(metric, unit, better);
        Self { label, unit, better, key, about, digits: Digits::Percent }
    }

    /// Label, unit, and an arrow for the better direction.
    pub(crate) fn heading(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" ({})", self.unit) };
        let arrow = match self.better {
            Better::Higher => " ↑",
            Better::Lower => " ↓",
            Better::Neither => "",
        };
        format!("{}{unit}{arrow}", self.label)
    }

    /// Number of digits after the decimal point.
    pub(crate) fn decimals(&self) -> usize {
        match self.digits {
            Digits::Decibels => 2,
            Digits::Thousandths => 3,
            Digits::Scientific => 6,
            Digits::Share => 4,
            Digits::Percent => 1,
        }
    }

    /// Formats a value for people.
    pub(crate) fn shown(&self, value: Option<f64>) -> String {
        self.digits.shown(value)
    }
}

/// What the values of a metric in a unit mean, in sentences.
fn meaning(metric: Metric, unit: &str, better: Better) -> String {
    let info = metric.info();
    let mut about = info.about.chars();
    let first = about.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    let unit = if unit.is_empty() { String::new() } else { format!(" Unit: {unit}.") };
    let better = match better {
        Better::Higher => "Higher is better.",
        Better::Lower => "Lower is better.",
        Better::Neither => "Neither direction is better: the reference has the right value.",
    };
    format!("{first}{}.{unit} {better} Source: {}.", about.as_str(), info.source)
}

impl Digits {
    pub(super) fn shown(self, value: Option<f64>) -> String {
        match (value, self) {
            (None, _) => "–".to_owned(),
            (Some(value), _) if value.is_infinite() => "inf".to_owned(),
            (Some(value), Digits::Decibels) => format!("{value:.2}"),
            (Some(value), Digits::Thousandths) => format!("{value:.3}"),
            (Some(value), Digits::Scientific) if value != 0.0 => format!("{value:.2e}"),
            (Some(value), Digits::Percent) if value != 0.0 && value.abs() < 0.1 => {
                format!("{value:.1e}")
            }
            (Some(value), Digits::Percent) => format!("{value:.1}"),
            (Some(value), _) => format!("{value:.4}"),
        }
    }
}
