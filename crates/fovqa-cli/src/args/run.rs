//! `fovqa run`, `fovqa check`, `fovqa report`, `fovqa merge`.

use std::path::PathBuf;

use clap::Args;
use fovqa_engine::Shard;
use fovqa_io::sequence::FrameRange;

use super::lock::LockArgs;

pub(crate) const EXAMPLES: &str = "\
The experiment file names scenes, methods and metrics; docs/experiments.md shows every key, and
`fovqa schema` prints its JSON Schema. The smallest one:

  name = \"first\"
  [view]
  fov_vertical_deg = 100
  [[scene]]
  name = \"bistro\"
  reference = \"renders/bistro/gt.%04d.exr\"
  [[method]]
  name = \"RMFR\"
  test = \"renders/{scene}/rmfr.%04d.exr\"

Results: results.csv (every value), summary.json, run.json, table.md, plots/, index.html.

A run that was killed goes on with --resume, and several machines share one with --shard:

  fovqa run first.toml --shard 1/2 --output one     # here
  fovqa run first.toml --shard 2/2 --output two     # there
  fovqa merge one two --output reports/first

Exit codes: 0 done; 2 the experiment file is wrong; 3 an input is missing, unreadable or does not
fit, or the output cannot be written (what fits is scored all the same); 70 a bug in fovqa; 130
interrupted.";

#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    /// The experiment file
    pub(crate) experiment: PathBuf,
    /// Folder for the results [default: reports/NAME, NAME being the experiment's, or
    /// reports/NAME-shard-I-of-N]
    #[arg(long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Go on with a run that was broken off: what is finished in the folder is not scored again. What has
    /// changed since (experiment, options, inputs) is said, and all is scored then; frames that could not
    /// be scored are tried again
    #[arg(long)]
    pub(crate) resume: bool,
    /// Score the I-th of N shares of all frames alone; `fovqa merge` puts them together
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Only these of each scene's frames, from A up to, but without, B
    #[arg(long, allow_hyphen_values = true, value_name = "A..B:STEP")]
    pub(crate) frames: Option<FrameRange>,
    /// Write the maps of each frame into a folder, SCENE/METHOD in it, one for each metric that has one
    /// (`fovqa list metrics`): the values (OpenEXR), and a picture in colours (PNG)
    #[arg(long, value_name = "DIR")]
    pub(crate) maps: Option<PathBuf>,
    /// Threads to score with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    /// The experiment file, or a file of curves
    pub(crate) experiment: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// Folder with the results of a run, or with several such folders: a page over all of them
    pub(crate) results: PathBuf,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}

pub(crate) const MERGE_EXAMPLES: &str = "\
  fovqa merge shards/* --output reports/first

All shards of one run have to be there, each once and finished, of the same experiment, version, frames
and files. What comes out is to the last byte what `fovqa run` without --shard writes. Neither the
experiment file nor the frames are needed.

Exit codes: 0 done; 2 the command line is wrong; 3 shards are missing or do not belong together, frames
could not be scored, or the output cannot be written.";

#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// Folders that `fovqa run --shard` wrote to
    #[arg(required = true, value_name = "DIR")]
    pub(crate) shards: Vec<PathBuf>,
    /// Folder for the results
    #[arg(long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}
