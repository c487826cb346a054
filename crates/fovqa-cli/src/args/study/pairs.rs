//! `fovqa study pairs`.

use clap::Args;
use fovqa_params::Words;
use fovqa_study::options::Ties;
use fovqa_study::pairs::Options;

use super::options::not_negative;
use super::{InputArgs, SettingsArgs};
use crate::args::values::words;

pub(super) const EXAMPLES: &str = "\
Columns: participant, method_a, method_b, answer (a, b, the name of a method, or tie); optional:
scene, n (the row stands for n trials).

Example:
  fovqa study pairs votes.csv --by scene --reference GT --ties half";

#[derive(Debug, Args)]
pub(crate) struct PairsArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// How ties count
    #[arg(long, value_name = "RULE", default_value = Ties::default().word(), value_parser = words::<Ties>())]
    ties: Ties,
    /// Order of the methods [default: by first appearance]
    #[arg(long, value_name = "METHOD,…", value_delimiter = ',')]
    order: Vec<String>,
    /// The method whose score is 0 [default: the mean score is 0]
    #[arg(long, value_name = "METHOD")]
    reference: Option<String>,
    /// Votes added to both sides of each pair with votes, for the scores
    #[arg(long, value_name = "VOTES", default_value = "0", value_parser = not_negative)]
    pseudo_votes: f64,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl PairsArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> Options {
        Options {
            ties: self.ties,
            order: self.order.clone(),
            reference: self.reference.clone(),
            pseudo_votes: self.pseudo_votes,
        }
    }
}
