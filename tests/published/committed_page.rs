//! The committed page is what is computed. `make published-numbers` writes it anew.

use std::fs;

use super::page::page;
use super::rows;
use super::tables::Tables;
use crate::fovqa::{root, shared};

const PAGE: &str = "docs/published-numbers.md";
const AGAIN: &str = "run `make published-numbers`";

/// Set by `make published-numbers`.
const WRITE: &str = "FOVQA_WRITE_PUBLISHED_NUMBERS";

fn committed() -> String {
    fs::read_to_string(root().join(PAGE)).unwrap()
}

/// Lines without the padding of tables, which depends on all rows.
fn lines(page: &str) -> Vec<String> {
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    page.lines().map(words).filter(|line| !line.starts_with("| :-")).collect()
}

#[test]
fn the_committed_page_is_what_is_computed() {
    let Some(papers) = shared("papers") else { return };
    let page = page(&rows(Some(&Tables::read(&papers))));
    if std::env::var_os(WRITE).is_some() {
        fs::write(root().join(PAGE), &page).unwrap();
    }
    let committed = committed();
    for (found, committed) in page.lines().zip(committed.lines()) {
        assert_eq!(found, committed, "{AGAIN}");
    }
    assert_eq!(page, committed, "{AGAIN}");
}

/// What can be checked everywhere: all rows but those that are computed from tables.
#[test]
fn without_tables_all_other_lines_are_the_committed_ones() {
    let found = lines(&page(&rows(None)));
    let not_checked: Vec<&String> =
        found.iter().filter(|line| line.contains("| not checked |")).collect();
    assert_eq!(not_checked.len(), 4, "{not_checked:?}");
    // Place and quantity name a row.
    let names: Vec<String> = not_checked
        .iter()
        .map(|line| line.split('|').take(3).collect::<Vec<_>>().join("|"))
        .collect();
    let of_tables = |line: &String| names.iter().any(|name| line.starts_with(name.as_str()));

    let committed: Vec<String> =
        lines(&committed()).into_iter().filter(|line| !of_tables(line)).collect();
    let closing = found.iter().position(|line| line.starts_with("## Not checked"));
    let mut kept: Vec<String> =
        found[..closing.unwrap()].iter().filter(|line| !of_tables(line)).cloned().collect();
    assert_eq!(kept.pop().as_deref(), Some(""));
    for (found, committed) in kept.iter().zip(&committed) {
        assert_eq!(found, committed, "{AGAIN}");
    }
    assert_eq!(kept.len(), committed.len(), "{AGAIN}");
    let told = found[closing.unwrap()..].join("\n");
    assert!(told.contains("the tables were not given"), "{told}");
    assert!(told.contains("RMFR, Table 1") && told.contains("DEAMP, Table 2"), "{told}");
}
