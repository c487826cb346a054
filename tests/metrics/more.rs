//! FLIP, HDR-FLIP, FWQI, flicker and spectra through the command: values of independent implementations.

use std::fs;
use std::path::Path;

use fovqa_io::{ReadOptions, read_frame};
use fovqa_testkit::npy::Array;
use serde_json::Value;

use crate::fovqa::{Folder, Run, command, root, shared};

/// The value at a path such as `frames[0].metrics.flip`.
fn at<'a>(json: &'a Value, path: &str) -> &'a Value {
    path.split(['.', '[', ']']).filter(|key| !key.is_empty()).fold(json, |value, key| {
        let found = match key.parse::<usize>() {
            Ok(index) => value.get(index),
            Err(_) => value.get(key),
        };
        found.unwrap_or_else(|| panic!("no {path}"))
    })
}

/// Whether a value is within a tolerance: absolute or, if that is negative, relative.
fn is_near(found: &Value, wanted: &Value, tolerance: f64) -> bool {
    let (Some(found), Some(wanted)) = (found.as_f64(), wanted.as_f64()) else {
        return found == wanted;
    };
    let allowed = if tolerance < 0.0 { -tolerance * wanted.abs() } else { tolerance };
    (found - wanted).abs() <= allowed
}

/// The arguments of a case. A word with @ is a path in the folder.
fn arguments(case: &Value, golden: &Path) -> Vec<String> {
    let in_folder = |path: &str| golden.join(path).display().to_string();
    let file = |key: &str| in_folder(case[key].as_str().unwrap());
    let words = case["args"].as_array().unwrap().iter().map(|word| {
        let word = word.as_str().unwrap();
        word.strip_prefix('@').map_or_else(|| word.to_owned(), in_folder)
    });
    let score = ["score".to_owned(), file("reference"), file("test")];
    score.into_iter().chain(words).chain(["--format", "json"].map(str::to_owned)).collect()
}

fn cases(golden: &Path, kind: &str) -> Vec<Value> {
    let file = fs::read_to_string(golden.join("golden.json")).unwrap();
    let file: Value = serde_json::from_str(&file).unwrap();
    let of_kind = |case: &&Value| case["kind"] == kind;
    file["cases"].as_array().unwrap().iter().filter(of_kind).cloned().collect()
}

/// Runs a case, and holds the result to its values.
fn run(case: &Value, golden: &Path, more: &[&str]) -> Value {
    let words = arguments(case, golden);
    let words: Vec<&str> = words.iter().map(String::as_str).chain(more.iter().copied()).collect();
    let json = Run::from(command(&words).output().unwrap()).ok().json();
    for expected in case["expect"].as_array().unwrap() {
        let (path, wanted) = (expected[0].as_str().unwrap(), &expected[1]);
        let found = at(&json, path);
        let near = is_near(found, wanted, expected[2].as_f64().unwrap());
        assert!(near, "{} {}: {path} {found} for {wanted}", case["kind"], case["id"]);
    }
    json
}

/// Both sets of golden values: the committed one, and the larger one beside the project.
fn golden() -> impl Iterator<Item = std::path::PathBuf> {
    [Some(root().join("tests/golden/more")), shared("golden/more")].into_iter().flatten()
}

fn check(kind: &str) {
    for golden in golden() {
        let cases = cases(&golden, kind);
        assert!(!cases.is_empty(), "{kind} in {}", golden.display());
        for case in cases {
            run(&case, &golden, &[]);
        }
    }
}

/// Holds FLIP's statistics and maps to those of its own program. Single pixels of gray pictures are
/// further off: what differs there is rounding alone.
fn check_flip(kind: &str) {
    let mut maps = 0;
    for golden in golden() {
        for case in cases(&golden, kind) {
            let folder = Folder::new();
            let to = folder.path("maps").display().to_string();
            let json = run(&case, &golden, &["--maps", &to]);
            let metrics = &json["frames"][0]["metrics"];
            for statistic in
                ["weighted_median", "q1", "q3", "min", "max", "start", "stop", "exposures"]
            {
                let wanted = &case[statistic];
                let found = &metrics[format!("{kind}_{statistic}")];
                let near = wanted.is_null() || is_near(found, wanted, 1.5e-3);
                assert!(near, "{kind} {}: {statistic} {found} for {wanted}", case["id"]);
            }
            let files = [("map", kind.to_owned()), ("exposure_map", format!("{kind}_exposure"))];
            for (key, name) in files {
                let Some(wanted) = case[key].as_str() else { continue };
                compare_maps(&golden.join(wanted), &folder.path(&format!("maps/{name}-0000.exr")));
                maps += 1;
            }
        }
    }
    assert!(maps > 0, "no maps of {kind}");
}

fn compare_maps(wanted: &Path, found: &Path) {
    let map = read_frame(found, &ReadOptions::default()).unwrap().frame;
    let array = Array::read(wanted);
    assert_eq!(array.shape[..2], [map.height(), map.width()], "{}", wanted.display());
    let off = array.floats().into_iter().enumerate().filter(|(i, wanted)| {
        (map.sample(0, i % map.width(), i / map.width()) - *wanted).abs() > 2e-4
    });
    let off = off.count();
    assert!(off <= map.width() * map.height() / 1000, "{off} pixels of {}", wanted.display());
}

#[test]
fn flip_is_that_of_its_own_program() {
    check_flip("flip");
}

#[test]
fn hdr_flip_is_that_of_its_own_program() {
    check_flip("hdr_flip");
}

#[test]
fn fwqi_is_that_of_an_independent_program() {
    check("fwqi");
}

#[test]
fn flicker_is_that_of_an_independent_program() {
    check("flicker");
}

#[test]
fn spectra_are_those_of_an_independent_program() {
    check("spectrum");
}
