//! Flicker through the command: frames, gaps, sources of motion, masks, eyes, gates, errors.

use serde_json::{Value, json};

use crate::fovqa::Folder;
use crate::frames::moving_frames::{H, MOTION, SIZE, W, float, motion, moving, noise, part, write};
use crate::runs::experiment_folder::{self, rows};
use fovqa_testkit::exr_files::{File, Part};

/// Signal as it is, in bands around the middle.
const VIEW: [&str; 8] =
    ["--transfer", "srgb", "--fov-vertical", "60", "--bands", "0,10,20,90", "--metrics", "flicker"];

/// A noise pattern that moves with its motion; the test's brightness alternates by 1/32.
fn alternating(frames: usize) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let up = if frame % 2 == 0 { 1.0 / 32.0 } else { -1.0 / 32.0 };
        let gt = moving(1, frame);
        let test = move |x, y| moving(1, frame)(x, y) / 2.0 + 0.25 + up;
        write(&folder, &format!("gt/{frame}.exr"), part(gt).with(&motion(MOTION)));
        write(&folder, &format!("test/{frame}.exr"), part(test));
    }
    folder
}

fn flicker(folder: &Folder, more: &[&str]) -> Value {
    folder.json(&[&["gt", "test"][..], &VIEW, more].concat())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn near(value: &Value, wanted: f64) {
    assert!((number(value) - wanted).abs() < 1e-6, "{value} for {wanted}");
}

#[test]
fn alternation_is_seen_along_the_motion_and_said_for_every_band() {
    let folder = alternating(10);
    let json = flicker(&folder, &["--set", "flicker.detrend=mean"]);
    let of = |frame: usize| &json["frames"][frame];
    assert_eq!(of(6).get("flicker"), None, "eight frames are needed");
    for frame in 7..10 {
        let whole = &of(frame)["flicker"];
        assert_eq!((&whole["reference"], &whole["ratio"]), (&json!(0.0), &Value::Null));
        near(&whole["test"], 1.0 / 32.0);
        // Seven steps of 3 pixels to the right and 2 up lead out of the frame.
        near(&whole["left_out"], 1.0 - ((W - 21) * (H - 14)) as f64 / (W * H) as f64);
        for band in of(frame)["bands"].as_array().unwrap() {
            near(&band["flicker"]["test"], 1.0 / 32.0);
        }
    }
    let all = &json["sequence"]["flicker"];
    near(&all["test"], 1.0 / 32.0);
    assert_eq!(
        (&all["frames"], &all["motion"], &all["depth"]),
        (&json!(3), &json!("reference"), &json!("none"))
    );
    assert_eq!(all["reason"], "the reference is 0");
    // A line through alternating values takes 16/42 of 8 squares away.
    let line = flicker(&folder, &[]);
    near(&line["sequence"]["flicker"]["test"], ((8.0 - 16.0 / 42.0) / 8.0f64).sqrt() / 32.0);
    let still = folder
        .score(&[&["gt", "test"][..], &VIEW, &["--motion", "none", "--format", "json"]].concat())
        .ok();
    let still = still.says(&["Flicker is computed without motion vectors"]).json();
    assert!(number(&still["sequence"]["flicker"]["reference"]) > 0.1);
    assert_eq!(still["sequence"]["flicker"]["left_out"], 0.0);
}

/// Over frames the mean is that of the squares.
#[test]
fn variances_add_up_over_frames() {
    let folder = Folder::new();
    for frame in 0..6 {
        let light = [0.25, 0.5, 0.25, 0.5, 0.5, 0.25][frame];
        folder.png(&format!("gt/{frame}.png"), 8, 8, &[100 + 20 * (frame % 2) as u8; 192]);
        folder.png(&format!("test/{frame}.png"), 8, 8, &[(light * 255.0) as u8; 192]);
    }
    let json = folder.json(&["gt", "test", "--metrics", "flicker", "--set", "flicker.frames=3"]);
    let of = |image: &str| -> Vec<f64> {
        let frames = json["frames"].as_array().unwrap();
        frames[2..].iter().map(|frame| number(&frame["flicker"][image])).collect()
    };
    for image in ["reference", "test"] {
        let squares: f64 = of(image).iter().map(|value| value * value).sum();
        near(&json["sequence"]["flicker"][image], (squares / 4.0).sqrt());
    }
    let options = ["--metrics", "flicker", "--set", "flicker.frames=3", "--format", "csv"];
    let csv = folder.score(&[&["gt", "test"][..], &options].concat()).ok().stdout;
    let pooled = |image: &str| -> f64 {
        let place = format!(",{image},flicker,pooled,,,,");
        let line = csv.lines().find(|line| line.contains(&place)).unwrap();
        line.rsplit(',').next().unwrap().parse().unwrap()
    };
    let all = &json["sequence"]["flicker"];
    near(&all["test"], pooled("test"));
    near(&all["ratio"], pooled("test") / pooled("reference"));
    near(&all["ratio"], pooled("ratio"));
    assert!(
        of("test")[0] > 1.5 * of("test")[3],
        "the last three do not alternate: {:?}",
        of("test")
    );
}

/// What rounding leaves of a drift is nothing.
#[test]
fn a_steady_drift_is_no_flicker_and_has_no_ratio() {
    let folder = Folder::new();
    for frame in 0..10 {
        folder.png(&format!("gt/{frame}.png"), 8, 8, &[60 + 5 * frame as u8; 192]);
        folder.png(&format!("test/{frame}.png"), 8, 8, &[60 + 20 * (frame % 2) as u8; 192]);
    }
    let json = folder.json(&["gt", "test", "--metrics", "flicker", "--plausibility", "off"]);
    let all = &json["sequence"]["flicker"];
    assert_eq!((&all["reference"], &all["ratio"]), (&json!(0.0), &Value::Null), "{all}");
    near(&all["test"], 10.0 / 255.0 * ((8.0 - 16.0 / 42.0) / 8.0f64).sqrt());
}

#[test]
fn too_few_frames_and_gaps_have_no_value_and_say_why() {
    let folder = alternating(5);
    let json = flicker(&folder, &[]);
    let all = &json["sequence"]["flicker"];
    assert_eq!((&all["test"], &all["frames"]), (&Value::Null, &json!(0)));
    assert_eq!(all["reason"], "needs 8 frames");
    let three = ["--set", "flicker.frames=3"];
    assert_eq!(flicker(&folder, &three)["sequence"]["flicker"]["frames"], 3);
    for side in ["gt", "test"] {
        std::fs::remove_file(folder.path(&format!("{side}/2.exr"))).unwrap();
    }
    let gap = flicker(&folder, &three);
    assert_eq!(gap["sequence"]["flicker"]["reason"], "no 3 of the frames follow each other");
    let run = folder.score(&[&["gt", "test"][..], &VIEW, &["--set", "flicker.frames=2"]].concat());
    run.fails(2, &["flicker.frames cannot be 2", "at least 3 with detrend = linear"]);
    let run = folder.score(&[&["gt", "test"][..], &VIEW, &["--set", "flicker.frames=65"]].concat());
    run.fails(2, &["flicker.frames cannot be 65"]);
    // One picture is no sequence.
    let one =
        folder.json(&["gt/0.exr", "test/0.exr", "--transfer", "srgb", "--metrics", "flicker"]);
    assert_eq!(one["sequence"]["flicker"]["reason"], "needs 8 frames");
    // Motion that stops in the middle is an error that names the metric.
    write(&folder, "gt/4.exr", part(moving(1, 4)));
    let run = folder.score(&[&["gt", "test"][..], &VIEW, &three].concat());
    assert_eq!(run.code, 3, "the other frames are scored");
    for said in ["has no motion vectors, but earlier frames have some", "leave flicker out"] {
        assert!(run.stderr.contains(said), "{}", run.stderr);
    }
}

/// Pixels that are not finite, and those of depths that differ, end the paths that touch them.
#[test]
fn paths_end_at_bad_pixels_and_other_depths() {
    let folder = Folder::new();
    for frame in 0..3 {
        let bad = move |x: usize, y: usize| {
            if frame == 1 && x == 20 && y == 10 {
                f32::NAN
            } else {
                noise(frame, x as i64, y as i64)
            }
        };
        let depth = move |x: usize, _| if frame == 0 && x >= 60 { 9.0 } else { 5.0 };
        let still = motion([0.0, 0.0]);
        let gt = part(bad).with(&still).with(&[("Z", float(depth))]);
        write(&folder, &format!("gt/{frame}.exr"), gt);
        write(
            &folder,
            &format!("test/{frame}.exr"),
            part(move |x, y| noise(9, x as i64, y as i64 + frame as i64)),
        );
    }
    let three = ["--set", "flicker.frames=3", "--nonfinite", "mask"];
    let json = flicker(&folder, &three);
    let frame = &json["frames"][2]["flicker"];
    near(&frame["left_out"], (1 + 4 * H) as f64 / (W * H) as f64);
    assert_eq!(json["sequence"]["flicker"]["depth"], "reference");
    let off = flicker(&folder, &[&three[..], &["--set", "atd.depth_tolerance=off"]].concat());
    near(&off["frames"][2]["flicker"]["left_out"], 1.0 / (W * H) as f64);
    // The bad pixel of one method does not touch another one's path, and the reference is measured for each.
    for frame in 0..3 {
        let test = move |x: usize, y: usize| noise(7, x as i64 + frame as i64, y as i64);
        let part = Part::rgb(SIZE, test);
        File::new(vec![part]).write(&folder.path(&format!("other/{frame}.exr")));
        let clean = part_with_depth(frame);
        write(&folder, &format!("gt/{frame}.exr"), clean);
        let holed = move |x: usize, y: usize| {
            if (x, y) == (5, 5) && frame == 0 { f32::NAN } else { test(x, y) }
        };
        write(&folder, &format!("test/{frame}.exr"), part_of(holed));
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[signal]\ntransfer = \"srgb\"\nnonfinite = \"mask\"\n\
         [[scene]]\nname = \"s\"\nreference = \"gt\"\n\
         [[method]]\nname = \"a\"\ntest = \"test\"\n[[method]]\nname = \"b\"\ntest = \"other\"\n\
         [metrics]\nflicker = { frames = 3 }\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let left_out = |index: usize| &summary["comparisons"][index]["flicker"]["left_out"];
    near(left_out(0), 1.0 / (W * H) as f64);
    near(left_out(1), 0.0);
}

fn part_of(value: impl Fn(usize, usize) -> f32) -> Part {
    Part::rgb(SIZE, value)
}

fn part_with_depth(frame: usize) -> Part {
    let still = motion([0.0, 0.0]);
    part_of(move |x, y| noise(frame, x as i64, y as i64))
        .with(&still)
        .with(&[("Z", float(|_, _| 5.0))])
}

#[test]
fn gates_hold_the_ratio_and_the_pooled_value() {
    let folder = alternating(10);
    // A reference that flickers less.
    for frame in 0..10 {
        let up = if frame % 2 == 0 { 1.0 / 64.0 } else { -1.0 / 64.0 };
        let gt = move |x, y| moving(1, frame)(x, y) / 2.0 + 0.25 + up;
        write(&folder, &format!("gt/{frame}.exr"), part(gt).with(&motion(MOTION)));
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\nbands_deg = [0, 10, 20, 90]\n[signal]\ntransfer = \"srgb\"\n\
         [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
         [metrics]\natd = {}\nflicker = { detrend = \"mean\" }\n\
         [[gate]]\nmetric = \"flicker\"\nimage = \"ratio\"\nat_most = 2.1\n\
         [[gate]]\nmetric = \"flicker\"\nband_deg = [0, 10]\nat_most = 0.04\n\
         [[gate]]\nmetric = \"flicker\"\naggregate = \"max\"\nat_most = 0.03\n\
         [[gate]]\nmetric = \"flicker\"\nstatistic = \"pooled\"\nat_most = 0.04\n\
         [[gate]]\nmetric = \"flicker\"\nstatistic = \"pooled\"\nimage = \"ratio\"\nband_deg = [10, 20]\nat_most = 2.1\n\
         [[gate]]\nmetric = \"flicker\"\nstatistic = \"pooled\"\nimage = \"ratio\"\nat_most = 2.1\n",
    );
    let verdict = folder.run(&["gate", "e.toml", "--format", "json"]);
    assert_eq!(verdict.code, 1, "{}", verdict.stderr);
    let verdict = verdict.json();
    let check = |rule: usize| &verdict["rules"][rule]["checks"][0]["value"];
    near(check(0), 2.0);
    near(check(1), 1.0 / 32.0);
    near(check(2), 1.0 / 32.0);
    near(check(3), 1.0 / 32.0);
    near(check(4), 2.0);
    near(check(5), 2.0);
    let found = rows(&folder, "reports/e");
    let values = found.iter().filter(|row| row["metric"] == "flicker");
    // Three frames, whole and three bands; reference, test and ratio; and the share of both.
    assert_eq!(values.count(), 3 * (4 * 3 + 2));
    let table = std::fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    assert!(table.contains("Flicker (% of reference) ↓"), "{table}");
    assert!(folder.path("reports/e/plots/sequence-flicker.svg").exists());
    assert!(folder.path("reports/e/plots/profile-flicker.svg").exists());
}
