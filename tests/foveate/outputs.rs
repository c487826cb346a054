//! Types, bits and names of the files that are written.

use std::fs;

use fovqa_frame::{Channels, Samples};
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::png_files;
use fovqa_testkit::synthetic::codes;

use super::frames::{HEIGHT, WIDTH, with_frame, with_sequence};
use crate::fovqa::Folder;

const RMFR: &str = "--method rmfr";

fn bits(samples: &Samples) -> &'static str {
    match samples {
        Samples::U8(_) => "8",
        Samples::U16(_) => "16",
        Samples::F16(_) => "half",
        Samples::F32(_) => "float",
    }
}

/// A folder with an input of every kind.
fn with_every_kind() -> Folder {
    let folder = with_frame();
    let deep = |n: usize| (0..n).map(|i| (i * 37 % 65536) as u16).collect::<Vec<u16>>();
    png_files::write16(&folder.path("deep.png"), WIDTH, HEIGHT, &deep(WIDTH * HEIGHT * 3));
    png_files::write16(&folder.path("deep-gray.png"), WIDTH, HEIGHT, &deep(WIDTH * HEIGHT));
    folder.png("gray.png", WIDTH, HEIGHT, &codes(WIDTH, HEIGHT, 1, 2));
    folder.png("a.jpg", WIDTH, HEIGHT, &codes(WIDTH, HEIGHT, 3, 1));
    let size = (WIDTH, HEIGHT);
    File::new(vec![Part::rgb(size, value)]).write(&folder.path("half.exr"));
    let plane: Vec<f32> = (0..WIDTH * HEIGHT).map(|i| value(i % WIDTH, i / WIDTH)).collect();
    let gray = Part::new(size, &[("Y", Values::Float(plane))]);
    File::new(vec![gray]).write(&folder.path("float.exr"));
    folder
}

fn value(x: usize, y: usize) -> f32 {
    (x * 7 + y * 13) as f32 % 31.0 / 25.0
}

#[test]
fn a_file_has_the_type_of_its_ending_and_the_bits_of_the_input() {
    let folder = with_every_kind();
    let cases = [
        ("a.png", "o.png", "8", Channels::Rgb),
        ("gray.png", "o.png", "8", Channels::Gray),
        ("deep.png", "o.png", "16", Channels::Rgb),
        ("deep-gray.png", "o.png", "16", Channels::Gray),
        ("a.jpg", "o.png", "8", Channels::Rgb),
        ("a.jpg", "o.jpeg", "8", Channels::Rgb),
        ("a.png", "o.jpg", "8", Channels::Rgb),
        ("gray.png", "o.jpg", "8", Channels::Gray),
        ("half.exr", "o.png", "8", Channels::Rgb),
        ("float.exr", "o.png", "8", Channels::Gray),
        ("half.exr", "o.exr", "half", Channels::Rgb),
        ("float.exr", "o.exr", "float", Channels::Gray),
        ("a.png", "o.exr", "half", Channels::Rgb),
        ("deep-gray.png", "o.exr", "half", Channels::Gray),
    ];
    for (input, output, wanted, channels) in cases {
        folder.foveate(&format!("{input} {output} {RMFR}")).ok();
        let frame = folder.frame(output);
        assert_eq!(bits(frame.samples()), wanted, "{input} to {output}");
        assert_eq!(frame.channels(), channels, "{input} to {output}");
        assert_eq!((frame.width(), frame.height()), (WIDTH, HEIGHT));
        fs::remove_file(folder.path(output)).unwrap();
    }
}

/// Where a method shows the frame itself, no sample changes, whatever the type. Values beyond the tone
/// map's range stay as well.
#[test]
fn what_a_method_does_not_change_keeps_its_value() {
    let folder = with_every_kind();
    let options = "--method full --tonemap reinhard --exposure 0.7";
    for input in ["a.png", "gray.png", "deep.png", "deep-gray.png", "half.exr", "float.exr"] {
        let output = format!("out-{input}");
        folder.foveate(&format!("{input} {output} {options}")).ok();
        assert!(folder.frame(&output) == folder.frame(input), "{input}");
    }
    folder.foveate("float.exr clamped.exr --method full").ok();
    assert!(folder.frame("clamped.exr") == folder.frame("float.exr"));
    // Rate 1 everywhere.
    folder.foveate("a.png cps.png --method cps --fov-vertical 10").ok();
    assert!(folder.frame("cps.png") == folder.frame("a.png"));
}

/// Linear light of an OpenEXR output means the same as the codes of a PNG output.
#[test]
fn linear_light_and_codes_of_an_output_agree() {
    let folder = with_every_kind();
    for options in ["--tonemap reinhard --exposure 1", "--exposure -1"] {
        for input in ["half.exr", "float.exr"] {
            folder.foveate(&format!("{input} o.png {RMFR} {options}")).ok();
            folder.foveate(&format!("{input} o.exr {RMFR} {options}")).ok();
            let arguments: Vec<&str> = options.split(' ').collect();
            let psnr = folder.metric("psnr", &[&["o.png", "o.exr"], &arguments[..]].concat());
            assert!(psnr > 55.0, "{input} {options}: {psnr} dB");
        }
    }
    folder.foveate(&format!("a.png p.png {RMFR}")).ok();
    folder.foveate(&format!("a.png p.exr {RMFR} --exposure 2 --tonemap reinhard")).ok();
    let psnr = folder.metric("psnr", &["p.png", "p.exr"]);
    assert!(psnr > 55.0, "codes have no exposure: {psnr} dB");
    // Encoded floats stay encoded.
    folder.foveate(&format!("float.exr s.exr {RMFR} --transfer srgb")).ok();
    folder.foveate(&format!("float.exr s.png {RMFR} --transfer srgb")).ok();
    let psnr = folder.metric("psnr", &["s.png", "s.exr", "--transfer", "srgb"]);
    assert!(psnr > 55.0, "{psnr} dB");
}

#[test]
fn only_the_crop_is_written() {
    let folder = with_frame();
    let record = folder.record("a.png o.png --method full --crop 8,4,24,20 --fov-vertical 60");
    assert_eq!(record["view"]["width"], 24);
    let (found, before) = (folder.frame("o.png"), folder.frame("a.png"));
    assert_eq!((found.width(), found.height()), (24, 20));
    assert_eq!(found.sample(1, 3, 5).to_bits(), before.sample(1, 11, 9).to_bits());
}

#[test]
fn existing_files_are_replaced_and_nothing_else_stays() {
    let folder = with_frame();
    folder.write("out/a.png", "old");
    folder.foveate(&format!("a.png out {RMFR}")).ok();
    assert_eq!(folder.frame("out/a.png").width(), WIDTH);
    let names = fs::read_dir(folder.path("out")).unwrap().map(|entry| entry.unwrap().file_name());
    assert_eq!(names.collect::<Vec<_>>(), ["a.png"]);
}

#[test]
fn reduced_buffers_are_written_as_pictures() {
    let folder = with_frame();
    let record = folder.record(&format!("a.png o.png {RMFR} --buffer b.png"));
    let [width, height] = [0, 1].map(|i| record["frames"][0]["buffers"][0][i].as_u64().unwrap());
    let buffer = folder.frame("b.png");
    assert_eq!([buffer.width() as u64, buffer.height() as u64], [width, height]);
    assert_eq!(record["frames"][0]["buffer_files"], serde_json::json!(["b.png"]));

    let record = folder.record("a.png o.png --method deamp --buffer layers.exr --frames 0..1");
    let sizes = record["frames"][0]["buffers"].as_array().unwrap();
    assert_eq!(sizes.len(), 3);
    for (layer, size) in sizes.iter().enumerate() {
        let buffer = folder.frame(&format!("layers-{}.exr", layer + 1));
        assert_eq!(serde_json::json!([buffer.width(), buffer.height()]), *size);
        assert_eq!(bits(buffer.samples()), "half");
    }

    let sequence = with_sequence(2);
    sequence.foveate("gt out --method rmfr --buffer buffers").ok();
    for name in ["buffers/0000.png", "buffers/0001.png"] {
        assert!(sequence.frame(name).width() < WIDTH, "{name}");
    }
}
