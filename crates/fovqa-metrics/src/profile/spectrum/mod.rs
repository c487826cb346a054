//! The power spectrum of luma by eccentricity, in cycles per degree.
//!
//! Blocks of B x B pixels overlap by half: their first pixels are at multiples of B/2, and a block belongs
//! to the band of its centre. With the window w_i = sin²(π (i + ½)/B) and the block's weighted mean Ȳ,
//!
//! ```text
//! q_ij = w_i w_j (Y_ij - Ȳ),  P(u,v) = |DFT(q)(u,v)|² / (B² Σ w_i² w_j²),  f = √(u² + v²)/B · ppd_b
//! ```
//!
//! with ppd_b = ppd (1 + ρ²)^¾ at the block's centre, ρ being its distance from the principal point in
//! focal lengths: a pinhole picture has 1 + ρ² times the pixels per degree radially and √(1 + ρ²) times
//! tangentially, and the geometric mean is taken. Bin k holds 2^((k-½)/2) ≤ f < 2^((k+½)/2) cycles per
//! degree, half an octave; (0,0) is left out. Per band and bin:
//!
//! - `power`: ΣP over the frequencies of a bin, as the mean over blocks, in luma². The sum over all bins is
//!   the mean windowed variance.
//! - `density`: the mean of P/Δ² over the samples, Δ = ppd_b/B, in luma²/cpd²: the radial average.
//! - `cutoff_cpd`: the centre of the last bin, from the lowest up, before the first one where the test has
//!   less than half of the reference's power. A good foveated render has it at or above the eye's acuity.
//!
//! Blocks with a pixel that does not count are left out. The measure is fovqa's own choice; no paper
//! defines it.

mod blocks;
mod fft;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use fovqa_frame::{LumaKind, LumaScratch, LumaSignal};
use fovqa_params::{ParamError, ParamInfo, ParamValue, ParamValues};
use fovqa_vision::Eccentricity;
use rayon::prelude::*;

use self::blocks::Blocks;
use super::picture_input::PictureInput;
use crate::info::MetricInfo;
use crate::kinds::Better;
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pooling::{Parts, Pooling, Statistic, Weight};
use crate::registry;
use crate::row::{Image, Key, Rows};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "spectrum",
    label: "Spectrum",
    long_name: "power spectrum of luma",
    statistics: &[
        Statistic::named("power")
            .pooled(Pooling::WeightedMean)
            .weighted_by(Weight::Statistic(BLOCKS))
            .with_floor(NO_POWER),
        Statistic::named("density")
            .pooled(Pooling::WeightedMean)
            .weighted_by(Weight::Statistic(SAMPLES))
            .with_floor(NO_POWER),
        Statistic::count(SAMPLES),
        Statistic::count(BLOCKS),
        Statistic::named(CUTOFF).pooled(Pooling::None).without_ratio().pointing(Better::Higher),
    ],
    derive: Some(derive),
    about: "power spectrum of luma in cycles per degree by half octave and band, of reference and test, and \
            the frequency up to which the test has it",
    source: "fovqa's own definition",
    params: &[ParamInfo {
        name: "block",
        default: "64",
        values: ParamValues::Whole(SMALLEST_BLOCK, LARGEST_BLOCK),
        about: "side of the blocks in px, a power of two",
    }],
    ..MetricInfo::PROFILE
};

/// The number of frequencies of a bin in all blocks of a band.
pub const SAMPLES: &str = "samples";

/// The number of blocks of a band.
pub const BLOCKS: &str = "blocks";

/// The frequency up to which the test has the reference's power.
pub const CUTOFF: &str = "cutoff_cpd";

const SMALLEST_BLOCK: u32 = 16;
const LARGEST_BLOCK: u32 = 256;

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Params {
    /// The side of the blocks in pixels: a power of two from 16 to 256.
    pub block: u32,
}

impl Default for Params {
    fn default() -> Self {
        Self { block: 64 }
    }
}

impl MetricParams for Params {
    const HAS_OWN_PASS: bool = true;

    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "block" => self.block = value.number()? as u32,
            _ => return None,
        }
        Some(())
    }

    fn check(&self) -> Result<(), ParamError> {
        if self.block.is_power_of_two() {
            return Ok(());
        }
        Err(ParamError::Value {
            owner: INFO.key,
            param: "block",
            value: self.block.to_string(),
            expected: "side of the blocks in px; 16, 32, 64, 128 or 256".to_owned(),
        })
    }

    fn smallest_side(&self, _ssim_window: usize) -> usize {
        self.block as usize
    }

    fn profile(&self, _all: &registry::Params, input: &PictureInput<'_>) -> Option<Rows> {
        Some(measure(self.block as usize, input))
    }
}

/// The frequency in the middle of a half octave, in cycles per degree: 2^(k/2).
pub fn centre_cpd(half_octave: i16) -> f64 {
    let whole = 2f64.powi(i32::from(half_octave).div_euclid(2));
    if half_octave.rem_euclid(2) == 0 { whole } else { whole * std::f64::consts::SQRT_2 }
}

/// The square of the frequency where a half octave ends: 2^(k+½).
fn end_squared(half_octave: i16) -> f64 {
    2f64.powi(i32::from(half_octave)) * std::f64::consts::SQRT_2
}

/// The half octave of a frequency, by its square in cycles² per degree².
fn half_octave(squared: f64) -> i16 {
    let mut k = libm::ilogb(squared) as i16;
    while squared >= end_squared(k) {
        k += 1;
    }
    while squared < end_squared(k - 1) {
        k -= 1;
    }
    k
}

/// The sums of a half octave in a band.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Bin {
    /// ΣP
    power: f64,
    /// ΣP/Δ²
    density: f64,
    samples: u64,
}

/// The sums of a band.
#[derive(Debug, Clone, Default, PartialEq)]
struct Band {
    blocks: u64,
    bins: BTreeMap<i16, Bin>,
}

impl Band {
    fn merge(&mut self, other: &Self) {
        self.blocks += other.blocks;
        for (k, theirs) in &other.bins {
            let mine = self.bins.entry(*k).or_default();
            mine.power += theirs.power;
            mine.density += theirs.density;
            mine.samples += theirs.samples;
        }
    }

    /// Adds a block, by its power on each ring. `unit_squared` is Δ², the square of the distance of
    /// neighbouring frequencies.
    fn add(&mut self, blocks: &Blocks, power: &[f64], unit_squared: f64) {
        self.blocks += 1;
        let mut bin = (i16::MIN, 0.0, Bin::default());
        for ((squared, count), power) in blocks.rings().zip(power) {
            let squared = f64::from(squared) * unit_squared;
            if squared >= bin.1 {
                self.add_bin(bin.0, bin.2, unit_squared);
                let k = half_octave(squared);
                bin = (k, end_squared(k), Bin::default());
            }
            bin.2.power += power;
            bin.2.samples += u64::from(count);
        }
        self.add_bin(bin.0, bin.2, unit_squared);
    }

    fn add_bin(&mut self, k: i16, bin: Bin, unit_squared: f64) {
        if bin.samples > 0 {
            let mine = self.bins.entry(k).or_default();
            mine.power += bin.power;
            mine.density += bin.power / unit_squared;
            mine.samples += bin.samples;
        }
    }
}

/// A block of a picture.
#[derive(Debug, Clone, Copy)]
struct Place {
    column: usize,
    band: usize,
    unit_squared: f64,
}

/// The spectrum of a picture.
fn measure(side: usize, input: &PictureInput<'_>) -> Rows {
    let Some((eccentricity, edges)) = input.seen else { return Rows::default() };
    let blocks = Blocks::new(side);
    let (width, height) = (input.frame.width(), input.frame.height());
    let luma = LumaSignal::new(input.frame, input.tables, LumaKind::Luma);
    let starts: Vec<usize> = (0..=height - side).step_by(side / 2).collect();
    let of_row = |&y: &usize| -> Vec<Band> {
        let mut bands = vec![Band::default(); edges.count()];
        let places = places(side, y, input, eccentricity, edges.edges_deg());
        if places.is_empty() {
            return bands;
        }
        let mut strip = vec![0.0; side * width];
        let mut converted = LumaScratch::new(width);
        for (row, y) in strip.chunks_exact_mut(width).zip(y..) {
            luma.fill_row(y, 0..width, &mut converted, row);
        }
        let mut scratch = blocks.scratch();
        for two in places.chunks(2) {
            let columns = [0, 1].map(|index| two.get(index).map(|place| place.column));
            let power = blocks.power(&strip, width, columns, &mut scratch);
            for (place, power) in two.iter().zip(power) {
                bands[place.band].add(&blocks, power, place.unit_squared);
            }
        }
        bands
    };
    let rows: Vec<Vec<Band>> = starts.par_iter().map(of_row).collect();
    let mut bands = vec![Band::default(); edges.count()];
    for row in &rows {
        for (mine, theirs) in bands.iter_mut().zip(row) {
            mine.merge(theirs);
        }
    }
    to_rows(&bands, input.image)
}

/// The blocks of a row of blocks, which begins at row `y` of the picture, that count and lie in a band.
fn places(
    side: usize,
    y: usize,
    input: &PictureInput<'_>,
    eccentricity: &Eccentricity,
    edges_deg: &[f64],
) -> Vec<Place> {
    let width = input.frame.width();
    let mut bad = vec![false; width];
    if input.regions.is_masked() {
        for y in y..y + side {
            for stretch in input.regions.left_out_in(y, 0..width) {
                bad[stretch].fill(true);
            }
        }
    }
    let view = eccentricity.view();
    let place = |column: usize| {
        let clean = !bad[column..column + side].contains(&true);
        let centre = [(column + side / 2) as f64, (y + side / 2) as f64];
        let deg = eccentricity.at_deg(centre[0], centre[1]);
        let band = edges_deg.windows(2).position(|edges| (edges[0]..edges[1]).contains(&deg));
        let across: [f64; 2] =
            std::array::from_fn(|i| (centre[i] - view.principal_px[i]) / view.focal_px[i]);
        let stretch = 1.0 + across[0] * across[0] + across[1] * across[1];
        // Δ² = (ppd_b/B)², and ppd_b² = ppd² (1 + ρ²)^(3/2).
        let unit = view.pixels_per_degree() / side as f64;
        let unit_squared = unit * unit * stretch * stretch.sqrt();
        band.filter(|_| clean).map(|band| Place { column, band, unit_squared })
    };
    (0..=width - side).step_by(side / 2).filter_map(place).collect()
}

fn to_rows(bands: &[Band], image: Image) -> Rows {
    let mut rows = Rows::default();
    let pair = Key::of(Metric::Spectrum);
    for (index, band) in bands.iter().enumerate() {
        let pair = pair.in_band(index);
        let weight = band.blocks as f64;
        for (k, bin) in &band.bins {
            let key = pair.of_image(image).at_level(*k);
            let power = Parts::Mean { sum: bin.power, weight };
            rows.push(key, Some(bin.power / weight), power);
            let density = Parts::Mean { sum: bin.density, weight: bin.samples as f64 };
            rows.push(key.nth(1), Some(bin.density / bin.samples as f64), density);
            // These numbers are the same for both pictures, and so belong to the pair.
            if image == Image::Reference {
                rows.count(pair.at_level(*k).nth(2), bin.samples);
            }
        }
        if image == Image::Reference {
            rows.count(pair.nth(3), band.blocks);
        }
    }
    rows
}

/// Where the reference has less power than this, its ratio says nothing.
const NO_POWER: f64 = 1e-12;

/// A half octave is lost where the test's power is below this share of the reference's.
const LACKING: f64 = 0.5;

/// The cut-off of each band, from the powers of both pictures.
fn derive(rows: &Rows) -> Rows {
    let mut bands: BTreeMap<u16, BTreeMap<i16, [f64; 2]>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.key.metric() == Some(Metric::Spectrum)) {
        let Some(band) = row.key.band else { continue };
        let bins = bands.entry(band).or_default();
        let is_power = row.key.statistic() == &INFO.statistics[0];
        let (Some(k), Some(value)) = (row.key.level.filter(|_| is_power), row.value) else {
            continue;
        };
        let bin = bins.entry(k).or_default();
        match row.key.image {
            Image::Reference => bin[0] = value,
            Image::Test => bin[1] = value,
            Image::Pair | Image::Ratio => {}
        }
    }
    let mut derived = Rows::default();
    for (band, bins) in bands {
        let known = bins.iter().filter(|(_, [reference, _])| *reference >= NO_POWER);
        let has = known.take_while(|(_, [reference, test])| *test >= LACKING * reference);
        let cutoff = has.last().map(|(k, _)| centre_cpd(*k));
        derived.push(Key::of(Metric::Spectrum).nth(4).in_band(band.into()), cutoff, Parts::Value);
    }
    derived
}
