//! Reads an experiment file for a command and reports its errors. Mistakes in the file are shown
//! with their lines.

use std::path::Path;

use fovqa::{Complaint, CurvesFile, Experiment, ExperimentError, Fault, StudyFile};
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode,
};

use crate::exit::Exit;
use crate::{diagnostic, width};
use fovqa::Dialect;

/// Number of mistakes that are shown in full; the others are only counted.
const SHOWN: usize = 20;

/// Maximum number of characters in a line that is shown. In a longer line, the place would be hard
/// to find.
const LONGEST_LINE: usize = 400;

/// Width in columns of a mistake with its lines, on a terminal that is not narrower.
const WIDTH: usize = 100;

/// Reads an experiment. Errors are reported before this returns.
pub(crate) fn read(path: &Path) -> Result<Experiment, Exit> {
    fovqa::read_experiment(path).map_err(|error| failed(&error))
}

/// Reads a curves file. Errors are reported before this returns.
pub(crate) fn read_curves(path: &Path) -> Result<CurvesFile, Exit> {
    fovqa::read_curves(path).map_err(|error| failed(&error))
}

/// Reads a study file. Errors are reported before this returns.
pub(crate) fn read_study(path: &Path) -> Result<StudyFile, Exit> {
    fovqa::read_study(path).map_err(|error| failed(&error))
}

/// Reports an error to a user who writes experiment files.
pub(crate) fn failed(error: &fovqa::Error) -> Exit {
    said(error, Dialect::Experiment)
}

/// Reports an error in the given terms.
pub(crate) fn said(error: &fovqa::Error, dialect: Dialect) -> Exit {
    match error {
        fovqa::Error::Experiment(error) => of_file(error),
        fovqa::Error::Usage(complaints) | fovqa::Error::Input(complaints) => {
            for Complaint { message, help } in complaints {
                diagnostic::error(&dialect.spell(message), &dialect.spell(help));
            }
        }
        other => diagnostic::error(&other.to_string(), ""),
    }
    if error.is_usage() { Exit::Usage } else { Exit::Input }
}

fn of_file(error: &ExperimentError) {
    match error {
        ExperimentError::Unreadable { .. } => {
            diagnostic::error(&error.to_string(), "give a TOML file, in UTF-8");
        }
        ExperimentError::Faults { path, text, faults } => {
            say(&diagnostic::shown(&path.display().to_string()), text, faults);
            if faults.len() > 1 {
                diagnostic::error(&error.to_string(), "");
            }
        }
    }
}

fn say(file: &str, text: &str, faults: &[Fault]) {
    let source = NamedSource::new(file, printable(text));
    let long = text.lines().any(|line| line.len() > LONGEST_LINE);
    for fault in faults.iter().take(SHOWN) {
        let whole = fault.span.is_empty() && fault.span.start == 0;
        if whole || long || !fits(text, fault, width::of_stderr()) {
            // A mistake that concerns the whole file has no position.
            let place = if whole { String::new() } else { format!(":{}", place(text, fault)) };
            let label = if fault.label.is_empty() { "" } else { "; " };
            let message = format!("{file}{place}: {}{label}{}", fault.message, fault.label);
            diagnostic::error(&message, &diagnostic::shown(&fault.help));
        } else {
            diagnostic::block(&rendered(&Shown { fault, source: &source }));
        }
    }
    if faults.len() > SHOWN {
        diagnostic::note(&format!("{} more mistakes are not shown", faults.len() - SHOWN));
    }
}

/// Whether the line of a mistake and its neighbours fit on a terminal. On a narrow one, a wrapped line
/// would separate the mistake from its mark.
fn fits(text: &str, fault: &Fault, width: Option<usize>) -> bool {
    /// Columns before a line: its number and a rule.
    const BEFORE: usize = 8;
    let Some(width) = width.filter(|width| *width < WIDTH) else { return true };
    let number = |at: usize| text.get(..at).unwrap_or(text).matches('\n').count();
    let (first, last) = (number(fault.span.start), number(fault.span.end));
    let shown = text.lines().take(last + 2).skip(first.saturating_sub(1));
    shown.map(|line| line.chars().count()).all(|columns| columns + BEFORE <= width)
}

/// Line and column of a mistake, both counted from 1.
fn place(text: &str, fault: &Fault) -> String {
    let before = text.get(..fault.span.start).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!("{line}:{column}")
}

/// The text with each control character replaced by the same number of bytes. It must not control
/// the terminal, and positions in the text must stay the same.
fn printable(text: &str) -> String {
    let shown = |c: char| match c {
        '\n' | '\t' => c,
        '\r' => ' ',
        c if c.is_control() && c.len_utf8() == 1 => '?',
        c if c.is_control() => '¿',
        c => c,
    };
    text.chars().map(shown).collect()
}

fn rendered(fault: &Shown<'_>) -> String {
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode());
    let handler = match width::of_stderr().filter(|width| *width < WIDTH) {
        Some(width) => handler.with_width(width).with_break_words(false),
        None => handler.with_width(WIDTH),
    };
    // Rendering to a string does not fail. If it did, the message would still be shown.
    if handler.with_context_lines(1).render_report(&mut text, fault).is_err() {
        text = fault.to_string();
    }
    text
}

/// A mistake together with the text that contains it.
#[derive(Debug)]
struct Shown<'a> {
    fault: &'a Fault,
    source: &'a NamedSource<String>,
}

impl std::fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&diagnostic::shown(&self.fault.message))
    }
}

impl std::error::Error for Shown<'_> {}

impl Diagnostic for Shown<'_> {
    fn help<'b>(&'b self) -> Option<Box<dyn std::fmt::Display + 'b>> {
        let help = diagnostic::shown(&self.fault.help);
        (!help.is_empty()).then(|| Box::new(help) as _)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let Fault { span, label, .. } = self.fault;
        let label = (!label.is_empty()).then(|| diagnostic::shown(label));
        Some(Box::new(std::iter::once(LabeledSpan::new(label, span.start, span.len()))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_file_says_does_not_reach_the_terminal_raw() {
        let text = "a = \"\u{1b}[31m\"\r\n\tb\u{9b}c";
        let shown = printable(text);
        assert_eq!(shown, "a = \"?[31m\" \n\tb¿c");
        assert_eq!(shown.len(), text.len());
    }

    #[test]
    fn lines_that_do_not_fit_are_not_shown() {
        let text = format!("short\n{}\nshort\nshort", "x".repeat(50));
        let at = |start| Fault {
            message: String::new(),
            span: start..start + 1,
            label: String::new(),
            help: String::new(),
        };
        let fits = |start: usize, width| fits(&text, &at(start), width);
        assert!(fits(0, Some(58)) && !fits(0, Some(57)), "the next line counts");
        assert!(fits(text.len() - 1, Some(57)), "others do not");
        assert!(fits(0, None) && fits(0, Some(100)));
    }

    #[test]
    fn places_count_from_one() {
        let fault = |start| Fault {
            message: String::new(),
            span: start..start + 1,
            label: String::new(),
            help: String::new(),
        };
        assert_eq!(place("äb\ncd", &fault(2)), "1:2");
        assert_eq!(place("äb\ncd", &fault(5)), "2:2");
    }
}
