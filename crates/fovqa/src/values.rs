//! The values of a run as a Parquet data set, one file per shard. Each has the columns of results.parquet.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use fovqa_engine::Shard;
use fovqa_results::{FileError, RunResults, VALUES_PARQUET, take_away};

/// The folder of the data set in that of the results.
const FOLDER: &str = "values";
/// The file with the rows that belong to no shard: of whole sequences, and of both eyes together.
const SEQUENCES: &str = "sequences.parquet";
const ENDING: &str = ".parquet";
/// The least number of digits, so that the files are in order for any number of shards.
const DIGITS: usize = 5;

/// Removes the data set of an earlier run. What somebody else put into the folder stays.
pub(crate) fn clear_values(results: &Path) {
    let folder = results.join(FOLDER);
    let Ok(entries) = fs::read_dir(&folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name == SEQUENCES || shard_of(&name).is_some() {
            let _ = fs::remove_file(entry.path());
        }
    }
    // Only an empty folder can be removed this way.
    let _ = fs::remove_dir(&folder);
}

/// The name of the file of a shard.
fn file_name(shard: Shard) -> String {
    format!("{:0DIGITS$}-of-{:0DIGITS$}{ENDING}", shard.index(), shard.of())
}

/// The shard that a file name stands for.
fn shard_of(name: &str) -> Option<Shard> {
    let (index, of) = name.strip_suffix(ENDING)?.split_once("-of-")?;
    let number = |text: &str| text.parse::<u32>().ok();
    let shard: Shard = format!("{}/{}", number(index)?, number(of)?).parse().ok()?;
    (file_name(shard) == name).then_some(shard)
}

/// The data set in the folder of a run.
pub(crate) struct ValuesFolder(PathBuf);

impl ValuesFolder {
    /// Creates the folder.
    ///
    /// # Errors
    /// If the operating system refuses.
    pub(crate) fn new(results: &Path) -> io::Result<Self> {
        let folder = results.join(FOLDER);
        fovqa_results::make_folder(&folder)?;
        Ok(Self(folder))
    }

    /// Takes the file of a shard from its folder. Returns whether there is one.
    ///
    /// # Errors
    /// If it cannot be read or written.
    pub(crate) fn take(&self, shard: Shard, folder: &Path) -> Result<bool, FileError> {
        let (from, to) = (folder.join(VALUES_PARQUET), self.0.join(file_name(shard)));
        let failed = |error| FileError::Write { path: to.clone(), error };
        take_away(&to).map_err(failed)?;
        // Both names of one file need its space only once. Nothing ever changes it: it is replaced.
        if fs::hard_link(&from, &to).is_ok() {
            return Ok(true);
        }
        match fs::copy(&from, &to) {
            Ok(_) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(error) => Err(failed(error)),
        }
    }

    /// Writes the rows of the frames of a shard.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(crate) fn write(&self, shard: Shard, results: &RunResults) -> Result<(), FileError> {
        write(&self.0.join(file_name(shard)), results, false)
    }

    /// Writes the rows that belong to no shard.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(crate) fn write_sequences(&self, results: &RunResults) -> Result<(), FileError> {
        write(&self.0.join(SEQUENCES), results, true)
    }
}

/// Writes the values of a shard into its folder. A build without Parquet writes none.
///
/// # Errors
/// If the file cannot be written.
pub(crate) fn write_values_of_shard(folder: &Path, results: &RunResults) -> Result<(), FileError> {
    write(&folder.join(VALUES_PARQUET), results, false)
}

#[cfg(feature = "parquet")]
fn write(path: &Path, results: &RunResults, sequences: bool) -> Result<(), FileError> {
    use fovqa_results::{Part, write_results_parquet, write_whole_with};

    let part = if sequences { Part::Sequences } else { Part::Frames };
    write_whole_with(path, |out| write_results_parquet(results, part, out))
}

#[cfg(not(feature = "parquet"))]
fn write(_: &Path, _: &RunResults, _: bool) -> Result<(), FileError> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_data_set_are_removed() {
        let results = tempfile::tempdir().unwrap();
        let folder = results.path().join(FOLDER);
        fs::create_dir(&folder).unwrap();
        let ours = ["00001-of-00002.parquet", "10000-of-10000.parquet", SEQUENCES];
        let others = ["1-of-2.parquet", "00003-of-00002.parquet", "00001-of-00002.csv", "mine"];
        for name in ours.iter().chain(&others) {
            fs::write(folder.join(name), "").unwrap();
        }
        clear_values(results.path());
        assert!(ours.iter().all(|name| !folder.join(name).exists()));
        assert!(others.iter().all(|name| folder.join(name).exists()));
        for name in others {
            fs::remove_file(folder.join(name)).unwrap();
        }
        clear_values(results.path());
        assert!(!folder.exists());
        clear_values(results.path());
    }

    #[test]
    fn a_shard_has_one_file_name() {
        let shard: Shard = "7/400".parse().unwrap();
        assert_eq!(file_name(shard), "00007-of-00400.parquet");
        assert_eq!(shard_of("00007-of-00400.parquet"), Some(shard));
        assert_eq!(shard_of("+0007-of-00400.parquet"), None);
    }
}
