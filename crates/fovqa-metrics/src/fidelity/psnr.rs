//! PSNR, the peak signal-to-noise ratio: -10 log10 MSE dB of the display-encoded signal with peak
//! 1.
//!
//! Decibels are never averaged over channels. It is in [0, ∞], and higher is better; it is infinite
//! for identical pictures.

use super::mse;
use crate::info::MetricInfo;
use crate::pooling::{Pooling, Statistic};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "psnr",
    label: "PSNR",
    unit: "dB",
    per_band: true,
    statistics: &[Statistic::VALUE.pooled(Pooling::Decibels).over_frames(Pooling::Decibels)],
    map: Some(&mse::MAP),
    about: "peak signal-to-noise ratio, -10 log10 MSE",
    source: "as scikit-image's peak_signal_noise_ratio",
    ..MetricInfo::FIDELITY
};

pub(crate) use crate::metric_params::NoParams as Params;
