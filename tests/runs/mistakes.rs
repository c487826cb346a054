//! Mistakes in what is compared are noticed: in `score`, `run` and `check`.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use crate::fovqa::{Folder, root};
use crate::runs::shards::divided;

/// A real render, by its place in the small data.
fn render(name: &str) -> String {
    small(name).to_str().unwrap().to_owned()
}

fn small(name: &str) -> PathBuf {
    root().join("tests/data/small").join(name)
}

const VIEW: [&str; 4] = ["--fov-vertical", "100", "--metrics", "psnr"];

/// The exposure with which the pictures of the class room were written, in stops.
const EXPOSURE: &str = "0.65976";

#[test]
fn a_forgotten_exposure_is_named_with_its_value() {
    let folder = Folder::new();
    let pair = [&render("classroom/gt/0000.exr"), &render("classroom/rmfr_taa/0000.png")];
    let pair = pair.map(String::as_str);
    let forgotten = folder.score(&[&pair[..], &VIEW].concat()).ok();
    let words = [
        "stops brighter than the reference over most of the frame",
        "set --exposure to that with which the test was written, about 0.6",
    ];
    let forgotten = forgotten.says(&words);
    assert_eq!(forgotten.stderr.matches("warning").count(), 1, "{}", forgotten.stderr);
    let right = [&pair[..], &VIEW, &["--exposure", EXPOSURE]].concat();
    assert_eq!(folder.score(&right).ok().stderr, "");
    let json = |more: &[&str]| folder.json(&[&pair[..], &VIEW, more].concat());
    assert_eq!(json(&[])["plausibility"][0]["check"], "exposure");
    assert!(json(&["--exposure", EXPOSURE]).get("plausibility").is_none());
    let refused = folder.score(&[&pair[..], &VIEW, &["--plausibility", "error"]].concat());
    refused.fails(3, &["stops brighter", "--plausibility warn scores it nevertheless"]);
    let off = folder.score(&[&pair[..], &VIEW, &["--plausibility", "off"]].concat()).ok();
    assert_eq!((off.stderr.as_str(), off.stdout == forgotten.stdout), ("", true));
}

#[test]
fn swapped_pictures_a_wrong_gaze_and_another_scene_are_noticed() {
    let folder = Folder::new();
    let [gt, kfr] = ["gt", "kfr"].map(|name| render(&format!("living-room/{name}.png")));
    let said = |more: &[&str]| folder.score(&[more, &VIEW].concat()).ok().stderr;
    assert_eq!(said(&[&gt, &kfr]), "");
    assert!(said(&[&kfr, &gt]).contains("they seem to be swapped"));
    let gaze = said(&[&gt, &kfr, "--gaze", "600,120"]);
    assert!(
        gaze.contains("not at the gaze (600, 120) px") && gaze.contains("--gaze X,Y"),
        "{gaze}"
    );
    let [left, other] = ["stereo/left_gt.exr", "stereo/left_rmfr.exr"].map(render);
    assert_eq!(said(&[&left, &other, "--gaze", "202.1,200"]), "");
    let crop = ["--crop", "0,0,320,360"];
    let scene = said(&[&left, &render("classroom/gt/0000.exr"), crop[0], "0,0,320,360"]);
    assert!(scene.contains("do not show the same"), "{scene}");
}

/// An experiment about the class room, whose two methods have two frames.
fn class_room(rest: &str) -> Folder {
    let folder = Folder::new();
    for (to, from) in [("gt", "gt"), ("taa", "rmfr_taa"), ("noaa", "rmfr_noaa")] {
        for frame in ["0000", "0001"] {
            let ending = if to == "gt" { "exr" } else { "png" };
            let bytes = fs::read(small(&format!("classroom/{from}/{frame}.{ending}"))).unwrap();
            folder.write(&format!("{to}/{frame}.{ending}"), bytes);
        }
    }
    folder.write("e.toml", format!("{rest}[view]\nfov_vertical_deg = 100\n{CLASS_ROOM}"));
    folder
}

const CLASS_ROOM: &str = "[[scene]]\nname = \"room\"\nreference = \"gt\"\n\
    [[method]]\nname = \"taa\"\ntest = \"taa\"\n[[method]]\nname = \"noaa\"\ntest = \"noaa\"\n\
    [metrics]\npsnr = {}\n";

fn read(folder: &Folder, name: &str) -> String {
    fs::read_to_string(folder.path(&format!("reports/e/{name}"))).unwrap()
}

fn summary(folder: &Folder) -> Value {
    serde_json::from_str(&read(folder, "summary.json")).unwrap()
}

#[test]
fn a_run_says_each_mistake_once_and_keeps_it() {
    let folder = class_room("name = \"e\"\n");
    let run = folder.run(&["run", "e.toml"]).ok();
    assert_eq!(run.stderr.matches("over most of the frame").count(), 2, "{}", run.stderr);
    let run = run.says(&[
        "room: taa/0000.png: the test is",
        "set exposure_stops to that with which the test was written, about 0.6",
    ]);
    assert!(run.stderr.contains("said once for all frames"));
    let all = summary(&folder);
    let doubts: Vec<&Value> =
        all["comparisons"].as_array().unwrap().iter().map(|of| &of["plausibility"]).collect();
    assert_eq!(doubts.len(), 2);
    for doubt in doubts {
        assert_eq!((&doubt[0]["check"], &doubt[0]["frames"]), (&"exposure".into(), &1.into()));
    }
    let page = read(&folder, "report.html");
    assert!(page.contains("Likely mistakes") && page.contains("room, taa, frame 0: the test is"));
    // From the journal, and drawn again.
    let before = read(&folder, "summary.json");
    folder.run(&["run", "e.toml", "--resume"]).ok();
    assert_eq!(read(&folder, "summary.json"), before);
    folder.run(&["report", "reports/e"]).ok();
    assert!(read(&folder, "report.html").contains("Likely mistakes"));
}

#[test]
fn shards_keep_what_was_noticed() {
    divided(&class_room("name = \"e\"\n"), 3, 0);
}

#[test]
fn with_error_suspected_pairs_are_not_scored_and_others_are() {
    let folder = class_room("name = \"e\"\nplausibility = \"error\"\n");
    folder.write("noaa/0000.png", fs::read(folder.path("noaa/0001.png")).unwrap());
    let run = folder.run(&["run", "e.toml"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let errors = summary(&folder)["errors"].as_array().unwrap().clone();
    assert_eq!(errors.len(), 4, "{errors:#?}");
    assert!(errors[0]["message"].as_str().unwrap().contains("stops brighter"));
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    // A scene may differ from the rest.
    folder.write(
        "e.toml",
        text.replace("reference = \"gt\"", "reference = \"gt\"\nplausibility = \"off\""),
    );
    let run = folder.run(&["run", "e.toml"]).ok();
    assert!(!run.stderr.contains("over most of the frame"), "{}", run.stderr);
    assert!(summary(&folder)["errors"].as_array().unwrap().is_empty());
    folder.write("e.toml", text.replace("\"error\"", "\"eror\""));
    folder.run(&["run", "e.toml"]).fails(2, &["plausibility", "warn", "error", "off"]);
}

#[test]
fn check_reads_previews_where_asked() {
    let folder = class_room("name = \"e\"\n");
    let check = folder.run(&["check", "e.toml"]).ok();
    assert_eq!(check.stderr, "");
    let previews = folder.run(&["check", "e.toml", "--previews"]).ok();
    assert_eq!(previews.stdout, check.stdout);
    let lines = |text: &str| -> Vec<String> {
        let warnings = text.lines().filter(|line| line.contains("over most of the frame"));
        warnings.map(str::to_owned).collect()
    };
    let run = folder.run(&["run", "e.toml"]).ok();
    assert_eq!(lines(&previews.stderr), lines(&run.stderr));
    assert_eq!(lines(&run.stderr).len(), 2);
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", format!("plausibility = \"error\"\n{text}"));
    let refused = folder.run(&["check", "e.toml", "--previews"]);
    assert_eq!(refused.code, 3, "{}", refused.stderr);
    refused.says(&["room, frame 0: taa/0000.png: the test is"]);
    folder.run(&["check", "e.toml"]).ok();
}

#[test]
fn files_of_another_format_are_noticed_before_a_pixel_is_read() {
    let folder = class_room("name = \"e\"\n[signal]\nexposure_stops = 0.65976\n");
    for frame in ["0000", "0001"] {
        fs::remove_file(folder.path(&format!("noaa/{frame}.png"))).unwrap();
        let bytes = fs::read(folder.path(&format!("gt/{frame}.exr"))).unwrap();
        folder.write(&format!("noaa/{frame}.exr"), bytes);
    }
    let words = ["the tests are PNG or video, but those of noaa are OpenEXR", "same format"];
    for command in ["check", "run"] {
        let run = folder.run(&[command, "e.toml"]).ok().says(&words);
        assert_eq!(run.stderr.matches("warning").count(), 1, "{command}: {}", run.stderr);
    }
}

#[test]
fn check_lists_temporal_metrics_for_sequences_only() {
    let folder = Folder::with_pair();
    let text = "name = \"e\"\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n\
                [[method]]\nname = \"m\"\ntest = \"b.png\"\n[metrics]\npsnr = {}\natd = {}\n";
    folder.write("e.toml", text);
    let check =
        folder.run(&["check", "e.toml"]).ok().says(&["ATD has no value: it needs two frames"]);
    assert!(check.stdout.starts_with("e: PSNR\n"), "{}", check.stdout);
    let folder = class_room("name = \"e\"\nplausibility = \"off\"\n");
    let text = fs::read_to_string(folder.path("e.toml")).unwrap();
    folder.write("e.toml", format!("{text}atd = {{}}\n"));
    let check = folder.run(&["check", "e.toml"]).ok();
    assert!(check.stdout.starts_with("e: PSNR, ATD\n"), "{}", check.stdout);
}
