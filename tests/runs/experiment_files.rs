//! Experiment files: mistakes are shown in their place, and the JSON Schema agrees with the parser.

use std::fs;

use serde_json::Value;

use crate::fovqa::{Folder, Run, command, root, shared};

/// A whole experiment of one scene and two methods, over files that are there.
pub(super) const GOOD: &str = r#"
name = "good"
[view]
fov_vertical_deg = 60
[[scene]]
name = "room"
reference = "gt"
[[method]]
name = "A"
test = "a"
[[method]]
name = "B"
test = "b"
[metrics]
psnr = {}
ssim = { sigma = 2.0 }
fpsnr = {}
"#;

pub(super) fn folder() -> Folder {
    let folder = Folder::new();
    for method in ["a", "b"] {
        folder.png_pair("gt/0000.png", &format!("{method}/0000.png"), 48, 40);
    }
    folder
}

/// What the parser says of a file.
pub(super) fn check(folder: &Folder, text: &str) -> Run {
    folder.write("e.toml", text);
    folder.run(&["check", "e.toml"])
}

/// Whether the schema allows a file.
pub(crate) fn schema_allows(text: &str) -> bool {
    let schema: Value = Run::from(command(&["schema"]).output().unwrap()).ok().json();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let experiment: Value = toml::from_str(text).unwrap();
    validator.is_valid(&experiment)
}

#[test]
fn the_committed_schema_is_the_one_printed() {
    let printed = Run::from(command(&["schema"]).output().unwrap()).ok().stdout;
    let committed = fs::read_to_string(root().join("docs/experiment.schema.json")).unwrap();
    assert_eq!(committed, printed, "run: fovqa schema > docs/experiment.schema.json");
}

/// Everything the format has, in one file.
const RICH: &str = r#"
schema = 1
name = "rich"

[view]
display = "vive_pro_eye"
gaze = { left = [20, 20], right = { trace = "{scene}/gaze.csv", hold = true } }
eccentricity = "planar"
bands_deg = [0, 7.5, 30]
[view.left]
frustum = { left = -1.2, right = 0.9, up = 1.1, down = -1.1 }

[signal]
channels = "luma"
exposure_stops = -0.5
tonemap = "reinhard"
transfer = "srgb"
nonfinite = "mask"
alpha = "over-black"
max_megapixels = 10
[signal.right]
crop = [0, 0, 40, 40]

[[scene]]
name = "room"
folder = "the room"
reference = { left = "gt/left.%04d.png", right = "gt/right.%04d.png" }
fps = 72.5
frames = "0..=3:1"
allow_missing = true
[scene.left]
crop = [8, 0, 40, 40]

[[scene]]
name = "hall"
reference = { left = "gt/left.%04d.png", right = "gt/right.%04d.png" }
gaze = "center"
distance_m = 0.5
screen_m = [1.2, 0.8]

[[method]]
name = "A"
test = "{method}/{eye}.%04d.png"
[[method]]
name = "B"
test = { left = "{method}/left.%04d.png", right = "{method}/right.%04d.png" }
scenes = ["room", "hall"]

[metrics]
ssim = { radius = "auto", k1 = 0.02 }
fpsnr = { weight = "acuity", acuity = "linear_mar", m = 0.03 }

[[plot]]
kind = "table"
scenes = ["hall"]
[[plot]]
kind = "profile"
metric = "ssim"
methods = ["B"]
"#;

#[test]
fn the_whole_format_is_read_and_resolved() {
    let folder = Folder::new();
    for eye in ["left", "right"] {
        for frame in 0..2 {
            let reference = format!("gt/{eye}.{frame:04}.png");
            for method in ["A", "B"] {
                folder.png_pair(&reference, &format!("{method}/{eye}.{frame:04}.png"), 48, 40);
            }
        }
    }
    folder.write("room/gaze.csv", "frame,x_px,y_px\n0,10,10\n");
    assert!(schema_allows(RICH));
    let plan = check(&folder, RICH).ok().stdout;
    for words in [
        "room, left eye: 2 frames, 0 to 1 of 40x40 px",
        "kept from an earlier frame in 1 frame",
        "16 test frames",
    ] {
        assert!(plan.contains(words), "{words}:\n{plan}");
    }
    folder.run(&["run", "e.toml"]).ok();
    let record = fs::read_to_string(folder.path("reports/rich/run.json")).unwrap();
    let record: Value = serde_json::from_str(&record).unwrap();
    let [left, right] = [0, 1].map(|eye| record["resolved"]["scenes"][0]["eyes"][eye].clone());
    assert_eq!(left["view"]["frustum"]["left"], -1.2);
    assert_eq!(left["view"]["gaze"], serde_json::json!([20.0, 20.0]));
    assert_eq!(left["signal"]["crop"], serde_json::json!([8, 0, 40, 40]));
    assert_eq!(right["view"]["display"], "vive_pro_eye");
    assert_eq!(right["view"]["gaze"]["trace"], "room/gaze.csv");
    assert_eq!(right["signal"]["crop"], serde_json::json!([0, 0, 40, 40]));
    assert_eq!(right["tests"]["B"], "B/right.%04d.png");
    let hall = &record["resolved"]["scenes"][1]["eyes"][0];
    assert_eq!(
        hall["view"]["screen_m"],
        serde_json::json!([1.2, 0.8]),
        "a scene's view replaces all"
    );
    assert_eq!(hall["view"]["frustum"], Value::Null);
    assert_eq!(hall["signal"]["tonemap"], "reinhard");
    assert_eq!(record["resolved"]["metrics"]["ssim"]["sigma"], 1.5, "defaults are written out");
    assert_eq!(record["resolved"]["metrics"]["ssim"]["k1"], 0.02);
    assert_eq!(record["resolved"]["metrics"]["fpsnr"]["knots_deg"][4], 60);
}

#[test]
fn files_that_are_no_experiment() {
    let folder = folder();
    folder.run(&["run", "nope.toml"]).fails(2, &["nope.toml", "no such file"]);
    folder.run(&["run", "gt"]).fails(2, &["not a regular file"]);
    folder.run(&["check", "gt/0000.png"]).fails(2, &["not UTF-8"]);
    check(&folder, "").fails(2, &["has no name", "has no scene", "has no method"]);
    check(&folder, "name = \"x").fails(2, &["this is not TOML", "e.toml:1"]);
    check(&folder, &format!("{GOOD}[signal\n")).fails(2, &["this is not TOML"]);
    check(&folder, &format!("{GOOD}[metrics]\nmse = {{}}\n")).fails(2, &["this is not TOML"]);
    folder.write("long.toml", "#".repeat(5 << 20));
    folder.run(&["check", "long.toml"]).fails(2, &["larger than 4 MiB"]);
}

#[test]
fn two_eyes_have_a_view_each_or_none() {
    let folder = folder();
    let text = GOOD
        .replace("fov_vertical_deg = 60", "left = { fov_vertical_deg = 60 }")
        .replace("fpsnr = {}", "")
        .replace("\"gt\"", "{ left = \"gt\", right = \"gt\" }")
        .replace("test = \"a\"", "test = { left = \"a\", right = \"a\" }")
        .replace("test = \"b\"", "test = { left = \"b\", right = \"b\" }");
    check(&folder, &text).fails(2, &["scene \"room\" has a view only for its left eye"]);
    check(&folder, &text.replace("left = { fov", "right = { fov"))
        .fails(2, &["only for its right eye"]);
    check(&folder, &text.replace("left = { fov_vertical_deg = 60 }", "")).ok();
}

#[test]
fn a_scene_needs_a_method() {
    let scene = "scenes = [\"room\"]";
    let text = GOOD
        .replace("test = \"a\"", &format!("test = \"a\"\n{scene}"))
        .replace("test = \"b\"", &format!("test = \"b\"\n{scene}"));
    let hall = "[[scene]]\nname = \"hall\"\nreference = \"gt\"\n";
    check(&folder(), &format!("{text}{hall}"))
        .fails(2, &["no method is scored in scene \"hall\"", "remove it"]);
}

#[test]
fn a_profile_needs_a_view() {
    let text = GOOD
        .replace("fov_vertical_deg = 60", "")
        .replace("fpsnr = {}", "[[plot]]\nkind = \"profile\"");
    check(&folder(), &text).fails(2, &["none of its scenes has a view", "[view]"]);
}

#[test]
fn an_array_of_tables_names_the_entry_that_is_none() {
    let text = "name = \"e\"\nscene = [1, { name = \"s\", reference = \"gt\" }]\nmethod = []\n";
    check(&folder(), text).fails(2, &["an entry of scene cannot be a whole number", "[[scene]]"]);
}

/// What only the files can tell, but the experiment has wrong.
#[test]
fn wrong_patterns_and_times_without_a_rate_are_the_experiments_fault() {
    let folder = folder();
    folder.write("gaze.csv", "time_s,x_px,y_px\n0.0,1,1\n");
    for (change, words) in [
        ("test = \"gt/%d.%d.png\"", &["room, A: gt/%d.%d.png: it is not a pattern"]),
        (
            "test = \"a\"\n[[scene]]\nname = \"hall\"\nreference = \"gt\"\ngaze = { trace = \"gaze.csv\" }",
            &["give fps"],
        ),
    ] {
        folder.write("e.toml", GOOD.replacen("test = \"a\"", change, 1));
        for command in ["check", "run"] {
            let run = folder.run(&[command, "e.toml"]);
            assert_eq!(run.code, 2, "{}", run.stderr);
            run.says(words);
        }
        assert!(!folder.path("reports/good/results.csv").exists());
    }
}

/// Neither a file on one line nor one of mistakes alone fills the terminal, and none steers it.
#[test]
fn mistakes_are_shown_within_reason() {
    let folder = folder();
    let one_line: String = "{name=\"s\",reference=\"../gt\",k=1},".repeat(3000);
    let run = check(&folder, &format!("name = \"e\"\nscene=[{one_line}]\n"))
        .fails(2, &["e.toml:2:", "more mistakes"]);
    assert!(run.stderr.len() < 20_000, "{}", run.stderr.len());
    let many: Vec<String> = (0..5000).map(|i| format!("k{i} = 1")).collect();
    let many = many.join("\n");
    let run = check(&folder, &many).fails(2, &["4983 more mistakes"]);
    assert!(run.stderr.len() < 20_000, "{}", run.stderr.len());
    let run =
        check(&folder, "name = \"e\"\ncolour = \"\u{9b}31m\" # \u{9b}31m\n").fails(2, &["colour"]);
    assert!(
        !run.stderr.chars().any(|c| c.is_control() && c != '\n'),
        "{}",
        run.stderr.escape_debug()
    );
}

#[test]
fn all_mistakes_are_said_at_once() {
    let folder = folder();
    let text = GOOD.replacen("psnr = {}", "pnsr = {}", 1).replace("60", "600");
    check(&folder, &text).fails(2, &["pnsr", "600", "2 mistakes"]);
}

#[test]
fn inputs_that_are_not_there_are_said_by_check() {
    let folder = folder();
    let run = check(&folder, &GOOD.replace("test = \"b\"", "test = \"nope\""));
    assert_eq!(run.code, 3);
    run.says(&["room, B: nope: there is no such file or folder"]);
    let run = check(
        &folder,
        &GOOD.replace("reference = \"gt\"", "reference = \"gt\"\nframes = \"5..9\""),
    );
    assert_eq!(run.code, 3);
    run.says(&["room: the selection contains no frame; the frames are 0 to 0"]);
    let run = check(
        &folder,
        &GOOD.replace("reference = \"gt\"", "reference = \"gt\"\nmask = \"no.png\""),
    );
    assert_eq!(run.code, 3);
    run.says(&["the mask no.png: there is no such file"]);
}

/// The tables in an array, if it is there.
fn tables(value: Option<&mut toml::Value>) -> impl Iterator<Item = &mut toml::Table> {
    let tables = value.map(|value| value.as_array_mut().unwrap().iter_mut());
    tables.into_iter().flatten().map(|table| table.as_table_mut().unwrap())
}

/// An experiment with emulated methods, made small: few frames of few pixels of built-in scenes, few
/// points of a sweep, and regions that lie in these frames.
fn small(text: &str) -> String {
    const MOST_FRAMES: i64 = 3;
    const MOST_VALUES: usize = 2;
    let mut experiment: toml::Table = toml::from_str(text).unwrap();
    let mut is_builtin = false;
    for scene in tables(experiment.get_mut("scene")) {
        if scene.contains_key("builtin") {
            is_builtin = true;
            let frames = scene.get("frames").and_then(toml::Value::as_integer).unwrap_or(1);
            scene.insert("frames".to_owned(), frames.min(MOST_FRAMES).into());
            scene.insert("resolution".to_owned(), "176x200".into());
            scene.insert("samples".to_owned(), 2.into());
            scene.remove("gaze");
        } else if let Some(reference) = scene.get_mut("reference") {
            let data = shared("data").unwrap();
            let path = reference.as_str().unwrap().split("shared/data/").nth(1).unwrap();
            *reference = data.join(path).to_str().unwrap().into();
        }
    }
    for plot in tables(experiment.get_mut("plot")).filter(|_| is_builtin) {
        for region in tables(plot.get_mut("regions")) {
            region.insert("at".to_owned(), vec![88, 100].into());
            region.insert("size".to_owned(), vec![24, 24].into());
        }
    }
    let sweep = experiment.get_mut("sweep").and_then(|sweep| sweep.as_table_mut());
    for (_, values) in sweep.into_iter().flatten() {
        match values {
            toml::Value::Array(values) => values.truncate(MOST_VALUES),
            range => range["steps"] = (MOST_VALUES as i64).into(),
        }
    }
    experiment.to_string()
}

/// Every experiment that belongs to the repository, run where its data is there.
#[test]
fn the_committed_experiments_are_right() {
    let results = Folder::new();
    let data = shared("data");
    let configs = root().join("configs");
    // Opinion scores are beside the experiment that names them.
    let opinions = "studies/data/opinions.csv";
    results.write(opinions, fs::read(configs.join(opinions)).unwrap());
    let folders = [configs.join("papers"), configs.join("ci"), configs];
    let mut seen = 0;
    for entry in folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()) {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.extension().is_none_or(|e| e != "toml") || name == "displays.toml" {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        if !text.contains("[[scene]]") {
            // Curves have a test of their own.
            continue;
        }
        seen += 1;
        assert!(schema_allows(&text), "{name}");
        let run = Run::from(command(&["check", path.to_str().unwrap()]).output().unwrap());
        let there = data.is_some() || !text.contains("../shared");
        assert_eq!(run.code, if there { 0 } else { 3 }, "{name}: {}", run.stderr);
        // These take longer and have tests of their own (results_folder.rs, gallery/reproject.rs).
        if there && !["demo.toml", "reproject.toml"].contains(&name) {
            if text.contains("emulate = ") {
                results.write(name, small(&text));
                results.run(&["run", name]).ok();
            } else {
                results.run(&["run", path.to_str().unwrap()]).ok();
            }
            let folder = results.path(&format!("reports/{}", name.trim_end_matches(".toml")));
            let files = || fs::read_dir(&folder).unwrap().map(|file| file.unwrap().path());
            let tables = files().filter(|file| file.extension().is_some_and(|e| e == "md"));
            let rows: usize = tables.map(|t| fs::read_to_string(t).unwrap().lines().count()).sum();
            assert!(rows > 4, "{name}");
            assert!(fs::read_dir(folder.join("plots")).unwrap().count() >= 3, "{name}");
        }
    }
    assert!(seen >= 10);
}

/// The names of all properties in a schema.
fn keys(schema: &Value, found: &mut Vec<String>) {
    match schema {
        Value::Object(map) => {
            if let Some(Value::Object(properties)) = map.get("properties") {
                found.extend(properties.keys().cloned());
            }
            map.values().for_each(|value| keys(value, found));
        }
        Value::Array(list) => list.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

#[test]
fn every_key_is_documented() {
    let docs = fs::read_to_string(root().join("docs/experiments.md")).unwrap();
    let words: Vec<&str> = docs.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    let mut schema: Value = Run::from(command(&["schema"]).output().unwrap()).ok().json();
    // Metrics and their parameters are listed by `fovqa list metrics`.
    schema["properties"]["metrics"] = Value::Null;
    // Parameters of emulated methods are listed by `fovqa list methods`.
    let emulate = &mut schema["properties"]["method"]["items"]["properties"]["emulate"];
    let keys_of_full = emulate["anyOf"][0].take();
    assert_eq!(keys_of_full["properties"]["model"]["enum"][0], "full");
    *emulate = keys_of_full;
    emulate["properties"]["other_eye"] = Value::Null;
    emulate["properties"].as_object_mut().unwrap().retain(|key, _| !key.contains('.'));
    let mut found = Vec::new();
    keys(&schema, &mut found);
    assert!(found.len() > 40);
    for key in found {
        assert!(words.contains(&key.as_str()), "{key}");
    }
}
