//! `fovqa baseline`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

pub(crate) const EXAMPLES: &str = "\
A baseline is a small JSON file with the values of a run, made for git:

  fovqa run nightly.toml
  fovqa baseline save reports/nightly nightly.baseline.json
  fovqa gate nightly.toml --baseline nightly.baseline.json
  fovqa baseline accept reports/nightly nightly.baseline.json --scene bistro";

#[derive(Debug, Subcommand)]
pub(crate) enum BaselineCommand {
    /// Make a baseline of the results of a run.
    Save(SaveArgs),
    /// Print the values of a baseline.
    Show(ShowArgs),
    /// Show how a run differs from a baseline, and take its values over.
    Accept(AcceptArgs),
}

#[derive(Debug, Args)]
pub(crate) struct SaveArgs {
    /// Folder with the results of a run
    pub(crate) results: PathBuf,
    /// The baseline to make
    pub(crate) baseline: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct ShowArgs {
    /// The baseline
    pub(crate) baseline: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct AcceptArgs {
    /// Folder with the results of a run
    pub(crate) results: PathBuf,
    /// The baseline to renew
    pub(crate) baseline: PathBuf,
    /// Only the values of this scene; may be given several times [default: all]
    #[arg(long = "scene", value_name = "NAME")]
    pub(crate) scenes: Vec<String>,
    /// Only show what differs
    #[arg(long)]
    pub(crate) dry_run: bool,
}
