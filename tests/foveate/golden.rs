//! Every golden case of emulation through the command: pixels and sample counts.

use std::fs;

use fovqa_frame::{Frame, Samples};
use serde_json::Value;

use super::frames::read;
use crate::fovqa::{Folder, root};

/// Pixels with a channel that differs by more than `codes`.
fn far(found: &Frame, wanted: &Frame, codes: u8) -> usize {
    assert_eq!(found.file_size(), wanted.file_size());
    let (Samples::U8(found), Samples::U8(wanted)) = (found.samples(), wanted.samples()) else {
        panic!("codes of 8 bits")
    };
    assert_eq!(found.len(), wanted.len());
    let pixels = found.chunks_exact(3).zip(wanted.chunks_exact(3));
    pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > codes)).count()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} of {value}"))
}

#[test]
fn golden_frames_come_out_of_the_command() {
    let golden = root().join("tests/golden/emulate");
    let text = fs::read_to_string(golden.join("golden.json")).unwrap();
    let cases: Value = serde_json::from_str(&text).unwrap();
    let cases = cases["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 58);
    for case in cases {
        let name = case["name"].as_str().unwrap();
        let is_folder = case["folder"].as_bool().unwrap();
        let tolerance = &case["tolerance"];
        let folder = Folder::new();
        let output = if is_folder { "out" } else { "out.png" };
        let input = golden.join(case["input"].as_str().unwrap());
        let of_folder = |argument: &Value| {
            argument.as_str().unwrap().replace("{dir}", golden.to_str().unwrap())
        };
        let given: Vec<String> = case["args"].as_array().unwrap().iter().map(of_folder).collect();
        let mut arguments = vec!["foveate", input.to_str().unwrap(), output, "--format", "json"];
        arguments.extend(given.iter().map(String::as_str));
        let record = folder.run(&arguments).ok().json();
        let frames = case["frames"].as_array().unwrap();
        assert_eq!(record["frames"].as_array().unwrap().len(), frames.len(), "{name}");
        for (wanted, found) in frames.iter().zip(record["frames"].as_array().unwrap()) {
            let expected = golden.join(wanted["expected"].as_str().unwrap());
            let file = if is_folder {
                folder.path(output).join(expected.file_name().unwrap())
            } else {
                folder.path(output)
            };
            let (shown, expected) = (read(&file), read(&expected));
            let far = far(&shown, &expected, tolerance["codes"].as_u64().unwrap() as u8);
            let pixels = (shown.width() * shown.height()) as f64;
            let share = 1.0 - far as f64 / pixels;
            assert!(share >= number(tolerance, "share"), "{name}: {share}");
            for (key, wanted) in wanted["counts"].as_object().unwrap() {
                if key == "buffers" {
                    assert_eq!(&found[key], wanted, "{name}");
                    continue;
                }
                let (relative, absolute) = match key.as_str() {
                    "samples_on_screen" => (number(tolerance, "on_screen_relative"), 1.0),
                    _ => (number(tolerance, "samples_relative"), 1e-6),
                };
                let wanted = wanted.as_f64().unwrap();
                let off = (number(found, key) - wanted).abs();
                assert!(off <= relative * wanted + absolute, "{name}: {key} {}", found[key]);
            }
        }
    }
}
