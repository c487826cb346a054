//! `fovqa published-numbers`: the committed page is what is computed, and bad tables are refused.

use std::fs;

use crate::fovqa::{Folder, root, shared};

const PAGE: &str = "docs/published-numbers.md";
const AGAIN: &str = "run `fovqa published-numbers --tables PAPERS > docs/published-numbers.md`";

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
    let page =
        Folder::new().run(&["published-numbers", "--tables", papers.to_str().unwrap()]).ok().stdout;
    let committed = committed();
    for (found, committed) in page.lines().zip(committed.lines()) {
        assert_eq!(found, committed, "{AGAIN}");
    }
    assert_eq!(page, committed, "{AGAIN}");
}

/// What can be checked everywhere: all rows but those that are computed from tables.
#[test]
fn without_tables_all_other_lines_are_the_committed_ones() {
    let run = Folder::new().run(&["published-numbers"]).ok();
    assert_eq!(run.stderr, "");
    let found = lines(&run.stdout);
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

const RMFR: &str = "metric,scene,hyperbolic,linear,kfr,rmfr\n";

#[test]
fn a_folder_without_the_tables_is_said() {
    let folder = Folder::new();
    let run = |tables: &str| folder.run(&["published-numbers", "--tables", tables]);
    run("nowhere").fails(3, &["nowhere: there is no such folder", "help: ", "rmfr-table-1.csv"]);
    folder.write("papers/other.csv", "");
    run("papers").fails(3, &["papers", "rmfr-table-1.csv: ", "help: ", "leave --tables out"]);
    folder.run(&["published-numbers", "papers"]).fails(2, &["papers"]);
}

#[test]
fn a_table_that_lacks_something_is_said() {
    let folder = Folder::new();
    let run = || folder.run(&["published-numbers", "--tables", "papers"]);
    folder.write("papers/rmfr-table-1.csv", "metric,scene,hyperbolic,linear,rmfr\n");
    run().fails(3, &["rmfr-table-1.csv: there is no column \"kfr\"", "help: the first line names"]);
    folder.write("papers/rmfr-table-1.csv", RMFR);
    run().fails(3, &["there is no row \"FPSNR, Average\""]);
    folder.write("papers/rmfr-table-1.csv", format!("{RMFR}FPSNR,Average,1.00,2.00,none,4.00\n"));
    run().fails(3, &["line 2: \"none\" in column \"kfr\" is no number"]);
    folder.write("papers/rmfr-table-1.csv", format!("{RMFR}FPSNR,Average\n"));
    run().fails(3, &["rmfr-table-1.csv: this is no table"]);
    folder.write("papers/rmfr-table-1.csv", [0xff, 0xfe, 0x00]);
    run().fails(3, &["rmfr-table-1.csv: ", "help: "]);
}
