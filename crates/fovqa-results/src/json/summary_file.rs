//! Reads and writes summary.json. A run may have very many comparisons. They are written and read
//! one after another, so that only one of them is in memory as JSON.

use std::collections::BTreeSet;
use std::fmt;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;

use fovqa_io::open_regular_file;
use serde::de::{DeserializeOwned, DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess};
use serde::de::{IgnoredAny, Visitor};

use super::summary::{ComparisonSummary, ErrorRecord, SUMMARY_SCHEMA};
use super::unique_keys::{CheckedKeys, UniqueKeys, stands_twice};
use super::values::Each;
use crate::files::{FileError, SUMMARY_JSON};
use crate::report::RunResults;

/// Writes the summary of a run as indented JSON.
///
/// # Errors
/// If the writer refuses.
pub fn write_summary(
    experiment: &str,
    results: &RunResults,
    mut out: impl Write,
) -> io::Result<()> {
    #[derive(serde::Serialize)]
    struct File<'a, C, E> {
        schema: &'a str,
        version: &'a str,
        experiment: &'a str,
        comparisons: C,
        errors: E,
    }
    let file = File {
        schema: SUMMARY_SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        experiment,
        comparisons: Each(|| results.comparisons.iter().map(ComparisonSummary::of)),
        errors: Each(|| results.comparisons.iter().flat_map(ErrorRecord::all)),
    };
    serde_json::to_writer_pretty(&mut out, &file)?;
    out.write_all(b"\n")
}

/// Reads summary.json in a folder. Passes each comparison to `take`, and returns the errors of the
/// run.
///
/// # Errors
/// If the file does not exist, has another format or version, or contains a key twice.
pub fn read_summary(
    folder: &Path,
    mut take: impl FnMut(ComparisonSummary),
) -> Result<Vec<ErrorRecord>, FileError> {
    let path = folder.join(SUMMARY_JSON);
    let open = || -> io::Result<BufReader<File>> {
        let file = open_regular_file(&path)?;
        let mut file = BufReader::with_capacity(1 << 16, file);
        if file.fill_buf()?.starts_with(b"\xef\xbb\xbf") {
            file.consume(3);
        }
        Ok(file)
    };
    let read = |error| FileError::Read { path: path.clone(), error };
    read_from(open().map_err(read)?, &mut take).map_err(|fault| match fault {
        Fault::Read(error) => read(error),
        Fault::Format(detail) => {
            // If a key appears twice, that explains the problem best.
            let detail = open().ok().and_then(key_twice).unwrap_or(detail);
            FileError::Format { path: path.clone(), expected: "a summary of a run", detail }
        }
    })
}

/// The key that appears twice, if there is one.
fn key_twice(file: impl Read) -> Option<String> {
    let error = serde_json::from_reader::<_, CheckedKeys>(file).err()?;
    error.is_data().then(|| error.to_string())
}

/// Why a summary cannot be read.
enum Fault {
    Read(io::Error),
    Format(String),
}

fn read_from(
    file: impl Read,
    take: &mut dyn FnMut(ComparisonSummary),
) -> Result<Vec<ErrorRecord>, Fault> {
    let mut other_schema = None;
    let mut json = serde_json::Deserializer::from_reader(file);
    let whole = Whole { take, other_schema: &mut other_schema };
    let read = whole.deserialize(&mut json).and_then(|errors| json.end().map(|()| errors));
    read.map_err(|error| match other_schema {
        Some(detail) => Fault::Format(detail),
        None if error.is_io() => Fault::Read(error.into()),
        None => Fault::Format(error.to_string()),
    })
}

/// The content of the whole file.
struct Whole<'t> {
    take: &'t mut dyn FnMut(ComparisonSummary),
    /// The name of the schema, if it is not the expected one.
    other_schema: &'t mut Option<String>,
}

impl Whole<'_> {
    fn refuse<E: Error>(&mut self, found: Option<&str>) -> E {
        let found = found
            .map_or("its schema is not".to_owned(), |found| format!("its schema is {found}, not"));
        *self.other_schema = Some(format!("{found} {SUMMARY_SCHEMA}"));
        E::custom("another schema")
    }
}

impl<'de> DeserializeSeed<'de> for Whole<'_> {
    type Value = Vec<ErrorRecord>;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Self::Value, D::Error> {
        json.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Whole<'_> {
    type Value = Vec<ErrorRecord>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<Self::Value, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Err(self.refuse(None))
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<Self::Value, A::Error> {
        let (mut keys, mut errors) = (BTreeSet::new(), None);
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "schema" => {
                    let UniqueKeys(found) = map.next_value()?;
                    if found != SUMMARY_SCHEMA {
                        return Err(self.refuse(found.as_str()));
                    }
                }
                "comparisons" => map.next_value_seed(Comparisons(self.take))?,
                "errors" => {
                    let UniqueKeys(found) = map.next_value()?;
                    errors = Some(read_value(found)?);
                }
                _ => drop(map.next_value::<UniqueKeys>()?),
            }
            if keys.contains(&key) {
                return Err(stands_twice(&key));
            }
            keys.insert(key);
        }
        if !keys.contains("schema") {
            return Err(self.refuse(None));
        }
        if !keys.contains("comparisons") {
            return Err(A::Error::missing_field("comparisons"));
        }
        errors.ok_or_else(|| A::Error::missing_field("errors"))
    }
}

fn read_value<T: DeserializeOwned, E: Error>(value: serde_json::Value) -> Result<T, E> {
    serde_json::from_value(value).map_err(E::custom)
}

/// The list of comparisons.
struct Comparisons<'t>(&'t mut dyn FnMut(ComparisonSummary));

impl<'de> DeserializeSeed<'de> for Comparisons<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<(), D::Error> {
        json.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Comparisons<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of comparisons")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while let Some(UniqueKeys(value)) = list.next_element()? {
            (self.0)(read_value(value)?);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::Inputs;
    use crate::report::{Comparison, Failure, ScoreReport};

    fn results() -> RunResults {
        let failure = Failure {
            frame: Some(3),
            reference: String::new(),
            test: String::new(),
            message: "no".to_owned(),
            help: String::new(),
        };
        let comparison = |method: &str| Comparison {
            scene: "s".to_owned(),
            method: method.to_owned(),
            swept: None,
            eye: "",
            report: ScoreReport { failures: vec![failure.clone()], ..ScoreReport::default() },
        };
        RunResults { comparisons: ["a", "b"].map(comparison).into(), inputs: Inputs::default() }
    }

    fn read(text: &str) -> Result<(Vec<String>, usize), String> {
        let mut methods = Vec::new();
        let mut take = |comparison: ComparisonSummary| methods.push(comparison.method);
        match read_from(text.as_bytes(), &mut take) {
            Ok(errors) => Ok((methods, errors.len())),
            Err(Fault::Format(detail)) => Err(detail),
            Err(Fault::Read(error)) => Err(error.to_string()),
        }
    }

    #[test]
    fn a_summary_is_read_as_it_was_written() {
        let mut text = Vec::new();
        write_summary("e", &results(), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.starts_with("{\n  \"schema\": \"fovqa.summary/1\",\n  \"version\""), "{text}");
        assert!(text.ends_with("\n  ]\n}\n"), "{text}");
        assert_eq!(read(&text), Ok((vec!["a".to_owned(), "b".to_owned()], 2)));
        let mut none = Vec::new();
        write_summary("e", &RunResults::default(), &mut none).unwrap();
        let none = String::from_utf8(none).unwrap();
        assert!(none.contains("\"comparisons\": [],\n  \"errors\": []\n"), "{none}");
        assert_eq!(read(&none), Ok((Vec::new(), 0)));
    }

    #[test]
    fn a_key_that_stands_twice_is_found_behind_other_faults() {
        let text = r#"{"comparisons": null, "schema": "x", "comparisons": []}"#;
        assert!(key_twice(text.as_bytes()).unwrap().contains("\"comparisons\" appears twice"));
        assert_eq!(key_twice(&br#"{"a": 1, "b": {"a": 2}}"#[..]), None);
        assert_eq!(key_twice(&b"{\"a\": 1"[..]), None);
    }

    #[test]
    fn what_is_no_summary_is_refused() {
        let good = r#"{"schema":"fovqa.summary/1","comparisons":[],"errors":[]}"#;
        assert_eq!(read(good), Ok((Vec::new(), 0)));
        for (text, wanted) in [
            ("[1, 2]", "its schema is not fovqa.summary/1"),
            ("{}", "its schema is not fovqa.summary/1"),
            (r#"{"schema":7}"#, "its schema is not fovqa.summary/1"),
            (r#"{"schema":"x/2","a":"#, "its schema is x/2, not fovqa.summary/1"),
            (r#"{"schema":"fovqa.summary/1","errors":[]}"#, "missing field `comparisons`"),
            (r#"{"schema":"fovqa.summary/1","comparisons":[]}"#, "missing field `errors`"),
            (&good.replace("\"errors\"", "\"comparisons\""), "\"comparisons\" appears twice"),
            (&good.replace("[]", "[{\"a\":1,\"a\":2}]"), "the key \"a\" appears twice"),
            (&good.replace("[]", "[{\"a\":1}]"), "missing field"),
            (&good.replace("[]", "{}"), "invalid type: map"),
            (&good.replace("]}", "],\"x\":{\"a\":1,\"a\":2}}"), "the key \"a\" appears twice"),
            (&format!("{good}x"), "trailing characters"),
            (&good[..good.len() / 2], "EOF"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(wanted), "{text}: {error}");
        }
    }
}
