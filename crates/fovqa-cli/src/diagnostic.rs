//! Messages on stderr: what, where, and how to mend it.

use std::io::Write;

/// An error, with a line on how to mend it unless that is empty.
pub(crate) fn error(message: &str, help: &str) {
    say("error", message, help);
}

/// A warning.
pub(crate) fn warning(message: &str) {
    say("warning", message, "");
}

/// A remark.
pub(crate) fn note(message: &str) {
    say("note", message, "");
}

fn say(kind: &str, message: &str, help: &str) {
    let mut stderr = std::io::stderr().lock();
    // A closed stderr must not change how the run ends.
    let _ = writeln!(stderr, "{kind}: {message}");
    if !help.is_empty() {
        let _ = writeln!(stderr, "  help: {help}");
    }
}
