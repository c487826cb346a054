//! The text of an experiment file and of a file of curves. A mistake has to have a place in it.

#![no_main]

use std::path::Path;

use fovqa_config::{ExperimentError, parse_curves, parse_experiment};
use fovqa_fuzz::abort_on_escaping_panics;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: abort_on_escaping_panics(), |text: &str| {
    let path = Path::new("experiments/it.toml");
    says_where(parse_experiment(path, text.to_owned()), text);
    says_where(parse_curves(path, text.to_owned()), text);
});

fn says_where<T>(parsed: Result<T, ExperimentError>, text: &str) {
    let Err(error) = parsed else { return };
    let ExperimentError::Faults { faults, .. } = error else { panic!("no file is read: {error}") };
    assert!(!faults.is_empty(), "a mistake");
    for fault in faults {
        assert!(text.get(fault.span).is_some(), "a place in the text: {}", fault.message);
    }
}
