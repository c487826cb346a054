//! Where a scene is asked, and how often.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use fovqa_emulate::{EmulationSpec, Emulator, FilterChoice, History, Jitter, Sampling};
use fovqa_frame::{Motion, Plane, PlaneSamples, SignalParams};

use crate::{Light, SIZE, emulator, shown, spec};

/// Asks a scene, and returns how often it was asked.
fn calls(spec: &EmulationSpec) -> usize {
    let calls = AtomicUsize::new(0);
    let scene = Light(|_, _| {
        calls.fetch_add(1, Ordering::Relaxed);
        [0.5; 3]
    });
    shown(spec, &scene, 0);
    calls.into_inner()
}

#[test]
fn each_sample_is_asked_once() {
    let methods = [
        "full",
        "rmfr",
        "deamp",
        "guenter",
        "cps",
        "kfr",
        "lafr",
        "vafr",
        "visual_polar",
        "stable",
    ];
    for method in methods {
        let mut spec = spec(method);
        let counts = emulator(&spec).counts().clone();
        let mut samples = (counts.samples + counts.samples_beyond) as usize;
        if method == "deamp" {
            // Its buffers are filled whole.
            samples = counts.buffers.iter().map(|[w, h]| w * h).sum();
        }
        assert_eq!(calls(&spec), samples, "{method}");
        spec.set_sampling(Sampling::Area);
        assert_eq!(calls(&spec), 16 * samples, "{method}, area");
        if spec.set_filters(FilterChoice::Own).is_ok() {
            assert_eq!(calls(&spec), 16 * samples, "{method}, area, filtered");
        }
    }
    // RMFR of Full HD.
    let emulator = Emulator::new(&spec("rmfr"), [1920, 1080], None, [960.0, 540.0]).unwrap();
    let counted = AtomicUsize::new(0);
    let scene = Light(|_, _| [counted.fetch_add(1, Ordering::Relaxed) as f32; 3]);
    let signal = SignalParams::default();
    emulator.emulate_scene(&scene, 0, &signal, None, &mut History::default()).unwrap();
    assert_eq!(counted.load(Ordering::Relaxed), emulator.counts().samples as usize);
}

#[test]
fn samples_are_asked_where_they_stand_also_off_the_frame() {
    for method in
        ["full", "rmfr", "deamp", "guenter", "cps", "kfr", "lafr", "vafr", "visual_polar", "stable"]
    {
        for (jitter, frame) in [(Jitter::None, 3), (Jitter::Halton, 3), (Jitter::Halton, 8)] {
            let mut spec = spec(method);
            spec.set_jitter(jitter);
            let asked = Mutex::new(Vec::new());
            let record = Light(|x, y| {
                asked.lock().unwrap().push([x, y]);
                [0.5; 3]
            });
            shown(&spec, &record, frame);
            let mut asked = asked.into_inner().unwrap();
            let mut positions = emulator(&spec).sample_positions(frame).unwrap();
            let order =
                |a: &[f64; 2], b: &[f64; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
            asked.sort_by(order);
            positions.sort_by(order);
            assert!(asked == positions, "{method}, {jitter:?}");
            let inside = |[x, y]: &[f64; 2]| {
                (0.0..SIZE[0] as f64).contains(x) && (0.0..SIZE[1] as f64).contains(y)
            };
            let on_screen = positions.iter().filter(|place| inside(place)).count();
            if ["kfr", "lafr", "vafr", "visual_polar"].contains(&method) {
                assert!(on_screen < positions.len(), "{method}: some stand off the frame");
                let counted = emulator(&spec).counts().samples_on_screen;
                let off = (counted - on_screen as f64).abs();
                assert!(off <= if jitter == Jitter::None { 1.0 } else { 0.05 * counted });
            }
        }
    }
}

/// Motion of another size is refused before the scene is asked, which may take long.
#[test]
fn motion_of_another_size_is_refused_first() {
    let mut spec = spec("rmfr");
    spec.set_temporal(true);
    let (width, height) = (SIZE[0] + 1, SIZE[1]);
    let plane = Plane::new(width, height, PlaneSamples::F32(vec![0.0; width * height])).unwrap();
    let motion = Motion::new(plane.clone(), plane, [1.0; 2]).unwrap();
    let scene = Light(|_, _| unreachable!("asked"));
    let signal = SignalParams::default();
    let mut history = History::default();
    let error = emulator(&spec).emulate_scene(&scene, 0, &signal, Some(&motion), &mut history);
    assert!(error.unwrap_err().to_string().contains("motion of 151x110"));
}
