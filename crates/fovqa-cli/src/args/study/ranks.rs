//! `fovqa study ranks`.

use clap::Args;
use fovqa_params::Words;
use fovqa_study::options::{PairwiseTest, Ties};
use fovqa_study::ranks::Options;

use super::{InputArgs, SettingsArgs};
use crate::args::values::words;

pub(super) const EXAMPLES: &str = "\
Columns: participant, method, value; or those of `fovqa study pairs`: the value is then the number
of votes that a method won.

Example:
  fovqa study ranks scores.csv --unit participant,scene --pairwise signed-rank";

#[derive(Debug, Args)]
pub(crate) struct RanksArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// Columns that make up a unit; rows of a unit and method are averaged
    #[arg(long, value_name = "COLUMN,…", default_value = "participant", value_delimiter = ',')]
    unit: Vec<String>,
    /// The test of each pair of methods
    #[arg(long, value_name = "TEST", default_value = PairwiseTest::default().word(), value_parser = words::<PairwiseTest>())]
    pairwise: PairwiseTest,
    /// How ties count in pairwise comparisons
    #[arg(long, value_name = "RULE", default_value = Ties::default().word(), value_parser = words::<Ties>())]
    ties: Ties,
    /// Order of the methods [default: by first appearance]
    #[arg(long, value_name = "METHOD,…", value_delimiter = ',')]
    order: Vec<String>,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl RanksArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> Options {
        Options {
            unit: self.unit.clone(),
            pairwise: self.pairwise,
            ties: self.ties,
            order: self.order.clone(),
        }
    }
}
