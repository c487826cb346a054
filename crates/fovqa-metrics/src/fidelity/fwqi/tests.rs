//! Rules of FWQI. tests/metrics/more.rs compares its values with those of independent implementations.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use fovqa_frame::{Frame, SignalParams, SignalTables};
use fovqa_testkit::synthetic::{codes, disturbed, rgb8};
use fovqa_vision::{BandMap, Eccentricity, EccentricityKind, ViewSpec};

use super::*;
use crate::regions::{BlockRegions, Regions};

const W: usize = 200;
const H: usize = 187;

fn fwqi(reference: &Frame, test: &Frame, vertical_deg: f64) -> Scored {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(vertical_deg) };
    let view = spec.resolve(W, H).unwrap().view;
    let eccentricity = Eccentricity::new(view, [30.0, 90.0], EccentricityKind::Angular);
    let bands = BandMap::without_bands(W, H);
    let input = PairInput {
        reference,
        test,
        tables: &SignalTables::new(SignalParams::default()),
        regions: &Regions::unmasked(&bands),
        blocks: &BlockRegions::default(),
        eccentricity: Some(&eccentricity),
        weight: None,
        map: false,
    };
    measure(&input).unwrap()
}

fn value(scored: &Scored) -> Option<f64> {
    scored.rows.value(Key::of(Metric::Fwqi))
}

#[test]
fn identical_pictures_have_1_and_others_the_less_the_more_they_differ() {
    let reference = codes(W, H, 3, 7);
    let frame = rgb8(W, H, reference.clone());
    assert_eq!(value(&fwqi(&frame, &frame, 40.0)), Some(1.0));
    let [little, much] = [10.0, 60.0].map(|amount| {
        let test = rgb8(W, H, disturbed(&reference, amount, 2));
        value(&fwqi(&frame, &test, 40.0)).unwrap()
    });
    assert!(much < little && little < 1.0, "{much} {little}");
}

#[test]
fn black_references_have_no_value() {
    let black = rgb8(W, H, vec![0; 3 * W * H]);
    let scored = fwqi(&black, &rgb8(W, H, codes(W, H, 3, 7)), 40.0);
    assert_eq!((value(&scored), &scored.warnings[..]), (None, &[NOTHING][..]));
    // Gray has means, but no details.
    let gray = rgb8(W, H, vec![100; 3 * W * H]);
    assert_eq!(value(&fwqi(&gray, &gray, 40.0)), Some(1.0));
}

/// The last columns and rows do not fill a block of 16 pixels.
#[test]
fn the_border_beyond_whole_blocks_does_not_count() {
    let reference = codes(W, H, 3, 7);
    let frame = rgb8(W, H, reference.clone());
    let test = disturbed(&reference, 30.0, 2);
    let mut cut = test.clone();
    for (i, code) in cut.iter_mut().enumerate() {
        let (x, y) = (i / 3 % W, i / 3 / W);
        if x >= W / 16 * 16 || y >= H / 16 * 16 {
            *code = 0;
        }
    }
    let [whole, cut] = [test, cut].map(|test| value(&fwqi(&frame, &rgb8(W, H, test), 40.0)));
    assert!(whole.is_some() && whole == cut);
}

/// Fine details beyond the eye's limit have no weight: farther from the gaze for coarser levels.
#[test]
fn sensitivity_ends_at_the_cut_off() {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(60.0) };
    let view = spec.resolve(4000, 4000).unwrap().view;
    let eccentricity = Eccentricity::new(view, [2000.0, 2000.0], EccentricityKind::Angular);
    let mut before = 0.0;
    for level in 1..=LEVELS {
        let seen = Seen::new(&eccentricity, level);
        let cutoff = GeislerPerry::default().cutoff_cpd(seen.farthest_deg);
        assert!((cutoff / seen.frequency_cpd - 1.0).abs() < 1e-12 && seen.farthest_deg > before);
        before = seen.farthest_deg;
        let centre = 2000 >> level;
        let weights: Vec<f64> = (centre..4000 >> level).map(|x| seen.weight(x, centre)).collect();
        assert!(weights.is_sorted_by(|a, b| a >= b) && weights[0] > 0.9);
        let step = |x: usize| eccentricity.at_deg(((centre + x) as f64 + 0.5) * seen.block, 2000.0);
        if let Some(end) = weights.iter().position(|weight| *weight == 0.0) {
            assert!(step(end) > seen.farthest_deg - 0.1 && step(end - 1) < seen.farthest_deg + 0.1);
        }
    }
}
