//! Means, extremes and pooled forms over the frames of a run.

use std::collections::BTreeMap;

use fovqa_metrics::{Metric, PairScores, psnr_db};

use crate::report::{FrameResult, ScoreReport};

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
                let per_band = report.metrics.iter().filter(|m| m.info().per_band);
                let statistics = per_band.map(|&metric| {
                    let values = bands.iter().filter_map(|b| b.scores.get(&metric).copied()?);
                    let pooled = pooled_psnr(metric, bands.iter().map(|b| (b.mse, b.pixels)));
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
        Self { statistics, bands }
    }
}

fn pooled(metric: Metric, frames: &[FrameResult]) -> Option<f64> {
    match metric {
        Metric::Psnr => pooled_psnr(metric, frames.iter().map(|f| (f.scores.mse, f.scores.pixels))),
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
fn pooled_psnr(metric: Metric, frames: impl Iterator<Item = (Option<f64>, u64)>) -> Option<f64> {
    if metric != Metric::Psnr {
        return None;
    }
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
        let pooled = pooled_psnr(Metric::Psnr, frames).unwrap();
        assert!((pooled - psnr_db(0.0025)).abs() < 1e-12);
    }
}
