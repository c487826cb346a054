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
    assert!(limits.starts_with("# Limits from 3 repeated runs of one build."), "{limits}");
    assert_eq!(limits.matches("[[gate]]").count(), 4, "{limits}");
    for words in ["in 3 runs (mean ", "standard deviation ", "max_drop = ", "aggregate = \"p05\""] {
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

/// The value of each rule in the three runs that `runs` makes of seeds 1 to 3.
fn values(folder: &Folder) -> Vec<[f64; 3]> {
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
    folder.write("e.toml", text());
    a.iter().zip(&b).zip(&c).map(|((a, b), c)| [*a, *b, *c]).collect()
}

/// The quantile of Student's t distribution with two degrees of freedom, in closed form.
fn student_t2(share: f64) -> f64 {
    (1.0 - 2.0 * share) / (2.0 * share * (1.0 - share)).sqrt()
}

#[test]
fn limits_have_the_stated_rate_of_false_alarms() {
    let folder = runs([1, 2, 3]);
    let values = values(&folder);
    for (options, rate) in [(&[][..], 0.01), (&["--false-alarms", "0.2"][..], 0.2)] {
        let run = folder.run(&[&ALL[..], options].concat()).ok();
        let words = format!("at most {rate} for all 5 limits together");
        let proposed = run.says(&["3 repeated runs", &words]).stdout;
        // The rule of the wavelet has two limits, so there are five.
        let t = student_t2(rate / 5.0);
        let moments = |rule: usize| {
            let mean = values[rule].iter().sum::<f64>() / 3.0;
            let squares = values[rule].iter().map(|value| (value - mean).powi(2)).sum::<f64>();
            (mean, (squares / 2.0).sqrt())
        };
        // Rounded outwards by at most a tenth of the margin.
        let outward = |found: Option<f64>, mean: f64, margin: f64, sign: f64| {
            let beyond = sign * (found.unwrap() - mean) - margin;
            assert!(
                beyond >= -1e-9 * margin && beyond <= 0.101 * margin,
                "{found:?} {mean} {margin}"
            );
        };
        let (at_least, at_most) = (limits(&proposed, "at_least"), limits(&proposed, "at_most"));
        let new_run = t * (4.0f64 / 3.0).sqrt();
        let (mean, deviation) = moments(0);
        outward(at_least[0], mean, new_run * deviation, -1.0);
        let (mean, deviation) = moments(1);
        outward(at_most[1], mean, new_run * deviation, 1.0);
        assert_eq!((at_least[1], at_most[0]), (None, None));
        let (_, deviation) = moments(2);
        outward(limits(&proposed, "max_drop")[2], 0.0, t * deviation * 2.0f64.sqrt(), 1.0);
        let (mean, deviation) = moments(3);
        outward(at_least[3], mean, new_run * deviation, -1.0);
        outward(at_most[3], mean, new_run * deviation, 1.0);
    }
}

#[test]
fn the_rate_of_false_alarms_is_a_probability_and_needs_runs() {
    let folder = runs([1, 2, 3]);
    for rate in ["0", "0.51", "-0.1", "nan", "inf", "x"] {
        let option = format!("--false-alarms={rate}");
        let words = ["above 0 and at most 0.5"];
        folder.run(&[&ALL[..], &[option.as_str()]].concat()).fails(2, &words);
    }
    folder.run(&["gate", "e.toml", "--false-alarms", "0.1"]).fails(2, &["--calibrate"]);
    folder.run(&["gate", "e.toml", "--write"]).fails(2, &["--calibrate"]);
}

#[test]
fn two_runs_say_little() {
    let folder = runs([1, 2, 3]);
    let run = folder.run(&["gate", "e.toml", "--calibrate", "runs/0", "runs/1"]).ok();
    let run = run.says(&[
        "2 repeated runs",
        "2 runs say little about the noise",
        "at most twice as wide",
    ]);
    let comment: Vec<&str> = run.stdout.lines().take_while(|line| line.starts_with("# ")).collect();
    assert!(comment.join(" ").replace("# ", "").contains("2 runs say little"), "{}", run.stdout);
}

#[test]
fn nearly_identical_runs_leave_room_for_rounding_noise() {
    let folder = runs([1, 1, 1]);
    let proposed = folder.run(&ALL).ok().stdout;
    let values = values(&folder);
    let allowed = |value: f64, noise: f64, limit: Option<f64>| {
        let room = (value - limit.unwrap()).abs();
        assert!(room >= 0.999 * noise && room <= 1.2 * noise, "{value} {room} {noise}");
    };
    allowed(values[0][0], 1e-3, limits(&proposed, "at_least")[0]);
    allowed(values[1][0], 1e-5 * values[1][0], limits(&proposed, "at_most")[1]);
    allowed(0.0, 1e-5 * values[2][0], limits(&proposed, "max_drop")[2]);
}

fn read(folder: &Folder, file: &str) -> String {
    fs::read_to_string(folder.path(file)).unwrap()
}

const BEGIN: &str = "# fovqa gate --calibrate: begin";
const END: &str = "# fovqa gate --calibrate: end";

#[test]
fn limits_are_written_between_two_markers() {
    let folder = runs([1, 2, 3]);
    let proposed = folder.run(&ALL).ok().stdout;
    let write = [&ALL[..], &["--write"]].concat();
    let run = folder.run(&write).ok();
    assert_eq!(run.stdout, "");
    run.says(&["e.toml: limits written: 5"]);
    let written = read(&folder, "e.toml");
    assert_eq!(written, format!("{}\n{BEGIN}\n{proposed}{END}\n", text()));
    folder.run(&["check", "e.toml"]).ok();
    // Again, with the block elsewhere, other line ends and another rate. The rules in the block get
    // no limits of their own.
    let moved = format!("{written}# the end").replace('\n', "\r\n");
    folder.write("e.toml", &moved);
    folder.run(&[&write[..], &["--false-alarms", "0.1"]].concat()).ok();
    let again = read(&folder, "e.toml");
    let limits = folder.run(&[&ALL[..], &["--false-alarms", "0.1"]].concat()).ok().stdout;
    let block = format!("{BEGIN}\n{limits}{END}\n# the end").replace('\n', "\r\n");
    assert_eq!(again, format!("{}\r\n{block}", text().replace('\n', "\r\n")));
    // Without other rules, those of the block are calibrated.
    folder.write("e.toml", written.replace(RULES, ""));
    folder.run(&write).ok();
    assert_eq!(read(&folder, "e.toml"), written.replace(RULES, ""));
}

#[test]
fn markers_without_their_partner_are_mistakes() {
    let folder = runs([1, 2, 3]);
    let write = [&ALL[..], &["--write"]].concat();
    let lines = text().matches('\n').count();
    for (behind, line, words) in [
        (format!("{BEGIN}\n"), 1, "there is no line \"# fovqa gate --calibrate: end\""),
        (format!("{END}\n"), 1, "there is no line \"# fovqa gate --calibrate: begin\""),
        (format!("{BEGIN}\n{END}\n{BEGIN}\n{END}\n"), 3, "appears twice"),
    ] {
        let broken = format!("{}{behind}", text());
        folder.write("e.toml", &broken);
        folder.run(&write).fails(2, &[&format!("e.toml:{}: ", lines + line), words]);
        assert_eq!(read(&folder, "e.toml"), broken);
    }
    // Where the rules are an array in one line, no table can be added.
    let inline = text().replace(RULES, "").replacen(
        "name = \"e\"\n",
        "name = \"e\"\ngate = [{ metric = \"mse\", at_most = 1 }]\n",
        1,
    );
    folder.write("e.toml", &inline);
    folder.run(&write).fails(2, &["the limits do not fit in this file", "without --write"]);
    assert_eq!(read(&folder, "e.toml"), inline);
}

#[cfg(unix)]
#[test]
fn a_link_to_the_experiment_stays() {
    let folder = runs([1, 2, 3]);
    fs::rename(folder.path("e.toml"), folder.path("real.toml")).unwrap();
    std::os::unix::fs::symlink("real.toml", folder.path("e.toml")).unwrap();
    folder.run(&[&ALL[..], &["--write"]].concat()).ok();
    assert!(folder.path("e.toml").is_symlink());
    assert!(read(&folder, "real.toml").contains(BEGIN));
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
