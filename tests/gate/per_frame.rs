//! Rules per frame: each frame is held against the limits and against the same frame of the baseline.

use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::Folder;
use crate::gate::experiments::{NOISE, SIZE, experiment, gate, near, only, sequence};
use crate::runs::experiment_folder::rows;

const METRICS: &str = "[metrics]\nmse = {}\npsnr = {}\nssim = {}\nhaar = { levels = 1 }\n";

fn text(rule: &str) -> String {
    experiment("fov_vertical_deg = 60\nbands_deg = [0, 10, 50]", "", &format!("{METRICS}{rule}"))
}

/// The value of each frame in the table.
fn values(folder: &Folder, metric: &str, band: &str) -> Vec<f64> {
    let rows = rows(folder, "reports/e").into_iter();
    let of = rows.filter(|row| {
        let from: Option<f64> = row["from_deg"].parse().ok();
        row["metric"] == metric && from == band.parse().ok()
    });
    of.map(|row| row["value"].parse().unwrap()).collect()
}

fn frames(check: &Value) -> Vec<i64> {
    let frames = check["frames"].as_array().map(Vec::as_slice).unwrap_or_default();
    frames.iter().map(|frame| frame["frame"].as_i64().unwrap()).collect()
}

#[test]
fn each_frame_is_held_against_a_limit() {
    let folder = sequence();
    folder.write("e.toml", text(""));
    folder.run(&["run", "e.toml"]).ok();
    let psnr = values(&folder, "psnr", "");
    // Between the second worst frame and the third.
    let mut sorted = psnr.clone();
    sorted.sort_by(f64::total_cmp);
    let limit = f64::midpoint(sorted[1], sorted[2]);
    let rule = format!("[[gate]]\nmetric = \"psnr\"\nper_frame = true\nat_least = {limit}\n");
    let (run, verdict) = gate(&folder, &text(&rule), &[]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    let check = only(&verdict);
    assert_eq!(frames(check), [1, 2], "the worst first");
    near("value", &check["value"], sorted[0]);
    near("margin", &check["margin"], sorted[0] - limit);
    near("second", &check["frames"][1]["value"], psnr[2]);
    assert_eq!(verdict["rules"][0]["quantity"], "psnr per frame");
    assert!(
        check["reason"].as_str().unwrap().starts_with("2 of 5 frames fail, worst is frame 1: ")
    );
    // An identical frame is infinitely good, and a limit that all keep is kept.
    let rule = format!("[[gate]]\nmetric = \"psnr\"\nper_frame = true\nat_least = {}\n", sorted[0]);
    let (run, verdict) = gate(&folder, &text(&rule), &[]);
    assert_eq!(run.code, 0);
    assert_eq!(frames(only(&verdict)), [0; 0]);
    near("value", &only(&verdict)["value"], sorted[0]);
}

#[test]
fn one_frame_of_a_sequence_cannot_hide_in_the_mean() {
    let rule = "[[gate]]\nmetric = \"ssim\"\nper_frame = true\nmax_drop = 0.001\n\
                [[gate]]\nmetric = \"mse\"\nper_frame = true\nband_deg = [0, 10]\nmax_rise = \"1%\"\n\
                [[gate]]\nmetric = \"ssim\"\nmax_drop = 0.05\n";
    let folder = sequence();
    folder.write("e.toml", text(rule));
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "b.json"]).ok();
    let before = [values(&folder, "ssim", ""), values(&folder, "mse", "0")];
    let (run, verdict) = gate(&folder, &text(rule), &["--baseline", "b.json"]);
    assert_eq!(run.code, 0, "{verdict:#}");
    // Frame 3 was the reference; now it has as much noise as frame 0.
    let reference = codes(SIZE.0, SIZE.1, 3, 4);
    folder.png("test/0003.png", SIZE.0, SIZE.1, &disturbed(&reference, NOISE[0], 8));
    let (run, verdict) = gate(&folder, &text(rule), &["--baseline", "b.json"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    let now = [values(&folder, "ssim", ""), values(&folder, "mse", "0")];
    let rules = verdict["rules"].as_array().unwrap();
    for (rule, (before, now)) in rules.iter().zip(before.iter().zip(&now)) {
        let check = &rule["checks"][0];
        assert_eq!(frames(check), [3], "{rule:#}");
        near("value", &check["value"], now[3]);
        near("baseline", &check["baseline"], before[3]);
        let loss = &check["losses"][0];
        assert_eq!((&loss["frame"], &loss["compared"]), (&3.into(), &"baseline".into()));
        assert!(loss["band"]["from_deg"].is_number(), "{loss:#}");
    }
    near("limit", &rules[0]["checks"][0]["limit"], before[0][3] - 0.001);
    near("limit", &rules[1]["checks"][0]["limit"], before[1][3] * 1.01);
    assert_eq!(rules[2]["state"], "passed");
}

#[test]
fn frames_that_are_only_on_one_side_are_no_pass() {
    let rule = "[[gate]]\nmetric = \"psnr\"\nper_frame = true\nmax_drop = 90\n";
    let folder = sequence();
    folder.write("e.toml", text(rule));
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "b.json"]).ok();
    fs::rename(folder.path("test/0004.png"), folder.path("gone.png")).unwrap();
    fs::rename(folder.path("gt/0004.png"), folder.path("gone-too.png")).unwrap();
    let (run, verdict) = gate(&folder, &text(rule), &["--baseline", "b.json"]);
    assert_eq!(run.code, 3);
    let reason = only(&verdict)["reason"].as_str().unwrap();
    assert_eq!(reason, "the baseline has psnr per frame of frame 4, but the run does not");
}

/// A baseline of an earlier version has no values of single frames: other rules use it as before.
#[test]
fn a_baseline_without_frames_is_read() {
    let rules = "[[gate]]\nmetric = \"psnr\"\nmax_drop = 0.5\n[[gate]]\nmetric = \"psnr\"\n\
                 per_frame = true\nmax_drop = 0.5\n";
    let folder = sequence();
    folder.write("e.toml", text(rules));
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "b.json"]).ok();
    let mut baseline: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("b.json")).unwrap()).unwrap();
    let comparison = baseline["comparisons"][0].as_object_mut().unwrap();
    assert!(comparison.remove("per_frame").is_some());
    folder.write("old.json", serde_json::to_string(&baseline).unwrap());
    let (run, verdict) = gate(&folder, &text(rules), &["--baseline", "old.json"]);
    assert_eq!(run.code, 1);
    assert_eq!(verdict["rules"][0]["state"], "passed");
    let reason = verdict["rules"][1]["checks"][0]["reason"].as_str().unwrap();
    assert!(
        reason.contains("no values of single frames of s, A; `fovqa baseline accept`"),
        "{reason}"
    );
    // What is damaged is an error, not a verdict.
    let text_of = fs::read_to_string(folder.path("b.json")).unwrap();
    folder.write("bad.json", text_of.replace("\"0..4\"", "\"0..9223372036854775807\""));
    folder
        .run(&["gate", "e.toml", "--baseline", "bad.json"])
        .fails(3, &["bad.json", "its frames of s, A do not have a value each"]);
}

#[test]
fn mistakes_in_rules_per_frame_are_underlined() {
    let folder = sequence();
    for (rule, words) in [
        (
            "metric = \"psnr\"\nper_frame = true\naggregate = \"min\"\nat_least = 1",
            ["there is no min", "leave out aggregate or per_frame"],
        ),
        (
            "metric = \"psnr\"\nstatistic = \"pooled\"\nper_frame = true\nat_least = 1",
            ["pooled describes the whole sequence", "leave out statistic"],
        ),
        ("metric = \"psnr\"\nper_frame = 1\nat_least = 1", ["per_frame", "true"]),
    ] {
        folder.write("e.toml", text(&format!("[[gate]]\n{rule}\n")));
        folder.run(&["check", "e.toml"]).fails(2, &words);
    }
}

#[test]
fn of_several_baselines_the_best_match_counts() {
    let rule = "[[gate]]\nmetric = \"psnr\"\nmax_drop = 0.1\n";
    let folder = sequence();
    folder.write("e.toml", text(rule));
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "here.json"]).ok();
    // A machine whose renders are better by 3 dB: this run would fail against it.
    for (frame, noise) in NOISE.iter().enumerate() {
        let reference = codes(SIZE.0, SIZE.1, 3, 1 + frame as u64);
        folder.png(
            &format!("test/{frame:04}.png"),
            SIZE.0,
            SIZE.1,
            &disturbed(&reference, noise * 0.7, 8),
        );
    }
    folder.run(&["run", "e.toml", "--output", "better"]).ok();
    folder.run(&["baseline", "save", "better", "there.json"]).ok();
    let alone = folder.run(&["gate", "reports/e", "--baseline", "there.json"]);
    assert_eq!(alone.code, 1);
    for both in [["here.json", "there.json"], ["there.json", "here.json"]] {
        let run = folder
            .run(&[
                "gate",
                "reports/e",
                "--baseline",
                both[0],
                "--baseline",
                both[1],
                "--format",
                "json",
            ])
            .ok();
        assert_eq!(run.json()["baseline"], "here.json");
    }
    // The experiment may name them, relative to itself.
    let named = format!("baseline = [\"there.json\", \"here.json\"]\n{}", text(rule));
    folder.write("e.toml", named);
    let run = folder.run(&["gate", "e.toml", "--output", "again"]).ok();
    assert!(run.stdout.contains("compared with there.json, the best match"), "{}", run.stdout);
    // One that was measured otherwise is passed over, if another fits.
    let other = text(rule).replace("fov_vertical_deg = 60", "fov_vertical_deg = 50");
    folder.write("other.toml", other);
    folder.run(&["run", "other.toml", "--output", "other"]).ok();
    folder.run(&["baseline", "save", "other", "other.json"]).ok();
    let run =
        folder.run(&["gate", "again", "--baseline", "other.json", "--baseline", "there.json"]).ok();
    assert!(
        run.stdout.contains("note: other.json: the baseline's values were measured differently")
    );
    folder
        .run(&["gate", "again", "--baseline", "other.json"])
        .fails(3, &["other.json: the baseline's values were measured differently"]);
}
