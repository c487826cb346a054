//! Compares the spectrum with its formula, written out literally.

#![allow(clippy::float_cmp, reason = "powers of two are exact")]

use std::collections::BTreeMap;
use std::f64::consts::{PI, SQRT_2, TAU};

use fovqa_frame::{Channels, Frame, Mask, Samples, SignalParams, SignalTables};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::super::{PictureInput, Profiler};
use super::*;
use crate::regions::{BlockRegions, Regions};

const W: usize = 61;
const H: usize = 43;
const B: usize = 16;

/// A gray picture: a gradient, waves and noise.
fn luma() -> Vec<f32> {
    let value = |i: usize| {
        let (x, y) = ((i % W) as f64, (i / W) as f64);
        let noise = ((i * 7919) % 1009) as f64 / 1009.0;
        let wave = libm::sin(x * 1.3) * libm::cos(y * 0.7);
        (0.3 + 0.004 * x + 0.1 * wave + 0.1 * noise) as f32
    };
    (0..W * H).map(value).collect()
}

struct Setup {
    eccentricity: Eccentricity,
    edges: BandEdges,
}

impl Setup {
    fn new() -> Self {
        let spec = ViewSpec::Fov { horizontal_deg: Some(70.0), vertical_deg: None };
        let view = spec.resolve(W, H).unwrap().view;
        let eccentricity = Eccentricity::new(view, [22.0, 15.5], EccentricityKind::Angular);
        Self { eccentricity, edges: BandEdges::new(vec![0.0, 12.0, 25.0, 40.0]).unwrap() }
    }

    fn measure(&self, luma: &[f32], mask: Option<&Mask>) -> Rows {
        let samples = Samples::F32(luma.to_vec().into());
        let frame = Frame::new(W, H, Channels::Gray, samples).unwrap().encoded();
        let tables = SignalTables::new(SignalParams::default());
        let bands = BandMap::new(&self.eccentricity, &self.edges);
        let regions = match mask {
            Some(mask) => Regions::masked(&bands, mask, 0),
            None => Regions::unmasked(&bands),
        };
        let mut params = crate::Params::default();
        params.spectrum.block = B as u32;
        let input = PictureInput {
            frame: &frame,
            tables: &tables,
            regions: &regions,
            blocks: &BlockRegions::default(),
            seen: Some((&self.eccentricity, &self.edges)),
            image: Image::Reference,
        };
        Profiler::new(&[Metric::Spectrum], &params).measure(&input, None)
    }
}

/// P(u, v) of a block, by the definition, for u and v from -B/2 to B/2 - 1.
fn power(luma: &[f64], corner: [usize; 2]) -> Vec<([f64; 2], f64)> {
    let window = |i: usize| libm::sin(PI * (i as f64 + 0.5) / B as f64).powi(2);
    let all = || (0..B).flat_map(|j| (0..B).map(move |i| (i, j)));
    let at = |i: usize, j: usize| luma[(corner[1] + j) * W + corner[0] + i];
    let weights: f64 = all().map(|(i, j)| window(i) * window(j)).sum();
    let mean: f64 = all().map(|(i, j)| window(i) * window(j) * at(i, j)).sum::<f64>() / weights;
    let squares: f64 = all().map(|(i, j)| (window(i) * window(j)).powi(2)).sum();
    let half = B as i32 / 2;
    let frequencies = (-half..half).flat_map(|v| (-half..half).map(move |u| [u, v]));
    let of = |[u, v]: [i32; 2]| {
        let (mut real, mut imaginary) = (0.0, 0.0);
        for (i, j) in all() {
            let q = window(i) * window(j) * (at(i, j) - mean);
            let turns = f64::from(u) * i as f64 + f64::from(v) * j as f64;
            let (sine, cosine) = libm::sincos(-TAU * turns / B as f64);
            real += q * cosine;
            imaginary += q * sine;
        }
        let power = (real * real + imaginary * imaginary) / ((B * B) as f64 * squares);
        ([f64::from(u), f64::from(v)], power)
    };
    frequencies.map(of).collect()
}

#[derive(Default)]
struct LiteralBand {
    blocks: u64,
    /// ΣP, Σ P/Δ² and the number of samples, by half octave.
    bins: BTreeMap<i16, (f64, f64, u64)>,
}

fn literal(setup: &Setup, luma: &[f64], mask: Option<&Mask>) -> Vec<LiteralBand> {
    let mut bands: Vec<LiteralBand> =
        (0..setup.edges.count()).map(|_| LiteralBand::default()).collect();
    let view = setup.eccentricity.view();
    let corners = (0..=H - B).step_by(B / 2);
    let corners = corners.flat_map(|y| (0..=W - B).step_by(B / 2).map(move |x| [x, y]));
    for corner in corners {
        let clean = mask.is_none_or(|mask| {
            (0..B).all(|j| mask.row(corner[1] + j)[corner[0]..corner[0] + B].iter().all(|ok| *ok))
        });
        let centre = corner.map(|at| (at + B / 2) as f64);
        let deg = setup.eccentricity.at_deg(centre[0], centre[1]);
        let Some(band) = setup.edges.iter().position(|(from, to)| from <= deg && deg < to) else {
            continue;
        };
        if !clean {
            continue;
        }
        let rho: f64 =
            (0..2).map(|i| ((centre[i] - view.principal_px[i]) / view.focal_px[i]).powi(2)).sum();
        let ppd = view.pixels_per_degree() * (1.0 + rho).powf(0.75);
        let step = ppd / B as f64;
        bands[band].blocks += 1;
        for ([u, v], power) in power(luma, corner) {
            if [u, v] != [0.0; 2] {
                let f = (u * u + v * v).sqrt() * step;
                let k = (2.0 * f.log2() + 0.5).floor() as i16;
                let bin = bands[band].bins.entry(k).or_default();
                *bin = (bin.0 + power, bin.1 + power / (step * step), bin.2 + 1);
            }
        }
    }
    bands
}

fn key(statistic: &str, band: usize) -> Key {
    let key = Key::named(crate::Subject::Metric(Metric::Spectrum), statistic).unwrap();
    key.in_band(band)
}

fn near(found: Option<f64>, want: f64) {
    let found = found.unwrap();
    assert!((found - want).abs() <= 1e-9 * want, "{found} for {want}");
}

#[test]
fn power_and_density_of_bands_and_masks_follow_the_formula() {
    let setup = Setup::new();
    let gray = luma();
    let values: Vec<f64> = gray.iter().map(|v| f64::from(*v)).collect();
    let mut valid = vec![true; W * H];
    valid[20 * W + 20] = false;
    let mask = Mask::new(W, H, valid).unwrap();
    let mut blocks = [0, 0];
    for (index, mask) in [None, Some(&mask)].into_iter().enumerate() {
        let rows = setup.measure(&gray, mask);
        let want = literal(&setup, &values, mask);
        for (band, want) in want.iter().enumerate() {
            assert_eq!(rows.number(key(BLOCKS, band)), want.blocks);
            blocks[index] += want.blocks;
            let bins = rows.iter().filter(|row| {
                row.key.band == Some(band as u16) && row.key.statistic().name == "power"
            });
            assert_eq!(bins.count(), want.bins.len(), "bins without samples are not listed");
            for (&k, &(power, density, samples)) in &want.bins {
                let of = |name| key(name, band).at_level(k).of_image(Image::Reference);
                near(rows.value(of("power")), power / want.blocks as f64);
                near(rows.value(of("density")), density / samples as f64);
                assert_eq!(rows.number(key(SAMPLES, band).at_level(k)), samples);
            }
        }
    }
    assert_eq!(blocks, [24, 20], "four blocks have the pixel");
}

/// With the window's weights, the variance of a block is the sum of its power (Parseval).
#[test]
fn power_adds_up_to_the_windowed_variance() {
    let setup = Setup::new();
    let gray = luma();
    let rows = setup.measure(&gray, None);
    let window = |i: usize| libm::sin(PI * (i as f64 + 0.5) / B as f64).powi(2);
    let weight = |i: usize| window(i % B) * window(i / B);
    let block = |corner: [usize; 2]| {
        let at = |i: usize| f64::from(gray[(corner[1] + i / B) * W + corner[0] + i % B]);
        let weights: f64 = (0..B * B).map(weight).sum();
        let mean = (0..B * B).map(|i| weight(i) * at(i)).sum::<f64>() / weights;
        let squares: f64 = (0..B * B).map(|i| weight(i).powi(2)).sum();
        (0..B * B).map(|i| (weight(i) * (at(i) - mean)).powi(2)).sum::<f64>() / squares
    };
    let mut variances = vec![(0.0, 0u64); setup.edges.count()];
    for (x, y) in (0..=H - B).step_by(8).flat_map(|y| (0..=W - B).step_by(8).map(move |x| (x, y))) {
        let deg = setup.eccentricity.at_deg((x + 8) as f64, (y + 8) as f64);
        if let Some(band) = setup.edges.iter().position(|(from, to)| (from..to).contains(&deg)) {
            variances[band].0 += block([x, y]);
            variances[band].1 += 1;
        }
    }
    for (band, (sum, blocks)) in variances.into_iter().enumerate() {
        let power = rows
            .iter()
            .filter(|row| row.key.band == Some(band as u16) && row.key.statistic().name == "power");
        let power: f64 = power.filter_map(|row| row.value).sum();
        // The mean is taken out, and so (0,0) has only what the window lets through.
        assert!((power / (sum / blocks as f64) - 1.0).abs() < 0.02, "{power} of {sum}");
    }
}

#[test]
fn half_octaves_meet_between_their_centres() {
    assert_eq!(centre_cpd(0), 1.0);
    assert_eq!([centre_cpd(4), centre_cpd(-6)], [4.0, 0.125]);
    assert_eq!([centre_cpd(3), centre_cpd(-1)], [2.0 * SQRT_2, 0.5 * SQRT_2]);
    for k in -40..40 {
        let centre = centre_cpd(k);
        assert_eq!(half_octave(centre * centre), k);
        assert_eq!(half_octave(end_squared(k)), k + 1, "an end belongs to the next one");
        assert_eq!(half_octave(end_squared(k) * (1.0 - 1e-12)), k);
    }
}

fn cutoff(powers: &[(i16, f64, f64)]) -> Option<f64> {
    let mut rows = Rows::default();
    rows.count(key(BLOCKS, 2), 3);
    for &(k, reference, test) in powers {
        let key = key("power", 2).at_level(k);
        rows.score(key.of_image(Image::Reference), reference);
        rows.score(key.of_image(Image::Test), test);
    }
    rows.derive();
    rows.get(key(CUTOFF, 2)).unwrap().value
}

#[test]
fn the_cut_off_is_the_last_half_octave_before_the_first_lost_one() {
    assert_eq!(
        cutoff(&[(-2, 1.0, 1.0), (-1, 1.0, 0.5), (0, 1.0, 0.49), (1, 1.0, 1.0)]),
        Some(0.5 * SQRT_2)
    );
    assert_eq!(cutoff(&[(-2, 1.0, 0.4), (-1, 1.0, 1.0)]), None);
    assert_eq!(cutoff(&[(-2, 1.0, 1.0), (0, 1.0, 2.0)]), Some(1.0), "nothing is lost");
    // Where the reference has nothing, nothing is lost.
    assert_eq!(cutoff(&[(-2, 1.0, 1.0), (0, 1e-13, 0.0), (2, 1.0, 0.9), (4, 1.0, 0.0)]), Some(2.0));
    assert_eq!(cutoff(&[]), None);
}

#[test]
fn a_block_has_a_power_of_two() {
    let block = |block| Params { block }.check().is_ok();
    assert!(block(16) && block(256) && !block(48));
}
