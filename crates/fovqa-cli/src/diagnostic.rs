//! Messages on stderr: what, where, and how to mend it. In colour on a terminal that shows it.

use std::io::Write;

use anstyle::{AnsiColor, Style};

/// An error, with a line on how to mend it unless that is empty.
pub(crate) fn error(message: &str, help: &str) {
    say("error", AnsiColor::Red, message, help);
}

/// A warning.
pub(crate) fn warning(message: &str) {
    say("warning", AnsiColor::Yellow, message, "");
}

/// A remark.
pub(crate) fn note(message: &str) {
    say("note", AnsiColor::Cyan, message, "");
}

fn say(kind: &str, colour: AnsiColor, message: &str, help: &str) {
    let style = Style::new().bold().fg_color(Some(colour.into()));
    let bold = Style::new().bold();
    let mut stderr = anstream::stderr().lock();
    // A closed stderr must not change how the run ends.
    let _ = writeln!(stderr, "{style}{kind}:{style:#} {message}");
    if !help.is_empty() {
        let _ = writeln!(stderr, "  {bold}help:{bold:#} {help}");
    }
}
