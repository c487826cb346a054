//! Means, extremes and pooled values over the frames of a run.

use std::collections::BTreeMap;

use fovqa_metrics::{FrameRows, Image, Key, Metric, MetricKind, Subject, pool};

use crate::compared::Sides;
use crate::fvvdp::FvvdpSummary;
use crate::report::{FrameResult, GuideSource, ScoreReport};
use crate::samples::SampleSummary;
use crate::spread::{Gathered, Spread};

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
    /// test / reference: the ratio of the means or, for maxima, of the largest values.
    pub ratio: Option<f64>,
}

/// Temporal differences of a whole sequence.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AtdSummary {
    /// Mean over the frames of the reference; `None` if no two frames could be compared.
    pub reference: Option<f64>,
    /// Mean over the frames of the test; `None` if no two frames could be compared.
    pub test: Option<f64>,
    /// test / reference, which the papers give as a percentage.
    pub ratio: Option<f64>,
    /// Share of the pixels that were left out, from 0 to 1.
    pub left_out: Option<f64>,
    /// Share of the pixels of the test that were left out, if the test used its own motion or
    /// depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out_test: Option<f64>,
    /// Number of frames that could be compared with the previous one.
    pub frames: usize,
    /// Source of the motion.
    pub motion: GuideSource,
    /// Source of the depth.
    pub depth: GuideSource,
    /// Why a value is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
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
    /// Temporal differences, if they are requested.
    pub atd: Option<AtdSummary>,
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
        let whole = scored().filter_map(|m| Some((m, Statistics::of_key(frames, Key::of(m))?)));
        let bands = report.edges().iter().enumerate().map(|(index, &(from_deg, to_deg))| {
            let pixels = Key::pixels(Subject::Pixels).in_band(index);
            let per_band = scored().filter(|m| m.info().per_band && m.is(MetricKind::Fidelity));
            let statistics =
                per_band.map(|m| (m, Statistics::of_key(frames, Key::of(m).in_band(index))));
            BandSummary {
                from_deg,
                to_deg,
                pixels: frames.iter().map(|frame| frame.rows.number(pixels)).sum(),
                statistics: statistics.collect(),
            }
        });
        let mut counts = BTreeMap::new();
        let is_count = |key: &Key| key.metric().is_some() && key.statistic().is_count;
        for row in frames.iter().flat_map(|frame| frame.rows.of_keys(is_count)) {
            *counts.entry(row.key).or_default() += row.value.unwrap_or_default() as u64;
        }
        Self {
            statistics: whole.collect(),
            bands: bands.collect(),
            compared: compared(frames),
            counts,
            atd: report.metrics.contains(&Metric::Atd).then(|| AtdSummary::of(report)),
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

/// Measures of each image over the frames.
fn compared(frames: &[FrameResult]) -> BTreeMap<Key, SideStatistics> {
    let mut values: BTreeMap<Key, Sides<Gathered>> = BTreeMap::new();
    for (key, sides) in frames.iter().flat_map(FrameResult::compared) {
        let entry = values.entry(key).or_default();
        entry.reference.add(sides.reference);
        entry.test.add(sides.test);
    }
    let statistics = values
        .into_iter()
        .map(|(key, values)| (key, SideStatistics::of(&values, key.statistic().is_maximum())));
    statistics.collect()
}

impl SideStatistics {
    fn of(values: &Sides<Gathered>, maximum: bool) -> Self {
        let Sides { reference, test } = values.map(Gathered::spread);
        let statistics = Self { reference, test, ratio: None };
        Self { ratio: statistics.headline(maximum).ratio(), ..statistics }
    }

    /// The value that represents all frames: the mean or, for maxima, the largest value.
    pub fn headline(&self, maximum: bool) -> Sides<Option<f64>> {
        let of = |spread: Spread| if maximum { spread.max } else { spread.mean };
        Sides { reference: self.reference.map(of), test: self.test.map(of) }
    }
}

impl AtdSummary {
    fn of(report: &ScoreReport) -> Self {
        let key = Key::of(Metric::Atd);
        let [of_reference, of_test] =
            [Image::Reference, Image::Test].map(|image| key.of_image(image));
        let found = || report.frames.iter().map(|f| &f.rows).filter(|rows| rows.has(Metric::Atd));
        let mut gathered: Sides<Gathered> = Sides::default();
        for rows in found() {
            if let (Some(reference), Some(test)) = (rows.value(of_reference), rows.value(of_test)) {
                gathered.reference.add(Some(reference));
                gathered.test.add(Some(test));
            }
        }
        let frames = gathered.test.count;
        let sides = gathered.map(|values| values.spread().map(|spread| spread.mean));
        let left_out = |image: Image| {
            let key = Key::named(Subject::Metric(Metric::Atd), "left_out")?.of_image(image);
            let rows = found().filter_map(|rows| rows.get(key));
            pool(key.statistic().frames, rows.map(|row| (row.value, row.parts))).0
        };
        let guides = report.atd_guides;
        let own = [guides.motion, guides.depth].contains(&GuideSource::Test);
        let reason = match () {
            () if frames > 0 => sides.reason(),
            () if report.frames.len() < 2 => Some("needs two frames"),
            () if found().next().is_none() => Some("no two of the frames follow each other"),
            () => Some("no pixel can be compared"),
        };
        Self {
            reference: sides.reference,
            test: sides.test,
            ratio: sides.ratio(),
            left_out: left_out(Image::Reference),
            left_out_test: left_out(Image::Test).filter(|_| own),
            frames,
            motion: guides.motion,
            depth: guides.depth,
            reason: reason.map(str::to_owned),
        }
    }
}

impl Statistics {
    /// The statistics of the values of a key; `None` if no frame has one.
    fn of_key(frames: &[FrameResult], key: Key) -> Option<Self> {
        let rows = || FrameRows::of_frames(frames.iter().map(|frame| &frame.rows), key);
        let values = rows().filter_map(|row| row.value);
        let statistics = Self::of(key.metric()?, values)?;
        let statistic = key.statistic();
        let pooled = || pool(statistic.frames, rows().map(|row| (row.value, row.parts))).0;
        Some(Self { pooled: statistic.pools_frames().then(pooled).flatten(), ..statistics })
    }

    /// The statistics of some values; `None` if there are none.
    fn of(metric: Metric, values: impl Iterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.collect();
        let min = values.iter().copied().reduce(f64::min)?;
        let max = values.iter().copied().reduce(f64::max)?;
        let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        let mean =
            if finite.is_empty() { max } else { finite.iter().sum::<f64>() / finite.len() as f64 };
        let identical_frames = metric.is_decibel().then(|| values.len() - finite.len());
        Some(Self { mean, min, max, identical_frames, pooled: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_identical_frame_does_not_lift_the_mean() {
        let s = Statistics::of(Metric::Psnr, [30.0, f64::INFINITY, 20.0].into_iter()).unwrap();
        assert_eq!(
            (s.mean, s.min, s.max, s.identical_frames),
            (25.0, 20.0, f64::INFINITY, Some(1))
        );
        let all = Statistics::of(Metric::Psnr, [f64::INFINITY; 2].into_iter()).unwrap();
        assert!(all.mean.is_infinite());
        assert!(Statistics::of(Metric::Ssim, std::iter::empty()).is_none());
    }
}
