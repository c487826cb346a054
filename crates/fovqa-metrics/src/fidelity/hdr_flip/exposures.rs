//! The exposures at which HDR-FLIP compares, from the luminance of the reference.

use fovqa_frame::{LightKind, LightSignal, map_row_blocks};

use super::Params;
use super::tonemap::LUMINANCE;
use crate::fidelity::score_error::ScoreError;
use crate::metric::Metric;
use crate::pair_input::PairInput;
use crate::regions::clipped;
use crate::row::Image;

/// Equal steps of exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Exposures {
    /// The first and the last exposure, in stops.
    pub(super) start: f64,
    pub(super) stop: f64,
    pub(super) count: usize,
}

/// The largest number of exposures.
pub(super) const MOST: usize = 128;

impl Exposures {
    /// The exposures for a pair.
    pub(super) fn new(params: &Params, input: &PairInput<'_>) -> Result<Self, ScoreError> {
        let (start, stop) = match (params.start, params.stop) {
            (Some(start), Some(stop)) => (start, stop),
            (start, stop) => {
                let [darkest, brightest] = automatic(params, input)?;
                (start.unwrap_or(darkest), stop.unwrap_or(brightest))
            }
        };
        if start > stop {
            let reason =
                format!("its first exposure, {start:.2} stops, is above the last, {stop:.2} stops");
            let help = "give both hdr_flip.start and hdr_flip.stop";
            return Err(unfit(Image::Reference, reason, help));
        }
        let auto = (stop - start).ceil().clamp(2.0, MOST as f64) as usize;
        Ok(Self { start, stop, count: params.exposures.unwrap_or(auto) })
    }

    /// The root of the gain of an exposure: 2 to half the stops. The gain itself may be beyond the largest `f32`.
    pub(super) fn root_of_gain(&self, index: usize) -> f32 {
        let step = (self.stop - self.start) / (self.count - 1) as f64;
        libm::exp2(f64::midpoint(self.start + index as f64 * step, 0.0)) as f32
    }
}

pub(super) fn unfit(image: Image, reason: String, help: &'static str) -> ScoreError {
    ScoreError::Unfit { metric: Metric::HdrFlip, image, reason, help }
}

/// The exposure at which the brightest pixel of the reference is bright, and the one at which half of its pixels
/// are brighter.
fn automatic(params: &Params, input: &PairInput<'_>) -> Result<[f64; 2], ScoreError> {
    let mut luminance = luminance(input);
    let middle = luminance.len() / 2;
    if luminance.is_empty() {
        return Err(ScoreError::NothingLeft);
    }
    let (_, median, brighter) = luminance.select_nth_unstable_by(middle, f32::total_cmp);
    let (median, most) = (f64::from(*median), brighter.iter().copied().fold(*median, f32::max));
    if median <= 0.0 {
        return Err(unfit(
            Image::Reference,
            "half of the reference is black, so there is no median to expose for".to_owned(),
            "give hdr_flip.start and hdr_flip.stop",
        ));
    }
    let bright = params.tonemap.of_bright();
    Ok([f64::from(most), median].map(|value| libm::log2(bright / value)))
}

/// The luminance of all pixels of the reference that count.
fn luminance(input: &PairInput<'_>) -> Vec<f32> {
    let light = LightSignal::new(input.reference, input.tables, LightKind::Scene);
    let width = light.width();
    let rows = map_row_blocks(light.height(), |rows| {
        let mut found = Vec::with_capacity(rows.len() * width);
        let mut planes: [Vec<f32>; 3] = std::array::from_fn(|_| vec![0.0; width]);
        for y in rows {
            let [r, g, b] = &mut planes;
            light.fill(y, 0..width, [r, g, b]);
            let [r, g, b] = &planes;
            let [wr, wg, wb] = LUMINANCE;
            for (from, to, _) in clipped(input.regions.pixel_runs(y), 0..width) {
                found.extend((from..to).map(|x| wr * r[x] + wg * g[x] + wb * b[x]));
            }
        }
        found
    });
    rows.concat()
}
