//! Which figures a run has, and that what is in them is what was found.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;

use crate::experiment_folder::{HEAD, experiment, json, rows, two_scenes};
use crate::fovqa::Folder;

/// The data beside a figure, a row a line.
fn data(folder: &Folder, figure: &str) -> Vec<Vec<String>> {
    let path = folder.path(&format!("reports/e/plots/{figure}.csv"));
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.records().map(|r| r.unwrap().iter().map(str::to_owned).collect()).collect()
}

fn figures(folder: &Folder) -> Vec<String> {
    let files = fs::read_dir(folder.path("reports/e/plots")).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> =
        names.filter_map(|name| Some(name.strip_suffix(".svg")?.to_owned())).collect();
    names.sort_unstable();
    names
}

/// A comparison of summary.json.
fn comparison(folder: &Folder, scene: &str, method: &str) -> Value {
    let summary = json(folder, "reports/e/summary.json");
    let comparisons = summary["comparisons"].as_array().unwrap();
    comparisons.iter().find(|c| c["scene"] == scene && c["method"] == method).unwrap().clone()
}

#[test]
fn a_run_that_asks_for_none_has_all_that_fit() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let profiles = ["", "-hall", "-room"].map(|scene| format!("profile-psnr{scene}"));
    let mut want: Vec<String> = profiles.to_vec();
    want.extend(profiles.map(|name| name.replace("psnr", "ssim")));
    for metric in ["fpsnr", "psnr", "ssim"] {
        want.extend([format!("bars-{metric}"), format!("frames-{metric}")]);
    }
    want.sort_unstable();
    assert_eq!(figures(&folder), want, "PSNR says what MSE would");
    // Without a view nothing has an eccentricity; one frame has no spread.
    let text = experiment("").replace("[view]\nfov_vertical_deg = 60\n", "");
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml", "--frames", "0..1"]).ok();
    assert_eq!(figures(&folder), ["bars-psnr", "bars-ssim"]);
}

#[test]
fn figures_show_what_was_found() {
    let folder = two_scenes();
    folder.run(&["run", "e.toml"]).ok();
    let band = |scene: &str, method: &str, band: usize| {
        let band = &comparison(&folder, scene, method)["bands"][band];
        let mean = band["ssim"]["mean"].as_f64();
        (f64::midpoint(band["from_deg"].as_f64().unwrap(), band["to_deg"].as_f64().unwrap()), mean)
    };
    let number = |cell: &String| cell.parse::<f64>().ok();
    let bands = comparison(&folder, "room", "B")["bands"].as_array().unwrap().len();
    let of_b = |figure: &str| {
        let rows = data(&folder, figure).into_iter().filter(|row| row[0] == "B");
        rows.map(|row| (number(&row[1]).unwrap(), number(&row[2]))).collect::<Vec<_>>()
    };
    assert_eq!(
        of_b("profile-ssim-room"),
        (0..bands).map(|b| band("room", "B", b)).collect::<Vec<_>>()
    );
    for (index, (_, value)) in of_b("profile-ssim").into_iter().enumerate() {
        let [room, hall] = ["room", "hall"].map(|scene| band(scene, "B", index).1.unwrap());
        assert!((value.unwrap() - f64::midpoint(room, hall)).abs() < 1e-15);
    }
    let bars = data(&folder, "bars-psnr");
    for row in bars.iter().filter(|row| row[0] != "Average") {
        let mean = comparison(&folder, &row[0], &row[1])["metrics"]["psnr"]["mean"].as_f64();
        assert_eq!(number(&row[2]), mean);
    }
    assert_eq!(bars.iter().filter(|row| row[0] == "Average").count(), 2);
    let spread = data(&folder, "frames-fpsnr");
    let spread: Vec<&String> =
        spread.iter().filter(|row| row[0] == "hall" && row[1] == "A").map(|row| &row[2]).collect();
    let values = rows(&folder, "reports/e");
    let values: Vec<&String> = values
        .iter()
        .filter(|r| r["scene"] == "hall" && r["method"] == "A" && r["metric"] == "fpsnr")
        .map(|row| &row["value"])
        .collect();
    assert_eq!(spread, values);
}

/// What is not of the same scenes for all methods is no mean of them.
#[test]
fn means_over_scenes_are_of_scenes_that_all_methods_have() {
    let folder = two_scenes();
    folder.write("e.toml", experiment("scenes = [\"hall\"]\n"));
    folder.run(&["run", "e.toml"]).ok();
    let figures = figures(&folder);
    assert!(figures.contains(&"profile-psnr-hall".to_owned()));
    assert!(!figures.contains(&"profile-psnr".to_owned()), "{figures:?}");
    assert!(!data(&folder, "bars-psnr").iter().any(|row| row[0] == "Average"));
}

#[test]
fn figures_of_two_eyes_are_of_both() {
    let folder = two_scenes();
    folder.write(
        "e.toml",
        format!(
            "{HEAD}[[scene]]\nname = \"s\"\nreference = {{ left = \"room/gt\", right = \"hall/gt\" }}\n\
             [[method]]\nname = \"A\"\ntest = {{ left = \"room/a\", right = \"hall/b\" }}\n"
        ),
    );
    folder.run(&["run", "e.toml"]).ok();
    let rows = rows(&folder, "reports/e");
    let of = |row: &&BTreeMap<String, String>| {
        row["eye"] == "both" && row["metric"] == "psnr" && row["from_deg"].is_empty()
    };
    let both: Vec<&String> = rows.iter().filter(of).map(|row| &row["value"]).collect();
    let figure = data(&folder, "frames-psnr");
    assert_eq!(figure.iter().map(|row| &row[2]).collect::<Vec<_>>(), both);
    assert!(
        !figures(&folder).iter().any(|name| name.starts_with("bars")),
        "one method in one scene"
    );
}
