//! Experiments with rules in the tests, and what came of them.

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::{Folder, Run};

/// A sequence whose second frame is the worst, and whose fourth is the reference.
pub(crate) const NOISE: [f64; 5] = [20.0, 45.0, 30.0, 0.0, 25.0];

pub(crate) const SIZE: (usize, usize) = (64, 48);

/// Writes the frames of a folder of the reference and one of the test.
pub(crate) fn write_frames(folder: &Folder, [gt, test]: [&str; 2], seed: u64, noise: &[f64]) {
    let (width, height) = SIZE;
    for (frame, noise) in noise.iter().enumerate() {
        let reference = codes(width, height, 3, seed + frame as u64);
        folder.png(&format!("{gt}/{frame:04}.png"), width, height, &reference);
        let test_codes = disturbed(&reference, *noise, seed + 7);
        folder.png(&format!("{test}/{frame:04}.png"), width, height, &test_codes);
    }
}

pub(crate) fn sequence() -> Folder {
    let folder = Folder::new();
    write_frames(&folder, ["gt", "test"], 1, &NOISE);
    folder
}

/// One scene of `gt`, one method in `test`, and what stands behind them.
pub(crate) fn experiment(of_view: &str, of_scene: &str, rest: &str) -> String {
    format!(
        "name = \"e\"\n[view]\n{of_view}\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n{of_scene}\n\
         [[method]]\nname = \"A\"\ntest = \"test\"\n{rest}"
    )
}

/// Runs `fovqa gate e.toml …` over an experiment; its exit code and its verdict.
#[track_caller]
pub(crate) fn gate(folder: &Folder, experiment: &str, options: &[&str]) -> (Run, Value) {
    folder.write("e.toml", experiment);
    let run = folder.run(&[&["gate", "e.toml", "--format", "json"], options].concat());
    let Ok(json) = serde_json::from_str(&run.stdout) else {
        panic!("exit {}: {}{}", run.code, run.stdout, run.stderr)
    };
    (run, json)
}

/// The only check of the only rule.
#[track_caller]
pub(crate) fn only(verdict: &Value) -> &Value {
    let rules = verdict["rules"].as_array().unwrap();
    let checks = rules[0]["checks"].as_array().unwrap();
    assert_eq!((rules.len(), checks.len()), (1, 1), "{verdict:#}");
    &checks[0]
}

pub(crate) fn number(value: &Value) -> f64 {
    match value.as_str() {
        Some("inf") => f64::INFINITY,
        Some("-inf") => f64::NEG_INFINITY,
        _ => value.as_f64().unwrap_or(f64::NAN),
    }
}

#[track_caller]
pub(crate) fn near(what: &str, found: &Value, want: f64) {
    let found = number(found);
    let same = found.to_bits() == want.to_bits();
    assert!(same || (found - want).abs() <= 1e-12 * want.abs().max(1.0), "{what}: {found}, {want}");
}

/// Straight between the two values next to the percentile's place, as NumPy has it.
pub(crate) fn percentile(percent: f64, values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = percent / 100.0 * (sorted.len() - 1) as f64;
    let (low, high) = (sorted[at.floor() as usize], sorted[at.ceil() as usize]);
    if at.fract() == 0.0 { low } else { low + (high - low) * at.fract() }
}

pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub(crate) fn smallest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// A rule with the value it has to have and, where it matters, its worst frame.
pub(crate) struct Expected {
    pub(crate) rule: String,
    pub(crate) value: f64,
    pub(crate) worst: Option<(u64, f64)>,
}

/// Gates with all of these rules, each of one comparison, and holds the values against theirs.
#[track_caller]
pub(crate) fn check(folder: &Folder, experiment: &str, rules: &[Expected]) {
    let tables: Vec<String> =
        rules.iter().map(|rule| format!("[[gate]]\n{}\n", rule.rule)).collect();
    let (run, verdict) = gate(folder, &format!("{experiment}\n{}", tables.concat()), &[]);
    assert_eq!(run.code, 0, "{verdict:#}\n{}", run.stderr);
    let found = verdict["rules"].as_array().unwrap();
    assert_eq!(found.len(), rules.len());
    for (found, want) in found.iter().zip(rules) {
        let checks = found["checks"].as_array().unwrap();
        assert_eq!(checks.len(), 1, "{found:#}");
        near(&want.rule, &checks[0]["value"], want.value);
        if let Some((frame, value)) = want.worst {
            assert_eq!(checks[0]["worst_frame"], frame, "{}", want.rule);
            near(&want.rule, &checks[0]["worst_value"], value);
        }
    }
}
