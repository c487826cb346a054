//! `fovqa published-numbers`.

use std::path::PathBuf;

use clap::Args;

pub(crate) const EXAMPLES: &str = "\
The tables that some numbers are computed from are the papers' own: type them into
rmfr-table-1.csv (metric,scene,hyperbolic,linear,kfr,rmfr) and deamp-table-2.csv (pass_ms, and a
column for each of its columns). Without them, their rows are not checked.

Example:
  fovqa published-numbers --tables papers/ > docs/published-numbers.md";

#[derive(Debug, Args)]
pub(crate) struct PublishedNumbersArgs {
    /// Folder with rmfr-table-1.csv and deamp-table-2.csv
    #[arg(long, value_name = "DIR")]
    pub(crate) tables: Option<PathBuf>,
}
