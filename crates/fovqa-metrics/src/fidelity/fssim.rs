//! Foveated SSIM: the SSIM map under FPSNR's weight, Σ f² map / Σ f² over the pixels where the map is
//! defined. Our own, beside FPSNR; in [-1, 1], higher is better.

use crate::info::{MetricInfo, Needs};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "fssim",
    label: "FSSIM",
    needs: Needs { view: true, foveal_weight: true, ..Needs::NOTHING },
    smallest_side: |params| params.ssim.window_side(),
    about: "the SSIM map under FPSNR's weight",
    source: "ours: the map of ssim under the weight of fpsnr",
    ..MetricInfo::FIDELITY
};

pub(crate) use crate::info::NoParams as Params;
