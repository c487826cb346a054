//! A run with very many inputs lists them in a file of their own, so that run.json stays small.

use std::fs;

use serde_json::Value;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::json;
use crate::runs::interrupted_runs::{assert_same, results};

/// A run lists up to 10,000 inputs itself.
const MOST: usize = 10_000;

/// A sequence of so many frames of 4x4 pixels.
fn folder(frames: usize) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        folder.png(&format!("gt/{frame:05}.png"), 4, 4, &[90; 48]);
        folder.png(&format!("a/{frame:05}.png"), 4, 4, &[(91 + frame % 100) as u8; 48]);
    }
    folder.write(
        "e.toml",
        "name = \"e\"\nplausibility = \"off\"\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n\
         [[method]]\nname = \"A\"\ntest = \"a\"\n[metrics]\nmse = {}\n[report]\nframes = []\n\
         [[plot]]\nkind = \"table\"\n[[gate]]\nmetric = \"mse\"\nat_most = 1.0\n",
    );
    folder
}

fn inputs(folder: &Folder, run: &str) -> usize {
    json(folder, run)["inputs"].as_array().map_or(0, Vec::len)
}

#[test]
fn are_in_a_file_of_their_own() {
    let folder = folder(MOST / 2 + 1);
    folder.run(&["run", "e.toml", "--output", "few", "--frames", "0..5000"]).ok();
    assert_eq!(inputs(&folder, "few/run.json"), MOST);
    assert!(!folder.path("few/inputs.csv").exists());
    assert_eq!(json(&folder, "few/run.json")["inputs_file"], Value::Null);

    folder.run(&["run", "e.toml", "--output", "many"]).ok();
    let run = json(&folder, "many/run.json");
    assert_eq!((inputs(&folder, "many/run.json"), &run["inputs_file"]), (0, &"inputs.csv".into()));
    assert!(run["files"]["inputs.csv"].is_string());
    assert!(fs::metadata(folder.path("many/run.json")).unwrap().len() < 4096);
    let listed = fs::read_to_string(folder.path("many/inputs.csv")).unwrap();
    assert_eq!(listed.lines().count(), 1 + MOST + 2);
    let first = folder.path("a/00000.png");
    let row = format!("a/00000.png,{},", fs::metadata(&first).unwrap().len());
    assert!(listed.lines().nth(1).unwrap().starts_with(&row), "{row}");
    let page = fs::read_to_string(folder.path("many/report.html")).unwrap();
    assert!(page.contains("more in inputs.csv") && page.contains("10002 input files"));

    // Everything that reads a run reads them.
    let before = results(&folder.path("many"));
    folder.run(&["report", "many"]).ok();
    folder.run(&["gate", "many"]).ok();
    folder.run(&["run", "e.toml", "--output", "many", "--resume"]).ok();
    let mut after = results(&folder.path("many"));
    after.retain(|name, _| before.contains_key(name));
    assert_same(&after, &before, "again");
    folder.run(&["baseline", "save", "many", "b.json"]).ok();
    folder.run(&["gate", "many", "--baseline", "b.json"]).ok();

    // Shards come to the same.
    for shard in ["1/2", "2/2"] {
        let output = format!("s{}", &shard[..1]);
        folder.run(&["run", "e.toml", "--shard", shard, "--output", &output]).ok();
    }
    folder.run(&["merge", "s1", "s2", "--output", "merged"]).ok();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    assert_same(&results(&folder.path("merged")), &results(&folder.path("whole")), "merged");

    // What was changed is told.
    fs::write(folder.path("many/inputs.csv"), listed.replacen("a/00000", "a/00009", 1)).unwrap();
    folder.run(&["gate", "many"]).fails(3, &["inputs.csv", "checksum"]);
    fs::remove_file(folder.path("many/inputs.csv")).unwrap();
    folder.run(&["report", "many"]).fails(3, &["inputs.csv"]);
    let elsewhere = run.to_string().replace(":\"inputs.csv\"", ":\"../gt/00000.png\"");
    fs::write(folder.path("many/run.json"), elsewhere).unwrap();
    folder.run(&["report", "many"]).fails(3, &["its inputs_file is \"../gt/00000.png\""]);
    // Few inputs again need no list.
    folder.run(&["run", "e.toml", "--output", "merged", "--frames", "0..3"]).ok();
    assert!(!folder.path("merged/inputs.csv").exists());
}
