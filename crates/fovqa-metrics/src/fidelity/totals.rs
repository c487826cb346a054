//! Converts the sums of a pass to the rows of each metric.

use super::pass::Sums;
use super::weighted_mean::WeightedMean;
use crate::decibels::psnr_db;
use crate::pooling::Parts;
use crate::row::{Key, Rows, Subject};

/// The sums over a frame, and their divisors.
pub(crate) struct Totals<'a> {
    pub(crate) sums: &'a Sums,
    /// The number of pixels that count: in each band, then outside all bands.
    pub(crate) pixels: &'a [u64],
    pub(crate) planes: f64,
    pub(crate) peak: f64,
}

impl Totals<'_> {
    fn bands(&self) -> usize {
        self.pixels.len() - 1
    }

    /// Adds the squared error of all pixels and of each band; `of` converts the mean to the
    /// metric's value.
    pub(crate) fn squared_error(&self, key: Key, of: impl Fn(f64) -> f64, rows: &mut Rows) {
        let Self { sums, planes, peak, .. } = *self;
        let mut add = |key: Key, sum: f64, pixels: u64| {
            // There is a single rounding: sums of integer codes and their divisors are exact.
            let mean = || sum / (planes * pixels as f64 * peak * peak);
            let parts = Parts::Mean { sum: sum / (planes * peak * peak), weight: pixels as f64 };
            rows.push(key, (pixels > 0).then(|| of(mean())), parts);
        };
        add(key, sums.squared.iter().sum(), self.pixels.iter().sum());
        for (band, sum) in sums.squared[..self.bands()].iter().enumerate() {
            add(key.in_band(band), *sum, self.pixels[band]);
        }
    }

    /// Adds FPSNR; `None` if there is no weight at all.
    pub(crate) fn weighted_squared_error(&self, key: Key, rows: &mut Rows) -> Option<()> {
        let scale = self.planes * self.peak * self.peak;
        let mean = self.sums.weighted_squared.mean()? / scale;
        let WeightedMean { weighted, weight } = self.sums.weighted_squared;
        rows.push(key, Some(psnr_db(mean)), Parts::Mean { sum: weighted / scale, weight });
        Some(())
    }

    /// Adds SSIM of all windows and of each band. Returns whether there is any window.
    pub(crate) fn ssim(&self, key: Key, rows: &mut Rows) -> bool {
        let mut add = |key: Key, sum: f64, windows: u64| {
            let value = (windows > 0).then(|| sum / (self.planes * windows as f64));
            let parts = Parts::Mean { sum: sum / self.planes, weight: windows as f64 };
            rows.push(key, value, parts);
        };
        let windows: u64 = self.sums.windows.iter().sum();
        if windows > 0 {
            add(key, self.sums.ssim.iter().sum(), windows);
        }
        for (band, sum) in self.sums.ssim[..self.bands()].iter().enumerate() {
            add(key.in_band(band), *sum, self.sums.windows[band]);
        }
        for (band, windows) in self.sums.windows[..self.bands()].iter().enumerate() {
            rows.count(key.nth(1).in_band(band), *windows);
        }
        windows > 0
    }

    /// Adds foveated SSIM; `None` if there is no window.
    pub(crate) fn weighted_ssim(&self, key: Key, rows: &mut Rows) -> Option<()> {
        rows.score(key, self.sums.weighted_ssim.mean()? / self.planes);
        Some(())
    }

    /// Adds the numbers of pixels that count, in each band and outside all bands, and of those that
    /// a mask leaves out.
    pub(crate) fn count(&self, left_out: u64, rows: &mut Rows) {
        if let [bands @ .., outside] = self.pixels
            && !bands.is_empty()
        {
            for (band, pixels) in bands.iter().enumerate() {
                rows.count(Key::pixels(Subject::Pixels).in_band(band), *pixels);
            }
            rows.count(Key::pixels(Subject::PixelsOutsideBands), *outside);
        }
        rows.count(Key::pixels(Subject::PixelsLeftOut), left_out);
    }
}
