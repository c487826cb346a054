//! `fovqa study ratings`.

use clap::Args;
use fovqa_params::Words;
use fovqa_study::options::Smoothing;

use super::{InputArgs, SettingsArgs};
use crate::args::values::{finite, words};

pub(super) const EXAMPLES: &str = "\
Columns: participant, value, and level or the two columns of --grid; optional: validation (1 for a
trial with a known answer).

Example:
  fovqa study ratings scores.csv --threshold 2 --validation-expected 3 --max-errors 3";

#[derive(Debug, Args)]
pub(crate) struct RatingsArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Mean score of an acceptable level, for the largest such level
    #[arg(long, value_name = "SCORE", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) threshold: Option<f64>,
    /// Two columns of parameters, for a grid of scores instead of levels
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1..)]
    pub(crate) grid: Vec<String>,
    /// Smoothing of the grid
    #[arg(long, value_name = "KIND", default_value = Smoothing::default().word(), value_parser = words::<Smoothing>(), requires = "grid")]
    pub(crate) smooth: Smoothing,
    /// The correct score of validation trials
    #[arg(long, value_name = "SCORE", value_parser = finite, requires = "max_errors", allow_negative_numbers = true)]
    pub(crate) validation_expected: Option<f64>,
    /// Wrong validation trials with which a participant is left out
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..), requires = "validation_expected")]
    pub(crate) max_errors: Option<u32>,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
}
