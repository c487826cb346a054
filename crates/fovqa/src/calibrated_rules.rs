//! The part of an experiment file between two marker lines, where a calibration writes its rules.

use std::ops::Range;
use std::path::Path;

use fovqa_config::parse_experiment;
use fovqa_plan::{Experiment, GateRule};
use fovqa_results::{Calibration, replaces, write_output};

use crate::error::Error;

const BEGIN: &str = "# fovqa gate --calibrate: begin";
const END: &str = "# fovqa gate --calibrate: end";

/// The part of a text between the two marker lines.
#[derive(Debug, Clone, PartialEq)]
struct Marked {
    /// The bytes between the marker lines.
    bytes: Range<usize>,
    /// The numbers of the lines between the marker lines, counted from 1.
    lines: Range<usize>,
}

/// Finds the marked part. A marker that is missing or appears twice is an error: the number of its
/// line, and what is wrong.
fn marked(text: &str) -> Result<Option<Marked>, (usize, String)> {
    let (mut begin, mut found) = (None, None);
    let mut at = 0;
    for (index, line) in text.split_inclusive('\n').enumerate() {
        let number = index + 1;
        let (start, end) = (at, at + line.len());
        at = end;
        // A byte order mark may precede the first line.
        match line.trim_start_matches('\u{feff}').trim() {
            BEGIN if begin.is_some() || found.is_some() => {
                return Err((number, format!("the line \"{BEGIN}\" appears twice")));
            }
            BEGIN => begin = Some((end, number + 1)),
            END => match begin.take() {
                Some((from, first)) => {
                    found = Some(Marked { bytes: from..start, lines: first..number });
                }
                None => {
                    return Err((number, format!("there is no line \"{BEGIN}\" before this one")));
                }
            },
            _ => {}
        }
    }
    match begin {
        Some((_, first)) => Err((first - 1, format!("there is no line \"{END}\" after this one"))),
        None => Ok(found),
    }
}

/// The lines of the experiment file between the markers, counted from 1; `None` if it has no
/// markers.
///
/// # Errors
/// If a marker is missing or appears twice.
pub(crate) fn marked_rules(experiment: &Experiment) -> Result<Option<Range<usize>>, Error> {
    let found = marked(&experiment.text).map_err(|(line, why)| {
        let message = format!("{}:{line}: {why}", experiment.path.display());
        let help = "correct the marker lines, or remove both and the rules between them";
        Error::usage(message, help)
    })?;
    Ok(found.map(|marked| marked.lines))
}

/// The text with other rules between its markers. Without markers, they are added at its end. All
/// other bytes stay.
fn with_rules(text: &str, marked: Option<&Marked>, rules: &str) -> String {
    let before = text.split_once('\n').map_or("", |(first, _)| first);
    let newline = if before.ends_with('\r') { "\r\n" } else { "\n" };
    let rules = rules.replace('\n', newline);
    if let Some(Marked { bytes, .. }) = marked {
        return format!("{}{rules}{}", &text[..bytes.start], &text[bytes.end..]);
    }
    let end = if text.is_empty() || text.ends_with('\n') { "" } else { newline };
    format!("{text}{end}{newline}{BEGIN}{newline}{rules}{END}{newline}")
}

/// Writes proposed limits into the file of the experiment, between the lines `# fovqa gate --calibrate:
/// begin` and `# fovqa gate --calibrate: end`. Rules that an earlier calibration wrote there are
/// replaced. If there are no such lines, they are added at the end. All other bytes of the file stay.
///
/// # Errors
/// If a marker line is missing or appears twice, if the file has changed since the experiment was read,
/// if it would no longer be correct, or if it cannot be written.
pub fn write_limits(experiment: &Experiment, calibration: &Calibration) -> Result<(), Error> {
    let path = &experiment.path;
    let lines = marked_rules(experiment)?;
    unchanged(experiment)?;
    let marked = marked(&experiment.text).ok().flatten();
    let text = with_rules(&experiment.text, marked.as_ref(), &calibration.toml());
    let by_hand = "print the limits without --write, and add them by hand";
    let new = parse_experiment(path, text.clone()).map_err(|error| {
        let message = format!("{}: the limits do not fit in this file: {error}", path.display());
        Error::usage(message, by_hand)
    })?;
    if outside(&new.gates, marked_rules(&new)?.as_ref())
        != outside(&experiment.gates, lines.as_ref())
    {
        let message =
            format!("{}: the limits would change other rules of this file", path.display());
        return Err(Error::usage(message, by_hand));
    }
    write_output(path, text.as_bytes())
        .map_err(|error| Error::input(error.to_string(), "check the permissions of the file"))
}

/// The rules that are not between the markers. Their lines may differ.
fn outside(rules: &[GateRule], lines: Option<&Range<usize>>) -> Vec<GateRule> {
    let own = rules.iter().filter(|rule| lines.is_none_or(|lines| !lines.contains(&rule.line)));
    own.map(|rule| GateRule { line: 0, ..rule.clone() }).collect()
}

/// Checks that the file still has the text that was read.
fn unchanged(experiment: &Experiment) -> Result<(), Error> {
    let path: &Path = &experiment.path;
    let now = replaces(path).then(|| std::fs::read(path).ok()).flatten();
    if now.is_some_and(|now| now == experiment.text.as_bytes()) {
        return Ok(());
    }
    let message = format!("{}: it is not a file, or it has changed meanwhile", path.display());
    Err(Error::input(message, "run the command again"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_added_and_later_replaced() {
        let first = with_rules("name = \"e\"", None, "a\n");
        assert_eq!(first, format!("name = \"e\"\n\n{BEGIN}\na\n{END}\n"));
        let moved = format!("{first}# behind\n");
        let found = marked(&moved).unwrap().unwrap();
        assert_eq!(found.lines, 4..5);
        let second = with_rules(&moved, Some(&found), "b\nc\n");
        assert_eq!(second, format!("name = \"e\"\n\n{BEGIN}\nb\nc\n{END}\n# behind\n"));
    }

    #[test]
    fn line_ends_stay() {
        let text = with_rules("a\r\nb\n", None, "c\n");
        assert_eq!(text, format!("a\r\nb\n\r\n{BEGIN}\r\nc\r\n{END}\r\n"));
        let found = marked(&text).unwrap();
        assert_eq!(with_rules(&text, found.as_ref(), "c\n"), text);
        let without_end = format!("{BEGIN}\nx\n  {END}");
        let found = marked(&without_end).unwrap();
        assert_eq!(with_rules(&without_end, found.as_ref(), "y\n"), format!("{BEGIN}\ny\n  {END}"));
    }

    #[test]
    fn markers_come_in_one_pair() {
        for (text, line, words) in [
            (format!("a\n{BEGIN}\nb"), 2, "no line \"# fovqa gate --calibrate: end\""),
            (format!("{END}\n"), 1, "no line \"# fovqa gate --calibrate: begin\""),
            (format!("{BEGIN}\n{BEGIN}\n{END}\n"), 2, "twice"),
            (format!("{BEGIN}\n{END}\n{BEGIN}\n{END}\n"), 3, "twice"),
            (format!("{BEGIN}\n{END}\n{END}\n"), 3, "no line"),
        ] {
            let (at, why) = marked(&text).unwrap_err();
            assert!(at == line && why.contains(words), "{text}: {at} {why}");
        }
        assert_eq!(marked("# fovqa gate --calibrate: begin of what\n"), Ok(None));
    }
}
