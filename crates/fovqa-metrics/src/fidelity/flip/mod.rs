//! FLIP, the difference that a person sees when two images alternate (Andersson, Nilsson, Akenine-Möller,
//! Oskarsson, Åström, Fairchild 2020; version 1.7 of its program).
//!
//! ```text
//! FLIP = D_c^(1 - D_f)
//! ```
//!
//! D_c is the difference of colours: HyAB in L*a*b*, after filters for the contrast sensitivity of each opponent
//! channel and scaled to 0 to 1. D_f is the difference of features: edges and points of the luminance that has
//! not been filtered. The metric is the mean of the map, from 0 (identical) to 1.
//!
//! The filters depend on the pixels per degree. FLIP assumes that every pixel is looked at, so this is one number
//! for the whole frame: that of the view at its centre. Red, green and blue are compared, whatever
//! the signal's channels are. Pixels that a mask leaves out are black in both pictures.

mod colour;
mod filters;
mod kernels;
pub(crate) mod magma;
mod quartiles;
pub(crate) mod scores;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod tile;

use fovqa_frame::{Frame, LightKind, Transfer, map_plane_blocks};
use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use self::scores::{STATISTICS, Sums, leave_out, statistics};
use self::tile::{Optics, TILE_COLUMNS, Tiles};
use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::info::{Demand, MetricInfo, Needs};
use crate::kinds::Better;
use crate::map::{Map, MapInfo, MapPicture, MapScale};
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pair_input::PairInput;
use crate::pooling::Statistic;
use crate::registry;
use crate::row::Image;

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "flip",
    label: "FLIP",
    better: Better::Lower,
    per_band: true,
    needs: NEEDS,
    statistics: &FLIP,
    map: Some(&MAP),
    about: "difference that is seen when the pictures alternate, of colours and features, 0 to 1",
    source: "Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020",
    params: &[ParamInfo {
        name: "ppd",
        default: "\"auto\"",
        values: ParamValues::NumberOr(SMALLEST_PPD, LARGEST_PPD, "auto"),
        about: "pixels per degree (also for HDR-FLIP); auto: those of the view",
    }],
    ..MetricInfo::FIDELITY
};

const FLIP: [Statistic; STATISTICS] = statistics("flip_min", "flip_max", "fflip");

/// A view is not needed, but with it there are bands and a mean with the foveal weight.
pub(crate) const NEEDS: Needs = Needs { foveal_weight: Demand::Takes, ..Needs::NOTHING };

const SMALLEST_PPD: f64 = 1e-3;
const LARGEST_PPD: f64 = 1e4;

/// The pixels per degree without a view: those of a screen 0.7 m wide with 3840 pixels, at a distance of
/// 0.7 m.
const DESKTOP_PPD: f64 = 67.020_6;

/// The warning that goes with it.
const NO_VIEW: &str = "FLIP is computed for 67.02 pixels per degree, a 4K screen of 0.7 m seen from 0.7 m: \
     give a view, or the pixels per degree with flip.ppd";

/// FLIP of each pixel.
const MAP: MapInfo = MapInfo {
    name: "flip",
    label: "FLIP",
    unit: None,
    block: 1,
    about: "FLIP of each pixel; coloured from 0 (identical) to 1",
    bright: "worse",
    scale: MapScale::Linear { none: 0.0, most: 1.0 },
};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Params {
    /// Pixels per degree; `None` means those of the view.
    pub ppd: Option<f64>,
}

impl MetricParams for Params {
    const HAS_OWN_PASS: bool = true;

    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "ppd" => self.ppd = value.number(),
            _ => return None,
        }
        Some(())
    }

    fn measure(
        &self,
        _all: &registry::Params,
        input: &PairInput<'_>,
    ) -> Option<Result<Scored, ScoreError>> {
        Some(measure(self, input))
    }
}

impl Params {
    /// The pixels per degree of a pair, and a warning if nothing says them.
    pub(crate) fn pixels_per_degree(
        &self,
        metric: Metric,
        input: &PairInput<'_>,
    ) -> Result<(f64, Option<&'static str>), ScoreError> {
        let seen = match (self.ppd, input.eccentricity) {
            (Some(given), _) => return Ok((given, None)),
            (None, None) => return Ok((DESKTOP_PPD, Some(NO_VIEW))),
            (None, Some(eccentricity)) => eccentricity.view().pixels_per_degree(),
        };
        // The kernels of a view through a keyhole would not fit into memory.
        if !(SMALLEST_PPD..=LARGEST_PPD).contains(&seen) {
            return Err(ScoreError::Unfit {
                metric,
                image: Image::Pair,
                reason: format!("the view has {seen:.3e} pixels per degree"),
                help: "check the view, or give flip.ppd, 0.001 to 10000",
            });
        }
        Ok((seen, None))
    }
}

/// Measures a pair.
fn measure(params: &Params, input: &PairInput<'_>) -> Result<Scored, ScoreError> {
    let signal = input.tables.params();
    let frames = [(Image::Reference, input.reference), (Image::Test, input.test)];
    let is_pq = |frame: &Frame| signal.transfer_of(frame) == Transfer::Pq;
    if let Some((image, _)) = frames.into_iter().find(|(_, frame)| is_pq(frame)) {
        return Err(ScoreError::Unfit {
            metric: Metric::Flip,
            image,
            reason: "PQ codes are absolute luminance, for which it is not defined".to_owned(),
            help: "use hdr_flip with linear frames",
        });
    }
    let (pixels_per_degree, warning) = params.pixels_per_degree(Metric::Flip, input)?;
    let optics = Optics::new(pixels_per_degree);
    let (width, height) = (input.reference.width(), input.reference.height());
    let mut values = vec![0.0; width * height];
    let blocks = map_plane_blocks(&mut values, width, |rows, values| {
        let mut tiles = Tiles::new(input, LightKind::Displayed, &optics);
        let mut sums = Sums::new(input);
        let mut scratch = [0.0; TILE_COLUMNS];
        for x in (0..width).step_by(TILE_COLUMNS) {
            let columns = x..(x + TILE_COLUMNS).min(width);
            tiles.read(rows.clone(), columns.clone());
            tiles.map(None, |y, row| {
                sums.add(input, (x, y), row, &mut scratch[..columns.len()]);
                leave_out(input, (x, y), row);
                let start = (y - rows.start) * width;
                values[start + x..start + columns.end].copy_from_slice(row);
            });
        }
        sums
    });
    let sums = Sums::of(input, &blocks);
    let rows = sums.rows(Metric::Flip, input, &values, pixels_per_degree)?;
    let map = input.map.then(|| coloured_map(&MAP, (width, height), values));
    Ok(Scored {
        maps: map.into_iter().collect(),
        warnings: warning.into_iter().collect(),
        ..Scored::of(rows)
    })
}

/// A map with its picture in the colours of FLIP's program.
pub(crate) fn coloured_map(info: &'static MapInfo, size: (usize, usize), values: Vec<f32>) -> Map {
    let picture = MapPicture { name: "magma", codes: magma::coloured(&values) };
    Map { pictures: vec![picture], ..info.with(size, values) }
}
