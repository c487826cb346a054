//! Geometry, photometry and pooling compared with values that were calculated by hand.

use std::f64::consts::PI;

use fovqa_vision::{Luminance, View};

use super::*;
use crate::fidelity::fvvdp::bands::bands;
use crate::fidelity::fvvdp::contrast::{background, differences};
use crate::fidelity::fvvdp::csf::{Coordinates, ECC_STEPS, RHO_FROM, RHO_STEPS_PER_OCTAVE};
use crate::fidelity::fvvdp::geometry::BandDirections;
use crate::fidelity::fvvdp::masking::{log2_masked, powers};
use crate::fidelity::fvvdp::pooling::{over_bands, over_channels, over_pixels};
use crate::fidelity::fvvdp::pyramid::expand;

fn seen(spec: &ViewSpec, width: usize, height: usize) -> Geometry {
    Geometry::new(spec.resolve(width, height).unwrap().view, None)
}

/// Checks the display's size divided by its distance, across and down, and its pixels per degree,
/// as FovVideoVDP's geometry defines them.
fn check(what: &str, geometry: &Geometry, [across, down]: [f64; 2]) {
    let View { width, height, .. } = geometry.view;
    let (w, h) = (width as f64, height as f64);
    let ppd = 1.0 / (2.0 * (0.5 * across / w).atan().to_degrees());
    assert_near(what, [geometry.pixels_per_degree], [ppd], [1e-12, 0.0]);
    for [x, y] in [[0.0, 0.0], [0.5, 0.5], [w / 2.0, h / 2.0], [w, h], [-3.0, 2.0 * h]] {
        let direction = [(x - w / 2.0) * across / w, -(y - h / 2.0) * down / h];
        let wanted = direction.map(|tangent| tangent.atan().to_degrees());
        assert_near(what, geometry.direction_deg([x, y]), wanted, [1e-12, 1e-12]);
    }
}

#[test]
fn fields_of_view_given_by_hand() {
    let (w, h) = (1440.0, 1600.0);
    let half = |deg: f64| (deg / 2.0).to_radians().tan();
    let vertical = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(100.0) };
    let down = 2.0 * half(100.0);
    check("vertical", &seen(&vertical, 1440, 1600), [down * w / h, down]);
    let horizontal = ViewSpec::Fov { horizontal_deg: Some(90.0), vertical_deg: None };
    let across = 2.0 * half(90.0);
    check("horizontal", &seen(&horizontal, 1440, 1600), [across, across * h / w]);
    let diagonal = ViewSpec::FovDiagonal { diagonal_deg: 110.0 };
    let distance_px = w.hypot(h) / (2.0 * half(110.0));
    check("diagonal", &seen(&diagonal, 1440, 1600), [w / distance_px, h / distance_px]);
    let t = half(80.0);
    let frustum = ViewSpec::Frustum { left: t, right: t, up: 1.1, down: 1.1 };
    check("frustum", &seen(&frustum, 1440, 1600), [2.0 * t, 2.2]);
}

#[test]
fn the_centre_of_a_frustum_is_where_it_is_seen_straight_ahead() {
    let frustum = ViewSpec::Frustum { left: 1.0, right: 3.0, up: 0.5, down: 1.5 };
    let geometry = seen(&frustum, 400, 200);
    assert_near("ahead", geometry.direction_deg([100.0, 50.0]), [0.0, 0.0], [0.0, 1e-12]);
    let sides = geometry.direction_deg([400.0, 200.0]);
    let wanted = [3f64.atan().to_degrees(), -1.5f64.atan().to_degrees()];
    assert_near("right and down", sides, wanted, [1e-12, 0.0]);
}

#[test]
fn magnification_is_the_difference_of_two_tangents() {
    let geometry = on_display("htc_vive_pro", 100, 80);
    let delta = (0.5 / geometry.pixels_per_degree).to_radians();
    for deg in [0.0, 0.1, 5.0, 20.0, 45.0, 70.0, 85.0, 89.0, 89.5, 89.9] {
        let a = f64::to_radians(deg);
        let wanted = ((a + delta).tan() - a.tan()) / delta.tan();
        assert_near("magnification", [geometry.magnification(deg)], [wanted], [1e-9, 0.0]);
    }
    let farthest = geometry.magnification(89.9);
    assert_eq!([90.0, 120.0, 200.0].map(|deg| geometry.magnification(deg)), [farthest; 3]);
}

/// Compares the coordinates of every pixel with those of its direction.
fn check_rows(geometry: &Geometry, gaze_px: [f64; 2]) {
    let View { width: w, height: h, .. } = geometry.view;
    let gaze = geometry.direction_deg(gaze_px);
    for band in &bands(geometry) {
        let (width, height) = band.size;
        let directions = BandDirections::new(geometry, band, gaze_px);
        let mut at = Coordinates { rho: vec![0.0; width], ecc: vec![0.0; width] };
        for y in 0..height {
            directions.row(y, &mut at);
            for x in 0..width {
                let share = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
                let point = [w as f64 * share(x, width), h as f64 * share(y, height)];
                let [right, up] = geometry.direction_deg(point);
                let ecc = (right - gaze[0]).hypot(up - gaze[1]).sqrt() * ECC_STEPS;
                // The tolerance is the precision of `f32` for a coordinate of up to 31.
                assert_near("ecc", [f64::from(at.ecc[x])], [ecc], [0.0, 2e-5]);
                let found = f64::from(at.rho[x]);
                let angle = right.hypot(up);
                let far = angle.min(89.9) + 0.5 / geometry.pixels_per_degree;
                if far > 89.99 {
                    // The frequency is the highest just before 90° and the lowest beyond it.
                    let wanted = if far >= 90.0 { found == 0.0 } else { found > 31.0 };
                    assert!(found.is_finite() && wanted, "{found} at {angle}°");
                    continue;
                }
                let rho = (band.cpd * geometry.magnification(angle)).log2();
                let rho = (rho - RHO_FROM) * RHO_STEPS_PER_OCTAVE;
                // The tolerance also covers the precision of a cosine of 2e-3.
                let absolute = if angle > 80.0 { 1e-3 } else { 2e-5 };
                assert_near("rho", [found], [rho], [0.0, absolute]);
            }
        }
    }
}

#[test]
fn rows_of_directions_are_the_directions_of_their_pixels() {
    check_rows(&on_display("htc_vive_pro", 90, 100), [20.0, 95.5]);
    // Up to 119° from the centre, on displays where half a pixel is 1/40° to 1°.
    let wide = ViewSpec::Fov { horizontal_deg: Some(172.0), vertical_deg: Some(168.0) };
    let view = wide.resolve(48, 41).unwrap().view;
    for (ppd, passes) in [(20.0, false), (6.0, false), (4.9, true), (0.5, true)] {
        let geometry = Geometry::new(view, Some(ppd));
        check_rows(&geometry, [30.0, 8.0]);
        assert_eq!(geometry.passes_90_deg(), passes, "{ppd}");
    }
    // A narrow field never exceeds 90°, however few pixels it has.
    assert!(
        !Geometry::new(
            seen(&ViewSpec::Fov { horizontal_deg: Some(60.0), vertical_deg: None }, 48, 41).view,
            Some(0.5)
        )
        .passes_90_deg()
    );
}

#[test]
fn gamma_and_measured_luminance_are_shown_unchanged() {
    let plain = Luminance::of_peak(400.0);
    let gamma = Photometry::new(Luminance {
        eotf: Eotf::Gamma,
        gamma: 2.4,
        contrast: Some(800.0),
        ambient_lux: 100.0,
        reflectivity: 0.01,
        ..plain
    });
    let black = 400.0 / 800.0 + 100.0 / PI * 0.01;
    let shown = |code: f64| (400.0 - black) * code.powf(2.4) + black;
    let codes = [0.0, 0.1, 0.5, 1.0];
    assert_near(
        "gamma",
        codes.map(|code| gamma.emitted_cd_m2(code)),
        codes.map(shown),
        [1e-12, 0.0],
    );
    let beyond = [-1.0, 2.0].map(|code| gamma.emitted_cd_m2(code));
    assert_near("kept in the range", beyond, [black, 400.0], [1e-12, 0.0]);
    let measured = Photometry::new(Luminance { eotf: Eotf::Absolute, ..plain });
    let light = [-3.0, 0.001, 0.5, 399.0, 5000.0].map(|light| measured.emitted_cd_m2(light));
    assert_near("measured", light, [0.005, 0.005, 0.5, 399.0, 400.0], [1e-12, 0.0]);
    let floor = Luminance { eotf: Eotf::Absolute, min_cd_m2: Some(0.25), ..plain };
    assert_near("floor", [Photometry::new(floor).emitted_cd_m2(0.1)], [0.25], [1e-12, 0.0]);
}

#[test]
fn pq_is_luminance_within_the_display() {
    let dim = Luminance { eotf: Eotf::Pq, contrast: Some(1e4), ..Luminance::of_peak(1000.0) };
    let photometry = Photometry::new(dim);
    let light = |code: f64| {
        let x = code.powf(1.0 / 78.84375);
        let share = (x - 0.835_937_5).max(0.0) / (18.851_562_5 - 18.6875 * x);
        (10_000.0 * share.powf(1.0 / 0.159_301_757_812_5)).clamp(0.005, 1000.0) + 0.1
    };
    let codes = [0.0, 0.01, 0.1, 0.25, 0.5, 0.74, 0.76, 1.0];
    let found = codes.map(|code| photometry.emitted_cd_m2(code));
    assert_near("PQ", found, codes.map(light), [1e-9, 0.0]);
}

#[test]
fn color_channels_are_shown_before_they_are_weighted() {
    use fovqa_frame::{Channels, Frame, Samples};
    let photometry = Photometry::new(Luminance::of_peak(100.0));
    let signal = SignalParams { transfer: Some(Transfer::Srgb), ..SignalParams::default() };
    for name in ["srgb", "adobe_rgb"] {
        let color_space = ColorSpace::find(name).unwrap();
        let tables = photometry.tables(signal, &Params { color_space, ..Params::default() });
        let codes = vec![255, 0, 128, 7, 200, 31];
        let frame = Frame::new(2, 1, Channels::Rgb, Samples::U8(codes.clone().into())).unwrap();
        let of_pixel = |rgb: &[u8]| {
            let shown = rgb.iter().map(|code| photometry.emitted_cd_m2(f64::from(*code) / 255.0));
            shown.zip(color_space.luminance_weights()).map(|(light, weight)| light * weight).sum()
        };
        let wanted: Vec<f64> = codes.chunks(3).map(of_pixel).collect();
        assert_near(name, values(&Grid::luminance(&frame, &tables)), wanted, [1e-6, 0.0]);
    }
}

#[test]
fn contrast_is_limited_from_above_alone() {
    let (mut limit, mut log2) = ([0.0; 4], [0.0; 4]);
    background(&[-1.0, 0.05, 0.1, 64.0], &mut limit, &mut log2);
    assert_eq!(limit, [100.0, 100.0, 100.0, 64_000.0]);
    assert_near(
        "log2",
        log2.map(f64::from),
        [0.1f64.log2(); 3].into_iter().chain([6.0]),
        [1e-6, 0.0],
    );
    let mut low_pass = [-1.0, 0.0, 300.0, 64.0];
    differences(&[500.0, 99.0, 0.0, 1e6], &limit, &mut low_pass);
    assert_eq!(low_pass, [100.0, 99.0, -300.0, 64_000.0]);
}

#[test]
fn masking_follows_its_formula() {
    let masked = |channel: usize, t: f32, r: f32| {
        let mut out = [0.0; 2];
        // The arguments are in cd/m², with a gain of 4 to multiples of the threshold.
        log2_masked(channel, (&[t / 4.0; 2], &[r / 4.0; 2]), &[2.0; 2], &mut out);
        let mut power = [0.0; 2];
        powers(&out, 1.0, &mut power);
        assert_eq!(power[0], power[1]);
        f64::from(power[0])
    };
    for (channel, q) in [(0, 2.43685), (1, 4.946)] {
        for (t, r) in [(1.0, 0.0), (3.0, 2.0), (-3.0, 2.0), (20.0, 18.0), (0.5, 30.0), (-9.0, -1.0)]
        {
            let masker = 10f64.powf(-0.973_838) * f64::abs(t).min(f64::abs(r));
            let wanted = f64::abs(t - r).powf(2.4) / (1.0 + masker.powf(q));
            assert_near("masked", [masked(channel, t as f32, r as f32)], [wanted], [2e-5, 0.0]);
        }
        assert_eq!(masked(channel, 7.0, 7.0), 0.0);
        assert_eq!(masked(channel, 0.0, 0.0), 0.0);
        // 1,000^2.4 is 1.6e7.
        assert_near("limited", [masked(channel, 1000.0, 0.0)], [1e4], [1e-5, 0.0]);
        // A masker's power of 2^130 masks as well, although it is not an `f32`.
        let strong = [1.8e17, 1e9][channel];
        assert!(masked(channel, strong, strong + strong / 1e6) < 1.0);
    }
}

#[test]
fn pooling_by_hand() {
    let sum = 3f64.powf(1.52134);
    assert_near("pixels", [over_pixels(sum, 2)], [(sum / 2.0).powf(1.0 / 1.52134)], [1e-12, 0.0]);
    // For a constant D, Q is this value for any number of pixels.
    assert_near("flat", [over_pixels(70.0 * 5f64.powf(1.52134), 70)], [5.0], [1e-12, 0.0]);
    assert_eq!(over_bands(0, [1.0, 2.0, 4.0].into_iter()), 7.0);
    assert_eq!(over_bands(1, [1.0, 2.0, 4.0].into_iter()), 1.75);
    let channels = (8f64.powf(0.666_092) + 2f64.powf(0.666_092)).powf(1.0 / 0.666_092);
    assert_near("channels", [over_channels(&[8.0, 2.0])], [channels], [1e-12, 0.0]);
    let exponent = 10f64.powf(-0.2280);
    let wanted = [1.0, 100.0, 1e5].map(|q: f64| 10.0 - 0.016_171_3 * q.powf(exponent));
    assert_near("JOD", [1.0, 100.0, 1e5].map(jod), wanted, [1e-12, 0.0]);
}

#[test]
fn flat_pictures_stay_flat_where_parities_agree() {
    for (width, height) in [(8, 6), (9, 7), (4, 4), (5, 5), (64, 130)] {
        let flat = grid(width, height, |_, _| 7.5);
        let coarse = reduced(&flat, RightEdge::ByRows);
        assert_eq!((coarse.width(), coarse.height()), (width.div_ceil(2), height.div_ceil(2)));
        assert_near("reduced", values(&coarse), values(&coarse).map(|_| 7.5), [1e-6, 0.0]);
        let back = expand(&coarse, (width, height));
        assert_near("expanded", values(&back), values(&flat), [1e-6, 0.0]);
    }
    // Where the parities differ, the weights of the last column sum to 1.25 or 0.75; with the
    // correct rule they sum to 1.
    for (width, height, weight) in [(8, 7, 1.25), (9, 6, 0.75)] {
        let flat = grid(width, height, |_, _| 1.0);
        for (edge, weight) in [(RightEdge::ByRows, weight), (RightEdge::ByColumns, 1.0)] {
            let coarse = reduced(&flat, edge);
            for y in 0..coarse.height() {
                let (last, before) = coarse.row(y).split_last().unwrap();
                assert_near("last", [f64::from(*last)], [weight], [1e-6, 0.0]);
                assert_near(
                    "before",
                    before.iter().copied().map(f64::from),
                    before.iter().map(|_| 1.0),
                    [1e-6, 0.0],
                );
            }
        }
    }
}
