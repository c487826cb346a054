//! Which figures a run has, and that what is in them is what was found.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;

use crate::fovqa::Folder;
use crate::frames::moving_frames::{H, W, motion, moving, part, write};
use crate::runs::experiment_folder::{HEAD, experiment, json, rows, two_scenes};

/// The data beside a figure, a row a line.
pub(super) fn data(folder: &Folder, figure: &str) -> Vec<Vec<String>> {
    let path = folder.path(&format!("reports/e/plots/{figure}.csv"));
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.records().map(|r| r.unwrap().iter().map(str::to_owned).collect()).collect()
}

pub(super) fn figures(folder: &Folder) -> Vec<String> {
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

/// A scene in which nothing of a method could be scored counts for no method: not in the table, not in
/// bars, and not in profiles, which once left the method out instead.
#[test]
fn one_rule_for_means_over_scenes() {
    let folder = two_scenes();
    let third = "[[scene]]\nname = \"cellar\"\nreference = \"cellar/gt\"\n";
    for name in ["gt", "a", "b"] {
        let frames = fs::read_dir(folder.path(&format!("room/{name}"))).unwrap();
        for frame in frames.map(|entry| entry.unwrap().path()) {
            let file = frame.file_name().unwrap().to_str().unwrap();
            let broken = name == "b";
            let bytes = if broken { b"no picture".to_vec() } else { fs::read(&frame).unwrap() };
            folder.write(&format!("cellar/{name}/{file}"), bytes);
        }
    }
    folder.write("e.toml", experiment("").replacen("[[method]]", &format!("{third}[[method]]"), 1));
    assert_eq!(folder.run(&["run", "e.toml"]).code, 3);
    let label = "Average of the 2 scenes all methods have";
    let table = fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    assert!(table.contains(label), "{table}");
    let bars = data(&folder, "bars-psnr");
    assert_eq!(bars.iter().filter(|row| row[0] == label).count(), 2);
    let profile = data(&folder, "profile-psnr");
    for method in ["A", "B"] {
        let of = |name: &str, method: &str| {
            let bands = comparison(&folder, name, method)["bands"].clone();
            bands[0]["psnr"]["mean"].as_f64().unwrap()
        };
        let first = profile.iter().find(|row| row[0] == method).unwrap();
        let wanted = f64::midpoint(of("room", method), of("hall", method));
        assert!((first[2].parse::<f64>().unwrap() - wanted).abs() < 1e-12, "{method}");
    }
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("mean over 2 scenes that all methods have"));
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

/// One scene of moving frames with two methods, and a gaze that moves by `degrees` from the centre in
/// frame 2.
fn sequence(degrees: f64, rest: &str) -> Folder {
    let folder = Folder::new();
    for frame in 0..4 {
        let of = |seed| part(moving(seed, frame * frame));
        write(&folder, &format!("gt/{frame}.exr"), of(1).with(&motion([1.5, 0.0])));
        write(&folder, &format!("a/{frame}.exr"), of(2));
        write(&folder, &format!("b/{frame}.exr"), of(3));
    }
    let focal = H as f64 / 2.0 / 30f64.to_radians().tan();
    let (x, y) = (W as f64 / 2.0, H as f64 / 2.0);
    let far = x + focal * degrees.to_radians().tan();
    folder.write(
        "gaze.csv",
        format!("frame,x_px,y_px\n0,{x},{y}\n1,{x},{y}\n2,{far},{y}\n3,{far},{y}\n"),
    );
    let methods =
        "[[method]]\nname = \"A\"\ntest = \"a\"\n[[method]]\nname = \"B\"\ntest = \"b\"\n";
    folder.write(
        "e.toml",
        format!("{HEAD}bands_deg = [0, 10, 20, 60]\ngaze = {{ trace = \"gaze.csv\" }}\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n{methods}{rest}"),
    );
    folder.run(&["run", "e.toml"]).ok();
    folder
}

/// The cells of a table, with its header.
fn table(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.path(&format!("reports/e/{name}.csv"))).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_sequence_with_default_metrics_has_all_figures_of_them() {
    let folder = sequence(3.0, "");
    let mut want: Vec<String> = Vec::new();
    for metric in ["atd", "haar", "psnr", "rms-contrast", "ssim"] {
        want.push(format!("profile-{metric}"));
    }
    for metric in ["fpsnr", "psnr", "ssim"] {
        want.extend([format!("bars-{metric}"), format!("frames-{metric}")]);
    }
    want.extend(["ratio-profile-haar", "ratio-profile-rms-contrast"].map(str::to_owned));
    want.push("sequence-atd".to_owned());
    want.sort_unstable();
    assert_eq!(figures(&folder), want);
    for name in ["ratios-rms-contrast", "ratios-haar", "ratios-atd"] {
        for ending in ["md", "csv", "tex"] {
            let file = folder.path(&format!("reports/e/{name}.{ending}"));
            assert!(fs::metadata(&file).is_ok_and(|file| file.len() > 100), "{name}.{ending}");
        }
    }
    for figure in &want {
        for ending in ["svg", "png", "csv"] {
            assert!(
                folder.path(&format!("reports/e/plots/{figure}.{ending}")).exists(),
                "{figure}"
            );
        }
    }
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("plots/sequence-atd") && page.contains("RMS contrast, test / reference"));
}

/// In percent, of the summary's ratios; a row a band and, of differences over time, one of the whole frame.
#[test]
fn tables_of_ratios_are_those_of_the_summary() {
    let plots = "[[plot]]\nkind = \"ratios\"\nmetric = \"haar\"\nlevels = [1, 3]\nstatistic = \"max_abs\"\n\
                 [[plot]]\nkind = \"ratios\"\nmetric = \"atd\"\n[[plot]]\nkind = \"ratios\"\nmetric = \"rms_contrast\"\nmethods = [\"B\"]\n";
    let folder = sequence(3.0, plots);
    let close = |cell: &str, ratio: &Value| {
        let (cell, ratio) = (cell.parse::<f64>().unwrap(), ratio.as_f64().unwrap());
        assert!((cell - 100.0 * ratio).abs() < 1e-9, "{cell} for {ratio}");
    };
    let haar = table(&folder, "ratios-haar");
    let columns = ["A", "B"]
        .map(|method| [1, 3].map(|level| format!("haar_max_abs_{level}_percent {method}")));
    let [[a1, a3], [b1, b3]] = columns;
    assert_eq!(haar[0], ["eccentricity".to_owned(), a1, b1, a3, b3]);
    let labels: Vec<&str> = haar[1..].iter().map(|row| &*row[0]).collect();
    assert_eq!(labels, ["0° to 10°", "10° to 20°", "20° to 60°"]);
    let atd = table(&folder, "ratios-atd");
    assert_eq!(atd[0], ["eccentricity", "atd_percent A", "atd_percent B"]);
    let contrast = table(&folder, "ratios-rms-contrast");
    assert_eq!(contrast[0], ["eccentricity", "rms_contrast_percent B"]);
    for (index, method) in ["A", "B"].into_iter().enumerate() {
        let summary = comparison(&folder, "s", method);
        for band in 0..3 {
            for (column, level) in [(1, 1), (3, 3)] {
                let record = &summary["haar"][3 * (level - 1) + band];
                assert_eq!(record["level"], level);
                let ratio = record["test"]["max_abs"]["max"].as_f64().unwrap()
                    / record["reference"]["max_abs"]["max"].as_f64().unwrap();
                assert_eq!(record["ratio"]["max_abs"], ratio);
                close(&haar[band + 1][column + index], &record["ratio"]["max_abs"]);
            }
            close(&atd[band + 1][1 + index], &summary["bands"][band]["atd"]["ratio"]);
            if method == "B" {
                close(&contrast[band + 1][1], &summary["bands"][band]["rms_contrast"]["ratio"]);
            }
        }
        assert_eq!(atd[4][0], "whole frame");
        close(&atd[4][1 + index], &summary["atd"]["ratio"]);
    }
    let text = fs::read_to_string(folder.path("reports/e/ratios-atd.md")).unwrap();
    let shown: f64 = atd[4][1].parse().unwrap();
    assert!(text.contains(&format!("{shown:.1}")), "{text}");
    let latex = fs::read_to_string(folder.path("reports/e/ratios-haar.tex")).unwrap();
    assert!(latex.contains("level 3") && latex.contains("max"), "{latex}");
    assert!(!folder.path("reports/e/plots").exists(), "tables alone were asked for");
}

#[test]
fn the_wavelet_has_a_panel_a_level() {
    let plots = "[metrics]\nhaar = { levels = 4 }\nrms_contrast = {}\n\
                 [[plot]]\nkind = \"profile\"\nmetric = \"haar\"\nlevels = [2, 4]\nstatistic = \"mean_abs\"\n\
                 [[plot]]\nkind = \"profile\"\nmetric = \"haar\"\n[[plot]]\nkind = \"profile\"\nmetric = \"rms_contrast\"\n";
    let folder = sequence(3.0, plots);
    assert_eq!(figures(&folder), ["profile-haar", "profile-haar-2", "profile-rms-contrast"]);
    let number = |cell: &str| cell.parse::<f64>().ok();
    let of = |series: &str| comparison(&folder, "s", if series == "B" { "B" } else { "A" });
    let side = |series: &str| if series == "reference" { "reference" } else { "test" };
    for (figure, levels, statistic) in
        [("profile-haar", &[2, 4][..], "mean_abs"), ("profile-haar-2", &[1, 2, 3, 4], "energy")]
    {
        let rows = data(&folder, figure);
        assert_eq!(rows.len(), levels.len() * 3 * 3, "{figure}: two methods and the reference");
        for (index, row) in rows.iter().enumerate() {
            let (level, band) = (levels[index / 9], index % 3);
            let pixels = 1 << level;
            assert_eq!(row[0], format!("Level {level} ({pixels}×{pixels} px)"));
            assert_eq!(row[1], ["A", "B", "reference"][index / 3 % 3]);
            assert_eq!(number(&row[2]), Some([5.0, 15.0, 40.0][band]));
            let want =
                &of(&row[1])["haar"][3 * (level - 1) + band][side(&row[1])][statistic]["mean"];
            assert_eq!(number(&row[3]), want.as_f64(), "{figure} {row:?}");
        }
    }
    for (index, row) in data(&folder, "profile-rms-contrast").iter().enumerate() {
        let want = &of(&row[0])["bands"][index % 3]["rms_contrast"][side(&row[0])]["mean"];
        assert_eq!(number(&row[2]), want.as_f64(), "{row:?}");
    }
}

#[test]
fn differences_are_drawn_frame_by_frame_and_saccades_marked() {
    let sequence = |degrees| sequence(degrees, "[[plot]]\nkind = \"sequence\"\nmetric = \"atd\"\n");
    let folder = sequence(2.1);
    let rows = data(&folder, "sequence-atd");
    let values = self::rows(&folder, "reports/e");
    let value = |method: &str, image: &str, frame: &str| {
        let is_it = |row: &&BTreeMap<String, String>| {
            let wanted =
                [("method", method), ("image", image), ("frame", frame), ("metric", "atd")];
            wanted.iter().all(|(column, cell)| row[*column] == *cell)
                && row["statistic"].is_empty()
                && row["from_deg"].is_empty()
        };
        values.iter().find(is_it).unwrap()["value"].clone()
    };
    let mut want: Vec<[String; 3]> = Vec::new();
    for (series, method, image) in
        [("A", "A", "test"), ("B", "B", "test"), ("reference", "A", "reference")]
    {
        for frame in ["1", "2", "3"] {
            want.push([series.to_owned(), format!("{frame}.0"), value(method, image, frame)]);
        }
    }
    for end in ["1.5", "2.5"] {
        want.push(["saccade".to_owned(), end.to_owned(), String::new()]);
    }
    assert_eq!(rows, want);
    let mean = |series: &str| {
        let values = want.iter().filter(|row| row[0] == series);
        values.map(|row| row[2].parse::<f64>().unwrap()).sum::<f64>() / 3.0
    };
    let summary = comparison(&folder, "s", "B")["atd"].clone();
    for (side, series) in [("test", "B"), ("reference", "reference")] {
        assert!((summary[side].as_f64().unwrap() - mean(series)).abs() < 1e-15);
    }
    let page = |folder: &Folder| fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page(&folder).contains("saccades (over 2° in a frame) marked"));
    let slow = sequence(1.9);
    assert!(!data(&slow, "sequence-atd").iter().any(|row| row[0] == "saccade"));
    assert!(!page(&slow).contains("saccade"));
}
