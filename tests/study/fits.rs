//! Unusual tables of psychometric functions, staircases, ratings and metrics, and plans.

use std::fmt::Write as _;

use serde_json::Value;

use super::unusual::assert_null_values_have_reasons;
use crate::fovqa::Folder;

const SCORES: &str =
    "scene,method,metric,value\ns,A,psnr,30\ns,B,psnr,30\ns,C,psnr,inf\ns,D,psnr,40\n";

fn json(csv: &str, arguments: &[&str]) -> Value {
    let folder = Folder::new();
    folder.write("t.csv", csv);
    folder.write("results.csv", SCORES);
    let all = [&["study", arguments[0], "t.csv"], &arguments[1..], &["--format", "json"]].concat();
    folder.run(&all).ok().json()
}

#[test]
fn psychometric_functions_of_few_or_extreme_answers_have_reasons() {
    let two = "level,correct,trials\n1,3,9\n2,9,9\n";
    let huge = "level,correct,trials\n-1e50,3,9\n0,9,10000000\n1e50,9,9\n";
    let near = "level,correct\n1,0\n1.0000000000000002,1\n2,1\n";
    let wrong = "level,correct,trials\n1,0,9\n2,0,9\n3,0,9\n";
    let none = "level,correct,trials\n1,0,0\n2,0,0\n";
    for csv in [two, huge, near, wrong, none] {
        for options in
            [&[][..], &["--direction", "decreasing", "--guess", "0"], &["--lapse", "0.02"]]
        {
            let few = ["psychometric", "--bootstrap", "5", "--overdispersion", "off"];
            let result = json(csv, &[&few, options].concat());
            assert_null_values_have_reasons(&result, "");
        }
        assert_null_values_have_reasons(&json(csv, &["psychometric", "--bootstrap", "0"]), "");
    }
    let result = json(none, &["psychometric"]);
    assert_eq!(result["groups"][0]["ml"], Value::Null);
}

#[test]
fn many_different_levels_are_fitted_in_a_few_seconds() {
    let mut csv = "level,correct\n".to_owned();
    for i in 0_u32..3000 {
        // Answers of a function with m near 1.5, by a fixed sequence of digits.
        let level = f64::from(i) / 1000.0;
        let chance = 0.5 + 0.5 / (1.0 + f64::exp(-6.0 * (level - 1.5)));
        let digit = f64::from(i.wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24);
        let _ = writeln!(csv, "{level},{}", u8::from(digit < chance));
    }
    let result = json(&csv, &["psychometric", "--bootstrap", "20", "--threads", "1"]);
    assert_eq!(result, json(&csv, &["psychometric", "--bootstrap", "20", "--threads", "2"]));
    let group = &result["groups"][0];
    for threshold in [&group["ml"]["threshold"], &group["posterior"]["median"]["threshold"]] {
        assert!((threshold.as_f64().unwrap() - 1.5).abs() < 0.1, "{threshold}");
    }
}

#[test]
fn staircases_and_ratings_of_one_participant_have_reasons() {
    let trials = "participant,trial,level,correct\nP,1,4,1\nP,2,3,0\nP,3,4,1\nP,4,3,1\n";
    for drop in ["0", "1", "99"] {
        let result = json(trials, &["staircase", "--drop-reversals", drop]);
        assert_null_values_have_reasons(&result, "");
        assert_eq!(result["groups"][0]["staircases"][0]["reversal_trials"][0], 2);
    }
    let scores = "participant,level,fx,fy,value\nP,1,0,0,3\nP,2,0,1,1e50\nP,3,1,0,\n";
    for options in [&["--threshold", "2"][..], &["--grid", "fx,fy", "--smooth", "binomial"], &[]] {
        let result = json(scores, &[&["ratings"], options].concat());
        assert_null_values_have_reasons(&result, "");
    }
}

#[test]
fn metrics_of_few_or_equal_conditions_have_reasons() {
    for csv in [
        "scene,method,value\ns,A,1\ns,D,2\n",
        "scene,method,value,se\ns,A,1,0\ns,B,1,0\ns,C,1,\n",
        "scene,method,value\ns,X,1\n",
    ] {
        let result = json(csv, &["metrics", "--scores", "results.csv"]);
        assert_null_values_have_reasons(&result, "");
    }
    let result =
        json("scene,method,value\ns,A,1\ns,C,2\n", &["metrics", "--scores", "results.csv"]);
    assert_eq!(result["groups"][0]["unmatched"][0], "s/C");
}

#[test]
fn plans_say_why_values_are_undefined() {
    let folder = Folder::new();
    let pairs =
        ["study", "plan", "pairs", "--share", "0.5", "--width", "0.0001", "--format", "json"];
    let plan = folder.run(&pairs).ok().json();
    assert_eq!(plan["trials"], Value::Null);
    assert_null_values_have_reasons(&plan, "");
    let one = [
        "study",
        "plan",
        "staircase",
        "--participants",
        "1",
        "--trials",
        "2",
        "--threshold",
        "1",
        "--width",
        "1",
        "--start",
        "2",
        "--steps",
        "0.5",
        "--studies",
        "5",
        "--format",
        "json",
    ];
    let plan = folder.run(&one).ok().json();
    assert_eq!(plan["failed"], 5);
    assert_null_values_have_reasons(&plan, "");
}
