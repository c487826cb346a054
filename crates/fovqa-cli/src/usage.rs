//! Reads the command line, and shows help and errors of it at the width of the terminal.

use std::ffi::OsString;
use std::io::Write;

use clap::{Command, CommandFactory, FromArgMatches};
use fovqa_report::wrapped;

use crate::args::Cli;
use crate::exit::Exit;
use crate::{output, width};

/// The longest line of help, in columns.
const LONGEST: usize = 99;

/// Parses arguments, of which the first is the name of the program.
pub(crate) fn parse(arguments: Vec<OsString>) -> Result<Cli, clap::Error> {
    let mut command = command();
    let mut matches = command.try_get_matches_from_mut(arguments)?;
    Cli::from_arg_matches_mut(&mut matches).map_err(|error| error.format(&mut command))
}

/// The command, whose help has the width of the terminal.
fn command() -> Command {
    let columns = width::of_stdout().filter(|columns| *columns < LONGEST);
    with_flowing_text(Cli::command().term_width(columns.unwrap_or(LONGEST)))
}

/// The command and its subcommands with examples whose paragraphs have no line ends, so that they can
/// be wrapped.
fn with_flowing_text(command: Command) -> Command {
    let text = command.get_after_help().map(|text| flowing(&text.to_string()));
    let command = match text {
        Some(text) => command.after_help(text),
        None => command,
    };
    let names: Vec<String> =
        command.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    names.iter().fold(command, |command, name| command.mut_subcommand(name, with_flowing_text))
}

/// The text with the lines of each paragraph joined. Lines that are indented stay.
fn flowing(text: &str) -> String {
    let is_of_paragraph = |line: &str| !line.is_empty() && !line.starts_with(' ');
    let mut joined = String::new();
    let mut was_of_paragraph = false;
    for (nth, line) in text.lines().enumerate() {
        let is_of_paragraph = is_of_paragraph(line);
        let joint = if was_of_paragraph && is_of_paragraph { " " } else { "\n" };
        joined.push_str(if nth == 0 { "" } else { joint });
        joined.push_str(line);
        was_of_paragraph = is_of_paragraph;
    }
    joined
}

/// Prints the output of clap: help and version on stdout, errors on stderr.
pub(crate) fn show(error: &clap::Error) -> Exit {
    if !error.use_stderr() {
        return output::outcome(error.print());
    }
    let text = error.render().ansi().to_string();
    let text = width::of_stderr().map_or(text.clone(), |columns| wrapped(&text, columns));
    // If stderr is closed, nothing more can be done.
    let _ = anstream::stderr().lock().write_all(text.as_bytes());
    Exit::Usage
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paragraphs_flow_and_examples_stay() {
        let text = "Rules are in\nthe file:\n\n  [[gate]]\n  a = 1\n\nExamples:\n  fovqa gate\nEnd";
        let flow = "Rules are in the file:\n\n  [[gate]]\n  a = 1\n\nExamples:\n  fovqa gate\nEnd";
        assert_eq!(flowing(text), flow);
    }

    #[test]
    fn the_command_line_is_declared_without_mistakes() {
        command().debug_assert();
    }
}
