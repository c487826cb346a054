//! Names of displays.

use fovqa_vision::{Display, displays, find_display};

use super::no_such::no_such;

/// The display with a given name. The error lists similar names.
pub(super) fn display(name: &str) -> Result<Display, String> {
    find_display(name).cloned().ok_or_else(|| {
        let names: Vec<String> = displays().iter().map(|d| d.name.replace('_', "-")).collect();
        no_such("display", name, &names)
    })
}
