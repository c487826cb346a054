//! Means, extremes and pooled forms over the frames of a run.

use std::collections::BTreeMap;

use fovqa_metrics::{FrameRows, Image, Key, Metric, MetricKind, Subject, pool};

use crate::compared::Sides;
use crate::fvvdp::FvvdpSummary;
use crate::report::{FrameResult, GuideSource, ScoreReport};
use crate::spread::{Gathered, Spread};

/// One measure over the frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Statistics {
    /// The mean; of decibels, over the frames that have a finite value, and infinite where none
    /// has: one identical frame must not lift the mean of all.
    pub mean: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// For decibels: frames without any error.
    pub identical_frames: Option<usize>,
    /// Of metrics that pool their frames (the decibels of all errors): the value of all together.
    pub pooled: Option<f64>,
}

/// A measure of reference and test alike over the frames.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SideStatistics {
    /// The reference's; `None` where no frame has a value.
    pub reference: Option<Spread>,
    /// The test's.
    pub test: Option<Spread>,
    /// test / reference: of the means or, of maxima, of the largest.
    pub ratio: Option<f64>,
}

/// Differences over time of a whole sequence.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AtdSummary {
    /// Mean over frames, of the reference; `None` where no two frames could be compared.
    pub reference: Option<f64>,
    /// The same of the test.
    pub test: Option<f64>,
    /// test / reference: the papers' percentage.
    pub ratio: Option<f64>,
    /// Share of the pixels that were left out, 0 to 1.
    pub left_out: Option<f64>,
    /// The same of the test, where it was compared along its own motion or depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out_test: Option<f64>,
    /// Frames that could be compared with the one before.
    pub frames: usize,
    /// Whose motion it was taken along.
    pub motion: GuideSource,
    /// Whose depth.
    pub depth: GuideSource,
    /// Why a value is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// One band over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct BandSummary {
    /// Lower edge.
    pub from_deg: f64,
    /// Upper edge.
    pub to_deg: f64,
    /// Pixels in all frames together.
    pub pixels: u64,
    /// Each measure; `None` where no frame has a value.
    pub statistics: BTreeMap<Metric, Option<Statistics>>,
}

/// All measures over the frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Whole frames.
    pub statistics: BTreeMap<Metric, Statistics>,
    /// Bands.
    pub bands: Vec<BandSummary>,
    /// What is measured of each picture, by the key of its ratio, in the order of results.
    pub compared: BTreeMap<Key, SideStatistics>,
    /// How many values there are in all frames together, where a metric counts them.
    pub counts: BTreeMap<Key, u64>,
    /// Differences over time, where they are asked for.
    pub atd: Option<AtdSummary>,
    /// FovVideoVDP, where it is asked for.
    pub fvvdp: Option<FvvdpSummary>,
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
        }
    }

    /// What is measured of each picture, metric by metric, level by level, band by band.
    pub(crate) fn compared_by_metric(&self) -> Vec<(Key, &SideStatistics)> {
        let mut compared: Vec<_> = self.compared.iter().map(|(key, of)| (*key, of)).collect();
        compared.sort_by_key(|(key, _)| (key.subject, key.level, key.band));
        compared
    }
}

/// What is measured of each picture, over the frames.
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

    /// What stands for all frames: the means or, of maxima, the largest.
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
    /// Of the values of a key; `None` where no frame has one.
    fn of_key(frames: &[FrameResult], key: Key) -> Option<Self> {
        let rows = || FrameRows::of_frames(frames.iter().map(|frame| &frame.rows), key);
        let values = rows().filter_map(|row| row.value);
        let statistics = Self::of(key.metric()?, values)?;
        let statistic = key.statistic();
        let pooled = || pool(statistic.frames, rows().map(|row| (row.value, row.parts))).0;
        Some(Self { pooled: statistic.pools_frames().then(pooled).flatten(), ..statistics })
    }

    /// `None` without a value.
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
