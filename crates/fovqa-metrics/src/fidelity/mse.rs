//! MSE, the mean squared error: the mean of (a - b)² over pixels and channels, for the frame and
//! per band.
//!
//! It is computed from the display-encoded signal with peak 1; channels are pooled. It is in [0,
//! 1], and lower is better.

use multiversion::multiversion;

use crate::info::MetricInfo;
use crate::kinds::Better;
use crate::map::{MapInfo, MapScale};
use crate::pooling::{Pooling, Statistic};

/// The squared error of each pixel, as the mean over its channels.
pub(crate) const MAP: MapInfo = MapInfo {
    name: "mse",
    label: "Squared error",
    unit: Some("peak 1"),
    block: 1,
    about: "squared error with peak 1, mean over channels; coloured from 1e-6 (60 dB) to 1",
    bright: "worse",
    scale: MapScale::Logarithmic { none: 1e-6, most: 1.0 },
};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "mse",
    label: "MSE",
    better: Better::Lower,
    per_band: true,
    statistics: &[Statistic::VALUE.pooled(Pooling::WeightedMean)],
    map: Some(&MAP),
    about: "mean squared error of the encoded signal, peak 1",
    source: "the squared error of all channels, pooled",
    ..MetricInfo::FIDELITY
};

pub(crate) use crate::metric_params::NoParams as Params;

/// The squared error of one row, summed over its planes. It is exact for 8-bit codes.
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
