//! Contrast: what a level has over its low-pass, relative to the background, the low-pass of the sustained
//! reference, which test and transient channel share. At most 1000, and at least 0.1 cd/m² of background;
//! negative contrast has no limit.
//!
//! Nothing is divided: differences are kept in cd/m², limited to 1000 times the background, and the
//! logarithm of the background goes into the gain.

use multiversion::multiversion;

use super::calibration::{DARKEST_BACKGROUND_CD_M2, MAX_CONTRAST};
use super::log_exp::log2;

/// The background of a row from the expanded reference: what differences are limited to, cd/m², and its
/// log2.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn background(expanded: &[f32], limit: &mut [f32], log2_background: &mut [f32]) {
    for ((low_pass, limit), log) in expanded.iter().zip(limit).zip(log2_background) {
        let background = low_pass.max(DARKEST_BACKGROUND_CD_M2);
        *limit = MAX_CONTRAST * background;
        *log = log2(background);
    }
}

/// What a row has over its low-pass, within the limits; it takes the place of the low-pass.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn differences(fine: &[f32], limit: &[f32], expanded: &mut [f32]) {
    for ((fine, limit), low_pass) in fine.iter().zip(limit).zip(expanded) {
        *low_pass = (fine - *low_pass).min(*limit);
    }
}

/// From log2 of the sensitivity to log2 of what turns differences in cd/m² into multiples of the threshold.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn gain(log2_background: &[f32], log2_of_band: f32, sensitivity: &mut [f32]) {
    for (log, gain) in log2_background.iter().zip(sensitivity) {
        *gain += log2_of_band - log;
    }
}
