//! How well metrics predict mean opinion scores: correlations with intervals, a logistic fit, and tests
//! of the difference of two metrics.

mod comparisons;
mod correlation;
mod fit;
mod scores;

use serde::Serialize;

pub use self::comparisons::Comparison;
pub use self::fit::Fit;
pub use self::scores::Condition;
pub(crate) use self::scores::mean_scores;

use self::comparisons::{Correlations, adjust, compare};
use self::correlation::{fisher_interval, is_constant, kendall, p_value, pearson, spearman};
use self::fit::{LEAST_CONDITIONS, fit};
use self::scores::{Scores, conditions};
use crate::bootstrap::{Interval, interval, replicates};
use crate::input::{Data, Table};
use crate::json::{Document, Group};
use crate::{Settings, StudyError};

/// The most metrics, since all pairs are compared.
const MOST_METRICS: usize = 200;

/// Options of the analysis.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Options {
    /// The metrics in their order; all of the table if there is none.
    pub metrics: Vec<String>,
    /// Metrics whose lower scores are better. Their scores are negated.
    pub lower_is_better: Vec<String>,
}

/// The result of one group.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metrics {
    /// The number of conditions with a finite score of each metric.
    pub n: usize,
    /// The other conditions, as "scene/method".
    pub unmatched: Vec<String>,
    /// The metrics.
    pub metrics: Vec<Metric>,
    /// All pairs of metrics.
    pub comparisons: Vec<Comparison>,
    /// The conditions with scores, for figures.
    #[serde(skip)]
    pub conditions: Vec<Condition>,
}

/// How well one metric predicts the scores.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metric {
    /// The metric.
    pub metric: String,
    /// The number of conditions.
    pub n: usize,
    /// Whether lower scores are better, so that they were negated.
    pub lower_is_better: bool,
    /// Pearson's correlation.
    pub pearson: Option<f64>,
    /// Its p-value, by t.
    pub pearson_p: Option<f64>,
    /// Its interval by Fisher's transformation.
    pub pearson_fisher: Option<[f64; 2]>,
    /// Its bootstrap interval, with conditions resampled.
    pub pearson_bootstrap: Option<Interval>,
    /// Spearman's correlation.
    pub spearman: Option<f64>,
    /// Its p-value, by t.
    pub spearman_p: Option<f64>,
    /// Its bootstrap interval.
    pub spearman_bootstrap: Option<Interval>,
    /// Kendall's τ_b.
    pub kendall: Option<f64>,
    /// Its bootstrap interval.
    pub kendall_bootstrap: Option<Interval>,
    /// The logistic fit.
    pub fit: Option<Fit>,
    /// The score of each condition, for figures. Higher scores are better.
    #[serde(skip)]
    pub scores: Vec<f64>,
    /// Why a value is undefined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Compares the metrics of a run (`scores`, its results.csv) with the mean opinion scores of each group.
///
/// # Errors
///
/// If a column is missing, a cell cannot be used, or a metric of the options has no scores.
pub fn metrics(
    data: &Data,
    scores: &Table,
    options: &Options,
    settings: &Settings,
) -> Result<Document<Metrics>, StudyError> {
    let scores = Scores::read(scores)?;
    let index = |option: &str, name: &String| {
        let found = scores.metrics.iter().position(|metric| metric == name);
        found.ok_or_else(|| StudyError::Setting {
            message: format!("{option} names the metric {name:?}, which has no scores"),
            help: format!("the metrics with scores are {}", scores.names()),
        })
    };
    let chosen: Vec<usize> = if options.metrics.is_empty() {
        (0..scores.metrics.len()).collect()
    } else {
        options.metrics.iter().map(|name| index("--metrics", name)).collect::<Result<_, _>>()?
    };
    if chosen.len() > MOST_METRICS {
        return Err(StudyError::Setting {
            message: format!("{} metrics are too many to compare", chosen.len()),
            help: format!("choose at most {MOST_METRICS} with --metrics"),
        });
    }
    for name in &options.lower_is_better {
        index("--lower-is-better", name)?;
    }
    let data = data.without_empty("value")?;
    let mut groups = Vec::new();
    for (by, data) in data.groups()? {
        let result = Matched::new(conditions(&data)?, &scores, &chosen, options).result(settings);
        groups.push(Group { by, result });
    }
    Ok(Document::new("metrics", groups))
}

/// The conditions with a mean opinion score, by first appearance.
///
/// # Errors
///
/// If a column is missing, or a cell cannot be used.
pub fn opinions(data: &Data) -> Result<Vec<Condition>, StudyError> {
    conditions(&data.without_empty("value")?)
}

/// The metrics with scores of whole images in the table of a run (results.csv), by first appearance.
///
/// # Errors
///
/// If the table has no such scores.
pub fn scored(scores: &Table) -> Result<Vec<String>, StudyError> {
    Ok(Scores::read(scores)?.metrics)
}

/// The scores of a group's conditions.
struct Matched {
    unmatched: Vec<String>,
    names: Vec<String>,
    is_lower_better: Vec<bool>,
    conditions: Vec<Condition>,
    /// The mean opinion scores.
    values: Vec<f64>,
    /// Their standard errors.
    errors: Vec<Option<f64>>,
    /// Per metric: its scores, of which higher ones are better.
    scores: Vec<Vec<f64>>,
}

impl Matched {
    fn new(
        conditions: Vec<Condition>,
        scores: &Scores,
        chosen: &[usize],
        options: &Options,
    ) -> Self {
        let names: Vec<String> =
            chosen.iter().map(|&metric| scores.metrics[metric].clone()).collect();
        let mut matched = Self {
            unmatched: Vec::new(),
            is_lower_better: names
                .iter()
                .map(|name| options.lower_is_better.contains(name))
                .collect(),
            conditions: Vec::new(),
            values: Vec::new(),
            errors: Vec::new(),
            scores: vec![Vec::new(); names.len()],
            names,
        };
        for condition in conditions {
            let Some(found) = scores.of(&condition, chosen) else {
                matched.unmatched.push(format!("{}/{}", condition.scene, condition.method));
                continue;
            };
            matched.values.push(condition.value);
            matched.errors.push(condition.error);
            matched.conditions.push(condition);
            let parts = matched.scores.iter_mut().zip(found).zip(&matched.is_lower_better);
            for ((scores, score), &is_lower_better) in parts {
                scores.push(if is_lower_better { -score } else { score });
            }
        }
        matched
    }

    fn result(self, settings: &Settings) -> Metrics {
        let drawn = self.bootstrap(settings);
        let metrics: Vec<Metric> = (0..self.names.len())
            .map(|metric| self.metric(metric, &drawn, settings.confidence))
            .collect();
        let mut comparisons = Vec::new();
        for i in 0..self.names.len() {
            for j in i + 1..self.names.len() {
                let of = Correlations {
                    r: metrics[i].pearson,
                    r_other: metrics[j].pearson,
                    r_between: pearson(&self.scores[i], &self.scores[j]),
                };
                let names = [self.names[i].as_str(), self.names[j].as_str()];
                comparisons.push(compare(names, of, self.values.len()));
            }
        }
        adjust(&mut comparisons, settings.adjust);
        Metrics {
            n: self.values.len(),
            unmatched: self.unmatched,
            metrics,
            comparisons,
            conditions: self.conditions,
        }
    }

    /// Per replicate and metric: the correlations of resampled conditions.
    fn bootstrap(&self, settings: &Settings) -> Vec<Vec<[Option<f64>; 3]>> {
        let n = self.values.len();
        if n < 2 {
            return Vec::new();
        }
        replicates(settings, |random| {
            let indices = random.resample(n);
            let of = |values: &[f64]| -> Vec<f64> { indices.iter().map(|&i| values[i]).collect() };
            let values = of(&self.values);
            let correlations = |scores: &Vec<f64>| {
                let scores = of(scores);
                [pearson(&scores, &values), spearman(&scores, &values), kendall(&scores, &values)]
            };
            self.scores.iter().map(correlations).collect()
        })
    }

    fn metric(&self, metric: usize, drawn: &[Vec<[Option<f64>; 3]>], confidence: f64) -> Metric {
        let (x, y) = (&self.scores[metric], &self.values);
        let n = y.len();
        let (pearson, spearman) = (pearson(x, y), spearman(x, y));
        let [pearson_bootstrap, spearman_bootstrap, kendall_bootstrap] = [0, 1, 2].map(|kind| {
            let values = drawn.iter().filter_map(|replicate| replicate[metric][kind]);
            interval(values.collect(), confidence)
        });
        Metric {
            metric: self.names[metric].clone(),
            n,
            lower_is_better: self.is_lower_better[metric],
            pearson,
            pearson_p: pearson.and_then(|r| p_value(r, n)),
            pearson_fisher: pearson.and_then(|r| fisher_interval(r, n, confidence)),
            pearson_bootstrap,
            spearman,
            spearman_p: spearman.and_then(|r| p_value(r, n)),
            spearman_bootstrap,
            kendall: kendall(x, y),
            kendall_bootstrap,
            fit: fit(x, y, &self.errors),
            scores: x.clone(),
            reason: reason(x, y, pearson, pearson_bootstrap.is_none()),
        }
    }
}

/// Why values of a metric are undefined.
fn reason(x: &[f64], y: &[f64], r: Option<f64>, has_no_bootstrap: bool) -> Option<String> {
    let mut reasons = Vec::new();
    if x.len() < 2 {
        reasons.push("a correlation needs 2 or more conditions".to_owned());
    } else if is_constant(x) {
        reasons.push("the scores of the metric are constant".to_owned());
    } else if is_constant(y) {
        reasons.push("the mean opinion scores are constant".to_owned());
    } else if has_no_bootstrap {
        reasons.push("there are no bootstrap replicates".to_owned());
    }
    if x.len() < 4 {
        reasons
            .push("fewer than 4 conditions have no interval by Fisher's transformation".to_owned());
    } else if r.is_some_and(|r| r.abs() >= 1.0) {
        reasons
            .push("a correlation of 1 or -1 has no interval by Fisher's transformation".to_owned());
    }
    if x.len() < LEAST_CONDITIONS {
        reasons.push(format!("a fit needs {LEAST_CONDITIONS} or more conditions"));
    }
    (!reasons.is_empty()).then(|| reasons.join("; "))
}
