//! Compares profiles with their formulas, written out literally in f64.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use fovqa_frame::{Frame, LumaKind, LumaScratch, LumaSignal, Mask, SignalParams, SignalTables};
use fovqa_testkit::synthetic::{codes, rgb8};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::*;
use crate::temporal::kept_plane::KeptPlane;
use crate::{BlockRegions, Image, Key, Metric, Params, Regions, Rows, Subject};
use fovqa_params::ParamValue;

const EDGES_DEG: [f64; 4] = [0.0, 10.0, 20.0, 35.0];

struct Setup {
    eccentricity: Eccentricity,
    frame: Frame,
    params: Params,
    mask: Option<Mask>,
}

impl Setup {
    fn new(width: usize, height: usize) -> Self {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(80.0) };
        let view = spec.resolve(width, height).unwrap().view;
        let gaze = [width as f64 * 0.3, height as f64 * 0.6];
        Self {
            eccentricity: Eccentricity::new(view, gaze, EccentricityKind::Angular),
            frame: rgb8(width, height, codes(width, height, 3, 7)),
            params: Params::default(),
            mask: None,
        }
    }

    fn set(mut self, metric: Metric, name: &str, value: &ParamValue) -> Self {
        self.params.set(metric, name, value).unwrap();
        self
    }

    fn size(&self) -> (usize, usize) {
        (self.frame.width(), self.frame.height())
    }

    fn luma(&self) -> Vec<Vec<f64>> {
        let tables = SignalTables::new(SignalParams::default());
        let signal = LumaSignal::new(&self.frame, &tables, LumaKind::Luma);
        let (width, height) = self.size();
        let mut scratch = LumaScratch::new(width);
        let rows = (0..height).map(|y| {
            let mut row = vec![0.0; width];
            signal.fill_row(y, 0..width, &mut scratch, &mut row);
            row
        });
        rows.collect()
    }

    fn measure(&self, plane: Option<&mut KeptPlane>) -> Rows {
        let profiler = Profiler::new(&[Metric::RmsContrast, Metric::Haar], &self.params);
        let edges = BandEdges::new(EDGES_DEG.to_vec()).unwrap();
        let bands = BandMap::new(&self.eccentricity, &edges);
        let levels = profiler.haar_levels().unwrap();
        let maps = BlockRegions::maps(&self.eccentricity, &edges, levels);
        let (regions, blocks) = match &self.mask {
            None => (Regions::unmasked(&bands), BlockRegions::unmasked(&maps)),
            Some(mask) => (Regions::masked(&bands, mask, 5), BlockRegions::masked(&maps, mask)),
        };
        let tables = SignalTables::new(SignalParams::default());
        let input = PictureInput {
            frame: &self.frame,
            tables: &tables,
            regions: &regions,
            blocks: &blocks,
            seen: None,
            image: Image::Reference,
        };
        profiler.measure(&input, plane)
    }

    fn band_at(&self, x_px: f64, y_px: f64) -> Option<usize> {
        let deg = self.eccentricity.at_deg(x_px, y_px);
        EDGES_DEG.windows(2).position(|edge| (edge[0]..edge[1]).contains(&deg))
    }

    fn counts(&self, x: usize, y: usize) -> bool {
        self.mask.as_ref().is_none_or(|mask| mask.row(y)[x])
    }

    /// All coefficients of each level and band: `[level - 1][band]`, with LH, HL and HH of each
    /// block.
    fn coefficients(&self) -> Vec<Vec<Vec<[f64; 3]>>> {
        let (width, height) = self.size();
        let luma = self.luma();
        let levels = self.params.haar.levels as usize;
        let (across, down) = (width >> levels << levels, height >> levels << levels);
        let of_level = |level: usize| {
            let side = 1usize << level;
            let mut bands = vec![Vec::new(); 3];
            for (j, i) in (0..down / side).flat_map(|j| (0..across / side).map(move |i| (j, i))) {
                let pixels = || (0..side).flat_map(move |dy| (0..side).map(move |dx| (dx, dy)));
                let clean = pixels().all(|(dx, dy)| self.counts(i * side + dx, j * side + dy));
                let centre = |index: usize| (index as f64 + 0.5) * side as f64;
                let Some(band) = self.band_at(centre(i), centre(j)).filter(|_| clean) else {
                    continue;
                };
                // The basis functions themselves: ±1 in each quarter, with norm 1.
                let mut block = [0.0; 3];
                for (dx, dy) in pixels() {
                    let value = luma[j * side + dy][i * side + dx] / side as f64;
                    let right = if dx < side / 2 { 1.0 } else { -1.0 };
                    let below = if dy < side / 2 { 1.0 } else { -1.0 };
                    block[0] += value * below;
                    block[1] += value * right;
                    block[2] += value * right * below;
                }
                bands[band].push(block);
            }
            bands
        };
        (1..=levels).map(of_level).collect()
    }

    fn check_haar(&self) {
        let found = self.measure(None);
        let mut some = 0;
        for (level, want) in (1..).zip(&self.coefficients()) {
            for (band, blocks) in want.iter().enumerate() {
                let value = |statistic: &str| found.value(haar(statistic, level, band));
                let count = Key::named(Subject::Metric(Metric::Haar), "coefficients").unwrap();
                let count = found.number(count.on_level(level).in_band(band));
                assert_eq!(count, 3 * blocks.len() as u64, "level {level}");
                let all: Vec<f64> = blocks.iter().flatten().copied().collect();
                near(STATISTICS.map(value), &all);
                some += blocks.len();
                for (index, orientation) in ["lh", "hl", "hh"].into_iter().enumerate() {
                    let of = STATISTICS.map(|name| value(&format!("{name}_{orientation}")));
                    let one: Vec<f64> = blocks.iter().map(|block| block[index]).collect();
                    if self.params.haar.orientations {
                        near(of, &one);
                    } else {
                        assert!(of.iter().all(Option::is_none), "{orientation}");
                    }
                }
            }
        }
        assert!(some > 0);
    }

    /// The RMS contrast of each band.
    fn contrasts(&self) -> Vec<Option<f64>> {
        let key = Key::of(Metric::RmsContrast).of_image(Image::Reference);
        let found = self.measure(None);
        (0..3).map(|band| found.get(key.in_band(band)).unwrap().value).collect()
    }
}

const STATISTICS: [&str; 3] = ["mean_abs", "max_abs", "energy"];

fn haar(statistic: &str, level: usize, band: usize) -> Key {
    let key = Key::named(Subject::Metric(Metric::Haar), statistic).unwrap();
    key.of_image(Image::Reference).on_level(level).in_band(band)
}

#[track_caller]
fn near(found: [Option<f64>; 3], coefficients: &[f64]) {
    let [Some(_), ..] = found else {
        assert!(coefficients.is_empty());
        return;
    };
    let count = coefficients.len() as f64;
    let want = [
        coefficients.iter().map(|c| c.abs()).sum::<f64>() / count,
        coefficients.iter().fold(0.0, |max: f64, c| max.max(c.abs())),
        coefficients.iter().map(|c| c * c).sum::<f64>() / count,
    ];
    for (found, want) in found.into_iter().zip(want) {
        let found = found.unwrap();
        assert!((found - want).abs() <= 1e-11 * want.max(1e-3), "{found} for {want}");
    }
}

#[test]
fn haar_is_the_sum_over_its_basis_functions() {
    for (width, height, levels) in
        [(97, 71, 5), (64, 64, 6), (2, 2, 1), (1091, 70, 3), (35, 130, 2)]
    {
        let levels = ParamValue::Number(f64::from(levels));
        Setup::new(width, height).set(Metric::Haar, "levels", &levels).check_haar();
    }
}

#[test]
fn levels_above_a_block_of_rows_are_no_different() {
    for (width, height, levels) in [(600, 300, 8), (128, 257, 7), (1030, 140, 7)] {
        let levels = ParamValue::Number(f64::from(levels));
        Setup::new(width, height).set(Metric::Haar, "levels", &levels).check_haar();
    }
}

#[test]
fn orientations_are_distinguished() {
    Setup::new(97, 71).set(Metric::Haar, "orientations", &ParamValue::Flag(true)).check_haar();
    // Horizontal stripes change only along y.
    let mut setup = Setup::new(64, 64).set(Metric::Haar, "orientations", &ParamValue::Flag(true));
    let stripes = (0..64 * 64).flat_map(|i| [if i / 64 % 2 == 0 { 255 } else { 0 }; 3]);
    setup.frame = rgb8(64, 64, stripes.collect());
    let found = setup.measure(None);
    let value = |statistic| found.value(haar(statistic, 1, 0)).unwrap();
    assert!((value("mean_abs_lh") - 1.0).abs() < 1e-12);
    assert!(value("max_abs_hl") == 0.0 && value("mean_abs_hh") == 0.0);
}

fn holes(width: usize, height: usize) -> Mask {
    let mut valid = vec![true; width * height];
    for (x, y) in [(3, 2), (40, 30), (41, 30), (90, 70), (width - 1, height - 1)] {
        valid[y * width + x] = false;
    }
    valid[50 * width..50 * width + 20].fill(false);
    Mask::new(width, height, valid).unwrap()
}

#[test]
fn a_block_with_a_pixel_left_out_does_not_count() {
    let mut setup = Setup::new(97, 71);
    setup.mask = Some(holes(97, 71));
    setup.check_haar();
    setup = Setup::new(300, 280).set(Metric::Haar, "levels", &ParamValue::Number(7.0));
    setup.mask = Some(holes(300, 280));
    setup.check_haar();
}

#[test]
fn rms_contrast_is_the_standard_deviation_of_a_band() {
    for mask in [false, true] {
        let mut setup = Setup::new(1030, 131);
        setup.mask = mask.then(|| holes(1030, 131));
        let found = setup.contrasts();
        let luma = setup.luma();
        for (band, found) in found.iter().enumerate() {
            let mut values = Vec::new();
            for (y, row) in luma.iter().enumerate() {
                for (x, value) in row.iter().enumerate() {
                    let here = setup.band_at(x as f64 + 0.5, y as f64 + 0.5) == Some(band);
                    if here && setup.counts(x, y) {
                        values.push(*value);
                    }
                }
            }
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let squared = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
            let want = (squared / values.len() as f64).sqrt();
            assert!((found.unwrap() - want).abs() < 1e-13, "band {band}");
        }
    }
}

#[test]
fn a_flat_picture_has_neither_contrast_nor_wavelets() {
    let mut setup = Setup::new(97, 71);
    setup.frame = rgb8(97, 71, [13, 77, 201].repeat(97 * 71));
    assert!(setup.contrasts().iter().all(|contrast| *contrast == Some(0.0)));
    let found = setup.measure(None);
    assert!(
        found.iter().filter(|row| row.key.metric() == Some(Metric::Haar)).all(|row| {
            row.key.statistic().is_count || row.value.is_none_or(|value| value == 0.0)
        })
    );
}

#[test]
fn parameters_of_contrast() {
    let setup = |name, value: &str| {
        Setup::new(60, 40).set(Metric::RmsContrast, name, &ParamValue::Text(value.to_owned()))
    };
    let plain = Setup::new(60, 40).contrasts()[0].unwrap();
    let by_mean = setup("normalise", "mean").contrasts()[0].unwrap();
    let luma = Setup::new(60, 40).luma();
    let s = Setup::new(60, 40);
    let inside: Vec<f64> = (0..40 * 60)
        .filter(|i| s.band_at((i % 60) as f64 + 0.5, (i / 60) as f64 + 0.5) == Some(0))
        .map(|i| luma[i / 60][i % 60])
        .collect();
    let mean = inside.iter().sum::<f64>() / inside.len() as f64;
    assert!((by_mean - plain / mean).abs() < 1e-12);
    let linear = setup("signal", "luminance").contrasts()[0].unwrap();
    assert!((linear - plain).abs() > 1e-3, "linear light is another signal");
}

#[test]
fn the_luma_is_left_for_the_next_frame() {
    let setup = Setup::new(600, 131);
    let mut plane = KeptPlane::default();
    setup.measure(Some(&mut plane));
    assert_eq!((plane.width(), plane.height()), (600, 131));
    for (y, row) in setup.luma().iter().enumerate() {
        let narrow: Vec<f32> = row.iter().map(|v| *v as f32).collect();
        assert_eq!(plane.row(y), narrow);
    }
}
