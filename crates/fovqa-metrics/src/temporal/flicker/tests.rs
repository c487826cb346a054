//! Compares flicker with its formula, written out literally.

use fovqa_frame::{Mask, Motion, Plane, PlaneSamples};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::super::{FrameBefore, KeptMotion, KeptPlane, Picture, TimeInput};
use crate::{Image, Key, Metric, Params, Regions, Rows};

/// Not a multiple of the width of tiles or lanes.
const W: usize = 300;
const H: usize = 70;

fn noise(seed: u32, i: usize) -> f32 {
    let mut h = (i as u32 ^ seed).wrapping_mul(0x9e37_79b9);
    h = (h ^ (h >> 15)).wrapping_mul(0x85eb_ca6b);
    ((h ^ (h >> 13)) % 1000) as f32 / 1000.0
}

fn channel(value: impl Fn(usize, usize) -> f32) -> Plane {
    let values = (0..W * H).map(|i| value(i % W, i / W)).collect();
    Plane::new(W, H, PlaneSamples::F32(values)).unwrap()
}

fn kept(plane: &Plane) -> KeptPlane {
    let mut kept = KeptPlane::default();
    kept.take(plane);
    kept
}

fn kept_motion(motion: &Motion) -> KeptMotion {
    let mut kept = KeptMotion::default();
    kept.take(motion);
    kept
}

/// The frames of a test, the present one first.
struct Frames {
    luma: Vec<Plane>,
    motion: Option<Vec<Motion>>,
    depth: Option<Vec<Plane>>,
    masks: Option<Vec<Mask>>,
}

impl Frames {
    /// Frames with these lumas, without motion.
    fn still(luma: Vec<Plane>) -> Self {
        Self { luma, motion: None, depth: None, masks: None }
    }

    fn measure(&self, regions: &Regions<'_>, params: &Params) -> Rows {
        let lumas: Vec<KeptPlane> = self.luma.iter().map(kept).collect();
        let motions: Vec<KeptMotion> = self.motion.iter().flatten().map(kept_motion).collect();
        let depths: Vec<KeptPlane> = self.depth.iter().flatten().map(kept).collect();
        let before: Vec<FrameBefore<'_>> = (1..self.luma.len())
            .map(|k| FrameBefore {
                motion: motions.get(k),
                depth: depths.get(k),
                mask: self.masks.as_ref().map(|masks| &masks[k]),
            })
            .collect();
        let input = TimeInput {
            motion: self.motion.as_ref().map(|motion| &motion[0]),
            depth: self.depth.as_ref().map(|depth| &depth[0]),
            regions,
            before: &before,
            pictures: &[Picture { image: Image::Test, lumas: lumas.iter().collect() }],
        };
        params.follow(Metric::Flicker, &input).unwrap().remove(0)
    }
}

fn params(frames: usize, detrend: bool) -> Params {
    let mut params = Params::default();
    (params.flicker.frames, params.flicker.detrend) = (frames, detrend);
    params
}

fn value(rows: &Rows) -> f64 {
    rows.value(Key::of(Metric::Flicker).of_image(Image::Test)).unwrap()
}

fn near(found: f64, want: f64) {
    assert!((found - want).abs() < 1e-7, "{found} for {want}");
}

#[test]
fn alternation_counts_and_a_drift_does_not() {
    let bands = BandMap::without_bands(W, H);
    let regions = Regions::unmasked(&bands);
    let of =
        |value: fn(usize) -> f32| Frames::still((0..8).map(|k| channel(|_, _| value(k))).collect());
    let alternating = of(|k| if k % 2 == 0 { 0.5625 } else { 0.4375 });
    near(value(&alternating.measure(&regions, &params(8, false))), 0.0625);
    // The line through eight alternating values has the slope of 4 / 42 amplitudes per frame, and so
    // takes 16 / 42 of 8 squared amplitudes away.
    let want = 0.0625 * ((8.0 - 16.0 / 42.0) / 8.0f64).sqrt();
    near(value(&alternating.measure(&regions, &params(8, true))), want);
    let drift = of(|k| 0.5 - k as f32 / 64.0);
    near(value(&drift.measure(&regions, &params(8, true))), 0.0);
    near(value(&drift.measure(&regions, &params(8, false))), (63.0f64 / 12.0).sqrt() / 64.0);
    // Two frames differ by two amplitudes.
    near(value(&alternating.measure(&regions, &params(2, false))), 0.0625);
}

/// Flicker of each band and outside all bands, and the number of pixels with a path of each, pixel by
/// pixel.
fn literal(
    frames: &Frames,
    band: impl Fn(usize, usize) -> Option<usize>,
    (n, detrend): (usize, bool),
) -> [(f64, u64); 4] {
    let mut sums = [(0.0, 0u64); 4];
    for (x, y) in (0..H).flat_map(|y| (0..W).map(move |x| (x, y))) {
        let Some(band) = band(x, y) else { continue };
        if let Some(values) = path(frames, x, y, n) {
            let mean = values.iter().sum::<f64>() / n as f64;
            let middle = (n - 1) as f64 / 2.0;
            let from_middle = |k: usize| k as f64 - middle;
            let squared: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
            let along: f64 =
                values.iter().enumerate().map(|(k, v)| from_middle(k) * (v - mean)).sum();
            let spread: f64 = (0..n).map(|k| from_middle(k).powi(2)).sum();
            let line = if detrend { along * along / spread } else { 0.0 };
            sums[band].0 += ((squared - line) / n as f64).max(0.0);
            sums[band].1 += 1;
        }
    }
    sums.map(|(sum, valid)| ((sum / valid as f64).sqrt(), valid))
}

/// The values along the path of a pixel; `None` if it has none.
fn path(frames: &Frames, x: usize, y: usize, n: usize) -> Option<Vec<f64>> {
    let mut at = [x as f64 + 0.5, y as f64 + 0.5];
    let mut values = vec![f64::from(frames.luma[0].at(x, y))];
    for k in 0..n - 1 {
        let here = at.map(|at| at as usize);
        let motion =
            frames.motion.as_ref().map_or([0.0; 2], |motion| motion[k].at(here[0], here[1]));
        at = [at[0] + motion[0], at[1] + motion[1]];
        let inside = (0.0..W as f64).contains(&at[0]) && (0.0..H as f64).contains(&at[1]);
        if !inside {
            return None;
        }
        if let Some(depth) = &frames.depth {
            let now = f64::from(depth[k].at(here[0], here[1]));
            let then = f64::from(depth[k + 1].at(at[0] as usize, at[1] as usize));
            let near = (then - now).abs() <= 0.05 * now.abs();
            if !near || now.is_infinite() {
                return None;
            }
        }
        let first = at.map(|at| (at - 0.5).floor());
        let mut value = 0.0;
        for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let weight = |d: f64, axis: usize| {
                let part = at[axis] - 0.5 - first[axis];
                if d > 0.0 { part } else { 1.0 - part }
            };
            let weight = weight(dx, 0) * weight(dy, 1);
            let tap_x = (first[0] + dx).clamp(0.0, W as f64 - 1.0) as usize;
            let tap_y = (first[1] + dy).clamp(0.0, H as f64 - 1.0) as usize;
            if weight > 0.0 && frames.masks.as_ref().is_some_and(|m| !m[k + 1].row(tap_y)[tap_x]) {
                return None;
            }
            value += weight * f64::from(frames.luma[k + 1].at(tap_x, tap_y));
        }
        values.push(value);
    }
    Some(values)
}

#[test]
fn paths_depth_bands_and_masks_follow_the_formula() {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(40.0) };
    let view = spec.resolve(W, H).unwrap().view;
    let eccentricity = Eccentricity::new(view, [120.0, 30.0], EccentricityKind::Angular);
    let edges = [0.0, 10.0, 20.0, 60.0];
    let bands = BandMap::new(&eccentricity, &BandEdges::new(edges.to_vec()).unwrap());
    let mask = |seed: u32| {
        let valid = (0..W * H).map(|i| noise(seed, i) > 0.01).collect();
        Mask::new(W, H, valid).unwrap()
    };
    let n = 5;
    // Motion is smooth on the left, of whole pixels in the middle and random on the right, where it
    // also leaves the frame or is not finite.
    let moved = |seed: u32, k: usize, x: usize, y: usize| match x {
        0..100 => x as f32 * 0.01 - y as f32 * 0.02 + k as f32 * 0.1 + 0.3,
        100..200 => -2.0,
        290 => f32::NAN,
        291 => 1e30,
        _ => (noise(seed + k as u32, y * W + x) - 0.5) * 30.0,
    };
    let motion = |k: usize| {
        let axes = [5, 90].map(|seed| channel(|x, y| moved(seed, k, x, y)));
        let [x, y] = axes;
        Motion::new(x, y, [1.0, -0.5]).unwrap()
    };
    let frames = Frames {
        luma: (0..n).map(|k| channel(|x, y| noise(k as u32, y * W + x))).collect(),
        motion: Some((0..n).map(motion).collect()),
        depth: Some(
            (0..n).map(|k| channel(|x, y| 1.0 + noise(40 + k as u32, y * W + x) * 0.06)).collect(),
        ),
        masks: Some((0..n).map(|k| mask(70 + k as u32)).collect()),
    };
    let now = frames.masks.as_ref().unwrap()[0].clone();
    let regions = Regions::masked(&bands, &now, 1);
    let band = |x: usize, y: usize| {
        let deg = eccentricity.at_deg(x as f64 + 0.5, y as f64 + 0.5);
        let band = edges.windows(2).position(|e| (e[0]..e[1]).contains(&deg)).unwrap_or(3);
        now.row(y)[x].then_some(band)
    };
    for (frames_used, detrend) in [(n, true), (n, false), (3, true)] {
        let want = literal(&frames, band, (frames_used, detrend));
        let rows = frames.measure(&regions, &params(frames_used, detrend));
        let key = Key::of(Metric::Flicker).of_image(Image::Test);
        for (band, (flicker, valid)) in want[..3].iter().enumerate() {
            let row = rows.get(key.in_band(band)).unwrap();
            near(row.value.unwrap(), *flicker);
            let crate::Parts::Mean { weight, .. } = row.parts else { panic!("a mean") };
            assert_eq!(weight as u64, *valid, "band {band}");
        }
        let paths: u64 = want.iter().map(|(_, valid)| valid).sum();
        let variance: f64 =
            want.iter().filter(|of| of.1 > 0).map(|(s, valid)| s * s * *valid as f64).sum();
        near(value(&rows), (variance / paths as f64).sqrt());
        let pixels = (W * H) as u64 - now.left_out();
        let left_out = rows.value(key.nth(1)).unwrap();
        near(left_out, (pixels - paths) as f64 / pixels as f64);
        assert!(paths > 500 && left_out > 0.1, "{paths} paths, {left_out}");
    }
}

#[test]
fn several_pictures_share_their_paths_and_bands_may_be_empty() {
    let bands = BandMap::without_bands(W, H);
    let mask = Mask::new(W, H, vec![false; W * H]).unwrap();
    let nothing = Regions::masked(&bands, &mask, 1);
    let frames = Frames::still((0..3).map(|k| channel(|x, y| noise(k, y * W + x))).collect());
    let rows = frames.measure(&nothing, &params(3, true));
    assert!(rows.iter().all(|row| row.key.statistic().name == "left_out" || row.value.is_none()));
    let all = Regions::unmasked(&bands);
    let alone = frames.measure(&all, &params(3, true));
    let lumas: Vec<KeptPlane> = frames.luma.iter().map(kept).collect();
    let still: Vec<KeptPlane> = vec![lumas[0].clone(); 3];
    let before = [FrameBefore { motion: None, depth: None, mask: None }; 2];
    let pictures = [
        Picture { image: Image::Reference, lumas: still.iter().collect() },
        Picture { image: Image::Test, lumas: lumas.iter().collect() },
    ];
    let input = TimeInput {
        motion: None,
        depth: None,
        regions: &all,
        before: &before,
        pictures: &pictures,
    };
    let both = params(3, true).follow(Metric::Flicker, &input).unwrap();
    assert_eq!(both[1], alone);
    let key = Key::of(Metric::Flicker).of_image(Image::Reference);
    assert_eq!(both[0].value(key), Some(0.0));
}

#[test]
fn a_line_goes_through_any_two_frames() {
    assert!(params(2, true).check().is_err());
    assert!(params(2, false).check().is_ok() && params(3, true).check().is_ok());
}
