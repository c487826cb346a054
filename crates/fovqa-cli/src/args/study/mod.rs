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

pub(crate) use anova::AnovaArgs;
pub(crate) use metrics::MetricsArgs;
pub(crate) use options::{InputArgs, SettingsArgs, StudyFormat};
pub(crate) use pairs::PairsArgs;
pub(crate) use plan::PlanCommand;
pub(crate) use psychometric::{PsychometricArgs, ShapeArgs};
pub(crate) use ranks::RanksArgs;
pub(crate) use ratings::RatingsArgs;
pub(crate) use staircase::{StaircaseArgs, ThresholdArgs};

use clap::Subcommand;

pub(crate) const EXAMPLES: &str = "\
Examples:
  fovqa study pairs votes.csv --by scene          shares, tests and JOD scores of 2AFC trials
  fovqa study anova ratings.csv --within method   repeated-measures ANOVA
  fovqa study plan pairs --share 0.65             how many trials a study needs

FILE.csv has one trial or block per row. --column ROLE=NAME names a column that has another name.

Exit codes: 0 done; 2 the command line is wrong; 3 the table is missing, unreadable or does not
fit, or the output cannot be written; 70 a bug in fovqa; 130 interrupted.";

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
