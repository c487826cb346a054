//! The message for an unknown name.

use fovqa_config::nearest;

/// Names the most similar known name, and all known names.
pub(crate) fn no_such(kind: &str, name: &str, known: &[String]) -> String {
    let guess = nearest(name, known.iter().map(String::as_str));
    let guess = guess.map(|near| format!(" (did you mean {near}?)")).unwrap_or_default();
    format!("there is no such {kind}{guess}; the {kind}s are {}", known.join(", "))
}
