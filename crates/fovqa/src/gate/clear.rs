//! Removes the verdict of an earlier gate and its pictures.

use std::fs;
use std::path::{Component, Path};

use fovqa_results::{GATE, kept_verdict, take_away, verdict_file};

/// Removes the verdict in a results folder and the pictures that it names. What somebody else put between
/// them stays.
pub(crate) fn clear_gate(results: &Path) {
    let verdict = kept_verdict(results).ok().flatten();
    let losses = verdict.iter().flat_map(|verdict| &verdict.rules);
    let losses = losses.flat_map(|rule| &rule.checks).flat_map(|check| &check.losses);
    for picture in losses.flat_map(|loss| &loss.pictures) {
        let path = Path::new(&picture.path);
        let is_inside = path.starts_with(GATE)
            && path.components().all(|part| matches!(part, Component::Normal(_)))
            && path.extension().is_some_and(|extension| extension == "png");
        if is_inside {
            // What cannot be removed is replaced, or is not named and does no harm.
            let _ = take_away(&results.join(path));
            remove_empty(results, path);
        }
    }
    let _ = take_away(&verdict_file(results));
    let _ = fs::remove_dir(results.join(GATE));
}

/// Removes the folders around a removed file that are empty now.
fn remove_empty(results: &Path, path: &Path) {
    for folder in path.ancestors().skip(1).filter(|folder| !folder.as_os_str().is_empty()) {
        // Only an empty folder can be removed this way.
        if fs::remove_dir(results.join(folder)).is_err() {
            return;
        }
    }
}
