//! The values of shards as a Parquet data set.

use std::fs;

use crate::fovqa::Folder;
use crate::runs::interrupted_runs::{assert_same, results, sequence, two_scenes};
use crate::runs::parquet::{cells, cells_of_csv};
use crate::runs::shards::{names, shard};

/// Scores an experiment as a whole and in shards, and merges them with their values.
fn with_values(folder: &Folder, of: usize) {
    folder.run(&["run", "e.toml", "--output", "whole"]);
    for index in 1..=of {
        shard(folder, "s", index, of);
    }
    let shards = names("s", of);
    let shards: Vec<&str> = shards.iter().map(String::as_str).collect();
    folder.run(&[&["merge"][..], &shards, &["--output", "merged", "--values"]].concat());
    let mut merged = results(&folder.path("merged"));
    merged.retain(|name, _| !name.starts_with("values/"));
    assert_same(&merged, &results(&folder.path("whole")), "merged");
}

fn part(index: usize, of: usize) -> String {
    format!("merged/values/{index:05}-of-{of:05}.parquet")
}

/// Compares the rows of all files with those of results.csv, in whichever order.
#[track_caller]
fn assert_all_rows(folder: &Folder, of: usize) {
    let mut expected = cells_of_csv(folder, "merged/results.csv");
    let header = expected.remove(0);
    let mut found = Vec::new();
    let files = (1..=of).map(|index| part(index, of));
    for file in files.chain(["merged/values/sequences.parquet".to_owned()]) {
        let mut rows = cells(folder, &file);
        assert_eq!(rows.remove(0), header, "{file}");
        found.extend(rows);
    }
    expected.sort();
    found.sort();
    assert!(!found.is_empty() && found == expected, "{} of {}", found.len(), expected.len());
}

#[test]
fn have_together_the_rows_of_the_results() {
    let folder = two_scenes();
    for of in [1, 3, 36] {
        with_values(&folder, of);
        assert_all_rows(&folder, of);
        let first = fs::read(folder.path(&part(1, of))).unwrap();
        assert!(first == fs::read(folder.path(&format!("s-1-of-{of}/values.parquet"))).unwrap());
        // Of sequences and of both eyes, no shard knows anything.
        let others = cells(&folder, "merged/values/sequences.parquet");
        assert!(others[1..].iter().all(|row| row[3] == "both" || row[4].is_empty()));
        assert_eq!(fs::read_dir(folder.path("merged/values")).unwrap().count(), of + 1);
    }
    // Another run in the folder has no such values.
    folder.run(&["run", "e.toml", "--output", "merged"]).ok();
    assert!(!folder.path("merged/values").exists());
}

/// After a frame that cannot be read, FovVideoVDP has no values, which later shards do not know.
#[test]
fn end_where_a_sequence_is_interrupted() {
    let folder = sequence("replicate");
    folder.write("moving/a/0001.exr", "no picture");
    with_values(&folder, 6);
    assert_all_rows(&folder, 6);
    let has_fvvdp = |file: &str| {
        let is_of_a = |row: &Vec<String>| row[1] == "A" && row[6] == "fvvdp" && !row[4].is_empty();
        cells(&folder, file).iter().any(is_of_a)
    };
    let has: Vec<bool> = (1..=6).map(|index| has_fvvdp(&part(index, 6))).collect();
    assert_eq!(has, [true, false, false, false, false, false]);
    // Its frames are too far behind for the shard itself to know, and its own file is not changed.
    assert!(has_fvvdp("s-6-of-6/values.parquet"));
}

#[test]
fn that_a_shard_lacks_are_written_again() {
    let folder = two_scenes();
    with_values(&folder, 2);
    let before = fs::read(folder.path(&part(2, 2))).unwrap();
    fs::remove_file(folder.path("s-2-of-2/values.parquet")).unwrap();
    with_merged_again(&folder);
    assert!(fs::read(folder.path(&part(2, 2))).unwrap() == before);
    // A shard that goes on has them again.
    folder.run(&["run", "e.toml", "--shard", "2/2", "--resume", "--output", "s-2-of-2"]).ok();
    assert!(fs::read(folder.path("s-2-of-2/values.parquet")).unwrap() == before);
}

fn with_merged_again(folder: &Folder) {
    folder.run(&["merge", "s-1-of-2", "s-2-of-2", "--output", "merged", "--values"]).ok();
}
