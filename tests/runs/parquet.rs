//! results.parquet: the values of results.csv, instead of it or beside it.

use std::fs;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{bytes, experiment, two_scenes};

const GATE: &str = "[[gate]]\nmetric = \"psnr\"\nat_least = 1.0\n";

fn with_tables(tables: &str) -> Folder {
    let folder = two_scenes();
    folder.write("e.toml", experiment(&format!("{GATE}[output]\ntables = {tables}\n")));
    folder
}

/// Every cell of results.csv.
pub(crate) fn cells_of_csv(folder: &Folder, file: &str) -> Vec<Vec<String>> {
    let csv = fs::read_to_string(folder.path(file)).unwrap();
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(csv.as_bytes());
    let records = reader.records().map(|record| {
        let record: Vec<String> = record.unwrap().iter().map(str::to_owned).collect();
        // Counts are whole numbers in the CSV; in Parquet a column has one type.
        let value = record[11].parse::<u64>();
        let value = value.map_or(record[11].clone(), |count| format!("{:?}", count as f64));
        [&record[..11], &[value]].concat()
    });
    records.collect()
}

/// Every cell as the CSV would show it.
pub(crate) fn cells(folder: &Folder, file: &str) -> Vec<Vec<String>> {
    let file = fs::File::open(folder.path(file)).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let names: Vec<String> = reader
        .metadata()
        .file_metadata()
        .schema_descr()
        .columns()
        .iter()
        .map(|column| column.name().to_owned())
        .collect();
    let mut rows = vec![names];
    for row in reader.get_row_iter(None).unwrap() {
        let row = row.unwrap();
        let cell = |(_, field): (&String, &Field)| match field {
            Field::Null => String::new(),
            Field::Str(text) => text.clone(),
            Field::Long(number) => number.to_string(),
            Field::Double(number) if number.is_nan() => "nan".to_owned(),
            Field::Double(number) => format!("{number:?}"),
            other => panic!("{other:?}"),
        };
        rows.push(row.get_column_iter().map(cell).collect());
    }
    rows
}

#[test]
fn has_the_values_of_the_csv() {
    let folder = with_tables("[\"csv\", \"parquet\"]");
    folder.png("room/b/0001.png", 3, 3, &[0; 27]);
    assert_eq!(folder.run(&["run", "e.toml", "--output", "out"]).code, 3);
    let expected = cells_of_csv(&folder, "out/results.csv");
    assert!(expected.iter().any(|row| row[6] == "error" && row[11] == "nan"));
    assert_eq!(cells(&folder, "out/results.parquet"), expected);
}

#[test]
fn stands_in_for_the_csv() {
    let [csv, parquet] = ["[\"csv\"]", "[\"parquet\"]"].map(with_tables);
    csv.run(&["run", "e.toml", "--output", "out"]).ok();
    let said = parquet.run(&["run", "e.toml", "--output", "out"]).ok().stderr;
    assert!(said.contains("out: results.parquet, summary.json"), "{said}");
    assert!(!parquet.path("out/results.csv").exists());
    // What is drawn from the table is the same.
    let drawn = |folder: &Folder| {
        let mut files = bytes(&folder.path("out"));
        files.retain(|name, _| name.starts_with("plots/") || name.starts_with("table"));
        files
    };
    let expected = drawn(&csv);
    assert!(expected.len() > 3);
    assert_eq!(drawn(&parquet), expected);
    let page = fs::read_to_string(parquet.path("out/report.html")).unwrap();
    assert!(page.contains("href=\"results.parquet\"") && !page.contains("results.csv"), "{page}");
    fs::remove_dir_all(parquet.path("out/plots")).unwrap();
    parquet.run(&["report", "out"]).ok();
    assert_eq!(drawn(&parquet), expected);
    let gate = |folder: &Folder| folder.run(&["gate", "out"]).ok().stdout;
    assert_eq!(gate(&parquet), gate(&csv));
}

#[test]
fn is_refused_when_it_was_changed_or_is_damaged() {
    let folder = with_tables("[\"parquet\"]");
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let file = folder.path("out/results.parquet");
    let whole = fs::read(&file).unwrap();
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 1;
    fs::write(&file, &changed).unwrap();
    for command in [["report", "out"], ["gate", "out"]] {
        folder.run(&command).fails(3, &["results.parquet", "checksum"]);
    }
    // Without checksums, as another program may write the folder: an error, and never a panic.
    let record = fs::read_to_string(folder.path("out/run.json")).unwrap();
    let mut record: serde_json::Value = serde_json::from_str(&record).unwrap();
    record["files"] = serde_json::json!({});
    folder.write("out/run.json", record.to_string());
    for end in [0, 3, 4, 11, whole.len() / 2, whole.len() - 9, whole.len() - 1] {
        fs::write(&file, &whole[..end]).unwrap();
        folder.run(&["gate", "out"]).fails(3, &["results.parquet"]);
    }
    fs::write(&file, "scene,method\n").unwrap();
    folder.run(&["gate", "out"]).fails(3, &["results.parquet"]);
}

/// A table beside the recorded one would be read in its place.
#[test]
fn a_table_that_the_run_did_not_write_is_refused() {
    let folder = with_tables("[\"parquet\"]");
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let other = with_tables("[\"csv\"]");
    other.run(&["run", "e.toml", "--output", "out"]).ok();
    folder.write("out/results.csv", fs::read(other.path("out/results.csv")).unwrap());
    for command in [["report", "out"], ["gate", "out"]] {
        folder.run(&command).fails(3, &["results.csv", "run.json has no checksum of it"]);
    }
}

#[test]
fn a_run_without_it_takes_an_old_one_away() {
    let folder = with_tables("[\"csv\", \"parquet\"]");
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    assert!(folder.path("out/results.parquet").exists());
    folder.write("e.toml", experiment(GATE));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    assert!(!folder.path("out/results.parquet").exists());
}

#[test]
fn mistakes_in_the_list_are_shown() {
    for (tables, words) in [
        ("[]", "tables"),
        ("[\"xlsx\"]", "parquet"),
        ("[\"csv\", \"csv\"]", "\"csv\" appears twice"),
        ("\"csv\"", "tables"),
    ] {
        with_tables(tables).run(&["check", "e.toml"]).fails(2, &["e.toml", words]);
    }
}
