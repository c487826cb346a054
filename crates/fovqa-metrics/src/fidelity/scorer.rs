//! Computes all metrics of one pair in one pass (MS-SSIM adds one pass per scale).

use fovqa_frame::PairSignal;
use fovqa_vision::BandMap;

use super::fpsnr::WeightField;
use super::ms_ssim::{EXPONENTS, PairRows, combine};
use super::pass::{PixelMaps, Scales, Sums, Wanted, WantedMaps, run};
use super::score_error::ScoreError;
use super::scored::Scored;
use super::ssim::rows::Constants;
use super::totals::Totals;
use super::{mse, ssim};
use crate::decibels::psnr_db;
use crate::info::Demand;
use crate::kinds::MetricKind;
use crate::map::MapInfo;
use crate::metric::Metric;
use crate::regions::Regions;
use crate::registry::Params;
use crate::row::{Key, Rows};

/// Computes a set of metrics.
#[derive(Debug, Clone)]
pub struct Scorer {
    metrics: Vec<Metric>,
    params: Params,
    lenient: bool,
    maps: bool,
}

impl Scorer {
    /// A scorer for these metrics.
    pub fn new(metrics: Vec<Metric>, params: Params) -> Self {
        Self { metrics, params, lenient: false, maps: false }
    }

    /// A scorer that leaves SSIM out if a mask leaves no window, instead of returning an error. It
    /// is meant for a run that names no metric.
    #[must_use]
    pub fn lenient(self) -> Self {
        Self { lenient: true, ..self }
    }

    /// A scorer that also returns maps, if `maps` is set.
    #[must_use]
    pub fn with_maps(self, maps: bool) -> Self {
        Self { maps, ..self }
    }

    fn wants(&self, metric: Metric) -> bool {
        self.metrics.contains(&metric)
    }

    /// Scores a pair, block by block. Only FPSNR and foveated SSIM need `weight`.
    ///
    /// # Errors
    /// When a metric does not fit the frames or the mask, or has no weight.
    ///
    /// # Panics
    /// When the regions belong to frames of another height.
    pub fn score(
        &self,
        pair: &PairSignal<'_>,
        regions: &Regions<'_>,
        weight: Option<&WeightField>,
    ) -> Result<Scored, ScoreError> {
        let unfit = self.params.unfit(&self.metrics, (pair.width(), pair.height()));
        if let Some((_, error)) = unfit.into_iter().next() {
            return Err(error);
        }
        assert_eq!(regions.rows(), pair.height(), "regions of these frames");
        let whole = self.metrics.iter().copied().find(|metric| metric.info().needs.every_pixel);
        if let Some(metric) = whole.filter(|_| regions.is_masked()) {
            return Err(ScoreError::Masked { metric });
        }
        let foveal =
            self.metrics.iter().copied().find(|m| m.info().needs.foveal_weight == Demand::Needs);
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
            maps: WantedMaps {
                squared_error: self.has_map(&mse::MAP),
                ssim: self.has_map(&ssim::MAP),
            },
        };
        let (sums, scale, maps) = if squared_error || map {
            run(pair, regions, &wanted)
        } else {
            (Sums::new(regions.bands()), None, PixelMaps::default())
        };
        let ms_ssim = scale.map(|scale| {
            let radius = wanted.ssim.as_ref().map_or(0, Constants::radius);
            coarser_scales(&sums, scale, (pair.width(), pair.height()), radius, &wanted)
        });
        let rows = self.finish(pair, regions, &sums, ms_ssim)?;
        let size = (pair.width(), pair.height());
        let maps = [(&mse::MAP, maps.squared_error), (&ssim::MAP, maps.ssim)].into_iter();
        let maps = maps.filter(|(_, values)| !values.is_empty());
        let maps = maps.map(|(map, values)| map.with(size, values)).collect();
        Ok(Scored { maps, ..Scored::of(rows) })
    }

    /// Whether a map is asked for.
    fn has_map(&self, map: &MapInfo) -> bool {
        let has = |metric: &Metric| metric.info().map.is_some_and(|of| of.name == map.name);
        self.maps && self.metrics.iter().any(has)
    }

    fn finish(
        &self,
        pair: &PairSignal<'_>,
        regions: &Regions<'_>,
        sums: &Sums,
        ms_ssim: Option<f64>,
    ) -> Result<Rows, ScoreError> {
        let pixels = regions.pixels();
        if pixels.iter().sum::<u64>() == 0 {
            return Err(ScoreError::NothingLeft);
        }
        let totals = Totals {
            sums,
            pixels: &pixels,
            planes: pair.planes() as f64,
            peak: f64::from(pair.peak()),
        };
        let mut rows = Rows::default();
        totals.count(regions.left_out(), &mut rows);
        for &metric in &self.metrics {
            let (key, no_window) = (Key::of(metric), ScoreError::NoWindow { metric });
            match metric {
                Metric::Mse => totals.squared_error(key, |mse| mse, &mut rows),
                Metric::Psnr => totals.squared_error(key, psnr_db, &mut rows),
                Metric::Fpsnr => {
                    let scored = totals.weighted_squared_error(key, &mut rows);
                    scored.ok_or(ScoreError::NothingLeft)?;
                }
                Metric::Ssim => {
                    let any = totals.ssim(key, &mut rows);
                    if !any && !self.lenient {
                        return Err(no_window);
                    }
                }
                Metric::MsSsim => rows.score(key, ms_ssim.ok_or(no_window)?),
                Metric::Fssim => totals.weighted_ssim(key, &mut rows).ok_or(no_window)?,
                // These metrics are measured elsewhere.
                _ => debug_assert!(!is_of_this_pass(metric), "{metric:?} is measured here"),
            }
        }
        Ok(rows)
    }
}

/// Whether this pass measures a metric. Other metrics have a pass of their own, or need luminance,
/// a single picture or previous frames.
fn is_of_this_pass(metric: Metric) -> bool {
    let info = metric.info();
    info.kind == MetricKind::Fidelity && !metric.has_own_pass() && !info.needs.luminance
}

/// Computes MS-SSIM from the sums of the finest scale and the next scale.
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
            maps: WantedMaps::default(),
        };
        let (sums, next, _) = run(&scale, &Regions::unmasked(&bands), &wanted);
        means.push(sums.channels.map(|s| s / windows(w, h)));
        match next {
            Some(next) => scale = next,
            None => break,
        }
    }
    let channel = |plane: usize| combine(means.iter().map(|means| means[plane]));
    (0..planes).map(channel).sum::<f64>() / planes as f64
}
