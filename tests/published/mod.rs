//! The numbers that papers print, beside what the models compute: `docs/published-numbers.md`.
//!
//! One paper per file, each a function that returns its rows. Printed numbers are typed in as they are
//! printed; computed numbers never are. A verdict follows from both ([`fovqa_report::Printed::verdict`]). The
//! papers' larger tables are read from a folder; without it, the rows that need them are not checked.

mod committed_page;
mod deamp;
mod frame;
mod known;
mod page;
mod patney;
mod rmfr;
mod row;
mod statistics;
mod tables;
mod vafr;

use row::PageRow;
use tables::Tables;

/// All rows, paper by paper.
fn rows(tables: Option<&Tables>) -> Vec<PageRow> {
    let (rmfr_table, deamp_table) = (tables.map(|t| &t.rmfr), tables.map(|t| &t.deamp));
    [vafr::vafr(), rmfr::rmfr(rmfr_table), deamp::deamp(deamp_table), patney::patney()].concat()
}
