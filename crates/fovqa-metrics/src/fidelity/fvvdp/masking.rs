//! Mutual masking: D = |t - r|^2.4 / (1 + (k min(|t|, |r|))^q), at most 10,000. t and r are in
//! multiples of the threshold, and q depends on the temporal channel.
//!
//! Everything is computed in logarithms; t and r themselves are never needed.

use multiversion::multiversion;

use super::calibration::{LOG10_MASK_C, MASK_P, MASK_Q, MAX_DIFFERENCE};
use crate::log_exp::{exp2, log2};

/// log2 of D along a row. Test and reference are in cd/m²; `gain` is log2 of the factor that turns
/// them into multiples of the threshold.
pub(super) fn log2_masked(
    channel: usize,
    (test, reference): (&[f32], &[f32]),
    gain: &[f32],
    out: &mut [f32],
) {
    let k = LOG10_MASK_C * std::f64::consts::LOG2_10;
    let limit = libm::log2(MAX_DIFFERENCE);
    masked([test, reference, gain], [k as f32, MASK_Q[channel] as f32, limit as f32], out);
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn masked([test, reference, gain]: [&[f32]; 3], [log2_k, q, limit]: [f32; 3], out: &mut [f32]) {
    /// Above this, adding 1 to a power of two has no effect, and higher powers may overflow.
    const HIGHEST: f32 = 100.0;
    let n = out.len();
    let (test, reference, gain) = (&test[..n], &reference[..n], &gain[..n]);
    for x in 0..n {
        let (t, r, gain) = (test[x], reference[x], gain[x]);
        let difference = log2((t - r).abs()) + gain;
        let masker = log2(t.abs().min(r.abs())) + gain + log2_k;
        let masking = log2(1.0 + exp2((q * masker).min(HIGHEST)));
        out[x] = (MASK_P as f32 * difference - masking).min(limit);
    }
}

/// The powers D^exponent of a row, from log2 of D.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(super) fn powers(log2_differences: &[f32], exponent: f32, out: &mut [f32]) {
    for (out, log) in out.iter_mut().zip(log2_differences) {
        *out = exp2(log * exponent);
    }
}
