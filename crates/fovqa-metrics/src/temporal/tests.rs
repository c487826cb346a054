//! Compares temporal differences with their formula, written out literally.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use fovqa_frame::{Mask, Motion, Plane, PlaneSamples};
use fovqa_vision::{BandEdges, BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::atd::{AtdFrame, AtdSum, Params, differences};
use super::source::Link;
use super::*;
use crate::Regions;

fn noise(seed: u32, i: usize) -> f32 {
    let mut h = (i as u32 ^ seed).wrapping_mul(0x9e37_79b9);
    h = (h ^ (h >> 15)).wrapping_mul(0x85eb_ca6b);
    ((h ^ (h >> 13)) % 1000) as f32 / 1000.0
}

fn plane(width: usize, height: usize, value: impl Fn(usize, usize) -> f32) -> KeptPlane {
    let mut plane = KeptPlane::default();
    let values = plane.resized(width, height).values_mut();
    for (i, v) in values.iter_mut().enumerate() {
        *v = value(i % width, i / width);
    }
    plane
}

fn channel(width: usize, height: usize, value: impl Fn(usize, usize) -> f32) -> Plane {
    let values = (0..width * height).map(|i| value(i % width, i / width)).collect();
    Plane::new(width, height, PlaneSamples::F32(values)).unwrap()
}

fn depth_plane(width: usize, height: usize, value: impl Fn(usize, usize) -> f32) -> KeptPlane {
    let mut plane = KeptPlane::default();
    plane.take(&channel(width, height, value));
    plane
}

fn no_bands(width: usize, height: usize) -> BandMap {
    BandMap::without_bands(width, height)
}

fn link<'a>(regions: &'a Regions<'a>, motion: Option<&'a Motion>) -> Link<'a> {
    Link { motion, depth: None, regions, mask_before: None }
}

fn uniform(width: usize, height: usize, [mx, my]: [f32; 2]) -> Motion {
    let of = |m| channel(width, height, move |_, _| m);
    Motion::new(of(mx), of(my), [1.0; 2]).unwrap()
}

const W: usize = 600;
const H: usize = 90;

fn pattern(x: i64, y: i64) -> f32 {
    noise(3, (y * 4096 + x + 70_000) as usize)
}

fn only(link: &Link<'_>, now: &KeptPlane, before: &KeptPlane) -> AtdFrame {
    differences(link, &[(now, before)], &Params::default()).remove(0)
}

#[test]
fn a_pattern_moved_by_whole_pixels_with_its_motion_does_not_differ() {
    let bands = no_bands(W, H);
    let regions = Regions::unmasked(&bands);
    let before = plane(W, H, |x, y| pattern(x as i64, y as i64));
    let now = plane(W, H, |x, y| pattern(x as i64 - 7, y as i64 + 3));
    let motion = uniform(W, H, [-7.0, 3.0]);
    let found = only(&link(&regions, Some(&motion)), &now, &before);
    assert_eq!(found.whole.mean(), Some(0.0));
    // The sources of seven columns on the left and three rows at the bottom are outside.
    assert_eq!(found.whole.valid, ((W - 7) * (H - 3)) as u64);
    assert_eq!(found.left_out(), (W * H - (W - 7) * (H - 3)) as u64);
    let wrong = uniform(W, H, [7.0, -3.0]);
    assert!(only(&link(&regions, Some(&wrong)), &now, &before).whole.mean().unwrap() > 0.1);
    let still = only(&link(&regions, None), &before, &before);
    assert_eq!((still.whole.mean(), still.left_out()), (Some(0.0), 0));
}

#[test]
fn half_a_pixel_fetches_the_bilinear_value() {
    // A ramp of 1/1024 per column: half a pixel of motion is half a step.
    let bands = no_bands(64, 8);
    let regions = Regions::unmasked(&bands);
    let ramp = plane(64, 8, |x, _| x as f32 / 1024.0);
    let motion = uniform(64, 8, [0.5, 0.0]);
    let found = only(&link(&regions, Some(&motion)), &ramp, &ramp);
    // The last column's source is on the border, which is outside; 63 columns differ by half a
    // step.
    assert_eq!(found.whole.valid, 63 * 8);
    assert_eq!(found.whole.mean(), Some(0.5 / 1024.0));
    // Half a pixel back, the first column's source is in the border pixel: both of its taps are the
    // same pixel.
    let back = uniform(64, 8, [-0.5, 0.0]);
    let found = only(&link(&regions, Some(&back)), &ramp, &ramp);
    assert_eq!(found.whole.valid, 64 * 8);
    assert_eq!(found.whole.mean(), Some(63.0 * 0.5 / 1024.0 / 64.0));
}

#[test]
fn newly_visible_pixels_are_left_out_and_counted() {
    let bands = no_bands(64, 8);
    let regions = Regions::unmasked(&bands);
    let (now, before) = (plane(64, 8, |_, _| 0.75), plane(64, 8, |x, _| x as f32 / 64.0));
    // Depth is 2 now. Before, five columns were 1 away, and one was 1.91 away, which is within the
    // tolerance.
    let depth_now = channel(64, 8, |_, _| 2.0);
    let depth_before = depth_plane(64, 8, |x, _| match x {
        10..15 => 1.0,
        15 => 1.91,
        _ => 2.0,
    });
    let depth = Some((&depth_now, &depth_before));
    let with_depth = Link { depth, ..link(&regions, None) };
    let found = only(&with_depth, &now, &before);
    assert_eq!((found.whole.valid, found.left_out()), (59 * 8, 5 * 8));
    let off = Params { depth_tolerance: None };
    let found = differences(&with_depth, &[(&now, &before)], &off).remove(0);
    assert_eq!(found.left_out(), 0);
    let strict = Params { depth_tolerance: Some(0.04) };
    let found = differences(&with_depth, &[(&now, &before)], &strict).remove(0);
    assert_eq!(found.left_out(), 6 * 8);
}

#[test]
fn pixels_that_are_not_finite_are_left_out() {
    let bands = no_bands(64, 8);
    let regions = Regions::unmasked(&bands);
    let gray = plane(64, 8, |_, _| 0.5);
    let bad = |x: usize| match x {
        3 => f32::NAN,
        9 => f32::INFINITY,
        20 => f32::NEG_INFINITY,
        33 => 1e30,
        _ => 0.0,
    };
    let motion =
        Motion::new(channel(64, 8, |x, _| bad(x)), channel(64, 8, |_, y| bad(y + 30)), [1.0; 2]);
    let found = only(&link(&regions, motion.as_ref()), &gray, &gray);
    // Four columns are left out, and the row whose vertical motion is 1e30.
    assert_eq!(found.whole.valid, 60 * 7);
    let depth_now = channel(64, 8, |x, _| if x < 4 { f32::INFINITY } else { 5.0 });
    let depth_before = depth_plane(64, 8, |x, _| match x {
        0..4 => f32::INFINITY,
        8 => f32::NAN,
        _ => 5.0,
    });
    let depth = Some((&depth_now, &depth_before));
    let found = only(&Link { depth, ..link(&regions, None) }, &gray, &gray);
    assert_eq!(found.left_out(), 5 * 8);
}

/// The definition, pixel by pixel.
struct Literal {
    sums: Vec<f64>,
    valid: Vec<u64>,
}

#[test]
fn any_motion_depth_bands_and_masks_follow_the_formula() {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(40.0) };
    let view = spec.resolve(W, H).unwrap().view;
    let eccentricity = Eccentricity::new(view, [200.0, 30.0], EccentricityKind::Angular);
    let edges = [0.0, 10.0, 20.0, 60.0];
    let bands = BandMap::new(&eccentricity, &BandEdges::new(edges.to_vec()).unwrap());
    let mask = |seed: u32| {
        let valid = (0..W * H).map(|i| noise(seed, i) > 0.02).collect();
        Mask::new(W, H, valid).unwrap()
    };
    let (mask_now, mask_before) = (mask(11), mask(12));
    let regions = Regions::masked(&bands, &mask_now, 5);
    let (now, before) =
        (plane(W, H, |x, y| noise(1, y * W + x)), plane(W, H, |x, y| noise(2, y * W + x)));
    // Motion is smooth on the left and random on the right, with whole pixels here and there.
    let m = |seed: u32, x: usize, y: usize| match x {
        0..200 => (x as f32 * 0.01 - y as f32 * 0.02) + 0.3,
        200..300 => -2.0,
        _ => (noise(seed, y * W + x) - 0.5) * 60.0,
    };
    let motion = Motion::new(
        channel(W, H, |x, y| m(5, x, y)),
        channel(W, H, |x, y| m(6, x, y)),
        [1.0, -0.5],
    )
    .unwrap();
    let z_now = |x: usize, y: usize| 1.0 + noise(8, y * W + x) * 0.05;
    let z_before = |x: usize, y: usize| 1.0 + noise(9, y * W + x) * 0.09;
    let (depth_now, depth_before) = (channel(W, H, z_now), depth_plane(W, H, z_before));
    let link = Link {
        motion: Some(&motion),
        depth: Some((&depth_now, &depth_before)),
        regions: &regions,
        mask_before: Some(&mask_before),
    };

    let mut want = Literal { sums: vec![0.0; 4], valid: vec![0; 4] };
    for (x, y) in (0..H).flat_map(|y| (0..W).map(move |x| (x, y))) {
        if !mask_now.row(y)[x] {
            continue;
        }
        let at =
            [x as f64 + 0.5 + f64::from(m(5, x, y)), y as f64 + 0.5 - 0.5 * f64::from(m(6, x, y))];
        if at[0] < 0.0 || at[0] >= W as f64 || at[1] < 0.0 || at[1] >= H as f64 {
            continue;
        }
        let (near, far) =
            (f64::from(z_now(x, y)), f64::from(z_before(at[0] as usize, at[1] as usize)));
        if (far - near).abs() > 0.05 * near {
            continue;
        }
        let first = at.map(|at| (at - 0.5).floor());
        let (mut value, mut clean) = (0.0, true);
        for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let weight = |d: f64, axis: usize| {
                let part = at[axis] - 0.5 - first[axis];
                if d > 0.0 { part } else { 1.0 - part }
            };
            let weight = weight(dx, 0) * weight(dy, 1);
            let tap_x = (first[0] + dx).clamp(0.0, W as f64 - 1.0) as usize;
            let tap_y = (first[1] + dy).clamp(0.0, H as f64 - 1.0) as usize;
            value += weight * f64::from(before.row(tap_y)[tap_x]);
            clean &= weight == 0.0 || mask_before.row(tap_y)[tap_x];
        }
        if !clean {
            continue;
        }
        let deg = eccentricity.at_deg(x as f64 + 0.5, y as f64 + 0.5);
        let band = edges.windows(2).position(|e| (e[0]..e[1]).contains(&deg)).unwrap_or(3);
        want.sums[band] += (f64::from(now.row(y)[x]) - value).abs();
        want.valid[band] += 1;
    }

    let found = only(&link, &now, &before);
    assert_eq!(found.pixels, (W * H) as u64 - mask_now.left_out());
    assert_eq!(found.whole.valid, want.valid.iter().sum::<u64>());
    let near = |found: Option<f64>, want: f64| {
        assert!((found.unwrap() - want).abs() < 1e-7, "{found:?} for {want}");
    };
    near(found.whole.mean(), want.sums.iter().sum::<f64>() / found.whole.valid as f64);
    for (band, found) in found.bands.iter().enumerate() {
        assert_eq!(found.valid, want.valid[band], "band {band}");
        near(found.mean(), want.sums[band] / want.valid[band] as f64);
    }
    let both = differences(&link, &[(&before, &before), (&now, &before)], &Params::default());
    assert_eq!(both[1], found, "several pictures share their motion");
}

#[test]
fn a_band_without_a_valid_pixel_has_no_value() {
    let bands = no_bands(8, 8);
    let mask = Mask::new(8, 8, vec![false; 64]).unwrap();
    let nothing = Regions::masked(&bands, &mask, 1);
    let gray = plane(8, 8, |_, _| 0.5);
    let found = only(&link(&nothing, None), &gray, &gray);
    assert_eq!((found.whole, found.pixels), (AtdSum { sum: 0.0, valid: 0 }, 0));
}
