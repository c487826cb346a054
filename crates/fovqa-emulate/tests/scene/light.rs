//! What becomes of a scene's light.

use fovqa_emulate::{History, Jitter, Sampling, Space};
use fovqa_frame::transfer::srgb;
use fovqa_frame::{SignalParams, ToneMap};
use fovqa_params::Words;

use crate::{Light, SIZE, all, emulator, fetched, noise, picture, shown, spec};

#[test]
fn a_constant_scene_stays_constant() {
    let light = [0.02f32, 0.21, 0.8];
    let expected = light.map(|light| srgb::encode(f64::from(light)) as f32);
    for (name, mut spec) in all() {
        for jitter in Jitter::all() {
            spec.set_jitter(jitter);
            let found = shown(&spec, &Light(|_, _| light), 6);
            for pixel in found.values().chunks_exact(3) {
                let off = pixel.iter().zip(expected).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f32::max) < 2e-6, "{name}: {pixel:?} for {expected:?}");
            }
        }
    }
}

/// Exposure, tone map, encoding, and what is no number: to the last bit as frames are read.
#[test]
fn light_becomes_the_signal_as_in_frames() {
    let mut pixels = noise(1);
    for pixel in &mut pixels {
        *pixel = pixel.map(|light| 6.0 * light - 0.5);
    }
    pixels[17] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let scene = Light(|x: f64, y: f64| pixels[y as usize * SIZE[0] + x as usize]);
    for tonemap in ToneMap::all() {
        for exposure_stops in [-1.5, 0.0, 2.0] {
            let signal = SignalParams { exposure_stops, tonemap, ..SignalParams::default() };
            let mut history = History::default();
            let full = emulator(&spec("full"));
            let found = full.emulate_scene(&scene, 0, &signal, None, &mut history).unwrap();
            assert!(found == picture(&pixels, signal), "{tonemap:?} {exposure_stops}");
        }
    }
}

/// Half of a pixel black, half white: half the light, not half the code; also where there is one sample
/// per pixel.
#[test]
fn rays_of_an_area_are_averaged_in_linear_light() {
    let scene = Light(|x: f64, _| [if x.fract() < 0.5 { 0.0 } else { 1.0 }; 3]);
    for space in Space::all() {
        let mut full = spec("full");
        full.set_sampling(Sampling::Area);
        full.set_space(space);
        let half = srgb::encode(0.5) as f32;
        assert!(shown(&full, &scene, 0).values().iter().all(|value| (value - half).abs() < 1e-6));
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let scene = fetched(&noise(2), Space::Encoded);
    for (name, mut spec) in all() {
        spec.set_temporal(true);
        spec.set_jitter(Jitter::Halton);
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let signal = SignalParams::default();
            pool.install(|| {
                let (emulator, mut history) = (emulator(&spec), History::default());
                let next = |frame| {
                    emulator.emulate_scene(&scene, frame, &signal, None, &mut history).unwrap()
                };
                [0, 1].map(next)
            })
        };
        assert!(run(1) == run(4), "{name}");
    }
}
