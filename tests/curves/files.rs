//! Files of curves: figures, tables, pages, and what is wrong with a file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::mistakes::GOOD;
use crate::fovqa::{Folder, Run, command, root};

/// Everything the format has, in one file.
pub(super) const RICH: &str = r#"
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
    assert!(page.contains("ahead &#38; aside") && page.contains("table-acuity.csv"));
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
    let lines: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    for (name, cells) in [
        ("GT", ["3686.4", "8294.4", "18662.4", "33177.6", "74649.6"]),
        ("LaFR, δ = 2.2", ["761.7", "1713.7", "3855.9", "6854.9", "15423.5"]),
        ("LaFR, δ = 1.8", ["1137.8", "2560.0", "5760.0", "10240.0", "23040.0"]),
        ("VaFR\\_Dup", ["1061.7", "1061.7", "1061.7", "1061.7", "1061.7"]),
        ("VaFR\\_Rep", ["637.0", "743.2", "849.4", "955.6", "1035.2"]),
    ] {
        let column = lines[0].iter().position(|head| *head == name).unwrap();
        let found: Vec<&str> = lines[2..].iter().map(|row| row[column]).collect();
        assert_eq!(found, cells, "{name}");
    }
    assert!(text.contains("not an independent check"), "VaFR_Rep says where its shares come from");
    let csv = fs::read_to_string(folder.path("out/table-samples.csv")).unwrap();
    assert!(csv.contains("samples VaFR_Dup") && csv.contains(",1061733.65"), "{csv}");
}

pub(super) fn schema_allows(text: &str) -> bool {
    let schema: Value = Run::from(command(&["schema", "curves"]).output().unwrap()).ok().json();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let file: Value = toml::from_str(text).unwrap();
    validator.is_valid(&file)
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

/// Methods across are the same numbers, and a method with another parameter at each resolution is
/// one column.
#[test]
fn methods_stand_across_where_they_are_wanted() {
    let folder = Folder::new();
    let text = |across: &str| {
        format!(
            "name = \"t\"\n[view]\nfov_vertical_deg = 110\nresolutions = [\"640x360\", \"1280x720\"]\n\
             [[curve]]\nname = \"GT\"\nmethod = {{ model = \"full\" }}\n\
             [[curve]]\nname = \"KFR, a\"\nmethod = {{ model = \"kfr\", sigma = 2 }}\nresolutions = [\"640x360\"]\n\
             [[curve]]\nname = \"KFR, b\"\nmethod = {{ model = \"kfr\", sigma = 4 }}\nresolutions = [\"1280x720\"]\n\
             [[table]]\nkind = \"samples\"\n{across}"
        )
    };
    folder.write("t.toml", text("across = \"methods\"\n"));
    folder.run(&["curves", "t.toml", "--output", "out"]).ok();
    let csv = fs::read_to_string(folder.path("out/table-samples.csv")).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "resolution,samples GT,load GT,samples KFR,load KFR");
    assert_eq!(lines[1], "640 × 360,230400.0,1.0,57600.0,0.25");
    assert_eq!(lines[2], "1280 × 720,921600.0,1.0,57600.0,0.0625");
    folder.write("t.toml", text("").replace("samples", "speed_up") + "across = \"methods\"\n");
    folder.run(&["check", "t.toml"]).fails(2, &["across only applies to kind = \"samples\""]);
}
