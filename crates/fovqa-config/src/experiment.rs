//! An experiment file, read and resolved.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use fovqa_metrics::Metric;
use fovqa_params::ParamValue;
use toml::de::DeTable;

use crate::fault::{ExperimentError, Fault};
use crate::grammar::{EXPERIMENT, check};
use crate::node::Node;
use crate::plan::Plan;
use crate::plots::Plot;
use crate::resolve;

/// What an experiment file asks for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Experiment {
    /// Its name.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
    /// The file's text.
    pub text: String,
    /// What is to be scored.
    pub plan: Plan,
    /// Tables and figures; none: all that fit.
    pub plots: Vec<Plot>,
    /// Parameters it sets; all others have their defaults.
    pub params: BTreeMap<(Metric, &'static str), ParamValue>,
}

/// Far more than anybody writes.
const MAX_BYTES: u64 = 4 << 20;

impl Experiment {
    /// Reads an experiment file. No other file is looked at.
    ///
    /// # Errors
    /// When it cannot be read, or has mistakes in it: all that can be told, in one go.
    pub fn read(path: &Path) -> Result<Self, ExperimentError> {
        let unreadable =
            |reason: String| ExperimentError::Unreadable { path: path.to_owned(), reason };
        let kind = fs::metadata(path).map_err(|error| unreadable(reason(&error)))?;
        // Before it is opened, which a pipe without a writer would never end.
        if !kind.is_file() {
            return Err(unreadable("it is not a regular file".to_owned()));
        }
        let file = fs::File::open(path).map_err(|error| unreadable(reason(&error)))?;
        let mut bytes = Vec::new();
        file.take(MAX_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| unreadable(reason(&error)))?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(unreadable("it is larger than 4 MiB".to_owned()));
        }
        let text =
            String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
        Self::parse(path, text)
    }

    /// Parses the text of an experiment file; relative paths in it begin in the folder of `path`.
    ///
    /// # Errors
    /// When it has mistakes in it.
    pub fn parse(path: &Path, text: String) -> Result<Self, ExperimentError> {
        match parse(path, &text) {
            Ok(experiment) => Ok(Self { text, ..experiment }),
            Err(mut faults) => {
                faults.sort_by_key(|fault| (fault.span.start, fault.span.end));
                // What is general is read once for each scene and eye.
                faults.dedup();
                Err(ExperimentError::Faults { path: path.to_owned(), text, faults })
            }
        }
    }
}

fn parse(path: &Path, text: &str) -> Result<Experiment, Vec<Fault>> {
    let document = DeTable::parse(text).map_err(|error| {
        // A mistake at the very end has no character of its own to point to.
        let span = error.span().unwrap_or_default();
        let span = span.start.min(text.len())..span.end.min(text.len());
        vec![Fault::new(span, format!("this is not TOML: {}", error.message()))]
    })?;
    let mut faults = Vec::new();
    check(EXPERIMENT, document.get_ref(), "the experiment", 0..0, &mut faults);
    // What refers to something is looked at only in a file that is written right: a table whose name
    // is misspelled would be missed in a dozen other places.
    if !faults.is_empty() {
        return Err(faults);
    }
    let experiment = resolve::experiment(Node::new(document.get_ref()), path, &mut faults);
    if faults.is_empty() { Ok(experiment) } else { Err(faults) }
}

fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string(),
    }
}
