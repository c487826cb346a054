//! Rules that hold for any pictures.

use super::*;
use fovqa_vision::{BandEdges, Eccentricity, EccentricityKind};

fn fvvdp(width: usize, height: usize, params: &Params) -> Fvvdp {
    Fvvdp::new(on_display("htc_vive_pro", width, height), params)
}

fn regions(fvvdp: &Fvvdp, gaze_px: [f64; 2]) -> FvvdpRegions {
    let eccentricity = Eccentricity::new(fvvdp.geometry().view, gaze_px, EccentricityKind::Angular);
    fvvdp.regions(&eccentricity, &BandEdges::new(vec![0.0, 10.0, 20.0, 30.0]).unwrap())
}

fn params(foveated: bool) -> Params {
    Params { foveated, ..Params::default() }
}

fn pair(width: usize, height: usize, seed: u64) -> Vec<Arc<Grid>> {
    let sustained = random(width, height, seed, [0.0, 130.0]);
    vec![Arc::new(sustained), Arc::new(random(width, height, seed + 1, [-15.0, 15.0]))]
}

#[test]
fn identical_pictures_differ_by_nothing() {
    for foveated in [false, true] {
        for (width, height) in [(4, 4), (5, 7), (90, 71)] {
            let fvvdp = fvvdp(width, height, &params(foveated));
            let both = pair(width, height, 1);
            for channels in [1, 2] {
                let planes = &both[..channels];
                let mut map = DifferenceMap::default();
                let found = score(&fvvdp, [planes, planes], [2.0, 1.0], Some(&mut map));
                assert_eq!((found.q, found.frame_jod), (0.0, 10.0));
                assert!(found.bands.iter().all(|band| band.sustained == 0.0));
                let transient = (channels == 2).then_some(0.0);
                assert!(found.bands.iter().all(|band| band.transient == transient));
                assert_eq!(found.shares, None);
                assert!(values(&map.raw()).all(|value| value == 0.0));
            }
        }
    }
}

#[test]
fn black_pictures_have_numbers() {
    let fvvdp = fvvdp(40, 30, &params(true));
    let black = [Arc::new(grid(40, 30, |_, _| 0.0))];
    let found = score(&fvvdp, [&black, &black], [20.0, 15.0], None);
    assert_eq!((found.q, found.frame_jod), (0.0, 10.0));
    let spot = [Arc::new(grid(40, 30, |x, y| if (x, y) == (20, 15) { 130.0 } else { 0.0 }))];
    for pair in [[&black[..], &spot[..]], [&spot[..], &black[..]]] {
        let found = score(&fvvdp, pair, [20.0, 15.0], None);
        assert!(found.q.is_finite() && found.q > 1.0);
    }
}

#[test]
fn a_kept_reference_gives_the_same_bits() {
    let (width, height) = (150, 140);
    for foveated in [false, true] {
        let fvvdp = fvvdp(width, height, &params(foveated));
        let gaze = [30.0, 99.0];
        let regions = regions(&fvvdp, gaze);
        for channels in [1, 2] {
            let reference = pair(width, height, 7)[..channels].to_vec();
            let [computed, kept] =
                [false, true].map(|keep| fvvdp.reference(reference.clone(), gaze, keep));
            for seed in [20, 30] {
                let test = &pair(width, height, seed)[..channels];
                let mut maps = [DifferenceMap::default(), DifferenceMap::default()];
                let [a, b] = &mut maps;
                let found = fvvdp.score(&computed, test, &regions, Some(a));
                assert_eq!(fvvdp.score(&kept, test, &regions, Some(b)), found);
                let [a, b] = maps.map(DifferenceMap::raw);
                assert_eq!(a, b);
            }
            assert_eq!(kept.sustained(), &*reference[0]);
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (width, height) = (333, 261);
    let fvvdp = fvvdp(width, height, &params(true));
    let gaze = [100.0, 77.0];
    let run = |threads: usize, keep: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let reference = fvvdp.reference(pair(width, height, 7), gaze, keep);
            let mut map = DifferenceMap::default();
            let regions = regions(&fvvdp, gaze);
            let frame = fvvdp.score(&reference, &pair(width, height, 9), &regions, Some(&mut map));
            (frame, map.raw())
        })
    };
    let one = run(1, false);
    assert_eq!(run(8, false), one);
    assert_eq!(run(8, true), one);
}

#[test]
fn exact_edges_matter_where_parities_differ() {
    let run = |width: usize, height: usize, exact_edges: bool| {
        let fvvdp = fvvdp(width, height, &Params { exact_edges, ..params(false) });
        let (reference, test) = (pair(width, height, 3), pair(width, height, 5));
        score(&fvvdp, [&reference, &test], [0.0; 2], None)
    };
    // Width and height have the same parity on every level: 36, 18, 9, 5; 20, 10, 5, 3; 68, 34, 17,
    // 9.
    for (width, height) in [(16, 16), (36, 20), (33, 17), (36, 68)] {
        assert_eq!(run(width, height, true), run(width, height, false), "{width}x{height}");
    }
    for (width, height) in [(33, 16), (16, 33), (36, 22)] {
        let (exact, as_calibrated) = (run(width, height, true), run(width, height, false));
        assert!((exact.q / as_calibrated.q - 1.0).abs() > 1e-4, "{width}x{height}");
    }
}

#[test]
fn without_foveation_the_gaze_has_no_effect() {
    let run = |foveated: bool, gaze: [f64; 2]| {
        let fvvdp = fvvdp(64, 60, &params(foveated));
        score(&fvvdp, [&pair(64, 60, 3), &pair(64, 60, 5)], gaze, None)
    };
    assert_eq!(run(false, [1.0, 2.0]), run(false, [60.0, 50.0]));
    assert!(run(true, [1.0, 2.0]).q < 0.99 * run(false, [1.0, 2.0]).q);
    assert_ne!(run(true, [1.0, 2.0]).q, run(true, [60.0, 50.0]).q);
}

#[test]
fn padding_after_the_end_of_a_row_has_no_effect() {
    let (width, height) = (37, 20);
    let fvvdp = fvvdp(width, height, &params(true));
    let planes = [pair(width, height, 3), pair(width, height, 5)];
    let poisoned = planes.each_ref().map(|planes| {
        let poison = |plane: &Arc<Grid>| {
            let mut plane = Grid::clone(plane);
            plane.fill_blocks(|_, rows| rows.for_each(|row| row[width..].fill(12_345.0)));
            Arc::new(plane)
        };
        planes.iter().map(poison).collect::<Vec<_>>()
    });
    for keep in [false, true] {
        let run = |[reference, test]: &[Vec<Arc<Grid>>; 2]| {
            let prepared = fvvdp.reference(reference.clone(), [9.0, 9.0], keep);
            fvvdp.score(&prepared, test, &no_regions(&fvvdp), None)
        };
        assert_eq!(run(&poisoned), run(&planes));
    }
}
