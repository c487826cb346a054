//! SSIM (Wang, Bovik, Sheikh, Simoncelli 2004, Eq. 13).
//!
//! ```text
//! SSIM = (2 μ_a μ_b + C1)(2 σ_ab + C2) / ((μ_a² + μ_b² + C1)(σ_a² + σ_b² + C2))
//! ```
//!
//! The window is Gaussian (σ 1.5 px, radius 5), C = (K L)², and moments are those of the
//! population. The input is the display-encoded signal. The map is defined where the window fits,
//! and the score is its mean; with `rgb` it is the mean of the channels' scores. It is in [-1, 1],
//! and higher is better.
//!
//! The moments are computed from those of u = a + b and v = a - b, of which four are enough: 2 μ_a
//! μ_b = (μ_u² - μ_v²) / 2, μ_a² + μ_b² = (μ_u² + μ_v²) / 2, and the same for the variances. For
//! equal pictures v is 0 and every quotient exactly 1.

pub(crate) mod rows;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::info::MetricInfo;
use crate::map::{MapInfo, MapScale};
use crate::metric_params::MetricParams;
use crate::pooling::{Pooling, Statistic, Weight};

/// The statistic by which bands are pooled: the number of pixels of the band that have a value in
/// the map.
pub(crate) const MAP_PIXELS: &str = "map_pixels";

/// SSIM around each pixel where the window fits, as the mean over channels.
pub(crate) const MAP: MapInfo = MapInfo {
    name: "ssim",
    label: "SSIM",
    unit: None,
    block: 1,
    about: "SSIM around each pixel, mean over channels; coloured from 1 (identical) to 0",
    bright: "worse",
    scale: MapScale::Linear { none: 1.0, most: 0.0 },
};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "ssim",
    label: "SSIM",
    per_band: true,
    statistics: &[
        Statistic::VALUE
            .over_bands(Pooling::WeightedMean)
            .weighted_by(Weight::Statistic(MAP_PIXELS)),
        Statistic::count(MAP_PIXELS),
    ],
    map: Some(&MAP),
    about: "structural similarity, the mean of its map where the window fits",
    source: "Wang, Bovik, Sheikh, Simoncelli 2004",
    params: &[
        ParamInfo {
            name: "sigma",
            default: "1.5",
            values: ParamValues::Number(MIN_SIGMA, MAX_SIGMA),
            about: "standard deviation of the Gaussian window, px (also for MS-SSIM and FSSIM)",
        },
        ParamInfo {
            name: "radius",
            default: "\"auto\"",
            values: ParamValues::WholeOr(1, MAX_RADIUS, "auto"),
            about: "window radius, px; auto is 3.5 sigma, rounded (5)",
        },
        ParamInfo {
            name: "k1",
            default: "0.01",
            values: ParamValues::Number(MIN_K1, 1.0),
            about: "stabiliser of the means",
        },
        ParamInfo {
            name: "k2",
            default: "0.03",
            values: ParamValues::Number(MIN_K2, 1.0),
            about: "stabiliser of the variances",
        },
    ],
    ..MetricInfo::FIDELITY
};

/// Window and constants.
#[derive(Debug, Clone, PartialEq)]
pub struct Params {
    /// Standard deviation of the Gaussian window in pixels.
    pub sigma: f64,
    /// Radius of the window; `None` means 3.5 sigma, rounded, as scikit-image truncates it.
    pub radius: Option<usize>,
    /// K1 of C1 = (K1 L)².
    pub k1: f64,
    /// K2 of C2 = (K2 L)².
    pub k2: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { sigma: 1.5, radius: None, k1: 0.01, k2: 0.03 }
    }
}

/// The smallest K1: the means that it stabilises lose no precision.
pub(crate) const MIN_K1: f64 = 1e-3;

/// The smallest K2: C2 = 1e-4 of peak² stays far above the rounding error of a window's mean.
pub(crate) const MIN_K2: f64 = 1e-2;

/// Largest radius of the window.
pub(crate) const MAX_RADIUS: u32 = 224;

/// The largest standard deviation: its window of 3.5 sigma still has a radius of `MAX_RADIUS`.
pub(crate) const MAX_SIGMA: f64 = 64.0;

/// The smallest standard deviation: below it, the window is one pixel.
pub(crate) const MIN_SIGMA: f64 = 0.1;

impl MetricParams for Params {
    fn smallest_side(&self, ssim_window: usize) -> usize {
        ssim_window
    }

    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "sigma" => self.sigma = value.number()?,
            "radius" if value.text() == Some("auto") => self.radius = None,
            "radius" => {
                self.radius = Some(value.number()? as usize);
            }
            "k1" => self.k1 = value.number()?,
            "k2" => self.k2 = value.number()?,
            _ => return None,
        }
        Some(())
    }
}

impl Params {
    /// Radius of the window in pixels.
    pub fn window_radius(&self) -> usize {
        let auto = (3.5 * self.sigma + 0.5) as usize;
        self.radius.unwrap_or(auto.clamp(1, MAX_RADIUS as usize))
    }

    /// The side of the window in pixels, which is the smallest image that it fits into.
    pub fn window_side(&self) -> usize {
        2 * self.window_radius() + 1
    }

    /// The window's weights from its centre outwards. The weights of the whole window add up to 1.
    pub(crate) fn taps(&self) -> Vec<f32> {
        let weight = |k: usize| {
            let k = k as f64;
            libm::exp(-k * k / (2.0 * self.sigma * self.sigma))
        };
        let radius = self.window_radius();
        let total = weight(0) + 2.0 * (1..=radius).map(weight).sum::<f64>();
        (0..=radius).map(|k| (weight(k) / total) as f32).collect()
    }
}
