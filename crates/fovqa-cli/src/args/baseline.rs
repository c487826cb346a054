//! `fovqa baseline`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Subcommand};
use fovqa::Frames;

pub(crate) const EXAMPLES: &str = "\
A baseline is a small JSON file with the values of a run, meant to be kept in git:

  fovqa run nightly.toml
  fovqa baseline save reports/nightly nightly.baseline.json --frames
  fovqa gate nightly.toml --baseline nightly.baseline.json
  fovqa baseline accept reports/nightly nightly.baseline.json --scene bistro
  fovqa baseline save runs/1 nightly.baseline.json --repeats runs/2 runs/3 runs/4";

#[derive(Debug, Subcommand)]
pub(crate) enum BaselineCommand {
    /// Save the results of a run as a baseline.
    Save(SaveArgs),
    /// Print the values of a baseline.
    Show(ShowArgs),
    /// Show how a run differs from a baseline, and update the baseline with its values.
    Accept(AcceptArgs),
}

#[derive(Debug, Args)]
pub(crate) struct SaveArgs {
    /// Folder with the results of a run
    pub(crate) results: PathBuf,
    /// The baseline file to write
    pub(crate) baseline: PathBuf,
    /// Further runs of the same build, for rules with alpha
    #[arg(long, value_name = "RESULTS_DIR", num_args = 1..)]
    pub(crate) repeats: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) frames: FramesArg,
}

#[derive(Debug, Args)]
pub(crate) struct FramesArg {
    /// Also keep reduced pictures and maps of all frames, in a folder beside the baseline: a gate that
    /// fails then shows what has changed. They are read again, with the experiment file EXPERIMENT
    /// [default: looked for beside the baseline, and near the working directory and the results]
    #[arg(long, value_name = "EXPERIMENT", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    frames: Option<OsString>,
}

impl FramesArg {
    pub(crate) fn frames(&self) -> Frames {
        match &self.frames {
            None => Frames::None,
            Some(file) => {
                Frames::Kept(Some(file).filter(|file| !file.is_empty()).map(PathBuf::from))
            }
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct ShowArgs {
    /// The baseline file
    pub(crate) baseline: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct AcceptArgs {
    /// Folder with the results of a run
    pub(crate) results: PathBuf,
    /// The baseline file to update
    pub(crate) baseline: PathBuf,
    /// Only the values of this scene; may be given several times [default: all]
    #[arg(long = "scene", value_name = "NAME", conflicts_with = "frames")]
    pub(crate) scenes: Vec<String>,
    /// Further runs of the same build, for rules with alpha
    #[arg(long, value_name = "RESULTS_DIR", num_args = 1..)]
    pub(crate) repeats: Vec<PathBuf>,
    /// Only show what differs
    #[arg(long)]
    pub(crate) dry_run: bool,
    #[command(flatten)]
    pub(crate) frames: FramesArg,
}
