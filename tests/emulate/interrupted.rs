//! Emulated methods in runs that are divided, broken off and gone on with: their temporal filter depends
//! on all frames before.

use std::fs;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{bytes, rows};
use crate::runs::interrupted_runs::{FRAMES, journal, write_sequence};
use crate::runs::resume::{cuts, goes_on};
use crate::runs::shards::divided;

const HEAD: &str = "name = \"e\"\n[view]\ndisplay = \"htc-vive-pro\"\nbands_deg = [0, 10, 30]\n\
                    [signal]\ntransfer = \"srgb\"\n[[scene]]\nname = \"moving\"\n\
                    reference = \"moving/gt\"\nfps = 24\ngaze = { trace = \"gaze.csv\" }\n";

const METRICS: &str = "[metrics]\nmse = {}\natd = {}\nfvvdp = {}\n[[plot]]\nkind = \"table\"\n";

const FILTERED: &str = "[[method]]\nname = \"R\"\nemulate = { model = \"cps\", temporal = true }\n\
                        [[method]]\nname = \"A\"\ntest = \"moving/a\"\n\
                        [[method]]\nname = \"K\"\nemulate = { model = \"kfr\", sigma = 2 }\n";

fn sequence(methods: &str, metrics: &str) -> Folder {
    let folder = Folder::new();
    write_sequence(&folder);
    folder.write("e.toml", format!("{HEAD}{methods}{metrics}"));
    folder
}

#[test]
fn a_temporal_filter_goes_on_wherever_a_run_is_divided() {
    let folder = sequence(FILTERED, METRICS);
    for of in [3 * FRAMES, FRAMES, 5, 2] {
        assert_eq!(divided(&folder, of, 0), vec![0; of]);
    }
    // The filter alone: no metric needs the frames before.
    let folder = sequence(FILTERED, "[metrics]\nmse = {}\n");
    for of in [3 * FRAMES, 4] {
        assert_eq!(divided(&folder, of, 0), vec![0; of]);
    }
}

#[test]
fn a_temporal_filter_goes_on_after_a_kill() {
    let folder = sequence(FILTERED, "[metrics]\nmse = {}\n[[plot]]\nkind = \"table\"\n");
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    goes_on(&folder, 0, &cuts(&journal(&folder, "whole"), "filtered"), "2");
}

/// Methods without the filter can be looked ahead at, methods with it cannot.
#[test]
fn a_metric_that_looks_ahead_has_emulated_frames() {
    let ahead = METRICS.replace("fvvdp = {}", "fvvdp = { temp_padding = \"circular\" }");
    let unfiltered = FILTERED.replace(", temporal = true", "");
    let folder = sequence(&unfiltered, &ahead);
    assert_eq!(divided(&folder, 5, 0), vec![0; 5]);
    let folder = sequence(FILTERED, &ahead);
    folder
        .run(&["run", "e.toml", "--output", "out"])
        .fails(2, &["the temporal filter of cps needs the frames in their order"]);
}

/// After a missing frame the filter begins again: its motion would lead to another frame.
#[test]
fn the_filter_begins_again_behind_a_gap() {
    let filter = "[[method]]\nname = \"T\"\nemulate = { model = \"taa\" }\n";
    let folder = sequence(filter, "[metrics]\nmse = {}\n");
    fs::remove_file(folder.path("moving/gt/0004.exr")).unwrap();
    let run = folder.run(&["run", "e.toml", "--output", "out"]).ok();
    run.says(&["no frame comes directly before frame 5: the temporal filter begins again there"]);
    let rows = rows(&folder, "out");
    let mse = rows.iter().filter(|row| row["metric"] == "mse" && row["from_deg"].is_empty());
    let passed = mse.filter(|row| row["value"].parse::<f64>().unwrap() == 0.0);
    let passed: Vec<&str> = passed.map(|row| row["frame"].as_str()).collect();
    assert_eq!(passed, ["0", "5"]);
}

#[test]
fn a_filter_without_motion_says_so_and_goes_on() {
    let filter = "[[method]]\nname = \"T\"\nemulate = { model = \"taa\" }\n";
    let folder = sequence(&format!("motion = \"none\"\n{filter}"), "[metrics]\nmse = {}\n");
    let run = folder.run(&["run", "e.toml", "--output", "out"]).ok();
    run.says(&["takes every pixel as standing still"]);
    // Channels that are named must exist.
    folder.write(
        "e.toml",
        format!(
            "{HEAD}motion = {{ channels = [\"no.X\", \"no.Y\"] }}\n{filter}[metrics]\nmse = {{}}\n"
        ),
    );
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    run.says(&["no.X"]);
}

/// Frames that are kept are written again if they are lacking, and shards have theirs.
#[test]
fn kept_frames_are_part_of_what_is_finished() {
    let keep = "[[method]]\nname = \"K\"\nemulate = { model = \"rmfr\", keep_frames = true }\n";
    let folder = sequence(keep, "[metrics]\nmse = {}\n[[plot]]\nkind = \"table\"\n");
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    let wanted = bytes(&folder.path("whole"));
    assert_eq!(wanted.keys().filter(|name| name.starts_with("emulated/")).count(), FRAMES);
    fs::remove_file(folder.path("whole/emulated/moving/K/0003.png")).unwrap();
    folder.run(&["run", "e.toml", "--output", "whole", "--resume"]).ok();
    assert_eq!(bytes(&folder.path("whole")), wanted);
    assert_eq!(divided(&folder, 3, 0), vec![0; 3]);
}
