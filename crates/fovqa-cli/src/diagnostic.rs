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

/// A message as a terminal may show it: what a file put into it (names, cells) must neither steer
/// the terminal nor fill it.
pub(crate) fn shown(message: &str) -> String {
    const LONGEST: usize = 4000;
    let mut shown = String::new();
    for (count, c) in message.chars().enumerate() {
        if count == LONGEST {
            shown.push('…');
            break;
        }
        if c.is_control() { shown.extend(c.escape_default()) } else { shown.push(c) }
    }
    shown
}

/// A message that has been laid out already.
pub(crate) fn block(text: &str) {
    // A closed stderr must not change how the run ends.
    let _ = writeln!(anstream::stderr().lock(), "{}\n", text.trim_end());
}

fn say(kind: &str, colour: AnsiColor, message: &str, help: &str) {
    let style = Style::new().bold().fg_color(Some(colour.into()));
    let bold = Style::new().bold();
    let message = shown(message);
    let mut stderr = anstream::stderr().lock();
    // A closed stderr must not change how the run ends.
    let _ = writeln!(stderr, "{style}{kind}:{style:#} {message}");
    if !help.is_empty() {
        let _ = writeln!(stderr, "  {bold}help:{bold:#} {help}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_files_say_does_not_reach_the_terminal_raw() {
        assert_eq!(shown("a\u{1b}[31mb\nc"), "a\\u{1b}[31mb\\nc");
        assert_eq!(shown("10° – é"), "10° – é");
        assert!(shown(&"x".repeat(1 << 20)).chars().count() < 4002);
    }
}
