//! `fovqa gallery`: built-in scenes as files.

use std::fs;

use serde_json::Value;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::bytes;

const VIEW: [&str; 4] = ["--resolution", "96x80", "--fov-vertical", "90"];

fn gallery(folder: &Folder, arguments: &[&str]) -> crate::fovqa::Run {
    folder.run(&[&["gallery"][..], &VIEW, arguments].concat())
}

#[test]
fn the_files_are_what_experiments_score() {
    let folder = Folder::new();
    gallery(&folder, &["--output", "hall", "--frames", "3", "--samples", "4"]).ok();
    let names: Vec<String> = bytes(&folder.path("hall")).into_keys().collect();
    let frames =
        |kind: &str| (0..3).map(move |i| format!("{kind}/{i:04}.{kind}")).collect::<Vec<_>>();
    let wanted =
        [vec!["camera.json".to_owned()], frames("exr"), vec!["gaze.csv".to_owned()], frames("png")];
    assert_eq!(names, wanted.concat());
    // Motion and depth are found in the files; light is rounded to half floats, then to codes.
    let score = folder.json(&[
        "hall/exr",
        "hall/png",
        "--metrics",
        "psnr,atd",
        "--fov-vertical",
        "90",
        "--gaze",
        "hall/gaze.csv",
    ]);
    assert_eq!(score["sequence"]["atd"]["motion"], "reference");
    assert_eq!(score["sequence"]["atd"]["depth"], "reference");
    assert!(score["frames"][1]["metrics"]["psnr"].as_f64().unwrap() > 55.0, "{score}");
    let camera: Value =
        serde_json::from_slice(&fs::read(folder.path("hall/camera.json")).unwrap()).unwrap();
    assert_eq!((&camera["width"], camera["frames"].as_array().unwrap().len()), (&96.into(), 3));
    // The same bytes for any number of threads.
    gallery(&folder, &["--output", "again", "--frames", "3", "--samples", "4", "--threads", "1"])
        .ok();
    assert_eq!(bytes(&folder.path("again")), bytes(&folder.path("hall")));
}

#[test]
fn eyes_and_scenes_can_be_chosen() {
    let folder = Folder::new();
    gallery(&folder, &["--output", "eyes", "--samples", "1", "--eye", "both"]).ok();
    let [left, right] = ["left", "right"]
        .map(|eye| fs::read(folder.path(&format!("eyes/{eye}/png/0000.png"))).unwrap());
    assert_ne!(left, right);
    for scene in ["pattern-a", "csf-chart"] {
        gallery(&folder, &["--output", scene, "--samples", "1", "--scene", scene]).ok();
        assert!(!folder.path(&format!("{scene}/camera.json")).exists());
    }
}

#[test]
fn mistakes_say_what_may_be_given() {
    let folder = Folder::new();
    for (arguments, said) in [
        (&["--output", "x", "--frames", "0"][..], "frames of a built-in scene cannot be 0"),
        (&["--output", "x", "--samples", "1000000"], "it must be 1 to 4096"),
        (&["--output", "x", "--scene", "galery"], "gallery"),
        (&["--output", "x", "--fps", "0"], "above 0"),
        (&["--output", "x", "--fps", "0.001"], "it must be 1 to 10000"),
        (&["--output", "x", "--ipd-mm", "900"], "--ipd-mm must be 0 to 200"),
        (&[], "--output"),
    ] {
        gallery(&folder, arguments).fails(2, &[said]);
    }
    let run = |arguments: &[&str]| folder.run(&[&["gallery", "--output", "x"], arguments].concat());
    run(&["--fov-vertical", "90"]).fails(2, &["--resolution"]);
    run(&["--resolution", "96x80"]).fails(2, &["--fov-vertical"]);
    run(&["--resolution", "96x80", "--fov-vertical", "190"]).fails(2, &["180"]);
    folder.write("file", "no folder");
    gallery(&folder, &["--output", "file/hall"]).fails(3, &["file/hall"]);
}

/// `fovqa foveate` samples the scene itself: between the pixels of its ground truth, and beyond them.
#[test]
fn a_method_samples_the_scene_itself() {
    let folder = Folder::new();
    let foveate = |scene: &str, output: &str, more: &[&str]| {
        let method = ["--method", "rmfr", "--set", "sigma=2"];
        folder.run(&[&["foveate", scene, output][..], &method, &VIEW, more].concat())
    };
    let json = foveate("builtin:gallery", "scene.png", &["--format", "json"]).ok().json();
    assert_eq!(json["frames"][0]["samples"], 1920);
    assert_eq!(json["frames"][0]["input"], "builtin:gallery");
    // The gaze is that of the viewer.
    gallery(&folder, &["--output", "hall", "--samples", "1"]).ok();
    let gaze = fs::read_to_string(folder.path("hall/gaze.csv")).unwrap();
    let [x, y] = [0, 1].map(|i| json["frames"][0]["gaze_px"][i].as_f64().unwrap());
    assert!(gaze.contains(&format!("0,{x},{y}")), "{gaze}");
    // From a picture of the scene, with the same gaze, the result is another one.
    let gaze = format!("{x},{y}");
    foveate("hall/png/0000.png", "picture.png", &["--gaze", &gaze]).ok();
    let bytes = |name: &str| fs::read(folder.path(name)).unwrap();
    assert_ne!(bytes("scene.png"), bytes("picture.png"));
    foveate("builtin:gallery", "moved.png", &["--jitter", "halton"]).ok();
    assert_ne!(bytes("scene.png"), bytes("moved.png"));
    foveate("builtin:gallery", "again.png", &["--threads", "1", "--buffer", "buffer.png"]).ok();
    assert_eq!(bytes("scene.png"), bytes("again.png"));
    assert!(folder.path("buffer.png").exists());
    let more = ["--builtin-frames", "3", "--temporal", "--frames", "0..2"];
    foveate("builtin:pattern-b", "frames", &more).ok();
    assert!(folder.path("frames/builtin-pattern_b.000001.png").exists());
    assert!(!folder.path("frames/builtin-pattern_b.000002.png").exists());
    foveate("builtin:galery", "x.png", &[])
        .fails(2, &["no such built-in scene", "did you mean gallery?"]);
    let run = |more: &[&str]| {
        let base = ["foveate", "builtin:gallery", "x.png", "--method", "rmfr"];
        folder.run(&[&base[..], more].concat())
    };
    run(&["--fov-vertical", "90"]).fails(2, &["--resolution"]);
    run(&["--resolution", "96x80"]).fails(2, &["--fov-vertical"]);
}
