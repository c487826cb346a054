//! `fovqa gate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fovqa_io::sequence::FrameRange;

use super::lock::LockArgs;

pub(crate) const EXAMPLES: &str = "\
The rules are in the experiment file; docs/experiments.md shows every key:

  [[gate]]
  metric = \"fpsnr\"
  method = \"RMFR\"
  aggregate = \"min\"
  at_least = 28.0
  [[gate]]
  metric = \"ssim\"
  band_deg = [0, 10]
  max_drop = \"2%\"                 # against --baseline

Examples:
  fovqa gate nightly.toml --junit gate.xml --markdown gate.md
  fovqa gate nightly.toml --baseline nightly.baseline.json --annotations github
  fovqa gate reports/nightly --format json
  fovqa gate runs/6 --repeats runs/7 runs/8 --baseline nightly.baseline.json
  fovqa gate nightly.toml --calibrate runs/1 runs/2 runs/3 > limits.toml
  fovqa gate nightly.toml --calibrate runs/* --false-alarms 0.001 --write

Exit codes: 0 every rule holds; 1 a rule fails; 2 the command line, the experiment file or a rule is
wrong; 3 something could not be scored or read, which is never a pass; 70 a bug in fovqa; 130
interrupted.";

/// How the verdict is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum GateFormat {
    /// A table to read.
    Table,
    /// All values, as nested JSON.
    Json,
}

/// For which CI system what does not hold is shown beside its rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Annotations {
    /// Workflow commands, printed after the verdict on stdout.
    Github,
    /// A Code Quality report on stdout; the verdict goes to stderr.
    Gitlab,
}

#[derive(Debug, Args)]
pub(crate) struct GateArgs {
    /// The experiment file, whose frames are then scored, or the folder of a finished run
    pub(crate) target: PathBuf,
    /// Baseline that max_drop and max_rise compare with; of several, the best match counts [default:
    /// those that the experiment names]
    #[arg(long, value_name = "FILE")]
    pub(crate) baseline: Vec<PathBuf>,
    /// Further runs of the same build, for rules with alpha
    #[arg(long, value_name = "RESULTS_DIR", num_args = 1.., conflicts_with = "calibrate")]
    pub(crate) repeats: Vec<PathBuf>,
    /// Write the verdict as JUnit XML, with one test case per check: rule, scene, method and eye
    #[arg(long, value_name = "FILE")]
    pub(crate) junit: Option<PathBuf>,
    /// Write the verdict as Markdown
    #[arg(long, value_name = "FILE")]
    pub(crate) markdown: Option<PathBuf>,
    /// Print annotations for a CI system
    #[arg(long, value_name = "SYSTEM", conflicts_with = "format")]
    pub(crate) annotations: Option<Annotations>,
    /// How the verdict is printed
    #[arg(long, value_name = "FORMAT", default_value = "table")]
    pub(crate) format: GateFormat,
    /// Print limits for the rules as TOML, proposed from the spread of repeated runs of one build
    #[arg(long, value_name = "RESULTS_DIR", num_args = 1.., conflicts_with_all = ["baseline", "junit", "markdown", "annotations", "format", "output", "maps", "threads"])]
    pub(crate) calibrate: Vec<PathBuf>,
    /// With --calibrate: the probability that a new run of the same build fails the gate, all limits
    /// together, above 0 and at most 0.5 [default: 0.01]
    #[arg(long, value_name = "RATE", requires = "calibrate", value_parser = rate)]
    pub(crate) false_alarms: Option<f64>,
    /// With --calibrate: write the limits into the experiment file instead of printing them, and
    /// replace those that were written before
    #[arg(long, requires = "calibrate")]
    pub(crate) write: bool,
    /// Folder for the results of an experiment [default: reports/NAME, with the experiment's
    /// name]
    #[arg(long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Continue an interrupted run, as `fovqa run --resume` does
    #[arg(long)]
    pub(crate) resume: bool,
    /// Score only these frames of each scene: from A up to, but not including, B
    #[arg(long, allow_hyphen_values = true, value_name = "A..B:STEP")]
    pub(crate) frames: Option<FrameRange>,
    /// Write maps of the frames of an experiment to DIR, as `fovqa run --maps` does
    #[arg(long, value_name = "DIR")]
    pub(crate) maps: Option<PathBuf>,
    /// Threads to score with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}

/// A rate of false alarms.
fn rate(text: &str) -> Result<f64, String> {
    let rate: Option<f64> = text.parse().ok();
    rate.filter(|rate| *rate > 0.0 && *rate <= 0.5)
        .ok_or_else(|| "write a number above 0 and at most 0.5".to_owned())
}
