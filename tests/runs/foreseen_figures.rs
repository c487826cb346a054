//! Figures that cannot be as the file says are found before anything is scored, and what a figure
//! does not show as expected is named in a warning.

use std::fs;

use super::figures::{data, figures};
use crate::fovqa::Folder;
use crate::runs::experiment_folder::{experiment, rows, two_scenes};

const PSNR: &str = "[metrics]\npsnr = {}\n";

/// A plot of regions of frames.
fn crops(regions: &str) -> String {
    format!("{PSNR}[[plot]]\nkind = \"crops\"\nregions = [{regions}]\n")
}

fn region(name: &str, rest: &str) -> String {
    format!("{{ name = \"{name}\", {rest} }}")
}

/// The lines with a warning.
fn warnings(stderr: &str) -> Vec<&str> {
    stderr.lines().filter(|line| line.contains("warning")).collect()
}

#[test]
fn sizes_that_figures_cannot_have_are_found_before_scoring() {
    let folder = two_scenes();
    let bars = format!("{PSNR}[[plot]]\nkind = \"bars\"\nfigure = {{ height_in = 0.6 }}\n");
    let panels = "[metrics]\nhaar = { levels = 3 }\n[figures]\naspect = 10\n\
                  [[plot]]\nkind = \"profile\"\nmetric = \"haar\"\n";
    let tall: Vec<String> = (0..30)
        .map(|i| region(&format!("r{i}"), &format!("at = [20, {}], size = [4, 16]", 10 + i % 9)))
        .collect();
    for (text, said) in [
        (bars.as_str(), ["bars-psnr: a height of 0.6 in is too low", "it needs"]),
        (panels, ["profile-haar", "is too low"]),
        ("[metrics]\npsnr = {}\n[figures]\nheight_in = 0.5\n", ["a height of 0.5 in", "too low"]),
        (&crops(&tall.join(", ")), ["crops: 300 pixels per inch make a PNG", "1 to 16384"]),
    ] {
        folder.write("e.toml", experiment(text));
        for command in ["check", "run"] {
            let run = folder.run(&[command, "e.toml"]);
            run.fails(2, &said).says(&["change its `figure`, or [figures]"]);
        }
        assert!(!folder.path("reports/e").exists(), "nothing was scored");
    }
    // A height for all figures leaves pictures as they are.
    let plots = "[[plot]]\nkind = \"bars\"\n[figures]\nheight_in = 2.5\n";
    let text = crops(&region("a", "at = [9, 9], size = [4, 4]"));
    folder.write("e.toml", experiment(&format!("{text}{plots}")));
    folder.run(&["run", "e.toml"]).ok();
    assert_eq!(figures(&folder), ["bars-psnr", "crops"]);
}

#[test]
fn a_report_names_the_run_that_mends_it() {
    let folder = two_scenes();
    let text =
        experiment(&format!("{PSNR}[[plot]]\nkind = \"bars\"\nfigure = {{ width_in = 3 }}\n"));
    folder.write("e.toml", &text);
    folder.run(&["run", "e.toml"]).ok();
    let record = folder.path("reports/e/run.json");
    let changed = fs::read_to_string(&record).unwrap();
    let changed = changed.replace("\"width_in\": 3.0", "\"width_in\": 3.0, \"height_in\": 0.6");
    fs::write(&record, changed).unwrap();
    let said = ["a height of 0.6 in is too low", "`fovqa run FILE --resume`"];
    folder.run(&["report", "reports/e"]).fails(2, &said);
}

#[test]
fn regions_that_do_not_exist_are_named_once() {
    let folder = two_scenes();
    let regions = [
        region("late", "at = [9, 9], size = [4, 4], frame = 7"),
        region("outside", "at = [2, 6], size = [8, 4]"),
        region("large", "at = [20, 20], size = [64, 4]"),
        region("good", "at = [9, 9], size = [4, 4]"),
    ];
    folder.write("e.toml", experiment(&crops(&regions.join(", "))));
    for command in ["check", "run"] {
        let run = folder.run(&[command, "e.toml"]).ok();
        run.says(&[
            "the region \"late\" is left out: there is no frame 7 (room has frames 0 to 2, hall has",
            "the region \"outside\" is left out: 8x4 px around [2, 6] are not within the frame of \
             48x40; the centre of a region of this size can be from [4, 2] to [44, 38]",
            "the region \"large\" is left out: 64x4 px",
            "a region can have at most 48x40 px",
        ]);
        let run = folder.run(&[command, "e.toml"]).ok();
        assert_eq!(warnings(&run.stderr).len(), 3, "{}", run.stderr);
    }
    let csv = fs::read_to_string(folder.path("reports/e/plots/crops.csv")).unwrap();
    assert!(csv.contains("good") && !csv.contains("outside"), "{csv}");
    // What is left out does not keep a run from going on.
    let run = folder.run(&["run", "e.toml", "--resume"]).ok();
    assert!(run.stderr.contains("finished; continuing"), "{}", run.stderr);
}

#[test]
fn missing_and_damaged_pictures_of_regions_are_named() {
    let folder = two_scenes();
    folder.write("e.toml", experiment(&crops(&region("a", "at = [9, 9], size = [4, 4]"))));
    folder.run(&["run", "e.toml"]).ok();
    let picture = |scene: &str| folder.path(&format!("reports/e/crops/{scene}/a/methods/B.png"));
    fs::remove_file(picture("room")).unwrap();
    fs::write(picture("hall"), "no picture").unwrap();
    let run = folder.run(&["report", "reports/e"]).ok();
    run.says(&["room/a/methods/B.png: the file of a region is missing; `fovqa run FILE --resume`"])
        .says(&["hall/a/methods/B.png: the file of a region is damaged; delete it, and"]);
    folder
        .run(&["run", "e.toml", "--resume"])
        .ok()
        .says(&["regions of frames that figures show are missing"]);
    let run = folder.run(&["report", "reports/e"]).ok();
    assert!(warnings(&run.stderr).is_empty(), "{}", run.stderr);
    fs::remove_dir_all(folder.path("reports/e/crops/room")).unwrap();
    folder
        .run(&["report", "reports/e"])
        .ok()
        .says(&["room/a/region.json: the file of a region is missing"]);
}

#[test]
fn crops_of_many_methods_are_several_figures() {
    let folder = two_scenes();
    let text = crops(&region("a", "at = [9, 9], size = [4, 4]"));
    let method = |i: usize| format!("[[method]]\nname = \"Method {i}\"\ntest = \"{{scene}}/a\"\n");
    let more: String = (1..=10).map(method).collect();
    folder.write("e.toml", experiment(&format!("{more}{text}")));
    folder.run(&["run", "e.toml"]).ok();
    assert_eq!(figures(&folder), ["crops-methods-1-6", "crops-methods-7-12"]);
    let svg = fs::read_to_string(folder.path("reports/e/plots/crops-methods-7-12.svg")).unwrap();
    for words in ["methods 7 to 12 of 12", "Reference", "Method 10"] {
        assert!(svg.contains(words), "{words}");
    }
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("; methods 1 to 6 of 12"));
}

#[test]
fn empty_axes_and_settings_without_effect_are_named() {
    let folder = two_scenes();
    let plots = "[figures]\nx = { min = 80, max = 90 }\nmarkers = false\n";
    folder.write(
        "e.toml",
        experiment(&format!(
            "{PSNR}[[plot]]\nkind = \"profile\"\n[[plot]]\nkind = \"bars\"\n{plots}"
        )),
    );
    let said =
        "profile-psnr-room: the figure is empty: no value is within its axes (x from 80 to 90)";
    folder.run(&["run", "e.toml"]).ok().says(&[said]);
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("room; the figure is empty: no value is within its axes"));
    folder.write("e.toml", experiment(&format!("{PSNR}[[plot]]\nkind = \"bars\"\n{plots}")));
    let run = folder.run(&["check", "e.toml"]).ok();
    run.says(&[
        "markers in [figures] has no effect on bars",
        "x in [figures] has no effect on bars",
    ]);
}

#[test]
fn characters_that_the_font_lacks_are_named() {
    let folder = two_scenes();
    let text =
        experiment(&format!("{PSNR}[[plot]]\nkind = \"bars\"\n[[plot]]\nkind = \"frames\"\n"));
    folder.write("e.toml", text.replace("name = \"A\"", "name = \"方法 A\""));
    let run = folder.run(&["run", "e.toml"]).ok();
    let run = run.says(&[
        "the font of figures has no \"方\", \"法\": PDF and PNG show boxes",
        "bars-psnr, frames-psnr",
    ]);
    assert_eq!(warnings(&run.stderr).len(), 1, "{}", run.stderr);
    folder.write("e.toml", text);
    let run = folder.run(&["run", "e.toml"]).ok();
    assert!(warnings(&run.stderr).is_empty(), "{}", run.stderr);
}

#[test]
fn differences_over_time_of_frames_are_in_percent_as_in_bars() {
    let folder: Folder = two_scenes();
    folder.write(
        "e.toml",
        experiment("[metrics]\natd = {}\n[[plot]]\nkind = \"frames\"\nmetric = \"atd\"\n"),
    );
    folder.run(&["run", "e.toml"]).ok();
    let rows = rows(&folder, "reports/e");
    let values = |image: &str| -> Vec<f64> {
        let wanted = rows.iter().filter(|row| {
            row["scene"] == "room"
                && row["method"] == "B"
                && row["metric"] == "atd"
                && row["image"] == image
                && row["statistic"].is_empty()
                && row["from_deg"].is_empty()
        });
        wanted.map(|row| row["value"].parse().unwrap()).collect()
    };
    let (test, reference) = (values("test"), values("reference"));
    let shown = data(&folder, "frames-atd");
    let shown = shown.iter().filter(|row| row[0] == "room" && row[1] == "B");
    let shown: Vec<f64> = shown.map(|row| row[2].parse().unwrap()).collect();
    assert_eq!((shown.len(), test.len()), (2, 2));
    for (i, value) in shown.into_iter().enumerate() {
        assert!((value - test[i] / reference[i] * 100.0).abs() < 1e-9);
    }
    let svg = fs::read_to_string(folder.path("reports/e/plots/frames-atd.svg")).unwrap();
    assert!(svg.contains("ATD in % of the reference"));
}
