//! The checksums of a run's files. They are part of run.json, so that a file that was truncated or
//! changed later can be detected.

use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use fovqa_io::{id_of, open_regular_file};

use crate::files::{FileError, INPUTS_CSV, RESULTS_CSV, RESULTS_PARQUET, SUMMARY_JSON};
use crate::json::RunRecord;
use crate::table::table_file;

/// SHA-256 of each file of a run, in hexadecimal digits, by its name.
pub type Checksums = BTreeMap<String, String>;

/// Computes the checksums of the files in the folder of a run.
///
/// # Errors
/// If a file cannot be read.
pub fn checksums(folder: &Path) -> Result<Checksums, FileError> {
    let of = |name: &str| {
        let path = folder.join(name);
        match checksum(&path) {
            Ok(sum) => Ok((name.to_owned(), sum)),
            Err(error) => Err(FileError::Read { path, error }),
        }
    };
    // A run has one of the two tables or both.
    let tables =
        [RESULTS_CSV, RESULTS_PARQUET].into_iter().filter(|name| folder.join(name).exists());
    let inputs = Some(INPUTS_CSV).filter(|name| folder.join(name).exists());
    tables.chain([SUMMARY_JSON]).chain(inputs).map(of).collect()
}

/// SHA-256 of a file. The byte order mark that an editor adds is left out, because readers of the
/// file skip it as well.
fn checksum(path: &Path) -> io::Result<String> {
    let mut file = BufReader::new(open_regular_file(path)?);
    if file.fill_buf()?.starts_with(b"\xef\xbb\xbf") {
        file.consume(3);
    }
    Ok(id_of(file)?.sha256)
}

/// Compares the files of a run with the checksums in its record. Returns a message for the user if
/// the record has no checksums, because an earlier version wrote it.
///
/// # Errors
/// If a file cannot be read, or was changed after it was written.
pub fn check_files(folder: &Path, record: &RunRecord) -> Result<Option<String>, FileError> {
    if record.files.is_empty() {
        let folder = folder.display();
        return Ok(Some(format!(
            "{folder}: an earlier version of fovqa wrote it without checksums, so later changes to its files \
             cannot be detected"
        )));
    }
    // Readers take this table. If the run did not write it, nothing vouches for its values.
    let table = table_file(folder);
    let name = table.file_name().unwrap_or_default().to_string_lossy();
    if !record.files.contains_key(&*name) {
        return Err(FileError::Format {
            path: table,
            expected: "a file of this run",
            detail: "run.json has no checksum of it".to_owned(),
        });
    }
    let found = checksums(folder)?;
    let changed =
        record.files.iter().find(|(name, sum)| found.get(*name).is_some_and(|now| now != *sum));
    match changed {
        None => Ok(None),
        Some((name, _)) => Err(FileError::Format {
            path: folder.join(name),
            expected: "as the run wrote it",
            detail: "its checksum differs from that in run.json".to_owned(),
        }),
    }
}
