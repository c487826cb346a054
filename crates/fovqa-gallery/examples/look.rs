//! Writes a frame of a built-in scene as a PPM picture: `look SCENE FRAME SAMPLES WIDTH HEIGHT FILE`.

#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a tool for those who work on the scene"
)]

use fovqa_frame::Samples;
use fovqa_frame::transfer::srgb;
use fovqa_gallery::{Builtin, BuiltinSpec, SceneName};
use fovqa_params::Words;
use fovqa_vision::View;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |i: usize| arguments[i].parse::<usize>().unwrap();
    let (frame, samples, width, height) = (number(2), number(3), number(4), number(5));
    let scene = SceneName::find(&arguments[1]).unwrap();
    let focal = height as f64 / 2.0 / 50f64.to_radians().tan();
    let principal_px = [width as f64 / 2.0, height as f64 / 2.0];
    let view = View { width, height, focal_px: [focal; 2], principal_px };
    let spec = BuiltinSpec { samples, ..BuiltinSpec::new(scene) };
    let builtin = Builtin::new(&spec, view, 0.0).unwrap();
    let picture = builtin.ground_truth(frame);
    let Samples::F32(values) = picture.samples() else { unreachable!() };
    let mut file = format!("P6\n{width} {height}\n255\n").into_bytes();
    let code = |value: f32| (srgb::encode(f64::from(value.clamp(0.0, 1.0))) * 255.0 + 0.5) as u8;
    for pixel in 0..width * height {
        file.extend((0..3).map(|c| code(values[c * width * height + pixel])));
    }
    std::fs::write(&arguments[6], file).unwrap();
    eprintln!("gaze {:?}, pose {:?}", builtin.gaze_px(frame), builtin.pose(frame));
}
