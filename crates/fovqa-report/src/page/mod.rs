//! The pages of reports: self-contained HTML from the templates in `templates/`. They need no
//! network, and their policy ([`shell`]) lets a browser run and load nothing but what is inside.

mod address;
mod alternative;
mod conditions;
mod figure;
mod forward;
mod left_out;
mod places;
mod run;
mod shell;
mod table;
mod terms;
mod verdict;

pub(crate) use address::address;
pub(crate) use alternative::in_words;
pub(crate) use figure::{PageFigure, data_image};
pub(crate) use forward::forward;
pub(crate) use run::{PageInputs, run_page};
pub(crate) use shell::Shell;
pub(crate) use table::PageTable;
pub(crate) use verdict::PageVerdict;
