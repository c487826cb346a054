//! `fovqa study plan`.

use std::path::PathBuf;

use clap::{Args, Subcommand};
use fovqa_params::Words;
use fovqa_results::RESULTS_CSV;
use fovqa_study::Request;
use fovqa_study::options::Alternative;
use fovqa_study::plan::{PairsOptions, PredictedOptions, StaircaseOptions};

use super::options::{not_negative, rate, share};
use super::{SettingsArgs, ShapeArgs, ThresholdArgs};
use crate::args::values::{finite, positive, words};

pub(super) const EXAMPLES: &str = "\
Example:
  fovqa study plan pairs --share 0.65 --power 0.9 --width 0.2
  fovqa study plan pairs --results reports/demo --methods A,B";

const STAIRCASE_EXAMPLES: &str = "\
Example:
  fovqa study plan staircase --participants 12 --trials 80 --threshold 1.3 --width 1.2 \\
    --start 4 --steps 0.5,0.25,0.125 --between-sd 0.2";

/// In two lines, since it is longer than one.
const STAIRCASE_USAGE: &str = "\
fovqa study plan staircase --participants <COUNT> --trials <COUNT> --threshold <LEVEL>
         --width <LEVELS> --start <LEVEL> --steps <LEVELS,…> [OPTIONS]";

#[derive(Debug, Subcommand)]
pub(crate) enum PlanCommand {
    /// The trials that a binomial test of pairwise comparisons needs.
    #[command(after_help = EXAMPLES)]
    Pairs(Box<PlanPairsArgs>),
    /// Simulated staircases: how precise the threshold of a study will be.
    #[command(after_help = STAIRCASE_EXAMPLES, override_usage = STAIRCASE_USAGE)]
    Staircase(Box<PlanStaircaseArgs>),
}

#[derive(Debug, Args)]
pub(crate) struct PlanPairsArgs {
    /// The true share of votes
    #[arg(long, value_name = "SHARE", value_parser = share, required_unless_present = "results", conflicts_with = "results")]
    share: Option<f64>,
    /// Predict the share of each pair of methods from the FovVideoVDP scores of a run (1 JOD = 75 %)
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Only these methods of the run
    #[arg(
        long,
        value_name = "METHOD,…",
        value_delimiter = ',',
        requires = "results",
        conflicts_with = "share"
    )]
    methods: Vec<String>,
    /// Only this scene of the run [default: the mean over all scenes]
    #[arg(long, value_name = "SCENE", requires = "results", conflicts_with = "share")]
    scene: Option<String>,
    /// Level of significance
    #[arg(long, value_name = "SHARE", default_value = "0.05", value_parser = share)]
    alpha: f64,
    /// Power that the study must have
    #[arg(long, value_name = "SHARE", default_value = "0.8", value_parser = share)]
    power: f64,
    /// What the test looks for
    #[arg(long, value_name = "SIDE", default_value = Alternative::default().word(), value_parser = words::<Alternative>())]
    alternative: Alternative,
    /// Also report the power with this number of trials
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    trials: Option<u32>,
    /// Also report the trials for an interval of the share that is no wider
    #[arg(long, value_name = "SHARE", value_parser = share)]
    width: Option<f64>,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

#[derive(Debug, Args)]
pub(crate) struct PlanStaircaseArgs {
    /// Participants of a study
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    participants: u32,
    /// Trials of a participant
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Mean of the true thresholds
    #[arg(long, value_name = "LEVEL", value_parser = finite, allow_negative_numbers = true)]
    threshold: f64,
    /// Width of the true psychometric functions
    #[arg(long, value_name = "LEVELS", value_parser = positive)]
    width: f64,
    /// True lapse rate
    #[arg(long, value_name = "RATE", default_value = "0", value_parser = rate)]
    lapse: f64,
    /// Standard deviation of the true thresholds between participants
    #[arg(long, value_name = "LEVELS", default_value = "0", value_parser = not_negative)]
    between_sd: f64,
    #[command(flatten)]
    shape: ShapeArgs,
    /// First level
    #[arg(long, value_name = "LEVEL", value_parser = finite, allow_negative_numbers = true)]
    start: f64,
    /// Sizes of steps: the first until the first reversal, the next until the second, and so on
    #[arg(long, value_name = "LEVELS,…", required = true, value_delimiter = ',', value_parser = positive)]
    steps: Vec<f64>,
    /// Lowest level [default: none]
    #[arg(long, value_name = "LEVEL", value_parser = finite, allow_negative_numbers = true)]
    lowest: Option<f64>,
    /// Highest level [default: none]
    #[arg(long, value_name = "LEVEL", value_parser = finite, allow_negative_numbers = true)]
    highest: Option<f64>,
    /// Correct answers in a row before a harder level
    #[arg(long, value_name = "COUNT", default_value = "2", value_parser = clap::value_parser!(u32).range(1..=100))]
    down: u32,
    /// Simulated studies
    #[arg(long, value_name = "COUNT", default_value = "1000", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    studies: u32,
    #[command(flatten)]
    reversals: ThresholdArgs,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl PlanPairsArgs {
    /// The plan of one pair, or of each pair of a run.
    pub(super) fn request(&self) -> Request {
        let pair = self.options();
        if self.results.is_none() {
            return Request::PlanPairs(pair);
        }
        let (methods, scene) = (self.methods.clone(), self.scene.clone());
        Request::PlanPredicted(PredictedOptions { pair, methods, scene })
    }

    /// The scores of the run.
    pub(super) fn scores(&self) -> Option<PathBuf> {
        self.results.as_ref().map(|folder| folder.join(RESULTS_CSV))
    }

    fn options(&self) -> PairsOptions {
        PairsOptions {
            share: self.share.unwrap_or(0.5),
            alpha: self.alpha,
            power: self.power,
            alternative: self.alternative,
            trials: self.trials.map(u64::from),
            width: self.width,
        }
    }
}

impl PlanStaircaseArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> StaircaseOptions {
        StaircaseOptions {
            participants: self.participants as usize,
            trials: self.trials as usize,
            threshold: self.threshold,
            width: self.width,
            lapse: self.lapse,
            between_sd: self.between_sd,
            model: self.shape.model(),
            start: self.start,
            steps: self.steps.clone(),
            lowest: self.lowest,
            highest: self.highest,
            down: self.down,
            studies: self.studies as usize,
            reversals: self.reversals.options(),
        }
    }
}
