//! Scenes with two eyes, which may differ in their parameters.

use fovqa_testkit::synthetic::codes;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{json, rows};

fn folder(emulate: &str) -> Folder {
    let folder = Folder::new();
    for (seed, eye) in ["left", "right"].into_iter().enumerate() {
        folder.png(&format!("{eye}.png"), 96, 80, &codes(96, 80, 3, seed as u64));
    }
    folder.write(
        "e.toml",
        format!(
            "name = \"e\"\n[view]\nfov_vertical_deg = 90\ngaze = {{ left = [50, 40], right = [46, 40] }}\n\
             [[scene]]\nname = \"s\"\nreference = {{ left = \"left.png\", right = \"right.png\" }}\n\
             [[method]]\nname = \"M\"\nemulate = {emulate}\n[metrics]\npsnr = {{}}\n"
        ),
    );
    folder
}

/// The samples of the left eye, of the right one, and of both.
fn samples(folder: &Folder) -> [String; 3] {
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let rows = rows(folder, "out");
    ["left", "right", "both"].map(|eye| {
        let mut of = rows.iter().filter(|row| row["metric"] == "samples" && row["eye"] == eye);
        of.next().unwrap()["value"].clone()
    })
}

#[test]
fn the_other_eye_has_its_own_parameters() {
    let alike = folder("{ model = \"rmfr\", sigma = 2 }");
    assert_eq!(samples(&alike), ["1920.0", "1920.0", "3840.0"]);
    let right = folder("{ model = \"rmfr\", sigma = 2, other_eye = { sigma = 4 } }");
    assert_eq!(samples(&right), ["480.0", "1920.0", "2400.0"]);
    let left =
        folder("{ model = \"rmfr\", sigma = 2, dominant = \"left\", other_eye = { sigma = 4 } }");
    assert_eq!(samples(&left), ["1920.0", "480.0", "2400.0"]);
    let summary = json(&left, "out/summary.json");
    let comparisons = summary["comparisons"].as_array().unwrap().iter();
    let shares = comparisons.map(|comparison| comparison["samples"]["share"].as_f64().unwrap());
    assert_eq!(shares.collect::<Vec<_>>(), [0.25, 0.0625, 0.15625]);
}

/// DEAMP's variants of two, four and six layers, and a budget for each eye.
#[test]
fn layers_and_budgets_may_differ() {
    let deamp = folder(
        "{ model = \"deamp\", sigmas = [2.51, 3.6, 4.8], bounds_deg = [15, 30, 45], dominant = \"left\", \
         other_eye = { sigmas = [2.9, 4.2, 5.6] } }",
    );
    let [left, right, both] = samples(&deamp).map(|count| count.parse::<f64>().unwrap());
    assert!(left > right && right > 0.0 && (left + right - both).abs() < 1e-9);
    let budgets = folder("{ model = \"rmfr\", budget = 0.25, other_eye = { budget = 0.0625 } }");
    assert_eq!(samples(&budgets), ["480.0", "1920.0", "2400.0"]);
}
