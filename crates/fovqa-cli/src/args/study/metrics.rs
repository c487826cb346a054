//! `fovqa study metrics`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::StringValueParser;
use fovqa_study::metrics::Options;

use super::{InputArgs, SettingsArgs};
use crate::args::offered::{self, offering};

pub(super) const EXAMPLES: &str = "\
Columns: scene, method, value (the mean opinion score); optional: se (its standard error).
The scores are results.csv of `fovqa run`.

Example:
  fovqa study metrics mos.csv --scores reports/demo/results.csv --lower-is-better mse";

#[derive(Debug, Args)]
pub(crate) struct MetricsArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// Scores of the metrics: results.csv of a run
    #[arg(long, value_name = "results.csv")]
    pub(super) scores: PathBuf,
    /// Metrics to compare [default: all in the file]
    #[arg(long, value_name = "METRIC,…", value_delimiter = ',', value_parser = offering(StringValueParser::new(), offered::metric_keys), hide_possible_values = true)]
    metrics: Vec<String>,
    /// Metrics whose lower scores are better
    #[arg(long, value_name = "METRIC,…", value_delimiter = ',', value_parser = offering(StringValueParser::new(), offered::metric_keys), hide_possible_values = true)]
    lower_is_better: Vec<String>,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl MetricsArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> Options {
        Options { metrics: self.metrics.clone(), lower_is_better: self.lower_is_better.clone() }
    }
}
