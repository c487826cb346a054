//! Compares HDR-FLIP with its definition: FLIP of each exposure, by the literal implementation of FLIP's tests.

#![allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]

use fovqa_frame::{Channels, Frame, Mask, Samples, SignalParams, SignalTables};
use fovqa_params::ParamValue;
use fovqa_vision::BandMap;

use super::*;
use crate::metric::flip::tests::literal;
use crate::regions::{BlockRegions, Regions};

const W: usize = 31;
const H: usize = 23;
const PPD: f64 = 15.0;

/// Values over several magnitudes, with some below 0.
fn light(seed: usize) -> Vec<f32> {
    let value = |i: usize| {
        let share = ((i * 7919 + seed * 31) % 997) as f32 / 997.0;
        let stops = share.powi(4) * 12.0 - 6.0;
        if i.is_multiple_of(101) { -0.5 } else { stops.exp2() }
    };
    (0..3 * W * H).map(value).collect()
}

struct Setup {
    planes: [Vec<f32>; 2],
    mask: Option<Mask>,
    params: registry::Params,
}

impl Setup {
    fn new() -> Self {
        let mut params = registry::Params::default();
        params.flip.ppd = Some(PPD);
        let reference = light(1);
        let test =
            reference.iter().enumerate().map(|(i, v)| v * (1.0 + 0.1 * (i % 5) as f32)).collect();
        Self { planes: [reference, test], mask: None, params }
    }

    fn measure(&self, signal: SignalParams) -> Result<Scored, ScoreError> {
        let [reference, test] = self.planes.each_ref().map(|planes| {
            Frame::new(W, H, Channels::Rgb, Samples::F32(planes.clone().into())).unwrap()
        });
        let bands = BandMap::without_bands(W, H);
        let regions = match &self.mask {
            None => Regions::unmasked(&bands),
            Some(mask) => Regions::masked(&bands, mask, 0),
        };
        measure(
            &self.params.hdr_flip,
            &self.params,
            &PairInput {
                reference: &reference,
                test: &test,
                tables: &SignalTables::new(signal),
                regions: &regions,
                blocks: &BlockRegions::default(),
                eccentricity: None,
                weight: None,
                map: true,
            },
        )
    }

    fn scored(&self) -> Scored {
        self.measure(SignalParams::default()).unwrap()
    }

    fn set(&mut self, name: &str, value: &ParamValue) {
        self.params.set(Metric::HdrFlip, name, value).unwrap();
    }
}

fn pixels(planes: &[f32]) -> Vec<[f64; 3]> {
    let at = |i: usize, c: usize| f64::from(planes[c * W * H + i].max(0.0));
    (0..W * H).map(|i| [at(i, 0), at(i, 1), at(i, 2)]).collect()
}

fn luminance(rgb: &[f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

fn tonemap(name: &str, rgb: [f64; 3]) -> [f64; 3] {
    let mapped = match name {
        "aces" => rgb.map(|v| (0.9036 * v * v + 0.018 * v) / (0.8748 * v * v + 0.354 * v + 0.14)),
        "hable" => {
            rgb.map(|v| (0.231_683 * v * v + 0.013_791 * v) / (0.18 * v * v + 0.3 * v + 0.018))
        }
        _ => rgb.map(|v| v / (1.0 + luminance(&rgb))),
    };
    mapped.map(|v| v.clamp(0.0, 1.0))
}

#[test]
fn the_map_is_the_largest_of_all_exposures() {
    for name in ["aces", "hable", "reinhard"] {
        let mut setup = Setup::new();
        setup.set("tonemap", &ParamValue::Text(name.to_owned()));
        let scored = setup.scored();
        let pictures = setup.planes.each_ref().map(|planes| pixels(planes));
        let mut sorted: Vec<f64> = pictures[0].iter().map(luminance).collect();
        sorted.sort_by(f64::total_cmp);
        let bright = Tonemap::find(name).unwrap().of_bright();
        let [start, stop] =
            [sorted[W * H - 1], sorted[W * H / 2]].map(|value| libm::log2(bright / value));
        let count = (stop - start).ceil().max(2.0);
        let stated =
            |nth: usize| scored.rows.value(Key::of(Metric::HdrFlip).nth(STATISTICS + nth)).unwrap();
        assert!((stated(0) - start).abs() < 1e-6 && (stated(1) - stop).abs() < 1e-6, "{name}");
        assert_eq!(stated(2), count);
        assert!(count > 3.0, "a case of several exposures");
        let mut largest = vec![(0.0, 0.0); W * H];
        for i in 0..count as usize {
            let gain = libm::exp2(start + i as f64 * (stop - start) / (count - 1.0));
            let mapped = pictures.each_ref().map(|picture| {
                picture.iter().map(|rgb| tonemap(name, rgb.map(|v| v * gain))).collect::<Vec<_>>()
            });
            let map = literal([&mapped[0], &mapped[1]], (W, H), PPD);
            for (largest, value) in largest.iter_mut().zip(map) {
                if i == 0 || value > largest.0 {
                    *largest = (value, i as f64 / (count - 1.0));
                }
            }
        }
        let [map, exposure] = &scored.maps[..] else { panic!("two maps") };
        assert_eq!((map.info.name, exposure.info.name), ("hdr_flip", "hdr_flip_exposure"));
        let mut other = 0;
        for (i, (value, at)) in largest.iter().enumerate() {
            assert!((f64::from(map.values[i]) - value).abs() < 3e-4, "{name} {i}");
            other += usize::from((f64::from(exposure.values[i]) - at).abs() > 1e-6);
        }
        // Where two exposures have the same value but for rounding, either may be the largest.
        assert!(other < W * H / 50, "{other} pixels have another exposure");
        let found = scored.rows.value(Key::of(Metric::HdrFlip)).unwrap();
        let wanted = largest.iter().map(|(value, _)| value).sum::<f64>() / (W * H) as f64;
        assert!((found - wanted).abs() < 1e-5, "{name}: {found} for {wanted}");
    }
}

#[test]
fn the_signal_does_not_matter_and_given_exposures_do() {
    let mut setup = Setup::new();
    let scored = setup.scored();
    let exposed = SignalParams { exposure_stops: 4.0, ..SignalParams::default() };
    assert_eq!(setup.measure(exposed).unwrap(), scored);
    setup.set("start", &ParamValue::Number(-3.0));
    setup.set("stop", &ParamValue::Number(1.0));
    setup.set("exposures", &ParamValue::Number(3.0));
    let exposures = Exposures { start: -3.0, stop: 1.0, count: 3 };
    let gain = |i: usize| exposures.root_of_gain(i).powi(2);
    assert!(
        (gain(0) - 0.125).abs() < 1e-7
            && (gain(1) - 0.5).abs() < 1e-7
            && (gain(2) - 2.0).abs() < 1e-6
    );
    let given = setup.scored();
    assert_ne!(given, scored);
    let stated =
        |nth: usize| given.rows.value(Key::of(Metric::HdrFlip).nth(STATISTICS + nth)).unwrap();
    assert_eq!([stated(0), stated(1), stated(2)], [-3.0, 1.0, 3.0]);
    setup.set("start", &ParamValue::Number(1.5));
    let error = setup.params.check().unwrap_err().to_string();
    assert!(error.contains("hdr_flip.stop"), "{error}");
    setup.params.hdr_flip.stop = None;
    setup.set("start", &ParamValue::Number(50.0));
    let error = setup.measure(SignalParams::default()).unwrap_err().to_string();
    assert!(error.contains("50.00 stops, is above the last"), "{error}");
}

/// Values so small that the gain is beyond the largest `f32`.
#[test]
fn the_darkest_light_is_exposed_too() {
    let mut setup = Setup::new();
    let wanted = setup.scored().rows.value(Key::of(Metric::HdrFlip)).unwrap();
    for planes in &mut setup.planes {
        for value in planes.iter_mut() {
            *value *= 2f32.powi(-70) * 2f32.powi(-60);
        }
    }
    let found = setup.scored().rows.value(Key::of(Metric::HdrFlip)).unwrap();
    assert!((found - wanted).abs() < 0.02, "{found} for {wanted}");
}

#[test]
fn pixels_left_out_do_not_set_the_exposures() {
    let mut setup = Setup::new();
    let counts: Vec<bool> = (0..W * H).map(|i| i % W > 3).collect();
    setup.mask = Some(Mask::new(W, H, counts.clone()).unwrap());
    let scored = setup.scored();
    let mut other = Setup { mask: setup.mask.clone(), ..Setup::new() };
    for planes in &mut other.planes {
        for (i, value) in planes.iter_mut().enumerate().filter(|(i, _)| !counts[i % (W * H)]) {
            *value = (i % 7) as f32 * 1e6;
        }
    }
    assert_eq!(scored.rows, other.scored().rows);
    let nan = |values: &[f32]| values.iter().map(|v| !v.is_nan()).collect::<Vec<bool>>();
    assert!(scored.maps.iter().all(|map| nan(&map.values) == counts));
}

#[test]
fn references_that_cannot_be_exposed_are_refused() {
    let mut setup = Setup::new();
    for value in &mut setup.planes[0][..] {
        *value = value.min(0.0);
    }
    let error = setup.measure(SignalParams::default()).unwrap_err();
    assert!(error.to_string().contains("half of the reference is black"), "{error}");
    setup.set("start", &ParamValue::Number(-3.0));
    setup.set("stop", &ParamValue::Number(1.0));
    assert!(setup.measure(SignalParams::default()).is_ok());
    let encoded = SignalParams { transfer: Some(Transfer::Srgb), ..SignalParams::default() };
    let error = setup.measure(encoded).unwrap_err();
    assert!(matches!(error, ScoreError::Unfit { help, .. } if help.contains("flip")), "{error}");
}
