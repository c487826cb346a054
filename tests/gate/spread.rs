//! Rules with `alpha`: repeated renders of a build against those of the baseline.

use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::{Value, json};

use crate::fovqa::{Folder, Run};
use crate::gate::baseline_command::{edit, read};
use crate::gate::experiments::{SIZE, experiment, mean, number};

const VIEW: &str = "fov_vertical_deg = 60\nbands_deg = [0, 10, 20, 30]";
const RULE: &str = "[[gate]]\nmetric = \"mse\"\nalpha = 0.01\n";
const BANDS: usize = 3;

fn text(rules: &str) -> String {
    experiment(VIEW, "", &format!("[metrics]\nmse = {{}}\npsnr = {{}}\nfpsnr = {{}}\n{rules}"))
}

/// Scores a render with its own noise into `runs/NAME`. Pixels near the centre get `loss` in addition.
fn render(folder: &Folder, name: &str, seed: u64, loss: u8) {
    let (width, height) = SIZE;
    for frame in 0..2 {
        let reference = codes(width, height, 3, frame);
        folder.png(&format!("gt/{frame:04}.png"), width, height, &reference);
        let mut test = disturbed(&reference, 20.0, 100 * seed + frame);
        for (index, code) in test.iter_mut().enumerate() {
            let (x, y) = (index / 3 % width, index / 3 / width);
            if x.abs_diff(width / 2) < 4 && y.abs_diff(height / 2) < 4 {
                *code = if *code < 128 { *code + loss } else { *code - loss };
            }
        }
        folder.png(&format!("test/{frame:04}.png"), width, height, &test);
    }
    folder.run(&["run", "e.toml", "--output", &format!("runs/{name}")]).ok();
}

/// Four runs of the accepted build, `b.json` made of them, and three runs of a new build.
fn builds(rules: &str, loss: u8) -> Folder {
    let folder = Folder::new();
    folder.write("e.toml", text(rules));
    for run in 0..4 {
        render(&folder, &format!("old{run}"), run, 0);
    }
    for run in 0..3 {
        render(&folder, &format!("new{run}"), 10 + run, loss);
    }
    let olds = ["runs/old1", "runs/old2", "runs/old3"];
    let save = ["baseline", "save", "runs/old0", "b.json", "--repeats"];
    folder.run(&[&save[..], &olds[..]].concat()).ok();
    folder
}

fn gate(folder: &Folder, options: &[&str]) -> Run {
    let gate = ["gate", "runs/new0", "--baseline", "b.json", "--format", "json"];
    folder.run(&[&gate[..], options].concat())
}

const REPEATS: [&str; 3] = ["--repeats", "runs/new1", "runs/new2"];

fn checks(run: &Run) -> Vec<Value> {
    run.json()["rules"][0]["checks"].as_array().unwrap().clone()
}

/// The mean squared error of a run in a band, as the mean over its frames.
fn scored(folder: &Folder, run: &str, band: usize) -> f64 {
    let csv = fs::read_to_string(folder.path(&format!("runs/{run}/results.csv"))).unwrap();
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let of = |line: &str, name: &str| {
        let at = names.iter().position(|n| *n == name).unwrap();
        line.split(',').nth(at).unwrap().to_owned()
    };
    let from = [0.0, 10.0, 20.0][band];
    let wanted = |line: &&str| {
        of(line, "metric") == "mse"
            && of(line, "statistic").is_empty()
            && of(line, "from_deg").parse() == Ok(from)
    };
    let values: Vec<f64> =
        lines.filter(wanted).map(|line| of(line, "value").parse().unwrap()).collect();
    assert_eq!(values.len(), 2);
    mean(&values)
}

#[test]
fn a_change_in_one_band_is_found_and_named() {
    let folder = builds(RULE, 60);
    let run = gate(&folder, &REPEATS);
    assert_eq!(run.code, 1, "{}", run.stdout);
    let checks = checks(&run);
    let bands: Vec<&Value> = checks.iter().map(|check| &check["band_deg"]).collect();
    assert_eq!(bands, [&json!([0.0, 10.0]), &json!([10.0, 20.0]), &json!([20.0, 30.0])]);
    let states: Vec<&Value> = checks.iter().map(|check| &check["state"]).collect();
    assert_eq!(states, ["failed", "passed", "passed"], "{checks:#?}");
    let reason = checks[0]["reason"].as_str().unwrap();
    for words in
        ["mse mean, 0° to 10° is ", "higher than the baseline's", "Welch's t = ", "after Holm"]
    {
        assert!(reason.contains(words), "{words}: {reason}");
    }
    for (band, check) in checks.iter().enumerate() {
        let of = |runs: &[&str]| -> Vec<f64> {
            runs.iter().map(|run| scored(&folder, run, band)).collect()
        };
        let new = of(&["new0", "new1", "new2"]);
        let old = of(&["old0", "old1", "old2", "old3"]);
        for (key, values) in [("value", &new), ("baseline", &old)] {
            let (found, want) = (number(&check[key]), mean(values));
            assert!((found / want - 1.0).abs() < 1e-9, "{key}: {found} {want}");
        }
        // The limit lies where the statistic reaches its quantile, and fails with the test.
        let margin = number(&check["limit"]) - number(&check["value"]);
        assert!((number(&check["margin"]) - margin).abs() < 1e-12);
        assert_eq!(margin < 0.0, band == 0);
        assert_eq!(number(&check["p"]) <= 0.01, band == 0);
    }
    // A single run is compared too, and each form of the verdict names the band.
    let one = gate(&folder, &[]);
    assert_eq!(one.code, 1, "{}", one.stdout);
    assert!(one.stdout.contains("one run: t = "), "{}", one.stdout);
    let files = ["--junit", "gate.xml", "--markdown", "gate.md", "--annotations", "github"];
    let shown = folder.run(&[&["gate", "runs/new0", "--baseline", "b.json"], &files[..]].concat());
    let file = |name: &str| fs::read_to_string(folder.path(name)).unwrap();
    for text in [shown.stdout, file("gate.xml"), file("gate.md")] {
        assert!(text.contains("s, A, 0° to 10°"), "{text}");
    }
    assert!(file("gate.xml").contains("p = "));
}

#[test]
fn an_unchanged_build_passes() {
    let folder = builds(RULE, 0);
    for options in [&REPEATS[..], &[]] {
        let run = gate(&folder, options);
        assert_eq!(run.code, 0, "{}", run.stdout);
        assert_eq!(checks(&run).len(), BANDS);
    }
    // The same, scored by the gate itself: the frames of the last render are still there.
    let scored = folder.run(&["gate", "e.toml", "--baseline", "b.json", "--format", "json"]);
    assert_eq!(scored.code, 0, "{}", scored.stdout);
}

#[test]
fn a_band_or_the_whole_frame_is_one_test() {
    let band = "[[gate]]\nmetric = \"psnr\"\nband_deg = [0, 20]\nalpha = 0.05\nadjust = \"none\"\n";
    let whole = "[[gate]]\nmetric = \"fpsnr\"\naggregate = \"min\"\nalpha = 0.05\nadjust = \"bonferroni\"\n";
    let folder = builds(&format!("{band}{whole}"), 0);
    let verdict = gate(&folder, &REPEATS).json();
    let rules = verdict["rules"].as_array().unwrap();
    for (rule, limits) in rules.iter().zip(["alpha 0.05", "alpha 0.05, bonferroni"]) {
        assert_eq!(rule["checks"].as_array().unwrap().len(), 1, "{rule:#}");
        assert!(rule["limits"].as_str().unwrap().ends_with(limits), "{rule:#}");
    }
    let baseline = read(&folder, "b.json");
    let repeats = baseline["comparisons"][0]["repeats"].as_object().unwrap();
    let names: Vec<&String> = repeats.keys().collect();
    assert_eq!(names, ["fpsnr min", "psnr mean, 0° to 20°"]);
    assert!(repeats.values().all(|values| values.as_array().unwrap().len() == 4), "{repeats:?}");
    assert_eq!(repeats["fpsnr min"][0], baseline["comparisons"][0]["values"]["fpsnr min"]);
}

#[test]
fn without_spread_only_a_difference_fails() {
    let folder = Folder::new();
    folder.write("e.toml", text(RULE));
    for (run, seed) in [("old0", 1), ("old1", 1), ("new0", 1), ("new1", 1), ("other", 2)] {
        render(&folder, run, seed, 0);
    }
    folder.run(&["baseline", "save", "runs/old0", "b.json", "--repeats", "runs/old1"]).ok();
    let run = gate(&folder, &["--repeats", "runs/new1"]);
    assert_eq!(run.code, 0, "{}", run.stdout);
    edit(&folder, |baseline| {
        for value in
            baseline["comparisons"][0]["repeats"]["mse mean, 0° to 10°"].as_array_mut().unwrap()
        {
            *value = json!(0.99 * number(value));
        }
    });
    let run = gate(&folder, &["--repeats", "runs/new1"]);
    assert_eq!(run.code, 1, "{}", run.stdout);
    assert!(run.stdout.contains("the repeated runs do not vary"), "{}", run.stdout);
}

#[test]
fn runs_that_are_no_repeats_are_refused() {
    let folder = builds(RULE, 0);
    let save = |repeats: &[&str]| {
        folder.run(&[&["baseline", "save", "runs/old0", "c.json", "--repeats"], repeats].concat())
    };
    save(&["runs/old0"]).fails(2, &["runs/old0: this run is given twice"]);
    save(&["runs/old1", "runs/../runs/old1"]).fails(2, &["this run is given twice"]);
    save(&["nope"]).fails(3, &["nope: the folder contains no finished run"]);
    gate(&folder, &["--repeats", "runs/new0"]).fails(2, &["this run is given twice"]);
    folder.write("e.toml", text(RULE).replace("fpsnr = {}\n", ""));
    folder.run(&["run", "e.toml", "--output", "runs/other"]).ok();
    let words = ["runs/other: it is no repeated run", "it has the metrics"];
    save(&["runs/other"]).fails(3, &words);
    gate(&folder, &["--repeats", "runs/other"]).fails(3, &words);
    folder.write("e.toml", text(RULE));
    fs::remove_file(folder.path("gt/0001.png")).unwrap();
    fs::remove_file(folder.path("test/0001.png")).unwrap();
    folder.run(&["run", "e.toml", "--output", "runs/short"]).ok();
    save(&["runs/short"]).fails(3, &["it has 1 frames of s, A instead of 2"]);
    folder.write("test/0000.png", "no picture");
    assert_eq!(folder.run(&["run", "e.toml", "--output", "runs/broken"]).code, 3);
    save(&["runs/broken"]).fails(3, &["runs/broken: it is no repeated run", "frame 0"]);
}

#[test]
fn a_baseline_without_repeats_is_not_scored() {
    let folder = builds(RULE, 0);
    folder.run(&["baseline", "save", "runs/old0", "single.json"]).ok();
    let run = folder.run(&["gate", "runs/new0", "--baseline", "single.json"]);
    assert_eq!(run.code, 3, "{}", run.stdout);
    for words in ["no repeated runs of mse mean, 0° to 10°", "--repeats DIR…"] {
        assert!(run.stdout.contains(words), "{words}: {}", run.stdout);
    }
    // A run that is accepted without repeats replaces those of the baseline.
    let dry = ["baseline", "accept", "runs/old0", "b.json"];
    folder.run(&[&dry[..], &["--repeats", "runs/old1"]].concat()).ok();
    let count = |folder: &Folder| {
        let baseline = read(folder, "b.json");
        let repeats = &baseline["comparisons"][0]["repeats"]["mse mean, 0° to 10°"];
        repeats.as_array().map_or(0, Vec::len)
    };
    assert_eq!(count(&folder), 2);
    folder.run(&dry).ok();
    assert_eq!(count(&folder), 0);
}

#[test]
fn mistakes_in_rules_are_named() {
    let folder = Folder::new();
    for (rule, words) in [
        ("alpha = 0", "alpha"),
        ("alpha = 0.6", "alpha"),
        ("alpha = 0.01\nadjust = \"sidak\"", "adjust"),
        ("adjust = \"holm\"\nat_most = 1", "adjust has no effect without alpha"),
        ("alpha = 0.01\nat_most = 1", "a rule with alpha has no at_most"),
        ("alpha = 0.01\nmax_rise = \"1%\"", "a rule with alpha has no max_rise"),
    ] {
        folder.write("e.toml", text(&format!("[[gate]]\nmetric = \"mse\"\n{rule}\n")));
        folder.run(&["check", "e.toml"]).fails(2, &[words]);
    }
    folder.write("e.toml", text("[[gate]]\nmetric = \"mse\"\nat_most = 1e6\n"));
    render(&folder, "new0", 1, 0);
    render(&folder, "new1", 2, 0);
    let words = ["no rule of the experiment tests the spread of repeated runs"];
    let repeats = ["--repeats", "runs/new1"];
    folder.run(&[&["gate", "runs/new0"], &repeats[..]].concat()).fails(2, &words);
    let save = ["baseline", "save", "runs/new0", "b.json"];
    folder.run(&[&save[..], &repeats[..]].concat()).fails(2, &words);
}
