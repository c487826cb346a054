//! An experiment: a plan, and what is made of its results.

use std::path::PathBuf;

use crate::gates::GateRule;
use crate::output::OutputSettings;
use crate::plan::Plan;
use crate::plots::Plot;

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
    /// How the results are written.
    pub output: OutputSettings,
    /// Tables and figures; none: all that fit.
    pub plots: Vec<Plot>,
    /// The rules of its gate.
    pub gates: Vec<GateRule>,
}
