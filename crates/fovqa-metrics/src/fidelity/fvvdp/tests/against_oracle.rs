//! Compares whole frames with the literal metric, on pictures of noise, for cases that golden
//! values of photographs do not cover.

use fovqa_vision::View;

use super::oracle::{Oracle, OracleScore, Plane};
use super::*;

/// A frame on its display, as both implementations describe it.
struct DisplayedFrame {
    fvvdp: Fvvdp,
    oracle: Oracle,
    size: (usize, usize),
    gaze_px: [f64; 2],
}

impl DisplayedFrame {
    /// Frames of a size that fill a display with this field and this number of pixels per degree.
    fn new(size: (usize, usize), tangents: [f64; 4], ppd: f64) -> Self {
        let oracle = Oracle { tangents, ppd, gaze_px: None, exact_edges: false };
        let params = Params { foveated: false, ..Params::default() };
        let fvvdp = Fvvdp::new(geometry(size, &oracle), &params);
        Self { fvvdp, oracle, size, gaze_px: [0.0; 2] }
    }

    fn looking_at(self, gaze_px: [f64; 2]) -> Self {
        let oracle = Oracle { gaze_px: Some(gaze_px), ..self.oracle };
        let exact_edges = oracle.exact_edges;
        let params = Params { exact_edges, ..Params::default() };
        let fvvdp = Fvvdp::new(geometry(self.size, &oracle), &params);
        Self { fvvdp, oracle, gaze_px, ..self }
    }

    fn with_exact_edges(self) -> Self {
        let oracle = Oracle { exact_edges: true, ..self.oracle };
        let params =
            Params { exact_edges: true, foveated: oracle.gaze_px.is_some(), ..Params::default() };
        let fvvdp = Fvvdp::new(geometry(self.size, &oracle), &params);
        Self { fvvdp, oracle, ..self }
    }

    /// Compares Q of all bands and of the frame, and the heat map.
    fn check(&self, what: &str, reference: &[&Grid], test: &[&Grid]) -> OracleScore {
        let shared = |grids: &[&Grid]| {
            grids.iter().map(|grid| Arc::new(Grid::clone(grid))).collect::<Vec<_>>()
        };
        let mut map = DifferenceMap::default();
        let pair = [&shared(reference)[..], &shared(test)[..]];
        let found = score(&self.fvvdp, pair, self.gaze_px, Some(&mut map));
        let planes =
            |grids: &[&Grid]| grids.iter().map(|grid| Plane::of_grid(grid)).collect::<Vec<_>>();
        let wanted = self.oracle.score(&planes(reference), &planes(test));
        let bands = wanted.q_of_bands.iter();
        for channel in 0..reference.len() {
            let of_band = |band: &FvvdpBand| match channel {
                0 => band.sustained,
                _ => band.transient.unwrap(),
            };
            let wanted = bands.clone().map(|channels| channels[channel]);
            // The luminance of the test, 100 cd/m² in `f32`, has an error of 1e-5, and so does a
            // small Q.
            assert_near(what, found.bands.iter().map(of_band), wanted, [1e-4, 3e-5]);
        }
        assert_near(what, [found.q, found.frame_jod], [wanted.q, jod(wanted.q)], [1e-4, 1e-4]);
        let map = map.raw();
        assert_eq!((map.width(), map.height()), self.size, "{what}");
        assert_near(what, values(&map), wanted.map.values.iter().copied(), [1e-3, 1e-5]);
        wanted
    }
}

fn geometry((width, height): (usize, usize), oracle: &Oracle) -> Geometry {
    let [left, right, up, down] = oracle.tangents;
    let (w, h) = (width as f64, height as f64);
    let view = View {
        width,
        height,
        focal_px: [w / (left + right), h / (up + down)],
        principal_px: [w * left / (left + right), h * up / (up + down)],
    };
    Geometry::new(view, Some(oracle.ppd))
}

/// Sizes: tiny ones, all combinations of even and odd, wider than a vector, taller than a block of
/// rows.
const SIZES: [(usize, usize); 10] =
    [(4, 4), (5, 4), (4, 5), (7, 9), (32, 24), (31, 24), (32, 23), (31, 23), (67, 33), (45, 150)];

/// 60° by 45°.
const WIDE: [f64; 4] = [0.577, 0.577, 0.414, 0.414];

fn noise((width, height): (usize, usize), seed: u64, range: [f64; 2]) -> Grid {
    random(width, height, seed, range)
}

#[test]
fn stills_of_every_size_and_parity() {
    for (index, size) in SIZES.into_iter().enumerate() {
        let seed = 10 * index as u64;
        let reference = noise(size, seed + 1, [1.0, 200.0]);
        // A good test and a bad one: sometimes below the threshold, and far above it.
        for (test, near) in
            [noise(size, seed + 2, [1.0, 200.0]), reference.clone()].into_iter().zip([false, true])
        {
            let bit = noise(size, seed + 3, [0.0, 2.0]);
            let test = if near {
                grid(size.0, size.1, |x, y| test.row(y)[x] + bit.row(y)[x])
            } else {
                test
            };
            let (reference, test) = ([&reference], [&test]);
            let seen = || DisplayedFrame::new(size, WIDE, 30.0);
            let gaze = [size.0 as f64 * 0.3, size.1 as f64 * 0.8];
            let what = format!("{size:?}, near: {near}");
            seen().check(&what, &reference, &test);
            seen().looking_at(gaze).check(&format!("{what}, foveated"), &reference, &test);
            seen().with_exact_edges().check(&format!("{what}, exact"), &reference, &test);
            let both = seen().with_exact_edges().looking_at(gaze);
            both.check(&format!("{what}, foveated, exact"), &reference, &test);
        }
    }
}

#[test]
fn two_channels_share_the_background_of_the_sustained_reference() {
    for size in [(32, 24), (31, 23), (70, 66)] {
        let pair =
            |seed: u64| [noise(size, seed, [1.0, 80.0]), noise(size, seed + 1, [-20.0, 20.0])];
        let (reference, test) = (pair(100), pair(200));
        let (reference, test) = (reference.each_ref(), test.each_ref());
        DisplayedFrame::new(size, WIDE, 20.0).check("two channels", &reference, &test);
        let foveated = DisplayedFrame::new(size, WIDE, 20.0).looking_at([3.0, 20.0]);
        foveated.check("two channels, foveated", &reference, &test);
        // The transient channel alone has an error.
        let one = [reference[0], test[1]];
        let found =
            DisplayedFrame::new(size, WIDE, 20.0).check("transient alone", &reference, &one);
        assert!(found.q_of_bands.iter().all(|channels| channels[0] == 0.0));
    }
}

#[test]
fn gaze_may_lie_anywhere_and_off_the_frame() {
    let size = (33, 26);
    let (reference, test) = (noise(size, 1, [1.0, 100.0]), noise(size, 2, [1.0, 100.0]));
    for gaze in [[0.0, 0.0], [16.5, 13.0], [7.25, 20.75], [-40.0, 13.0], [20.0, 500.0]] {
        let seen = DisplayedFrame::new(size, WIDE, 12.0).looking_at(gaze);
        seen.check(&format!("{gaze:?}"), &[&reference], &[&test]);
    }
}

#[test]
fn the_centre_of_the_display_may_lie_off_the_middle() {
    let size = (40, 30);
    let (reference, test) = (noise(size, 5, [1.0, 100.0]), noise(size, 6, [1.0, 100.0]));
    let seen = DisplayedFrame::new(size, [1.2, 0.6, 0.5, 0.9], 12.0).looking_at([30.0, 8.0]);
    seen.check("frustum", &[&reference], &[&test]);
}

#[test]
fn directions_beyond_89_9_degrees_are_clamped() {
    // 172° by 168°: the corners are 119° from the centre, measured as the distance of two pairs of
    // angles.
    let size = (48, 40);
    let tangents = [86f64, 86.0, 84.0, 84.0].map(|deg| deg.to_radians().tan());
    let (reference, test) = (noise(size, 7, [1.0, 100.0]), noise(size, 8, [1.0, 100.0]));
    for ppd in [6.0, 20.0] {
        for gaze in [[24.0, 20.0], [47.5, 39.5]] {
            let seen = DisplayedFrame::new(size, tangents, ppd).looking_at(gaze);
            let [corner_x, corner_y] = seen.oracle.direction_deg([0.99, 0.99]);
            assert!(corner_x.hypot(corner_y) > 89.9);
            seen.check("wide", &[&reference], &[&test]);
        }
    }
}

#[test]
fn beyond_90_degrees_the_lowest_frequency_counts() {
    // Another half pixel exceeds 90° in a part of the frame.
    let size = (48, 40);
    let tangents = [86f64, 86.0, 84.0, 84.0].map(|deg| deg.to_radians().tan());
    let (reference, test) = (noise(size, 7, [1.0, 100.0]), noise(size, 8, [1.0, 100.0]));
    for ppd in [1.5, 3.0, 4.5] {
        let seen = DisplayedFrame::new(size, tangents, ppd).looking_at([24.0, 20.0]);
        assert!(seen.fvvdp.geometry().passes_90_deg());
        seen.check("beyond 90°", &[&reference], &[&test]);
    }
}

#[test]
fn displays_of_very_few_pixels_a_degree_have_one_band() {
    // The first band at or below 0.5 cpd is the last, even if it is the first of all.
    let size = (32, 24);
    let (reference, test) = (noise(size, 9, [1.0, 100.0]), noise(size, 10, [1.0, 100.0]));
    for (ppd, bands) in [(0.8, 1), (1.0, 1), (1.01, 2), (3.0, 2), (3.2, 3)] {
        let seen = DisplayedFrame::new(size, WIDE, ppd);
        let found = seen.check(&format!("{ppd}"), &[&reference], &[&test]);
        assert_eq!(found.q_of_bands.len(), bands, "{ppd} pixels a degree");
    }
}

#[test]
fn backgrounds_are_at_least_a_tenth() {
    // Levels with a low-pass of less than 0.1 cd/m², including completely black ones.
    let size = (48, 33);
    for [from, to] in [[0.0, 0.05], [0.0, 0.3], [-0.2, 0.2]] {
        let (reference, test) = (noise(size, 21, [from, to]), noise(size, 22, [from, to]));
        let foveated = DisplayedFrame::new(size, WIDE, 8.0).looking_at([40.0, 3.0]);
        foveated.check("dark", &[&reference], &[&test]);
        let black = grid(size.0, size.1, |_, _| 0.0);
        DisplayedFrame::new(size, WIDE, 8.0).check("black reference", &[&black], &[&test]);
        DisplayedFrame::new(size, WIDE, 8.0).check("black test", &[&reference], &[&black]);
    }
}

#[test]
fn contrast_ends_at_a_thousand_and_has_no_lower_end() {
    // Bright dots on black. They are so fine on this display that the sensitivity to them, 1e-4
    // before its correction, keeps differences below the limit of 10,000.
    let size = (40, 36);
    let dots = |x: usize, y: usize| x % 11 == 5 && y % 9 == 4;
    let black = grid(size.0, size.1, |_, _| 0.0);
    let bright = grid(size.0, size.1, |x, y| if dots(x, y) { 9000.0 } else { 0.0 });
    let seen = || DisplayedFrame::new(size, [0.01; 4], 400.0);
    let found = seen().check("bright dots", &[&black], &[&bright]);
    let finest = &found.differences[0][0];
    let limited = (1000.0 * 1e-4 * 10f64.powf(16.2596 / 20.0)).powf(2.4);
    let at = |x: usize, y: usize| finest.values[y * size.0 + x];
    assert!((at(16, 13) / limited - 1.0).abs() < 1e-3, "{} for {limited}", at(16, 13));
    // Beside a dot the test is darker than its low-pass by thousands of backgrounds.
    assert!(at(17, 13) > 2.0 * limited);
    // Both are limited, so there is no difference at the dots, though one is twice as bright.
    let brighter = grid(size.0, size.1, |x, y| 2.0 * bright.row(y)[x]);
    seen().check("dots of both", &[&bright], &[&brighter]);
    seen().check("no dots", &[&bright], &[&black]);
}
