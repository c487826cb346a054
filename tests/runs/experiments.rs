//! Running experiments: scenes, methods, eyes, and what is in the results.

use std::collections::BTreeMap;
use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::{Folder, root};
use crate::runs::experiment_folder::{HEAD, experiment, json, rows, two_scenes};

#[test]
fn an_experiment_finds_what_score_finds() {
    let folder = two_scenes();
    let run = folder.run(&["run", "e.toml"]).ok().says(&["reports/e/report.html"]);
    assert!(run.stdout.contains("PSNR (dB) ↑"), "{}", run.stdout);
    let rows = rows(&folder, "reports/e");
    let order: Vec<(&str, &str)> =
        rows.iter().map(|row| (row["scene"].as_str(), row["method"].as_str())).collect();
    let mut comparisons = order.clone();
    comparisons.dedup();
    assert_eq!(comparisons, [("room", "A"), ("room", "B"), ("hall", "A"), ("hall", "B")]);
    for (scene, method) in comparisons {
        let (reference, test) =
            (format!("{scene}/gt"), format!("{scene}/{}", method.to_lowercase()));
        let score = folder.json(&[
            &reference,
            &test,
            "--fov-vertical",
            "60",
            "--metrics",
            "mse,psnr,ssim,fpsnr",
        ]);
        let mut values = 0;
        for row in rows.iter().filter(|r| r["scene"] == scene && r["method"] == method) {
            let frame = &score["frames"][row["frame"].parse::<usize>().unwrap()];
            if row["statistic"] == "map_pixels" {
                let edge = row["from_deg"].parse::<f64>().unwrap();
                let mut bands = frame["bands"].as_array().unwrap().iter();
                let band = bands.find(|band| band["from_deg"] == edge).unwrap();
                assert_eq!(row["value"], band["ssim_map_pixels"].to_string());
                continue;
            }
            let want = match row["from_deg"].parse::<f64>() {
                Err(_) => &frame["metrics"][&row["metric"]],
                Ok(from) => {
                    let bands = frame["bands"].as_array().unwrap();
                    &bands.iter().find(|b| b["from_deg"] == from).unwrap()[&row["metric"]]
                }
            };
            let found = row["value"].parse::<f64>().ok();
            assert_eq!(found, want.as_f64(), "{row:?}");
            assert_eq!((row["image"].as_str(), row["statistic"].as_str()), ("pair", ""));
            values += 1;
        }
        let bands = score["frames"][0]["bands"].as_array().unwrap().len();
        assert_eq!(values, 3 * (4 + 4 * bands));
        let summary = json(&folder, "reports/e/summary.json");
        let comparison = summary["comparisons"].as_array().unwrap().iter();
        let comparison =
            comparison.clone().find(|c| c["scene"] == scene && c["method"] == method).unwrap();
        assert_eq!(comparison["metrics"], score["summary"]);
        assert_eq!(comparison["bands"], score["summary_bands"]);
        assert_eq!(comparison["view"], score["view"]);
    }
}

#[test]
fn one_bad_input_costs_its_own_rows_alone() {
    let folder = two_scenes();
    folder.write("room/a/0001.png", "no picture");
    folder.png("hall/b/0002.png", 50, 40, &codes(50, 40, 3, 1));
    let run = folder.run(&["run", "e.toml"]).says(&[
        "room, A, frame 1: room/a/0001.png: this is not a PNG",
        "hall, B, frame 2: hall/gt/0002.png has 48x40 pixels, but hall/b/0002.png has 50x40",
        "2 errors, but 10 frames were scored",
    ]);
    assert_eq!(run.code, 3);
    let rows = rows(&folder, "reports/e");
    let errors: Vec<_> = rows.iter().filter(|row| row["metric"] == "error").collect();
    assert_eq!(errors.len(), 2);
    assert_eq!((errors[0]["scene"].as_str(), errors[0]["frame"].as_str()), ("room", "1"));
    assert_eq!(errors[0]["value"], "nan");
    let frames = |scene: &str, method: &str| {
        rows.iter()
            .filter(|r| {
                r["scene"] == scene
                    && r["method"] == method
                    && r["metric"] == "psnr"
                    && r["from_deg"].is_empty()
            })
            .count()
    };
    assert_eq!(
        [frames("room", "A"), frames("room", "B"), frames("hall", "A"), frames("hall", "B")],
        [2, 3, 3, 2]
    );
    let summary = json(&folder, "reports/e/summary.json");
    assert_eq!(summary["errors"][0]["message"].as_str().unwrap().find("room/a/0001.png"), Some(0));
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("Not scored"), "{page}");
}

#[test]
fn a_bad_reference_is_an_error_of_every_method() {
    let folder = two_scenes();
    folder.write("room/gt/0001.png", "no picture");
    let run = folder.run(&["run", "e.toml"]).says(&[
        "room, A, frame 1",
        "room, B, frame 1",
        "2 errors, but 10",
    ]);
    assert_eq!(run.code, 3);
}

#[test]
fn missing_inputs_are_said_and_the_rest_is_scored() {
    let folder = two_scenes();
    fs::remove_file(folder.path("room/a/0002.png")).unwrap();
    fs::remove_dir_all(folder.path("hall/b")).unwrap();
    let run = folder.run(&["run", "e.toml"]).says(&[
        "room, A: reference without a test frame: room/gt/0002.png",
        "allow_missing = true",
        "hall, B: hall/b: there is no such file or folder",
    ]);
    assert_eq!(run.code, 3);
    let rows = rows(&folder, "reports/e");
    let scored = |scene: &str, method: &str| {
        rows.iter()
            .any(|row| row["scene"] == scene && row["method"] == method && row["metric"] == "psnr")
    };
    assert!(
        scored("room", "A") && scored("room", "B") && scored("hall", "A") && !scored("hall", "B")
    );
    let errors = json(&folder, "reports/e/summary.json")["errors"].clone();
    let of: Vec<&str> =
        errors.as_array().unwrap().iter().map(|e| e["method"].as_str().unwrap()).collect();
    assert_eq!(of, ["A", "B"], "each of its own method");
    // Everything missing: errors alone, and nothing left of the results before.
    fs::remove_dir_all(folder.path("hall")).unwrap();
    fs::remove_dir_all(folder.path("room")).unwrap();
    folder
        .run(&["run", "e.toml"])
        .fails(3, &["room, A: room/gt: there is no such file", "4 errors, and nothing was scored"]);
    let rows = self::rows(&folder, "reports/e");
    assert!(rows.len() == 4 && rows.iter().all(|row| row["metric"] == "error"));
    assert!(!folder.path("reports/e/table.md").exists());
}

#[test]
fn scenes_override_what_is_general() {
    let folder = two_scenes();
    folder.write("gaze.csv", "frame,x_px,y_px\n0,4,4\n1,30,30\n2,nan,nan\n");
    let text = experiment("[signal]\nchannels = \"luma\"\n[metrics]\npsnr = {}\nfpsnr = {}\n")
        .replace(
            "name = \"room\"\n",
            "name = \"room\"\nfov_horizontal_deg = 90\ngaze = { trace = \"gaze.csv\" }\nchannels = \"rgb\"\nframes = \"1..\"\n",
        );
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok();
    let value = |scene: &str, frame: &str, metric: &str| {
        let rows = rows(&folder, "reports/e");
        let of = |row: &&BTreeMap<String, String>| {
            row["scene"] == scene
                && row["method"] == "A"
                && row["frame"] == frame
                && row["metric"] == metric
                && row["from_deg"].is_empty()
        };
        rows.iter().find(of).map(|row| row["value"].parse::<f64>().unwrap())
    };
    let room = folder.json(&[
        "room/gt",
        "room/a",
        "--fov-horizontal",
        "90",
        "--gaze",
        "gaze.csv",
        "--metrics",
        "psnr,fpsnr",
    ]);
    assert_eq!(value("room", "0", "psnr"), None);
    for frame in [1, 2] {
        for metric in ["psnr", "fpsnr"] {
            assert_eq!(
                value("room", &frame.to_string(), metric),
                room["frames"][frame]["metrics"][metric].as_f64()
            );
        }
    }
    let hall = folder.json(&[
        "hall/gt",
        "hall/a",
        "--fov-vertical",
        "60",
        "--channels",
        "luma",
        "--metrics",
        "psnr,fpsnr",
    ]);
    assert_eq!(value("hall", "0", "fpsnr"), hall["frames"][0]["metrics"]["fpsnr"].as_f64());
    // The command line picks among the frames the file picks.
    folder.run(&["run", "e.toml", "--frames", "0..2"]).ok();
    assert_eq!((value("room", "0", "psnr"), value("room", "2", "psnr")), (None, None));
    assert!(value("room", "1", "psnr").is_some() && value("hall", "0", "psnr").is_some());
}

#[test]
fn methods_are_scored_in_their_scenes_alone() {
    let folder = two_scenes();
    folder.write("e.toml", experiment("scenes = [\"hall\"]\n"));
    folder.run(&["run", "e.toml"]).ok();
    let rows = rows(&folder, "reports/e");
    assert!(!rows.iter().any(|row| row["scene"] == "room" && row["method"] == "B"));
    assert!(rows.iter().any(|row| row["scene"] == "hall" && row["method"] == "B"));
    let table = fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    assert!(!table.contains("Average"), "one common scene has no average:\n{table}");
}

/// Left and right of their own size of error, with a gaze each.
#[test]
fn two_eyes_are_scored_and_pooled() {
    let folder = Folder::new();
    for (seed, eye) in ["left", "right"].into_iter().enumerate() {
        let reference = codes(48, 40, 3, seed as u64);
        folder.png(&format!("gt_{eye}.png"), 48, 40, &reference);
        folder.png(
            &format!("a_{eye}.png"),
            48,
            40,
            &disturbed(&reference, 20.0 + 30.0 * seed as f64, 3),
        );
    }
    let text = |gaze: &str| {
        format!(
            "{HEAD}gaze = {gaze}\n[[scene]]\nname = \"s\"\nreference = {{ left = \"gt_left.png\", right = \"gt_right.png\" }}\n\
         [[method]]\nname = \"A\"\ntest = \"a_{{eye}}.png\"\n[metrics]\nmse = {{}}\npsnr = {{}}\nssim = {{}}\nfpsnr = {{}}\n"
        )
    };
    folder.write("e.toml", text("{ left = [0, 20], right = [47, 40] }"));
    folder.run(&["run", "e.toml"]).ok();
    let found = rows(&folder, "reports/e");
    let value = |eye: &str, metric: &str| {
        let row = found
            .iter()
            .find(|r| r["eye"] == eye && r["metric"] == metric && r["from_deg"].is_empty());
        row.unwrap()["value"].parse::<f64>().unwrap()
    };
    let eyes: Vec<&str> = found.iter().map(|row| row["eye"].as_str()).collect();
    assert!(eyes.is_sorted_by_key(|eye| ["left", "right", "both"].iter().position(|e| e == eye)));
    for (eye, gaze) in [("left", "0,20"), ("right", "47,40")] {
        let (reference, test) = (format!("gt_{eye}.png"), format!("a_{eye}.png"));
        let arguments = [&reference, &test, "--fov-vertical", "60", "--gaze", gaze];
        for metric in ["mse", "psnr", "ssim", "fpsnr"] {
            let alone = folder.metric(metric, &arguments);
            assert_eq!(value(eye, metric).to_bits(), alone.to_bits(), "{eye} {metric}");
        }
    }
    let mean = |metric: &str| f64::midpoint(value("left", metric), value("right", metric));
    assert!((value("both", "mse") - mean("mse")).abs() < 1e-15);
    assert!(
        (value("both", "psnr") + 10.0 * mean("mse").log10()).abs() < 1e-12,
        "of the pooled error"
    );
    assert!((value("both", "ssim") - mean("ssim")).abs() < 1e-15);
    // One list of bands, as far as either eye sees: here the right one looks into a corner.
    let last = |eye: &str| {
        let edges = found
            .iter()
            .filter(|r| r["eye"] == eye)
            .filter_map(|r| r["to_deg"].parse::<f64>().ok());
        edges.fold(0.0, f64::max)
    };
    let alone =
        folder.json(&["gt_right.png", "a_right.png", "--fov-vertical", "60", "--gaze", "47,40"]);
    let alone = alone["frames"][0]["bands"].as_array().unwrap().last().unwrap()["to_deg"].as_f64();
    assert_eq!([last("left"), last("right"), last("both")].map(Some), [alone; 3]);
    let summary = json(&folder, "reports/e/summary.json");
    assert_eq!(summary["comparisons"][1]["view"]["gaze_px"], serde_json::json!([47.0, 40.0]));
    assert_eq!(summary["comparisons"][2]["view"], serde_json::Value::Null, "two views are none");
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(
        page.contains("1 scene, 1 method, 2 frames scored"),
        "both are not counted again: {page}"
    );
    // The table and the figures are of both eyes.
    let table = fs::read_to_string(folder.path("reports/e/table.csv")).unwrap();
    assert!(table.contains(&format!("{:?}", value("both", "psnr"))), "{table}");
}

#[test]
fn names_may_be_anything_that_is_a_name() {
    let folder = two_scenes();
    let text = experiment("").replace("\"A\"", "\"A, \\\"quoted\\\" | <b> & *_`\"").replace(
        "name = \"room\"\nreference = \"room/gt\"",
        "name = \"Zimmer β: 1\"\nfolder = \"room\"\nreference = \"{folder}/gt\"",
    );
    folder.write("e.toml", text.replace("{scene}/", "{folder}/"));
    folder.run(&["run", "e.toml"]).ok();
    let name = "A, \"quoted\" | <b> & *_`";
    assert!(rows(&folder, "reports/e").iter().any(|row| row["method"] == name));
    let read = |file: &str| fs::read_to_string(folder.path(&format!("reports/e/{file}"))).unwrap();
    assert!(
        read("table.md").contains("A, \"quoted\" \\| \\<b\\> \\& \\*\\_\\`"),
        "{}",
        read("table.md")
    );
    assert!(
        read("table.tex")
            .contains("A, ''quoted'' \\textbar{} \\textless{}b\\textgreater{} \\& *\\_`")
    );
    assert!(read("report.html").contains("A, &#34;quoted&#34; | &#60;b&#62; &#38; *_`"));
    assert!(read("plots/bars-psnr.svg").contains("&lt;b&gt; &amp;"));
    assert!(folder.path("reports/e/plots/profile-psnr-zimmer-β-1.png").exists());
}

/// Numbers of single files tell the eyes apart, not frames; and what has no partner is said.
#[test]
fn frames_of_two_eyes_meet() {
    let folder = Folder::new();
    for (camera, eye) in ["left", "right"].into_iter().enumerate() {
        folder.png_pair(&format!("gt_cam{camera}.png"), &format!("a_cam{camera}.png"), 48, 40);
        for frame in camera..3 {
            folder.png_pair(
                &format!("gt/{eye}/{frame}.png"),
                &format!("a/{eye}/{frame}.png"),
                48,
                40,
            );
        }
    }
    folder.write(
        "e.toml",
        format!(
            "{HEAD}[[scene]]\nname = \"single\"\nreference = {{ left = \"gt_cam0.png\", right = \"gt_cam1.png\" }}\n\
             [[scene]]\nname = \"sequence\"\nreference = {{ left = \"gt/left\", right = \"gt/right\" }}\n\
             [[method]]\nname = \"A\"\nscenes = [\"single\"]\ntest = {{ left = \"a_cam0.png\", right = \"a_cam1.png\" }}\n\
             [[method]]\nname = \"B\"\nscenes = [\"sequence\"]\ntest = \"a/{{eye}}\"\n"
        ),
    );
    folder.run(&["run", "e.toml"]).ok().says(&[
        "sequence, B: left out of the results of both eyes: 1 frame of one eye without a partner",
    ]);
    let frames = |scene: &str| {
        let both = rows(&folder, "reports/e").into_iter();
        both.filter(|r| {
            r["scene"] == scene
                && r["eye"] == "both"
                && r["metric"] == "psnr"
                && r["from_deg"].is_empty()
        })
        .count()
    };
    assert_eq!((frames("single"), frames("sequence")), (1, 2));
}

#[test]
fn frames_that_are_not_asked_for_need_no_partner() {
    let folder = two_scenes();
    fs::remove_file(folder.path("room/a/0002.png")).unwrap();
    folder.write("e.toml", experiment("").replace("\"room/gt\"", "\"room/gt\"\nframes = \"0..2\""));
    folder.run(&["run", "e.toml"]).ok();
    folder.score(&["room/gt", "room/a", "--frames", "..2"]).ok();
    folder
        .score(&["room/gt", "room/a"])
        .fails(3, &["reference without a test frame: room/gt/0002.png"]);
}

#[test]
fn brackets_in_names_are_no_wildcards() {
    let folder = Folder::new();
    for method in ["a", "b"] {
        folder.png_pair("run[1]/s[2]/gt/0.png", &format!("run[1]/s[2]/{method}/0.png"), 48, 40);
    }
    let text =
        experiment("").replace("\"room\"", "\"s[2]\"").replace("room/gt", "{scene}/gt/*.png");
    let text = text
        .replace("/a\"", "/a/?.png\"")
        .replace("name = \"hall\"", "name = \"hall\"\nfolder = \"s[2]\"");
    folder.write("run[1]/e.toml", text.replace("{scene}", "{folder}"));
    folder.run(&["run", "run[1]/e.toml"]).ok();
    assert!(folder.path("reports/e/table.md").exists());
}

#[test]
fn committed_renders_are_scored() {
    let folder = Folder::new();
    let renders = root().join("configs/renders.toml");
    folder.run(&["run", renders.to_str().unwrap()]).ok();
    let summary = json(&folder, "reports/renders/summary.json");
    // Of the committed golden values (scikit-image), of the same pictures.
    let psnr = summary["comparisons"][0]["metrics"]["psnr"]["mean"].as_f64().unwrap();
    assert!((psnr - 28.651_635).abs() < 1e-4, "{psnr}");
}

#[test]
fn a_number_that_not_all_names_carry_is_no_frame_number() {
    let folder = two_scenes();
    let text = experiment("")
        .replace("\"room/gt\"", "\"room/gt/0002.png\"")
        .replace("{scene}/a", "{scene}/a/0002.png")
        .replace("{scene}/b", "{scene}/b/0001.png")
        .replace("\"{scene}/gt\"", "\"{scene}/gt/0002.png\"");
    folder.write("e.toml", &text);
    folder.run(&["run", "e.toml"]).ok();
    let frames = |method: &str| {
        let rows = rows(&folder, "reports/e");
        let mut frames: Vec<String> =
            rows.iter().filter(|r| r["method"] == method).map(|r| r["frame"].clone()).collect();
        frames.dedup();
        frames
    };
    assert_eq!((frames("A"), frames("B")), (vec!["2".to_owned()], vec!["0".to_owned()]));
    folder.write("e.toml", text.replace("b/0001", "b/0002"));
    folder.run(&["run", "e.toml"]).ok();
    assert_eq!(frames("B"), ["2"]);
}

#[test]
fn frames_stay_in_order_whichever_are_missing() {
    let folder = two_scenes();
    fs::remove_file(folder.path("room/a/0000.png")).unwrap();
    fs::remove_file(folder.path("room/b/0001.png")).unwrap();
    let text = experiment("").replace("\"room/gt\"", "\"room/gt\"\nallow_missing = true");
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml"]).ok().says(&["room: skipped frames without a partner: 2"]);
    let rows = rows(&folder, "reports/e");
    let frames = |method: &str| {
        let of = |row: &&BTreeMap<String, String>| {
            row["scene"] == "room" && row["method"] == method && row["metric"] == "psnr"
        };
        let mut frames: Vec<&str> = rows.iter().filter(of).map(|r| r["frame"].as_str()).collect();
        frames.dedup();
        frames
    };
    assert_eq!((frames("A"), frames("B")), (vec!["1", "2"], vec!["0", "2"]));
    let table = fs::read_to_string(folder.path("reports/e/table.md")).unwrap();
    assert!(table.contains("Average"), "{table}");
}
