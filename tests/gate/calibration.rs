//! `fovqa gate --calibrate`: limits out of repeated runs.

use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::Folder;
use crate::gate::experiments::{NOISE, SIZE, experiment, write_frames};

const METRICS: &str = "[metrics]\nmse = {}\npsnr = {}\nssim = {}\nhaar = { levels = 2 }\n";
const RULES: &str = r#"[[gate]]
metric = "psnr"
aggregate = "min"
at_least = 0
[[gate]]
metric = "mse"
at_most = 1
[[gate]]
metric = "ssim"
band_deg = [0, 10]
aggregate = "p05"
max_drop = 0
[[gate]]
metric = "haar"
statistic = "energy"
image = "ratio"
level = 2
band_deg = [5, 20]
at_least = 0
"#;

fn text() -> String {
    let view = "fov_vertical_deg = 60\nbands_deg = [0, 5, 10, 20, 30, 50]";
    experiment(view, "", &format!("{METRICS}{RULES}"))
        .replace("name = \"A\"", "name = \"A \\\"<b>\\\" é\"")
}

/// Three runs of one build, each with noise of its own.
fn runs(seeds: [u64; 3]) -> Folder {
    let folder = Folder::new();
    folder.write("e.toml", text());
    for (run, seed) in seeds.into_iter().enumerate() {
        write_frames(&folder, ["gt", "test"], 1, &[]);
        for (frame, noise) in NOISE.iter().enumerate() {
            let reference = codes(SIZE.0, SIZE.1, 3, frame as u64);
            folder.png(&format!("gt/{frame:04}.png"), SIZE.0, SIZE.1, &reference);
            let test = disturbed(&reference, noise + 5.0, seed);
            folder.png(&format!("test/{frame:04}.png"), SIZE.0, SIZE.1, &test);
        }
        folder.run(&["run", "e.toml", "--output", &format!("runs/{run}")]).ok();
    }
    folder
}

const ALL: [&str; 6] = ["gate", "e.toml", "--calibrate", "runs/0", "runs/1", "runs/2"];

#[test]
fn proposed_limits_hold_for_the_runs_they_come_from() {
    let folder = runs([1, 2, 3]);
    let limits = folder.run(&ALL).ok().stdout;
    assert!(limits.starts_with("# Limits from 3 repeated runs"), "{limits}");
    assert_eq!(limits.matches("[[gate]]").count(), 4, "{limits}");
    for words in ["in 3 runs (spread ", "standard deviation ", "max_drop = ", "aggregate = \"p05\""]
    {
        assert!(limits.contains(words), "{words}: {limits}");
    }
    let own = text().replace(RULES, "");
    folder.write("e.toml", format!("{own}\n{limits}"));
    folder.run(&["check", "e.toml"]).ok();
    // The limits are of the runs: scored again, each of them passes.
    for (run, seed) in [1u64, 2, 3].into_iter().enumerate() {
        for (frame, noise) in NOISE.iter().enumerate() {
            let reference = codes(SIZE.0, SIZE.1, 3, frame as u64);
            let test = disturbed(&reference, noise + 5.0, seed);
            folder.png(&format!("test/{frame:04}.png"), SIZE.0, SIZE.1, &test);
        }
        let baseline = format!("{run}.json");
        folder.run(&["run", "e.toml", "--output", "again"]).ok();
        folder.run(&["baseline", "save", "again", &baseline]).ok();
        for against in 0..=run {
            let against = format!("{against}.json");
            folder.run(&["gate", "again", "--baseline", &against]).ok();
        }
    }
}

/// The values of a key of the rules, in order.
fn limits(toml: &str, key: &str) -> Vec<Option<f64>> {
    let table: toml::Table = toml::from_str(toml).unwrap();
    let gates = table["gate"].as_array().unwrap().iter();
    gates.map(|gate| gate.get(key).and_then(toml::Value::as_float)).collect()
}

#[test]
fn limits_lie_as_far_beyond_the_worst_as_the_runs_lie_apart() {
    let folder = runs([1, 2, 3]);
    let proposed = folder.run(&ALL).ok().stdout;
    let values: Vec<[f64; 3]> = {
        let of = |run: usize| {
            let folder = folder.run(&["gate", &format!("runs/{run}"), "--format", "json"]);
            let text = folder.stderr;
            assert!(text.contains("needs a baseline"), "{text}");
        };
        (0..3).for_each(of);
        // Without the rule that needs a baseline.
        folder.write("e.toml", text().replace("max_drop = 0", "at_least = 0"));
        let again = |run: u64| {
            for (frame, noise) in NOISE.iter().enumerate() {
                let reference = codes(SIZE.0, SIZE.1, 3, frame as u64);
                let test = disturbed(&reference, noise + 5.0, run);
                folder.png(&format!("test/{frame:04}.png"), SIZE.0, SIZE.1, &test);
            }
            let json = folder.run(&["gate", "e.toml", "--format", "json"]).json();
            let rules = json["rules"].as_array().unwrap().clone();
            rules.iter().map(|r| r["checks"][0]["value"].as_f64().unwrap()).collect::<Vec<f64>>()
        };
        let [a, b, c] = [again(1), again(2), again(3)];
        a.iter().zip(&b).zip(&c).map(|((a, b), c)| [*a, *b, *c]).collect()
    };
    let spread = |rule: usize| {
        let (min, max) = (
            values[rule].iter().copied().fold(f64::INFINITY, f64::min),
            values[rule].iter().copied().fold(f64::NEG_INFINITY, f64::max),
        );
        (min, max, max - min)
    };
    // Rounded outwards by at most a tenth of the spread.
    let outward = |found: Option<f64>, want: f64, spread: f64, sign: f64| {
        let beyond = sign * (found.unwrap() - want);
        assert!(beyond >= -1e-9 * spread && beyond <= 0.11 * spread, "{found:?} {want} {spread}");
    };
    let at_least = limits(&proposed, "at_least");
    let at_most = limits(&proposed, "at_most");
    let (min, _, apart) = spread(0);
    outward(at_least[0], min - apart, apart, -1.0);
    let (_, max, apart) = spread(1);
    outward(at_most[1], max + apart, apart, 1.0);
    assert_eq!((at_least[1], at_most[0]), (None, None));
    let (_, _, apart) = spread(2);
    outward(limits(&proposed, "max_drop")[2], 2.0 * apart, apart, 1.0);
    let (min, max, apart) = spread(3);
    outward(at_least[3], min - apart, apart, -1.0);
    outward(at_most[3], max + apart, apart, 1.0);
}

#[test]
fn runs_without_a_spread_or_of_something_else_are_said() {
    let folder = runs([1, 1, 2]);
    folder.run(&["gate", "e.toml", "--calibrate", "runs/0"]).fails(2, &["a single run"]);
    folder
        .run(&["gate", "e.toml", "--calibrate", "runs/0", "runs/1"])
        .ok()
        .says(&["warning", "identical to the last digit"]);
    folder
        .run(&["gate", "e.toml", "--calibrate", "runs/0", "nope"])
        .fails(3, &["nope: the folder contains no finished run"]);
    for (from, to, words) in [
        ("ssim = {}", "ssim = { sigma = 2.0 }", "ssim.sigma = 1.5 instead of 2"),
        ("ssim = {}", "ssim = {}\nfpsnr = {}", "it has the metrics"),
        ("fov_vertical_deg = 60", "fov_vertical_deg = 50", "view.fov_vertical_deg = 60.0"),
        ("name = \"s\"", "name = \"t\"", "it has the scenes [\"s\"] instead of [\"t\"]"),
        ("name = \"A ", "name = \"B ", "it has the methods"),
    ] {
        folder.write("e.toml", text().replacen(from, to, 1));
        folder.run(&ALL).fails(3, &["runs/0: this run gives no limits", words]);
    }
    folder.write("e.toml", text().replace(RULES, ""));
    folder.run(&ALL).fails(2, &["it has no [[gate]] rule"]);
    folder.write("e.toml", text());
    folder.run(&[&ALL[..], &["--output", "x"]].concat()).fails(2, &["--output"]);
    folder
        .run(&["gate", "e.toml", "--junit", "a.xml", "--calibrate", "runs/0", "runs/1"])
        .fails(2, &["--junit"]);
}

#[test]
fn no_limit_comes_of_what_is_infinite() {
    let folder = runs([1, 2, 3]);
    for frame in 0..5 {
        fs::copy(
            folder.path(&format!("gt/{frame:04}.png")),
            folder.path(&format!("test/{frame:04}.png")),
        )
        .unwrap();
    }
    folder.run(&["run", "e.toml", "--output", "runs/2"]).ok();
    let limits = folder.run(&ALL).ok().stdout;
    assert!(limits.contains("an infinite value gives no limit"), "{limits}");
    assert!(!limits.contains("inf\n") && !limits.to_lowercase().contains("nan"), "{limits}");
    folder.write("e.toml", format!("{}\n{limits}", text().replace(RULES, "")));
    folder.run(&["check", "e.toml"]).ok();
}

#[test]
fn a_run_that_lacks_a_value_is_named() {
    let folder = runs([1, 2, 3]);
    fs::write(folder.path("test/0001.png"), "no picture").unwrap();
    assert_eq!(folder.run(&["run", "e.toml", "--output", "runs/1"]).code, 3);
    folder.run(&ALL).fails(3, &["runs/1: this run gives no limits: s, A", "frame 1"]);
}
