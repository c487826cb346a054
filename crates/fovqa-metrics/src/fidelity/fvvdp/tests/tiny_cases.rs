//! Compares every intermediate value of three tiny pictures with the reference program, level by
//! level: a still, a foveated still, and a frame of a sequence.

use std::collections::BTreeMap;

use super::*;
use crate::fidelity::fvvdp::band::Band;
use crate::fidelity::fvvdp::bands::bands;
use crate::fidelity::fvvdp::contrast::differences;
use crate::fidelity::fvvdp::csf::{Coordinates, ECC_STEPS, RHO_FROM, RHO_STEPS_PER_OCTAVE};
use crate::fidelity::fvvdp::geometry::BandDirections;
use crate::fidelity::fvvdp::level::{DifferenceRows, Levels, Reference, ReferenceRows, Viewing};
use crate::fidelity::fvvdp::pyramid::Expander;

/// The results of the rows of one level, for one channel.
#[derive(Default)]
struct Measured {
    background: Vec<f64>,
    contrasts: [Vec<f64>; 2],
    sensitivity: Vec<f64>,
    rho_cpd: Vec<f64>,
    ecc_deg: Vec<f64>,
    differences: Vec<f64>,
}

fn refs(planes: &[Arc<Grid>]) -> Vec<&Grid> {
    planes.iter().map(Arc::as_ref).collect()
}

fn measured(
    viewing: Viewing<'_>,
    channel: usize,
    [reference, test]: [&[Arc<Grid>]; 2],
    [below_reference, below_test]: [&[Grid]; 2],
) -> Measured {
    let Band { size: (width, height), log2_gain, cpd, .. } = *viewing.band;
    let levels = Levels::new(&refs(reference), below_reference);
    let computed = Reference::Computed(Box::new(ReferenceRows::new(viewing, levels)));
    let test_levels = Levels::new(&refs(test), below_test);
    let mut masked = DifferenceRows::new(viewing.band, computed, test_levels);
    let mut rows = ReferenceRows::new(viewing, levels);
    let mut expander = Expander::new(viewing.band.size);
    let stride = test[0].stride();
    let mut row_of_test = vec![0.0; stride];
    let mut at = Coordinates { rho: vec![0.0; stride], ecc: vec![0.0; stride] };
    let mut found = Measured::default();
    let gain_of_band = libm::exp2(f64::from(log2_gain));
    for y in 0..height {
        let row = rows.row(y);
        expander.row(&below_test[channel], y, &mut row_of_test);
        differences(test[channel].padded_row(y), row.limit, &mut row_of_test);
        if let Some(directions) = viewing.directions {
            directions.row(y, &mut at);
        }
        for (x, of_test) in row_of_test.iter().enumerate().take(width) {
            let background = f64::from(row.limit[x]) / 1000.0;
            found.background.push(background);
            let contrast = |cd_m2: f32| f64::from(cd_m2) / background * gain_of_band;
            found.contrasts[0].push(contrast(row.differences[channel][x]));
            found.contrasts[1].push(contrast(*of_test));
            let to_thresholds = libm::exp2(f64::from(row.gains[channel][x]));
            found.sensitivity.push(to_thresholds * background / gain_of_band);
            let octave = f64::from(at.rho[x]) / RHO_STEPS_PER_OCTAVE + RHO_FROM;
            let looked_at = viewing.directions.is_none();
            found.rho_cpd.push(if looked_at { cpd } else { libm::exp2(octave) });
            found.ecc_deg.push((f64::from(at.ecc[x]) / ECC_STEPS).powi(2));
        }
        let log2_masked = &masked.row(y)[channel][..width];
        found.differences.extend(log2_masked.iter().map(|log| libm::exp2(f64::from(*log))));
    }
    found
}

/// Compares all levels with the arrays whose names begin with `prefix`.
fn check(
    prefix: &str,
    geometry: &Geometry,
    gaze_px: Option<[f64; 2]>,
    planes: [Vec<Arc<Grid>>; 2],
) {
    let golden = golden();
    let mut fine = planes;
    let bands = bands(geometry);
    assert_eq!(bands.len(), 3);
    for (index, band) in bands.iter().enumerate() {
        let directions = gaze_px.map(|gaze| BandDirections::new(geometry, band, gaze));
        let viewing = Viewing { band, directions: directions.as_ref() };
        let coarse = fine.each_ref().map(|planes| reduce(&refs(planes), RightEdge::ByRows));
        for channel in 0..fine[0].len() {
            let found = measured(viewing, channel, [&fine[0], &fine[1]], [&coarse[0], &coarse[1]]);
            let near = |quantity: &str, found: Vec<f64>, tolerance: [f64; 2]| {
                let name = format!("{prefix}_b{index}_c{channel}_{quantity}");
                let wanted = golden.array(&format!("media/stages/{name}.npy"));
                assert_eq!(wanted.shape, [band.size.1, band.size.0], "{name}");
                assert_near(&name, found, wanted.floats().into_iter().map(f64::from), tolerance);
            };
            let Measured { background, contrasts: [of_reference, of_test], .. } = found;
            near("L_bkg", background, [2e-6, 0.0]);
            // Where a level and its low-pass are nearly equal, the difference has the rounding
            // errors of both.
            near("contrast_ref", of_reference, [1e-5, 2e-6]);
            near("contrast_test", of_test, [1e-5, 2e-6]);
            // The reference program computes the magnification in `f32`: see
            // `directions_and_magnifications_agree`.
            near("rho_cpd", found.rho_cpd, [2e-4, 0.0]);
            near("ecc_deg", found.ecc_deg, [1e-5, 1e-5]);
            // Where the sensitivity is as steep as at 60 cpd, an error of 2e-4 in frequency becomes
            // ten times larger in sensitivity. At equal coordinates the two implementations agree.
            let relative = if gaze_px.is_some() { 4e-3 } else { 1e-5 };
            near("S_corrected", found.sensitivity, [relative, 0.0]);
            let given = |quantity: &str| {
                let name = format!("media/stages/{prefix}_b{index}_c{channel}_{quantity}.npy");
                golden.array(&name).floats().into_iter().map(f64::from)
            };
            let own = given("rho_cpd").zip(given("L_bkg")).zip(given("ecc_deg"));
            let own = own.map(|((rho, light), ecc)| sensitivity(channel, rho, light, ecc));
            near("S_corrected", own.collect(), [1e-4, 0.0]);
            // An error of 2e-6 in contrast is 1e-3 thresholds, and D is a power of 2.4 of a
            // difference of two contrasts.
            near("D", found.differences, [2e-3, 1e-5]);
        }
        fine = coarse.map(|planes| planes.into_iter().map(Arc::new).collect());
    }
}

fn near_plane(name: &str, found: &Grid) {
    let wanted = golden().array(&format!("media/stages/{name}.npy"));
    assert_eq!(wanted.shape, [found.height(), found.width()]);
    // The transient channel is a difference of frames, so it has the rounding errors of their
    // luminance.
    assert_near(name, values(found), wanted.floats().into_iter().map(f64::from), [2e-6, 1e-5]);
}

#[test]
fn a_still_level_by_level() {
    let planes = luminance(&golden(), "tiny_img");
    near_plane("img_ref", &planes[0][0]);
    near_plane("img_test", &planes[1][0]);
    check("img", &on_display("standard_fhd", 32, 24), None, planes);
}

#[test]
fn a_foveated_still_level_by_level() {
    let planes = luminance(&golden(), "tiny_img_fov");
    near_plane("fov_ref", &planes[0][0]);
    near_plane("fov_test", &planes[1][0]);
    check("fov", &on_display("htc_vive_pro", 32, 24), Some([5.5, 4.5]), planes);
}

#[test]
fn a_frame_of_a_sequence_level_by_level() {
    let time = Time::new(4, Some(30.0), Padding::Replicate).unwrap();
    assert!(time.before_first().is_empty());
    let planes = luminance(&golden(), "tiny_vid").map(|frames| {
        let mut stream = Stream::begin(&time, &frames[0], &BTreeMap::new());
        for (index, frame) in frames.iter().enumerate().skip(1) {
            stream.push(index, Arc::clone(frame));
        }
        stream.channels(&time)
    });
    for (planes, stream) in planes.iter().zip(["ref", "test"]) {
        near_plane(&format!("vid_{stream}_sustained"), &planes[0]);
        near_plane(&format!("vid_{stream}_transient"), &planes[1]);
    }
    check("vid", &on_display("standard_fhd", 32, 24), None, planes);
}
