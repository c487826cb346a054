//! One long, tidy table of all values, one row per value: its rows, and the files that hold it.

mod csv;
#[cfg(feature = "parquet")]
mod parquet;
#[cfg(feature = "parquet")]
mod part;
mod reading;
pub(crate) mod row;
mod rows;

use std::path::{Path, PathBuf};

use fovqa_plan::{OutputSettings, TableFormat};

pub use csv::{write_csv, write_results_csv, write_stereo_csv};
#[cfg(feature = "parquet")]
pub use parquet::write_results_parquet;
#[cfg(feature = "parquet")]
pub use part::Part;
pub use reading::Which;
pub(crate) use reading::not_results;
pub use row::{ERROR, GAZE_STEP, TableRow, Value};
pub(crate) use rows::rows_of_run;

use crate::csv_names::CsvNames;
use crate::files::{FileError, RESULTS_CSV, RESULTS_PARQUET};
use crate::output::Batch;
use crate::report::RunResults;

/// Whether this build can write and read results.parquet.
pub const HAS_PARQUET: bool = cfg!(feature = "parquet");

/// The file name for a format.
fn file(format: TableFormat) -> &'static str {
    match format {
        TableFormat::Csv => RESULTS_CSV,
        TableFormat::Parquet => RESULTS_PARQUET,
    }
}

/// Writes the table of a run into its folder, in each of the requested formats.
///
/// # Errors
/// If a file cannot be written, or this build does not support a format.
pub fn write_tables(
    folder: &Path,
    results: &RunResults,
    output: &OutputSettings,
    batch: &Batch,
) -> Result<(), FileError> {
    let names = CsvNames::from(output);
    output.tables.iter().try_for_each(|format| {
        let path = folder.join(file(*format));
        match format {
            TableFormat::Csv => {
                batch.write_with(&path, |out| write_results_csv(results, names, out))
            }
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => {
                batch.write_with(&path, |out| write_results_parquet(results, Part::All, out))
            }
            #[cfg(not(feature = "parquet"))]
            TableFormat::Parquet => Err(no_parquet(path)),
        }
    })
}

/// The file with the table of a results folder: results.csv, or results.parquet if there is no CSV.
pub fn table_file(folder: &Path) -> PathBuf {
    let [csv, parquet] = [RESULTS_CSV, RESULTS_PARQUET].map(|name| folder.join(name));
    if !csv.exists() && parquet.exists() { parquet } else { csv }
}

/// Reads the table of a results folder, row by row. `names` states how names are written in
/// results.csv.
///
/// # Errors
/// If it is missing, was not written by a run, or `take` refuses a row. The reason is reported with
/// the line or row number.
pub fn read_results(
    folder: &Path,
    names: CsvNames,
    which: Which,
    mut take: impl FnMut(&TableRow<'_>) -> Result<(), String>,
) -> Result<(), FileError> {
    let path = table_file(folder);
    if path.ends_with(RESULTS_CSV) {
        return csv::read_results_csv(&path, names, which, &mut take);
    }
    #[cfg(feature = "parquet")]
    return parquet::read_results_parquet(&path, which, &mut take);
    #[cfg(not(feature = "parquet"))]
    Err(no_parquet(path))
}

#[cfg(not(feature = "parquet"))]
fn no_parquet(path: PathBuf) -> FileError {
    let detail = "this build of fovqa has no support for Parquet".to_owned();
    FileError::Format { path, expected: "readable here", detail }
}
