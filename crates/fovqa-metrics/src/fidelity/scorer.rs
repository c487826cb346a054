//! All metrics of one pair, from one pass (and, for MS-SSIM, one a scale).

use std::collections::BTreeMap;

use fovqa_frame::PairSignal;
use fovqa_vision::BandMap;
use thiserror::Error;

use super::fpsnr::WeightField;
use super::ms_ssim::{EXPONENTS, PairRows, combine};
use super::pass::{Scales, Sums, Wanted, run};
use super::psnr::psnr_db;
use super::ssim::rows::Constants;
use crate::regions::Regions;
use crate::registry::Metric;
use crate::registry::Params;

/// A pair that a metric cannot score.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScoreError {
    /// A picture smaller than the metric's window.
    #[error("{} needs {needed} pixels on each side; the frame has {width}x{height}", metric.info().label)]
    TooSmall {
        /// The metric.
        metric: Metric,
        /// Width of the frame.
        width: usize,
        /// Height of the frame.
        height: usize,
        /// Smallest side.
        needed: usize,
    },
    /// A metric that is not defined where pixels are left out.
    #[error("{} is not defined where pixels are left out", metric.info().label)]
    Masked {
        /// The metric.
        metric: Metric,
    },
    /// A mask without a pixel.
    #[error("the mask leaves no pixel to score")]
    NothingLeft,
    /// A mask without a whole window.
    #[error("the mask leaves no whole window for {}", metric.info().label)]
    NoWindow {
        /// The metric.
        metric: Metric,
    },
    /// A foveal metric without a weight.
    #[error("{} needs a view", metric.info().label)]
    NoView {
        /// The metric.
        metric: Metric,
    },
}

/// Scores of one band.
#[derive(Debug, Clone, PartialEq)]
pub struct BandScores {
    /// Pixels in the band.
    pub pixels: u64,
    /// Mean squared error, peak 1, where MSE or PSNR is asked for: sequences pool it.
    pub mse: Option<f64>,
    /// Its pixels that have a value in the SSIM map, where SSIM is asked for: several bands are pooled
    /// by them.
    pub ssim_map_pixels: Option<u64>,
    /// Its scores; `None` where no pixel, or no window, is in it.
    pub scores: BTreeMap<Metric, Option<f64>>,
}

/// Scores of one pair of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct PairScores {
    /// Whole-frame scores.
    pub scores: BTreeMap<Metric, f64>,
    /// One entry a band.
    pub bands: Vec<BandScores>,
    /// Pixels that count, in all.
    pub pixels: u64,
    /// Pixels that count but lie outside all bands.
    pub outside_bands: u64,
    /// Pixels a mask left out.
    pub left_out: u64,
    /// Mean squared error, peak 1, where MSE or PSNR is asked for: sequences pool it.
    pub mse: Option<f64>,
    /// Σ f² d² and Σ f² of FPSNR, peak 1: sequences pool it.
    pub weighted_squared_error: Option<(f64, f64)>,
}

/// Computes a set of metrics.
#[derive(Debug, Clone)]
pub struct Scorer {
    metrics: Vec<Metric>,
    params: Params,
    lenient: bool,
}

impl Scorer {
    /// A scorer for these metrics.
    pub fn new(metrics: Vec<Metric>, params: Params) -> Self {
        Self { metrics, params, lenient: false }
    }

    /// The same, but where a mask leaves no window, SSIM is left out of the scores instead of being
    /// an error: for a run that names no metric.
    #[must_use]
    pub fn lenient(self) -> Self {
        Self { lenient: true, ..self }
    }

    /// The metrics.
    pub fn metrics(&self) -> &[Metric] {
        &self.metrics
    }

    /// Radius of the windows whose every pixel has to count.
    pub fn window_radius(&self) -> usize {
        self.params.ssim.window_radius()
    }

    fn wants(&self, metric: Metric) -> bool {
        self.metrics.contains(&metric)
    }

    /// The metrics that do not fit frames of this size, and why.
    pub fn unfit(&self, width: usize, height: usize) -> Vec<(Metric, ScoreError)> {
        let needed = |metric: Metric| (metric.info().smallest_side)(&self.params);
        self.metrics
            .iter()
            .filter(|metric| width.min(height) < needed(**metric))
            .map(|&metric| {
                let needed = needed(metric);
                (metric, ScoreError::TooSmall { metric, width, height, needed })
            })
            .collect()
    }

    /// Scores a pair. `weight` is needed by FPSNR and foveated SSIM alone.
    ///
    /// # Errors
    /// When a metric does not fit the frames or the mask, or has no weight.
    ///
    /// # Panics
    /// When the regions are of frames of another height.
    pub fn score(
        &self,
        pair: &PairSignal<'_>,
        regions: &Regions<'_>,
        weight: Option<&WeightField>,
    ) -> Result<PairScores, ScoreError> {
        if let Some((_, error)) = self.unfit(pair.width(), pair.height()).into_iter().next() {
            return Err(error);
        }
        assert_eq!(regions.rows(), pair.height(), "regions of these frames");
        let whole = self.metrics.iter().copied().find(|metric| metric.info().needs.every_pixel);
        if let Some(metric) = whole.filter(|_| regions.is_masked()) {
            return Err(ScoreError::Masked { metric });
        }
        let foveal = self.metrics.iter().copied().find(|m| m.info().needs.foveal_weight);
        if let (Some(metric), None) = (foveal, weight) {
            return Err(ScoreError::NoView { metric });
        }
        let squared_error =
            [Metric::Mse, Metric::Psnr, Metric::Fpsnr].into_iter().any(|m| self.wants(m));
        let map = [Metric::Ssim, Metric::MsSsim, Metric::Fssim].into_iter().any(|m| self.wants(m));
        let wanted = Wanted {
            squared_error,
            weight: weight.filter(|_| foveal.is_some()),
            ssim: map.then(|| Constants::new(&self.params.ssim, pair.peak())),
            scales: if self.wants(Metric::MsSsim) { Scales::AndNext } else { Scales::None },
        };
        let (sums, scale) = if squared_error || map {
            run(pair, regions, &wanted)
        } else {
            (Sums::new(regions.bands()), None)
        };
        let ms_ssim = scale.map(|scale| {
            let radius = wanted.ssim.as_ref().map_or(0, Constants::radius);
            coarser_scales(&sums, scale, (pair.width(), pair.height()), radius, &wanted)
        });
        self.finish(pair, regions, &sums, ms_ssim)
    }

    fn finish(
        &self,
        pair: &PairSignal<'_>,
        regions: &Regions<'_>,
        sums: &Sums,
        ms_ssim: Option<f64>,
    ) -> Result<PairScores, ScoreError> {
        let pixels = regions.pixels();
        let all: u64 = pixels.iter().sum();
        if all == 0 {
            return Err(ScoreError::NothingLeft);
        }
        let planes = pair.planes() as f64;
        let peak = f64::from(pair.peak());
        // One rounding: sums of integer codes, and what divides them, are exact.
        let mse = |squared: f64, pixels: u64| squared / (planes * pixels as f64 * peak * peak);
        let ssim = |sum: f64, windows: u64| sum / (planes * windows as f64);
        let windows: u64 = sums.windows.iter().sum();
        let frame_mse = mse(sums.squared.iter().sum(), all);
        let fmse = sums.weighted_squared.mean().map(|m| m / (planes * peak * peak));

        let mut scores = BTreeMap::new();
        for &metric in &self.metrics {
            let no_window = ScoreError::NoWindow { metric };
            let value = match metric {
                Metric::Mse => frame_mse,
                Metric::Psnr => psnr_db(frame_mse),
                Metric::Fpsnr => psnr_db(fmse.ok_or(ScoreError::NothingLeft)?),
                Metric::Ssim if windows == 0 && self.lenient => continue,
                Metric::Ssim if windows == 0 => return Err(no_window),
                Metric::Ssim => ssim(sums.ssim.iter().sum(), windows),
                Metric::MsSsim => ms_ssim.ok_or(no_window)?,
                Metric::Fssim => sums.weighted_ssim.mean().ok_or(no_window)? / planes,
                // Of light, of one picture, or of two frames: measured elsewhere.
                Metric::Fvvdp
                | Metric::PuPsnr
                | Metric::RmsContrast
                | Metric::Haar
                | Metric::Atd => continue,
            };
            scores.insert(metric, value);
        }
        let asks_mse = [Metric::Mse, Metric::Psnr].iter().any(|m| self.wants(*m));
        let bands = (0..regions.bands())
            .map(|band| {
                let mse = (pixels[band] > 0).then(|| mse(sums.squared[band], pixels[band]));
                let windows = sums.windows[band];
                let ssim = (windows > 0).then(|| ssim(sums.ssim[band], windows));
                let scores = self.metrics.iter().filter_map(|&metric| match metric {
                    Metric::Mse => Some((metric, mse)),
                    Metric::Psnr => Some((metric, mse.map(psnr_db))),
                    Metric::Ssim => Some((metric, ssim)),
                    Metric::MsSsim
                    | Metric::Fpsnr
                    | Metric::Fssim
                    | Metric::Fvvdp
                    | Metric::PuPsnr
                    | Metric::RmsContrast
                    | Metric::Haar
                    | Metric::Atd => None,
                });
                let pooled = mse.filter(|_| asks_mse);
                BandScores {
                    pixels: pixels[band],
                    mse: pooled,
                    ssim_map_pixels: self.wants(Metric::Ssim).then_some(windows),
                    scores: scores.collect(),
                }
            })
            .collect();
        let scale = planes * peak * peak;
        Ok(PairScores {
            scores,
            bands,
            pixels: all,
            outside_bands: pixels[regions.bands()],
            left_out: regions.left_out(),
            mse: asks_mse.then_some(frame_mse),
            weighted_squared_error: self
                .wants(Metric::Fpsnr)
                .then(|| (sums.weighted_squared.weighted / scale, sums.weighted_squared.weight)),
        })
    }
}

/// MS-SSIM from the finest scale's sums and the next scale.
fn coarser_scales(
    finest: &Sums,
    mut scale: super::ms_ssim::Scale,
    (width, height): (usize, usize),
    radius: usize,
    wanted: &Wanted<'_>,
) -> f64 {
    let planes = PairRows::planes(&scale);
    let windows = |w: usize, h: usize| ((w - 2 * radius) * (h - 2 * radius)) as f64;
    let mut means = vec![finest.channels.map(|s| s / windows(width, height))];
    for level in 1..EXPONENTS.len() {
        let last = level + 1 == EXPONENTS.len();
        let (w, h) = scale.size();
        let bands = BandMap::without_bands(w, h);
        let wanted = Wanted {
            squared_error: false,
            weight: None,
            ssim: wanted.ssim.clone(),
            scales: if last { Scales::Last } else { Scales::AndNext },
        };
        let (sums, next) = run(&scale, &Regions::unmasked(&bands), &wanted);
        means.push(sums.channels.map(|s| s / windows(w, h)));
        match next {
            Some(next) => scale = next,
            None => break,
        }
    }
    let channel = |plane: usize| combine(means.iter().map(|means| means[plane]));
    (0..planes).map(channel).sum::<f64>() / planes as f64
}
