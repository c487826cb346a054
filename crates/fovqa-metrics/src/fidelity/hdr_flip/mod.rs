//! HDR-FLIP, the largest FLIP of a pixel over a range of exposures (Andersson, Nilsson, Shirley,
//! Akenine-Möller 2021; version 1.7 of FLIP's program).
//!
//! Linear frames are exposed, tone-mapped and compared as in FLIP. The range begins where the brightest pixel of the
//! reference is mapped to 0.85, and ends where its median is; there is about one exposure per stop. The metric is the mean
//! of the map, from 0 (identical) to 1. Exposure and tone map of the signal have no effect. Negative samples are 0.

mod exposures;
#[cfg(test)]
mod tests;
mod tonemap;

use std::ops::Range;

use fovqa_frame::{LightKind, Transfer, map_plane_blocks};
use fovqa_params::{ParamError, ParamInfo, ParamValue, ParamValues};

use self::exposures::{Exposures, unfit};
use self::tonemap::Tonemap;
use crate::fidelity::score_error::ScoreError;
use crate::fidelity::scored::Scored;
use crate::info::MetricInfo;
use crate::kinds::Better;
use crate::map::{MapInfo, MapScale};
use crate::metric::Metric;
use crate::metric::flip::scores::{STATISTICS, Sums, leave_out, setting, statistics};
use crate::metric::flip::tile::{Optics, TILE_COLUMNS, Tiles};
use crate::metric::flip::{NEEDS, coloured_map};
use crate::metric_params::MetricParams;
use crate::pair_input::PairInput;
use crate::pooling::Statistic;
use crate::registry;
use crate::row::{Image, Key};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "hdr_flip",
    label: "HDR-FLIP",
    better: Better::Lower,
    per_band: true,
    needs: NEEDS,
    statistics: &HDR_FLIP,
    map: Some(&MAP),
    more_maps: &[&EXPOSURE_MAP],
    about: "largest FLIP of each pixel over a range of exposures, of linear frames, 0 to 1",
    source: "Andersson, Nilsson, Shirley, Akenine-Möller 2021",
    params: &[
        ParamInfo {
            name: "tonemap",
            default: "\"aces\"",
            values: ParamValues::Word(&["aces", "hable", "reinhard"]),
            about: "tone map of each exposure",
        },
        ParamInfo {
            name: "start",
            default: "\"auto\"",
            values: ParamValues::NumberOr(-LARGEST_STOPS, LARGEST_STOPS, "auto"),
            about: "first exposure, stops; auto: the brightest pixel of the reference is mapped to 0.85",
        },
        ParamInfo {
            name: "stop",
            default: "\"auto\"",
            values: ParamValues::NumberOr(-LARGEST_STOPS, LARGEST_STOPS, "auto"),
            about: "last exposure, stops; auto: the median of the reference is mapped to 0.85",
        },
        ParamInfo {
            name: "exposures",
            default: "\"auto\"",
            values: ParamValues::WholeOr(2, exposures::MOST as u32, "auto"),
            about: "number of exposures; auto: one per stop, at least 2",
        },
    ],
    ..MetricInfo::FIDELITY
};

/// The largest exposure in either direction.
const LARGEST_STOPS: f64 = 100.0;

/// The statistics of the map, then the exposures.
const HDR_FLIP: [Statistic; STATISTICS + 3] = {
    let [mean, median, q1, q3, min, max, foveal, ppd] =
        statistics("hdr_flip_min", "hdr_flip_max", "hdr_fflip");
    [
        mean,
        median,
        q1,
        q3,
        min,
        max,
        foveal,
        ppd,
        setting("start"),
        setting("stop"),
        setting("exposures"),
    ]
};

/// HDR-FLIP of each pixel.
const MAP: MapInfo = MapInfo {
    name: "hdr_flip",
    label: "HDR-FLIP",
    unit: None,
    block: 1,
    about: "HDR-FLIP of each pixel; coloured from 0 (identical) to 1",
    bright: "worse",
    scale: MapScale::Linear { none: 0.0, most: 1.0 },
};

/// The exposure with the largest difference.
const EXPOSURE_MAP: MapInfo = MapInfo {
    name: "hdr_flip_exposure",
    label: "Exposure of the largest HDR-FLIP",
    unit: None,
    block: 1,
    about: "the exposure at which each pixel differs most, from 0 (the first and darkest) to 1 (the last and brightest)",
    bright: "brighter",
    scale: MapScale::Linear { none: 0.0, most: 1.0 },
};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Params {
    /// The tone map of each exposure.
    pub tonemap: Tonemap,
    /// The first exposure in stops; `None` means that of the brightest pixel.
    pub start: Option<f64>,
    /// The last exposure in stops; `None` means that of the median.
    pub stop: Option<f64>,
    /// The number of exposures; `None` means one per stop.
    pub exposures: Option<usize>,
}

impl MetricParams for Params {
    const HAS_OWN_PASS: bool = true;

    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "tonemap" => self.tonemap = Tonemap::find(value.text()?)?,
            "start" => self.start = value.number(),
            "stop" => self.stop = value.number(),
            "exposures" => self.exposures = value.number().map(|count| count as usize),
            _ => return None,
        }
        Some(())
    }

    /// Checks that the exposures are in order.
    fn check(&self) -> Result<(), ParamError> {
        let (Some(start), Some(stop)) = (self.start, self.stop) else { return Ok(()) };
        if start <= stop {
            return Ok(());
        }
        Err(ParamError::Value {
            owner: INFO.key,
            param: "start",
            value: start.to_string(),
            expected: format!("at most hdr_flip.stop, {stop}"),
        })
    }

    fn measure(
        &self,
        all: &registry::Params,
        input: &PairInput<'_>,
    ) -> Option<Result<Scored, ScoreError>> {
        Some(measure(self, all, input))
    }
}

/// Measures a pair.
fn measure(
    params: &Params,
    all: &registry::Params,
    input: &PairInput<'_>,
) -> Result<Scored, ScoreError> {
    let signal = input.tables.params();
    let frames = [(Image::Reference, input.reference), (Image::Test, input.test)];
    for (image, frame) in frames {
        if signal.transfer_of(frame) != Transfer::Linear {
            let reason = format!("the {} is not linear light", image.name());
            let help = "use flip, or give linear frames, such as OpenEXR files";
            return Err(unfit(image, reason, help));
        }
    }
    let exposures = Exposures::new(params, input)?;
    let (pixels_per_degree, warning) = all.flip.pixels_per_degree(Metric::HdrFlip, input)?;
    let optics = Optics::new(pixels_per_degree);
    let (width, height) = (input.reference.width(), input.reference.height());
    let mut values = vec![0.0; width * height];
    let blocks = map_plane_blocks(&mut values, width, |rows, values| {
        let mut block = Block {
            input,
            params,
            exposures: &exposures,
            tiles: Tiles::new(input, LightKind::Scene, &optics),
            sums: Sums::new(input),
            indices: if input.map { vec![0; values.len()] } else { Vec::new() },
            rows,
        };
        for x in (0..width).step_by(TILE_COLUMNS) {
            block.tile(x..(x + TILE_COLUMNS).min(width), width, values);
        }
        (block.sums, block.indices)
    });
    let (sums, indices): (Vec<Sums>, Vec<Vec<u8>>) = blocks.into_iter().unzip();
    let mut rows =
        Sums::of(input, &sums).rows(Metric::HdrFlip, input, &values, pixels_per_degree)?;
    let Exposures { start, stop, count } = exposures;
    for (index, value) in [start, stop, count as f64].into_iter().enumerate() {
        rows.score(Key::of(Metric::HdrFlip).nth(STATISTICS + index), value);
    }
    let mut maps = Vec::new();
    if input.map {
        let last = (count - 1) as f32;
        let exposure =
            indices.concat().into_iter().zip(&values).map(|(index, value)| {
                if value.is_nan() { f32::NAN } else { f32::from(index) / last }
            });
        let exposure = EXPOSURE_MAP.with((width, height), exposure.collect());
        maps = vec![coloured_map(&MAP, (width, height), values), exposure];
    }
    Ok(Scored { rows, maps, warnings: warning.into_iter().collect() })
}

/// A block of rows.
struct Block<'a> {
    input: &'a PairInput<'a>,
    params: &'a Params,
    exposures: &'a Exposures,
    tiles: Tiles<'a>,
    sums: Sums,
    /// The exposure with the largest difference of each pixel, if a map is asked for.
    indices: Vec<u8>,
    rows: Range<usize>,
}

impl Block<'_> {
    /// Computes the largest differences in some columns. `values` has the rows of the block.
    fn tile(&mut self, columns: Range<usize>, width: usize, values: &mut [f32]) {
        self.tiles.read(self.rows.clone(), columns.clone());
        let first = self.rows.start;
        let stretch = |y: usize| {
            let start = (y - first) * width;
            start + columns.start..start + columns.end
        };
        for exposure in 0..self.exposures.count {
            let (tonemap, root) = (self.params.tonemap, self.exposures.root_of_gain(exposure));
            let indices = &mut self.indices;
            let change = |light: [&[f32]; 3], out: [&mut [f32]; 3]| tonemap.map(root, light, out);
            self.tiles.map(Some(&change), |y, row| {
                let largest = &mut values[stretch(y)];
                if exposure == 0 {
                    largest.copy_from_slice(row);
                    return;
                }
                if !indices.is_empty() {
                    let of_row = &mut indices[stretch(y)];
                    for ((index, largest), value) in of_row.iter_mut().zip(&*largest).zip(&*row) {
                        *index = if value > largest { exposure as u8 } else { *index };
                    }
                }
                for (largest, value) in largest.iter_mut().zip(row) {
                    *largest = if *value > *largest { *value } else { *largest };
                }
            });
        }
        let mut scratch = [0.0; TILE_COLUMNS];
        for y in self.rows.clone() {
            let row = &mut values[stretch(y)];
            let at = (columns.start, y);
            self.sums.add(self.input, at, row, &mut scratch[..row.len()]);
            leave_out(self.input, at, row);
        }
    }
}
