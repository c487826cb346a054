//! inputs.csv lists the inputs of a run that has too many for run.json, with one row per file.

use std::io::{self, BufReader, Write};
use std::path::Path;

use crate::files::{FileError, open_result_file};
use crate::inputs::{Identity, Input, Inputs};

const COLUMNS: [&str; 3] = ["path", "bytes", "sha256"];

/// Writes inputs, ordered by path.
///
/// # Errors
/// If the writer refuses.
pub fn write_inputs(inputs: &Inputs, out: impl Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(COLUMNS)?;
    for Input { path, bytes, sha256 } in inputs.all() {
        writer.write_record([path, bytes.to_string(), sha256])?;
    }
    writer.flush()
}

/// Reads inputs.
pub(crate) fn read_inputs(path: &Path) -> Result<Inputs, FileError> {
    let wrong = |detail: String| FileError::Format {
        path: path.to_owned(),
        expected: "the list of the inputs of a run",
        detail,
    };
    let mut reader = csv::Reader::from_reader(BufReader::new(open_result_file(path)?));
    let headers = reader.headers().map_err(|error| wrong(error.to_string()))?;
    if !headers.iter().eq(COLUMNS) {
        return Err(wrong(format!("its columns are not these: {}", COLUMNS.join(", "))));
    }
    let mut inputs = Inputs::default();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| wrong(error.to_string()))? {
        let bytes = record[1].parse();
        let bytes = bytes.map_err(|_| {
            let line = record.position().map_or(0, csv::Position::line);
            wrong(format!("line {line}: {:?} is not a number of bytes", &record[1]))
        })?;
        inputs.add(record[0].into(), Identity::new(bytes, &record[2]));
    }
    Ok(inputs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_read_as_they_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("inputs.csv");
        let mut inputs = Inputs::default();
        for (name, bytes) in [("b \"quoted\", ä.png", 0), ("a\nb.png", u64::MAX), ("c.png", 7)] {
            inputs.add(name.into(), Identity::new(bytes, &"0f".repeat(32)));
        }
        let mut written = Vec::new();
        write_inputs(&inputs, &mut written).unwrap();
        std::fs::write(&path, &written).unwrap();
        assert_eq!(read_inputs(&path).unwrap(), inputs);
        for (text, what) in [
            ("path,bytes\n", "its columns are not these: path, bytes, sha256"),
            ("path,bytes,sha256\na,-1,00\n", "line 2: \"-1\" is not a number of bytes"),
            ("path,bytes,sha256\na,1\n", "2 fields"),
        ] {
            std::fs::write(&path, text).unwrap();
            let error = read_inputs(&path).unwrap_err().to_string();
            assert!(error.contains(what), "{error}");
        }
        std::fs::remove_file(&path).unwrap();
        assert!(read_inputs(&path).is_err());
    }
}
