//! Foveated SSIM: the SSIM map with FPSNR's weight, Σ f² map / Σ f² over the pixels where the map
//! is defined. This metric is our own. It is in [-1, 1], and higher is better.

use crate::info::{Demand, MetricInfo, Needs};
use crate::metric_params::MetricParams;

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "fssim",
    label: "FSSIM",
    needs: Needs { view: true, foveal_weight: Demand::Needs, ..Needs::NOTHING },
    about: "the SSIM map weighted as in FPSNR",
    source: "a definition of fovqa: the map of ssim with the weight of fpsnr",
    ..MetricInfo::FIDELITY
};

/// FSSIM has no parameters of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Params;

impl MetricParams for Params {
    fn smallest_side(&self, ssim_window: usize) -> usize {
        ssim_window
    }
}
