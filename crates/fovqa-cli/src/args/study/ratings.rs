//! `fovqa study ratings`.

use clap::Args;
use fovqa_params::Words;
use fovqa_study::input::Validation;
use fovqa_study::options::Smoothing;
use fovqa_study::ratings::Options;

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
    pub(super) input: InputArgs,
    /// Mean score of an acceptable level, for the largest such level
    #[arg(long, value_name = "SCORE", value_parser = finite, allow_negative_numbers = true)]
    threshold: Option<f64>,
    /// Two columns of parameters, for a grid of scores instead of levels
    #[arg(long, value_name = "X,Y", value_parser = grid_columns, conflicts_with = "threshold")]
    grid: Option<GridColumns>,
    /// Smoothing of the grid
    #[arg(long, value_name = "KIND", default_value = Smoothing::default().word(), value_parser = words::<Smoothing>(), requires = "grid")]
    smooth: Smoothing,
    /// The correct score of validation trials
    #[arg(long, value_name = "SCORE", value_parser = finite, requires = "max_errors", allow_negative_numbers = true)]
    validation_expected: Option<f64>,
    /// Wrong validation trials with which a participant is left out
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..), requires = "validation_expected")]
    max_errors: Option<u32>,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl RatingsArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> Options {
        let rule = self.validation_expected.zip(self.max_errors);
        Options {
            threshold: self.threshold,
            grid: self.grid.clone().map(|GridColumns(x, y)| [x, y]),
            smoothing: self.smooth,
            validation: rule.map(|(expected, max_errors)| Validation {
                expected,
                max_errors: max_errors as usize,
            }),
        }
    }
}

/// The two columns of a grid.
#[derive(Debug, Clone)]
struct GridColumns(String, String);

fn grid_columns(text: &str) -> Result<GridColumns, String> {
    let (x, y) = text.split_once(',').ok_or_else(|| "write two columns: X,Y".to_owned())?;
    let (x, y) = (x.trim(), y.trim());
    if x.is_empty() || y.is_empty() || y.contains(',') || x == y {
        return Err("write two different columns: X,Y".to_owned());
    }
    Ok(GridColumns(x.to_owned(), y.to_owned()))
}
