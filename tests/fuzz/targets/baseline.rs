//! Baselines: read, shown, compared and renewed.

#![no_main]

use std::sync::LazyLock;

use fovqa_fuzz::{abort_on_escaping_panics, with_file};
use fovqa_report::{baseline_table, difference_table};
use fovqa_results::Baseline;
use libfuzzer_sys::fuzz_target;

/// The committed one, which others are compared with.
static KNOWN: LazyLock<Baseline> = LazyLock::new(|| {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../configs/ci/nightly.baseline.json");
    Baseline::read(file.as_ref()).expect("the committed baseline")
});

fuzz_target!(init: abort_on_escaping_panics(), |bytes: &[u8]| {
    let Ok(baseline) = with_file(bytes, Baseline::read) else { return };
    assert!(!baseline_table(&baseline).is_empty());
    let _ = baseline.refuses(&baseline.resolved);
    assert!(baseline.differences(&baseline, &[]).is_empty());
    for (before, after) in [(&*KNOWN, &baseline), (&baseline, &*KNOWN)] {
        let _ = before.refuses(&after.resolved);
        let differences = before.differences(after, &[]);
        assert_eq!(difference_table(&differences).is_empty(), differences.is_empty());
        let _ = before.accepting(after, &["living-room".to_owned()]);
    }
});
