//! `fovqa baseline`: what is in one, and how it is renewed.

use std::fs;

use serde_json::{Value, json};

use crate::fovqa::{Folder, Run, root};
use crate::gate::experiments::{near, number};
use crate::runs::experiment_folder::{experiment, two_scenes};

pub(crate) const METRICS: &str = "[metrics]\nmse = {}\npsnr = {}\nssim = {}\n";

/// Two scenes of two methods, scored, and their baseline in `b.json`.
pub(crate) fn saved(rest: &str) -> Folder {
    let folder = two_scenes();
    folder.write("e.toml", experiment(&format!("{METRICS}{rest}")));
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "b.json"]).ok().says(&["b.json: 4 comparisons"]);
    folder
}

pub(crate) fn read(folder: &Folder, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.path(name)).unwrap()).unwrap()
}

/// Changes the baseline.
pub(crate) fn edit(folder: &Folder, change: impl Fn(&mut Value)) {
    let mut baseline = read(folder, "b.json");
    change(&mut baseline);
    folder.write("b.json", serde_json::to_vec_pretty(&baseline).unwrap());
}

pub(crate) fn against(folder: &Folder) -> Run {
    folder.run(&["gate", "e.toml", "--baseline", "b.json", "--format", "json"])
}

pub(crate) const DROP: &str = "[[gate]]\nmetric = \"psnr\"\naggregate = \"min\"\nmax_drop = 0.5\n";

#[test]
fn a_baseline_holds_what_the_run_found() {
    let folder = saved("[[gate]]\nmetric = \"ssim\"\naggregate = \"p25\"\nmax_drop = 0\n");
    let baseline = read(&folder, "b.json");
    assert_eq!(baseline["schema"], "fovqa.baseline/1");
    let summary = read(&folder, "reports/e/summary.json");
    for comparison in baseline["comparisons"].as_array().unwrap() {
        let of = summary["comparisons"].as_array().unwrap().iter();
        let of = of.clone().find(|c| ["scene", "method"].iter().all(|k| c[k] == comparison[k]));
        let metrics = &of.unwrap()["metrics"];
        let values = comparison["values"].as_object().unwrap();
        for (name, want) in [
            ("psnr mean", &metrics["psnr"]["mean"]),
            ("psnr min", &metrics["psnr"]["min"]),
            ("ssim min", &metrics["ssim"]["min"]),
            ("mse mean", &metrics["mse"]["mean"]),
            ("mse max", &metrics["mse"]["max"]),
        ] {
            near(name, &values[name], number(want));
        }
        assert!(values.contains_key("ssim p25"), "what a rule looks at: {values:?}");
        assert_eq!((values.len(), &comparison["frames"]), (7, &json!(3)));
    }
    assert_eq!(baseline["metrics"]["ssim"]["parameters"]["sigma"], 1.5);
    assert_eq!(baseline["inputs"]["room/gt"]["files"], 3);
    assert_eq!(baseline["resolved"]["scenes"][0]["name"], "room");
    let shown = folder.run(&["baseline", "show", "b.json"]).ok().stdout;
    for words in ["room, A", "psnr min", "room/gt: 3 files, SHA-256", "versions of metrics: mse 1"]
    {
        assert!(shown.contains(words), "{words}: {shown}");
    }
    let verdict = against(&folder).ok().json();
    for check in verdict["rules"][0]["checks"].as_array().unwrap() {
        assert_eq!((number(&check["margin"]), &check["value"]), (0.0, &check["baseline"]));
    }
}

#[test]
fn baselines_are_renewed_whole_or_by_scene() {
    let folder = saved(DROP);
    let original = fs::read_to_string(folder.path("b.json")).unwrap();
    folder
        .run(&["baseline", "save", "reports/e", "b.json"])
        .fails(3, &["the file already exists", "baseline accept"]);
    for scene in ["room", "hall"] {
        for of in ["gt", "a"] {
            let source = folder.path(&format!("{scene}/{of}/0000.png"));
            fs::copy(source, folder.path(&format!("{scene}/{of}/0002.png"))).unwrap();
        }
    }
    folder.run(&["run", "e.toml"]).ok();
    let accept = |options: &[&str]| {
        folder.run(&[&["baseline", "accept", "reports/e", "b.json"], options].concat())
    };
    let dry = accept(&["--dry-run"]).ok().says(&["values differ; nothing was written"]);
    assert!(dry.stdout.contains("psnr min") && dry.stdout.contains("hall, A"), "{}", dry.stdout);
    assert_eq!(fs::read_to_string(folder.path("b.json")).unwrap(), original);
    accept(&["--scene", "nope"]).fails(3, &["the run has no scene nope"]);
    let one = accept(&["--scene", "room"]).ok();
    assert!(one.stdout.contains("room, A") && !one.stdout.contains("hall"), "{}", one.stdout);
    let of = |text: &str, key: &str, name: &str| {
        let json: Value = serde_json::from_str(text).unwrap();
        match key {
            "inputs" => json["inputs"][name].clone(),
            _ => json["comparisons"]
                .as_array()
                .unwrap()
                .iter()
                .filter(|c| c["scene"] == name)
                .cloned()
                .collect(),
        }
    };
    let renewed = fs::read_to_string(folder.path("b.json")).unwrap();
    assert_eq!(of(&original, "", "hall"), of(&renewed, "", "hall"));
    assert_ne!(of(&original, "", "room"), of(&renewed, "", "room"));
    for (folder, same) in
        [("hall/gt", true), ("hall/a", true), ("room/gt", false), ("room/a", false)]
    {
        let inputs = [&original, &renewed].map(|text| of(text, "inputs", folder));
        assert_eq!(inputs[0] == inputs[1], same, "{folder}");
    }
    // A line that has changed is of the scene: nothing else of the file moves.
    let lines = original.lines().zip(renewed.lines()).filter(|(a, b)| a != b).count();
    assert_eq!(original.lines().count(), renewed.lines().count());
    assert!(lines > 0 && lines < 80, "{lines}");
    accept(&[]).ok().says(&["values have changed"]);
    let again = accept(&[]).ok().says(&["0 values have changed"]);
    assert_eq!(again.stdout, "");
    against(&folder).ok();
}

#[test]
fn values_of_some_scenes_do_not_stand_beside_those_taken_otherwise() {
    let folder = saved(DROP);
    let text = experiment(&format!("{METRICS}{DROP}"));
    folder.write("e.toml", text.replace("ssim = {}", "ssim = { sigma = 2.0 }"));
    folder.run(&["run", "e.toml"]).ok();
    let accept = ["baseline", "accept", "reports/e", "b.json"];
    folder
        .run(&[&accept[..], &["--scene", "room"]].concat())
        .fails(3, &["cannot be combined with", "ssim.sigma = 1.5", "without --scene"]);
    folder.run(&accept).ok().says(&["warning", "the values were measured differently"]);
    against(&folder).ok();
}

#[test]
fn a_baseline_needs_a_run_that_was_scored_whole() {
    let folder = two_scenes();
    folder.run(&["baseline", "save", "reports/e", "b.json"]).fails(3, &["no finished run"]);
    fs::remove_file(folder.path("room/a/0001.png")).unwrap();
    assert_eq!(folder.run(&["run", "e.toml"]).code, 3);
    folder
        .run(&["baseline", "save", "reports/e", "b.json"])
        .fails(3, &["not everything was scored: room, A"]);
    assert!(!folder.path("b.json").exists());
    folder.run(&["baseline", "show", "b.json"]).fails(3, &["b.json: it cannot be read"]);
    folder.run(&["baseline", "accept", "reports/e", "b.json"]).fails(3, &["b.json"]);
}

#[test]
fn a_baseline_has_the_same_bytes_for_any_number_of_threads() {
    let folder = two_scenes();
    for threads in ["1", "8"] {
        folder.run(&["run", "e.toml", "--output", threads, "--threads", threads]).ok();
        folder.run(&["baseline", "save", threads, &format!("{threads}.json")]).ok();
    }
    let [one, eight] = ["1.json", "8.json"].map(|name| fs::read(folder.path(name)).unwrap());
    assert_eq!(one, eight);
    assert!(one.ends_with(b"}\n") && one.is_ascii());
}

/// As a merge leaves it that went wrong: `tests/cases/baseline-duplicate`.
#[test]
fn a_comparison_that_stands_twice_is_refused() {
    let folder = saved(DROP);
    for (file, twice) in
        [("dupfirst.json", "mono, B"), ("baseline-crash.json", "living-room, VaFR")]
    {
        let path = root().join("tests/cases/baseline-duplicate").join(file);
        let path = path.display().to_string();
        let said = [file, "it is not a baseline: the comparison ", twice, " appears twice"];
        folder.run(&["baseline", "show", &path]).fails(3, &said);
        folder.run(&["gate", "e.toml", "--baseline", &path]).fails(3, &said);
    }
    let before = read(&folder, "b.json");
    edit(&folder, |baseline| {
        let comparisons = baseline["comparisons"].as_array_mut().unwrap();
        comparisons.push(comparisons[1].clone());
    });
    let doubled = fs::read(folder.path("b.json")).unwrap();
    folder.run(&["baseline", "accept", "reports/e", "b.json"]).fails(3, &["appears twice"]);
    assert_eq!(fs::read(folder.path("b.json")).unwrap(), doubled, "it is left as it is");
    folder.write("b.json", before.to_string());
    assert_eq!(against(&folder).code, 0);
}

/// Of two values of one key nobody can tell which is meant.
#[test]
fn a_key_that_stands_twice_is_refused() {
    let folder = saved(DROP);
    let twice = |name: &str, key: &str| {
        let text = String::from_utf8(fs::read(folder.path(name)).unwrap()).unwrap();
        let (before, behind) = text.split_once(key).unwrap();
        folder.write(name, format!("{before}{key} null,\n{key}{behind}"));
        text
    };
    let baseline = twice("b.json", "\"psnr min\":");
    against(&folder)
        .fails(3, &["b.json: it is not a baseline: the key \"psnr min\" appears twice"]);
    folder.write("b.json", baseline);
    let record = twice("reports/e/run.json", "\"name\":");
    let arguments = ["gate", "reports/e", "--baseline", "b.json"];
    folder.run(&arguments).fails(3, &["run.json", "the key \"name\" appears twice"]);
    folder.write("reports/e/run.json", record);
    let summary = twice("reports/e/summary.json", "\"comparisons\":");
    folder.run(&["report", "reports/e"]).fails(3, &["summary.json", "appears twice"]);
    folder.write("reports/e/summary.json", summary);
    folder.run(&["report", "reports/e"]).ok();
}
