//! `fovqa study`.

mod anova;
mod metrics;
mod options;
mod pairs;
mod plan;
mod psychometric;
mod ranks;
mod ratings;
mod staircase;

pub(crate) use options::{InputArgs, SettingsArgs, StudyFormat};

use anova::AnovaArgs;
use metrics::MetricsArgs;
use pairs::PairsArgs;
use plan::PlanCommand;
use psychometric::{PsychometricArgs, ShapeArgs};
use ranks::RanksArgs;
use ratings::RatingsArgs;
use staircase::{StaircaseArgs, ThresholdArgs};

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use fovqa_config::nearest;
use fovqa_study::Request;

use super::lock::LockArgs;

pub(crate) const EXAMPLES: &str = "\
Examples:
  fovqa study configs/studies/votes.toml          all analyses of a file: figures, tables, a page
  fovqa study pairs votes.csv --by scene          shares, tests and JOD scores of 2AFC trials
  fovqa study anova ratings.csv --within method   repeated-measures ANOVA
  fovqa study plan pairs --share 0.65             how many trials a study needs

FILE.csv has one trial or block per row. --column ROLE=NAME names a column that has another name.

Exit codes: 0 done; 2 the command line or the study file is wrong; 3 a table is missing, unreadable
or does not fit, or the output cannot be written; 70 a bug in fovqa; 130 interrupted.";

/// The analyses by their names.
const ANALYSES: [&str; 8] =
    ["pairs", "ranks", "anova", "psychometric", "staircase", "ratings", "metrics", "plan"];

#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    arg_required_else_help = true
)]
pub(crate) struct StudyArgs {
    #[command(subcommand)]
    pub(crate) command: Option<StudyCommand>,
    /// Study files: analyses with figures, LaTeX tables and a page; each has a folder of its own
    #[arg(value_name = "STUDY.toml", required = true, value_parser = study_file)]
    pub(crate) files: Vec<PathBuf>,
    /// Folder to write to; of several files, the folder of their folders [default: reports/NAME]
    #[arg(long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// How the results are printed
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub(crate) format: StudyFormat,
    /// Threads to compute with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) lock: LockArgs,
}

/// The path of a study file. A word that is neither a file nor an analysis is an analysis that does not
/// exist.
fn study_file(text: &str) -> Result<PathBuf, String> {
    let path = Path::new(text);
    let is_toml = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    if is_toml || path.is_file() {
        return Ok(path.to_owned());
    }
    let guess = nearest(text, ANALYSES);
    let guess = guess.map(|near| format!(" (did you mean {near}?)")).unwrap_or_default();
    let known = ANALYSES.join(", ");
    Err(format!(
        "there is no such analysis{guess}; the analyses are {known}; a study file ends with .toml"
    ))
}

/// What a command asks for.
pub(crate) struct Asked<'a> {
    pub(crate) request: Request,
    /// The table; a plan has none.
    pub(crate) input: Option<&'a InputArgs>,
    /// results.csv of a run.
    pub(crate) scores: Option<PathBuf>,
    pub(crate) settings: &'a SettingsArgs,
}

impl StudyCommand {
    /// The analysis with its options.
    pub(crate) fn asked(&self) -> Asked<'_> {
        let of = |request, input, settings| Asked {
            request,
            input: Some(input),
            scores: None,
            settings,
        };
        let plan = |request, scores, settings| Asked { request, input: None, scores, settings };
        match self {
            Self::Pairs(args) => of(Request::Pairs(args.options()), &args.input, &args.settings),
            Self::Ranks(args) => of(Request::Ranks(args.options()), &args.input, &args.settings),
            Self::Anova(args) => {
                of(Request::Anova(args.within.clone()), &args.input, &args.settings)
            }
            Self::Psychometric(args) => {
                of(Request::Psychometric(args.options()), &args.input, &args.settings)
            }
            Self::Staircase(args) => {
                of(Request::Staircase(args.threshold.options()), &args.input, &args.settings)
            }
            Self::Ratings(args) => {
                of(Request::Ratings(args.options()), &args.input, &args.settings)
            }
            Self::Metrics(args) => Asked {
                scores: Some(args.scores.clone()),
                ..of(Request::Metrics(args.options()), &args.input, &args.settings)
            },
            Self::Plan(PlanCommand::Pairs(args)) => {
                plan(args.request(), args.scores(), &args.settings)
            }
            Self::Plan(PlanCommand::Staircase(args)) => {
                plan(Request::PlanStaircase(args.options()), None, &args.settings)
            }
        }
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum StudyCommand {
    /// Pairwise comparisons (2AFC): shares, binomial tests, JOD scores, consistency of judges.
    #[command(after_help = pairs::EXAMPLES)]
    Pairs(Box<PairsArgs>),
    /// Rank tests: Kruskal-Wallis, Friedman, and tests of each pair of methods.
    #[command(after_help = ranks::EXAMPLES)]
    Ranks(Box<RanksArgs>),
    /// Repeated-measures ANOVA with one or two factors, and paired t tests.
    #[command(after_help = anova::EXAMPLES)]
    Anova(Box<AnovaArgs>),
    /// Psychometric functions: maximum-likelihood and Bayesian fits, and thresholds.
    #[command(after_help = psychometric::EXAMPLES)]
    Psychometric(Box<PsychometricArgs>),
    /// Thresholds of adaptive staircases, from their reversals.
    #[command(after_help = staircase::EXAMPLES)]
    Staircase(Box<StaircaseArgs>),
    /// Mean scores by level, the largest acceptable level, and grids of two parameters.
    #[command(after_help = ratings::EXAMPLES)]
    Ratings(Box<RatingsArgs>),
    /// How well metrics predict mean opinion scores: correlations, fits and comparisons.
    #[command(after_help = metrics::EXAMPLES)]
    Metrics(Box<MetricsArgs>),
    /// Plan a study: the trials that pairwise comparisons need, or simulated staircases.
    #[command(subcommand, after_help = plan::EXAMPLES)]
    Plan(PlanCommand),
}
