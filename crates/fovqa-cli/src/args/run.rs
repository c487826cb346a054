//! `fovqa run`, `fovqa check`, `fovqa report`, `fovqa merge`.

use std::path::PathBuf;

use clap::Args;
use fovqa_engine::Shard;
use fovqa_io::sequence::FrameRange;

use super::lock::LockArgs;

pub(crate) const EXAMPLES: &str = "\
The experiment file names scenes, methods and metrics; docs/experiments.md shows every key, and
`fovqa schema` prints its JSON Schema. A minimal one:

  name = \"first\"
  [view]
  fov_vertical_deg = 100
  [[scene]]
  name = \"bistro\"
  reference = \"renders/bistro/gt.%04d.exr\"
  [[method]]
  name = \"RMFR\"
  test = \"renders/{scene}/rmfr.%04d.exr\"

Results: results.csv (every value), summary.json, run.json, table.md, plots/, report.html.

--resume continues an interrupted run, and --shard divides a run between machines:

  fovqa run first.toml --shard 1/2 --output one     # on one machine
  fovqa run first.toml --shard 2/2 --output two     # on another machine
  fovqa merge one two --output reports/first

Exit codes: 0 done; 2 the experiment file is wrong; 3 an input is missing, unreadable or does not
fit, or the output cannot be written (all frames that fit are still scored); 70 a bug in fovqa; 130
interrupted.";

#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    /// The experiment file
    pub(crate) experiment: PathBuf,
    /// Folder for the results [default: reports/NAME, with the experiment's name; for a shard,
    /// reports/NAME-shard-I-of-N]
    #[arg(long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Continue an interrupted run. Finished frames are not scored again; frames that failed are tried
    /// again. If the experiment, the options or an input has changed, fovqa names what changed and
    /// scores everything again
    #[arg(long)]
    pub(crate) resume: bool,
    /// Score only the I-th of N shares of all frames; `fovqa merge` joins them
    #[arg(long, value_name = "I/N")]
    pub(crate) shard: Option<Shard>,
    /// Score only these frames of each scene: from A up to, but not including, B
    #[arg(long, allow_hyphen_values = true, value_name = "A..B:STEP")]
    pub(crate) frames: Option<FrameRange>,
    /// Write maps of each frame to DIR/SCENE/METHOD, as values (OpenEXR) and as a heat map with a
    /// colour bar, bands and gaze (PNG); `fovqa list metrics` shows which metrics have a map
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
    /// The experiment file, or a curve file
    pub(crate) experiment: PathBuf,
    /// Read the first, the middle and the last frame of each scene, and look for mistakes: another
    /// exposure, swapped folders, a wrong gaze, another scene
    #[arg(long)]
    pub(crate) previews: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// Folder with the results of a run, or a folder that contains several of these, for an overview
    /// page
    pub(crate) results: PathBuf,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}

pub(crate) const MERGE_EXAMPLES: &str = "\
  fovqa merge shards/* --output reports/first

Every shard of the run must be given exactly once and be finished. All must have the same experiment,
version, frames and files. The result is the same, to the last byte, as that of `fovqa run` without
--shard. Neither the experiment file nor the frames are needed, except for some pictures of long
sequences (--experiment). docs/cluster.md shows shards in a Slurm array.

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
    /// The experiment file. Its frames are read again for the pictures of report.html that only all
    /// scores together choose, such as those of the worst frame; without it, the page may lack them
    #[arg(long, value_name = "FILE")]
    pub(crate) experiment: Option<PathBuf>,
    /// Also write all values as Parquet, one file per shard, to the folder `values` in that of the
    /// results: polars, pandas and DuckDB read these files as one table
    #[arg(long)]
    pub(crate) values: bool,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}
