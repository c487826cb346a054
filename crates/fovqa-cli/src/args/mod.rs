//! The command line, as clap sees it.

mod metrics;
mod nearest;
mod score;
mod signal;
mod values;
mod view;

pub(crate) use score::{Format, ScoreArgs};

use clap::{Parser, Subcommand, ValueEnum};

/// Scores foveated renders against ground truth, by eccentricity.
#[derive(Debug, Parser)]
#[command(
    name = "fovqa",
    bin_name = "fovqa",
    version,
    max_term_width = 100,
    subcommand_required = true,
    arg_required_else_help = true
)]
#[command(
    after_help = "Exit codes: 0 done; 2 the command line is wrong; 3 an input is missing, unreadable or does not\n\
fit, or the output cannot be written; 70 a bug in fovqa; 130 interrupted."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Score test frames against reference frames.
    #[command(after_help = score::EXAMPLES)]
    Score(Box<ScoreArgs>),
    /// List what there is: metrics with their parameters, or display presets.
    List {
        /// What to list.
        what: Listed,
    },
    /// Print a completion script for a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
}

/// What can be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Listed {
    /// Metrics, their parameters, defaults, units and sources.
    Metrics,
    /// Display presets.
    Displays,
}
