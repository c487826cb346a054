//! Scores for people: tables for terminals and papers, figures, and the page of a run.

mod comparison;
mod draw;
mod figures;
mod frame_values;
mod page;
mod terminal;
mod text_table;

pub use comparison::ComparisonTable;
pub use draw::{Drawn, ReportError, clear, draw};
pub use terminal::score_table;
