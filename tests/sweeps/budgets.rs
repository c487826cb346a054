//! Budgets of single methods, of the whole experiment, and swept.

use super::{HEAD, METRICS, SCENE, folder, number, table};
use crate::fovqa::Folder;
use crate::runs::experiment_folder::{json, rows};

fn method(model: &str, rest: &str) -> String {
    format!("[[method]]\nname = \"{model}\"\nemulate = {{ model = \"{model}\"{rest} }}\n")
}

/// The value of a row of a method.
fn value(folder: &Folder, method: &str, metric: &str) -> Option<f64> {
    let rows = rows(folder, "out");
    let row = rows.iter().find(|row| row["method"] == method && row["metric"] == metric)?;
    Some(row["value"].parse().unwrap())
}

const SOLVED: [(&str, &str); 7] = [
    ("rmfr", "sigma"),
    ("kfr", "sigma"),
    ("lafr", "sigma"),
    ("vafr", "factor"),
    ("cps", "transition_deg"),
    ("linear", "outer_deg"),
    ("visual_polar", "samples_per_pixel"),
];

/// Every method reaches the budget of the experiment to within 0.1 %, and says how.
#[test]
fn a_budget_of_the_experiment_is_that_of_every_method() {
    let methods: String = SOLVED.map(|(model, _)| method(model, "")).concat();
    let others = method("full", "") + &method("stable", "") + &method("deamp", "");
    let own = "[[method]]\nname = \"own\"\nemulate = { model = \"rmfr\", budget = 0.5 }\n\
               [[method]]\nname = \"kept\"\nemulate = { model = \"rmfr\", sigma = 2, budget = \"none\" }\n";
    let budget = "budget = 0.3\n";
    let folder = folder(&format!("{budget}{HEAD}{SCENE}{methods}{others}{own}{METRICS}"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let budgets = table(&folder, "out/table-budgets.csv");
    for (model, parameter) in SOLVED {
        let row = budgets.iter().find(|row| row["method"] == model).unwrap();
        let (asked, ideal) = (number(row, "budget_share"), number(row, "ideal_share"));
        assert!((asked - 0.3).abs() < 1e-12 && (ideal / 0.3 - 1.0).abs() < 1e-3, "{row:?}");
        assert_eq!(row["parameter"], parameter);
        let solved = value(&folder, model, "budget_value").unwrap();
        assert_eq!(solved.to_bits(), number(row, "value").to_bits(), "{model}");
        let share = value(&folder, model, "samples_share").unwrap();
        assert_eq!(share.to_bits(), number(row, "rounded_share").to_bits(), "{model}");
    }
    // Of a list, each number is a row.
    let of = rows(&folder, "out");
    let of = of.iter().filter(|row| row["method"] == "deamp" && row["metric"] == "budget_value");
    let levels: Vec<&str> = of.map(|row| row["level"].as_str()).collect();
    assert_eq!(levels, ["1", "2", "3"]);
    for method in ["full", "stable", "kept"] {
        assert_eq!(value(&folder, method, "budget_share"), None, "{method}");
    }
    assert_eq!(value(&folder, "kept", "samples_share"), Some(0.25));
    assert_eq!(value(&folder, "own", "budget_share"), Some(0.5));
    let summary = json(&folder, "out/summary.json");
    let budget = &summary["comparisons"][0]["samples"]["budget"];
    assert_eq!(budget["share"].as_f64(), Some(0.3));
    assert_eq!(budget["value"].as_array().unwrap().len(), 1);
}

/// The samples on the screen may be counted instead.
#[test]
fn a_budget_may_count_samples_on_the_screen() {
    let kfr = method("kfr", "");
    let budget = "budget = 0.3\nbudget_of = \"on_screen\"\n";
    let folder = folder(&format!("{budget}{HEAD}{SCENE}{kfr}{METRICS}"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let on_screen = value(&folder, "kfr", "samples_on_screen").unwrap() / (96.0 * 80.0);
    assert!((on_screen / 0.3 - 1.0).abs() < 0.03, "{on_screen}");
    assert!(value(&folder, "kfr", "samples_share").unwrap() > 0.35);
}

#[test]
fn budgets_are_swept_for_all_methods_at_once() {
    let methods = method("rmfr", "") + &method("kfr", "") + &method("full", "");
    let sweep = "[sweep]\nbudget = [0.1, 0.2, 0.4]\n";
    let folder = folder(&format!("{HEAD}{SCENE}{methods}{METRICS}{sweep}"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let curves = table(&folder, "out/plots/sweep-psnr.csv");
    for method in ["rmfr", "kfr"] {
        let of: Vec<_> = curves.iter().filter(|row| row["series"] == method).collect();
        let at: Vec<f64> = of.iter().map(|row| number(row, "x")).collect();
        assert_eq!(at, [0.1, 0.2, 0.4], "{method}");
        let values: Vec<f64> = of.iter().map(|row| number(row, "y")).collect();
        assert!(values[0] < values[1] && values[1] < values[2], "{method}: {values:?}");
    }
    let budgets = table(&folder, "out/table-budgets.csv");
    assert_eq!(budgets.len(), 6);
    assert!(
        budgets.iter().all(|row| (number(row, "ideal_share") / number(row, "budget_share") - 1.0)
            .abs()
            < 1e-3)
    );
}

/// With two eyes, each eye has its own parameter.
#[test]
fn each_eye_has_its_own_solution() {
    let folder = folder("");
    folder.write(
        "e.toml",
        format!(
            "budget = 0.3\nname = \"e\"\n[view]\nfov_vertical_deg = 90\n\
             gaze = {{ left = [20, 40], right = [48, 40] }}\n\
             [[scene]]\nname = \"s\"\nreference = {{ left = \"gt.png\", right = \"other.png\" }}\n{}{METRICS}",
            method("cps", "")
        ),
    );
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let budgets = table(&folder, "out/table-budgets.csv");
    let eyes: Vec<&str> = budgets.iter().map(|row| row["eye"].as_str()).collect();
    assert_eq!(eyes, ["left", "right"]);
    assert!((number(&budgets[0], "value") - number(&budgets[1], "value")).abs() > 1e-3);
}
