//! `fovqa limit`.

use std::path::PathBuf;

use clap::Args;
use fovqa::LimitOptions;
use fovqa_io::sequence::FrameRange;

use super::lock::LockArgs;

pub(crate) const EXAMPLES: &str = "\
The [[gate]] rules of the experiment say what must hold:

  [[method]]
  name = \"RMFR\"
  emulate = { model = \"rmfr\" }
  [[gate]]
  metric = \"fpsnr\"
  at_least = 30

Examples:
  fovqa limit headset.toml                                # the smallest budget of each method
  fovqa limit headset.toml --method RMFR --vary sigma --from 1 --to 8   # the largest σ

Results: limits.json, limits.csv (every value measured), table-limits.md, plots/, index.html.

Exit codes: 0 limits were found; 2 the command line or the experiment is wrong, or no rule has a limit in
the range; 3 an input is missing or unreadable, or the output cannot be written.";

#[derive(Debug, Args)]
pub(crate) struct LimitArgs {
    /// The experiment file: emulated methods, and [[gate]] rules with at_least or at_most
    pub(crate) experiment: PathBuf,
    /// What is varied: budget, or a number among the parameters of the methods
    #[arg(long, value_name = "KEY", default_value = LimitOptions::BUDGET)]
    pub(crate) vary: String,
    /// The lowest value [default for budgets: 0.01, or the lowest that the method can have]
    #[arg(long, value_name = "VALUE")]
    pub(crate) from: Option<f64>,
    /// The highest value [default for budgets: 1, or the highest that the method can have]
    #[arg(long, value_name = "VALUE")]
    pub(crate) to: Option<f64>,
    /// Number of values that are measured before the search, 2 to 1000: they show whether the metric is
    /// monotone
    #[arg(long, value_name = "N", default_value_t = LimitOptions::STEPS as u64, value_parser = clap::value_parser!(u64).range(2..=1000))]
    pub(crate) steps: u64,
    /// How exactly limits are found, as a share of them
    #[arg(long, value_name = "SHARE", default_value_t = LimitOptions::TOLERANCE)]
    pub(crate) tolerance: f64,
    /// Only this method; may be repeated [default: all emulated methods that have the key]
    #[arg(long = "method", value_name = "NAME")]
    pub(crate) methods: Vec<String>,
    /// Folder for the results [default: reports/NAME-limit, with the experiment's name]
    #[arg(long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Score only these frames of each scene: from A up to, but not including, B
    #[arg(long, allow_hyphen_values = true, value_name = "A..B:STEP")]
    pub(crate) frames: Option<FrameRange>,
    /// Threads to score with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}
