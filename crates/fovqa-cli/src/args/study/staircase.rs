//! `fovqa study staircase`.

use clap::Args;
use fovqa_params::Words;
use fovqa_study::options::LevelMean;
use fovqa_study::staircase::Options;

use super::{InputArgs, SettingsArgs};
use crate::args::values::words;

pub(super) const EXAMPLES: &str = "\
Columns: participant, trial, level, correct; optional: method, scene, staircase.

Example:
  fovqa study staircase staircases.csv --drop-reversals 2 --mean geometric";

/// How a threshold follows from the reversals.
#[derive(Debug, Args)]
pub(crate) struct ThresholdArgs {
    /// First reversals that are left out
    #[arg(long, value_name = "COUNT", default_value = "2", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    drop_reversals: u32,
    /// Mean of the levels at the other reversals
    #[arg(long, value_name = "MEAN", default_value = LevelMean::default().word(), value_parser = words::<LevelMean>())]
    mean: LevelMean,
}

#[derive(Debug, Args)]
pub(crate) struct StaircaseArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    #[command(flatten)]
    pub(super) threshold: ThresholdArgs,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}

impl ThresholdArgs {
    /// The options of the library.
    pub(super) fn options(&self) -> Options {
        Options { drop_reversals: self.drop_reversals as usize, mean: self.mean }
    }
}
