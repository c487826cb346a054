//! Messages on stderr. They say what is wrong, where, and how to correct it. They are coloured if
//! the terminal supports it.

use std::io::Write;

use anstyle::{AnsiColor, Style};
use fovqa_report::{Text, wrapped_line};

use crate::width;

/// Prints an error and, unless `help` is empty, a line on how to correct it.
pub(crate) fn error(message: &str, help: &str) {
    say("error", AnsiColor::Red, message, help);
}

/// Prints a warning.
pub(crate) fn warning(message: &str) {
    say("warning", AnsiColor::Yellow, message, "");
}

/// Prints a note.
pub(crate) fn note(message: &str) {
    say("note", AnsiColor::Cyan, message, "");
}

/// A message that is safe for a terminal. Text from a file (names, cells) must neither control the
/// terminal nor fill it.
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

/// Prints a message whose layout is complete already.
pub(crate) fn block(text: &str) {
    // A closed stderr must not change how the run ends.
    let _ = writeln!(anstream::stderr().lock(), "{}\n", text.trim_end());
}

/// Prints a text. On a terminal, lines and tables are laid out for its width.
pub(crate) fn text(text: &Text) {
    match width::of_stderr() {
        Some(columns) => block(&text.within(columns)),
        None => block(&text.to_string()),
    }
}

fn say(kind: &str, colour: AnsiColor, message: &str, help: &str) {
    let style = Style::new().bold().fg_color(Some(colour.into()));
    let bold = Style::new().bold();
    let message = shown(message);
    let mut stderr = anstream::stderr().lock();
    // A closed stderr must not change how the run ends.
    let _ = writeln!(stderr, "{}", line(&format!("{style}{kind}:{style:#} "), &message));
    if !help.is_empty() {
        let _ = writeln!(stderr, "{}", line(&format!("  {bold}help:{bold:#} "), help));
    }
}

/// A message behind its kind. On a terminal, it is wrapped between words.
fn line(kind: &str, message: &str) -> String {
    match width::of_stderr() {
        Some(columns) => wrapped_line(message, columns, kind),
        None => format!("{kind}{message}"),
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
