//! ATD, the average temporal difference along the motion (Patney et al. 2016, 4.4.3).
//!
//! For frame t it is the mean over valid pixels of |Y_t(x) - Y_{t-1}(x + m_t(x))|. Y is the luma of
//! the display-encoded signal, and m the backward motion in pixels. The previous frame is
//! interpolated bilinearly at pixel centres and clamped to its borders. A pixel is valid when its
//! source x + m lies in [0, W) x [0, H) and, if depth is given, |Z_{t-1}(s) - Z_t(x)| ≤
//! `depth_tolerance` |Z_t(x)|, where s is the pixel that holds the source. A pixel with non-finite
//! motion or depth is not valid. ATD is in [0, 1]; lower is steadier, and its ratio to the
//! reference's ATD is the papers' percentage.

use fovqa_frame::map_row_blocks;
use multiversion::multiversion;

use super::kept_plane::KeptPlane;
use super::source::{Link, Sources, Stretch};
use super::time_input::{Picture, TimeInput};
use crate::info::MetricInfo;
use crate::metric::Metric;
use crate::metric_params::MetricParams;
use crate::pooling::{Parts, Pooling, Statistic};
use crate::regions::{Regions, clipped};
use crate::row::{Image, Key, Rows};
use crate::sums::add_by_band;
use fovqa_params::{ParamInfo, ParamValue, ParamValues};

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "atd",
    label: "ATD",
    long_name: "average temporal difference",
    statistics: &[
        Statistic::VALUE.over_eyes(Pooling::WeightedMean),
        Statistic::named("left_out")
            .pooled(Pooling::WeightedMean)
            .over_frames(Pooling::WeightedMean)
            .without_ratio(),
    ],
    about: "average temporal difference of luma along the motion, of reference and test, and their ratio",
    source: "Patney et al. 2016, 4.4.3",
    params: &[ParamInfo {
        name: "depth_tolerance",
        default: "0.05",
        values: ParamValues::NumberOr(0.0, 1e6, "off"),
        about: "largest relative difference of depth along the motion; off ignores depth",
    }],
    ..MetricInfo::TEMPORAL
};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Params {
    /// The largest change of depth along the motion, as a share of the depth; `None` means that
    /// depth is ignored.
    pub depth_tolerance: Option<f64>,
}

impl Default for Params {
    fn default() -> Self {
        Self { depth_tolerance: Some(0.05) }
    }
}

impl MetricParams for Params {
    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match name {
            "depth_tolerance" => self.depth_tolerance = value.number(),
            _ => return None,
        }
        Some(())
    }

    fn frames_needed(&self) -> usize {
        2
    }

    fn follow(&self, _all: &crate::Params, input: &TimeInput<'_>) -> Option<Vec<Rows>> {
        let before = &input.before[0];
        let link = Link {
            motion: input.motion,
            depth: input.depth.zip(before.depth),
            regions: input.regions,
            mask_before: before.mask,
        };
        let pictures: Vec<_> = input.pictures.iter().map(|of| (of.lumas[0], of.lumas[1])).collect();
        let found = differences(&link, &pictures, self);
        let rows = |(of, picture): (&AtdFrame, &Picture<'_>)| {
            let mut rows = Rows::default();
            of.rows(picture.image, &mut rows);
            rows
        };
        Some(found.iter().zip(input.pictures).map(rows).collect())
    }
}

/// The difference of one frame to the one before it: sums and numbers of valid pixels, per band.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct AtdFrame {
    /// The number of pixels that count, valid or not.
    pub pixels: u64,
    /// The differences over the whole frame.
    pub whole: AtdSum,
    /// The differences in each band.
    pub bands: Vec<AtdSum>,
}

/// The sum of differences over some pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct AtdSum {
    /// The sum of the differences.
    pub sum: f64,
    /// The number of pixels that can be compared.
    pub valid: u64,
}

impl AtdSum {
    /// The mean over valid pixels; `None` if there are none.
    pub(super) fn mean(&self) -> Option<f64> {
        (self.valid > 0).then(|| self.sum / self.valid as f64)
    }
}

impl AtdFrame {
    /// The number of pixels that are left out.
    pub(super) fn left_out(&self) -> u64 {
        self.pixels - self.whole.valid
    }

    /// Adds the values of one picture: of the whole frame, with the share that is left out, and of
    /// each band.
    fn rows(&self, image: Image, rows: &mut Rows) {
        let key = Key::of(Metric::Atd).of_image(image);
        let mut add = |key: Key, difference: &AtdSum| {
            let AtdSum { sum, valid } = *difference;
            rows.push(key, difference.mean(), Parts::Mean { sum, weight: valid as f64 });
        };
        add(key, &self.whole);
        for (band, difference) in self.bands.iter().enumerate() {
            add(key.in_band(band), difference);
        }
        let (sum, weight) = (self.left_out() as f64, self.pixels as f64);
        rows.push(key.nth(1), Some(sum / weight.max(1.0)), Parts::Mean { sum, weight });
    }
}

/// The number of columns of a tile: its sources stay in the first-level cache.
const TILE_COLUMNS: usize = 256;

/// The sums of a block of rows: per band, then outside all bands.
struct Sums {
    /// The sums for each picture.
    differences: Vec<Vec<f64>>,
    valid: Vec<u64>,
}

/// The differences of pictures that share their motion. Each picture is given by its present and
/// its previous frame.
///
/// # Panics
/// When regions, motion, depth or planes differ in size.
pub(crate) fn differences(
    link: &Link<'_>,
    pictures: &[(&KeptPlane, &KeptPlane)],
    params: &Params,
) -> Vec<AtdFrame> {
    let Some((first, _)) = pictures.first() else { return Vec::new() };
    let size = (first.width(), first.height());
    let sizes = pictures.iter().flat_map(|(now, before)| [now, before]);
    assert!(sizes.into_iter().all(|p| (p.width(), p.height()) == size), "pictures of one size");
    assert_eq!(link.regions.rows(), size.1, "regions of these pictures");
    let bands = link.regions.bands();
    let blocks = map_row_blocks(size.1, |rows| {
        let mut block = Block::new(link, pictures, params, size);
        for y in rows {
            for x in (0..size.0).step_by(TILE_COLUMNS) {
                block.stretch(x, y, TILE_COLUMNS.min(size.0 - x));
            }
        }
        block.sums
    });
    let mut all = Sums::new(bands, pictures.len());
    for block in blocks {
        all.merge(&block);
    }
    let counts = link.regions.pixels();
    all.differences.iter().map(|sums| frame(link.regions, sums, &all.valid, &counts)).collect()
}

fn frame(regions: &Regions<'_>, sums: &[f64], valid: &[u64], counts: &[u64]) -> AtdFrame {
    let bands = sums.iter().zip(valid).take(regions.bands());
    AtdFrame {
        pixels: counts.iter().sum(),
        whole: AtdSum { sum: sums.iter().sum(), valid: valid.iter().sum() },
        bands: bands.map(|(&sum, &valid)| AtdSum { sum, valid }).collect(),
    }
}

impl Sums {
    fn new(bands: usize, pictures: usize) -> Self {
        Self { differences: vec![vec![0.0; bands + 1]; pictures], valid: vec![0; bands + 1] }
    }

    fn merge(&mut self, other: &Self) {
        let pictures = self.differences.iter_mut().zip(&other.differences);
        for (mine, theirs) in pictures.flat_map(|(mine, theirs)| mine.iter_mut().zip(theirs)) {
            *mine += theirs;
        }
        for (mine, theirs) in self.valid.iter_mut().zip(&other.valid) {
            *mine += theirs;
        }
    }
}

struct Block<'a> {
    link: &'a Link<'a>,
    pictures: &'a [(&'a KeptPlane, &'a KeptPlane)],
    tolerance: Option<f64>,
    size: (usize, usize),
    sources: Sources,
    fetched: Vec<f32>,
    sums: Sums,
}

impl<'a> Block<'a> {
    fn new(
        link: &'a Link<'a>,
        pictures: &'a [(&'a KeptPlane, &'a KeptPlane)],
        params: &Params,
        size: (usize, usize),
    ) -> Self {
        Self {
            link,
            pictures,
            tolerance: params.depth_tolerance,
            size,
            sources: Sources::new(TILE_COLUMNS),
            fetched: vec![0.0; TILE_COLUMNS],
            sums: Sums::new(link.regions.bands(), pictures.len()),
        }
    }

    fn stretch(&mut self, x: usize, y: usize, n: usize) {
        let (width, height) = self.size;
        let at = Stretch { x, y, pixels: n, width, height };
        self.sources.find(self.link, self.tolerance, at);
        let valid = &self.sources.valid()[..n];
        let runs = self.link.regions.pixel_runs(y);
        for (from, to, band) in clipped(runs, x..x + n) {
            self.sums.valid[usize::from(band)] += count(&valid[from - x..to - x]);
        }
        let fetched = &mut self.fetched[..n];
        for ((now, before), sums) in self.pictures.iter().zip(&mut self.sums.differences) {
            self.sources.fetch(before, at, fetched);
            difference(&now.row(y)[x..x + n], valid, fetched);
            add_by_band(fetched, x, runs, sums);
        }
    }
}

fn count(valid: &[u32]) -> u64 {
    u64::from(valid.iter().sum::<u32>())
}

/// Replaces `values` by their distances to `now`, and by 0 where that is not valid.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn difference(now: &[f32], valid: &[u32], values: &mut [f32]) {
    for ((value, now), valid) in values.iter_mut().zip(now).zip(valid) {
        *value = if *valid == 1 { (now - *value).abs() } else { 0.0 };
    }
}
