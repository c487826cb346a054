//! What holds for every method, whatever the picture.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use fovqa_emulate::{EmulationSpec, Emulator, FilterChoice, History, Picture, Sampling, Space};
use fovqa_frame::{Channels, Crop, Frame, Mask, Samples, SignalParams, SignalTables, Transfer};
use fovqa_params::{ParamValue, Words};
use fovqa_vision::{View, ViewSpec};

const SIZE: [usize; 2] = [150, 110];
const GAZE: [f64; 2] = [61.3, 70.25];

fn view() -> View {
    let spec = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(110.0) };
    spec.resolve(SIZE[0], SIZE[1]).unwrap().view
}

fn emulator(spec: &EmulationSpec) -> Emulator {
    Emulator::new(spec, SIZE, Some(&view()), GAZE).unwrap()
}

fn picture(channels: Channels, code: impl Fn(usize) -> u8) -> Picture {
    let codes = (0..SIZE[0] * SIZE[1] * channels.count()).map(code).collect();
    let frame = Frame::new(SIZE[0], SIZE[1], channels, Samples::U8(codes)).unwrap();
    Picture::from_frame(&frame, &SignalTables::new(SignalParams::default()))
}

/// Samples are on some pixel of the frame, or off it.
#[test]
fn every_sample_in_the_frame_is_on_one_pixel() {
    let [width, height] = SIZE;
    let mask = |is_on: fn(usize, usize) -> bool| {
        let pixels = (0..width * height).map(|i| is_on(i % width, i / width)).collect();
        Mask::new(width, height, pixels).unwrap()
    };
    let parts =
        [mask(|x, y| x < 64 && y < 50), mask(|x, y| x >= 64 && y < 50), mask(|_, y| y >= 50)];
    let continuous = [("quantise", ParamValue::Text("continuous".to_owned()))];
    let methods = EmulationSpec::methods().into_iter().map(|info| spec(info.key, &[]));
    for spec in methods.chain([spec("cps", &continuous)]) {
        let emulator = emulator(&spec);
        let counts = emulator.counts();
        let on = |mask: &Mask| emulator.samples_on(0, mask).unwrap();
        let parts = parts.each_ref().map(on);
        let (all, sum) = (on(&mask(|_, _| true)), parts.iter().sum::<f64>());
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * a;
        // Blocks of pixels at the frame's edge may have their sample off the frame.
        let is_cut = spec.key() == "cps" && all > 0.95 * counts.samples;
        let is_all = close(all, counts.samples_on_screen) || is_cut;
        assert!(is_all, "{}: {all} {counts:?}", spec.key());
        assert!(close(all, sum) && parts.iter().all(|part| *part > 0.0), "{}: {sum}", spec.key());
        let left = counts.reshaded(parts[2]);
        assert!(close(left.all(), parts[2]) && close(left.samples_on_screen, parts[2]));
        assert!(close(left.samples * counts.all(), parts[2] * counts.samples), "{left:?}");
    }
    // The gaze is on pixel (61, 70): the finest samples are there.
    let near = mask(|x, y| x.abs_diff(61) <= 5 && y.abs_diff(70) <= 5);
    let far = mask(|x, y| x.abs_diff(140) <= 5 && y.abs_diff(10) <= 5);
    for method in ["rmfr", "deamp", "guenter", "cps", "linear", "kfr", "lafr", "vafr"] {
        let emulator = emulator(&spec(method, &[]));
        let [near, far] = [&near, &far].map(|mask| emulator.samples_on(0, mask).unwrap());
        assert!(near > 1.5 * far, "{method}: {near} {far}");
    }
    let small = Mask::new(3, 2, vec![true; 6]).unwrap();
    assert!(emulator(&spec("rmfr", &[])).samples_on(0, &small).is_err());
}

/// A pattern without order.
fn noise(i: usize) -> u8 {
    ((i as u32).wrapping_mul(2_654_435_761) >> 24) as u8
}

fn spec(method: &str, set: &[(&str, ParamValue)]) -> EmulationSpec {
    let mut spec = EmulationSpec::new(method).unwrap();
    for (name, value) in set {
        spec.set(name, value).unwrap();
    }
    spec
}

/// Every method with every choice of sampling, filters and space, some of them enhanced.
fn all() -> Vec<(String, EmulationSpec)> {
    let mut all = Vec::new();
    for info in EmulationSpec::methods() {
        for sampling in Sampling::all() {
            for filters in FilterChoice::all() {
                for space in Space::all() {
                    let mut spec = EmulationSpec::new(info.key).unwrap();
                    if info.key == "vafr" {
                        // A million samples show no more than ten thousand.
                        spec.set("factor", &ParamValue::Number(0.1)).unwrap();
                    }
                    spec.set_sampling(sampling);
                    spec.set_space(space);
                    if spec.set_filters(filters).is_err() {
                        continue;
                    }
                    if space == Space::Linear {
                        spec.set_enhance(2.0).unwrap();
                    }
                    let words = [sampling.word(), filters.word(), space.word()];
                    all.push((format!("{} {}", info.key, words.join(" ")), spec));
                }
            }
        }
    }
    assert!(all.len() > 70, "{}", all.len());
    all
}

#[test]
fn a_rate_of_one_everywhere_leaves_the_frame_as_it_is() {
    let number = ParamValue::Number;
    let ones = ParamValue::List(vec![1.0; 3]);
    let cases = [
        spec("full", &[]),
        spec("guenter", &[("scales", ones)]),
        spec("cps", &[("foveal_deg", number(89.0))]),
        spec(
            "cps",
            &[("foveal_deg", number(89.0)), ("quantise", ParamValue::Text("continuous".into()))],
        ),
        spec("linear", &[("p_min", number(1.0))]),
        spec("stable", &[("rate_arcmin", number(0.0))]),
        spec("aliased", &[("rate_arcmin", number(0.0))]),
        spec("perceptual-target", &[("rate_arcmin", number(0.0))]),
    ];
    for channels in [Channels::Gray, Channels::Rgb] {
        let frame = picture(channels, noise);
        for sampling in Sampling::all() {
            for mut spec in cases.clone() {
                spec.set_sampling(sampling);
                let shown = emulator(&spec).emulate(&frame).unwrap();
                assert!(shown == frame, "{} {}", spec.key(), sampling.word());
            }
        }
    }
}

#[test]
fn a_constant_frame_stays_constant() {
    for channels in [Channels::Gray, Channels::Rgb] {
        let frame = picture(channels, |i| [40, 150, 201][i % channels.count()]);
        for (name, spec) in all() {
            let emulator = emulator(&spec);
            let shown = emulator.emulate(&frame).unwrap();
            let off = shown.values().iter().zip(frame.values()).map(|(a, b)| (a - b).abs());
            let worst = off.fold(0.0, f32::max);
            assert!(worst < 2e-6, "{name}: {worst:e}");
        }
    }
}

#[test]
fn codes_are_those_of_the_picture() {
    let tables = SignalTables::new(SignalParams::default());
    for channels in [Channels::Gray, Channels::Rgb] {
        let codes = (0..SIZE[0] * SIZE[1] * channels.count()).map(noise).collect();
        let frame = Frame::new(SIZE[0], SIZE[1], channels, Samples::U8(codes)).unwrap();
        let picture = Picture::from_frame(&frame, &tables);
        for (name, spec) in all() {
            let emulator = emulator(&spec);
            let expected = emulator.emulate(&picture).unwrap().to_codes8();
            assert!(emulator.emulate_codes8(&frame, &tables).unwrap() == expected, "{name}");
        }
    }
}

#[test]
fn codes_are_read_as_the_frame_says() {
    let codes = |n: usize| Samples::U8((0..n).map(noise).collect());
    let wide = Frame::new(SIZE[0] + 7, SIZE[1] + 5, Channels::Rgb, codes(157 * 115 * 3)).unwrap();
    let crop = Crop { x: 3, y: 4, width: SIZE[0], height: SIZE[1] };
    let cropped = wide.cropped(crop).unwrap();
    let linear = SignalParams { transfer: Some(Transfer::Linear), ..SignalParams::default() };
    for params in [SignalParams::default(), linear] {
        let tables = SignalTables::new(params);
        let emulator = emulator(&spec("kfr", &[]));
        let picture = Picture::from_frame(&cropped, &tables);
        let expected = emulator.emulate(&picture).unwrap().to_codes8();
        assert!(emulator.emulate_codes8(&cropped, &tables).unwrap() == expected, "{params:?}");
    }
    let tables = SignalTables::new(SignalParams::default());
    for side in 1..=3 {
        let frame = Frame::new(side, 1, Channels::Rgb, codes(side * 3)).unwrap();
        let full = EmulationSpec::new("rmfr").unwrap();
        let emulator = Emulator::new(&full, [side, 1], None, [0.5, 0.5]).unwrap();
        let expected = emulator.emulate(&Picture::from_frame(&frame, &tables)).unwrap();
        assert!(emulator.emulate_codes8(&frame, &tables).unwrap() == expected.to_codes8());
    }
}

/// Every sample that a pixel reads is there, wherever the gaze is and however dense samples are.
#[test]
fn polar_buffers_are_sampled_where_pixels_read_them() {
    let frame = picture(Channels::Rgb, |i| [40, 150, 201][i % 3]);
    let cases = [
        spec("kfr", &[]),
        spec("kfr", &[("sigma", ParamValue::Number(40.0))]),
        spec("kfr", &[("alpha", ParamValue::Number(0.5))]),
        spec("lafr", &[]),
        spec("vafr", &[("factor", ParamValue::Number(0.02))]),
        spec("vafr", &[("factor", ParamValue::Number(0.3))]),
        spec("visual-polar", &[]),
        spec("visual-polar", &[("samples_per_pixel", ParamValue::Number(0.002))]),
        spec("visual-polar", &[("samples_per_pixel", ParamValue::Number(8.0))]),
    ];
    let gazes = [
        [0.0, 0.0],
        [75.0, 55.0],
        [75.5, 55.5],
        [150.0, 110.0],
        [0.0, 61.0],
        [33.3, 109.9],
        [149.5, 0.5],
        [64.0, 110.0],
    ];
    for spec in &cases {
        for gaze in gazes {
            let emulator = Emulator::new(spec, SIZE, Some(&view()), gaze).unwrap();
            let shown = emulator.emulate(&frame).unwrap();
            let off = shown.values().iter().zip(frame.values()).map(|(a, b)| (a - b).abs());
            let worst = off.fold(0.0, f32::max);
            assert!(worst < 2e-6, "{} {:?} {gaze:?}: {worst:e}", spec.key(), spec.parameters());
        }
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let frame = picture(Channels::Rgb, noise);
    for (name, mut spec) in all() {
        spec.set_temporal(true);
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let (emulator, mut history) = (emulator(&spec), History::default());
                emulator.emulate_next(&picture(Channels::Rgb, |_| 9), None, &mut history).unwrap();
                let shown = emulator.emulate_next(&frame, None, &mut history).unwrap();
                (shown, emulator.counts().clone())
            })
        };
        assert!(run(1) == run(8), "{name}");
    }
}

#[test]
fn gray_is_three_equal_channels() {
    let gray = picture(Channels::Gray, noise);
    let colour = picture(Channels::Rgb, |i| noise(i / 3));
    for (name, spec) in all() {
        let emulator = emulator(&spec);
        let (gray, colour) = (emulator.emulate(&gray).unwrap(), emulator.emulate(&colour).unwrap());
        let pairs = gray.values().iter().zip(colour.values().chunks_exact(3));
        let worst = pairs.map(|(a, b)| (a - b[1]).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-6, "{name}: {worst:e}");
    }
}

#[test]
fn buffers_are_as_large_as_their_counts_say() {
    let frame = picture(Channels::Rgb, noise);
    for (name, spec) in all() {
        let emulator = emulator(&spec);
        let buffers = emulator.buffers(&frame).unwrap();
        let sizes: Vec<_> = buffers.iter().map(|b| [b.width(), b.height()]).collect();
        if !sizes.is_empty() {
            assert_eq!(sizes, emulator.counts().buffers, "{name}");
        }
    }
}
