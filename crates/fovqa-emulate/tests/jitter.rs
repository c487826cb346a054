//! Jitter: where samples stand from frame to frame.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::TAU;

use fovqa_emulate::{
    EmulationSpec, Emulator, History, Jitter, Picture, Sampling, SceneLight, Space,
};
use fovqa_frame::transfer::srgb;
use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables};
use fovqa_params::ParamValue;
use fovqa_vision::ViewSpec;

const SIZE: [usize; 2] = [96, 72];
const GAZE: [f64; 2] = [41.5, 30.25];

fn emulator(spec: &EmulationSpec) -> Emulator {
    let fov = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(90.0) };
    let view = fov.resolve(SIZE[0], SIZE[1]).unwrap().view;
    Emulator::new(spec, SIZE, Some(&view), GAZE).unwrap()
}

fn jittered(method: &str) -> EmulationSpec {
    let mut spec = EmulationSpec::new(method).unwrap();
    spec.set_jitter(Jitter::Halton);
    spec
}

/// Halton (2, 3) of index 1, 2, 3, 4.
const FRAMES: [[f64; 2]; 4] =
    [[0.5, 1.0 / 3.0], [0.25, 2.0 / 3.0], [0.75, 1.0 / 9.0], [0.125, 4.0 / 9.0]];

fn near(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).abs() < 1e-9 && (a[1] - b[1]).abs() < 1e-9
}

#[test]
fn samples_stand_at_the_frames_point_of_their_cells() {
    let full = emulator(&jittered("full"));
    let mut kfr = jittered("kfr");
    kfr.set("alpha", &ParamValue::Number(4.0)).unwrap();
    let kfr = emulator(&kfr);
    let [w, h] = kfr.counts().buffers[0];
    let corner = [GAZE[0].max(SIZE[0] as f64 - GAZE[0]), GAZE[1].max(SIZE[1] as f64 - GAZE[1])];
    let reach = corner[0].hypot(corner[1]);
    for (frame, [x, y]) in FRAMES.into_iter().enumerate() {
        let positions = full.sample_positions(frame).unwrap();
        assert!(near(positions[2 * SIZE[0] + 5], [5.0 + x, 2.0 + y]), "{frame}");
        let positions = kfr.sample_positions(frame).unwrap();
        assert_eq!(positions.len(), w * h);
        for [i, j] in [[0, 0], [w / 2, h / 3], [w - 1, h - 1]] {
            let radius_px = reach.powf(((i as f64 + x) / w as f64).powf(0.25));
            let (sin, cos) = (TAU * (j as f64 + y) / h as f64).sin_cos();
            let expected = [GAZE[0] + radius_px * cos, GAZE[1] + radius_px * sin];
            assert!(near(positions[i * h + j], expected), "{frame}: {i}, {j}");
        }
    }
    // RMFR of one axis at a time: between the neighbours without jitter.
    let (centred, moved) = (EmulationSpec::new("rmfr").unwrap(), jittered("rmfr"));
    let centred = emulator(&centred).sample_positions(1).unwrap();
    let moved = emulator(&moved).sample_positions(1).unwrap();
    for (centred, moved) in centred.iter().zip(&moved) {
        assert!(moved[0] < centred[0] && moved[1] > centred[1], "{centred:?}, {moved:?}");
    }
}

#[test]
fn cells_and_layers_of_one_sample_per_pixel_are_jittered_too() {
    for method in ["cps", "guenter", "linear", "aliased", "stable", "taa"] {
        let positions = emulator(&jittered(method)).sample_positions(2).unwrap();
        let [x, y] = FRAMES[2];
        let within = |[px, py]: &&[f64; 2]| near([px.fract(), py.fract()], [x, y]);
        assert!(positions.iter().filter(within).count() > 100, "{method}");
    }
    let cps = emulator(&jittered("cps"));
    assert_eq!(cps.sample_positions(2).unwrap().len(), cps.counts().samples as usize);
}

fn ramp(x: f64, y: f64) -> f64 {
    0.2 + 0.004 * x + 0.002 * y
}

/// A finished frame is read where its samples stand, also by methods whose samples are its pixels.
#[test]
fn finished_frames_are_read_between_their_pixels() {
    let centres = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    let values = centres.map(|[x, y]| ramp(x as f64 + 0.5, y as f64 + 0.5) as f32).collect();
    let frame = Frame::new(SIZE[0], SIZE[1], Channels::Gray, Samples::F32(values)).unwrap();
    let tables = SignalTables::new(SignalParams::default());
    let picture = Picture::from_frame(&frame.encoded(), &tables);
    for method in ["full", "guenter", "cps", "linear", "stable"] {
        let emulator = emulator(&jittered(method));
        for (frame, [dx, dy]) in FRAMES.into_iter().enumerate() {
            let at_frame = emulator.at_frame(frame).unwrap();
            let shown = at_frame.emulate(&picture).unwrap();
            // Around the gaze all of them shade every pixel.
            let [x, y] = GAZE.map(|at| at as usize);
            let expected = ramp(x as f64 + dx, y as f64 + dy);
            let found = f64::from(shown.values()[y * SIZE[0] + x]);
            assert!((found - expected).abs() < 1e-5, "{method} {frame}: {found}, {expected}");
            let next = at_frame.emulate_next(&picture, None, &mut History::default()).unwrap();
            assert!(next == shown, "{method}");
        }
        let first = emulator.at_frame(0).unwrap().emulate(&picture).unwrap();
        assert!(emulator.emulate(&picture).unwrap() == first, "{method}: frame 0 by default");
    }
}

#[test]
fn codes_are_read_where_samples_stand() {
    let codes: Vec<u8> = (0..SIZE[0] * SIZE[1] * 3).map(|i| (i * 37 % 251) as u8).collect();
    let frame = Frame::new(SIZE[0], SIZE[1], Channels::Rgb, Samples::U8(codes.into())).unwrap();
    let tables = SignalTables::new(SignalParams::default());
    for info in EmulationSpec::methods() {
        let emulator = emulator(&jittered(info.key)).at_frame(5).unwrap();
        let picture = Picture::from_frame(&frame, &tables);
        let expected = emulator.emulate(&picture).unwrap().to_codes8();
        assert!(emulator.emulate_codes8(&frame, &tables).unwrap() == expected, "{}", info.key);
    }
}

/// Fine stripes and dots.
struct Pattern;

impl SceneLight for Pattern {
    fn light(&self, x: f64, y: f64) -> [f32; 3] {
        let dots = 0.5 + 0.25 * ((1.5 * x).sin() + (1.3 * y + 0.4 * x).sin());
        [dots as f32; 3]
    }
}

/// The mean light of pictures.
fn mean(pictures: &[Picture]) -> Vec<f64> {
    let light = |value: &f32| srgb::decode(f64::from(*value));
    (0..pictures[0].values().len())
        .map(|i| pictures.iter().map(|picture| light(&picture.values()[i])).sum::<f64>())
        .map(|sum| sum / pictures.len() as f64)
        .collect()
}

/// Over many frames jittered point samples cover their cells.
#[test]
fn the_mean_of_many_frames_is_that_of_the_area() {
    let signal = SignalParams::default();
    for method in ["full", "rmfr", "cps", "guenter", "kfr"] {
        let show = |spec: &EmulationSpec, frame: usize| {
            emulator(spec)
                .emulate_scene(&Pattern, frame, &signal, None, &mut History::default())
                .unwrap()
        };
        // Linear, so that means and the reading of buffers can change places.
        let linear = |mut spec: EmulationSpec| {
            spec.set_space(Space::Linear);
            spec
        };
        let point = linear(jittered(method));
        let mut area = linear(EmulationSpec::new(method).unwrap());
        let centred = mean(&[show(&area, 0)]);
        area.set_sampling(Sampling::Area);
        let area = mean(&[show(&area, 0)]);
        let many: Vec<Picture> = (0..128).map(|frame| show(&point, frame)).collect();
        let off = |values: &[f64]| {
            let squares = values.iter().zip(&area).map(|(a, b)| (a - b) * (a - b));
            (squares.sum::<f64>() / values.len() as f64).sqrt()
        };
        let (of_mean, of_one) = (off(&mean(&many)), off(&centred));
        assert!(of_mean < 0.15 * of_one, "{method}: {of_mean}, {of_one}");
    }
}

#[test]
fn jitter_is_written_where_it_is_on() {
    let none = EmulationSpec::new("rmfr").unwrap();
    let text = serde_json::to_string(&none).unwrap();
    assert!(!text.contains("jitter"), "{text}");
    assert_eq!(serde_json::from_str::<EmulationSpec>(&text).unwrap(), none);
    let halton = jittered("rmfr");
    let text = serde_json::to_string(&halton).unwrap();
    assert!(text.contains("\"jitter\":\"halton\""), "{text}");
    assert_eq!(serde_json::from_str::<EmulationSpec>(&text).unwrap(), halton);
    assert_eq!((none.jitter(), halton.jitter()), (Jitter::None, Jitter::Halton));
}
