//! Means, extremes and pooled forms over the frames of a run.

use std::collections::BTreeMap;

use fovqa_metrics::temporal::AtdFrame;
use fovqa_metrics::{Metric, MetricKind, PairScores, mse_of_db, psnr_db};

use crate::compared::{HaarStatistic, Measure, Sides};
use crate::fvvdp::FvvdpSummary;
use crate::report::{FrameResult, GuideSource, ScoreReport};

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
    /// For PSNR and FPSNR: the decibels of the error pooled over all frames.
    pub pooled: Option<f64>,
}

/// Mean and extremes over the frames.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
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
    /// Measures of reference and test alike.
    pub compared: BTreeMap<Measure, SideStatistics>,
    /// Coefficients of each level and band of the wavelet, in all frames together.
    pub coefficients: BTreeMap<(usize, usize), u64>,
    /// Differences over time, where they are asked for.
    pub atd: Option<AtdSummary>,
    /// FovVideoVDP, where it is asked for.
    pub fvvdp: Option<FvvdpSummary>,
}

impl Summary {
    /// Summarises the scored frames of a report.
    pub fn of(report: &ScoreReport) -> Self {
        let frames = &report.frames;
        let statistics = report
            .metrics
            .iter()
            .filter_map(|&metric| {
                let values = frames.iter().filter_map(|f| f.scores.scores.get(&metric).copied());
                let statistics = Statistics::of(metric, values)?;
                Some((metric, Statistics { pooled: pooled(metric, frames), ..statistics }))
            })
            .collect();
        let edges = report.view.iter().flat_map(|view| &view.bands_deg).enumerate();
        let bands = edges
            .map(|(index, &(from_deg, to_deg))| {
                let scores = |f: &FrameResult| f.scores.bands[index].clone();
                let bands: Vec<_> = frames.iter().map(scores).collect();
                // FovVideoVDP's shares of a whole are no scores.
                let scored = |m: &&Metric| {
                    m.info().per_band && m.is(MetricKind::Fidelity) && **m != Metric::Fvvdp
                };
                let per_band = report.metrics.iter().filter(scored);
                let statistics = per_band.map(|&metric| {
                    let values = bands.iter().filter_map(|b| b.scores.get(&metric).copied()?);
                    let errors = bands.iter().map(|b| (b.mse, b.pixels));
                    let pooled = pooled_psnr(errors).filter(|_| metric == Metric::Psnr);
                    (metric, Statistics::of(metric, values).map(|s| Statistics { pooled, ..s }))
                });
                BandSummary {
                    from_deg,
                    to_deg,
                    pixels: bands.iter().map(|b| b.pixels).sum(),
                    statistics: statistics.collect(),
                }
            })
            .collect();
        let mut coefficients = BTreeMap::new();
        let bands_of = |frame: &FrameResult| frame.scores.bands.len();
        for frame in frames {
            for level in 1..=frame.haar_levels() {
                for band in 0..bands_of(frame) {
                    *coefficients.entry((level, band)).or_default() +=
                        frame.coefficients(level, band);
                }
            }
        }
        let atd = report.metrics.contains(&Metric::Atd).then(|| AtdSummary::of(report));
        let fvvdp = FvvdpSummary::of(report);
        Self { statistics, bands, compared: compared(frames), coefficients, atd, fvvdp }
    }
}

/// Each measure of reference and test alike over the frames.
fn compared(frames: &[FrameResult]) -> BTreeMap<Measure, SideStatistics> {
    let mut values: BTreeMap<Measure, Sides<Gathered>> = BTreeMap::new();
    for (measure, sides) in frames.iter().flat_map(FrameResult::all_compared) {
        let entry = values.entry(measure).or_default();
        entry.reference.add(sides.reference);
        entry.test.add(sides.test);
    }
    let statistics = values.into_iter().map(|(measure, values)| {
        let maximum = measure.statistic.is_some_and(HaarStatistic::is_maximum);
        (measure, SideStatistics::of(&values, maximum))
    });
    statistics.collect()
}

/// Values on their way to a [`Spread`].
#[derive(Debug, Clone, Copy, Default)]
struct Gathered {
    sum: f64,
    count: usize,
    extremes: Option<(f64, f64)>,
}

impl Gathered {
    fn add(&mut self, value: Option<f64>) {
        let Some(value) = value else { return };
        let (min, max) = self.extremes.unwrap_or((value, value));
        self.extremes = Some((min.min(value), max.max(value)));
        self.sum += value;
        self.count += 1;
    }

    /// `None` without a value.
    fn spread(&self) -> Option<Spread> {
        self.extremes.map(|(min, max)| Spread { mean: self.sum / self.count as f64, min, max })
    }
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
        let found = || report.frames.iter().filter_map(|frame| frame.atd.as_ref());
        let mut gathered: Sides<Gathered> = Sides::default();
        for atd in found() {
            if let (Some(reference), Some(test)) = (atd.reference.whole.mean, atd.test.whole.mean) {
                gathered.reference.add(Some(reference));
                gathered.test.add(Some(test));
            }
        }
        let frames = gathered.test.count;
        let sides = gathered.map(|values| values.spread().map(|spread| spread.mean));
        let left_out = |side: fn(&Sides<AtdFrame>) -> &AtdFrame| {
            let sum = |of: fn(&AtdFrame) -> u64| found().map(|atd| of(side(atd))).sum::<u64>();
            let pixels = sum(|atd| atd.pixels);
            (pixels > 0).then(|| sum(AtdFrame::left_out) as f64 / pixels as f64)
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
            left_out: left_out(|atd| &atd.reference),
            left_out_test: left_out(|atd| &atd.test).filter(|_| own),
            frames,
            motion: guides.motion,
            depth: guides.depth,
            reason: reason.map(str::to_owned),
        }
    }
}

fn pooled(metric: Metric, frames: &[FrameResult]) -> Option<f64> {
    match metric {
        Metric::Psnr => pooled_psnr(frames.iter().map(|f| (f.scores.mse, f.scores.pixels))),
        Metric::PuPsnr => pooled_psnr(frames.iter().map(|f| {
            let error = f.scores.scores.get(&metric).map(|db| mse_of_db(*db));
            (error, f.scores.pixels)
        })),
        Metric::Fpsnr => {
            let sums = |f: &FrameResult| -> Option<(f64, f64)> {
                let scores: &PairScores = &f.scores;
                scores.weighted_squared_error
            };
            let (squared, weight) = frames
                .iter()
                .filter_map(sums)
                .fold((0.0, 0.0), |(a, b), (squared, weight)| (a + squared, b + weight));
            (weight > 0.0).then(|| psnr_db(squared / weight))
        }
        _ => None,
    }
}

/// PSNR of the error pooled over frames of `(mse, pixels)`.
fn pooled_psnr(frames: impl Iterator<Item = (Option<f64>, u64)>) -> Option<f64> {
    let (squared, pixels) = frames
        .filter_map(|(mse, pixels)| Some((mse? * pixels as f64, pixels)))
        .fold((0.0, 0u64), |(a, b), (squared, pixels)| (a + squared, b + pixels));
    (pixels > 0).then(|| psnr_db(squared / pixels as f64))
}

impl Statistics {
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

    #[test]
    fn pooled_is_of_the_error_not_of_the_decibels() {
        let frames = [(Some(0.01), 100), (Some(0.0), 300), (None, 7)].into_iter();
        let pooled = pooled_psnr(frames).unwrap();
        assert!((pooled - psnr_db(0.0025)).abs() < 1e-12);
    }
}
