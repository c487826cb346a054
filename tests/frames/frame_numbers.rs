//! The numbers of frames: negative ones, inside names, missing ones, and frames that cannot be read.

use std::fs;
use std::path::PathBuf;

use fovqa_testkit::synthetic::codes;
use serde_json::{Value, json};

use crate::fovqa::{Folder, root};

/// A folder of `tests/cases`, and its copy to work in.
fn case(name: &str) -> Folder {
    let folder = Folder::new();
    let from = root().join("tests/cases").join(name);
    let mut todo = vec![PathBuf::new()];
    while let Some(below) = todo.pop() {
        for entry in fs::read_dir(from.join(&below)).unwrap() {
            let path = below.join(entry.unwrap().file_name());
            if from.join(&path).is_dir() {
                todo.push(path);
            } else {
                let to = folder.path(path.to_str().unwrap());
                fs::copy(from.join(&path), to).unwrap();
            }
        }
    }
    folder
}

const ATD: [&str; 4] = ["--metrics", "atd", "--fov-vertical", "60"];

/// ATD of the test of `missing-frame` over its first two frames.
const FROM_0_TO_1: f64 = 0.012_489_5;

#[track_caller]
fn near(value: &Value, want: f64) {
    let value = value.as_f64().unwrap();
    assert!((value - want).abs() <= 1e-4 * want, "{value} is not {want}");
}

fn numbers(json: &Value) -> Vec<i64> {
    json["frames"].as_array().unwrap().iter().map(|f| f["frame"].as_i64().unwrap()).collect()
}

/// Frames of these names, each of its own picture.
fn frames(folder: &Folder, names: &[&str]) {
    for (seed, name) in names.iter().enumerate() {
        folder.png(name, 16, 12, &codes(16, 12, 3, seed as u64));
    }
}

#[test]
fn negative_numbers_come_first() {
    let folder = case("negative-frames");
    let patterns = ["f.%04d.exr", "f.%d.exr", "f.####.exr", "f.@@@@.exr", "f.$F4.exr", "*.exr", ""];
    // %d is for numbers without leading zeros.
    for pattern in patterns.into_iter().filter(|pattern| *pattern != "f.%d.exr") {
        let sides = ["gt", "test"].map(|side| format!("{side}/{pattern}"));
        let arguments = [&[&*sides[0], &sides[1]], &ATD[..]].concat();
        let json = folder.json(&arguments);
        assert_eq!(numbers(&json), [-2, -1, 0, 1], "{pattern}");
        let atd = &json["sequence"]["atd"];
        assert_eq!((&atd["reference"], &atd["frames"]), (&json!(0.0), &json!(3)), "{pattern}");
        near(&atd["test"], 0.012_807_6);
    }
}

#[test]
fn negative_numbers_in_selections_results_and_gaze() {
    let folder = case("negative-frames");
    let picked = |range: &str| {
        let arguments = ["gt", "test", "--metrics", "psnr", "--frames", range];
        numbers(&folder.json(&arguments))
    };
    assert_eq!(picked("-2..1"), [-2, -1, 0]);
    assert_eq!(picked("..0"), [-2, -1]);
    assert_eq!(picked("-2..=1:3"), [-2, 1]);
    folder.write("gaze.csv", "frame,x_px,y_px\n-2,3,4\n-1,5,6\n0,7,8\n1,9,10\n");
    let view = ["--fov-vertical", "60", "--metrics", "psnr"];
    let json = folder.json(&[&["gt", "test", "--gaze", "gaze.csv"], &view[..]].concat());
    let gaze: Vec<&Value> =
        json["frames"].as_array().unwrap().iter().map(|f| &f["gaze_px"][0]).collect();
    assert_eq!(gaze, [&json!(3.0), &json!(5.0), &json!(7.0), &json!(9.0)]);
    // Times start with the first frame, whatever its number.
    folder.write("times.csv", "time_s,x_px,y_px\n0,3,4\n0.1,5,6\n0.2,7,8\n0.3,9,10\n");
    let times = ["gt", "test", "--gaze", "times.csv", "--fps", "10"];
    let of_times = folder.json(&[&times, &view[..]].concat());
    assert_eq!(of_times["frames"], json["frames"]);
    let csv = folder.score(&["gt", "test", "--metrics", "psnr", "--format", "csv"]).ok().stdout;
    assert!(csv.lines().any(|line| line.contains(",-2,pair,psnr,")), "{csv}");
}

#[test]
fn negative_numbers_resume_and_gate() {
    let folder = case("negative-frames");
    folder.write(
        "x.toml",
        "name = \"x\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\nreference = \"gt/f.####.exr\"\n\
         frames = \"-2..1\"\n[[method]]\nname = \"m\"\ntest = \"test/f.%04d.exr\"\n\
         [metrics]\npsnr = {}\natd = {}\n[[plot]]\nkind = \"sequence\"\nmetric = \"psnr\"\n\
         [[gate]]\nmetric = \"psnr\"\naggregate = \"min\"\nat_least = 0\n",
    );
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    let results = fs::read_to_string(folder.path("r/results.csv")).unwrap();
    assert!(results.contains("s,m,,,-2,pair,psnr"), "{results}");
    // Two of the three frames are finished.
    let journal = fs::read_to_string(folder.path("r/journal.jsonl")).unwrap();
    let third = journal.match_indices("\"values\"").nth(2).unwrap().0;
    let end = journal[..third].rfind('\n').unwrap() + 1;
    folder.write("r/journal.jsonl", &journal[..end]);
    folder
        .run(&["run", "x.toml", "--output", "r", "--resume"])
        .ok()
        .says(&["2 frames are finished"]);
    assert_eq!(fs::read_to_string(folder.path("r/results.csv")).unwrap(), results);
    let gate = folder.run(&["gate", "r", "--format", "json"]).ok().json();
    assert!(gate.to_string().contains("\"worst_frame\":"), "{gate}");
    folder.run(&["run", "x.toml", "--output", "r2", "--frames", "-1..1"]).ok();
    let fewer = fs::read_to_string(folder.path("r2/results.csv")).unwrap();
    assert!(fewer.contains(",-1,pair,psnr") && !fewer.contains(",-2,pair,psnr"), "{fewer}");
}

#[test]
fn the_number_that_changes_is_that_of_the_frame() {
    let folder = case("frame-number-inside");
    let view = ["--gaze", "gaze.csv", "--fov-vertical", "60", "--metrics", "psnr"];
    let sides = [
        ["gt", "test"],
        ["gt/*.png", "test/*"],
        ["gt/gt_%04d_1080p.png", "test/gt_####_1080p.png"],
        ["gt", "test/gt_%04d_*.png"],
    ];
    for sides in sides {
        let json = folder.json(&[&sides, &view[..]].concat());
        assert_eq!(numbers(&json), [1, 2, 3, 4], "{sides:?}");
        assert_eq!(json["frames"][0]["gaze_px"], json!([10.0, 5.0]), "{sides:?}");
    }
    // Named otherwise on the other side, they pair by that number.
    for number in 1..5 {
        let (from, to) =
            (format!("test/gt_000{number}_1080p.png"), format!("test/2k_{number}.png"));
        fs::rename(folder.path(&from), folder.path(&to)).unwrap();
    }
    let json = folder.json(&[&["gt", "test"], &view[..]].concat());
    assert_eq!(json["frames"][3]["test"], "test/2k_4.png");
    assert_eq!(json["frames"][3]["gaze_px"], json!([40.0, 5.0]));
    // One file of the folder is the frame that it is among the others.
    let one = ["gt/gt_0002_1080p.png", "test"];
    folder
        .score(&[&one, &view[..]].concat())
        .fails(3, &["no file of gt/gt_0002_1080p.png has a partner"]);
}

#[test]
fn several_numbers_that_change_ask_for_a_pattern() {
    let folder = Folder::new();
    let names = ["f0001_t0017.png", "f0002_t0033.png", "f0003_t0050.png"];
    for side in ["gt", "test"] {
        frames(&folder, &names.map(|name| format!("{side}/{name}")).each_ref().map(|n| &**n));
    }
    folder.score(&["gt", "test", "--metrics", "psnr"]).fails(
        3,
        &["several change from name to name", "f0001_t0017", "'f%04d_t*.*' or 'f*_t%04d.*'"],
    );
    let advice = ["gt/f%04d_t*.*", "test/f%04d_t*.*"];
    assert_eq!(numbers(&folder.json(&advice)), [1, 2, 3]);
    let advice = ["gt/f*_t%04d.*", "test/f*_t%04d.*"];
    assert_eq!(numbers(&folder.json(&advice)), [17, 33, 50]);
}

#[test]
fn names_that_do_not_number_the_frames_are_questioned() {
    let folder = Folder::new();
    frames(&folder, &["gt/cover.png", "gt/0001.png", "gt/0002.png"]);
    let plain = ["gt", "gt", "--metrics", "psnr"];
    let run = folder.score(&[&plain[..], &["--format", "json"]].concat()).ok();
    let run = run.says(&["do not identify the frames: cover has none"]);
    assert_eq!(numbers(&run.json()), [0, 1, 2]);
    folder.write("gaze.csv", "frame,x_px,y_px\n0,1,9\n1,2,9\n2,3,9\n");
    let trace = ["--gaze", "gaze.csv", "--fov-vertical", "60"];
    let words = ["a gaze trace needs frame numbers", "cover has none"];
    folder.score(&[&plain[..], &trace].concat()).fails(3, &words);
    let words = ["a selection of frames needs frame numbers", "%04d"];
    folder.score(&[&plain[..], &["--frames", "0..2"]].concat()).fails(3, &words);
    // A single file has no others to compare its numbers with.
    frames(&folder, &["a/gt_0001_1080p.png", "b/gt_0001_1080p.png"]);
    folder.write("gaze.csv", "frame,x_px,y_px\n1080,5,9\n");
    let one = ["a", "b", "--metrics", "psnr"];
    folder.score(&[&one[..], &trace].concat()).ok().says(&["uses the last one"]);
    // Stems that differ in capitals alone.
    frames(&folder, &["c/F1.png", "c/f1.png"]);
    folder.score(&["c", "c"]).fails(3, &["have the same name without the ending"]);
}

#[cfg(unix)]
#[test]
fn a_frame_that_is_not_there_is_an_error_and_a_hole() {
    let folder = case("missing-frame");
    for side in ["gt", "test"] {
        std::os::unix::fs::symlink("nowhere", folder.path(&format!("{side}/f.0002.exr"))).unwrap();
    }
    for sides in [["gt", "test"], ["gt/*.exr", "test/*.exr"], ["gt/f.%04d.exr", "test/f.####.exr"]]
    {
        let run = folder.score(&[&sides, &ATD[..], &["--format", "json"]].concat());
        let run = run.says(&["frame 2: gt/f.0002.exr: it is a link to nowhere", "git annex get"]);
        assert_eq!(run.code, 3);
        let json = run.json();
        assert_eq!(numbers(&json), [0, 1, 3]);
        assert_eq!(json["errors"][0]["frame"], 2);
        assert_eq!(json["sequence"]["atd"]["frames"], 1, "from 0 to 1 alone");
        near(&json["sequence"]["atd"]["test"], FROM_0_TO_1);
    }
    folder.write(
        "x.toml",
        "name = \"x\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n\
         [[method]]\nname = \"m\"\ntest = \"test\"\n[metrics]\natd = {}\n\
         [[gate]]\nmetric = \"atd\"\nat_most = 100\n",
    );
    let gate = folder.run(&["gate", "x.toml", "--output", "r"]);
    assert_eq!(gate.code, 3, "{}", gate.stdout);
    folder.run(&["check", "x.toml"]).says(&["f.0002.exr: the file is missing"]);
}

#[cfg(target_os = "linux")]
#[test]
fn whatever_is_named_like_a_frame_is_one() {
    let folder = Folder::new();
    let names = ["f0.png", "f1.png", "f2.png", "f3.png", "f4.png", "f5.png"];
    for side in ["gt", "test"] {
        frames(&folder, &names.map(|name| format!("{side}/{name}")).each_ref().map(|n| &**n));
    }
    let replace = |name: &str| {
        let path = folder.path(&format!("test/{name}"));
        fs::remove_file(&path).unwrap();
        path
    };
    std::os::unix::fs::symlink(".", replace("f1.png")).unwrap();
    let made = std::process::Command::new("mkfifo").arg(replace("f2.png")).status().unwrap();
    assert!(made.success());
    std::os::unix::fs::symlink("/dev/zero", replace("f3.png")).unwrap();
    let run = folder.score(&["gt", "test", "--metrics", "psnr", "--format", "json"]).says(&[
        "frame 1: test/f1.png: it is a folder",
        "frame 2: test/f2.png: it is not a regular file",
        "frame 3: test/f3.png: it is not a regular file",
    ]);
    assert_eq!(run.code, 3);
    assert_eq!(numbers(&run.json()), [0, 4, 5]);
}

#[test]
fn numbers_that_neither_side_has_are_named() {
    let folder = case("missing-frame");
    let run = folder.score(&[&["gt", "test"], &ATD[..], &["--format", "json"]].concat()).ok();
    let run = run.says(&["frame 2 is missing in reference and test"]);
    assert_eq!(run.json()["sequence"]["atd"]["frames"], 1);
    near(&run.json()["sequence"]["atd"]["test"], FROM_0_TO_1);
    // What is not asked for is not missing.
    let some = ["gt", "test", "--frames", "0..2"];
    let run = folder.score(&[&some[..], &ATD].concat()).ok();
    assert!(!run.stderr.contains("missing"), "{}", run.stderr);
    // A constant step is no gap, and its frames follow each other.
    for side in ["gt", "test"] {
        for (from, to) in [("f.0003", "f.0020"), ("f.0001", "f.0010")] {
            let path = |name: &str| folder.path(&format!("{side}/{name}.exr"));
            fs::rename(path(from), path(to)).unwrap();
        }
    }
    let run = folder.score(&[&["gt", "test"], &ATD[..], &["--format", "json"]].concat()).ok();
    assert!(!run.stderr.contains("missing"), "{}", run.stderr);
    assert_eq!(run.json()["sequence"]["atd"]["frames"], 2);
}

#[test]
fn padded_patterns_name_motion_files_too() {
    let folder = case("negative-frames");
    for side in ["gt", "test"] {
        fs::rename(folder.path(side), folder.path("old")).unwrap();
        fs::create_dir_all(folder.path(side)).unwrap();
        for (from, to) in [("f.0000", "f.0000"), ("f.0001", "f.0001")] {
            let from = folder.path(&format!("old/{from}.exr"));
            fs::copy(from, folder.path(&format!("{side}/{to}.exr"))).unwrap();
        }
        fs::remove_dir_all(folder.path("old")).unwrap();
    }
    let own = folder.json(&[&["gt", "test"], &ATD[..]].concat());
    let files = ["--motion-files", "gt/f.####.exr", "--depth-files", "gt/f.%04d.exr"];
    let named = folder.json(&[&["gt", "test"], &ATD[..], &files].concat());
    assert_eq!(named["sequence"]["atd"]["reference"], own["sequence"]["atd"]["reference"]);
}

#[cfg(unix)]
#[test]
fn names_that_are_not_utf8_resume() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let os = OsStr::from_bytes;
    let below = |side: &[u8], name: &[u8]| folder.path("").join(os(side)).join(os(name));
    frames(&folder, &["0.png", "1.png"]);
    for side in [&b"g\xfft"[..], b"test"] {
        fs::create_dir_all(below(side, b"")).unwrap();
        fs::copy(folder.path("0.png"), below(side, b"f\xff_0.png")).unwrap();
        // The same text, where it is shown carelessly.
        fs::copy(folder.path("1.png"), below(side, b"f\xfe_1.png")).unwrap();
    }
    folder.write(
        "x.toml",
        "name = \"x\"\n[[scene]]\nname = \"s\"\nreference = \"g*t/*.png\"\n\
         [[method]]\nname = \"m\"\ntest = \"test\"\n[metrics]\npsnr = {}\n",
    );
    folder.run(&["run", "x.toml", "--output", "r"]).ok();
    let run: Value = serde_json::from_slice(&fs::read(folder.path("r/run.json")).unwrap()).unwrap();
    let inputs = run["inputs"].as_array().unwrap();
    assert_eq!(inputs.len(), 4, "{inputs:?}");
    assert_eq!(inputs[0]["path"], r"g\xfft/f\xfe_1.png");
    let resume = ["run", "x.toml", "--output", "r", "--resume"];
    folder.run(&resume).ok().says(&["2 frames are finished"]);
    fs::copy(folder.path("0.png"), below(b"g\xfft", b"f\xfe_1.png")).unwrap();
    folder.run(&resume).ok().says(&[r"g\xfft/f\xfe_1.png has changed"]);
}
