//! Means, extremes and pooled values over the frames of a run.

use std::collections::BTreeMap;

use fovqa_metrics::{FrameRows, Key, Metric, MetricKind, Pool, Row, Statistic, Subject};

use crate::compared::{Sides, compared_in};
use crate::fvvdp::FvvdpSummary;
use crate::report::ScoreReport;
use crate::samples::SampleSummary;
use crate::spread::{Gathered, Spread};
use crate::temporal::{TemporalSummaries, TemporalValues};

/// The statistics of one measure over the frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// The mean. The mean of decibels uses only the frames with a finite value, and is infinite if
    /// there are none, so that one identical frame does not raise the mean of all frames.
    pub mean: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// For decibels: number of frames without any error.
    pub identical_frames: Option<usize>,
    /// For metrics that pool their frames (decibels of the error of all frames): the pooled value.
    pub pooled: Option<f64>,
}

/// The statistics over the frames of a measure that is computed for reference and test in the same
/// way.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SideStatistics {
    /// Values of the reference; `None` if no frame has a value.
    pub reference: Option<Spread>,
    /// Values of the test; `None` if no frame has a value.
    pub test: Option<Spread>,
    /// test / reference: the ratio of the values that represent all frames ([`Self::headline`]).
    pub ratio: Option<f64>,
}

/// The statistics of one band over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct BandSummary {
    /// Lower edge in degrees.
    pub from_deg: f64,
    /// Upper edge in degrees.
    pub to_deg: f64,
    /// Number of pixels in all frames together.
    pub pixels: u64,
    /// The statistics of each measure; `None` if no frame has a value.
    pub statistics: BTreeMap<Metric, Option<Statistics>>,
}

/// All measures over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Statistics of whole frames.
    pub statistics: BTreeMap<Metric, Statistics>,
    /// Statistics of the bands.
    pub bands: Vec<BandSummary>,
    /// Measures of each image, by the key of their ratio, in the order of results.
    pub compared: BTreeMap<Key, SideStatistics>,
    /// Number of values in all frames together, for metrics that count them.
    pub counts: BTreeMap<Key, u64>,
    /// Temporal metrics, as far as they are requested.
    pub temporal: TemporalSummaries,
    /// FovVideoVDP, if it is requested.
    pub fvvdp: Option<FvvdpSummary>,
    /// The samples of an emulated method.
    pub samples: Option<SampleSummary>,
}

impl Summary {
    /// Summarises the scored frames of a report.
    pub fn of(report: &ScoreReport) -> Self {
        let frames = &report.frames;
        let scored = || report.metrics.iter().copied().filter(|metric| Key::of(*metric).is_score());
        let per_band = |m: &Metric| m.info().per_band && m.is(MetricKind::Fidelity);
        let pixels = |band| Key::pixels(Subject::Pixels).in_band(band);
        let edges = report.edges();
        let of_band = |band: usize| {
            let metrics = scored().filter(per_band).map(move |m| Key::of(m).in_band(band));
            metrics.chain([pixels(band)])
        };
        let keys: Vec<Key> =
            scored().map(Key::of).chain((0..edges.len()).flat_map(of_band)).collect();
        let is_count = |key: &Key| key.metric().is_some() && key.statistic().is_count;
        let mut gathered = GatheredValues::of(&keys);
        let mut counts = BTreeMap::new();
        let mut compared: BTreeMap<Key, Sides<Gathered>> = BTreeMap::new();
        let temporal = report.metrics.iter().filter(|metric| metric.is(MetricKind::Temporal));
        let mut temporal: BTreeMap<Metric, TemporalValues> =
            temporal.map(|metric| (*metric, TemporalValues::default())).collect();
        for frame in frames {
            // The values of a frame are read once for all statistics.
            let rows = frame.rows.held();
            gathered.add(&rows);
            for row in rows.of_keys(is_count) {
                *counts.entry(row.key).or_default() += row.value.unwrap_or_default() as u64;
            }
            for (key, sides) in compared_in(&rows) {
                let entry = compared.entry(key).or_default();
                entry.reference.add(sides.reference);
                entry.test.add(sides.test);
            }
            for (metric, values) in &mut temporal {
                values.add(*metric, &rows);
            }
        }
        let whole = scored().filter_map(|m| Some((m, gathered.statistics(Key::of(m))?)));
        let bands = edges.iter().enumerate().map(|(index, &(from_deg, to_deg))| {
            let per_band = scored().filter(per_band);
            let statistics = per_band.map(|m| (m, gathered.statistics(Key::of(m).in_band(index))));
            BandSummary {
                from_deg,
                to_deg,
                pixels: gathered.total(pixels(index)),
                statistics: statistics.collect(),
            }
        });
        let compared = compared
            .into_iter()
            .map(|(key, values)| (key, SideStatistics::of(&values, key.statistic())));
        let temporal = temporal.into_iter().map(|(m, values)| (m, values.summary(m, report)));
        Self {
            statistics: whole.collect(),
            bands: bands.collect(),
            compared: compared.collect(),
            counts,
            temporal: TemporalSummaries(temporal.collect()),
            fvvdp: FvvdpSummary::of(report),
            samples: SampleSummary::of(frames),
        }
    }

    /// Measures of each image, ordered by metric, level and band.
    pub(crate) fn compared_by_metric(&self) -> Vec<(Key, &SideStatistics)> {
        let mut compared: Vec<_> = self.compared.iter().map(|(key, of)| (*key, of)).collect();
        compared.sort_by_key(|(key, _)| (key.subject, key.level, key.band));
        compared
    }
}

impl SideStatistics {
    fn of(values: &Sides<Gathered>, statistic: &Statistic) -> Self {
        let Sides { reference, test } = values.map(|values| values.spread(statistic));
        let statistics = Self { reference, test, ratio: None };
        Self { ratio: statistics.headline(statistic).ratio(statistic), ..statistics }
    }

    /// The value that represents all frames ([`Spread::headline`]).
    pub fn headline(&self, statistic: &Statistic) -> Sides<Option<f64>> {
        let of = |spread: Spread| spread.headline(statistic);
        Sides { reference: self.reference.map(of), test: self.test.map(of) }
    }
}

/// The values of several keys over the frames.
struct GatheredValues(BTreeMap<Key, KeyValues>);

impl GatheredValues {
    fn of(keys: &[Key]) -> Self {
        Self(keys.iter().map(|key| (*key, KeyValues::default())).collect())
    }

    /// Adds the values of the next frame.
    fn add(&mut self, rows: &FrameRows) {
        for (key, values) in &mut self.0 {
            if let Some(row) = rows.get(*key) {
                values.add(&row);
            }
        }
    }

    /// The statistics of a key; `None` if no frame has a value.
    fn statistics(&self, key: Key) -> Option<Statistics> {
        self.0.get(&key)?.statistics(key)
    }

    /// The sum of the counts of a key.
    fn total(&self, key: Key) -> u64 {
        self.0.get(&key).map_or(0, |values| values.total)
    }
}

/// What is kept of the values of one key.
#[derive(Debug, Clone, Copy)]
struct KeyValues {
    count: usize,
    extremes: Option<(f64, f64)>,
    finite: usize,
    finite_sum: f64,
    /// The sum of the values as counts.
    total: u64,
    pool: Pool,
}

impl Default for KeyValues {
    fn default() -> Self {
        // The sum of no numbers, to which -0.0 can be added without a change of its sign.
        let finite_sum = -0.0;
        Self { count: 0, extremes: None, finite: 0, finite_sum, total: 0, pool: Pool::default() }
    }
}

impl KeyValues {
    fn add(&mut self, row: &Row) {
        self.pool.add(row.value, row.parts);
        let Some(value) = row.value else { return };
        let (min, max) = self.extremes.unwrap_or((value, value));
        self.extremes = Some((min.min(value), max.max(value)));
        self.count += 1;
        self.total += value as u64;
        if value.is_finite() {
            self.finite += 1;
            self.finite_sum += value;
        }
    }

    /// The statistics; `None` if there is no value.
    fn statistics(&self, key: Key) -> Option<Statistics> {
        let (min, max) = self.extremes?;
        let mean = if self.finite == 0 { max } else { self.finite_sum / self.finite as f64 };
        let identical_frames = key.metric()?.is_decibel().then(|| self.count - self.finite);
        let statistic = key.statistic();
        let pooled = statistic.pools_frames().then(|| self.pool.value(statistic.frames).0);
        Some(Statistics { mean, min, max, identical_frames, pooled: pooled.flatten() })
    }
}

#[cfg(test)]
mod tests {
    use fovqa_metrics::Parts;

    use super::*;

    #[test]
    fn an_identical_frame_does_not_lift_the_mean() {
        let of = |metric, values: &[f64]| {
            let key = Key::of(metric);
            let mut gathered = KeyValues::default();
            for &value in values {
                gathered.add(&Row { key, value: Some(value), parts: Parts::Value });
            }
            gathered.statistics(key)
        };
        let s = of(Metric::Psnr, &[30.0, f64::INFINITY, 20.0]).unwrap();
        assert_eq!(
            (s.mean, s.min, s.max, s.identical_frames),
            (25.0, 20.0, f64::INFINITY, Some(1))
        );
        let all = of(Metric::Psnr, &[f64::INFINITY; 2]).unwrap();
        assert!(all.mean.is_infinite());
        assert!(of(Metric::Ssim, &[]).is_none());
        let zero = of(Metric::Ssim, &[-0.0]).unwrap();
        assert!(zero.mean.is_sign_negative(), "the sum of one value is the value");
    }
}
