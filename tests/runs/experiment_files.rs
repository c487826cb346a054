//! Experiment files: mistakes are shown in their place, and the JSON Schema agrees with the parser.

use std::fs;

use serde_json::Value;

use crate::fovqa::{Folder, Run, command, root, shared};

/// A whole experiment of one scene and two methods, over files that are there.
const GOOD: &str = r#"
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

fn folder() -> Folder {
    let folder = Folder::new();
    for method in ["a", "b"] {
        folder.png_pair("gt/0000.png", &format!("{method}/0000.png"), 48, 40);
    }
    folder
}

/// What the parser says of a file.
fn check(folder: &Folder, text: &str) -> Run {
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

/// A mistake: the line it replaces (or, empty, is put in front of), the line itself, the words of the
/// message, and whether a schema can tell.
type Mistake = (&'static str, &'static str, &'static [&'static str], bool);

const MISTAKES: &[Mistake] = &[
    ("", "colour = \"rgb\"", &["no key `colour`", "e.toml:1:1"], true),
    ("", "metric = { psnr = {} }", &["no key `metric`", "did you mean metrics?"], true),
    ("name = \"good\"", "nam = \"good\"", &["did you mean name?", "has no name"], true),
    ("name = \"good\"", "name = 5", &["name cannot be a whole number", "a name in quotes"], true),
    ("name = \"good\"", "name = \"../good\"", &["cannot have /"], true),
    ("name = \"good\"", "schema = 2\nname = \"good\"", &["schema cannot be 2"], true),
    ("fov_vertical_deg = 60", "fov_vertical_deg = 180", &["cannot be 180", "above 0"], true),
    ("fov_vertical_deg = 60", "fov_vertical_deg = \"wide\"", &["cannot be text"], true),
    ("fov_vertical_deg = 60", "fov_vertical_deg = nan", &["cannot be nan"], false),
    (
        "fov_vertical_deg = 60",
        "display = \"vive-pro-ey\"",
        &["did you mean \"vive_pro_eye\"?"],
        true,
    ),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ndisplay = \"vive-pro-eye\"",
        &["more than one way: display, fov_vertical_deg"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "distance_m = 0.5",
        &["distance_m alone does not define a view"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "frustum = { left = -1, right = -1, up = 1, down = 1 }",
        &["the frustum tangents must be positive"],
        false,
    ),
    ("fov_vertical_deg = 60", "bands_deg = [0, 10]", &["eccentricity bands needs a view"], false),
    ("fov_vertical_deg = 60", "gaze = [1, 2]", &["a gaze needs a view"], false),
    ("fov_vertical_deg = 60", "", &["fpsnr needs a view, but scene \"room\" has none"], false),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\nbands_deg = [0, 10, 5]",
        &["5 is not above the edge before it, 10"],
        false,
    ),
    ("fov_vertical_deg = 60", "fov_vertical_deg = 60\nbands_deg = [0]", &["a list of 1"], true),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ngaze = \"centre\"",
        &["did you mean \"center\"?"],
        true,
    ),
    ("fov_vertical_deg = 60", "fov_vertical_deg = 60\ngaze = [1, 2, 3]", &["a list of 3"], true),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ngaze = {}",
        &["a table without a trace"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\ngaze = { left = [1, 2], right = [1, 2] }",
        &["the scene has one reference"],
        false,
    ),
    ("reference = \"gt\"", "", &["scene \"room\" has no reference"], true),
    ("reference = \"gt\"", "reference = \"gt\"\nfps = 0", &["cannot be 0"], true),
    ("reference = \"gt\"", "reference = \"gt\"\nframes = \"5\"", &["not a range of frames"], true),
    (
        "reference = \"gt\"",
        "reference = \"{scen}\"",
        &["{scen}, which is not a known placeholder"],
        false,
    ),
    ("reference = \"gt\"", "reference = \"{scene\"", &["opens a brace"], false),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ncrop = [0, 0, 0, 5]",
        &["crop contains no pixels"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nleft = { gaze = [1, 2] }",
        &["no left eye of its own"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = { left = \"gt\", right = \"gt\" }",
        &["two eyes, but method \"A\" has one test", "{eye}"],
        false,
    ),
    ("reference = \"gt\"", "reference = { left = \"gt\" }", &["has no right"], true),
    (
        "test = \"a\"",
        "test = \"{eye}\"",
        &["a test for each eye, but scene \"room\" has one"],
        false,
    ),
    (
        "test = \"a\"",
        "test = \"a\"\nscenes = [\"rom\"]",
        &["no scene \"rom\"", "did you mean \"room\"?"],
        false,
    ),
    ("test = \"a\"", "test = \"a\"\nscenes = []", &["a list of 0"], true),
    ("name = \"B\"", "name = \"A\"", &["two methods named \"A\"", "the second"], false),
    ("name = \"B\"", "name = \"a\"", &["two methods named \"a\""], false),
    ("psnr = {}", "pnsr = {}", &["no metric `pnsr`", "did you mean psnr?"], true),
    ("psnr = {}", "psnr = true", &["metrics.psnr is true or false"], true),
    (
        "psnr = {}",
        "psnr = { peak = 255 }",
        &["psnr has no parameter `peak`", "no parameters"],
        true,
    ),
    ("sigma = 2.0", "sgma = 2.0", &["did you mean sigma?"], true),
    ("sigma = 2.0", "sigma = 0", &["metrics.ssim.sigma cannot be 0", "from 0.1 to 64"], true),
    ("sigma = 2.0", "radius = 2.5", &["metrics.ssim.radius"], true),
    ("fpsnr = {}", "fpsnr = { weight = \"lee2003\" }", &["did you mean \"lee2002\"?"], true),
    (
        "fpsnr = {}",
        "fpsnr = { weight = \"acuity\", knots_cpd = [1] }",
        &["knots_cpd cannot be"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profiel\"",
        &["did you mean \"profile\"?"],
        true,
    ),
    ("fpsnr = {}", "fpsnr = {}\n[[plot]]\nmetric = \"psnr\"", &["plot has no kind"], true),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profile\"\nmetric = \"fpsnr\"",
        &["fpsnr has no values per band"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"bars\"\nmetric = \"mse\"",
        &["mse is not scored"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"bars\"\nmethods = [\"C\"]",
        &["no method \"C\""],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[scene]]\nname = \"room\"\nreference = \"gt\"",
        &["two scenes named \"room\""],
        false,
    ),
    ("name = \"B\"", "name = \"Best\"", &["a method cannot be named \"Best\""], false),
    ("name = \"room\"", "name = \"average\"", &["a scene cannot be named"], false),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\nleft = { gaze = [1, 2] }",
        &["no scene has a left eye of its own"],
        false,
    ),
    (
        "fov_vertical_deg = 60",
        "fov_vertical_deg = 60\nleft = { gaze = { left = [1, 2] } }",
        &["has no key `left`"],
        true,
    ),
    ("fov_vertical_deg = 60", "eccentricity = \"planar\"", &["eccentricity needs a view"], false),
    (
        "fpsnr = {}",
        "mse = {}\n[[scene]]\nname = \"hall\"\nreference = \"gt\"\n[[plot]]\nkind = \"bars\"\nscenes = [\"hall\"]\nmethods = [\"C\"]\n[[method]]\nname = \"C\"\ntest = \"a\"\nscenes = [\"room\"]",
        &["none of its methods is in any of its scenes"],
        false,
    ),
    ("fov_vertical_deg = 60", "display = \"VIVE-pro_eye\"", &["did you mean"], true),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ncrop = [0, 0, 5.5, 5]",
        &["crop cannot be 5.5"],
        true,
    ),
    ("reference = \"gt\"", "reference = \"gt\"\nframes = \"+0..5\"", &["not a range"], true),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[plot]\nkind = \"bars\"",
        &["plot cannot be a table", "[[plot]]"],
        true,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"profile\"\nmetric = \"psnr\"\nlevels = [1]",
        &["levels only applies to the wavelet", "metric = \"haar\""],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"profile\"\nlevels = [1]",
        &["levels only applies to the wavelet"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = { levels = 3 }\n[[plot]]\nkind = \"profile\"\nmetric = \"haar\"\nlevels = [1, 4]",
        &["level 4 is not scored: the number of levels is 3", "haar = { levels = 4 }"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"ratios\"\nmetric = \"haar\"\nlevels = [9]",
        &["plot.levels", "9", "from 1 to 8"],
        true,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"table\"\nstatistic = \"energy\"",
        &["statistic only applies to the wavelet"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"profile\"\nmetric = \"haar\"\nstatistic = \"enrgy\"",
        &["did you mean \"energy\"?"],
        true,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"bars\"\nmetric = \"haar\"",
        &["haar describes each image by eccentricity: draw it as profile or ratios", "psnr"],
        false,
    ),
    (
        "fpsnr = {}",
        "rms_contrast = {}\n[[plot]]\nkind = \"sequence\"\nmetric = \"rms_contrast\"",
        &["rms_contrast describes each image by eccentricity"],
        false,
    ),
    (
        "fpsnr = {}",
        "haar = {}\n[[plot]]\nkind = \"ratios\"\nmetric = \"ssim\"",
        &["ssim already compares test with reference, and so has no ratio", "haar"],
        false,
    ),
    (
        "fpsnr = {}",
        "fpsnr = {}\n[[plot]]\nkind = \"ratios\"",
        &["nothing to show: no metric that is scored fits its kind"],
        false,
    ),
    ("fpsnr = {}", "haar = { levels = 9 }", &["metrics.haar.levels cannot be 9"], true),
    ("fpsnr = {}", "haar = { levels = 0 }", &["metrics.haar.levels cannot be 0"], true),
    ("fpsnr = {}", "haar = { orientations = \"yes\" }", &["metrics.haar.orientations"], true),
    ("fpsnr = {}", "rms_contrast = { signal = \"lumen\" }", &["metrics.rms_contrast.signal"], true),
    ("fpsnr = {}", "atd = { depth_tolerance = -0.1 }", &["metrics.atd.depth_tolerance"], true),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { preset = \"blender\", channels = [\"u\", \"v\"] }",
        &["both channels and a preset are given", "keep one of them"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ndepth = { preset = \"blender\", channel = \"Z\" }",
        &["both channel and a preset are given"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], sign = [1, 0.5] }",
        &["a sign must be 1 or -1", "use scale for other factors"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], sign = [1, 2] }",
        &["sign", "from -1 to 1"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], scale = 0 }",
        &["a scale of 0 removes all motion"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], scale = [1, 0.0] }",
        &["a scale of 0 removes all motion"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { sign = [1, -1] }",
        &["sign describes channels, but none are named", "add channels"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { preset = \"falcor\", unit = \"ndc\" }",
        &["unit describes channels, but none are named", "a preset has its own"],
        false,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\", \"v\"], unit = \"pixel\" }",
        &["unit cannot be \"pixel\"", "did you mean \"pixels\"?"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { channels = [\"u\"] }",
        &["channels", "a list of 1"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = \"blendr\"",
        &["motion cannot be \"blendr\"", "did you mean \"blender\"?"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\ndepth = { preset = \"renderman\" }",
        &["depth.preset cannot be \"renderman\"", "mitsuba"],
        true,
    ),
    (
        "reference = \"gt\"",
        "reference = \"gt\"\nmotion = { file = \"motion\" }",
        &["did you mean files?"],
        true,
    ),
];

fn with(mistake: &Mistake) -> String {
    match mistake {
        ("", line, ..) => format!("{line}{GOOD}"),
        (place, line, ..) => {
            assert!(GOOD.contains(place), "{place}");
            GOOD.replacen(place, line, 1)
        }
    }
}

#[test]
fn every_mistake_is_shown_in_its_place() {
    let folder = folder();
    check(&folder, GOOD).ok();
    for mistake in MISTAKES {
        let run = check(&folder, &with(mistake)).fails(2, mistake.2);
        assert!(run.stderr.contains("e.toml"), "{}", run.stderr);
    }
}

#[test]
fn the_schema_agrees_with_the_parser() {
    assert!(schema_allows(GOOD));
    for mistake @ (_, line, _, structural) in MISTAKES {
        let text = with(mistake);
        // JSON has no such number.
        if !line.contains("nan") {
            assert_eq!(schema_allows(&text), !structural, "{line}");
        }
    }
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

/// Every experiment that belongs to the repository, run where its data is there.
#[test]
fn the_committed_experiments_are_right() {
    let results = Folder::new();
    let data = shared("data");
    let configs = root().join("configs");
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
        if there {
            results.run(&["run", path.to_str().unwrap()]).ok();
            let folder = results.path(&format!("reports/{}", name.trim_end_matches(".toml")));
            let files = || fs::read_dir(&folder).unwrap().map(|file| file.unwrap().path());
            let tables = files().filter(|file| file.extension().is_some_and(|e| e == "md"));
            let rows: usize = tables.map(|t| fs::read_to_string(t).unwrap().lines().count()).sum();
            assert!(rows > 4, "{name}");
            assert!(fs::read_dir(folder.join("plots")).unwrap().count() >= 3, "{name}");
        }
    }
    assert!(seen >= 9);
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
    let mut found = Vec::new();
    keys(&schema, &mut found);
    assert!(found.len() > 40);
    for key in found {
        assert!(words.contains(&key.as_str()), "{key}");
    }
}
