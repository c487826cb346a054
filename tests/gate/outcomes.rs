//! What is no pass: values that are not there, results that are damaged, verdicts that cannot be written.

use std::fs;

use crate::fovqa::Folder;
use crate::gate::experiments::{NOISE, experiment, gate, number, only, sequence, write_frames};
use crate::runs::experiment_folder::two_scenes;

const VIEW: &str = "fov_vertical_deg = 60";

/// The exit code and the reason of a single check.
#[track_caller]
fn outcome(folder: &Folder, view: &str, rest: &str) -> (i32, String) {
    let (run, verdict) = gate(folder, &experiment(view, "", rest), &[]);
    let check = only(&verdict);
    assert_eq!(run.code == 0, check["state"] == "passed", "{verdict:#}");
    (run.code, check["reason"].as_str().unwrap_or_default().to_owned())
}

#[test]
fn infinity_passes_any_minimum_and_fails_no_mean() {
    let folder = Folder::new();
    write_frames(&folder, ["gt", "test"], 1, &[0.0, 0.0]);
    for rule in [
        "metric = \"psnr\"\nat_least = 1e12",
        "metric = \"psnr\"\naggregate = \"p05\"\nat_least = 1e12",
        "metric = \"psnr\"\nstatistic = \"pooled\"\nat_least = 1e12",
        "metric = \"psnr\"\nband_deg = [0, 10]\nat_least = 1e12",
        "metric = \"psnr\"\nband_deg = [0, 10]\nstatistic = \"pooled\"\nat_least = 1e12",
        "metric = \"fpsnr\"\naggregate = \"max\"\nat_least = 1e12",
    ] {
        let rest = format!("[metrics]\npsnr = {{}}\nfpsnr = {{}}\n[[gate]]\n{rule}\n");
        let (run, verdict) = gate(&folder, &experiment(VIEW, "", &rest), &[]);
        let check = only(&verdict);
        assert_eq!((run.code, number(&check["value"])), (0, f64::INFINITY), "{rule}: {verdict:#}");
        assert_eq!(check["margin"], "inf");
    }
    for (rule, value) in [("ssim", 1.0), ("mse", 0.0)] {
        let limit = if rule == "mse" { "at_most = 0" } else { "at_least = 1" };
        let rest = format!("[metrics]\n{rule} = {{}}\n[[gate]]\nmetric = \"{rule}\"\n{limit}\n");
        let (run, verdict) = gate(&folder, &experiment(VIEW, "", &rest), &[]);
        assert_eq!(
            (run.code, number(&only(&verdict)["value"]).to_bits()),
            (0, f64::to_bits(value))
        );
    }
}

#[test]
fn a_band_without_pixels_fails_for_that_reason() {
    let folder = sequence();
    let view = "fov_vertical_deg = 60\nbands_deg = [0, 10, 20, 80, 90]";
    for rule in [
        "metric = \"psnr\"",
        "metric = \"ssim\"\naggregate = \"min\"",
        "metric = \"psnr\"\nstatistic = \"pooled\"",
        "metric = \"rms_contrast\"\nimage = \"test\"",
        "metric = \"haar\"\nstatistic = \"energy\"\nlevel = 1\nimage = \"ratio\"",
    ] {
        let metrics = "[metrics]\npsnr = {}\nssim = {}\nrms_contrast = {}\nhaar = { levels = 2 }\n";
        let text = format!("{metrics}[[gate]]\n{rule}\nband_deg = [80, 90]\nat_least = 0\n");
        let (code, reason) = outcome(&folder, view, &text);
        assert!(
            code == 1 && reason.ends_with("no pixel is in the band"),
            "{rule}: {code} {reason}"
        );
    }
    // Beside bands that have some, it counts for nothing.
    for rule in ["metric = \"psnr\"", "metric = \"psnr\"\nstatistic = \"pooled\""] {
        let values = [[20, 80], [20, 90]].map(|band| {
            let text = format!(
                "[metrics]\npsnr = {{}}\n[[gate]]\n{rule}\nband_deg = {band:?}\nat_least = 0\n"
            );
            let (run, verdict) = gate(&folder, &experiment(view, "", &text), &[]);
            assert_eq!(run.code, 0, "{verdict:#}");
            number(&only(&verdict)["value"])
        });
        assert_eq!(values[0].to_bits(), values[1].to_bits());
    }
}

#[test]
fn what_is_not_scored_is_no_pass() {
    let small = Folder::new();
    small.png_pair("gt/0000.png", "test/0000.png", 8, 8);
    // A default metric that does not fit is left out, and an experiment of one frame has no ATD.
    for rule in ["metric = \"ssim\"", "metric = \"ssim\"\nband_deg = [0, 5]"] {
        let (code, reason) = outcome(&small, VIEW, &format!("[[gate]]\n{rule}\nat_least = 0\n"));
        assert!(code == 3 && reason.contains("it has no value"), "{rule}: {code} {reason}");
    }
    let folder = sequence();
    for (metrics, rule, words) in [
        (
            "fvvdp",
            "metric = \"fvvdp\"\nstatistic = \"q_sustained\"\nlevel = 30\nat_most = 9",
            "level 30: it has no value",
        ),
        (
            "haar",
            "metric = \"haar\"\nstatistic = \"energy\"\nimage = \"ratio\"\nlevel = 1\nband_deg = [0, 5]\nat_most = 9",
            "no ratio",
        ),
    ] {
        let view = "display = \"htc_vive_pro\"\nbands_deg = [0, 5, 80]";
        if metrics == "haar" {
            // Flat references have no detail to have a share of.
            for frame in 0..NOISE.len() {
                folder.png(&format!("gt/{frame:04}.png"), 64, 48, &[90; 64 * 48 * 3]);
            }
        }
        let text = experiment(
            view,
            "fps = 30",
            &format!("[metrics]\n{metrics} = {{}}\n[[gate]]\n{rule}\n"),
        );
        let (run, verdict) = gate(&folder, &text, &[]);
        let reason = only(&verdict)["reason"].as_str().unwrap();
        assert!(run.code == 3 && reason.contains(words), "{rule}: {} {reason}", run.code);
    }
}

#[test]
fn default_bands_are_known_when_frames_are_read() {
    let folder = sequence();
    for rule in [
        "metric = \"psnr\"\nband_deg = [0, 80]",
        "metric = \"psnr\"\nband_deg = [60, 80]",
        "metric = \"psnr\"\nband_deg = [0, 80]\nstatistic = \"pooled\"",
    ] {
        let text = format!("[metrics]\npsnr = {{}}\n[[gate]]\n{rule}\nat_least = 0\n");
        let (code, reason) = outcome(&folder, VIEW, &text);
        assert_eq!(code, 2, "{rule}: {reason}");
        assert!(reason.contains("edges of scored bands: 0 to 5, 5 to 10"), "{reason}");
    }
    let text =
        "[metrics]\npsnr = {}\n[[gate]]\nmetric = \"psnr\"\nband_deg = [0, 45]\nat_least = 0\n";
    assert_eq!(outcome(&folder, VIEW, text).0, 0);
}

/// Two scenes, the second method in one of them.
fn scenes(rules: &str) -> Folder {
    let folder = two_scenes();
    let text =
        crate::runs::experiment_folder::experiment(&format!("[metrics]\npsnr = {{}}\n{rules}"));
    folder.write("e.toml", text.replace("/b\"\n", "/b\"\nscenes = [\"room\"]\n"));
    folder
}

const HOLDS: &str = "[[gate]]\nmetric = \"psnr\"\nscene = \"hall\"\nat_least = 1\n";
const FAILS: &str = "[[gate]]\nmetric = \"psnr\"\nscene = \"hall\"\nat_least = 90\n";
const WRONG: &str =
    "[[gate]]\nmetric = \"psnr\"\nscene = \"hall\"\nband_deg = [0, 80]\nat_least = 1\n";

#[test]
fn a_rule_that_nothing_is_compared_for_fails() {
    let rule = "[[gate]]\nmetric = \"psnr\"\nscene = \"hall\"\nmethod = \"B\"\nat_least = 1\n";
    let run = scenes(rule).run(&["gate", "e.toml"]);
    assert_eq!(run.code, 1, "{}", run.stdout);
    assert!(run.stdout.contains("the rule applies to no comparison of the run"), "{}", run.stdout);
    assert!(run.stdout.contains("the gate fails: 1 of 1 rule"), "{}", run.stdout);
    let run = scenes(&format!("{HOLDS}{rule}")).run(&["gate", "e.toml"]);
    assert_eq!(run.code, 1, "{}", run.stdout);
}

#[test]
fn what_is_wrong_comes_before_what_is_missing_before_what_fails() {
    for (rules, bad, code) in [
        (HOLDS.to_owned(), "", 0),
        (FAILS.to_owned(), "", 1),
        (format!("{HOLDS}{FAILS}"), "", 1),
        (WRONG.to_owned(), "", 2),
        (format!("{FAILS}{WRONG}"), "", 2),
        (HOLDS.to_owned(), "missing", 3),
        (HOLDS.to_owned(), "damaged", 3),
        (FAILS.to_owned(), "missing", 3),
        (FAILS.to_owned(), "damaged", 3),
        (format!("{HOLDS}{FAILS}{WRONG}"), "missing", 2),
    ] {
        let folder = scenes(&rules);
        match bad {
            "missing" => fs::remove_dir_all(folder.path("room/a")).unwrap(),
            "damaged" => folder.write("room/a/0001.png", "no picture"),
            _ => {}
        }
        let run = folder.run(&["gate", "e.toml"]);
        assert_eq!(run.code, code, "{rules} {bad}: {}{}", run.stdout, run.stderr);
        assert_eq!(run.stdout.contains("the gate holds"), code == 0, "{}", run.stdout);
        if code == 3 {
            assert!(run.stdout.contains("not scored: room, A"), "{}", run.stdout);
        }
        // The folder tells the same.
        assert_eq!(folder.run(&["gate", "reports/e"]).code, code, "{rules} {bad}");
        // What cannot be written is no pass either, and takes nothing away from the verdict.
        let files = ["gate", "e.toml", "--junit", "no/gate.xml", "--markdown", "gate.md"];
        let written = folder.run(&files).says(&["no/gate.xml: it cannot be written"]);
        assert_eq!(written.code, if code == 2 { 2 } else { 3 }, "{}", written.stderr);
        assert_eq!(written.stdout, run.stdout);
        assert!(folder.path("gate.md").exists(), "the other file is written all the same");
    }
}

#[test]
fn a_rule_of_frames_that_could_not_be_scored_is_not_scored_itself() {
    let folder = scenes("[[gate]]\nmetric = \"psnr\"\nmethod = \"A\"\nat_least = 1\n");
    folder.write("room/a/0001.png", "no picture");
    let run = folder.run(&["gate", "e.toml", "--format", "json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let verdict = run.json();
    let [hall, room] = [0, 1].map(|check| verdict["rules"][0]["checks"][check].clone());
    assert_eq!((&hall["state"], &room["state"]), (&"passed".into(), &"not scored".into()));
    assert_eq!(room["reason"], "1 of its frames could not be scored");
    assert_eq!(verdict["errors"].as_array().unwrap().len(), 1);
}

/// A change of a file's text.
type Damage = (&'static str, fn(&str) -> String, &'static str);

const DAMAGES: &[Damage] = &[
    ("results.csv", |_| String::new(), "it has no column"),
    ("results.csv", |t| t[..t.len() / 2].to_owned(), "results.csv: it is not the results of a run"),
    ("results.csv", |t| t.lines().take(40).fold(String::new(), |a, l| a + l + "\n"), "differ from"),
    (
        "results.csv",
        |t| t.replacen("\nroom,A,,,1,pair,psnr", "\nroom,A,,,7,pair,psnr", 1),
        "its frames of room, A differ",
    ),
    (
        "results.csv",
        |t| t.replacen(",psnr,,,,,", ",psnr,,,,,9", 1),
        "its values of psnr of room, A differ",
    ),
    (
        "results.csv",
        |t| {
            t.replacen("room,A,,,0,pair,pixels,,,0.0,5.0,", "room,A,,,0,pair,pixels,,,0.0,5.0,1", 1)
        },
        "its pixels of room, A differ",
    ),
    (
        "results.csv",
        |t| {
            let row = "room,A,,,0,pair,psnr,,,,,";
            t.replacen(row, &format!("room,A,,,0,pair,x,,,,,nan\n{row}"), 1)
        },
        "line 2: \"nan\" is not a number",
    ),
    (
        "results.csv",
        |t| t.replacen("room,A,,,0,pair,psnr,,,,,", "room,A,,,0,pair,psnr,,,,,1e999", 1),
        "is not a number",
    ),
    (
        "results.csv",
        |t| t.replacen("room,A,,,0,", "room,A,,,1.5,", 1),
        "\"1.5\" is not a whole number",
    ),
    (
        "results.csv",
        |t| t.replacen("room,A,,,0,", "room,A,,,99999999999999999999,", 1),
        "is not a whole number",
    ),
    ("results.csv", |t| t.replacen("room,A,,,0,", "cellar,A,,,0,", 1), "differ from"),
    ("results.csv", |t| t.replacen("room,A", "room", 1), "line 2: it has 11 cells, not 12"),
    ("summary.json", |t| t[..t.len() / 2].to_owned(), "it is not a summary of a run"),
    (
        "summary.json",
        |t| t.replacen("fovqa.summary/1", "fovqa.summary/2", 1),
        "its schema is fovqa.summary/2",
    ),
    ("summary.json", |t| t.replacen("\"frames\": 3", "\"frames\": \"three\"", 1), "invalid type"),
    (
        "summary.json",
        |t| t.replacen("\"frames\": 3", "\"frames\": 2", 1),
        "its frames of room, A differ",
    ),
    ("summary.json", |t| t.replacen("\"frames\": 3", "\"frames\": 1e400", 1), "out of range"),
    ("summary.json", |_| "[]".to_owned(), "its schema is not"),
    ("run.json", |t| t[..t.len() / 2].to_owned(), "it is not the record of a run"),
    (
        "run.json",
        |t| t.replacen("fovqa.run/1", "fovqa.baseline/1", 1),
        "its schema is fovqa.baseline/1",
    ),
    (
        "run.json",
        |t| t.replacen("\"at_least\": 1.0", "\"at_least\": NaN", 1),
        "it is not the record",
    ),
    ("run.json", |t| t.replacen("\"at_least\": 1.0", "\"at_least\": \"1\"", 1), "invalid type"),
    (
        "run.json",
        |t| t.replacen("\"aggregate\": \"mean\"", "\"aggregate\": \"p1000\"", 1),
        "is not an aggregate",
    ),
];

#[test]
fn damaged_results_are_refused() {
    let folder = scenes(HOLDS);
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["gate", "reports/e"]).ok();
    for (name, damage, words) in DAMAGES {
        let path = folder.path(&format!("reports/e/{name}"));
        let original = fs::read_to_string(&path).unwrap();
        let damaged = damage(&original);
        assert_ne!(damaged, original, "{name}: {words}");
        fs::write(&path, &damaged).unwrap();
        folder.run(&["gate", "reports/e"]).fails(3, &[words, name, "run the experiment again"]);
        fs::remove_file(&path).unwrap();
        folder.run(&["gate", "reports/e"]).fails(3, &["reports/e"]);
        fs::write(&path, &original).unwrap();
    }
    folder.run(&["gate", "reports/e"]).ok();
}

/// Files that agree with each other, and are not those that were written: whatever was changed in them.
#[test]
fn changed_results_are_refused_by_everything_that_reads_them() {
    let folder = scenes(HOLDS);
    folder.run(&["run", "e.toml"]).ok();
    for name in ["results.csv", "summary.json"] {
        let path = folder.path(&format!("reports/e/{name}"));
        let original = fs::read_to_string(&path).unwrap();
        fs::write(&path, format!("{original}\n")).unwrap();
        let said = [name, "it is not as the run wrote it", "run the experiment again"];
        for command in [
            &["gate", "reports/e"][..],
            &["report", "reports/e"],
            &["baseline", "save", "reports/e", "b.json"],
        ] {
            folder.run(command).fails(3, &said);
        }
        fs::write(&path, &original).unwrap();
    }
    // Half a file, which a figure would be drawn of.
    let path = folder.path("reports/e/results.csv");
    let original = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = original.lines().collect();
    fs::write(&path, lines[..lines.len() / 2].join("\n") + "\n").unwrap();
    folder.run(&["report", "reports/e"]).fails(3, &["results.csv", "run the experiment again"]);
    fs::write(&path, &original).unwrap();
    // Those of an earlier version have no checksums.
    let path = folder.path("reports/e/run.json");
    let mut record: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    assert_eq!(record["files"].as_object().unwrap().len(), 2);
    record.as_object_mut().unwrap().remove("files");
    fs::write(&path, record.to_string()).unwrap();
    let said = "an earlier version of fovqa wrote it without checksums";
    folder.run(&["report", "reports/e"]).ok().says(&[said]);
    let run = folder.run(&["gate", "reports/e"]).ok();
    assert!(run.stdout.contains(said), "{}", run.stdout);
}

#[test]
fn a_folder_has_been_scored_and_needs_rules() {
    let folder = scenes(HOLDS);
    folder.run(&["run", "e.toml"]).ok();
    for option in [["--frames", "0..2"], ["--output", "x"], ["--threads", "1"]] {
        folder
            .run(&[&["gate", "reports/e"], &option[..]].concat())
            .fails(2, &[option[0], "reports/e has already been scored"]);
    }
    folder.run(&["gate", "room"]).fails(3, &["room: the folder contains no finished run"]);
    let folder = scenes("");
    folder.run(&["run", "e.toml"]).ok();
    for target in ["e.toml", "reports/e"] {
        folder
            .run(&["gate", target])
            .fails(2, &["it has no [[gate]] rule", "a gate without rules cannot pass"]);
    }
    let folder = scenes("[[gate]]\nmetric = \"psnr\"\nmax_drop = 1\n");
    folder
        .run(&["gate", "e.toml"])
        .fails(2, &["e.toml:19: the rule for psnr mean needs a baseline"]);
    assert!(!folder.path("reports").join("e").exists());
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["gate", "reports/e"]).fails(2, &["reports/e/e.toml:19", "--baseline"]);
}

#[test]
fn heat_maps_of_a_gate_are_those_of_a_run() {
    let folder = sequence();
    let view = "display = \"htc-vive-pro\"";
    let rest = "[metrics]\nfvvdp = {}\n[[gate]]\nmetric = \"fvvdp\"\nat_least = -1e9\n";
    let text = experiment(view, "", rest)
        .replace("reference = \"gt\"\n", "reference = \"gt\"\nfps = 30\n");
    folder.write("e.toml", &text);
    folder.run(&["gate", "e.toml", "--maps", "gate-maps"]).ok();
    folder.run(&["run", "e.toml", "--maps", "run-maps"]).ok();
    let files = |name: &str| {
        let mut stack = vec![folder.path(name)];
        let mut files = std::collections::BTreeMap::new();
        while let Some(path) = stack.pop() {
            for entry in fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()) {
                if entry.is_dir() {
                    stack.push(entry);
                } else {
                    let name = entry.strip_prefix(folder.path(name)).unwrap().to_owned();
                    files.insert(name, fs::read(&entry).unwrap());
                }
            }
        }
        files
    };
    let maps = files("gate-maps");
    assert!(maps.len() >= 3 && maps == files("run-maps"));
    folder
        .run(&["gate", "reports/e", "--maps", "more"])
        .fails(2, &["--maps only applies to scoring", "give the experiment file"]);
    folder.write("e.toml", text.replace("fvvdp", "fpsnr"));
    folder.run(&["gate", "e.toml", "--maps", "more"]).fails(2, &["none of the metrics has a map"]);
}
