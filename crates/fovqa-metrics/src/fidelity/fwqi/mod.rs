//! FWQI, the foveated wavelet image quality index (Wang, Bovik, Lu, Kouloheris 2001).
//!
//! ```text
//! FWQI = Σ S |c| Q / Σ S |c|
//! ```
//!
//! over the coefficients c of four levels of the 9/7 wavelet of the reference's luma: LH, HL and HH of each level, and
//! LL of the last. Q is the quality of the 11x11 coefficients around c, from -1 to 1, and S = S_w S_f^2.5 the
//! sensitivity of the eye: S_w to the level and orientation at the centre of the gaze, and S_f to the level's
//! frequency at the coefficient's eccentricity. 1 is identical, and higher is better.
//!
//! The frame is cropped at the right and bottom to a multiple of 16 pixels; only coefficients count whose window fits
//! inside their subband. A black reference has no value. Where the paper leaves a detail open (phase, borders, windows,
//! flat areas), it is our choice.

mod quality;
#[cfg(test)]
mod tests;
mod wavelet;

use fovqa_frame::{Frame, LumaKind, LumaScratch, LumaSignal};
use fovqa_vision::Eccentricity;
use fovqa_vision::acuity::GeislerPerry;
use multiversion::multiversion;
use rayon::prelude::*;

use self::quality::{Qualities, REACH, WINDOW};
use self::wavelet::{Level, Plane, transform};
use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::info::{MetricInfo, Needs};
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pair_input::PairInput;
use crate::pooling::Parts;
use crate::registry;
use crate::row::{Key, Rows};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "fwqi",
    label: "FWQI",
    needs: Needs { view: true, every_pixel: true, ..Needs::NOTHING },
    about: "similarity of wavelet coefficients of luma, weighted by the eye's sensitivity at each eccentricity, 1 if identical; needs sides of 176 px",
    source: "Wang, Bovik, Lu, Kouloheris 2001",
    ..MetricInfo::FIDELITY
};

/// FWQI has no parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Params;

impl MetricParams for Params {
    const HAS_OWN_PASS: bool = true;

    fn smallest_side(&self, _ssim_window: usize) -> usize {
        WINDOW << LEVELS
    }

    fn measure(
        &self,
        _all: &registry::Params,
        input: &PairInput<'_>,
    ) -> Option<Result<Scored, ScoreError>> {
        Some(measure(input))
    }
}

/// The number of levels.
const LEVELS: usize = 4;

/// The warning where there is no value.
const NOTHING: &str =
    "FWQI has no value where the reference is black, or all of it is finer than the eye resolves";

/// The largest value of a coefficient's synthesis function: of LH and HL, and of HH, on each level, and of LL on the
/// last.
const OF_EDGES: [f64; LEVELS] = [0.672_341, 0.413_174, 0.227_267, 0.117_925];
const OF_CORNERS: [f64; LEVELS] = [0.727_095, 0.494_284, 0.286_881, 0.152_145];
const OF_MEANS: f64 = 0.091_401;

/// The factor of the frequency at which the eye is most sensitive, by orientation.
const EDGES: f64 = 1.0;
const CORNERS: f64 = 0.534;
const MEANS: f64 = 1.501;

/// The sensitivity at the gaze to a coefficient with this synthesis function, level and orientation.
fn sensitivity(peak: f64, level: usize, orientation: f64, pixels_per_degree: f64) -> f64 {
    let octaves = libm::log10(libm::exp2(level as f64) * 0.401 * orientation / pixels_per_degree);
    peak / (0.495 * libm::pow(10.0, 0.466 * octaves * octaves))
}

/// The decay of the sensitivity, per degree and cycle per degree, and its exponent.
const DECAY: f64 = 0.0461;
const EXPONENT: f64 = 2.5;

/// Weighted sums over coefficients.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    quality: f64,
    weight: f64,
}

impl Sums {
    fn add(self, other: Self) -> Self {
        Self { quality: self.quality + other.quality, weight: self.weight + other.weight }
    }
}

/// Measures a pair.
fn measure(input: &PairInput<'_>) -> Result<Scored, ScoreError> {
    let metric = Metric::Fwqi;
    let Some(eccentricity) = input.eccentricity else { return Err(ScoreError::NoView { metric }) };
    let pixels_per_degree = eccentricity.view().pixels_per_degree();
    let mut planes = [input.reference, input.test].map(|frame| luma(frame, input));
    let mut sums = Sums::default();
    for level in 1..=LEVELS {
        let [reference, test] = planes.each_ref().map(transform);
        let sensitivity =
            |peak, orientation| sensitivity(peak, level, orientation, pixels_per_degree);
        let edges = sensitivity(OF_EDGES[level - 1], EDGES);
        let corners = sensitivity(OF_CORNERS[level - 1], CORNERS);
        let details = reference.details.iter().zip(&test.details).zip([edges, edges, corners]);
        let mut subbands: Vec<Subband<'_>> = details
            .map(|((reference, test), sensitivity)| Subband { reference, test, sensitivity })
            .collect();
        if level == LEVELS {
            let (reference, test) = (&reference.low, &test.low);
            let sensitivity = sensitivity(OF_MEANS, MEANS);
            subbands.push(Subband { reference, test, sensitivity });
        }
        sums = sums.add(Seen::new(eccentricity, level).sums(&subbands));
        planes = [reference, test].map(|Level { low, .. }| low);
    }
    let value = (sums.weight > 0.0).then(|| sums.quality / sums.weight);
    let mut rows = Rows::default();
    rows.push(Key::of(metric), value, Parts::Value);
    let warnings = if value.is_none() { vec![NOTHING] } else { Vec::new() };
    Ok(Scored { warnings, ..Scored::of(rows) })
}

/// The luma of a frame, cropped to whole blocks of the last level.
fn luma(frame: &Frame, input: &PairInput<'_>) -> Plane {
    let [width, height] = [frame.width(), frame.height()].map(|side| (side >> LEVELS) << LEVELS);
    let signal = LumaSignal::new(frame, input.tables, LumaKind::Luma);
    let mut values = vec![0.0; width * height];
    let rows = values.par_chunks_exact_mut(width).enumerate();
    rows.for_each_init(
        || LumaScratch::new(width),
        |scratch, (y, row)| signal.fill_row(y, 0..width, scratch, row),
    );
    Plane { width, values }
}

/// The coefficients of one orientation on one level.
struct Subband<'a> {
    reference: &'a Plane,
    test: &'a Plane,
    sensitivity: f64,
}

/// How the eye sees the coefficients of a level.
struct Seen<'a> {
    eccentricity: &'a Eccentricity,
    /// Side of a coefficient's block in pixels.
    block: f64,
    /// Frequency of the level, in cycles per degree.
    frequency_cpd: f64,
    /// The eccentricity up to which it is visible.
    farthest_deg: f64,
}

impl<'a> Seen<'a> {
    fn new(eccentricity: &'a Eccentricity, level: usize) -> Self {
        let block = libm::exp2(level as f64);
        let frequency_cpd = eccentricity.view().pixels_per_degree() / block;
        let GeislerPerry { alpha, e2_deg, ct0 } = GeislerPerry::default();
        // The frequency is the cut-off of Geisler and Perry there. It is never above the display's Nyquist frequency.
        let farthest_deg = e2_deg * libm::log(1.0 / ct0) / (alpha * frequency_cpd) - e2_deg;
        Self { eccentricity, block, frequency_cpd, farthest_deg }
    }

    /// S_f^2.5 of a coefficient.
    fn weight(&self, x: usize, y: usize) -> f64 {
        let [x, y] = [x, y].map(|at| (at as f64 + 0.5) * self.block);
        let e = self.eccentricity.at_deg(x, y);
        let visible = e <= self.farthest_deg;
        if visible { libm::exp(-EXPONENT * DECAY * self.frequency_cpd * e) } else { 0.0 }
    }

    /// The sums of all subbands of the level.
    fn sums(&self, subbands: &[Subband<'_>]) -> Sums {
        let Some(Subband { reference, .. }) = subbands.first() else { return Sums::default() };
        let columns = REACH..reference.width - REACH;
        let of_row = |(qualities, quality, weight): &mut Buffers, y: usize| {
            for (x, weight) in columns.clone().zip(weight.iter_mut()) {
                *weight = self.weight(x, y);
            }
            let of_subband = |Subband { reference, test, sensitivity }: &Subband<'_>| {
                qualities.fill([reference, test], y, quality);
                let sums = weighted(&reference.row(y)[columns.clone()], quality, weight);
                Sums { quality: sensitivity * sums.quality, weight: sensitivity * sums.weight }
            };
            subbands.iter().map(of_subband).fold(Sums::default(), Sums::add)
        };
        let row = || vec![0.0; columns.len()];
        let rows: Vec<Sums> = (REACH..reference.height() - REACH)
            .into_par_iter()
            .map_init(|| (Qualities::new(), row(), row()), of_row)
            .collect();
        rows.into_iter().fold(Sums::default(), Sums::add)
    }
}

/// Buffers for a row: sums of windows, their qualities, and the weights of their centres.
type Buffers = (Qualities, Vec<f64>, Vec<f64>);

/// The sums of a row, lane by lane in the same order for any vector width.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn weighted(coefficients: &[f64], quality: &[f64], weight: &[f64]) -> Sums {
    const LANES: usize = 8;
    let mut sums = [[0.0; LANES]; 2];
    let mut add = |lane: usize, c: f64, q: f64, w: f64| {
        let weight = c.abs() * w;
        sums[0][lane] += weight * q;
        sums[1][lane] += weight;
    };
    let (c, c_rest) = coefficients.as_chunks::<LANES>();
    let (q, q_rest) = quality.as_chunks::<LANES>();
    let (w, w_rest) = weight.as_chunks::<LANES>();
    for ((c, q), w) in c.iter().zip(q).zip(w) {
        for i in 0..LANES {
            add(i, c[i], q[i], w[i]);
        }
    }
    for (i, ((c, q), w)) in c_rest.iter().zip(q_rest).zip(w_rest).enumerate() {
        add(i, *c, *q, *w);
    }
    let [quality, weight] = sums.map(|lanes| lanes.iter().sum());
    Sums { quality, weight }
}
