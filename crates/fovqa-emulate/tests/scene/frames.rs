//! A scene that answers as a frame does is shown as the frame is.

use fovqa_emulate::{FilterChoice, History, Jitter, Picture, Sampling, SceneLight, Space};
use fovqa_frame::SignalParams;
use fovqa_frame::transfer::srgb;
use fovqa_params::Words;

use crate::{Light, SIZE, all, emulator, fetched, noise, picture, shown};

fn worst(a: &Picture, b: &Picture) -> f32 {
    assert_eq!(a.values().len(), b.values().len());
    let offs = a.values().iter().zip(b.values()).map(|(a, b)| (a - b).abs());
    offs.fold(0.0, |worst, off| if off > worst || off.is_nan() { off } else { worst })
}

/// The same positions, the same filters, the same sequence: a scene that answers what a frame's fetch
/// reads gives the picture of that frame.
#[test]
fn a_scene_that_is_a_frame_shows_what_the_frame_shows() {
    let pixelwise =
        ["full", "taa", "guenter", "cps", "linear", "stable", "aliased", "perceptual_target"];
    let mut compared = 0;
    for (name, mut spec) in all() {
        // The rays of an area are averaged in linear light; of a pixel they are not the pixel.
        let area = spec.sampling() == Sampling::Area;
        if area && (spec.space() == Space::Encoded || pixelwise.contains(&spec.key())) {
            continue;
        }
        for jitter in Jitter::all() {
            spec.set_jitter(jitter);
            spec.set_temporal(true);
            spec.set_enhance(0.5).unwrap();
            // FXAA divides by differences of neighbours.
            let fxaa = spec.key() == "vafr" && spec.filters() != FilterChoice::None;
            let tolerance = if fxaa { 1e-3 } else { 1e-4 };
            let emulator = emulator(&spec);
            let (mut of_frames, mut of_scenes) = (History::default(), History::default());
            for frame in [4, 5] {
                let (pixels, signal) = (noise(frame), SignalParams::default());
                let expected = emulator
                    .at_frame(frame)
                    .unwrap()
                    .emulate_next(&picture(&pixels, signal), None, &mut of_frames)
                    .unwrap();
                let scene = fetched(&pixels, spec.space());
                let found =
                    emulator.emulate_scene(&scene, frame, &signal, None, &mut of_scenes).unwrap();
                let off = worst(&found, &expected);
                // The temporal filter takes roots of small differences.
                let tolerance = if frame == 4 { tolerance } else { 1e-3 };
                assert!(off < tolerance, "{name}, {jitter:?}, frame {frame}: {off:e}");
                compared += 1;
            }
            let pixels = noise(9);
            let frame = picture(&pixels, SignalParams::default());
            let expected = emulator.at_frame(9).unwrap().buffers(&frame).unwrap();
            let scene = fetched(&pixels, spec.space());
            let found = emulator.scene_buffers(&scene, 9, &SignalParams::default()).unwrap();
            assert_eq!(found.len(), expected.len(), "{name}");
            for (found, expected) in found.iter().zip(&expected) {
                assert_eq!(found.width(), expected.width(), "{name}");
                let off = worst(found, expected);
                assert!(off < tolerance, "{name}, {jitter:?}, buffer: {off:e}");
            }
        }
    }
    assert!(compared > 120, "{compared}");
}

/// A linear function of the position, encoded, is shown as it is, whatever the sampling: away from the
/// edges, where blurs and samples off the frame matter.
#[test]
fn a_ramp_stays_a_ramp() {
    let ramp = |x: f64, y: f64| [0.3 + 4e-4 * x, 0.5 - 3e-4 * y, 0.2 + 2e-4 * (x + y)];
    let scene = Light(|x, y| ramp(x, y).map(|value| srgb::decode(value) as f32));
    let pixels: Vec<[f32; 3]> = (0..SIZE[0] * SIZE[1])
        .map(|i| scene.light((i % SIZE[0]) as f64 + 0.5, (i / SIZE[0]) as f64 + 0.5))
        .collect();
    let frame = picture(&pixels, SignalParams::default());
    for (name, spec) in all() {
        let (found, of_frame) = (shown(&spec, &scene, 0), emulator(&spec).emulate(&frame).unwrap());
        for y in 40..SIZE[1] - 30 {
            for x in 40..SIZE[0] - 40 {
                for c in 0..3 {
                    let at = 3 * (y * SIZE[0] + x) + c;
                    let off = (found.values()[at] - of_frame.values()[at]).abs();
                    assert!(off < 1e-4, "{name} at {x}, {y}: {off:e}");
                }
            }
        }
    }
}
