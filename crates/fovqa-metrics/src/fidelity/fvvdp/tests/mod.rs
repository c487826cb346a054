//! Tests FovVideoVDP step by step: with golden values of the reference program, with its formulas
//! written out literally in `f64` for cases without golden values, and with rules that hold for any
//! pictures.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

mod against_oracle;
mod by_hand;
mod csf_formula;
mod heat_maps;
mod oracle;
mod over_time;
mod rules;
mod shares;
mod stages;
mod tiny_cases;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use fovqa_testkit::fvvdp_golden::Golden;
use fovqa_testkit::synthetic::Xorshift;
use fovqa_vision::{Eotf, ViewSpec, find_display};

use super::grid::Grid;
use super::pyramid::{RightEdge, reduce};
use super::*;
use fovqa_frame::{SignalParams, Transfer};

/// The golden values in the repository.
fn golden() -> Golden {
    Golden::read(&root().join("tests/golden/fvvdp"))
}

/// All golden values, if they are available.
fn whole_golden() -> Option<Golden> {
    let folder = root().join("../shared/golden/fvvdp");
    folder.is_dir().then(|| Golden::read(&folder))
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn reduced(fine: &Grid, edge: RightEdge) -> Grid {
    reduce(&[fine], edge).remove(0)
}

fn grid(width: usize, height: usize, value: impl Fn(usize, usize) -> f32 + Sync) -> Grid {
    let mut grid = Grid::new(width, height);
    grid.fill_blocks(|first, rows| {
        for (index, row) in rows.enumerate() {
            for (x, out) in row[..width].iter_mut().enumerate() {
                *out = value(x, first + index);
            }
        }
    });
    grid
}

/// Random values between two limits, with a separate sequence for each seed.
fn random(width: usize, height: usize, seed: u64, [from, to]: [f64; 2]) -> Grid {
    let mut random = Xorshift::new(seed);
    let mut draw = || (from + (to - from) * random.next_unit()) as f32;
    let values: Vec<f32> = (0..width * height).map(|_| draw()).collect();
    grid(width, height, |x, y| values[y * width + x])
}

fn values(grid: &Grid) -> impl Iterator<Item = f64> + '_ {
    (0..grid.height()).flat_map(|y| grid.row(y)).map(|value| f64::from(*value))
}

/// Checks that every value is near the wanted one, within a relative and an absolute tolerance.
fn assert_near(
    what: &str,
    found: impl IntoIterator<Item = f64>,
    wanted: impl IntoIterator<Item = f64>,
    [relative, absolute]: [f64; 2],
) {
    let (mut found, mut wanted) = (found.into_iter(), wanted.into_iter());
    for index in 0.. {
        let (found, wanted) = match (found.next(), wanted.next()) {
            (Some(found), Some(wanted)) => (found, wanted),
            (None, None) => break,
            _ => panic!("{what}: {index} values of one and more of the other"),
        };
        let allowed = relative * wanted.abs() + absolute;
        let error = (found - wanted).abs();
        assert!(error <= allowed, "{what}, value {index}: {found} for {wanted}, {error:e} off");
    }
}

/// The geometry of frames of a size that are stretched over a display.
fn on_display(name: &str, width: usize, height: usize) -> Geometry {
    let display = find_display(name).unwrap();
    let view = ViewSpec::Display(display.clone()).resolve(width, height).unwrap().view;
    Geometry::new(view, Some(display.central_pixels_per_degree()))
}

/// The luminance of the frames of a golden case on its display, for the reference and for the test.
fn luminance(golden: &Golden, id: &str) -> [Vec<Arc<Grid>>; 2] {
    let case = golden.cases.iter().find(|case| case.id == id).unwrap();
    let photometry = Photometry::new(find_display(&case.display).unwrap().luminance.unwrap());
    assert_eq!(photometry.eotf(), Eotf::Srgb);
    let signal = SignalParams { transfer: Some(Transfer::Srgb), ..SignalParams::default() };
    let tables = photometry.tables(signal, &Params::default());
    let shown = |frame: &fovqa_frame::Frame| Arc::new(Grid::luminance(frame, &tables));
    golden.frames(case).map(|frames| frames.iter().map(shown).collect())
}

/// Regions without eccentricity bands.
fn no_regions(fvvdp: &Fvvdp) -> FvvdpRegions {
    use fovqa_vision::{BandEdges, Eccentricity, EccentricityKind};
    let view = fvvdp.geometry().view;
    let eccentricity = Eccentricity::new(view, view.principal_px, EccentricityKind::Angular);
    fvvdp.regions(&eccentricity, &BandEdges::new(vec![0.0, 180.0]).unwrap())
}

/// The score of a frame for a gaze.
fn score(
    fvvdp: &Fvvdp,
    [reference, test]: [&[Arc<Grid>]; 2],
    gaze_px: [f64; 2],
    map: Option<&mut DifferenceMap>,
) -> FvvdpFrame {
    let prepared = fvvdp.reference(reference.to_vec(), gaze_px, false);
    fvvdp.score(&prepared, test, &no_regions(fvvdp), map)
}
