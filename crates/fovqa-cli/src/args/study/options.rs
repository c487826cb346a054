//! Options that the analyses of `fovqa study` share.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fovqa_params::Words;
use fovqa_study::Settings;
use fovqa_study::adjust::Adjustment;
use fovqa_study::input::Selection;

use crate::args::values::{finite, words};

/// How a study's results are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum StudyFormat {
    /// Tables.
    Text,
    /// JSON of the schema fovqa.study/1; of a study file, fovqa.studies/1.
    Json,
}

#[derive(Debug, Args)]
pub(crate) struct InputArgs {
    /// The table: CSV with a header line, one trial or block per row
    #[arg(value_name = "FILE.csv")]
    pub(crate) file: PathBuf,
    /// Columns that divide the rows into groups; each group has its own result
    #[arg(long, value_name = "COLUMN,…", value_delimiter = ',', help_heading = "Table")]
    by: Vec<String>,
    /// Only rows with this value in a column; may be given several times
    #[arg(long = "where", value_name = "COLUMN=VALUE", value_parser = assignment, help_heading = "Table")]
    filters: Vec<(String, String)>,
    /// The name of a column in the file, such as value=score; may be given several times
    #[arg(long = "column", value_name = "ROLE=NAME", value_parser = assignment, help_heading = "Table")]
    columns: Vec<(String, String)>,
}

impl InputArgs {
    /// The selected rows and columns.
    pub(crate) fn selection(&self) -> Selection {
        Selection {
            by: self.by.clone(),
            filters: self.filters.clone(),
            columns: self.columns.clone(),
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct SettingsArgs {
    /// Coverage of intervals
    #[arg(long, value_name = "SHARE", default_value = "0.95", value_parser = share, help_heading = "Statistics")]
    confidence: f64,
    /// Adjustment of p-values for several tests
    #[arg(long, value_name = "METHOD", default_value = Adjustment::default().word(), value_parser = words::<Adjustment>(), help_heading = "Statistics")]
    adjust: Adjustment,
    /// Bootstrap replicates
    #[arg(long, value_name = "COUNT", default_value = "1000", value_parser = clap::value_parser!(u32).range(0..=1_000_000), help_heading = "Statistics")]
    bootstrap: u32,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value = "1", help_heading = "Statistics")]
    seed: u64,
    /// Threads to compute with [default: all cores, or `RAYON_NUM_THREADS`]
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<u16>,
    /// How the results are printed
    #[arg(long, value_name = "FORMAT", default_value = "text")]
    pub(crate) format: StudyFormat,
    /// Folder to write study.json to
    #[arg(long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
}

impl SettingsArgs {
    /// The settings of the library.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            confidence: self.confidence,
            adjust: self.adjust,
            bootstrap: self.bootstrap as usize,
            seed: self.seed,
        }
    }
}

fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or_else(|| "write NAME=VALUE".to_owned())?;
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

/// A share between 0 and 1, both excluded.
pub(super) fn share(text: &str) -> Result<f64, String> {
    finite(text)
        .ok()
        .filter(|share| *share > 0.0 && *share < 1.0)
        .ok_or_else(|| "write a number above 0 and below 1".to_owned())
}

/// A number from 0 to below 1.
pub(super) fn rate(text: &str) -> Result<f64, String> {
    finite(text)
        .ok()
        .filter(|rate| *rate >= 0.0 && *rate < 1.0)
        .ok_or_else(|| "write a number from 0 to below 1".to_owned())
}

/// A number of 0 or more.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    finite(text)
        .ok()
        .filter(|number| *number >= 0.0)
        .ok_or_else(|| "write a number of 0 or more".to_owned())
}
