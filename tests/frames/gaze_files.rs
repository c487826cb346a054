//! Gaze traces as people and trackers write them.

use std::fs;

use fovqa_testkit::synthetic::codes;
use serde_json::json;

use crate::fovqa::{Folder, Run, root};

/// Two frames of 16x12.
fn two_frames() -> Folder {
    let folder = Folder::new();
    for frame in 0..2 {
        folder.png(&format!("gt/{frame}.png"), 16, 12, &codes(16, 12, 3, frame));
    }
    folder
}

fn score(folder: &Folder, gaze: &str, more: &[&str]) -> Run {
    let arguments = [
        "gt",
        "gt",
        "--metrics",
        "psnr",
        "--fov-vertical",
        "60",
        "--format",
        "json",
        "--gaze",
        gaze,
    ];
    folder.score(&[&arguments, more].concat())
}

#[test]
fn numbers_of_frames_are_exact_however_large() {
    let folder = Folder::new();
    let case = root().join("tests/cases/gaze-large-numbers");
    for name in ["frame.csv", "epoch.csv"] {
        fs::copy(case.join(name), folder.path(name)).unwrap();
    }
    for number in [0, 1, 2] {
        let name = format!("gt/169999999999{number}.png");
        fs::copy(case.join(&name), folder.path(&name)).unwrap();
    }
    let json = score(&folder, "frame.csv", &[]).ok().json();
    assert_eq!(json["frames"][2]["frame"], 1_699_999_999_992_i64);
    assert_eq!(json["frames"][2]["gaze_px"], json!([12.0, 5.0]));
    for more in [&["--fps", "90"][..], &["--fps", "90", "--gaze-hold"]] {
        score(&folder, "epoch.csv", more).fails(
            3,
            &["times start at 0 with the first frame", "subtract the time of the first frame"],
        );
    }
}

#[test]
fn separators_and_encodings_are_read() {
    let folder = two_frames();
    let text = "frame;note;x_px;y_px\r\n0;a,b;3.5;4\r\n1;;5;6\r\n";
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    folder.write("semicolons.csv", text);
    folder.write("tabs.tsv", format!("\u{feff}{}", text.replace(';', "\t")));
    folder.write("wide.csv", [&[0xff, 0xfe][..], &utf16].concat());
    for file in ["semicolons.csv", "tabs.tsv", "wide.csv"] {
        let json = score(&folder, file, &[]).ok().json();
        assert_eq!(json["frames"][0]["gaze_px"], json!([3.5, 4.0]), "{file}");
    }
    folder.write("comma.csv", "frame;x_px;y_px\n0;3,5;4\n");
    score(&folder, "comma.csv", &[]).fails(3, &["x_px has \"3,5\"", "decimal point"]);
    folder.write("comma.csv", "frame,x_px,y_px\n0,3,5,4\n");
    score(&folder, "comma.csv", &[]).fails(3, &["decimal point"]);
}

#[test]
fn exports_of_trackers_are_told_what_to_do() {
    let folder = two_frames();
    let exports = [
        (
            "Recording timestamp\tGaze point X\tGaze point Y\tValidity left\n0\t1\t2\tValid\n",
            "Tobii",
        ),
        ("gaze_timestamp,world_index,confidence,norm_pos_x,norm_pos_y\n0,0,1,0.5,0.5\n", "Pupil"),
        ("raw_timestamp,status,gaze_forward_x,gaze_forward_y\n0,2,0,0\n", "Varjo"),
        ("t,x,y\n0,1,2\n", "its columns are: t, x, y"),
    ];
    for (text, words) in exports {
        folder.write("gaze.csv", text);
        score(&folder, "gaze.csv", &[]).fails(3, &[words, "frame,x_px,y_px", "it has no column"]);
    }
    folder.write("gaze.csv", "frame,x_px,y_px\n0,3,4\n0,3,5\n1,3,4\n");
    score(&folder, "gaze.csv", &[])
        .fails(3, &["line 3", "already a row for frame 0", "one row per frame"]);
}

#[test]
fn samples_that_are_not_valid_are_no_gaze() {
    let folder = two_frames();
    folder.write("gaze.csv", "frame,x_px,y_px,valid\n0,3,4,1\n1,0,0,0\n");
    let json = score(&folder, "gaze.csv", &[]).ok().json();
    assert_eq!(json["frames"][1]["gaze_px"], json!([3.0, 4.0]));
    assert_eq!(json["gaze_held"], 1);
    folder.write("gaze.csv", "frame,x_px,y_px,Confidence\n0,3,4,1\n1,0,0,0\n");
    score(&folder, "gaze.csv", &[]).ok().says(&["not applied: Confidence"]);
}

#[test]
fn shares_of_the_frame_are_questioned() {
    let folder = two_frames();
    folder.write("gaze.csv", "frame,x_px,y_px\n0,0.5,0.5\n1,0.25,1.03\n");
    let words = ["look like fractions of the frame", "multiply x_px by the frame's width"];
    score(&folder, "gaze.csv", &[]).fails(3, &words);
    score(&folder, "0.5,0.5", &[]).ok().says(&["is in the first pixel"]);
    let corner = score(&folder, "0,0", &[]).ok();
    assert!(!corner.stderr.contains("first pixel"), "{}", corner.stderr);
    folder.write("gaze.csv", "time_s,x_px,y_px\n0,5,5\n11,6,6\n22,7,7\n");
    let held = score(&folder, "gaze.csv", &["--fps", "90", "--gaze-hold"]).ok();
    held.says(&["time_s increases by 11 s from row to row"]);
}
