//! What to say of a name that is not there.

use fovqa_config::nearest;

/// The nearest name there is, and all of them.
pub(crate) fn no_such(kind: &str, name: &str, known: &[String]) -> String {
    let guess = nearest(name, known.iter().map(String::as_str));
    let guess = guess.map(|near| format!(" (did you mean {near}?)")).unwrap_or_default();
    format!("there is no such {kind}{guess}; the {kind}s are {}", known.join(", "))
}
