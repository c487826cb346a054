//! Compares the metrics with their formulas, written out literally in f64.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use fovqa_frame::{
    Channels, Frame, Luma, Mask, PairSignal, Samples, SignalChannels, SignalParams, SignalTables,
};
use fovqa_testkit::synthetic::{codes, disturbed, rgb8};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, View, ViewSpec};

use super::score_error::ScoreError;
use super::scorer::Scorer;
use crate::{Key, Metric, Params, Parts, Regions, Rows, Subject, WeightField};
use fovqa_params::ParamValue;

mod flat_regions;

const ALL: [Metric; 6] =
    [Metric::Mse, Metric::Psnr, Metric::Ssim, Metric::MsSsim, Metric::Fpsnr, Metric::Fssim];

fn view(width: usize, height: usize) -> View {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(80.0) };
    spec.resolve(width, height).unwrap().view
}

struct Setup {
    eccentricity: Eccentricity,
    bands: BandMap,
    params: Params,
    channels: SignalChannels,
    mask: Option<Mask>,
}

impl Setup {
    fn new(width: usize, height: usize, gaze: [f64; 2]) -> Self {
        let eccentricity = Eccentricity::new(view(width, height), gaze, EccentricityKind::Angular);
        let edges = BandEdges::new(vec![0.0, 10.0, 20.0, 35.0]).unwrap();
        Self {
            bands: BandMap::new(&eccentricity, &edges),
            eccentricity,
            params: Params::default(),
            channels: SignalChannels::Rgb,
            mask: None,
        }
    }

    fn score(&self, metrics: &[Metric], a: &Frame, b: &Frame) -> Result<Rows, ScoreError> {
        let params = SignalParams { channels: self.channels, ..SignalParams::default() };
        let tables = SignalTables::new(params);
        let scorer = Scorer::new(metrics.to_vec(), self.params.clone());
        let regions = match &self.mask {
            Some(mask) => Regions::masked(&self.bands, mask, self.params.ssim.window_radius()),
            None => Regions::unmasked(&self.bands),
        };
        let weight = WeightField::new(self.eccentricity, &self.params.fpsnr);
        let pair = PairSignal::new(a, b, &tables);
        let scored = scorer.score(&pair, &regions, Some(&weight))?;
        // The values are the same if maps are asked for.
        let with_maps = scorer.with_maps(true).score(&pair, &regions, Some(&weight))?;
        assert_eq!(with_maps.rows, scored.rows);
        Ok(scored.rows)
    }

    /// The band of a pixel, or `None`.
    fn band(&self, x: usize, y: usize) -> Option<usize> {
        let deg = self.eccentricity.at_deg(x as f64 + 0.5, y as f64 + 0.5);
        [(0.0, 10.0), (10.0, 20.0), (20.0, 35.0)].iter().position(|(a, b)| (*a..*b).contains(&deg))
    }

    /// f² of a pixel.
    fn weight(&self, x: usize, y: usize) -> f64 {
        let deg = self.eccentricity.at_deg(x as f64 + 0.5, y as f64 + 0.5);
        let cutoff = self.params.fpsnr.lee2002.cutoff_cpd(deg);
        cutoff.min(self.eccentricity.view().nyquist_cpd()).powi(2)
    }
}

/// The score of a whole frame.
fn score(rows: &Rows, metric: Metric) -> f64 {
    rows.value(Key::of(metric)).unwrap()
}

/// The planes of a frame in [0, 1].
fn planes(frame: &Frame, luma: bool) -> Vec<Vec<f64>> {
    let (w, h) = (frame.width(), frame.height());
    let plane = |c: usize| -> Vec<f64> {
        (0..w * h).map(|i| f64::from(frame.sample(c, i % w, i / w)) / 255.0).collect()
    };
    let rgb = [plane(0), plane(1), plane(2)];
    if !luma {
        return rgb.to_vec();
    }
    let weights = Luma::WEIGHTS.map(f64::from);
    vec![(0..w * h).map(|i| (0..3).map(|c| weights[c] * rgb[c][i]).sum()).collect()]
}

/// The maps of SSIM and of its contrast-structure term, computed window by window; NaN where no
/// window fits.
fn literal_maps(
    a: &[f64],
    b: &[f64],
    w: usize,
    h: usize,
    sigma: f64,
    radius: usize,
) -> [Vec<f64>; 2] {
    let r = radius as i64;
    let gauss = |k: i64| (-(k * k) as f64 / (2.0 * sigma * sigma)).exp();
    let total: f64 = (-r..=r).map(gauss).sum();
    let mut maps = [vec![f64::NAN; w * h], vec![f64::NAN; w * h]];
    for y in radius..h.saturating_sub(radius) {
        for x in radius..w.saturating_sub(radius) {
            let mut m = [0.0; 5];
            for dy in -r..=r {
                for dx in -r..=r {
                    let weight = gauss(dx) * gauss(dy) / (total * total);
                    let i = (y as i64 + dy) as usize * w + (x as i64 + dx) as usize;
                    let (a, b) = (a[i], b[i]);
                    for (m, v) in m.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                        *m += weight * v;
                    }
                }
            }
            let [ma, mb, aa, bb, ab] = m;
            let (c1, c2) = (0.01f64.powi(2), 0.03f64.powi(2));
            let structure = (2.0 * (ab - ma * mb) + c2) / (aa - ma * ma + bb - mb * mb + c2);
            let luminance = (2.0 * ma * mb + c1) / (ma * ma + mb * mb + c1);
            maps[0][y * w + x] = luminance * structure;
            maps[1][y * w + x] = structure;
        }
    }
    maps
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) =
        values.filter(|v| !v.is_nan()).fold((0.0, 0.0), |(s, n), v| (s + v, n + 1.0));
    sum / count
}

fn literal_ms_ssim(mut a: Vec<f64>, mut b: Vec<f64>, mut w: usize, mut h: usize) -> f64 {
    let mut score = 1.0;
    for (level, exponent) in [0.0448, 0.2856, 0.3001, 0.2363, 0.1333].into_iter().enumerate() {
        let [ssim, structure] = literal_maps(&a, &b, w, h, 1.5, 5);
        let map = if level == 4 { ssim } else { structure };
        score *= mean(map.into_iter()).max(0.0).powf(exponent);
        let halve = |p: &[f64]| -> Vec<f64> {
            let at = |x: usize, y: usize| p[y * w + x];
            (0..(w / 2) * (h / 2))
                .map(|i| (2 * (i % (w / 2)), 2 * (i / (w / 2))))
                .map(|(x, y)| (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4.0)
                .collect()
        };
        (a, b) = (halve(&a), halve(&b));
        (w, h) = (w / 2, h / 2);
    }
    score
}

fn pair(w: usize, h: usize, amount: f64) -> (Frame, Frame) {
    let reference = codes(w, h, 3, 7);
    let test = disturbed(&reference, amount, 9);
    (rgb8(w, h, reference), rgb8(w, h, test))
}

/// A picture and its ghost, which is the picture mixed with a shifted copy of itself. They differ
/// at every scale.
fn ghosted(w: usize, h: usize) -> (Frame, Frame) {
    const SHIFT: usize = 3 * 9;
    let reference = codes(w, h, 3, 7);
    let ghost = reference.iter().cycle().skip(SHIFT);
    let blend = |(a, b): (&u8, &u8)| ((3 * u16::from(*a) + 2 * u16::from(*b)) / 5) as u8;
    let test = reference.iter().zip(ghost).map(blend).collect();
    (rgb8(w, h, reference), rgb8(w, h, test))
}

/// Every metric, for the whole frame and per band, at sizes around those of blocks and tiles, in
/// RGB and luma.
#[test]
fn all_metrics_follow_their_formulas() {
    // Odd sizes; one more and one less than a block; more than a tile; the smallest size for
    // MS-SSIM.
    for (w, h, ms) in [(11, 11, false), (23, 65, false), (270, 63, false), (177, 193, true)] {
        let (a, b) = if ms { ghosted(w, h) } else { pair(w, h, 50.0) };
        for luma in [false, true] {
            let mut setup = Setup::new(w, h, [0.3 * w as f64, 0.6 * h as f64]);
            setup.channels = if luma { SignalChannels::Luma } else { SignalChannels::Rgb };
            let metrics: Vec<_> = ALL.into_iter().filter(|m| ms || *m != Metric::MsSsim).collect();
            let found = setup.score(&metrics, &a, &b).unwrap();
            let (pa, pb) = (planes(&a, luma), planes(&b, luma));
            let n = pa.len() as f64;
            let squared = |i: usize| -> f64 {
                pa.iter().zip(&pb).map(|(a, b)| (a[i] - b[i]).powi(2)).sum::<f64>() / n
            };
            let maps: Vec<_> = pa
                .iter()
                .zip(&pb)
                .map(|(a, b)| literal_maps(a, b, w, h, 1.5, 5)[0].clone())
                .collect();
            let map = |i: usize| maps.iter().map(|m| m[i]).sum::<f64>() / n;
            let weight = |i: usize| setup.weight(i % w, i / w);
            let weighted = |value: &dyn Fn(usize) -> f64| {
                let all = (0..w * h).filter(|&i| !value(i).is_nan());
                let (top, bottom) =
                    all.fold((0.0, 0.0), |(t, b), i| (t + weight(i) * value(i), b + weight(i)));
                top / bottom
            };
            let mse = mean((0..w * h).map(squared));
            let near = |metric: Metric, want: f64, tolerance: f64| {
                let got = score(&found, metric);
                assert!((got - want).abs() <= tolerance, "{metric:?} {w}x{h}: {got} for {want}");
            };
            near(Metric::Mse, mse, 1e-9);
            near(Metric::Psnr, -10.0 * mse.log10(), 1e-6);
            near(Metric::Ssim, mean((0..w * h).map(map)), 1e-6);
            near(Metric::Fpsnr, -10.0 * weighted(&squared).log10(), 2e-5);
            near(Metric::Fssim, weighted(&map), 2e-6);
            if ms {
                let scores =
                    pa.iter().zip(&pb).map(|(a, b)| literal_ms_ssim(a.clone(), b.clone(), w, h));
                near(Metric::MsSsim, scores.sum::<f64>() / n, 1e-6);
            }
            for index in 0..3 {
                let inside = |i: &usize| setup.band(i % w, i / w) == Some(index);
                let pixels = found.number(Key::pixels(Subject::Pixels).in_band(index));
                assert_eq!(pixels, (0..w * h).filter(inside).count() as u64);
                let of_band =
                    |value: &dyn Fn(usize) -> f64| mean((0..w * h).filter(inside).map(value));
                for (metric, want) in
                    [(Metric::Mse, of_band(&squared)), (Metric::Ssim, of_band(&map))]
                {
                    match found.value(Key::of(metric).in_band(index)) {
                        Some(got) => assert!((got - want).abs() < 2e-6, "{metric:?} band {index}"),
                        None => assert!(want.is_nan()),
                    }
                }
            }
        }
    }
}

#[test]
fn equal_pictures_are_equal_to_the_last_bit() {
    let (a, _) = pair(200, 180, 0.0);
    let found = Setup::new(200, 180, [20.0, 30.0]).score(&ALL, &a, &a).unwrap();
    for metric in ALL {
        let want = match metric {
            Metric::Mse => 0.0,
            Metric::Psnr | Metric::Fpsnr => f64::INFINITY,
            _ => 1.0,
        };
        assert_eq!(score(&found, metric), want, "{metric:?}");
    }
}

#[test]
fn eight_bit_errors_are_exact() {
    let (a, b) = pair(300, 130, 40.0);
    let found = Setup::new(300, 130, [150.0, 65.0]).score(&[Metric::Mse], &a, &b).unwrap();
    let (Samples::U8(a), Samples::U8(b)) = (a.samples(), b.samples()) else { unreachable!() };
    let squared: i64 = a.iter().zip(b).map(|(a, b)| (i64::from(*a) - i64::from(*b)).pow(2)).sum();
    assert_eq!(score(&found, Metric::Mse), squared as f64 / (3.0 * 300.0 * 130.0 * 255.0 * 255.0));
}

/// A constant error has the same weight everywhere; an error at the gaze has more weight than a
/// distant one.
#[test]
fn foveal_psnr_knows_where_the_error_is() {
    // With a focal length of 1000 px there is a flat zone of 8°, 141 px, around the gaze.
    let (w, h) = (400, 60);
    let gray = |code: u8| rgb8(w, h, vec![code; 3 * w * h]);
    let view = ViewSpec::PixelPitch { distance_m: 1.0, pitch_mm: 1.0 };
    let view = view.resolve(w, h).unwrap().view;
    let mut setup = Setup::new(w, h, [40.0, 50.0]);
    setup.eccentricity = Eccentricity::new(view, [40.0, 50.0], EccentricityKind::Angular);
    let both = [Metric::Psnr, Metric::Fpsnr];
    let constant = setup.score(&both, &gray(100), &gray(110)).unwrap();
    assert!((score(&constant, Metric::Psnr) - score(&constant, Metric::Fpsnr)).abs() < 1e-6);
    let spot = |x: usize, y: usize| {
        let mut codes = vec![100; 3 * w * h];
        codes[3 * (y * w + x)] = 200;
        score(&setup.score(&both, &gray(100), &rgb8(w, h, codes)).unwrap(), Metric::Fpsnr)
    };
    assert!((spot(40, 50) - spot(150, 20)).abs() < 1e-6, "the weight is flat near the gaze");
    assert!(spot(40, 50) < spot(350, 50) - 1.0);
}

#[test]
fn masked_pixels_do_not_affect_any_number() {
    let (w, h) = (90, 80);
    let (a, b) = pair(w, h, 40.0);
    let mut setup = Setup::new(w, h, [45.0, 40.0]);
    let inside = |i: usize| (10..70).contains(&(i % w)) && (8..75).contains(&(i / w));
    setup.mask = Mask::new(w, h, (0..w * h).map(inside).collect());
    let metrics = [Metric::Mse, Metric::Psnr, Metric::Ssim, Metric::Fpsnr, Metric::Fssim];
    let before = setup.score(&metrics, &a, &b).unwrap();
    // The result does not depend on the pixels outside the mask.
    let Samples::U8(codes) = b.samples().clone() else { unreachable!() };
    let mut codes = codes.into_vec();
    for (i, code) in codes.iter_mut().enumerate() {
        if !inside(i / 3) {
            *code = 255 - *code;
        }
    }
    let after = setup.score(&metrics, &a, &rgb8(w, h, codes)).unwrap();
    assert_eq!(before, after);
    let left_out = before.number(Key::pixels(Subject::PixelsLeftOut));
    assert_eq!(left_out, (w * h - 60 * 67) as u64);
    let parts = before.get(Key::of(Metric::Mse)).unwrap().parts;
    assert!(matches!(parts, Parts::Mean { weight: 4020.0, .. }), "60 x 67 pixels: {parts:?}");
    // The cropped pictures without a mask have the same windows.
    let crop = fovqa_frame::Crop { x: 10, y: 8, width: 60, height: 67 };
    let cropped = Setup::new(60, 67, [35.0, 32.0]);
    let (a, b) = (a.cropped(crop).unwrap(), b.cropped(crop).unwrap());
    let found = cropped.score(&[Metric::Mse, Metric::Ssim], &a, &b).unwrap();
    assert_eq!(score(&found, Metric::Mse), score(&before, Metric::Mse));
    assert!((score(&found, Metric::Ssim) - score(&before, Metric::Ssim)).abs() < 1e-9);
    let (a, b) = pair(180, 180, 40.0);
    let mut large = Setup::new(180, 180, [90.0, 90.0]);
    assert!(large.score(&[Metric::MsSsim], &a, &b).is_ok());
    large.mask = Mask::new(180, 180, (0..180 * 180).map(|i| i != 7).collect());
    let masked = large.score(&[Metric::MsSsim], &a, &b);
    assert_eq!(masked, Err(ScoreError::Masked { metric: Metric::MsSsim }));
}

#[test]
fn masks_without_pixels_or_windows_are_errors() {
    let (w, h) = (40, 40);
    let (a, b) = pair(w, h, 40.0);
    let mut setup = Setup::new(w, h, [20.0, 20.0]);
    setup.mask = Mask::new(w, h, vec![false; w * h]);
    assert_eq!(setup.score(&[Metric::Mse], &a, &b), Err(ScoreError::NothingLeft));
    setup.mask = Mask::new(w, h, (0..w * h).map(|i| i % 10 != 0).collect());
    let no_window = Err(ScoreError::NoWindow { metric: Metric::Ssim });
    assert_eq!(setup.score(&[Metric::Ssim], &a, &b), no_window);
    assert!(setup.score(&[Metric::Psnr], &a, &b).is_ok());
}

#[test]
fn small_pictures_are_refused_with_the_size_needed() {
    let (a, b) = pair(10, 40, 40.0);
    let setup = Setup::new(10, 40, [5.0, 20.0]);
    let error = setup.score(&[Metric::Ssim], &a, &b).unwrap_err();
    assert_eq!(error.to_string(), "SSIM needs 11 pixels on each side; the frame has 10x40");
    assert!(setup.score(&[Metric::Psnr, Metric::Fpsnr], &a, &b).is_ok());
    let (a, b) = pair(176, 175, 40.0);
    let error = Setup::new(176, 175, [5.0, 20.0]).score(&[Metric::MsSsim], &a, &b).unwrap_err();
    assert!(error.to_string().contains("176 pixels on each side"));
}

#[test]
fn the_window_may_have_any_size() {
    let (w, h) = (60, 40);
    let (a, b) = pair(w, h, 40.0);
    let mut setup = Setup::new(w, h, [30.0, 20.0]);
    setup.params.set(Metric::Ssim, "sigma", &ParamValue::Number(2.0)).unwrap();
    let found = score(&setup.score(&[Metric::Ssim], &a, &b).unwrap(), Metric::Ssim);
    let maps = planes(&a, false)
        .iter()
        .zip(planes(&b, false))
        .map(|(a, b)| mean(literal_maps(a, &b, w, h, 2.0, 7)[0].iter().copied()))
        .collect::<Vec<_>>();
    assert!((found - maps.iter().sum::<f64>() / 3.0).abs() < 1e-6);
}

type Maker<'a> = &'a dyn Fn(&[u8]) -> Frame;

/// The same picture in 8 bits, 16 bits and floats, gray and RGB, has the same scores.
#[test]
fn one_picture_scores_alike_in_every_type() {
    let (w, h) = (64, 48);
    let a = codes(w, h, 1, 3);
    let b = disturbed(&a, 60.0, 4);
    let as_u8 =
        |c: &[u8]| Frame::new(w, h, Channels::Gray, Samples::U8(c.to_vec().into())).unwrap();
    let as_u16 = |c: &[u8]| {
        let codes = c.iter().map(|c| u16::from(*c) * 257).collect();
        Frame::new(w, h, Channels::Gray, Samples::U16(codes)).unwrap()
    };
    let as_rgb = |c: &[u8]| rgb8(w, h, c.iter().flat_map(|c| [*c; 3]).collect());
    let as_linear = |c: &[u8]| {
        let light = |c: &u8| fovqa_frame::transfer::srgb::decode(f64::from(*c) / 255.0) as f32;
        Frame::new(w, h, Channels::Gray, Samples::F32(c.iter().map(light).collect())).unwrap()
    };
    let setup = Setup::new(w, h, [30.0, 20.0]);
    let metrics = [Metric::Psnr, Metric::Ssim, Metric::Fpsnr, Metric::Fssim];
    let want = setup.score(&metrics, &as_u8(&a), &as_u8(&b)).unwrap();
    let makers: [Maker<'_>; 4] = [&as_u8, &as_u16, &as_rgb, &as_linear];
    for of_reference in makers {
        for of_test in makers {
            let found = setup.score(&metrics, &of_reference(&a), &of_test(&b)).unwrap();
            for metric in metrics {
                let (got, want) = (score(&found, metric), score(&want, metric));
                assert!((got - want).abs() < 2e-5, "{metric:?}: {got} for {want}");
            }
        }
    }
}
