//! `fovqa published-numbers`.

use std::path::PathBuf;

use clap::Args;

pub(crate) const EXAMPLES: &str = "\
Some numbers are computed from tables of the papers, which are not part of fovqa: type them off, in
files with these columns. Without them, those numbers are not checked.

  rmfr-table-1.csv    metric,scene,hyperbolic,linear,kfr,rmfr
  deamp-table-2.csv   pass_ms,full,kfr,rmfr,efr_kfr_dom,efr_kfr_other,2r_dom,2r_other,4r_dom,
                      4r_other,6r_dom,6r_other

Example:
  fovqa published-numbers --tables papers/ > docs/published-numbers.md";

#[derive(Debug, Args)]
pub(crate) struct PublishedNumbersArgs {
    /// Folder with rmfr-table-1.csv and deamp-table-2.csv
    #[arg(long, value_name = "DIR")]
    pub(crate) tables: Option<PathBuf>,
}
