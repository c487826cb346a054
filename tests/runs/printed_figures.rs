//! How figures are printed, their error bars and ratios, and regions of frames side by side.

use std::fs;

use super::figures::{data, figures};
use crate::fovqa::Folder;
use crate::runs::experiment_folder::{experiment, rows, two_scenes};

/// The size in inches that an SVG declares.
fn size_in(folder: &Folder, figure: &str) -> (f64, f64) {
    let svg = fs::read_to_string(folder.path(&format!("reports/e/plots/{figure}.svg"))).unwrap();
    let side = |name: &str| {
        let text = svg.split(&format!(" {name}=\"")).nth(1).unwrap().split("in\"").next().unwrap();
        text.parse::<f64>().unwrap()
    };
    (side("width"), side("height"))
}

#[test]
fn figures_are_printed_as_the_file_says() {
    let folder = two_scenes();
    folder.write(
        "e.toml",
        experiment(
            "[metrics]\npsnr = {}\n[figures]\nwidth_in = 5\nformats = [\"pdf\", \"svg\"]\n\
             [[plot]]\nkind = \"bars\"\n\
             [[plot]]\nkind = \"frames\"\n\
             figure = { width_in = 7, height_in = 2.5, y = { label = \"dB of each\", max = 99 } }\n",
        ),
    );
    folder.run(&["run", "e.toml"]).ok();
    assert!((size_in(&folder, "bars-psnr").0 - 5.0).abs() < 1e-9);
    let (width, height) = size_in(&folder, "frames-psnr");
    assert!((width - 7.0).abs() < 1e-9 && (height - 2.5).abs() < 0.03, "{width} x {height}");
    let plots = folder.path("reports/e/plots");
    assert!(plots.join("bars-psnr.pdf").exists() && !plots.join("bars-psnr.png").exists());
    let svg = fs::read_to_string(plots.join("frames-psnr.svg")).unwrap();
    assert!(svg.contains("dB of each") && !svg.contains("<text"));
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("bars-psnr.pdf\">PDF") && !page.contains("bars-psnr.png"));
    // A report draws the same again, from the results alone.
    let before = fs::read(plots.join("frames-psnr.pdf")).unwrap();
    assert!(before.starts_with(b"%PDF"));
    fs::remove_file(plots.join("frames-psnr.pdf")).unwrap();
    folder.run(&["report", "reports/e"]).ok();
    assert_eq!(fs::read(plots.join("frames-psnr.pdf")).unwrap(), before);
}

#[test]
fn another_size_needs_no_other_scores() {
    let folder = two_scenes();
    let text = experiment(
        "[metrics]\npsnr = {}\n[[plot]]\nkind = \"bars\"\nfigure = { height_in = 2.2 }\n\
         [[plot]]\nkind = \"frames\"\n",
    );
    folder.write("e.toml", &text);
    folder.run(&["run", "e.toml"]).ok();
    folder.write("e.toml", text.replace("2.2", "2.6"));
    let run = folder.run(&["run", "e.toml", "--resume"]).ok();
    assert!(!run.stderr.contains("changed"), "{}", run.stderr);
    assert_eq!(figures(&folder), ["bars-psnr", "frames-psnr"]);
    folder.write("e.toml", text.replace("fov_vertical_deg = 60", "fov_vertical_deg = 61"));
    let run = folder.run(&["run", "e.toml", "--resume"]).ok();
    assert!(run.stderr.contains("the experiment file has changed"), "{}", run.stderr);
}

/// Half the length of an error bar over values, from its definition.
fn deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    (squares / (values.len() as f64 - 1.0)).sqrt()
}

#[test]
fn error_bars_are_over_frames_and_over_scenes() {
    let folder = two_scenes();
    folder.write(
        "e.toml",
        experiment(
            "[metrics]\npsnr = {}\nrms_contrast = {}\n[[plot]]\nkind = \"bars\"\nmetric = \"psnr\"\nerror_bars = \"se\"\n\
             [[plot]]\nkind = \"profile\"\nerror_bars = \"sd\"\n",
        ),
    );
    folder.run(&["run", "e.toml"]).ok();
    let rows = rows(&folder, "reports/e");
    let values = |metric: &str, image: &str, from: &str| -> Vec<f64> {
        let wanted = rows.iter().filter(|row| {
            row["scene"] == "room"
                && row["method"] == "B"
                && row["metric"] == metric
                && row["image"] == image
                && row["from_deg"] == from
                && !row["frame"].is_empty()
        });
        wanted.map(|row| row["value"].parse().unwrap()).collect()
    };
    let near = |found: &str, want: f64| {
        let found: f64 = found.parse().unwrap();
        assert!((found - want).abs() <= 1e-9 * want.abs().max(1e-9), "{found} {want}");
    };
    let bars = data(&folder, "bars-psnr");
    let bar = |group: &str| bars.iter().find(|row| row[0] == group && row[1] == "B").unwrap();
    let frames = values("psnr", "pair", "");
    assert_eq!(frames.len(), 3);
    near(&bar("room")[3], deviation(&frames) / 3.0_f64.sqrt());
    let scenes: Vec<f64> =
        ["room", "hall"].iter().map(|scene| bar(scene)[2].parse().unwrap()).collect();
    near(&bar("Average")[3], deviation(&scenes) / 2.0_f64.sqrt());
    let profile = data(&folder, "profile-psnr-room");
    let first = profile.iter().find(|row| row[0] == "B").unwrap();
    near(&first[3], deviation(&values("psnr", "pair", "0.0")));
    let contrast = data(&folder, "profile-rms-contrast-room");
    let first = contrast.iter().find(|row| row[0] == "B").unwrap();
    near(&first[3], deviation(&values("rms_contrast", "test", "0.0")));
}

#[test]
fn a_ratio_is_that_of_test_and_reference() {
    let folder = two_scenes();
    folder.write(
        "e.toml",
        experiment("[metrics]\nrms_contrast = {}\n[[plot]]\nkind = \"ratio_profile\"\n[[plot]]\nkind = \"profile\"\n"),
    );
    folder.run(&["run", "e.toml"]).ok();
    let value = |rows: &[Vec<String>], series: &str| -> f64 {
        rows.iter().find(|row| row[0] == series).unwrap()[2].parse().unwrap()
    };
    let (ratios, profile) = (
        data(&folder, "ratio-profile-rms-contrast-room"),
        data(&folder, "profile-rms-contrast-room"),
    );
    let want = value(&profile, "B") / value(&profile, "reference");
    assert!((value(&ratios, "B") / want - 1.0).abs() < 1e-9);
    assert!((value(&ratios, "reference") - 1.0).abs() < 1e-12);
}

const CROPS: &str = "[metrics]\npsnr = {}\n[[plot]]\nkind = \"crops\"\n\
    regions = [{ name = \"corner\", at = [8, 6], size = [8, 4] }, { name = \"later\", at = [20, 20], size = [4, 4], scene = \"hall\", frame = 2 }]\n";

#[test]
fn regions_are_shown_side_by_side() {
    let folder = two_scenes();
    folder.write("e.toml", experiment(CROPS));
    folder.run(&["run", "e.toml"]).ok();
    // Pictures of 8 bits are cut out as they are.
    let cut = image::open(folder.path("reports/e/crops/room/corner/methods/B.png")).unwrap();
    let whole = image::open(folder.path("room/b/0000.png")).unwrap();
    assert_eq!(cut.to_rgb8(), whole.crop_imm(4, 4, 8, 4).to_rgb8());
    let later = image::open(folder.path("reports/e/crops/hall/later/reference.png")).unwrap();
    let whole = image::open(folder.path("hall/gt/0002.png")).unwrap();
    assert_eq!(later.to_rgb8(), whole.crop_imm(18, 18, 4, 4).to_rgb8());
    assert!(!folder.path("reports/e/crops/room/later").exists());
    assert_eq!(figures(&folder), ["crops"]);
    let svg = fs::read_to_string(folder.path("reports/e/plots/crops.svg")).unwrap();
    for words in ["corner, room, ", "° from the gaze, ×", "later, hall, frame 2", "Reference"] {
        assert!(svg.contains(words), "{words}");
    }
    // Shards cut out the same, and so does a run that goes on.
    let before = fs::read(folder.path("reports/e/plots/crops.pdf")).unwrap();
    folder.run(&["run", "e.toml", "--shard", "1/2", "--output", "s1"]).ok();
    folder.run(&["run", "e.toml", "--shard", "2/2", "--output", "s2"]).ok();
    folder.run(&["merge", "s1", "s2", "--output", "merged"]).ok();
    assert!(fs::read(folder.path("merged/plots/crops.pdf")).unwrap() == before);
    // Another region needs the frames again.
    folder.write("e.toml", experiment(&CROPS.replace("[8, 6]", "[9, 6]")));
    folder.run(&["run", "e.toml", "--resume"]).ok().says(&["everything is scored again"]);
    assert!(fs::read(folder.path("reports/e/plots/crops.pdf")).unwrap() != before);
}
