//! Reprojection: the other eye takes what it can from the frames of the dominant one.

use std::collections::BTreeMap;
use std::fs;

use fovqa_testkit::synthetic::codes;

use crate::fovqa::{Folder, root};
use crate::runs::experiment_folder::{bytes, json, rows};
use crate::runs::shards::divided;

const SCENE: &str =
    "builtin = \"gallery\"\nresolution = \"96x80\"\nframes = 4\nfps = 10\nsamples = 2\nipd_mm = 64";

/// Methods of a scene in an experiment.
fn experiment(scene: &str, methods: &[(&str, &str)]) -> String {
    let method = |(name, emulate): &(&str, &str)| {
        format!("[[method]]\nname = \"{name}\"\nemulate = {{ {emulate} }}\n")
    };
    let methods = methods.iter().map(method).collect::<Vec<_>>().concat();
    format!(
        "name = \"e\"\n[view]\nfov_vertical_deg = 90\nbands_deg = [0, 30]\n[[scene]]\nname = \"s\"\n{scene}\n\
         {methods}[metrics]\npsnr = {{}}\natd = {{}}\n[[plot]]\nkind = \"table\"\n"
    )
}

/// The values of a metric for a method and an eye, frame by frame.
fn values(folder: &Folder, results: &str, [method, eye, metric]: [&str; 3]) -> Vec<f64> {
    let is_it = |row: &&BTreeMap<String, String>| {
        row["method"] == method
            && row["eye"] == eye
            && row["metric"] == metric
            && row["from_deg"].is_empty()
            && row["image"] != "reference"
    };
    let rows = rows(folder, results);
    rows.iter().filter(is_it).map(|row| row["value"].parse().unwrap()).collect()
}

#[test]
fn the_other_eye_shades_only_what_the_dominant_one_does_not_see() {
    let folder = Folder::new();
    let methods = [
        ("full", "model = \"full\", sampling = \"area\""),
        ("full rep", "model = \"full\", sampling = \"area\", reproject = {}"),
        ("V", "model = \"vafr\", factor = 0.1"),
        ("V rep", "model = \"vafr\", factor = 0.1, reproject = { ipd_mm = 64 }"),
        ("V left", "model = \"vafr\", factor = 0.1, reproject = {}, dominant = \"left\""),
    ];
    folder.write("e.toml", experiment(SCENE, &methods));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let of = |method, eye, metric| values(&folder, "out", [method, eye, metric]);
    for (method, eye, dominant) in
        [("V rep", "left", "right"), ("V left", "right", "left"), ("full rep", "left", "right")]
    {
        let shares = of(method, eye, "reshaded_share");
        assert!(shares.len() == 4 && shares.iter().all(|s| (0.01..0.2).contains(s)), "{shares:?}");
        assert!(of(method, dominant, "reshaded_share").is_empty());
        assert!(of(method, "both", "reshaded_share").is_empty());
        // The dominant eye is as it was.
        let plain = if method == "full rep" { "full" } else { "V" };
        for metric in ["psnr", "samples", "samples_on_screen"] {
            assert_eq!(of(method, dominant, metric), of(plain, dominant, metric));
        }
        for metric in ["samples", "samples_share", "samples_beyond"] {
            let (own, all) = (of(method, eye, metric), of(plain, eye, metric));
            for ((own, all), share) in own.iter().zip(&all).zip(&shares) {
                assert!((own - share * all).abs() <= 1e-9 * all, "{metric}: {own} {all} {share}");
            }
        }
        let samples = of(method, eye, "samples");
        assert_eq!(of(method, eye, "samples_on_screen"), samples, "they are on pixels");
        let sums = samples.iter().zip(of(method, dominant, "samples")).map(|(a, b)| a + b);
        assert_eq!(of(method, "both", "samples"), sums.collect::<Vec<_>>());
    }
    // What is taken from the right place is what the eye would see there.
    let psnr = |method| of(method, "left", "psnr").iter().sum::<f64>() / 4.0;
    assert!(psnr("full rep") > 20.0, "{}", psnr("full rep"));
    assert!(psnr("V rep") > psnr("V") - 2.0, "{} {}", psnr("V rep"), psnr("V"));
    let summary = json(&folder, "out/summary.json");
    let comparisons = summary["comparisons"].as_array().unwrap();
    let rep: Vec<_> = comparisons.iter().filter(|c| c["method"] == "V rep").collect();
    let mean = of("V rep", "left", "reshaded_share").iter().sum::<f64>() / 4.0;
    let found = rep[0]["samples"]["reshaded_share"].as_f64().unwrap();
    assert!((found - mean).abs() < 1e-12 && rep[0]["eye"] == "left");
    assert!(rep[1..].iter().all(|c| c["samples"].get("reshaded_share").is_none()));
    let eyes = &json(&folder, "out/run.json")["resolved"]["scenes"][0]["eyes"];
    let keys = serde_json::json!({ "ipd_mm": 64.0, "depth_m": 1.0, "dominant": "right" });
    assert_eq!(eyes[0]["emulations"]["V rep"]["reproject"], keys);
    assert!(eyes[1]["emulations"]["V rep"].get("reproject").is_none());
}

/// The dominant eye's frames, and its history, are emulated again wherever a run is divided.
#[test]
fn division_threads_and_resuming_do_not_matter() {
    let folder = Folder::new();
    let methods = [
        (
            "T",
            "model = \"rmfr\", jitter = \"halton\", temporal = true, keep_frames = true, reproject = {}, \
             other_eye = { sigma = 4 }",
        ),
        ("D", "model = \"cps\", temporal = true, reproject = {}, other_eye = { temporal = false }"),
        ("K", "model = \"kfr\", reproject = {}"),
    ];
    folder.write("e.toml", experiment(SCENE, &methods));
    folder.run(&["run", "e.toml", "--output", "one", "--threads", "1"]).ok();
    folder.run(&["run", "e.toml", "--output", "two", "--threads", "2"]).ok();
    assert_eq!(bytes(&folder.path("one")), bytes(&folder.path("two")));
    for of in [24, 5, 2] {
        assert_eq!(divided(&folder, of, 0), vec![0; of]);
    }
    let whole = bytes(&folder.path("whole"));
    let kept: Vec<_> = whole.keys().filter(|name| name.starts_with("emulated/")).collect();
    assert_eq!(kept.len(), 8, "{kept:?}");
    // A run that is broken off in the middle of the left eye.
    let journal = fs::read_to_string(folder.path("whole/journal.jsonl")).unwrap();
    let lines: Vec<&str> = journal.split_inclusive('\n').collect();
    for left in [4, 8, lines.len() / 2] {
        fs::write(folder.path("whole/journal.jsonl"), lines[..left].concat()).unwrap();
        folder.run(&["run", "e.toml", "--output", "whole", "--resume"]).ok();
        assert_eq!(bytes(&folder.path("whole")), whole, "{left}");
    }
}

/// The temporal filter of the dominant eye alone: no metric, and no filter of the other eye, needs the frames
/// before.
#[test]
fn the_history_of_the_dominant_eye_goes_on_wherever_a_run_is_divided() {
    let folder = Folder::new();
    let methods = [(
        "D",
        "model = \"cps\", temporal = true, reproject = {}, other_eye = { temporal = false }",
    )];
    folder.write("e.toml", experiment(SCENE, &methods).replace("atd = {}\n", ""));
    for of in [8, 3] {
        assert_eq!(divided(&folder, of, 0), vec![0; of]);
    }
}

const VIEW: [&str; 4] = ["--resolution", "96x80", "--fov-vertical", "90"];

/// Files of the two eyes, and the scene of an experiment that reads them.
fn files(folder: &Folder) -> String {
    let gallery = ["gallery", "--output", "eyes", "--eye", "both", "--frames", "3"];
    folder.run(&[&gallery[..], &VIEW].concat()).ok();
    "reference = { left = \"eyes/left/exr\", right = \"eyes/right/exr\" }\n\
     gaze = { left = { trace = \"eyes/left/gaze.csv\" }, right = { trace = \"eyes/right/gaze.csv\" } }"
        .to_owned()
}

/// Depth of files is that of the scene, in any unit.
#[test]
fn files_share_what_the_scene_shares() {
    let folder = Folder::new();
    let scene = files(&folder);
    let method = |reproject: &str| {
        [("V", format!("model = \"vafr\", factor = 0.1, reproject = {{ {reproject} }}"))]
    };
    let (mut shares, mut psnr) = (Vec::new(), Vec::new());
    for (scene, reproject) in [
        (&*scene, ""),
        ("builtin = \"gallery\"\nresolution = \"96x80\"\nframes = 3\nsamples = 2\nipd_mm = 63", ""),
        (&*scene, "ipd_mm = 31.5, depth_m = 0.5"),
        (&*scene, "ipd_mm = 0.001"),
        (&*scene, "ipd_mm = 600"),
    ] {
        let method = method(reproject);
        let methods: Vec<(&str, &str)> = method.iter().map(|(n, e)| (*n, &**e)).collect();
        folder.write("e.toml", experiment(scene, &methods));
        folder.run(&["run", "e.toml", "--output", "out"]).ok();
        shares.push(values(&folder, "out", ["V", "left", "reshaded_share"]));
        psnr.push(values(&folder, "out", ["V", "left", "psnr"])[0]);
    }
    assert_eq!(shares[0].len(), 3);
    for (file, drawn) in shares[0].iter().zip(&shares[1]) {
        assert!((file - drawn).abs() < 1e-3, "{shares:?}");
    }
    assert_eq!(shares[0], shares[2], "half as far in units twice as short");
    // With another distance, what is at the same place has more often another depth.
    let more = |share: f64, than: f64, factor: f64| share > factor * than;
    assert!(more(shares[3][0], shares[0][0], 1.05), "{shares:?}");
    assert!(more(shares[4][0], shares[0][0], 2.0), "{shares:?}");
    // And what is taken is not what is there.
    assert!(psnr[0] > psnr[3] + 1.0 && psnr[0] > psnr[4] + 4.0, "{psnr:?}");
    // The files of the dominant eye are inputs of the other one.
    fs::write(folder.path("eyes/right/exr/0001.exr"), "no picture").unwrap();
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    let errors = json(&folder, "out/summary.json")["errors"].as_array().unwrap().clone();
    let eyes: Vec<_> = errors.iter().map(|e| (e["eye"].clone(), e["frame"].clone())).collect();
    assert_eq!(eyes, [("left".into(), 1.into()), ("right".into(), 1.into())]);
    fs::remove_file(folder.path("eyes/right/exr/0001.exr")).unwrap();
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    run.says(&["frame 1 has no right eye, from which it would be reprojected"]);
}

#[test]
fn files_without_depth_are_refused() {
    let folder = Folder::new();
    let scene = files(&folder);
    for eye in ["left", "right"] {
        let (from, to) = (format!("eyes/{eye}/exr"), format!("flat/{eye}/exr"));
        fs::create_dir_all(folder.path(&to)).unwrap();
        folder.run(&["foveate", &from, &to, "--method", "full"]).ok();
    }
    let scene =
        scene.replace("eyes/left/exr", "flat/left/exr").replace("eyes/right/exr", "flat/right/exr");
    folder.write("e.toml", experiment(&scene, &[("V", "model = \"rmfr\", reproject = {}")]));
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    run.says(&["has no depth, which reproject compares between both eyes"]);
}

#[test]
fn mistakes_are_shown_in_their_place() {
    let folder = Folder::new();
    for (seed, eye) in ["left", "right"].into_iter().enumerate() {
        folder.png(&format!("{eye}.png"), 96, 80, &codes(96, 80, 3, seed as u64));
    }
    let one = SCENE.replace("\nipd_mm = 64", "");
    let exr = "reference = { left = \"l.exr\", right = \"r.exr\" }";
    let pattern = SCENE.replace("gallery", "pattern-a");
    for (scene, emulate, said) in [
        (SCENE, "reproject = true", "reproject cannot be"),
        (SCENE, "reproject = { ipd = 63 }", "did you mean ipd_mm?"),
        (SCENE, "reproject = { ipd_mm = 0 }", "ipd_mm cannot be 0"),
        (SCENE, "reproject = { depth_m = -1 }", "depth_m cannot be -1"),
        (SCENE, "reproject = { ipd_mm = 63 }", "\"s\" are 64 mm apart"),
        (SCENE, "reproject = { depth_m = 0.01 }", "is in metres"),
        (SCENE, "other_eye = { reproject = {} }", "no parameter `reproject`"),
        (SCENE, "reprojected_share = 0.4, reproject = {}", "a share that is assumed"),
        (&one, "reproject = {}", "scene \"s\" has one image per frame"),
        ("reference = \"left.png\"", "reproject = {}", "scene \"s\" has one image per frame"),
        (&pattern, "reproject = {}", "pattern_a, is flat"),
        (
            "reference = { left = \"left.png\", right = \"right.png\" }",
            "reproject = {}",
            "the left eye of scene \"s\" has no depth: files that end in .png",
        ),
        (
            &format!("{exr}\nright = {{ depth = \"none\" }}"),
            "reproject = {}",
            "the right eye of scene \"s\" has no depth",
        ),
    ] {
        folder
            .write("e.toml", experiment(scene, &[("M", &format!("model = \"vafr\", {emulate}"))]));
        folder.run(&["run", "e.toml", "--output", "out"]).fails(2, &[said]);
    }
    let no_view = experiment(exr, &[("M", "model = \"rmfr\", reproject = {}")]);
    let no_view = no_view.replace("fov_vertical_deg = 90\nbands_deg = [0, 30]\n", "");
    folder.write("e.toml", no_view);
    folder.run(&["run", "e.toml", "--output", "out"]).fails(2, &["scene \"s\" has no view"]);
    // FovVideoVDP that begins with later frames needs them alone.
    let ahead = experiment(SCENE, &[("M", "model = \"rmfr\", reproject = {}")])
        .replace("fov_vertical_deg = 90", "fov_vertical_deg = 90\nluminance = \"htc-vive-pro\"")
        .replace("psnr = {}", "fvvdp = { temp_padding = \"circular\" }");
    folder.write("e.toml", ahead);
    folder
        .run(&["run", "e.toml", "--output", "out"])
        .fails(2, &["needs the frames of both eyes in their order"]);
}

/// The table of docs/emulation.md, with an eighth of the pixels along each axis.
#[test]
fn the_experiment_of_the_documentation_runs() {
    let folder = Folder::new();
    let mut text = fs::read_to_string(root().join("configs/reproject.toml")).unwrap();
    for size in ["1440x1600", "1440x1700", "2560x1440", "3840x2160"] {
        let (width, height) = size.split_once('x').unwrap();
        let eighth = |side: &str| side.parse::<usize>().unwrap() / 8;
        let resolution = format!("resolution = \"{size}\"");
        assert!(text.contains(&resolution), "{size}");
        let small = format!("resolution = \"{}x{}\"", eighth(width), eighth(height));
        text = text.replace(&resolution, &small);
    }
    folder.write("e.toml", text.replace("model = \"vafr\"", "model = \"vafr\", factor = 0.1"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let shares = rows(&folder, "out").into_iter().filter(|row| row["metric"] == "reshaded_share");
    let shares: Vec<f64> = shares.map(|row| row["value"].parse().unwrap()).collect();
    assert_eq!(shares.len(), 4 * 4);
    assert!(shares.iter().all(|share| (0.01..0.2).contains(share)), "{shares:?}");
}
