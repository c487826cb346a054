//! Sequences of OpenEXR files with motion, to score in the tests.

use fovqa_testkit::exr_files::{File, Part, Values};

use serde_json::{Value, json};

use crate::fovqa::Folder;

/// Sides of the frames: powers of two, so that motion in any unit is exact.
pub(crate) const W: usize = 64;
pub(crate) const H: usize = 32;
pub(crate) const SIZE: (usize, usize) = (W, H);

/// Where the pixels of a frame were in the frame before it.
pub(crate) const MOTION: [f32; 2] = [-3.0, 2.0];

/// What is used as it is: values that half floats have, already encoded.
pub(crate) const ENCODED: [&str; 2] = ["--transfer", "srgb"];

/// Noise, in steps of 1/256.
pub(crate) fn noise(seed: usize, x: i64, y: i64) -> f32 {
    let mut h = ((x + 1000) as u32).wrapping_mul(0x9e37_79b9) ^ ((y + 1000) as u32) << 12;
    h = (h ^ seed as u32 ^ (h >> 15)).wrapping_mul(0x85eb_ca6b);
    (1 + (h >> 13) % 200) as f32 / 256.0
}

/// A pattern that moves as [`MOTION`] says.
pub(crate) fn moving(seed: usize, frame: usize) -> impl Fn(usize, usize) -> f32 {
    let shift = MOTION.map(|motion| motion as i64 * frame as i64);
    move |x, y| noise(seed, x as i64 + shift[0], y as i64 + shift[1])
}

pub(crate) fn plane(value: impl Fn(usize, usize) -> f32) -> Vec<f32> {
    (0..W * H).map(|i| value(i % W, i / W)).collect()
}

pub(crate) fn float(value: impl Fn(usize, usize) -> f32) -> Values {
    Values::Float(plane(value))
}

pub(crate) fn half(value: impl Fn(usize, usize) -> f32) -> Values {
    Values::Half(plane(value))
}

/// Motion that is the same everywhere.
pub(crate) fn motion(motion: [f32; 2]) -> [(&'static str, Values); 2] {
    [("motion.X", float(|_, _| motion[0])), ("motion.Y", float(|_, _| motion[1]))]
}

pub(crate) fn write(folder: &Folder, name: &str, part: Part) {
    File::new(vec![part]).write(&folder.path(name));
}

pub(crate) fn part(value: impl Fn(usize, usize) -> f32) -> Part {
    Part::rgb(SIZE, value)
}

/// `gt` and `test`, of other noise each, that move; `gt` says how.
pub(crate) fn moved(frames: usize) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let gt = part(moving(1, frame)).with(&motion(MOTION));
        write(&folder, &format!("gt/{frame:04}.exr"), gt);
        write(&folder, &format!("test/{frame:04}.exr"), part(moving(2, frame)));
    }
    folder
}

/// A sequence whose frames differ, so that values tell frames apart.
pub(crate) fn restless(frames: usize) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let gt = part(moving(1, frame * frame)).with(&motion(MOTION));
        write(&folder, &format!("gt/{frame:04}.exr"), gt);
        write(&folder, &format!("test/{frame:04}.exr"), part(moving(2, frame * frame)));
    }
    folder
}

pub(crate) fn atd(folder: &Folder, arguments: &[&str]) -> Value {
    folder.json(&[&["gt", "test", "--metrics", "atd"], arguments].concat())
}

/// What [`MOTION`] leads outside of the frame.
pub(crate) fn beyond_borders() -> f64 {
    1.0 - ((W - 3) * (H - 2)) as f64 / (W * H) as f64
}

#[track_caller]
pub(crate) fn near(found: &Value, want: f64) {
    let number = found.as_f64().unwrap_or_else(|| panic!("{found} for {want}"));
    assert!((number - want).abs() < 1e-6, "{number} for {want}");
}

/// Differences of exactly nothing, and of the pixels left out just those from beyond the borders.
#[track_caller]
pub(crate) fn is_steady(atd: &Value) {
    assert_eq!((&atd["reference"], &atd["test"]), (&json!(0.0), &json!(0.0)), "{atd}");
    let left_out = atd["left_out"].as_f64().unwrap();
    assert!((left_out - beyond_borders()).abs() < 1e-12, "{atd}");
}

/// One scene of `gt` with one method in `test`.
pub(crate) fn experiment(of_scene: &str) -> String {
    format!(
        "name = \"e\"\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n{of_scene}\
         [[method]]\nname = \"A\"\ntest = \"test\"\n[metrics]\natd = {{}}\n"
    )
}

/// Frames by number, and whether they have a difference to the one before.
pub(crate) fn with_atd(json: &Value) -> Vec<(u64, bool)> {
    let frames = json["frames"].as_array().unwrap().iter();
    frames.map(|f| (f["frame"].as_u64().unwrap(), f.get("atd").is_some())).collect()
}
