//! The numbers that papers print, beside what the models compute: [`page`] puts them into one page
//! of Markdown.
//!
//! One paper a file, each a function that gives its [`Row`]s. Printed numbers are typed in as they
//! are printed; computed ones never are. Verdicts follow from both ([`Printed::verdict`]), so that
//! none can be bent. The papers' larger tables are read from a folder of the user's ([`Tables`]);
//! without them their rows are not checked, and say so.
//!
//! ```
//! use fovqa_published::{Paper, Verdict, rows};
//!
//! let rows = rows(None);
//! let share = rows.iter().find(|row| row.quantity == "share of samples at σ = 2.6").unwrap();
//! assert_eq!((share.paper, share.verdict()), (Paper::Rmfr, Verdict::Reproduced));
//! ```

mod deamp;
mod frame;
mod page;
mod patney;
mod printed;
mod rmfr;
mod row;
mod statistics;
mod tables;
mod vafr;

pub use deamp::deamp;
pub use page::page;
pub use patney::patney;
pub use printed::{CLOSE, Printed, Verdict};
pub use rmfr::rmfr;
pub use row::{Cell, Paper, Row};
pub use statistics::{at_least, f_tail, two_sided, whole_votes};
pub use tables::{DEAMP_TABLE, RMFR_TABLE, Table, Tables, TablesError};
pub use vafr::vafr;

/// All rows, paper by paper.
pub fn rows(tables: Option<&Tables>) -> Vec<Row> {
    [vafr(), rmfr(tables.map(|t| &t.rmfr)), deamp(tables.map(|t| &t.deamp)), patney()].concat()
}

#[cfg(test)]
mod tests;
