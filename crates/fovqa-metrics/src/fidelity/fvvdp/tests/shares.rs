//! The shares of eccentricity bands in Q.

use fovqa_vision::{BandEdges, Eccentricity, EccentricityKind, View};

use super::oracle::{Oracle, Plane, power_where};
use super::*;

const W: usize = 96;
const H: usize = 80;
const EDGES: [f64; 4] = [2.0, 10.0, 20.0, 26.0];

struct Setup {
    size: (usize, usize),
    fvvdp: Fvvdp,
    eccentricity: Eccentricity,
    regions: FvvdpRegions,
}

/// 60° by 51°, with a gaze to the left, so that some pixels are within the innermost edge and some
/// beyond the outermost.
fn setup() -> Setup {
    setup_of((W, H), EccentricityKind::Angular)
}

fn setup_of(size: (usize, usize), kind: EccentricityKind) -> Setup {
    let spec = ViewSpec::Fov { horizontal_deg: Some(60.0), vertical_deg: None };
    let view = spec.resolve(size.0, size.1).unwrap().view;
    let fvvdp = Fvvdp::new(Geometry::new(view, Some(8.0)), &Params::default());
    let eccentricity = Eccentricity::new(view, [20.0, 40.0], kind);
    let regions = fvvdp.regions(&eccentricity, &BandEdges::new(EDGES.to_vec()).unwrap());
    Setup { size, fvvdp, eccentricity, regions }
}

impl Setup {
    fn score(&self, reference: &[&Grid], test: &[&Grid]) -> FvvdpFrame {
        let shared = |grids: &[&Grid]| {
            grids.iter().map(|grid| Arc::new(Grid::clone(grid))).collect::<Vec<_>>()
        };
        let prepared = self.fvvdp.reference(shared(reference), self.eccentricity.gaze_px(), false);
        self.fvvdp.score(&prepared, &shared(test), &self.regions, None)
    }

    /// The band of a pixel of a level; pixels outside all bands have the last index.
    fn band(&self, (x, y): (usize, usize), level: &Plane) -> usize {
        let (w, h) = self.size;
        let at = [
            (x as f64 + 0.5) * w as f64 / level.width as f64,
            (y as f64 + 0.5) * h as f64 / level.height as f64,
        ];
        let deg = self.eccentricity.at_deg(at[0], at[1]);
        EDGES.windows(2).position(|edges| (edges[0]..edges[1]).contains(&deg)).unwrap_or(3)
    }
}

#[test]
fn shares_are_those_of_the_pooled_powers_and_sum_to_one() {
    // The levels of 33x123 pixels are not halves of one another in both directions.
    for size in [(W, H), (33, 123)] {
        for kind in [EccentricityKind::Angular, EccentricityKind::Planar] {
            check_shares(&setup_of(size, kind));
        }
    }
}

fn check_shares(setup: &Setup) {
    let (w, h) = setup.size;
    let View { focal_px: [fx, fy], principal_px: [cx, cy], .. } = *setup.eccentricity.view();
    let tangents = [cx / fx, (w as f64 - cx) / fx, cy / fy, (h as f64 - cy) / fy];
    let gaze_px = Some(setup.eccentricity.gaze_px());
    let oracle = Oracle { tangents, ppd: 8.0, gaze_px, exact_edges: false };
    let pair = |seed: u64| [random(w, h, seed, [1.0, 90.0]), random(w, h, seed + 1, [-9.0, 9.0])];
    let (reference, test) = (pair(1), pair(11));
    let (reference, test) = (reference.each_ref(), test.each_ref());
    for channels in [1, 2] {
        let (reference, test) = (&reference[..channels], &test[..channels]);
        let found = setup.score(reference, test);
        let planes =
            |grids: &[&Grid]| grids.iter().map(|grid| Plane::of_grid(grid)).collect::<Vec<_>>();
        let wanted = oracle.score(&planes(reference), &planes(test));
        // The share is the product of a channel's part in the norm over channels, a level's part in
        // the sum over bands, and a region's part in the sum over pixels.
        let of_channel = |c: usize| {
            let sum: f64 = wanted.q_of_bands.iter().map(|q| q[c]).sum();
            ([1.0, 0.25][c] * sum).powf(0.666_092)
        };
        let all: f64 = (0..channels).map(of_channel).sum();
        let mut shares = [0.0; 4];
        for c in 0..channels {
            let sum: f64 = wanted.q_of_bands.iter().map(|q| q[c]).sum();
            for (q, planes) in wanted.q_of_bands.iter().zip(&wanted.differences) {
                let whole = power_where(&planes[c], |_, _| true);
                for (band, share) in shares.iter_mut().enumerate() {
                    let here = |x, y| setup.band((x, y), &planes[c]) == band;
                    let part = power_where(&planes[c], here) / whole;
                    *share += of_channel(c) / all * q[c] / sum * part;
                }
            }
        }
        let found_shares = found.shares.as_ref().unwrap();
        assert!((found_shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert_near("shares", found_shares.iter().copied(), shares, [1e-4, 1e-7]);
        assert_eq!(
            [0, 3, 4].map(|band| found.share(band)),
            [Some(found_shares[0]), Some(found_shares[3]), None]
        );
    }
}

#[test]
fn an_error_counts_in_its_band() {
    let setup = setup();
    let reference = grid(W, H, |_, _| 30.0);
    let full = |x: usize, y: usize| Plane { width: W, height: H, values: vec![(x + y) as f64] };
    for (spot, band) in [([30, 40], 0), ([41, 40], 1), ([5, 40], 0), ([90, 70], 3)] {
        let here = |x: usize, y: usize| x.abs_diff(spot[0]) < 2 && y.abs_diff(spot[1]) < 2;
        assert_eq!(setup.band((spot[0], spot[1]), &full(0, 0)), band, "{spot:?}");
        let test = grid(W, H, |x, y| if here(x, y) { 32.0 } else { 30.0 });
        let found = setup.score(&[&reference], &[&test]);
        let share = found.share(band).unwrap();
        assert!(share > 0.9, "{spot:?}: {:?}", found.shares);
        assert!((found.shares.unwrap().iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn without_a_difference_nobody_has_a_share() {
    let setup = setup();
    let picture = random(W, H, 3, [1.0, 90.0]);
    let found = setup.score(&[&picture], &[&picture]);
    assert_eq!((found.q, found.shares.as_ref(), found.share(0)), (0.0, None, None));
    // Only one channel has an error.
    let pair = [random(W, H, 4, [-9.0, 9.0]), random(W, H, 5, [-9.0, 9.0])];
    let found = setup.score(&[&picture, &pair[0]], &[&picture, &pair[1]]);
    assert!(found.bands.iter().all(|band| band.sustained == 0.0));
    assert!((found.shares.unwrap().iter().sum::<f64>() - 1.0).abs() < 1e-12);
}
