//! `fovqa run`: experiments, their results folders, resume, shards, figures.

mod comparison_table;
mod crafted_names;
pub(crate) mod experiment_files;
pub(crate) mod experiment_folder;
mod experiment_mistakes;
mod experiments;
mod figure_mistakes;
mod figures;
mod foreseen;
mod foreseen_figures;
pub(crate) mod interrupted_runs;
mod killed;
mod library;
mod many_methods;
mod mistakes;
mod parquet;
mod pictures;
mod printed_figures;
mod report_page;
mod results_folder;
pub(crate) mod resume;
pub(crate) mod shards;
mod spreadsheet_names;
mod table_layouts;
mod two_eyes;
mod typeset;
mod unchanged;
