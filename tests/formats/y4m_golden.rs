//! Video as YUV4MPEG2, compared with an independent program.

use std::fs;
use std::path::PathBuf;

use fovqa_io::{SourceOptions, open_source};
use serde_json::{Value, json};

use super::y4m::psnrs;
use crate::fovqa::{Run, command, root};

/// PSNR, against double precision.
const PSNR_DB: f64 = 2e-5;

/// R'G'B', against double precision.
const RGB: f64 = 5e-7;

/// Cases, as `tests/golden/y4m/make_golden.py` wrote them.
fn golden() -> Vec<Value> {
    let text = fs::read_to_string(root().join("tests/golden/y4m/golden.json")).unwrap();
    let golden: Value = serde_json::from_str(&text).unwrap();
    golden["cases"].as_array().unwrap().clone()
}

fn text<'a>(case: &'a Value, key: &str) -> &'a str {
    case[key].as_str().unwrap()
}

fn golden_file(case: &Value, key: &str) -> PathBuf {
    root().join("tests/golden/y4m").join(text(case, key))
}

#[test]
fn scores_are_those_of_an_independent_program() {
    let cases = golden();
    assert!(cases.len() > 90);
    for case in &cases {
        let [reference, test] =
            ["reference", "test"].map(|key| golden_file(case, key).display().to_string());
        let (range, matrix) = (text(case, "range"), text(case, "matrix"));
        let settings = ["--range", range, "--matrix", matrix, "--metrics", "psnr"];
        let arguments = [&["score", &reference, &test, "--format", "json"], &settings[..]].concat();
        let json = Run::from(command(&arguments).output().unwrap()).ok().json();
        let expected = case["psnr"].as_array().unwrap();
        let found = psnrs(&json);
        assert_eq!(found.len(), expected.len(), "{}", case["name"]);
        for (found, expected) in found.iter().zip(expected) {
            let near = (found - expected.as_f64().unwrap()).abs() < PSNR_DB;
            assert!(near, "{}: {found}, not {expected}", case["name"]);
        }
    }
}

fn options(case: &Value) -> SourceOptions {
    let mut formats = json!({});
    for key in ["range", "matrix"] {
        if case[key] != "auto" {
            formats[key] = case[key].clone();
        }
    }
    let mut options = SourceOptions::default();
    options.read.formats = serde_json::from_value(formats).unwrap();
    options
}

#[test]
fn pixels_are_those_of_an_independent_program() {
    let mut compared = 0;
    for case in golden() {
        let source = open_source(&golden_file(&case, "test"), options(&case)).unwrap();
        for pixel in case["pixels"].as_array().unwrap() {
            let place = |key: &str| pixel[key].as_u64().unwrap() as usize;
            let (x, y) = (place("x"), place("y"));
            let picture = source.read(place("frame"), false).unwrap().frame;
            for (channel, value) in pixel["rgb"].as_array().unwrap().iter().enumerate() {
                let channel = channel.min(picture.channels().count() - 1);
                let found = f64::from(picture.sample(channel, x, y));
                let near = (found - value.as_f64().unwrap()).abs() < RGB;
                assert!(near, "{} at ({x}, {y}): {found}, not {value}", case["name"]);
                compared += 1;
            }
        }
    }
    assert!(compared > 1000);
}
