//! Emulation of continuous scenes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod asked;
mod frames;
mod gain;
mod light;

use fovqa_emulate::{EmulationSpec, Emulator, FilterChoice, History, Picture};
use fovqa_emulate::{Sampling, SceneLight, Space};
use fovqa_frame::transfer::srgb;
use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables};
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

/// A scene that is a function.
struct Light<F>(F);

impl<F: Fn(f64, f64) -> [f32; 3] + Sync> SceneLight for Light<F> {
    fn light(&self, x: f64, y: f64) -> [f32; 3] {
        (self.0)(x, y)
    }
}

fn shown(spec: &EmulationSpec, scene: &dyn SceneLight, frame: usize) -> Picture {
    let signal = SignalParams::default();
    emulator(spec).emulate_scene(scene, frame, &signal, None, &mut History::default()).unwrap()
}

fn spec(method: &str) -> EmulationSpec {
    let mut spec = EmulationSpec::new(method).unwrap();
    if method == "vafr" {
        // A million samples show no more than ten thousand.
        spec.set("factor", &ParamValue::Number(0.1)).unwrap();
    }
    spec
}

/// Every method with every choice of sampling, filters and space.
fn all() -> Vec<(String, EmulationSpec)> {
    let mut all = Vec::new();
    for info in EmulationSpec::methods() {
        for sampling in Sampling::all() {
            for filters in FilterChoice::all() {
                for space in Space::all() {
                    let mut spec = spec(info.key);
                    spec.set_sampling(sampling);
                    spec.set_space(space);
                    if spec.set_filters(filters).is_ok() {
                        let words = [sampling.word(), filters.word(), space.word()];
                        all.push((format!("{} {}", info.key, words.join(" ")), spec));
                    }
                }
            }
        }
    }
    assert!(all.len() > 70, "{}", all.len());
    all
}

/// A pattern without order, linear light.
fn noise(seed: usize) -> Vec<[f32; 3]> {
    let value = |i: usize| ((i + 7919 * seed) as u32).wrapping_mul(2_654_435_761) >> 8;
    let channel = |i: usize| value(i) as f32 / (1u32 << 24) as f32;
    (0..SIZE[0] * SIZE[1])
        .map(|i| [channel(3 * i), channel(3 * i + 1), channel(3 * i + 2)])
        .collect()
}

fn picture(pixels: &[[f32; 3]], signal: SignalParams) -> Picture {
    let planes = (0..3).flat_map(|c| pixels.iter().map(move |pixel| pixel[c])).collect();
    let frame = Frame::new(SIZE[0], SIZE[1], Channels::Rgb, Samples::F32(planes)).unwrap();
    Picture::from_frame(&frame, &SignalTables::new(signal))
}

/// The scene that is what `fetch` reads in a frame: bilinear in the values of a space, edges clamped.
fn fetched(pixels: &[[f32; 3]], space: Space) -> impl SceneLight + use<> {
    let encodes = space == Space::Encoded;
    let value = move |light: f32| {
        if encodes { srgb::encode(f64::from(light)) } else { f64::from(light) }
    };
    let values: Vec<[f64; 3]> = pixels.iter().map(|pixel| pixel.map(value)).collect();
    Light(move |x: f64, y: f64| {
        let tap = |x: f64, n: usize| {
            let a = (x - 0.5).clamp(0.0, (n - 1) as f64);
            let i = a.floor() as usize;
            (i, (i + 1).min(n - 1), a - a.floor())
        };
        let ((i, next_i, s), (j, next_j, t)) = (tap(x, SIZE[0]), tap(y, SIZE[1]));
        std::array::from_fn(|c| {
            let at = |i: usize, j: usize| values[j * SIZE[0] + i][c];
            let row = |j: usize| at(i, j) * (1.0 - s) + at(next_i, j) * s;
            let value = row(j) * (1.0 - t) + row(next_j) * t;
            if encodes { srgb::decode(value) as f32 } else { value as f32 }
        })
    })
}
