//! Mistakes in `emulate = { … }`, and frames from which nothing can be emulated.

use fovqa_testkit::exr_files::{File, Part};
use fovqa_testkit::synthetic::codes;

use crate::fovqa::Folder;
use crate::frames::moving_frames::SIZE;

fn experiment(view: &str, reference: &str, method: &str) -> String {
    format!(
        "name = \"e\"\n[view]\n{view}\n[[scene]]\nname = \"s\"\nreference = \"{reference}\"\n\
         [[method]]\nname = \"M\"\n{method}\n[metrics]\nmse = {{}}\n"
    )
}

const VIEW: &str = "fov_vertical_deg = 90";

#[test]
fn mistakes_are_shown_in_their_place() {
    let folder = Folder::new();
    folder.png("gt.png", 96, 80, &codes(96, 80, 3, 1));
    for (method, said) in [
        ("", "method \"M\" has neither test nor emulate"),
        ("test = \"gt.png\"\nemulate = { model = \"rmfr\" }", "has both test and emulate"),
        ("emulate = \"rmfr\"", "{ model = \"rmfr\", sigma = 2.6 }"),
        ("emulate = { sigma = 2 }", "has no model"),
        ("emulate = { model = 5 }", "model cannot be a whole number"),
        ("emulate = { model = \"rmfrr\" }", "did you mean \"rmfr\"?"),
        ("emulate = { model = \"rmfr\", sigm = 2 }", "did you mean sigma?"),
        ("emulate = { model = \"rmfr\", sigma = 0.001 }", "sigma cannot be 0.001"),
        (
            "emulate = { model = \"rmfr\", filter = \"own\" }",
            "rmfr has no filters of its own; only deamp, kfr",
        ),
        ("emulate = { model = \"vafr\", filter = \"screen\" }", "it has the filter `buffer`"),
        (
            "emulate = { model = \"kfr\", \"filter.span\" = 4 }",
            "kfr has no parameter `filter.span`",
        ),
        ("emulate = { model = \"kfr\", \"taa.k\" = -1 }", "write a number from 0 to 1000"),
        ("emulate = { model = \"kfr\", sampling = \"aera\" }", "did you mean \"area\"?"),
        ("emulate = { model = \"kfr\", enhance = 101 }", "enhance cannot be 101"),
        ("emulate = { model = \"kfr\", budget = 0 }", "budget cannot be 0"),
        ("emulate = { model = \"kfr\", budget_of = \"buffer\" }", "budget_of needs a budget"),
        ("emulate = { model = \"kfr\", dominant = \"left\" }", "says nothing without other_eye"),
        (
            "emulate = { model = \"kfr\", other_eye = { sigma = 3 } }",
            "no scene of this method has two eyes",
        ),
        (
            "emulate = { model = \"kfr\", other_eye = { model = \"rmfr\" } }",
            "both eyes have that of the method",
        ),
        ("emulate = { model = \"kfr\", other_eye = 3 }", "other_eye cannot be a whole number"),
        ("emulate = { model = \"kfr\" }\nlayer = \"x\"", "is emulated, and reads no layer"),
        ("emulate = { model = \"deamp\", sigmas = [1, 2], bounds_deg = [30] }", "deamp"),
        ("emulate = { model = \"guenter\", budget = 0.0001 }", "guenter"),
        ("emulate = { model = \"stable\", budget = 0.5 }", "stable"),
        ("emulate = { model = \"vafr\", factor = 1000 }", "vafr would shade"),
        ("emulate = { model = \"rmfr\", sigma = 2, budget = 0.2 }", "a budget solves sigma"),
    ] {
        folder.write("e.toml", experiment(VIEW, "gt.png", method));
        let run = folder.run(&["run", "e.toml", "--output", "out"]);
        run.fails(2, &[said]);
        assert!(!folder.path("out").exists(), "nothing is written: {method}");
    }
}

#[test]
fn a_budget_out_of_reach_says_what_can_be_had() {
    let folder = Folder::new();
    folder.png("gt.png", 96, 80, &codes(96, 80, 3, 1));
    folder.write(
        "e.toml",
        experiment(VIEW, "gt.png", "emulate = { model = \"linear\", budget = 0.001 }"),
    );
    folder.run(&["run", "e.toml"]).fails(2, &["s, M: ", "linear", "0.001"]);
    let check = folder.run(&["check", "e.toml"]);
    assert_eq!(check.code, 2);
    check.says(&["s, M: ", "linear", "0.001"]);
}

#[test]
fn angles_need_a_view() {
    let folder = Folder::new();
    folder.png("gt.png", 96, 80, &codes(96, 80, 3, 1));
    for (method, code) in [
        ("emulate = { model = \"rmfr\" }", 0),
        ("emulate = { model = \"taa\" }", 0),
        ("emulate = { model = \"vafr\" }", 2),
        ("emulate = { model = \"rmfr\", enhance = 1 }", 2),
    ] {
        folder.write("e.toml", experiment("", "gt.png", method));
        let run = folder.run(&["run", "e.toml", "--output", "out"]);
        if code == 0 {
            run.ok();
        } else {
            run.fails(code, &["depends on visual angles, but scene \"s\" has no view"]);
        }
    }
}

/// Bad pixels would spread over their neighbours; the methods that are read are scored without them.
#[test]
fn bad_pixels_are_not_spread() {
    let folder = Folder::new();
    let bad = |x: usize, y: usize| if (x, y) == (3, 4) { f32::NAN } else { 0.5 };
    File::new(vec![Part::rgb(SIZE, bad)]).write(&folder.path("gt.exr"));
    File::new(vec![Part::rgb(SIZE, |_, _| 0.4)]).write(&folder.path("test.exr"));
    let methods = "emulate = { model = \"rmfr\" }\n[[method]]\nname = \"F\"\ntest = \"test.exr\"";
    let text = experiment(&format!("{VIEW}\n[signal]\nnonfinite = \"mask\""), "gt.exr", methods);
    folder.write("e.toml", text);
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    run.says(&["gt.exr: channel R is NaN at pixel (3, 4)", "would spread"]);
    let csv = std::fs::read_to_string(folder.path("out/results.csv")).unwrap();
    assert!(csv.contains("s,F,,,0,pair,mse,") && csv.contains("s,M,,,0,pair,error,"), "{csv}");
}

/// Nobody looks around in a scene that is read from files.
#[test]
fn the_gaze_of_a_viewer_needs_a_built_in_scene() {
    let folder = Folder::new();
    folder.png("gt.png", 96, 80, &codes(96, 80, 3, 1));
    let view = format!("{VIEW}\ngaze = \"builtin\"");
    folder.write("e.toml", experiment(&view, "gt.png", "emulate = { model = \"rmfr\" }"));
    folder.run(&["run", "e.toml", "--output", "out"]).fails(2, &["is not built in", "\"center\""]);
}

/// Frames that are kept may not replace the frames that they are emulated from.
#[test]
fn inputs_are_not_replaced_by_kept_frames() {
    let folder = Folder::new();
    folder.png("out/emulated/s/M/0000.png", 96, 80, &codes(96, 80, 3, 1));
    let reference = "out/emulated/s/M/0000.png";
    let before = std::fs::read(folder.path(reference)).unwrap();
    let emulate = "emulate = { model = \"rmfr\", keep_frames = true }";
    folder.write("e.toml", experiment(VIEW, reference, emulate));
    let said = ["this input is in the folder that emulated frames are written to"];
    folder.run(&["run", "e.toml", "--output", "out"]).fails(2, &said);
    assert_eq!(std::fs::read(folder.path(reference)).unwrap(), before);
    folder.run(&["run", "e.toml", "--output", "other"]).ok();
}
