//! An experiment file, read and resolved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fovqa_metrics::Metric;
use fovqa_params::ParamValue;

use crate::fault::ExperimentError;
use crate::file;
use crate::gates::GateRule;
use crate::grammar::EXPERIMENT;
use crate::plan::Plan;
use crate::plots::Plot;
use crate::resolve;

/// What an experiment file asks for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Experiment {
    /// Its name.
    pub name: String,
    /// What it shows.
    pub about: Option<String>,
    /// Its file.
    pub path: PathBuf,
    /// The file's text.
    pub text: String,
    /// What is to be scored.
    pub plan: Plan,
    /// Tables and figures; none: all that fit.
    pub plots: Vec<Plot>,
    /// The rules of its gate.
    pub gates: Vec<GateRule>,
    /// Parameters it sets; all others have their defaults.
    pub params: BTreeMap<(Metric, &'static str), ParamValue>,
}

impl Experiment {
    /// Reads an experiment file. No other file is looked at.
    ///
    /// # Errors
    /// When it cannot be read, or has mistakes in it: all that can be told, in one go.
    pub fn read(path: &Path) -> Result<Self, ExperimentError> {
        let text = file::read(path)?;
        Self::parse(path, text)
    }

    /// Parses the text of an experiment file; relative paths in it begin in the folder of `path`.
    ///
    /// # Errors
    /// When it has mistakes in it.
    pub fn parse(path: &Path, text: String) -> Result<Self, ExperimentError> {
        let resolved = file::parse(path, &text, EXPERIMENT, |root, faults| {
            resolve::experiment(root, path, &text, faults)
        });
        Ok(Self { text, ..resolved? })
    }
}
