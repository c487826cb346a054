//! The map of visible differences in a frame: the differences of all bands, expanded and added.
//!
//! The levels are H_0 = D_0 and H_l = D_l / 2, where D is that of the sustained channel plus 0.25
//! times that of the transient channel. From the coarsest level on, img = expand(img) + H_l. The
//! raw map is a img^b, in units of JOD but without an upper limit. For the coloured map it is laid
//! over a gray picture of the frame.

use multiversion::multiversion;

use super::calibration::{CHANNEL_WEIGHTS, JOD_A};
use super::grid::Grid;
use super::level::DifferenceRows;
use super::masking::powers;
use super::pooling::jod_exponent;
use super::pyramid::expand;
use crate::log_exp::{exp2, log2};
use crate::map::{Map, MapInfo, MapPicture, MapScale};

/// The description of the map.
pub(crate) const MAP: MapInfo = MapInfo {
    name: "fvvdp",
    label: "Visible difference",
    unit: Some("JOD"),
    block: 1,
    about: "visible difference, in units like JOD; coloured from 0 to 3, and over a gray picture of the frame",
    bright: "worse",
    scale: MapScale::Linear { none: 0.0, most: 3.0 },
};

/// The differences of a frame, level by level.
#[derive(Debug, Clone, Default)]
pub struct DifferenceMap {
    levels: Vec<Grid>,
}

impl DifferenceMap {
    /// Adds the differences of a level; levels must be added in order.
    pub(super) fn add_level<'a>(
        &mut self,
        index: usize,
        (width, height): (usize, usize),
        rows: impl Fn() -> DifferenceRows<'a> + Sync + Send,
    ) {
        let halved = if index == 0 { 1.0 } else { 0.5 };
        let mut level = Grid::new(width, height);
        level.fill_blocks(|first, out| {
            let mut rows = rows();
            let mut power = vec![0.0; width];
            for (index, out) in out.enumerate() {
                for (log2_differences, weight) in
                    rows.row(first + index).iter().zip(CHANNEL_WEIGHTS)
                {
                    powers(log2_differences, 1.0, &mut power);
                    let weight = (weight * halved) as f32;
                    for (out, power) in out.iter_mut().zip(&power) {
                        *out += weight * power;
                    }
                }
            }
        });
        self.levels.truncate(index);
        self.levels.push(level);
    }

    /// The map, coloured over a picture's luminance. Values are in units like JOD, 0 and above.
    pub fn map(self, luminance: &Grid) -> Map {
        let raw = self.raw();
        let picture = |colors: MapColors| MapPicture {
            name: colors.name(),
            codes: colored(&raw, luminance, colors),
        };
        Map {
            info: &MAP,
            frame_size: (raw.width(), raw.height()),
            values: (0..raw.height()).flat_map(|y| raw.row(y)).copied().collect(),
            is_half: true,
            pictures: MapColors::ALL.map(picture).into(),
        }
    }

    /// The raw map, row by row, in units like JOD, 0 and above.
    pub(crate) fn raw(mut self) -> Grid {
        let Some(mut image) = self.levels.pop() else { return Grid::new(1, 1) };
        while let Some(level) = self.levels.pop() {
            let mut finer = expand(&image, level.size());
            finer.fill_blocks(|first, rows| {
                for (index, row) in rows.enumerate() {
                    for (sum, value) in row.iter_mut().zip(level.padded_row(first + index)) {
                        *sum += value;
                    }
                }
            });
            image = finer;
        }
        let exponent = jod_exponent() as f32;
        image.fill_blocks(|_, rows| rows.for_each(|row| to_jod(row, exponent)));
        image
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn to_jod(row: &mut [f32], exponent: f32) {
    for value in row {
        let jod = JOD_A as f32 * exp2(exponent * log2(*value));
        // The logarithm of 0 is about -126, so 0 is handled separately.
        *value = if *value > 0.0 { jod } else { 0.0 };
    }
}

/// A colour scheme for maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MapColors {
    /// Blue, cyan, green, yellow, red from 0 to 1: shows what is visible at all.
    Threshold,
    /// Cyan, white, yellow from 0 to 1: shows differences well above the threshold.
    SupraThreshold,
}

type Rgb = [f64; 3];

impl MapColors {
    /// Both colour schemes.
    pub(crate) const ALL: [MapColors; 2] = [Self::Threshold, Self::SupraThreshold];

    /// The name of the scheme in file names.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Threshold => "threshold",
            Self::SupraThreshold => "supra-threshold",
        }
    }

    /// Colours at equal steps from 0 to 1.
    fn nodes(self) -> &'static [Rgb] {
        match self {
            Self::Threshold => &[
                [0.2, 0.2, 1.0],
                [0.2, 1.0, 1.0],
                [0.2, 1.0, 0.2],
                [1.0, 1.0, 0.2],
                [1.0, 0.2, 0.2],
            ],
            Self::SupraThreshold => &[[0.2, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 0.2]],
        }
    }

    /// The colour of a value. All colours have about the same luma, so that the gray picture below
    /// determines the luma.
    fn at(self, value: f64) -> Rgb {
        let even = |[r, g, b]: Rgb| {
            let luma = 0.212_656 * r + 0.715_158 * g + 0.072_186 * b + 0.0001;
            [r / luma, g / luma, b / luma]
        };
        let nodes = self.nodes();
        let at = value.clamp(0.0, 1.0) * (nodes.len() - 1) as f64;
        let below = (at as usize).min(nodes.len() - 2);
        let (from, to) = (even(nodes[below]), even(nodes[below + 1]));
        let share = at - below as f64;
        std::array::from_fn(|c| from[c] + (to[c] - from[c]) * share)
    }
}

/// Colours a raw map over a picture's luminance. The result is interleaved 8-bit sRGB codes.
pub(crate) fn colored(raw: &Grid, luminance: &Grid, colors: MapColors) -> Vec<u8> {
    let context = context(luminance);
    let values = (0..raw.height()).flat_map(|y| raw.row(y));
    let pixels = values.zip(context).flat_map(|(value, gray)| {
        colors.at(f64::from(*value)).map(|c| (255.0 * (c * gray).clamp(0.0, 1.0)) as u8)
    });
    pixels.collect()
}

/// A gray picture of a luminance, 0 to 1: its logarithm with a partly equalised histogram.
fn context(luminance: &Grid) -> Vec<f64> {
    /// The range of the grays, in the middle of 0 to 1.
    const RANGE: f64 = 0.6;
    const BINS: usize = 1024;
    let values = || (0..luminance.height()).flat_map(|y| luminance.row(y)).map(|v| f64::from(*v));
    let smallest = values().filter(|value| *value > 0.0).fold(f64::INFINITY, f64::min);
    if smallest.is_infinite() {
        return values().map(|_| 0.5).collect();
    }
    let logs: Vec<f64> = values().map(|value| libm::log(value.max(smallest))).collect();
    let min = logs.iter().copied().fold(f64::INFINITY, f64::min);
    let max = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let placed = |share: f64| share * RANGE + (1.0 - RANGE) / 2.0;
    if max - min < RANGE {
        return logs.iter().map(|log| placed((log - min) / (max - min + 1e-3))).collect();
    }
    let mut histogram = vec![0.0; BINS];
    for log in &logs {
        let bin = (BINS as f64 * (log - min) / (max - min)) as usize;
        histogram[bin.min(BINS - 1)] += 1.0;
    }
    let mut sum = 0.0;
    for count in &mut histogram {
        sum += libm::cbrt(*count);
        *count = sum;
    }
    let look_up = |log: &f64| {
        let at = (log - min) / (max - min) * (BINS - 1) as f64;
        let below = (at as usize).min(BINS - 2);
        let (from, to) = (histogram[below], histogram[below + 1]);
        placed((from + (to - from) * (at - below as f64)) / sum)
    };
    logs.iter().map(look_up).collect()
}
