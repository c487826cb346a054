//! Mean, smallest and largest of several values.

use fovqa_metrics::{Parts, Pool, Statistic};

/// Mean and extremes over the frames.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// For metrics that pool their frames: the pooled value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pooled: Option<f64>,
}

impl Spread {
    /// The value that represents all frames: the pooled value of metrics that have one, the largest
    /// one of maxima, and otherwise the mean.
    pub fn headline(&self, statistic: &Statistic) -> f64 {
        match self.pooled {
            _ if statistic.is_maximum() => self.max,
            Some(pooled) => pooled,
            None => self.mean,
        }
    }
}

/// Collects values for a [`Spread`].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Gathered {
    sum: f64,
    count: usize,
    extremes: Option<(f64, f64)>,
    pool: Pool,
}

impl Gathered {
    pub(crate) fn add(&mut self, value: Option<f64>) {
        let Some(value) = value else { return };
        let (min, max) = self.extremes.unwrap_or((value, value));
        self.extremes = Some((min.min(value), max.max(value)));
        self.sum += value;
        self.count += 1;
        self.pool.add(Some(value), Parts::Value);
    }

    /// The mean and extremes; `None` if there is no value.
    pub(crate) fn spread(&self, statistic: &Statistic) -> Option<Spread> {
        let (min, max) = self.extremes?;
        let pooled = statistic.pools_values().then(|| self.pool.value(statistic.frames).0);
        Some(Spread { mean: self.sum / self.count as f64, min, max, pooled: pooled.flatten() })
    }

    /// The value that represents all frames; `None` if there is none.
    pub(crate) fn headline(&self, statistic: &Statistic) -> Option<f64> {
        self.spread(statistic).map(|spread| spread.headline(statistic))
    }
}
