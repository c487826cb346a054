//! The search for limits.

use super::{HEAD, METRICS, RMFR, SCENE, SIZE, folder, number, smooth, table};
use crate::fovqa::Folder;
use crate::runs::experiment_folder::{bytes, json};

fn rule(limits: &str) -> String {
    format!("[[gate]]\nmetric = \"psnr\"\n{limits}\n")
}

/// The limit is where a sweep of 200 steps has it.
#[test]
fn a_limit_is_where_a_fine_sweep_has_it() {
    let sweep = "[sweep]\nbudget = { from = 0.02, to = 1, steps = 200, scale = \"log\" }\n";
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{sweep}"));
    folder.run(&["run", "e.toml", "--output", "swept"]).ok();
    let curve = table(&folder, "swept/plots/sweep-psnr.csv");
    let curve: Vec<(f64, f64)> = curve
        .iter()
        .filter(|row| row["series"] == "R")
        .map(|row| (number(row, "x"), number(row, "y")))
        .collect();
    assert_eq!(curve.len(), 200);
    let least = curve[100].1;
    folder.write(
        "l.toml",
        format!("{HEAD}{SCENE}{RMFR}{METRICS}{}", rule(&format!("at_least = {least}"))),
    );
    let found = folder.run(&["limit", "l.toml", "--from", "0.02", "--output", "out"]).ok();
    let limits = json(&folder, "out/limits.json");
    let limit = &limits["limits"][0];
    // Coming from above, the last step at which the rule holds.
    let fails = curve.iter().rposition(|(_, psnr)| *psnr < least).unwrap();
    let (holds, fails) = (curve[fails + 1].0, curve[fails].0);
    let at = limit["limit"].as_f64().unwrap();
    assert!(fails * 0.999 < at && at <= holds * 1.001, "{fails} {at} {holds}");
    let fails_at = limit["fails_at"].as_f64().unwrap();
    assert!(fails_at < at && at - fails_at <= 0.001 * at);
    assert!(limit["value"].as_f64().unwrap() >= least);
    assert!((limit["ideal_share"].as_f64().unwrap() / at - 1.0).abs() < 1e-3);
    assert_eq!(limit["parameter"], "sigma");
    assert!(
        found.stdout.contains("Smallest budget at which each rule still holds"),
        "{}",
        found.stdout
    );
    assert!(folder.path("out/plots/limit-psnr.svg").exists());
    let before = bytes(&folder.path("out"));
    folder.run(&["report", "out"]).ok().says(&[]);
    assert!(before == bytes(&folder.path("out")), "drawn again, it is the same");
    folder.run(&["limit", "l.toml", "--from", "0.02", "--output", "one", "--threads", "1"]).ok();
    assert!(before == bytes(&folder.path("one")), "threads change nothing");
}

#[test]
fn of_a_parameter_the_largest_value_is_found() {
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{}", rule("at_least = 26")));
    let options = ["--vary", "sigma", "--from", "1", "--to", "9"];
    folder.run(&[&["limit", "e.toml", "--output", "out"][..], &options].concat()).ok();
    let limits = json(&folder, "out/limits.json");
    let limit = &limits["limits"][0];
    let (at, fails) = (limit["limit"].as_f64().unwrap(), limit["fails_at"].as_f64().unwrap());
    assert!(1.0 < at && at < fails && fails < 9.0, "{at} {fails}");
    // The values are those of a run.
    for (name, sigma, holds) in [("at", at, true), ("fails", fails, false)] {
        let emulate = format!("{{ model = \"rmfr\", sigma = {sigma} }}");
        let rmfr = format!("[[method]]\nname = \"R\"\nemulate = {emulate}\n");
        let rule = rule("at_least = 26");
        folder.write("e.toml", format!("{HEAD}{SCENE}{rmfr}{METRICS}{rule}"));
        let run = folder.run(&["gate", "e.toml", "--output", name]);
        assert_eq!(run.code, i32::from(!holds), "{sigma}: {}", run.stdout);
    }
}

/// A rule that holds between two budgets only has a limit, but is not monotone.
#[test]
fn a_rule_that_changes_twice_is_said_not_to_be_monotone() {
    let of = |limits: &str| {
        format!(
            "{HEAD}{SCENE}{RMFR}[metrics]\nhaar = {{}}\n[[gate]]\nmetric = \"haar\"\nstatistic = \"energy\"\n\
             image = \"ratio\"\nlevel = 1\nband_deg = [0, 10]\n{limits}\n"
        )
    };
    let folder = folder(&of("at_least = 0"));
    folder.run(&["limit", "e.toml", "--output", "all"]).fails(2, &["the rule holds everywhere"]);
    let mut all: Vec<f64> =
        table(&folder, "all/limits.csv").iter().map(|row| number(row, "value")).collect();
    all.sort_by(f64::total_cmp);
    let (low, high) = (all[all.len() / 3], all[2 * all.len() / 3]);
    folder.write("e.toml", of(&format!("at_least = {low}\nat_most = {high}")));
    let run = folder.run(&["limit", "e.toml", "--output", "out"]).ok();
    let limits = json(&folder, "out/limits.json");
    assert_eq!(limits["limits"][0]["monotone"], false);
    let value = limits["limits"][0]["value"].as_f64().unwrap();
    assert!((low..=high).contains(&value), "{value}");
    assert!(run.stdout.contains("not monotone"), "{}", run.stdout);
}

#[test]
fn each_rule_applies_to_its_scenes_and_methods() {
    let scenes = format!("{SCENE}[[scene]]\nname = \"t\"\nreference = \"other.png\"\n");
    let methods = format!(
        "{RMFR}[[method]]\nname = \"K\"\nemulate = {{ model = \"kfr\", sigma = 3 }}\n\
         [[method]]\nname = \"F\"\nemulate = {{ model = \"full\" }}\n\
         [[method]]\nname = \"D\"\ntest = \"other.png\"\nscenes = [\"s\"]\n"
    );
    let rules = format!(
        "{}scene = \"t\"\n{}method = \"K\"\n",
        rule("at_least = 25"),
        rule("at_least = 26")
    );
    let folder = folder(&format!("{HEAD}{scenes}{methods}{METRICS}{rules}"));
    folder.run(&["limit", "e.toml", "--output", "out"]).ok();
    let found = table(&folder, "out/table-limits.csv");
    let found: Vec<[&str; 3]> =
        found.iter().map(|row| ["rule", "scene", "method"].map(|c| row[c].as_str())).collect();
    assert_eq!(
        found,
        [
            ["psnr mean ≥ 25", "t", "R"],
            ["psnr mean ≥ 25", "t", "K"],
            ["psnr mean ≥ 26", "s", "K"],
            ["psnr mean ≥ 26", "t", "K"],
        ]
    );
}

#[test]
fn a_rule_without_a_limit_is_an_error() {
    let folder = folder(&format!("{HEAD}{SCENE}{RMFR}{METRICS}{}", rule("at_least = 5")));
    folder
        .run(&["limit", "e.toml", "--output", "out"])
        .fails(2, &["no rule has a limit: s, R: the rule holds everywhere from 0.01"]);
    // All that was measured is there nevertheless.
    assert!(folder.path("out/limits.csv").exists());
    folder.write("e.toml", format!("{HEAD}{SCENE}{RMFR}{METRICS}{}", rule("at_least = 90")));
    folder
        .run(&["limit", "e.toml", "--output", "out"])
        .fails(2, &["s, R: the rule holds nowhere from 0.01 to 1"]);
}

#[test]
fn what_cannot_be_searched_is_said() {
    let with = |methods: &str, rest: &str| format!("{HEAD}{SCENE}{methods}{METRICS}{rest}");
    let disk = "[[method]]\nname = \"D\"\ntest = \"other.png\"\n";
    for (experiment, options, words) in [
        (with(RMFR, ""), &[][..], "it has no [[gate]] rule whose limit could be searched"),
        (with(disk, &rule("at_least = 20")), &[], "no method that is emulated has budget to vary"),
        (with(RMFR, &rule("max_drop = 1")), &[], "compares with a baseline"),
        (
            with(RMFR, &(rule("at_least = 20") + "[sweep]\n\"R.fx\" = [0.1, 0.2]\n")),
            &[],
            "it has a [sweep]",
        ),
        (with(RMFR, &rule("at_least = 20")), &["--vary", "sigme"], "has sigme to vary"),
        (
            with(RMFR, &rule("at_least = 20")),
            &["--vary", "sigma"],
            "the range of sigma is not given",
        ),
        (
            with(RMFR, &rule("at_least = 20")),
            &["--from", "0.5", "--to", "0.2"],
            "--from 0.5 is not below --to 0.2",
        ),
        (with(RMFR, &rule("at_least = 20")), &["--method", "Q"], "there is no method \"Q\""),
        (with(RMFR, &rule("at_least = 20")), &["--tolerance", "0"], "a tolerance of 0"),
        (
            with(
                "[[method]]\nname = \"C\"\nemulate = { model = \"cps\" }\n",
                &rule("at_least = 20"),
            ),
            &["--to", "0.01"],
            "can be reached, but not from 0.01 to 0.01",
        ),
    ] {
        let folder = folder(&experiment);
        folder
            .run(&[&["limit", "e.toml", "--output", "out"][..], options].concat())
            .fails(2, &[words]);
        assert!(!folder.path("out/limits.json").exists());
    }
    // The folder of a run is not replaced.
    let folder = folder(&with(RMFR, &rule("at_least = 20")));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    folder
        .run(&["limit", "e.toml", "--output", "out"])
        .fails(3, &["contains the results of `fovqa run`"]);
}

/// A frame that one eye lacks leaves no value for both, rather than that of the other frames.
#[test]
fn a_frame_that_cannot_be_read_leaves_no_limit() {
    let folder = Folder::new();
    for (seed, file) in ["l/0.png", "l/1.png", "r/0.png", "r/1.png"].into_iter().enumerate() {
        folder.png(file, SIZE.0, SIZE.1, &smooth(seed as u64));
    }
    let whole = std::fs::read(folder.path("l/1.png")).unwrap();
    folder.write("l/1.png", &whole[..whole.len() / 2]);
    let scene = "[[scene]]\nname = \"s\"\nreference = { left = \"l\", right = \"r\" }\n";
    folder.write("e.toml", format!("{HEAD}{scene}{RMFR}{METRICS}{}", rule("at_least = 26")));
    folder.run(&["limit", "e.toml", "--output", "out"]).fails(2, &["no rule has a limit", "1.png"]);
    let limits = json(&folder, "out/limits.json");
    assert_eq!(limits["limits"][0]["state"], "not_scored");
}
