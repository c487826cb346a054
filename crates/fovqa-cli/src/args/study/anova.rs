//! `fovqa study anova`.

use clap::Args;

use super::{InputArgs, SettingsArgs};

pub(super) const EXAMPLES: &str = "\
Columns: participant, value, and those of the factors.

Example:
  fovqa study anova slider.csv --within method,eye";

#[derive(Debug, Args)]
pub(crate) struct AnovaArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    /// One or two columns: the factors within participants
    #[arg(long, value_name = "FACTOR,…", required = true, value_delimiter = ',')]
    pub(super) within: Vec<String>,
    #[command(flatten)]
    pub(super) settings: SettingsArgs,
}
