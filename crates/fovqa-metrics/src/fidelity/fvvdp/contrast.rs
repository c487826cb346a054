//! Contrast: the difference of a level and its low-pass, relative to the background. The background
//! is the low-pass of the sustained reference; test and transient channel use it as well. Contrast
//! is at most 1000, and the background at least 0.1 cd/m²; negative contrast has no limit.
//!
//! The code avoids divisions: differences stay in cd/m² and are limited to 1000 times the
//! background, and the logarithm of the background becomes part of the gain.

use multiversion::multiversion;

use super::calibration::{DARKEST_BACKGROUND_CD_M2, MAX_CONTRAST};
use crate::log_exp::log2;

/// The background of a row from the expanded reference: the limit of differences in cd/m², and the
/// log2 of the background.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn background(expanded: &[f32], limit: &mut [f32], log2_background: &mut [f32]) {
    for ((low_pass, limit), log) in expanded.iter().zip(limit).zip(log2_background) {
        let background = low_pass.max(DARKEST_BACKGROUND_CD_M2);
        *limit = MAX_CONTRAST * background;
        *log = log2(background);
    }
}

/// The limited differences of a row and its low-pass. They replace the low-pass.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn differences(fine: &[f32], limit: &[f32], expanded: &mut [f32]) {
    for ((fine, limit), low_pass) in fine.iter().zip(limit).zip(expanded) {
        *low_pass = (fine - *low_pass).min(*limit);
    }
}

/// Converts log2 of the sensitivity to log2 of the gain that turns differences in cd/m² into
/// multiples of the threshold.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn gain(log2_background: &[f32], log2_of_band: f32, sensitivity: &mut [f32]) {
    for (log, gain) in log2_background.iter().zip(sensitivity) {
        *gain += log2_of_band - log;
    }
}
