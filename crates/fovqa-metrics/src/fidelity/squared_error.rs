//! MSE and PSNR: the squared error of all channels, pooled, over the frame and per band.
//!
//! MSE = mean over pixels and channels of (a - b)², PSNR = -10 log10 MSE dB, both of the
//! display-encoded signal with peak 1. Decibels are never averaged over channels.
//! MSE in [0, 1], lower is better; PSNR in [0, ∞], higher is better.

use multiversion::multiversion;

/// PSNR in dB of a mean squared error with peak 1; infinite for 0.
pub fn psnr_db(mse: f64) -> f64 {
    // Subtracted from 0, so that an error of 1 gives 0 dB and not -0.
    if mse == 0.0 { f64::INFINITY } else { 0.0 - 10.0 * libm::log10(mse) }
}

/// The mean squared error, with peak 1, that has a PSNR.
pub fn mse_of_db(psnr_db: f64) -> f64 {
    libm::pow(10.0, -psnr_db / 10.0)
}

/// The squared error of one row, summed over its planes. Exact for 8-bit codes.
pub(crate) fn squared_row(differences: &[&[f32]], out: &mut [f32]) {
    match differences {
        [r, g, b] => three(r, g, b, out),
        [gray] => one(gray, out),
        _ => unreachable!("a signal has one plane or three"),
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn three(r: &[f32], g: &[f32], b: &[f32], out: &mut [f32]) {
    for (((out, r), g), b) in out.iter_mut().zip(r).zip(g).zip(b) {
        *out = r * r + g * g + b * b;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn one(gray: &[f32], out: &mut [f32]) {
    for (out, v) in out.iter_mut().zip(gray) {
        *out = v * v;
    }
}
