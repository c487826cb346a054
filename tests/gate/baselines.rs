//! Rules that are compared with a baseline, and baselines that are refused.

use std::fs;

use serde_json::json;

use crate::fovqa::Folder;
use crate::gate::baseline_command::{DROP, METRICS, against, edit, read, saved};
use crate::gate::experiments::{near, number};
use crate::runs::experiment_folder::experiment;

#[test]
fn drops_and_rises_are_in_units_and_percent() {
    for (limit, metric, name, before, holds) in [
        ("max_drop = 0.5", "psnr", "psnr mean", 1.0, true),
        ("max_drop = 0.5", "psnr", "psnr mean", 1.01, true),
        ("max_drop = 0.5", "psnr", "psnr mean", 1.03, false),
        ("max_drop = \"2%\"", "psnr", "psnr mean", 1.0 / 0.981, true),
        ("max_drop = \"2%\"", "psnr", "psnr mean", 1.0 / 0.979, false),
        ("max_rise = \"10 %\"", "mse", "mse mean", 1.0 / 1.09, true),
        ("max_rise = \"10 %\"", "mse", "mse mean", 1.0 / 1.11, false),
        ("max_rise = 1e-9", "mse", "mse mean", 1.0, true),
        ("max_rise = 1e-9", "mse", "mse mean", 0.999, false),
    ] {
        let rule =
            format!("[[gate]]\nmetric = \"{metric}\"\nscene = \"room\"\nmethod = \"A\"\n{limit}\n");
        let folder = saved(&rule);
        let mut was = 0.0;
        edit(&folder, |baseline| {
            let of = baseline["comparisons"].as_array_mut().unwrap().iter_mut();
            let mut of = of.filter(|c| c["scene"] == "room" && c["method"] == "A");
            let value = &mut of.next().unwrap()["values"][name];
            *value = json!(number(value) * before);
        });
        let baseline = read(&folder, "b.json");
        for comparison in baseline["comparisons"].as_array().unwrap() {
            if comparison["scene"] == "room" && comparison["method"] == "A" {
                was = number(&comparison["values"][name]);
            }
        }
        let run = against(&folder);
        assert_eq!(run.code, i32::from(!holds), "{limit} {before}: {}", run.stdout);
        let verdict = run.json();
        let check = &verdict["rules"][0]["checks"][0];
        near("baseline", &check["baseline"], was);
        let (_, limit) = limit.split_once(" = ").unwrap();
        let allowance = match limit.trim_matches('"').strip_suffix('%') {
            Some(percent) => was * percent.trim().parse::<f64>().unwrap() / 100.0,
            None => limit.parse().unwrap(),
        };
        let value = number(&check["value"]);
        let margin =
            if metric == "mse" { was + allowance - value } else { value - was + allowance };
        assert!((number(&check["margin"]) - margin).abs() < 1e-12, "{check:#}");
        if !holds {
            let reason = check["reason"].as_str().unwrap();
            assert!(reason.contains(&format!("(baseline {was})")), "{reason}");
        }
    }
}

#[test]
fn infinity_on_either_side_is_compared() {
    for (limit, before, identical, code) in [
        ("0.5", "inf", true, 0),
        ("\"2%\"", "inf", true, 0),
        ("0.5", "inf", false, 1),
        ("\"2%\"", "inf", false, 1),
        ("\"0%\"", "inf", false, 1),
        ("0.5", "", true, 0),
        ("\"2%\"", "", true, 0),
    ] {
        let rule = format!(
            "[[gate]]\nmetric = \"psnr\"\nscene = \"room\"\nmethod = \"A\"\nmax_drop = {limit}\n"
        );
        let folder = saved(&rule);
        if before == "inf" {
            edit(&folder, |baseline| {
                for comparison in baseline["comparisons"].as_array_mut().unwrap() {
                    comparison["values"]["psnr mean"] = json!("inf");
                }
            });
        }
        if identical {
            for frame in 0..3 {
                let [gt, test] =
                    ["gt", "a"].map(|of| folder.path(&format!("room/{of}/{frame:04}.png")));
                fs::copy(gt, test).unwrap();
            }
        }
        let run = against(&folder);
        assert_eq!(run.code, code, "{limit} {before} {identical}: {}", run.stdout);
    }
}

#[test]
fn what_is_on_one_side_alone_fails_and_says_so() {
    let folder = saved(DROP);
    let remove = |folder: &Folder, scene: &str, method: &str| {
        edit(folder, |baseline| {
            let all = baseline["comparisons"].as_array_mut().unwrap();
            all.retain(|c| c["scene"] != scene || (!method.is_empty() && c["method"] != method));
        });
    };
    let original = fs::read(folder.path("b.json")).unwrap();
    for (scene, method, words) in [
        ("hall", "", "the baseline has no scene hall"),
        ("hall", "B", "the baseline has no B in scene hall"),
    ] {
        remove(&folder, scene, method);
        let run = against(&folder);
        assert_eq!(run.code, 1, "{}", run.stdout);
        assert!(run.stdout.contains(words), "{words}: {}", run.stdout);
        folder.write("b.json", &original);
    }
    edit(&folder, |baseline| {
        let values = baseline["comparisons"][0]["values"].as_object_mut().unwrap();
        values.remove("psnr min");
    });
    let run = against(&folder);
    assert_eq!(run.code, 1);
    assert!(run.stdout.contains("the baseline has no psnr min of hall, A"), "{}", run.stdout);
    folder.write("b.json", &original);
    // And on the other side.
    let text = experiment(&format!("{METRICS}{DROP}"));
    let gone = text.replace("[[scene]]\nname = \"hall\"\nreference = \"{scene}/gt\"\n", "");
    folder.write("e.toml", gone);
    let run = against(&folder);
    assert_eq!(run.code, 1, "{}", run.stdout);
    assert!(
        run.stdout.contains("the baseline has hall, A, but the run does not"),
        "{}",
        run.stdout
    );
    // A rule that is of another scene holds, with a note.
    let rule = DROP.replace("[[gate]]\n", "[[gate]]\nscene = \"room\"\n");
    let text = experiment(&format!("{METRICS}{rule}"));
    folder.write(
        "e.toml",
        text.replace("[[scene]]\nname = \"hall\"\nreference = \"{scene}/gt\"\n", ""),
    );
    let verdict = against(&folder).ok().json();
    assert!(
        verdict["notes"].to_string().contains("the baseline has hall, B, but the run does not")
    );
}

#[test]
fn values_that_were_taken_otherwise_are_refused() {
    let folder = saved(DROP);
    let original = fs::read(folder.path("b.json")).unwrap();
    edit(&folder, |baseline| baseline["metrics"]["psnr"]["version"] = json!(7));
    against(&folder)
        .fails(3, &["it has version 7 of psnr, but this fovqa has version", "baseline accept"]);
    folder.write("b.json", &original);
    edit(&folder, |baseline| baseline["metrics"]["ssim"]["parameters"]["sigma"] = json!(2));
    against(&folder).fails(3, &["it has ssim.sigma = 2 instead of 1.5"]);
    folder.write("b.json", &original);
    let good = experiment(&format!("{METRICS}{DROP}"));
    let room = "reference = \"room/gt\"";
    for (place, change, words) in [
        ("fov_vertical_deg = 60", "fov_vertical_deg = 61", "view.fov_vertical_deg = 60.0 in scene"),
        ("ssim = {}", "ssim = { k1 = 0.02 }", "it has ssim.k1 = 0.01 instead of 0.02"),
        (room, "reference = \"room/gt\"\nfps = 30", "fps = null in scene room instead of 30"),
        (room, "reference = \"room/gt\"\nframes = \"0..2\"", "frames = null in scene room"),
        (
            room,
            "reference = \"room/gt\"\nchannels = \"luma\"",
            "signal.channels = \"rgb\" in scene room",
        ),
        (room, "reference = \"room/gt\"\ngaze = [3, 4]", "view.gaze = \"center\" in scene room"),
        (
            room,
            "reference = \"room/gt\"\nbands_deg = [0, 5]",
            "view.bands_deg = null in scene room",
        ),
        (
            room,
            "reference = \"room/gt\"\nexposure_stops = 1",
            "signal.exposure_stops = 0.0 in scene",
        ),
    ] {
        folder.write("e.toml", good.replacen(place, change, 1));
        fs::remove_dir_all(folder.path("reports")).unwrap();
        against(&folder).fails(3, &["measured differently", words]);
        assert!(!folder.path("reports/e/results.csv").exists(), "before anything is scored");
    }
    folder.write("e.toml", &good);
    folder
        .run(&["gate", "e.toml", "--baseline", "b.json", "--frames", "0..2"])
        .fails(3, &["--frames = null instead of \"0..2:1\""]);
    // Other limits, and what does not change a value, are none of it.
    folder
        .write("e.toml", good.replace("max_drop = 0.5", "max_drop = 1").replace("ssim = {}\n", ""));
    against(&folder).ok();
}

#[test]
fn other_frames_are_no_baseline_and_other_inputs_are_noted() {
    let folder = saved(DROP);
    let verdict = against(&folder).ok().json();
    assert_eq!(verdict["notes"], json!([]));
    fs::copy(folder.path("room/gt/0001.png"), folder.path("room/a/0001.png")).unwrap();
    let verdict = against(&folder).ok().json();
    assert_eq!(verdict["notes"], json!(["the inputs in room/a differ from those of the baseline"]));
    for of in ["gt", "a", "b"] {
        fs::remove_file(folder.path(&format!("room/{of}/0002.png"))).unwrap();
    }
    let run = against(&folder);
    assert_eq!(run.code, 3, "{}", run.stdout);
    assert!(run.stdout.contains("the baseline has 3 frames, but the run has 2"), "{}", run.stdout);
}
