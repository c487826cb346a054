//! PSNR, the peak signal-to-noise ratio: -10 log10 MSE dB of the display-encoded signal with peak 1.
//!
//! Decibels are never averaged over channels. In [0, ∞], higher is better; infinite for identical pictures.

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

pub(crate) use crate::info::NoParams as Params;

/// PSNR in dB of a mean squared error with peak 1; infinite for 0.
pub(crate) fn psnr_db(mse: f64) -> f64 {
    // Subtracted from 0, so that an error of 1 gives 0 dB and not -0.
    if mse == 0.0 { f64::INFINITY } else { 0.0 - 10.0 * libm::log10(mse) }
}

/// The mean squared error, with peak 1, that has a PSNR.
pub(crate) fn mse_of_db(psnr_db: f64) -> f64 {
    libm::pow(10.0, -psnr_db / 10.0)
}
