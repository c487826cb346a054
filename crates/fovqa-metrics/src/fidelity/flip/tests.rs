//! Compares FLIP with its definition, written out literally in f64, with kernels in two dimensions.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use std::f64::consts::PI;

use fovqa_frame::transfer::srgb;
use fovqa_frame::{Frame, Mask, SignalParams, SignalTables};
use fovqa_testkit::synthetic::{codes, disturbed, rgb8};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::*;
use crate::fidelity::fpsnr::{self, WeightField};
use crate::regions::{BlockRegions, Regions};
use crate::row::Key;

type Picture = Vec<[f64; 3]>;

/// The definition for pictures of linear red, green and blue.
pub(crate) fn literal(
    [reference, test]: [&Picture; 2],
    (width, height): (usize, usize),
    p: f64,
) -> Vec<f64> {
    let picture = |rgb: &Picture| Literal::new(rgb, (width, height), p);
    let (reference, test) = (picture(reference), picture(test));
    let most = libm::pow(hyab(hunt(lab([0.0, 1.0, 0.0])), hunt(lab([0.0, 0.0, 1.0]))), 0.7);
    let value = |i: usize| {
        let error = libm::pow(hyab(reference.lab[i], test.lab[i]), 0.7);
        let knee = 0.4 * most;
        let colour = if error < knee {
            0.95 * error / knee
        } else {
            0.95 + 0.05 * (error - knee) / (most - knee)
        };
        let apart = |f: fn(&Literal) -> &Vec<f64>| (f(&reference)[i] - f(&test)[i]).abs();
        let feature = apart(|of| &of.edges).max(apart(|of| &of.points)) / 2f64.sqrt();
        if colour > 0.0 { libm::pow(colour, 1.0 - feature.sqrt()) } else { 0.0 }
    };
    (0..width * height).map(value).collect()
}

const M: [[f64; 3]; 3] = [
    [10_135_552.0, 8_788_810.0, 4_435_075.0],
    [5_226_144.0, 17_577_620.0, 1_774_030.0],
    [475_104.0, 8_788_810.0 / 3.0, 70_074_185.0 / 3.0],
];
const WHITE: [f64; 3] = [0.950_428_545, 1.0, 1.088_900_371];

/// XYZ over that of white.
fn relative(rgb: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|c| M[i][c] / 24_577_794.0 * rgb[c]).sum::<f64>() / WHITE[i])
}

/// Linear RGB by Cramer's rule.
fn rgb(relative: [f64; 3]) -> [f64; 3] {
    let determinant = |m: [[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    std::array::from_fn(|c| {
        let mut with = M;
        for (row, (value, white)) in with.iter_mut().zip(relative.iter().zip(WHITE)) {
            row[c] = value * white * 24_577_794.0;
        }
        determinant(with) / determinant(M)
    })
}

fn lab(rgb: [f64; 3]) -> [f64; 3] {
    let f = |v: f64| {
        let straight = v / (3.0 * (6.0f64 / 29.0).powi(2)) + 4.0 / 29.0;
        if v > (6.0f64 / 29.0).powi(3) { libm::cbrt(v) } else { straight }
    };
    let [x, y, z] = relative(rgb).map(f);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn hunt([l, a, b]: [f64; 3]) -> [f64; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}

fn hyab(p: [f64; 3], q: [f64; 3]) -> f64 {
    (p[0] - q[0]).abs() + libm::hypot(p[1] - q[1], p[2] - q[2])
}

struct Literal {
    lab: Vec<[f64; 3]>,
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Literal {
    fn new(picture: &Picture, (width, height): (usize, usize), p: f64) -> Self {
        let opponents: Picture = picture
            .iter()
            .map(|rgb| {
                let [x, y, z] = relative(*rgb);
                [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
            })
            .collect();
        let filtered = |channel: usize, radius: isize, kernel: &dyn Fn(isize, isize) -> f64| {
            let at = |x: isize, y: isize| {
                let x = x.clamp(0, width as isize - 1) as usize;
                opponents[y.clamp(0, height as isize - 1) as usize * width + x][channel]
            };
            let value = |i: usize| {
                let (x, y) = ((i % width) as isize, (i / width) as isize);
                let offsets =
                    (-radius..=radius).flat_map(|j| (-radius..=radius).map(move |i| (i, j)));
                offsets.map(|(i, j)| kernel(i, j) * at(x + i, y + j)).sum::<f64>()
            };
            (0..width * height).map(value).collect::<Vec<f64>>()
        };
        let radius = (3.0 * p * (0.04 / (2.0 * PI * PI)).sqrt()).ceil() as isize;
        let sensitivity = |channel: usize, parts: &[(f64, f64)]| {
            let kernel = |i: isize, j: isize| {
                let square = ((i * i + j * j) as f64) / (p * p);
                let part =
                    |(a, b): &(f64, f64)| a * (PI / b).sqrt() * libm::exp(-PI * PI * square / b);
                parts.iter().map(part).sum::<f64>()
            };
            let offsets = (-radius..=radius).flat_map(|j| (-radius..=radius).map(move |i| (i, j)));
            let total = offsets.map(|(i, j)| kernel(i, j)).sum::<f64>();
            filtered(channel, radius, &|i, j| kernel(i, j) / total)
        };
        let [y, cx, cz] = [
            sensitivity(0, &[(1.0, 0.0047)]),
            sensitivity(1, &[(1.0, 0.0053)]),
            sensitivity(2, &[(34.1, 0.04), (13.5, 0.025)]),
        ];
        let lab = (0..width * height).map(|i| {
            let luminance = (y[i] + 16.0) / 116.0;
            let xyz = [cx[i] / 500.0 + luminance, luminance, luminance - cz[i] / 200.0];
            hunt(lab(rgb(xyz).map(|v| v.clamp(0.0, 1.0))))
        });
        let sigma = 0.5 * 0.082 * p;
        let reach = (3.0 * sigma).ceil() as isize;
        let gaussian = |i: isize| libm::exp(-((i * i) as f64) / (2.0 * sigma * sigma));
        let first = |i: isize| -(i as f64) * gaussian(i);
        let second = |i: isize| ((i * i) as f64 / (sigma * sigma) - 1.0) * gaussian(i);
        let of_sign = |kernel: &dyn Fn(isize) -> f64, sign: f64| {
            (-reach..=reach).map(|i| (sign * kernel(i)).max(0.0)).sum::<f64>()
        };
        let magnitude = |kernel: &dyn Fn(isize) -> f64| {
            let (above, below) = (of_sign(kernel, 1.0), of_sign(kernel, -1.0));
            let scaled = |i: isize| kernel(i) / if kernel(i) > 0.0 { above } else { below };
            let total = of_sign(&gaussian, 1.0);
            let across = filtered(0, reach, &|i, j| scaled(i) * gaussian(j) / total / 116.0);
            let down = filtered(0, reach, &|i, j| gaussian(i) / total * scaled(j) / 116.0);
            across.iter().zip(down).map(|(x, y)| libm::hypot(*x, y)).collect::<Vec<f64>>()
        };
        Self { lab: lab.collect(), edges: magnitude(&first), points: magnitude(&second) }
    }
}

/// A pair with a view.
struct Setup {
    size: (usize, usize),
    eccentricity: Eccentricity,
    frames: [Frame; 2],
    mask: Option<Mask>,
    signal: SignalParams,
    params: registry::Params,
}

const EDGES_DEG: [f64; 3] = [0.0, 10.0, 20.0];

impl Setup {
    fn new(width: usize, height: usize, ppd: Option<f64>) -> Self {
        let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(60.0) };
        let view = spec.resolve(width, height).unwrap().view;
        let gaze = [width as f64 * 0.3, height as f64 * 0.6];
        let reference = codes(width, height, 3, 7);
        let test = disturbed(&reference, 60.0, 2);
        let params = registry::Params { flip: Params { ppd }, ..registry::Params::default() };
        Self {
            size: (width, height),
            eccentricity: Eccentricity::new(view, gaze, EccentricityKind::Angular),
            frames: [reference, test].map(|codes| rgb8(width, height, codes)),
            mask: None,
            signal: SignalParams::default(),
            params,
        }
    }

    fn bands(&self) -> BandMap {
        BandMap::new(&self.eccentricity, &BandEdges::new(EDGES_DEG.to_vec()).unwrap())
    }

    fn measure(&self, with_view: bool) -> Result<Scored, ScoreError> {
        let bands =
            if with_view { self.bands() } else { BandMap::without_bands(self.size.0, self.size.1) };
        let regions = match &self.mask {
            None => Regions::unmasked(&bands),
            Some(mask) => Regions::masked(&bands, mask, 0),
        };
        let weight = WeightField::new(self.eccentricity, &fpsnr::Params::default());
        measure(
            &self.params.flip,
            &PairInput {
                reference: &self.frames[0],
                test: &self.frames[1],
                tables: &SignalTables::new(self.signal),
                regions: &regions,
                blocks: &BlockRegions::default(),
                eccentricity: with_view.then_some(&self.eccentricity),
                weight: with_view.then_some(&weight),
                map: true,
            },
        )
    }

    /// The literal map.
    fn literal(&self, p: f64) -> Vec<f64> {
        let linear = |frame: &Frame| -> Picture {
            let pixel = |i: usize| {
                let at = |c: usize| {
                    let (x, y) = (i % self.size.0, i / self.size.0);
                    let counts = self.mask.as_ref().is_none_or(|mask| mask.row(y)[x]);
                    let code = f64::from(frame.sample(c, x, y)) / 255.0;
                    if counts { srgb::decode(code) } else { 0.0 }
                };
                [at(0), at(1), at(2)]
            };
            (0..self.size.0 * self.size.1).map(pixel).collect()
        };
        let [reference, test] = self.frames.each_ref().map(linear);
        literal([&reference, &test], self.size, p)
    }
}

fn value(scored: &Scored, key: Key) -> f64 {
    scored.rows.value(key).unwrap()
}

fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.into_iter().collect();
    values.iter().sum::<f64>() / values.len() as f64
}

/// Sizes of one and of several tiles and blocks of rows; kernels smaller and larger than the picture.
#[test]
fn maps_are_the_definition() {
    for (width, height, ppd) in [(37, 29, 20.0), (290, 70, 11.2), (270, 9, 67.0), (1, 1, 35.0)] {
        let setup = Setup::new(width, height, Some(ppd));
        let scored = setup.measure(false).unwrap();
        let wanted = setup.literal(ppd);
        let map = &scored.maps[0];
        assert_eq!((map.info.name, map.values.len()), ("flip", wanted.len()));
        for (i, (found, wanted)) in map.values.iter().zip(&wanted).enumerate() {
            let (x, y) = (i % width, i / width);
            // The root of a feature's difference lifts rounding where that is near 0.
            assert!((f64::from(*found) - wanted).abs() < 3e-4, "{x},{y}: {found} for {wanted}");
        }
        let found = value(&scored, Key::of(Metric::Flip));
        assert!((found - mean(wanted)).abs() < 5e-6, "{width}x{height}: {found}");
        assert!(scored.warnings.is_empty());
    }
}

#[test]
fn bands_weights_and_masks_choose_the_pixels_that_count() {
    let mut setup = Setup::new(72, 66, None);
    for mask in
        [None, Some(Mask::new(72, 66, (0..72 * 66).map(|i| i % 72 > 20 || i / 72 == 5).collect()))]
    {
        setup.mask = mask.map(|mask| mask.unwrap());
        let scored = setup.measure(true).unwrap();
        // The pixels per degree are those of the view.
        let literal = setup.literal(setup.eccentricity.view().pixels_per_degree());
        let counts = |i: &usize| setup.mask.as_ref().is_none_or(|mask| mask.row(i / 72)[i % 72]);
        let of_pixels = |wanted: &dyn Fn(f64) -> bool| {
            let pixels = (0..72 * 66).filter(counts).filter(|i| {
                wanted(setup.eccentricity.at_deg((i % 72) as f64 + 0.5, (i / 72) as f64 + 0.5))
            });
            mean(pixels.map(|i| literal[i]))
        };
        let key = Key::of(Metric::Flip);
        let near = |found: f64, wanted: f64| {
            assert!((found - wanted).abs() < 1e-5, "{found} for {wanted}");
        };
        near(value(&scored, key), of_pixels(&|_| true));
        for band in 0..2 {
            let edges = EDGES_DEG[band]..EDGES_DEG[band + 1];
            near(value(&scored, key.in_band(band)), of_pixels(&|e| edges.contains(&e)));
        }
        let weight = WeightField::new(setup.eccentricity, &fpsnr::Params::default());
        let mut row = vec![0.0; 72];
        let (mut sum, mut total) = (0.0, 0.0);
        for y in 0..66 {
            weight.fill_row(y, 0..72, &mut row);
            for (x, weight) in row.iter().enumerate().filter(|(x, _)| counts(&(y * 72 + x))) {
                sum += f64::from(*weight) * literal[y * 72 + x];
                total += f64::from(*weight);
            }
        }
        near(value(&scored, key.nth(STATISTICS - 2)), sum / total);
        for (i, found) in scored.maps[0].values.iter().enumerate() {
            assert_eq!(found.is_nan(), !counts(&i), "{i}");
        }
    }
}

#[test]
fn equal_pictures_differ_nowhere_and_opposite_ones_by_1() {
    let mut setup = Setup::new(40, 30, Some(30.0));
    setup.frames[1] = setup.frames[0].clone();
    let scored = setup.measure(false).unwrap();
    assert!((0..6).all(|nth| value(&scored, Key::of(Metric::Flip).nth(nth)) == 0.0));
    assert!(scored.maps[0].values.iter().all(|v| *v == 0.0));
    let flat = |rgb: [u8; 3]| rgb8(40, 30, rgb.repeat(40 * 30));
    setup.frames = [flat([0, 255, 0]), flat([0, 0, 255])];
    let found = value(&setup.measure(false).unwrap(), Key::of(Metric::Flip));
    assert!((found - 1.0).abs() < 1e-6, "{found}");
}

#[test]
fn without_a_view_it_is_that_of_a_desktop_and_says_so() {
    let mut setup = Setup::new(40, 30, None);
    let scored = setup.measure(false).unwrap();
    assert!(scored.warnings[0].contains("flip.ppd"), "{:?}", scored.warnings);
    setup.params.flip.ppd = Some(DESKTOP_PPD);
    let said = setup.measure(false).unwrap();
    assert!(said.warnings.is_empty());
    let of = |scored: &Scored| value(scored, Key::of(Metric::Flip));
    assert_eq!(of(&said), of(&scored));
    assert_eq!(scored.rows.get(Key::of(Metric::Flip).nth(STATISTICS - 2)), None);
}

#[test]
fn what_has_no_colours_from_0_to_1_is_refused() {
    let mut setup = Setup::new(8, 8, Some(30.0));
    setup.signal.transfer = Some(Transfer::Pq);
    let error = setup.measure(false).unwrap_err();
    assert!(matches!(error, ScoreError::Unfit { help, .. } if help.contains("hdr_flip")));
    setup.signal.transfer = None;
    setup.mask = Some(Mask::new(8, 8, vec![false; 64]).unwrap());
    assert_eq!(setup.measure(true).unwrap_err(), ScoreError::NothingLeft);
}
