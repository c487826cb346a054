//! Runs an analysis on a table in memory.

use fovqa_study::input::{Data, Selection, Table};
use fovqa_study::json::Document;
use fovqa_study::{Settings, StudyError};

/// Bootstrap replicates of each study.
const BOOTSTRAP: usize = 300;

/// The settings of a repetition, whose bootstrap has a seed of its own.
pub(crate) fn settings(repetition: u64) -> Settings {
    Settings { bootstrap: BOOTSTRAP, seed: 1_000_000 + repetition, ..Settings::default() }
}

/// The result of an analysis of a whole table, which has one group.
pub(crate) fn one_group<T>(
    csv: &str,
    analysis: impl Fn(&Data) -> Result<Document<T>, StudyError>,
) -> T {
    let table = Table::read("simulated.csv", csv.as_bytes()).unwrap();
    let selection = Selection::default();
    let document = analysis(&Data::new(&table, &selection).unwrap()).unwrap();
    document.groups.into_iter().next().unwrap().result
}
