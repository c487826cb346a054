//! Names that a spreadsheet would take for formulas: as they are, or, where that is asked for, as text.

use std::fs;
use std::path::Path;

use super::experiment_folder::{bytes, rows, two_scenes};
use crate::fovqa::Folder;

const NAMES: [(&str, &str); 4] = [
    ("\"room\"", "\"=1+1\""),
    ("\"hall\"", "\"'@hall\""),
    ("\"A\"", "\"-A\""),
    ("\"B\"", "\"+B, C\""),
];

/// Two experiments that differ in nothing but the setting.
fn experiments() -> Folder {
    let folder = two_scenes();
    let mut text = fs::read_to_string(folder.path("e.toml")).unwrap();
    for (name, other) in NAMES {
        text = text.replacen(&format!("name = {name}"), &format!("name = {other}"), 1);
    }
    text = text.replace("{scene}/gt", "hall/gt").replace("{scene}/", "room/");
    let text = text.replace("[metrics]", "[[gate]]\nmetric = \"psnr\"\nat_least = 1\n[metrics]");
    folder.write("plain.toml", &text);
    folder.write("safe.toml", format!("{text}[output]\nspreadsheet_safe = true\n"));
    folder
}

fn cells(text: &[u8]) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text);
    let records: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    records.iter().flat_map(|record| record.iter().map(str::to_owned)).collect()
}

#[test]
fn names_are_text_in_every_csv_file_and_the_same_when_read_again() {
    let folder = experiments();
    for of in ["plain", "safe"] {
        folder.run(&["run", &format!("{of}.toml"), "--output", of]).ok();
    }
    let names = |of: &str| {
        let rows = rows(&folder, of);
        let mut names: Vec<String> =
            rows.iter().flat_map(|row| [row["scene"].clone(), row["method"].clone()]).collect();
        names.sort();
        names.dedup();
        names
    };
    assert_eq!(names("plain"), ["'@hall", "+B, C", "-A", "=1+1"]);
    assert_eq!(names("safe"), ["''@hall", "'+B, C", "'-A", "'=1+1"]);
    let [plain, safe] = ["plain", "safe"].map(|of| bytes(&folder.path(of)));
    assert_eq!(plain.keys().collect::<Vec<_>>(), safe.keys().collect::<Vec<_>>());
    let mut changed = 0;
    for (file, text) in &safe {
        if Path::new(file).extension().is_some_and(|ending| ending == "csv") {
            let (found, wanted) = (cells(text), cells(&plain[file]));
            assert_eq!(found.len(), wanted.len(), "{file}");
            for (found, wanted) in found.iter().zip(&wanted) {
                let is_formula = found.starts_with(['=', '+', '-', '@']);
                assert!(!is_formula || found.parse::<f64>().is_ok(), "{file}: {found}");
                changed += u32::from(found != wanted);
                assert!(found == wanted || *found == format!("'{wanted}"), "{file}: {found}");
            }
        } else if !["run.json", "journal.jsonl", "report.html"].contains(&&**file) {
            // Those have the experiment as it was written.
            assert!(*text == plain[file], "{file}");
        }
    }
    assert!(changed > 100, "{changed}");
    assert!(!String::from_utf8_lossy(&plain["run.json"]).contains("spreadsheet_safe"));
    // Verdicts, baselines and drawings are of the names themselves.
    let [plain, again] = ["plain", "safe"].map(|of| folder.run(&["gate", of]).ok().stdout);
    assert_eq!(plain, again);
    folder.run(&["baseline", "save", "safe", "base.json"]).ok();
    folder.run(&["gate", "plain", "--baseline", "base.json"]).ok();
    // The run had no verdict yet.
    fs::remove_dir_all(folder.path("safe/gate")).unwrap();
    folder.run(&["report", "safe"]).ok();
    assert!(bytes(&folder.path("safe")) == safe);
}
