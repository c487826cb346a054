//! Presents scores to people: tables for terminals and papers, figures, and the page of a run.

mod band_spread;
mod budgets;
mod comparison;
mod curves;
mod doubts;
mod draw;
mod escaped;
mod figures;
mod foresee;
mod foveate_text;
mod frame_values;
mod heat_map;
mod html_table;
mod index;
mod latex;
mod limits;
mod long_lines;
mod moments;
mod overview;
mod page;
mod plain_table;
mod plot_figures;
mod print;
mod printed;
mod profile;
mod run_table;
mod sentence;
mod sheet;
mod steps;
mod study;
mod sweep;
mod terminal;
mod text;
mod text_table;
mod verdict;
mod viewer;

pub use comparison::ComparisonTable;
pub use curves::{DrawnCurves, draw_curves, impossible_curves};
pub use draw::{Drawn, draw};
pub use figures::Band;
pub use foresee::{ExpectedScore, impossible_figures};
pub use foveate_text::foveate_text;
pub use heat_map::MapSheet;
pub use index::draw_index;
pub use limits::{DrawnLimits, draw_limits};
pub use printed::{Printed, PrintedVerdict};
pub use profile::{ProfileLine, profile_picture};
pub use run_table::{PlainRunTable, RunTable};
pub use sheet::{ReportError, clear};
pub use steps::{BeginStep, ItemDone};
pub use study::{
    AnsweredAnalysis, DrawnStudy, NoResult, ResultOfPrinted, StudySheet, printed_results,
    study_text,
};
pub use terminal::{score_table, stereo_table};
pub use text::{Text, wrapped, wrapped_line};
pub use text_table::TextTable;
pub use verdict::{
    baseline_table, difference_table, github_annotations, gitlab_report, junit, markdown,
    verdict_table, without_commands,
};
