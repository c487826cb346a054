//! Studies and runs: mean opinion scores in an experiment, and plans from the scores of a run.

use std::fmt::Write as _;
use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::Folder;

const METHODS: [&str; 5] = ["A", "B", "C", "D", "E"];

/// Five methods of growing error, one frame in each of two scenes, and an opinion score for each but one.
fn experiment() -> Folder {
    let folder = Folder::new();
    let mut text = String::from(
        "name = \"e\"\n[metrics]\nmse = {}\npsnr = {}\nssim = {}\n\
         [study]\nfile = \"mos.csv\"\nvalue = \"score\"\nbootstrap = 50\n",
    );
    for scene in ["hall", "road"] {
        let _ = write!(text, "[[scene]]\nname = \"{scene}\"\nreference = \"{scene}/ref.png\"\n");
    }
    let mut opinions = String::from("scene,method,score,se\n");
    for (index, method) in METHODS.iter().enumerate() {
        let _ =
            write!(text, "[[method]]\nname = \"{method}\"\ntest = \"{{scene}}/{method}.png\"\n");
        for (of_scene, scene) in ["hall", "road"].into_iter().enumerate() {
            let reference = codes(48, 40, 3, 1);
            let noise = 6.0 * (index + 1) as f64 + 3.0 * of_scene as f64;
            folder.png(&format!("{scene}/ref.png"), 48, 40, &reference);
            folder.png(&format!("{scene}/{method}.png"), 48, 40, &disturbed(&reference, noise, 2));
            if (index, of_scene) != (4, 1) {
                let score = 4.8 - 0.6 * index as f64 - 0.2 * of_scene as f64;
                let _ = writeln!(opinions, "{scene},{method},{score},0.2");
            }
        }
    }
    opinions += "attic,A,3,0.2\n";
    folder.write("e.toml", text);
    folder.write("mos.csv", opinions);
    folder
}

fn json_of(folder: &Folder, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.path(name)).unwrap()).unwrap()
}

#[test]
fn the_metrics_of_a_run_are_compared_with_opinion_scores() {
    let folder = experiment();
    let said = ["mos.csv: the experiment has no attic/A"];
    folder.run(&["check", "e.toml"]).ok().says(&said);
    folder.run(&["run", "e.toml", "--output", "out"]).ok().says(&said);
    let found = json_of(&folder, "out/study.json");
    let group = &found["groups"][0];
    assert_eq!((&found["analysis"], &group["n"]), (&"metrics".into(), &9.into()));
    assert_eq!(group["unmatched"], Value::from(vec!["attic/A"]));
    let metric = |name: &str| {
        let of = group["metrics"].as_array().unwrap().iter().find(|m| m["metric"] == name);
        of.unwrap_or_else(|| panic!("{name}: {group}")).clone()
    };
    // Metrics of errors are known to be better if they are lower.
    assert_eq!(metric("mse")["lower_is_better"], true);
    assert_eq!(metric("psnr")["lower_is_better"], false);
    for name in ["mse", "psnr", "ssim"] {
        assert!(metric(name)["pearson"].as_f64().unwrap() > 0.8, "{name}");
    }
    // The same as by options.
    let by_options = folder.run(&[
        "study",
        "metrics",
        "mos.csv",
        "--column",
        "value=score",
        "--scores",
        "out/results.csv",
        "--metrics",
        "mse,psnr,ssim",
        "--lower-is-better",
        "mse",
        "--bootstrap",
        "50",
        "--format",
        "json",
    ]);
    assert_eq!(by_options.ok().json(), found);
    let page = fs::read_to_string(folder.path("out/report.html")).unwrap();
    assert!(page.contains("table-study-correlations") && page.contains("plots/study-scores.svg"));
    assert!(page.contains("attic/A"));
    // The report needs the folder alone.
    let read = |name: &str| fs::read(folder.path(name)).unwrap();
    let files = ["out/report.html", "out/study.json", "out/table-study-fits.tex"];
    let before = files.map(read);
    fs::remove_file(folder.path("mos.csv")).unwrap();
    fs::remove_file(folder.path("out/study.json")).unwrap();
    folder.run(&["report", "out"]).ok();
    assert!(before == files.map(read));
    // Without its copy, the run has everything else.
    fs::remove_file(folder.path("out/opinions.csv")).unwrap();
    folder.run(&["report", "out"]).ok().says(&["not compared with opinion scores", "opinions.csv"]);
    assert!(!fs::read_to_string(folder.path("out/report.html")).unwrap().contains("table-study"));
}

#[test]
fn shards_take_their_opinion_scores_with_them() {
    let folder = experiment();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    for shard in ["1", "2"] {
        let (of, output) = (format!("{shard}/2"), format!("s{shard}"));
        folder.run(&["run", "e.toml", "--shard", &of, "--output", &output]).ok();
    }
    fs::remove_file(folder.path("mos.csv")).unwrap();
    folder.run(&["merge", "s1", "s2", "--output", "merged"]).ok();
    for name in ["study.json", "opinions.csv", "report.html", "plots/study-scores.svg"] {
        let of = |run: &str| fs::read(folder.path(&format!("{run}/{name}"))).unwrap();
        assert!(of("whole") == of("merged"), "{name}");
    }
    // Shards with different tables are not joined.
    let other = fs::read_to_string(folder.path("s2/opinions.csv")).unwrap();
    folder.write("s2/opinions.csv", other.replace("hall,A,4.8", "hall,A,1"));
    let joined = folder.run(&["merge", "s1", "s2", "--output", "other"]);
    joined.fails(3, &["different opinion scores", "--resume"]);
    // A changed opinion costs no score.
    let folder = experiment();
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let before = json_of(&folder, "out/study.json");
    let table = fs::read_to_string(folder.path("mos.csv")).unwrap();
    folder.write("mos.csv", table.replace("hall,A,4.8", "hall,A,1"));
    folder
        .run(&["run", "e.toml", "--output", "out", "--resume"])
        .ok()
        .says(&["frames are finished"]);
    assert_ne!(json_of(&folder, "out/study.json"), before);
    // Nor do other settings of the comparison.
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", text.replace("bootstrap = 50", "bootstrap = 60"));
    folder
        .run(&["run", "e.toml", "--output", "out", "--resume"])
        .ok()
        .says(&["frames are finished"]);
    // Nor does a study that is no longer wanted stay.
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    let (start, end) = (text.find("[study]").unwrap(), text.find("[[scene]]").unwrap());
    folder.write("e.toml", format!("{}{}", &text[..start], &text[end..]));
    folder.run(&["run", "e.toml", "--output", "out", "--resume"]).ok();
    assert!(!folder.path("out/study.json").exists() && !folder.path("out/opinions.csv").exists());
}

#[test]
fn wrong_opinion_scores_are_found_before_scoring() {
    let folder = experiment();
    let wrong = |code: i32, words: &[&str]| {
        folder.run(&["check", "e.toml"]).fails(code, words);
        folder.run(&["run", "e.toml", "--output", "out"]).fails(code, words);
        assert!(!folder.path("out").join("results.csv").exists());
    };
    let table = fs::read_to_string(folder.path("mos.csv")).unwrap();
    folder.write("mos.csv", table.replace("hall,A,4.8", "hall,A,good"));
    wrong(3, &["mos.csv, line 2, column \"score\": \"good\""]);
    folder.write("mos.csv", table.replace("score", "opinion"));
    wrong(3, &["no column \"score\"", "value = \"NAME\"", "scene, method, opinion, se"]);
    fs::remove_file(folder.path("mos.csv")).unwrap();
    wrong(3, &["mos.csv cannot be read", "[study]"]);
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", text.replace("bootstrap = 50", "metrics = [\"gmsd\"]"));
    wrong(2, &["[study] compares gmsd", "[metrics]"]);
    folder.write("e.toml", format!("{text}[output]\ntables = [\"parquet\"]\n"));
    folder.run(&["check", "e.toml"]).fails(2, &["[study]", "results.csv", "tables"]);
}

#[test]
fn a_plan_predicts_shares_from_the_scores_of_a_run() {
    let folder = Folder::new();
    let results = "scene,method,eye,frame,metric,statistic,from_deg,value\n\
        hall,A,,,fvvdp,jod,,9\nhall,B,,,fvvdp,jod,,8\nhall,C,,,fvvdp,jod,,8.2\nhall,A,,0,psnr,,,30\n";
    folder.write("run/results.csv", results);
    let plan = ["study", "plan", "pairs", "--results", "run"];
    let found = folder.run(&[&plan[..], &["--format", "json"]].concat()).ok().json();
    assert!(found["prediction"].as_str().unwrap().contains("1 JOD is 75 %"), "{found}");
    let pair = &found["pairs"][0];
    assert_eq!((&pair["method"], &pair["opponent"]), (&"A".into(), &"B".into()));
    assert!((pair["share"].as_f64().unwrap() - 0.75).abs() < 1e-12);
    let alone = ["study", "plan", "pairs", "--share", "0.75", "--format", "json"];
    assert_eq!(pair["trials"], folder.run(&alone).ok().json()["trials"]);
    // Of the second and third, the third has the higher score.
    assert_eq!(found["pairs"][2]["method"], "C");
    let text = folder.run(&[&plan[..], &["--methods", "A,B"]].concat()).ok().stdout;
    assert!(text.contains("75 % of votes") && !text.contains("A – C"), "{text}");
    folder.run(&[&plan[..], &["--methods", "A,X"]].concat()).fails(3, &["\"X\"", "A, B, C"]);
    folder.run(&[&plan[..], &["--share", "0.7"]].concat()).fails(2, &["--share"]);
    folder.run(&["study", "plan", "pairs"]).fails(2, &["--share"]);
    folder
        .run(&["study", "plan", "pairs", "--share", "0.7", "--scene", "hall"])
        .fails(2, &["--scene"]);

    folder.write("run/results.csv", results.replace("fvvdp", "ssim"));
    folder.run(&plan).fails(3, &["no scores of fvvdp"]);
    folder.write(
        "p.toml",
        "name = \"p\"\n[[analysis]]\nkind = \"plan\"\nplan = \"pairs\"\nresults = \"run\"\n",
    );
    folder.write("run/results.csv", results);
    folder.run(&["study", "p.toml", "--output", "out"]).ok();
    assert_eq!(json_of(&folder, "out/study.json")["analyses"][0]["result"], found);
}

#[test]
fn names_and_directions_of_scores_are_those_of_the_experiment() {
    // A method like a formula, in a table that spreadsheets may open.
    let folder = experiment();
    for file in ["e.toml", "mos.csv"] {
        let text = fs::read_to_string(folder.path(file)).unwrap();
        let text = text.replace("\"A\"", "\"=A\"").replace(",A,", ",=A,");
        folder.write(file, text);
    }
    folder.run(&["run", "e.toml", "--output", "plain"]).ok();
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", format!("{text}[output]\nspreadsheet_safe = true\n"));
    folder.run(&["run", "e.toml", "--output", "safe"]).ok();
    assert_eq!(json_of(&folder, "safe/study.json"), json_of(&folder, "plain/study.json"));
    assert_eq!(json_of(&folder, "safe/study.json")["groups"][0]["n"], 9);
    // Where nothing fits, nothing is compared, and an earlier comparison does not stay.
    let table = fs::read_to_string(folder.path("mos.csv")).unwrap();
    folder.write("mos.csv", table.replace("hall,", "hail,").replace("road,", "rode,"));
    let said = ["the experiment has no hail/", "are not compared", "no condition"];
    folder.run(&["run", "e.toml", "--output", "safe", "--resume"]).ok().says(&said);
    assert!(!folder.path("safe").join("study.json").exists());
    // A metric that says nothing of quality is refused.
    let neither = text.replace("ssim = {}", "rms_contrast = {}");
    folder.write("e.toml", neither.replace("[study]\n", "[study]\nmetrics = [\"rms_contrast\"]\n"));
    folder.run(&["check", "e.toml"]).fails(2, &["rms_contrast says neither"]);
}

#[test]
fn metrics_that_are_better_if_lower_are_pointed_out() {
    let folder = experiment();
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let arguments = [
        "study",
        "metrics",
        "mos.csv",
        "--column",
        "value=score",
        "--scores",
        "out/results.csv",
        "--bootstrap",
        "10",
    ];
    folder.run(&arguments).ok().says(&["lower scores of mse are better", "--lower-is-better mse"]);
    let named = folder.run(&[&arguments[..], &["--lower-is-better", "mse"]].concat()).ok();
    assert!(!named.stderr.contains("lower scores"), "{}", named.stderr);
}
