//! Files of curves: figures, tables, pages, and what is wrong with a file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::fovqa::{Folder, Run, command, root};

/// Everything the format has, in one file.
const RICH: &str = r#"
schema = 1
name = "rich"
about = "A headset, ahead & aside."
step_deg = 0.5
to_deg = 70
acuity = { model = "piecewise", cap_cpd = 18 }

[view]
fov_vertical_deg = 110
resolutions = ["1440x1600", "2880 x 3200"]
gazes = ["center", [1000, 800]]
directions_deg = [0, 90]
tangential = "angle"
eccentricity = "angular"

[[curve]]
name = "RMFR"
method = { model = "rmfr", fx = 0.3 }

[[curve]]
name = "Polar"
method = { model = "visual-polar" }
resolutions = ["1440x1600"]
gazes = ["center"]
directions_deg = [0]
budget = 0.2
budget_of = "on_screen"

[[curve]]
name = "Nested"
method = { model = "deamp", sigmas = [2.51, 4.8], bounds_deg = [22.5, 45], projection = "linear" }
display = "huawei-vr-glass"
resolutions = ["1600x1600"]
gazes = ["center"]

[[curve]]
name = "VaFR"
method = { model = "vafr", ratio = [[0, 1], [30, 0.5]], cap_cpd = "none" }
directions_deg = [0]

[[curve]]
name = "Linear MAR"
acuity = { model = "linear_mar", m = 0.022 }

[[plot]]
kind = "rates"
title = "By resolution"
panels = "resolution"
curves = ["RMFR", "VaFR"]
rate = "both"
display = true
y_limits = [0.5, 60]
log = true

[[plot]]
kind = "rates"
name = "One #1"
panels = "one"
unit = "per_pixel"
areas = false

[[plot]]
kind = "rates"
name = "marked"
curves = ["Linear MAR"]
marks = [{ name = "Thibos 1996", at = [30, 5] }]

[[plot]]
kind = "density"
curves = ["Polar", "Nested"]
rings_deg = [5, 20]

[[plot]]
kind = "accumulated"

[[plot]]
kind = "half_axis"
f = [1.5, 3]

[[table]]
kind = "samples"
[[table]]
kind = "speed_up"
curves = ["RMFR"]
[[table]]
kind = "acuity"
"#;

pub(crate) fn json(folder: &Folder, name: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.path(name)).unwrap()).unwrap()
}

/// Every file below a folder with its bytes, but those whose names begin with a dot.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            found.extend(
                files(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)),
            );
        } else if !name.starts_with('.') {
            found.insert(name, fs::read(&path).unwrap());
        }
    }
    found
}

#[test]
fn the_whole_format_is_drawn_and_again_the_same() {
    let folder = Folder::new();
    folder.write("rich.toml", RICH);
    let plan = folder.run(&["check", "rich.toml"]).ok().stdout;
    for words in
        ["rich: 16 curves", "2880x3200, gaze (1000, 800), direction 90°", "6 figures, 3 tables"]
    {
        assert!(plan.contains(words), "{words}:\n{plan}");
    }
    folder
        .run(&["curves", "rich.toml"])
        .ok()
        .says(&["Visual-Polar is a reconstruction", "rich/index.html"]);
    let first = files(&folder.path("reports/rich"));
    let names: Vec<&str> = first.keys().map(String::as_str).collect();
    for name in [
        "curves.csv",
        "curves.json",
        "index.html",
        "plots/rates.svg",
        "plots/one-1.png",
        "plots/density.csv",
        "plots/accumulated.svg",
        "plots/half-axis.svg",
        "table-samples.md",
        "table-speed-up.csv",
        "table-acuity.md",
    ] {
        assert!(names.contains(&name), "{name}: {names:?}");
    }
    let page = String::from_utf8(first["index.html"].clone()).unwrap();
    assert!(page.contains("ahead &amp; aside") && page.contains("table-acuity.csv"));
    assert!(page.contains("reconstruction from the text of the paper"));

    let marked = String::from_utf8(first["plots/marked.csv"].clone()).unwrap();
    assert!(marked.contains("Thibos 1996,30.0,5.0"), "{marked}");

    let record = json(&folder, "reports/rich/curves.json");
    assert_eq!(record["schema"], "fovqa.curves/1");
    assert_eq!(record["curves"].as_array().unwrap().len(), 16);
    let screen = &record["curves"][0]["screen"];
    assert_eq!(
        (&screen["tangential"], &screen["eccentricity"]),
        (&"angle".into(), &"angular".into())
    );
    assert_eq!(record["curves"][7]["screen"]["gaze_px"], serde_json::json!([1000.0, 800.0]));
    let polar = &record["curves"][8];
    let on_screen = polar["shading"]["samples_on_screen"].as_f64().unwrap();
    assert!((on_screen / (1440.0 * 1600.0) - 0.2).abs() < 1e-9);
    assert_eq!(polar["model"], "visual_polar");

    let mut csv = csv::Reader::from_reader(first["curves.csv"].as_slice());
    let head = csv.headers().unwrap().clone();
    let column = |name: &str| head.iter().position(|h| h == name).unwrap();
    let (mut rows, mut models) = (0, 0);
    for row in csv.records().map(Result::unwrap) {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        assert!(number("acuity_cpd") <= 18.0);
        rows += 1;
        if &row[column("model")] == "linear_mar" {
            let e = number("eccentricity_deg");
            assert!((number("radial_cpd") - 1.0 / (0.022 * e + 1.0 / 48.0)).abs() < 1e-9);
            assert_eq!(&row[column("width_px")], "");
            models += 1;
        }
    }
    assert!(rows > 1500 && models == 141, "{rows} {models}");

    for threads in ["1", "3"] {
        let mut again = command(&["curves", "rich.toml"]);
        let again = again.current_dir(folder.path("")).env("RAYON_NUM_THREADS", threads).output();
        Run::from(again.unwrap()).ok();
        assert_eq!(files(&folder.path("reports/rich")), first);
    }
}

#[test]
fn tables_hold_what_the_papers_print() {
    let folder = Folder::new();
    let table = root().join("configs/papers/vafr-table-1.toml");
    folder.run(&["curves", table.to_str().unwrap(), "--output", "out"]).ok();
    let text = fs::read_to_string(folder.path("out/table-samples.md")).unwrap();
    let row = |name: &str| text.lines().find(|line| line.contains(name)).unwrap().to_owned();
    for (name, cells) in [
        ("GT", ["3686.4", "8294.4", "18662.4", "33177.6", "74649.6"]),
        ("LaFR, δ = 2.2", ["761.7", "1713.7", "3855.9", "6854.9", "15423.5"]),
        ("LaFR, δ = 1.8", ["1137.8", "2560.0", "5760.0", "10240.0", "23040.0"]),
        ("Dup", ["1061.7", "1061.7", "1061.7", "1061.7", "1061.7"]),
    ] {
        let row = row(name);
        let found: Vec<&str> = row.split('|').map(str::trim).skip(2).step_by(2).take(5).collect();
        assert_eq!(found, cells, "{name}");
    }
    assert!(text.contains("not an independent check"), "VaFR_Rep says where its shares come from");
    let csv = fs::read_to_string(folder.path("out/table-samples.csv")).unwrap();
    assert!(csv.contains("samples 2560x1440") && csv.contains("VaFR_Dup,1061733.65"), "{csv}");
}

/// A mistake: the line it replaces, the line itself, the words of the message, whether a schema can
/// tell.
type Mistake = (&'static str, &'static str, &'static [&'static str], bool);

const GOOD: &str = r#"
name = "good"
[view]
fov_vertical_deg = 110
resolutions = ["1440x1600"]
[[curve]]
name = "A"
method = { model = "rmfr" }
[[curve]]
name = "B"
acuity = { model = "piecewise" }
[[plot]]
kind = "rates"
"#;

const MISTAKES: &[Mistake] = &[
    ("name = \"good\"", "nam = \"good\"", &["did you mean name?"], true),
    (
        "name = \"good\"",
        "name = \"good\"\nstep_deg = 0",
        &["step_deg cannot be 0", "from 0.001 to 60"],
        true,
    ),
    ("name = \"good\"", "name = \"good\"\nacuity = {}", &["acuity has no model"], true),
    ("fov_vertical_deg = 110", "fov_vertical_deg = 180", &["cannot be 180"], true),
    ("fov_vertical_deg = 110", "", &["no view is given", "fov_vertical_deg = 110"], false),
    ("resolutions = [\"1440x1600\"]", "", &["needs a resolution"], false),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"0x1600\"]",
        &["cannot be \"0x1600\"", "1 to 100000"],
        true,
    ),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"1440x1600\"]\ngazes = [[1]]",
        &["a list of 1"],
        true,
    ),
    (
        "resolutions = [\"1440x1600\"]",
        "resolutions = [\"1440x1600\"]\ntangential = \"round\"",
        &["cannot be \"round\""],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmf\" }",
        &["no method \"rmf\"", "did you mean \"rmfr\"?"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { sigma = 2 }",
        &["has no model", "\"deamp\""],
        true,
    ),
    ("method = { model = \"rmfr\" }", "method = { model = 3 }", &["text in quotes"], true),
    ("method = { model = \"rmfr\" }", "method = \"rmfr\"", &["a table such as"], true),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\", sigma = 0 }",
        &["sigma cannot be 0", "0.1 to 1000"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\", sgma = 2 }",
        &["no parameter `sgma`", "did you mean sigma?"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"vafr\", ratio = [1, 2] }",
        &["ratio"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"vafr\", knots_deg = [0, 9, 5, 30, 60] }",
        &["must start at 0° and increase"],
        false,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"deamp\", sigmas = [2] }",
        &["one of each per layer"],
        false,
    ),
    ("method = { model = \"rmfr\" }", "", &["neither a method nor an acuity model"], false),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\" }\nacuity = { model = \"piecewise\" }",
        &["both a method and an acuity model"],
        false,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\" }\nbudget = 0",
        &["budget cannot be 0"],
        true,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"guenter\" }\nbudget = 0.9",
        &["cannot reach a budget of 0.9"],
        false,
    ),
    (
        "method = { model = \"rmfr\" }",
        "method = { model = \"rmfr\" }\nbudget_of = \"buffer\"",
        &["none is given"],
        false,
    ),
    (
        "acuity = { model = \"piecewise\" }",
        "acuity = { model = \"piecewise\", knots_cpd = [40, 5] }",
        &["5 eccentricities and 2 frequencies"],
        false,
    ),
    (
        "acuity = { model = \"piecewise\" }",
        "acuity = { model = \"piecewise\", cap_cpd = \"high\" }",
        &["cap_cpd"],
        true,
    ),
    (
        "acuity = { model = \"piecewise\" }",
        "acuity = { model = \"piecewise\" }\nbudget = 0.1",
        &["budget needs a method"],
        false,
    ),
    ("name = \"B\"", "name = \"A\"", &["\"A\""], false),
    ("kind = \"rates\"", "kind = \"rate\"", &["did you mean \"rates\"?"], true),
    ("kind = \"rates\"", "kind = \"rates\"\ncurves = [\"C\"]", &["there is no curve \"C\""], false),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nf = [2]",
        &["f does not apply to a plot of kind \"rates\""],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\nunit = \"per_pixel\"\nmarks = [{ name = \"a\", at = [1, 2] }]",
        &["marks are in cycles per degree"],
        false,
    ),
    ("kind = \"rates\"", "kind = \"rates\"\nmarks = [{ at = [1, 2] }]", &["has no name"], true),
    ("kind = \"rates\"", "kind = \"half_axis\"", &["needs values of f"], false),
    ("kind = \"rates\"", "kind = \"half_axis\"\nf = [0.5]", &["cannot be 0.5"], true),
    ("kind = \"rates\"", "kind = \"accumulated\"", &["needs a curve of deamp"], false),
    ("kind = \"rates\"", "kind = \"density\"\ncurves = [\"B\"]", &["nothing to show"], false),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\ny_limits = [5, 5]",
        &["is not above its lower end"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\ny_limits = [0, 5]\nlog = true",
        &["cannot include 0"],
        false,
    ),
    (
        "kind = \"rates\"",
        "kind = \"rates\"\n[[table]]\nkind = \"samples\"\ncurves = [\"B\"]",
        &["nothing to show"],
        false,
    ),
    ("kind = \"rates\"", "kind = \"rates\"\n[[scene]]\nname = \"x\"", &["no key `scene`"], true),
];

fn schema_allows(text: &str) -> bool {
    let schema: Value = Run::from(command(&["schema", "curves"]).output().unwrap()).ok().json();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let file: Value = toml::from_str(text).unwrap();
    validator.is_valid(&file)
}

#[test]
fn every_mistake_is_shown_in_its_place_and_the_schema_agrees() {
    let folder = Folder::new();
    folder.write("e.toml", GOOD);
    folder.run(&["check", "e.toml"]).ok();
    assert!(schema_allows(GOOD) && schema_allows(RICH));
    for (line, instead, words, structural) in MISTAKES {
        assert_eq!(GOOD.matches(line).count(), 1, "{line}");
        let text = GOOD.replace(line, instead);
        folder.write("e.toml", &text);
        let run = folder.run(&["curves", "e.toml"]).fails(2, words);
        assert!(run.stderr.contains("e.toml"), "{}", run.stderr);
        assert_eq!(schema_allows(&text), !structural, "{instead}");
    }
    assert!(!folder.path("reports/good/curves.csv").exists());
}

#[test]
fn the_committed_schema_is_the_one_printed_and_its_keys_are_documented() {
    let printed = Run::from(command(&["schema", "curves"]).output().unwrap()).ok().stdout;
    let committed = fs::read_to_string(root().join("docs/curves.schema.json")).unwrap();
    assert_eq!(committed, printed, "run: fovqa schema curves > docs/curves.schema.json");
    let docs = ["curves.md", "experiments.md"]
        .map(|name| fs::read_to_string(root().join("docs").join(name)).unwrap());
    let docs = docs.join("\n");
    let words: Vec<&str> = docs.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    let schema: Value = serde_json::from_str(&printed).unwrap();
    let curve = &schema["properties"]["curve"]["items"]["properties"];
    let tables = [
        &schema["properties"],
        &schema["properties"]["view"]["properties"],
        curve,
        &schema["properties"]["plot"]["items"]["properties"],
        &schema["properties"]["table"]["items"]["properties"],
    ];
    let mut seen = 0;
    for key in tables.iter().flat_map(|table| table.as_object().unwrap().keys()) {
        assert!(words.contains(&key.as_str()), "{key}");
        seen += 1;
    }
    assert!(seen > 50, "{seen}");
}

const FIGURES: &str = r#"
name = "f"
[view]
resolutions = ["1600x1600"]
fov_vertical_deg = 90
[[curve]]
name = "Full"
method = { model = "full" }
[[curve]]
name = "Sparse"
method = { model = "guenter" }
[[curve]]
name = "Dense"
method = { model = "vafr", factor = 2 }
[[curve]]
name = "2L"
method = { model = "deamp", sigmas = [2.6], bounds_deg = [45] }
gazes = [[400, 1200]]
directions_deg = [90]
[[curve]]
name = "Angle"
method = { model = "full" }
tangential = "angle"
[[plot]]
kind = "rates"
name = "angle"
rate = "tangential"
unit = "per_pixel"
curves = ["Angle"]
[[plot]]
kind = "rates"
name = "pixels"
unit = "per_pixel"
panels = "one"
display = true
[[plot]]
kind = "rates"
name = "across"
rate = "tangential"
panels = "one"
curves = ["Full", "2L"]
[[plot]]
kind = "rates"
name = "sparse"
curves = ["Sparse"]
[[plot]]
kind = "rates"
name = "dense"
curves = ["Dense"]
[[plot]]
kind = "density"
curves = ["2L"]
[[plot]]
kind = "accumulated"
[[plot]]
kind = "half_axis"
f = [2]
"#;

/// What stands in the figures, from their data.
#[test]
fn figures_show_what_they_say() {
    let folder = Folder::new();
    folder.write("f.toml", FIGURES);
    folder.run(&["curves", "f.toml"]).ok();
    let plot = |name: &str| fs::read_to_string(folder.path("reports/f/plots").join(name)).unwrap();
    // Rows of a series: where, and what.
    let series = |name: &str, wanted: &str| -> Vec<(f64, f64)> {
        let text = plot(&format!("{name}.csv"));
        let mut csv = csv::Reader::from_reader(text.as_bytes());
        let rows = csv.records().map(Result::unwrap).filter(|row| &row[0] == wanted);
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        rows.map(|row| (number(&row[1]), number(&row[2]))).collect()
    };
    let near = |found: f64, want: f64| assert!((found / want - 1.0).abs() < 1e-9, "{found} {want}");
    let at =
        |rows: &[(f64, f64)], x: f64| rows.iter().find(|row| (row.0 - x).abs() < 1e-9).unwrap().1;

    // Over the display's own rate: 1, and 1/2 between 10° and 20°.
    let full = series("pixels", "Full, gaze at centre, direction 0°");
    assert!(full.len() > 200 && full.iter().all(|row| (row.1 - 1.0).abs() < 1e-12));
    near(at(&series("pixels", "Sparse, gaze at centre, direction 0°"), 15.0), 0.5);
    assert!(plot("pixels.svg").contains("Radial rate over the display"));

    // Across the line a degree of angle has other pixels, and the display's own rate is 1 again.
    let angle = series("angle", "Angle");
    assert!(angle.len() > 200 && angle.iter().all(|row| (row.1 - 1.0).abs() < 1e-12));

    // Across, 15° below the gaze: along x, where t = 0, f (f + A) / (f² σ), A the 1200 px to the
    // right, f = 608; a degree of the paper's convention has (π/180) 800 / cos² 15° pixels.
    let across = series("across", "2L, gaze (400, 1200), direction 90°");
    let pixels = 800.0 * 1f64.to_radians() / 15f64.to_radians().cos().powi(2);
    near(at(&across, 15.0), (608.0 + 1200.0) / (608.0 * 2.6) * pixels / 2.0);
    assert!(plot("across.svg").contains("Tangential rate"));

    // Areas are named after the side they lie on.
    let areas =
        |name: &str| ["Under-sampled", "Over-sampled"].map(|area| plot(name).contains(area));
    assert_eq!((areas("sparse.svg"), areas("dense.svg")), ([true, false], [false, true]));
    assert_eq!(areas("pixels.svg"), [false, false], "of several curves none");

    // The picture is the right way up: densest at the gaze, and there f (f + A) / (f² σ) each way.
    let text = plot("density.csv");
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    let cells: Vec<[f64; 3]> = csv
        .records()
        .map(|row| [1, 2, 3].map(|i| row.as_ref().unwrap()[i].parse().unwrap()))
        .collect();
    let densest = cells.iter().max_by(|a, b| a[2].total_cmp(&b[2])).unwrap();
    assert!((densest[0] - 400.0).abs() < 7.0 && (densest[1] - 1200.0).abs() < 7.0, "{densest:?}");
    let [x, y, density] = densest;
    let axis = |t: f64, side: f64| 608.0 * (608.0 + side) / ((t.abs() + 608.0).powi(2) * 2.6);
    let sides = [if *x < 400.0 { 400.0 } else { 1200.0 }, if *y < 1200.0 { 1200.0 } else { 400.0 }];
    let want = axis(x - 400.0, sides[0]) * axis(y - 1200.0, sides[1]);
    assert!((density / want - 1.0).abs() < 1e-4, "{density} {want}");

    // To the full angle of the whole frame.
    let accumulated = series("accumulated", "2L");
    assert!((accumulated[accumulated.len() - 1].0 - 90.0).abs() < 1e-9);
    // d / (2 - d), normalised.
    near(at(&series("half-axis", "f = 2"), 0.5), 1.0 / 3.0);
    near(at(&series("half-axis", "f = 2"), 1.0), 1.0);
}

/// Rings and cross stand where the method takes the gaze.
#[test]
fn a_gaze_outside_is_drawn_at_the_border() {
    let folder = Folder::new();
    let picture = |gaze: &str| {
        let text = GOOD
            .replace("kind = \"rates\"", "kind = \"density\"")
            .replace("[view]", &format!("[view]\ngazes = [{gaze}]"));
        folder.write("e.toml", text);
        folder.run(&["curves", "e.toml"]).ok();
        fs::read_to_string(folder.path("reports/good/plots/density.svg")).unwrap()
    };
    assert!(picture("[3000, 400]") == picture("[1440, 400]"));
}

#[test]
fn the_example_of_the_docs_is_right() {
    let folder = Folder::new();
    let docs = fs::read_to_string(root().join("docs/curves.md")).unwrap();
    let (_, example) = docs.split_once("```toml\n").unwrap();
    folder.write("e.toml", example.split_once("```").unwrap().0);
    let plan = folder.run(&["check", "e.toml"]).ok().stdout;
    assert!(plan.contains("13 curves") && plan.contains("2 figures, 1 table"), "{plan}");
}

#[test]
fn files_and_experiments_are_told_apart() {
    let folder = Folder::new();
    folder.write("e.toml", GOOD);
    folder.run(&["run", "e.toml"]).fails(2, &["this is a curve file", "fovqa curves"]);
    folder.run(&["curves", "e.toml"]).ok();
    let report = folder.run(&["report", "reports/good"]);
    report.fails(3, &["the folder contains curves", "fovqa curves"]);
    // One page over all.
    folder.write("f.toml", GOOD.replace("\"good\"", "\"fine\""));
    folder.run(&["curves", "e.toml", "f.toml", "--output", "all"]).ok();
    folder.run(&["report", "all"]).ok().says(&["2 folders of results"]);
    let page = fs::read_to_string(folder.path("all/index.html")).unwrap();
    assert!(page.contains("good/plots/rates.svg") && page.contains("fine/index.html"));
    folder.run(&["curves", "e.toml", "e.toml"]).fails(2, &["have the same name", "\"good\""]);
    // One wrong file, and nothing is drawn.
    folder.write("g.toml", GOOD.replace("\"good\"", "\"g\"").replace("rmfr", "x"));
    folder.run(&["curves", "f.toml", "g.toml", "--output", "none"]).fails(2, &["no method \"x\""]);
    assert!(!folder.path("none/fine").exists());
    // A folder of somebody else's stays as it is.
    folder.write("mine/curves.csv", "mine");
    folder
        .run(&["curves", "e.toml", "--output", "mine"])
        .fails(3, &["that no run of fovqa has written"]);
    assert_eq!(fs::read_to_string(folder.path("mine/curves.csv")).unwrap(), "mine");
    // What is drawn no longer is taken away.
    let other = GOOD.replace("kind = \"rates\"", "kind = \"density\"");
    folder.write("e.toml", other);
    folder.run(&["curves", "e.toml"]).ok();
    assert!(!folder.path("reports/good/plots/rates.svg").exists());
    assert!(folder.path("reports/good/plots/density.svg").exists());
    // Without plots and tables all that fit.
    folder.write("e.toml", GOOD.replace("[[plot]]\nkind = \"rates\"", ""));
    folder.run(&["curves", "e.toml"]).ok();
    for name in ["plots/rates.svg", "plots/density.svg", "table-samples.md", "table-acuity.csv"] {
        assert!(folder.path(&format!("reports/good/{name}")).exists(), "{name}");
    }
}

/// Neither takes away what the other has left.
#[test]
fn runs_and_curves_keep_each_others_folders() {
    let folder = Folder::with_pair();
    let run = "name = \"good\"\n[[scene]]\nname = \"s\"\nreference = \"a.png\"\n[[method]]\nname = \"m\"\ntest = \"b.png\"\n[metrics]\npsnr = {}\n";
    folder.write("run.toml", run);
    folder.write("curves.toml", GOOD);
    folder.run(&["run", "run.toml"]).ok();
    let before = files(&folder.path("reports/good"));
    let refused = folder.run(&["curves", "curves.toml"]);
    refused.fails(3, &["the folder contains the results of `fovqa run`", "--output"]);
    assert_eq!(files(&folder.path("reports/good")), before);
    folder.run(&["curves", "curves.toml", "--output", "c"]).ok();
    let before = files(&folder.path("c"));
    let refused = folder.run(&["run", "run.toml", "--output", "c"]);
    refused.fails(3, &["the folder contains the results of `fovqa curves`"]);
    assert_eq!(files(&folder.path("c")), before);
}

#[test]
fn what_differs_decides_what_is_drawn_and_how_often() {
    let folder = Folder::new();
    let many = |gazes: usize| {
        let gazes: Vec<String> = (0..gazes).map(|i| format!("[{i}, 0]")).collect();
        GOOD.replace(
            "[[curve]]\nname = \"A\"",
            &format!("gazes = [{}]\n[[curve]]\nname = \"A\"", gazes.join(", ")),
        )
    };
    folder.write("e.toml", many(49));
    folder
        .run(&["check", "e.toml"])
        .fails(2, &["the figure has 49 panels, but at most 48", "panels = \"one\""]);
    folder.write(
        "e.toml",
        many(49).replace("kind = \"rates\"", "kind = \"rates\"\npanels = \"one\""),
    );
    folder.run(&["check", "e.toml"]).ok();
    folder.write("e.toml", many(49).replace("[[plot]]\nkind = \"rates\"", ""));
    folder.run(&["check", "e.toml"]).fails(2, &["panels, but at most 48"]);
    folder.write("e.toml", many(101));
    folder.run(&["check", "e.toml"]).fails(2, &["a list of 1 to 100 values"]);

    // A direction is no other picture, and what is written twice no other curve.
    let twice = GOOD
        .replace(
            "resolutions = [\"1440x1600\"]",
            "resolutions = [\"1440x1600\", \"1440x1600\"]\ndirections_deg = [0, 90, 90]",
        )
        .replace("kind = \"rates\"", "kind = \"density\"\n[[table]]\nkind = \"acuity\"")
        .replace(
            "name = \"good\"",
            "name = \"good\"\nacuity = { model = \"piecewise\", cap_cpd = 18 }",
        )
        .replace(
            "name = \"A\"\nmethod = { model = \"rmfr\" }",
            "name = \"<b>VP\"\nmethod = { model = \"visual-polar\" }",
        );
    folder.write("e.toml", twice);
    folder.run(&["curves", "e.toml"]).ok();
    let record = json(&folder, "reports/good/curves.json");
    assert_eq!(record["curves"].as_array().unwrap().len(), 3);
    assert_eq!(record["acuity_parameters"], "cap_cpd=18");
    assert!(record["text"].as_str().unwrap().contains("[[curve]]"));
    let density = fs::read_to_string(folder.path("reports/good/plots/density.csv")).unwrap();
    assert_eq!(density.lines().count(), 1 + 240 * 216);
    let table = fs::read_to_string(folder.path("reports/good/table-acuity.md")).unwrap();
    assert!(table.contains("cap_cpd=18") || table.contains("cap\\_cpd=18"), "{table}");
    let row = table.lines().find(|line| line.contains("VP")).unwrap();
    assert!(row.contains("\\<b\\>VP (reconstruction)"), "{row}");
}

/// A budget is of all that a frame costs, and so are share and speed-up.
#[test]
fn a_wide_frame_costs_what_lies_beyond_too() {
    let folder = Folder::new();
    let text = "name = \"w\"\n[view]\nfov_vertical_deg = 110\nresolutions = [\"2560x1440\"]\n[[curve]]\nname = \"VaFR\"\nmethod = { model = \"vafr\" }\nbudget = 0.15\n[[table]]\nkind = \"speed_up\"\n";
    folder.write("w.toml", text);
    folder.run(&["curves", "w.toml"]).ok();
    let shading = &json(&folder, "reports/w/curves.json")["curves"][0]["shading"];
    let of = |key: &str| shading[key].as_f64().unwrap();
    assert!(of("samples_beyond") > 1e4);
    let pixels = 2560.0 * 1440.0;
    assert!(((of("samples") + of("samples_beyond")) / pixels - 0.15).abs() < 1e-9);
    assert!((of("share") - 0.15).abs() < 1e-9 && (of("speed_up") - 1.0 / 0.15).abs() < 1e-6);
    assert!(of("samples_on_screen") < of("samples") + of("samples_beyond"));
    let table = fs::read_to_string(folder.path("reports/w/table-speed-up.md")).unwrap();
    assert!(table.contains("| 15.0 % | 6.67 |") && table.contains("Beyond"), "{table}");
}

/// Every file of curves that belongs to the repository.
#[test]
fn the_committed_curves_are_drawn() {
    let folder = Folder::new();
    let configs = root().join("configs");
    let mut paths: Vec<String> = Vec::new();
    for inner in ["papers", "curves"] {
        for entry in fs::read_dir(configs.join(inner)).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            if text.contains("[[scene]]") {
                continue;
            }
            assert!(schema_allows(&text), "{name}");
            assert!(text.contains(&format!("name = \"{name}\"")), "{name} is named after its file");
            paths.push(path.to_str().unwrap().to_owned());
        }
    }
    assert!(paths.len() >= 16, "{paths:?}");
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    folder.run(&[&["curves"], paths.as_slice(), &["--output", "out"]].concat()).ok();
    for path in &paths {
        let name = Path::new(path).file_stem().unwrap().to_str().unwrap();
        let drawn = files(&folder.path(&format!("out/{name}")));
        let drawn_at_all = |file: &String| file.starts_with("plots/") || file.starts_with("table-");
        assert!(drawn.keys().any(drawn_at_all), "{name}");
    }
    folder.run(&["report", "out"]).ok();
    let page = fs::read_to_string(folder.path("out/index.html")).unwrap();
    for path in &paths {
        let name = Path::new(path).file_stem().unwrap().to_str().unwrap();
        assert!(page.contains(&format!("{name}/index.html")), "{name}");
    }
}

/// The README's pictures come out again.
#[test]
fn the_committed_pictures_come_out_again() {
    let folder = Folder::new();
    let headset = root().join("configs/curves/headset.toml");
    folder.run(&["curves", headset.to_str().unwrap(), "--output", "out"]).ok();
    for name in ["rates.png", "density.png"] {
        let committed = fs::read(root().join("docs/headset").join(name)).unwrap();
        let drawn = fs::read(folder.path("out/plots").join(name)).unwrap();
        assert!(
            drawn == committed,
            "{name}: fovqa curves configs/curves/headset.toml, and copy it"
        );
    }
}
