//! Names of scenes and eyes.

use fovqa_plan::{ResolvedEye, ResolvedScene};

/// Maximum number of places that a line names.
const MOST_NAMES: usize = 6;

/// The scene, and its eye if it has two.
pub(super) fn place_name(scene: &ResolvedScene, eye: &ResolvedEye) -> String {
    match eye.eye {
        None => scene.name.clone(),
        Some(eye) => format!("{}, {} eye", scene.name, eye.name()),
    }
}

/// The first names of a list, and how many follow.
pub(super) fn some(names: &[String]) -> String {
    let shown = names[..names.len().min(MOST_NAMES)].join(", ");
    match names.len().saturating_sub(MOST_NAMES) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
