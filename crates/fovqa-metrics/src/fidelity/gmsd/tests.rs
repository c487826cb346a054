//! Compares GMSD with its formula, written out literally in f64.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use fovqa_frame::{Frame, Mask, SignalParams, SignalTables};
use fovqa_testkit::synthetic::{codes, disturbed, rgb8};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::*;
use crate::regions::{BlockRegions, Regions};

const EDGES_DEG: [f64; 4] = [0.0, 10.0, 20.0, 35.0];

struct Setup {
    eccentricity: Eccentricity,
    frames: [Frame; 2],
    mask: Option<Mask>,
}

impl Setup {
    fn new(width: usize, height: usize) -> Self {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(80.0) };
        let view = spec.resolve(width, height).unwrap().view;
        let gaze = [width as f64 * 0.3, height as f64 * 0.6];
        let reference = codes(width, height, 3, 7);
        let test = disturbed(&reference, 40.0, 2);
        Self {
            eccentricity: Eccentricity::new(view, gaze, EccentricityKind::Angular),
            frames: [reference, test].map(|codes| rgb8(width, height, codes)),
            mask: None,
        }
    }

    fn measure(&self, maps: &[BandMap]) -> Result<Scored, ScoreError> {
        let blocks = match &self.mask {
            None => BlockRegions::unmasked(maps),
            Some(mask) => BlockRegions::masked(maps, mask),
        };
        let [reference, test] = &self.frames;
        let pixels = BandMap::without_bands(reference.width(), reference.height());
        measure(&PairInput {
            reference,
            test,
            tables: &SignalTables::new(SignalParams::default()),
            regions: &Regions::unmasked(&pixels),
            blocks: &blocks,
            eccentricity: None,
            weight: None,
            map: true,
        })
    }

    fn scored(&self) -> Result<Scored, ScoreError> {
        let edges = BandEdges::new(EDGES_DEG.to_vec()).unwrap();
        self.measure(&BlockRegions::maps(&self.eccentricity, &edges, LEVELS))
    }

    /// The literal map, with the band of each block; NaN where a block is left out.
    fn literal(&self) -> Vec<(f64, Option<usize>)> {
        let (w, h) = (self.frames[0].width() / 2, self.frames[0].height() / 2);
        let luma = |frame: &Frame, x: usize, y: usize| {
            let code = |c: usize| f64::from(frame.sample(c, x, y)) / 255.0;
            0.2126 * code(0) + 0.7152 * code(1) + 0.0722 * code(2)
        };
        let half = |frame: &Frame, i: i64, j: i64| -> f64 {
            if i < 0 || j < 0 || i >= w as i64 || j >= h as i64 {
                return 0.0;
            }
            let (x, y) = (2 * i as usize, 2 * j as usize);
            let sum = luma(frame, x, y) + luma(frame, x + 1, y);
            (sum + luma(frame, x, y + 1) + luma(frame, x + 1, y + 1)) / 4.0
        };
        let gradient = |frame: &Frame, i: i64, j: i64| {
            let three = |of: &dyn Fn(i64) -> f64| (-1..=1).map(of).sum::<f64>();
            let at = |dx: i64, dy: i64| half(frame, i + dx, j + dy);
            let across = three(&|d| at(1, d)) - three(&|d| at(-1, d));
            let down = three(&|d| at(d, 1)) - three(&|d| at(d, -1));
            (across / 3.0).hypot(down / 3.0)
        };
        let counts = |i: i64, j: i64| {
            let outside = i < 0 || j < 0 || i >= w as i64 || j >= h as i64;
            let pixel = |dx: usize, dy: usize| {
                let (x, y) = (2 * i as usize + dx, 2 * j as usize + dy);
                self.mask.as_ref().is_none_or(|mask| mask.row(y)[x])
            };
            outside || (pixel(0, 0) && pixel(1, 0) && pixel(0, 1) && pixel(1, 1))
        };
        let value = |index: usize| {
            let (i, j) = ((index % w) as i64, (index / w) as i64);
            let clean = (-1..=1).all(|dy| (-1..=1).all(|dx| counts(i + dx, j + dy)));
            let [g, h] = self.frames.each_ref().map(|frame| gradient(frame, i, j));
            let c = 170.0 / (255.0 * 255.0);
            let similarity = (2.0 * g * h + c) / (g * g + h * h + c);
            let deg = self.eccentricity.at_deg((2 * i + 1) as f64, (2 * j + 1) as f64);
            let band = EDGES_DEG.windows(2).position(|e| (e[0]..e[1]).contains(&deg));
            (if clean { similarity } else { f64::NAN }, band)
        };
        (0..w * h).map(value).collect()
    }

    fn check(&self) {
        let literal = self.literal();
        let Scored { rows, maps, .. } = self.scored().unwrap();
        let deviation = |band: Option<usize>| -> (u64, f64, f64) {
            let of_band = |(_, of): &&(f64, Option<usize>)| band.is_none() || *of == band;
            let values = literal.iter().filter(of_band).map(|(value, _)| *value);
            let values: Vec<f64> = values.filter(|value| !value.is_nan()).collect();
            let count = values.len() as f64;
            let mean = values.iter().sum::<f64>() / count;
            let squared = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
            let deviation = (squared / (count - 1.0)).sqrt();
            (values.len() as u64, mean, if count < 2.0 { f64::NAN } else { deviation })
        };
        let key = Key::of(Metric::Gmsd);
        let near = |key: Key, want: f64| match rows.value(key) {
            Some(found) => assert!((found - want).abs() < 1e-8, "{found} for {want}"),
            None => assert!(want.is_nan(), "none for {want}"),
        };
        near(key, deviation(None).2);
        near(key.nth(MEAN), deviation(None).1);
        for band in 0..3 {
            let (count, mean, deviation) = deviation(Some(band));
            near(key.in_band(band), deviation);
            assert_eq!(rows.number(key.nth(COUNT).in_band(band)), count, "band {band}");
            near(key.nth(MEAN).in_band(band), mean);
        }
        assert_eq!(maps[0].values.len(), literal.len());
        for (found, (want, _)) in maps[0].values.iter().zip(&literal) {
            let alike = (f64::from(*found) - want).abs() < 1e-7;
            assert!(alike || (found.is_nan() && want.is_nan()), "{found} for {want}");
        }
    }
}

/// Sizes around those of blocks and tiles, odd and even, and the smallest size.
#[test]
fn it_follows_its_formula() {
    for (width, height) in [(4, 4), (5, 7), (1031, 67), (130, 257), (513, 130)] {
        Setup::new(width, height).check();
    }
}

#[test]
fn blocks_beside_a_pixel_left_out_do_not_count() {
    for (width, height) in [(300, 139), (70, 270)] {
        let mut setup = Setup::new(width, height);
        let mut valid = vec![true; width * height];
        for (x, y) in [(0, 0), (width - 1, height - 1), (41, 30), (40, 127), (20, 64), (60, 100)] {
            valid[y * width + x] = false;
        }
        valid[50 * width..50 * width + 20].fill(false);
        setup.mask = Mask::new(width, height, valid);
        setup.check();
    }
}

#[test]
fn identical_pictures_do_not_deviate_at_all() {
    let mut setup = Setup::new(97, 71);
    setup.frames[1] = setup.frames[0].clone();
    let Scored { rows, maps, .. } = setup.scored().unwrap();
    assert_eq!(rows.value(Key::of(Metric::Gmsd)), Some(0.0));
    assert_eq!(rows.value(Key::of(Metric::Gmsd).nth(MEAN).in_band(0)), Some(1.0));
    assert!(maps[0].values.iter().all(|value| *value == 1.0));
}

#[test]
fn frames_too_small_and_masks_without_two_blocks_are_errors() {
    let needed = SMALLEST_SIDE;
    let error = Setup::new(3, 50).scored().unwrap_err();
    let wanted = ScoreError::TooSmall { metric: Metric::Gmsd, width: 3, height: 50, needed };
    assert_eq!(error, wanted);
    let mut setup = Setup::new(8, 8);
    setup.mask = Mask::new(8, 8, (0..64).map(|i| i == 9).collect());
    let error = setup.scored().unwrap_err();
    assert!(matches!(error, ScoreError::TooFew { metric: Metric::Gmsd, .. }), "{error}");
}

/// Without a view there are no bands, but the whole frame is measured nevertheless.
#[test]
fn bands_are_not_needed() {
    let setup = Setup::new(97, 71);
    let maps = BlockRegions::maps_without_bands((97, 71), LEVELS);
    let rows = setup.measure(&maps).unwrap().rows;
    let with_bands = setup.scored().unwrap().rows;
    let key = Key::of(Metric::Gmsd);
    let [found, wanted] = [&rows, &with_bands].map(|rows| rows.value(key).unwrap());
    assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}");
    assert_eq!(rows.iter().count(), 2);
}
