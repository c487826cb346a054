//! The content of a study file: analyses of user studies, which share figures, a page and a folder.

use std::collections::BTreeMap;
use std::path::PathBuf;

use fovqa_statistics::adjust::Adjustment;
use fovqa_study::input::Selection;
use fovqa_study::{Request, Settings};
use serde::{Deserialize, Serialize};

use crate::figures::FigureSettings;

/// A study file.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyFile {
    /// Name of the study.
    pub name: String,
    /// Description for the page; may be empty.
    pub about: String,
    /// Path of the file.
    pub path: PathBuf,
    /// Its analyses; at least one.
    pub analyses: Vec<StudyAnalysis>,
}

/// One analysis in a study file.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyAnalysis {
    /// Its name, with which the names of its files begin. No two analyses have the same one.
    pub name: String,
    /// Its heading on the page; `None` for its name.
    pub title: Option<String>,
    /// The analysis and its own options.
    pub request: Request,
    /// The table of answers; a plan has none.
    pub table: Option<PathBuf>,
    /// The scores of metrics: results.csv of a run.
    pub scores: Option<PathBuf>,
    /// The rows and columns of the table.
    pub selection: Selection,
    /// Settings that all analyses have.
    pub settings: Settings,
    /// Printed numbers that results are compared with.
    pub printed: Vec<PrintedNumber>,
    /// How its figures are printed.
    pub figure: FigureSettings,
}

/// A number that a paper prints, and the result that it is compared with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrintedNumber {
    /// What it is.
    pub quantity: String,
    /// Where it is printed, such as `Table 2`; may be empty.
    pub place: String,
    /// As it is printed: `.637`, `< .01`, `14.8 %`.
    pub value: String,
    /// The place of the result in the JSON of the analysis (a JSON pointer, RFC 6901).
    pub at: String,
    /// Why they differ, or what is known about it; may be empty.
    pub note: String,
    /// Whether the data do not depend on the number.
    pub independent: bool,
}

/// `[study]` of an experiment: mean opinion scores, which the scores of the run's metrics are compared
/// with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OpinionScores {
    /// The table as the experiment names it.
    pub file: String,
    /// The roles `scene`, `method`, `value` and `se`, and the names of their columns if they have others.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub columns: BTreeMap<String, String>,
    /// The keys of the metrics that are compared; all that are scored if there is none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub metrics: Vec<String>,
    /// Coverage of intervals.
    pub confidence: f64,
    /// The adjustment for several tests.
    pub adjust: Adjustment,
    /// The number of bootstrap replicates.
    pub bootstrap: usize,
    /// The seed of all random numbers.
    pub seed: u64,
}

impl OpinionScores {
    /// The columns of the table.
    pub fn selection(&self) -> Selection {
        let columns = self.columns.iter().map(|(role, name)| (role.clone(), name.clone()));
        Selection { columns: columns.collect(), ..Selection::default() }
    }

    /// The settings of the analysis.
    pub fn settings(&self) -> Settings {
        Settings {
            confidence: self.confidence,
            adjust: self.adjust,
            bootstrap: self.bootstrap,
            seed: self.seed,
        }
    }
}
