//! Views that are possible and yet most likely a slip are questioned; angles that cannot be tangents are
//! refused.

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{HEAD, experiment, two_scenes};

const METRIC: [&str; 2] = ["--metrics", "fpsnr"];

#[test]
fn frusta_in_other_units() {
    let folder = Folder::with_pair();
    let score = |frustum: &str| {
        folder.score(&[&["a.png", "b.png", "--frustum", frustum][..], &METRIC].concat())
    };
    // OpenXR's signs are fine, and so are tangents that do not agree with 48x40 pixels by a little.
    for right in ["-1.2,1.2,1,-1", "1.1,1.3,1,1"] {
        let stderr = score(right).ok().stderr;
        let doubted = ["frustum", "pixels are", "per degree at its centre"];
        assert!(!doubted.iter().any(|words| stderr.contains(words)), "{right}: {stderr}");
    }
    score("50,45,42,48").fails(2, &["if these are angles in degrees", "1.1918, 1, 0.9004, 1.1106"]);
    score("-50,45,42,-48").fails(2, &["if these are angles in degrees"]);
    score("12,12,0.9,0.9").fails(2, &["extends more than 85° to one side"]);
    // 1.2 and 1 are the tangents of 0.876 and 0.785 radians.
    score("0.876058,0.876058,0.785398,0.785398")
        .ok()
        .says(&["angles in radians", "1.2000,1.2000,1.0000,1.0000"]);
    score("1,1,1.2,1.2").ok().says(&["pixels are 1.44 times as long", "48x40"]);
}

#[test]
fn fields_and_distances_in_other_units() {
    let folder = Folder::with_pair();
    let score = |view: &[&str]| folder.score(&[&["a.png", "b.png"], view, &METRIC[..]].concat());
    let plain = score(&["--fov-vertical", "60"]).ok();
    assert!(!plain.stderr.contains("per degree at its centre"), "{}", plain.stderr);
    folder.png_pair("c.png", "d.png", 640, 480);
    let large = |view: &[&str]| folder.score(&[&["c.png", "d.png"], view, &METRIC[..]].concat());
    large(&["--fov-vertical", "1.6"]).ok().says(&["300 pixels per degree", "not in radians"]);
    large(&["--distance-m", "600", "--pixel-pitch-mm", "0.25"])
        .ok()
        .says(&["distance must be in metres"]);
    large(&["--distance-m", "0.6", "--pixel-pitch-mm", "250"]).ok().says(&["the screen fills 179"]);
}

#[test]
fn experiments_and_curves_too() {
    let folder = two_scenes();
    let frustum = |sides: &str| {
        let [left, right, up, down]: [&str; 4] =
            sides.split(',').collect::<Vec<_>>().try_into().unwrap();
        let table =
            format!("frustum = {{ left = {left}, right = {right}, up = {up}, down = {down} }}");
        folder.write("e.toml", experiment("").replace("fov_vertical_deg = 60", &table));
    };
    assert!(HEAD.contains("fov_vertical_deg = 60"));
    frustum("50,45,42,48");
    for command in ["check", "run"] {
        folder.run(&[command, "e.toml"]).fails(2, &["1.1918, 1, 0.9004, 1.1106"]);
    }
    frustum("1,1,1.2,1.2");
    for command in ["check", "run"] {
        folder
            .run(&[command, "e.toml"])
            .ok()
            .says(&["room: pixels are 1.44 times", "hall: pixels"]);
    }
    let curve = |frustum: &str| {
        folder.run(&["curves", "--method", "rmfr", "--resolution", "800x800", "--frustum", frustum])
    };
    curve("50,45,42,48").fails(2, &["if these are angles in degrees"]);
    curve("2,2,1,1").ok().says(&["pixels are 2.00 times"]);
}
