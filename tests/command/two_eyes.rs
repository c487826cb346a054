//! `fovqa score` of two eyes.

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::Folder;

const RIGHT: [&str; 6] =
    ["l.png", "lt.png", "--right-reference", "r.png", "--right-test", "rt.png"];
const VIEW: [&str; 4] = ["--fov-vertical", "60", "--bands", "0,10,80"];

/// Reference and test of two eyes, and both eyes side by side.
fn eyes() -> Folder {
    let folder = Folder::new();
    let mut wide = [vec![0; 96 * 40 * 3], vec![0; 96 * 40 * 3]];
    for (nth, eye) in ["l", "r"].into_iter().enumerate() {
        let reference = codes(48, 40, 3, nth as u64);
        let test = disturbed(&reference, 30.0 + 20.0 * nth as f64, 2);
        for (all, own) in wide.iter_mut().zip([&reference, &test]) {
            for (to, from) in all.chunks_mut(96 * 3).zip(own.chunks(48 * 3)) {
                to[nth * 48 * 3..][..48 * 3].copy_from_slice(from);
            }
        }
        folder.png(&format!("{eye}.png"), 48, 40, &reference);
        folder.png(&format!("{eye}t.png"), 48, 40, &test);
    }
    folder.png("wide.png", 96, 40, &wide[0]);
    folder.png("widet.png", 96, 40, &wide[1]);
    folder
}

/// What a document says about a comparison.
fn contents(json: &Value) -> Value {
    let mut json = json.clone();
    for key in ["schema", "version", "eyes"] {
        json.as_object_mut().unwrap().remove(key);
    }
    json
}

#[test]
fn json_has_each_eye_as_if_it_were_alone_and_both() {
    let folder = eyes();
    let of = |arguments: &[&str]| folder.json(&[arguments, &VIEW, &["--gaze", "20,20"]].concat());
    let all = of(&[&RIGHT[..], &["--right-gaze", "28,20"]].concat());
    assert_eq!(all["schema"], "fovqa.score/1");
    assert_eq!(all["eyes"]["left"], contents(&of(&["l.png", "lt.png"])));
    let right = [&["r.png", "rt.png"], &VIEW[..], &["--gaze", "28,20"]].concat();
    assert_eq!(all["eyes"]["right"], contents(&folder.json(&right)));
    let mse = |json: &Value| json["summary"]["mse"]["mean"].as_f64().unwrap();
    let each = [mse(&all["eyes"]["left"]), mse(&all["eyes"]["right"])];
    assert!(each[0] < each[1] && (mse(&all) - f64::midpoint(each[0], each[1])).abs() < 1e-12);
    assert_eq!(all["frames"][0]["reference"], "l.png");
    assert!(of(&["l.png", "lt.png"]).get("eyes").is_none());
}

#[test]
fn a_side_by_side_picture_has_two_eyes() {
    let folder = eyes();
    let crops = ["--crop", "0,0,48,40", "--right-crop", "48,0,48,40"];
    let wide = folder.json(&[&["wide.png", "widet.png"], &crops[..], &VIEW].concat());
    let apart = folder.json(&[&RIGHT[..], &VIEW].concat());
    assert_eq!(wide["summary"], apart["summary"]);
    assert_eq!(wide["eyes"]["right"]["summary"], apart["eyes"]["right"]["summary"]);
}

#[test]
fn the_table_and_csv_name_the_eyes() {
    let folder = eyes();
    let table = folder.score(&[&RIGHT[..], &VIEW].concat()).ok().stdout;
    for title in ["Left eye\nlt.png against l.png\n", "Right eye\nrt.png against r.png\n"] {
        assert!(table.contains(title), "{title}{table}");
    }
    let both = table.split("Both eyes, 1 frame\n").nth(1).unwrap();
    let json = folder.json(&[&RIGHT[..], &VIEW].concat());
    let psnr = both.lines().find(|line| line.starts_with("PSNR dB")).unwrap();
    let mean = |json: &Value| format!("{:.3}", json["summary"]["psnr"]["mean"].as_f64().unwrap());
    let means = [&json["eyes"]["left"], &json["eyes"]["right"], &json].map(mean);
    assert_eq!(psnr.split_whitespace().skip(2).collect::<Vec<_>>(), means, "{table}");
    assert!(both.contains("left eye  right eye  both eyes") && both.contains("eccentricity"));

    let csv = folder.score(&[&RIGHT[..], &VIEW, &["--format", "csv"]].concat()).ok().stdout;
    let eyes = |eye: &str| csv.lines().filter(|l| l.split(',').nth(3) == Some(eye)).count();
    let one = folder.score(&[&["l.png", "lt.png"], &VIEW[..], &["--format", "csv"]].concat());
    let rows = one.ok().stdout.lines().count() - 1;
    assert_eq!((eyes("left"), eyes("right"), eyes("")), (rows, rows, 0), "{csv}");
    assert!(eyes("both") > 0);
}

#[test]
fn maps_have_a_folder_for_each_eye() {
    let folder = eyes();
    folder.score(&[&RIGHT[..], &["--metrics", "ssim", "--maps", "maps"]].concat()).ok();
    for eye in ["left", "right"] {
        assert!(folder.path(&format!("maps/{eye}/ssim-0000.exr")).is_file(), "{eye}");
    }
}

#[test]
fn a_right_eye_without_frames_is_a_mistake() {
    let folder = eyes();
    let with = |arguments: &[&str]| folder.score(&[&["l.png", "lt.png"], arguments].concat());
    let frames = "the frames of the right eye are missing";
    with(&["--fov-vertical", "60", "--right-gaze", "3,4"]).fails(2, &[frames]);
    with(&["--right-reference", "r.png"]).fails(2, &["--right-test"]);
    let stdin = ["--right-reference", "r.png", "--right-test", "-"];
    with(&stdin).fails(2, &["standard input"]);
    with(&["--right-reference", "r.png", "--right-test", "no.png"]).fails(3, &["no.png"]);
    folder.write("rt.png", "no picture");
    let run = folder.score(&[&RIGHT[..], &["--format", "json"]].concat());
    assert_eq!(run.code, 3);
    assert!(run.stderr.contains("right eye: "), "{}", run.stderr);
    assert_eq!(run.json()["errors"][0]["eye"], "right");
}
