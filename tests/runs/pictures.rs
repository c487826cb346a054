//! Pictures of chosen frames in the results folder: which, of what, and that no way to them gives
//! others.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use fovqa_frame::Samples;
use fovqa_io::{ReadOptions, read_frame};
use serde_json::Value;

use crate::fovqa::Folder;
use crate::runs::interrupted_runs::{assert_same, results};

/// Eight frames of the gallery, two methods, one of which filters over time.
fn sequence(frames: &str) -> String {
    of_length(8, frames)
}

fn of_length(length: usize, frames: &str) -> String {
    format!(
        "name = \"s\"\n[view]\ndisplay = \"htc-vive-pro\"\n[[scene]]\nname = \"walk\"\n\
         builtin = \"gallery\"\nresolution = \"72x80\"\nframes = {length}\nsamples = 1\n\
         [[method]]\nname = \"RMFR\"\nemulate = {{ model = \"rmfr\", jitter = \"halton\", temporal = true }}\n\
         [[method]]\nname = \"DEAMP\"\nemulate = {{ model = \"deamp\" }}\n\
         [metrics]\npsnr = {{}}\nssim = {{}}\nfvvdp = {{}}\n\
         [report]\nsize = 64\nframes = {frames}\n"
    )
}

fn run(folder: &Folder, text: &str, name: &str, more: &[&str]) {
    folder.write("s.toml", text);
    folder.run(&[&["run", "s.toml", "--output", name], more].concat()).ok();
}

fn list(folder: &Folder, name: &str) -> Value {
    let text = fs::read(folder.path(&format!("{name}/images/images.json"))).unwrap();
    serde_json::from_slice(&text).unwrap()
}

/// All files below a folder, by their paths in it.
fn files(root: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
                found.insert(name, fs::read(path).unwrap());
            }
        }
    }
    found
}

/// The PSNR of each frame by method, from the table of all values.
fn psnr(folder: &Folder, name: &str) -> BTreeMap<i64, Vec<f64>> {
    let mut of_frames: BTreeMap<i64, Vec<f64>> = BTreeMap::new();
    let mut rows = csv::Reader::from_path(folder.path(&format!("{name}/results.csv"))).unwrap();
    for row in rows.records().map(Result::unwrap) {
        if &row[6] == "psnr" && row[9].is_empty() && !row[4].is_empty() {
            of_frames.entry(row[4].parse().unwrap()).or_default().push(row[11].parse().unwrap());
        }
    }
    of_frames
}

#[test]
fn the_worst_and_the_median_frame_are_those_of_the_scores() {
    let folder = Folder::new();
    run(&folder, &sequence("[\"worst\", \"median\", \"first\", 5, 99]"), "out", &[]);
    let scores = psnr(&folder, "out");
    let lowest = |of: &[f64]| of.iter().copied().fold(f64::INFINITY, f64::min);
    let worst = scores.iter().min_by(|a, b| lowest(a.1).total_cmp(&lowest(b.1))).unwrap().0;
    let mut means: Vec<(f64, i64)> =
        scores.iter().map(|(frame, of)| (of.iter().sum::<f64>() / 2.0, *frame)).collect();
    means.sort_by(|a, b| a.0.total_cmp(&b.0));
    let view = &list(&folder, "out")["views"][0];
    assert_eq!(view["ranked_by"], "psnr");
    let chosen: BTreeMap<i64, Vec<String>> = view["frames"]
        .as_array()
        .unwrap()
        .iter()
        .map(|of| {
            let why = of["why"].as_array().unwrap().iter();
            let why = why.map(|word| word.as_str().map_or(word.to_string(), str::to_owned));
            (of["frame"].as_i64().unwrap(), why.collect())
        })
        .collect();
    let of = |word: &str| {
        let mut found = chosen.iter().filter(|(_, why)| why.iter().any(|w| w == word));
        found.next().map(|(frame, _)| *frame)
    };
    assert_eq!(of("worst"), Some(*worst));
    assert_eq!(of("median"), Some(means[3].1), "of eight frames, the worse one in the middle");
    assert_eq!((of("first"), of("5"), of("99")), (Some(0), Some(5), None));
    for frame in chosen.keys() {
        let test = format!("out/images/walk/{frame:04}/methods/DEAMP/test.png");
        assert!(folder.path(&test).is_file(), "{test}");
    }
}

#[test]
fn pictures_taken_after_scoring_are_those_taken_while_scoring() {
    let folder = Folder::new();
    // So many frames that they are not kept until the scores are known.
    run(&folder, &of_length(26, "[\"worst\", \"median\"]"), "after", &[]);
    let frames = list(&folder, "after")["views"][0]["frames"].clone();
    let numbers: Vec<String> =
        frames.as_array().unwrap().iter().map(|frame| frame["frame"].to_string()).collect();
    run(
        &folder,
        &of_length(26, &format!("[{}]", numbers.join(", "))),
        "while",
        &["--threads", "1"],
    );
    let [after, during] =
        ["after", "while"].map(|name| files(&folder.path(&format!("{name}/images/walk"))));
    assert!(after.len() >= 2 * (3 + 2 * 5), "{:?}", after.keys());
    assert_eq!(after.keys().collect::<Vec<_>>(), during.keys().collect::<Vec<_>>());
    for (name, bytes) in &after {
        assert!(during[name] == *bytes, "{name}");
    }
}

#[test]
fn a_picture_is_that_of_the_frame_and_its_map_that_of_the_scores() {
    let folder = Folder::with_pair();
    folder.write(
        "s.toml",
        "name = \"s\"\n[[scene]]\nname = \"a\"\nreference = \"a.png\"\n\
         [[method]]\nname = \"b\"\ntest = \"b.png\"\n[metrics]\nmse = {}\nssim = {}\n\
         [output]\nmaps = [\"ssim\"]\n",
    );
    folder.run(&["run", "s.toml", "--output", "out"]).ok();
    let codes = |path: &str| image::open(folder.path(path)).unwrap().to_rgb8().into_raw();
    assert_eq!(codes("out/images/a/0000/reference.png"), codes("a.png"));
    assert_eq!(codes("out/images/a/0000/methods/b/test.png"), codes("b.png"));
    assert!(folder.path("out/images/a/0000/methods/b/mse.png").is_file());
    // A crop shows what is scored.
    let text = fs::read_to_string(folder.path("s.toml")).unwrap();
    folder.write("s.toml", text + "[signal]\ncrop = [8, 4, 32, 30]\n");
    folder.run(&["run", "s.toml", "--output", "part"]).ok();
    let whole = image::open(folder.path("b.png")).unwrap().to_rgb8();
    let part = image::imageops::crop_imm(&whole, 8, 4, 32, 30).to_image().into_raw();
    assert_eq!(codes("part/images/a/0000/methods/b/test.png"), part);
    // The maps of every frame are those that were asked for.
    let maps = files(&folder.path("out/maps/a/b"));
    assert_eq!(maps.keys().collect::<Vec<_>>(), ["ssim-0000.exr", "ssim-0000.png"]);
}

#[test]
fn a_lost_picture_is_taken_again_and_those_of_other_frames_go() {
    let folder = Folder::new();
    run(&folder, &sequence("[\"worst\", 2]"), "out", &[]);
    let before = files(&folder.path("out/images"));
    fs::remove_file(folder.path("out/images/walk/0002/methods/RMFR/ssim.png")).unwrap();
    fs::write(folder.path("out/images/walk/note.txt"), "mine").unwrap();
    folder.run(&["run", "s.toml", "--output", "out", "--resume"]).ok().says(&["finished"]);
    let mut after = files(&folder.path("out/images"));
    assert_eq!(after.remove("walk/note.txt").as_deref(), Some(&b"mine"[..]));
    assert!(before == after);
    run(&folder, &sequence("[2]"), "out", &["--resume"]);
    let names = files(&folder.path("out/images/walk"));
    assert!(names.keys().all(|name| name.starts_with("0002/") || name == "note.txt"));
}

#[test]
fn no_frames_no_pictures() {
    let folder = Folder::new();
    run(&folder, &sequence("[1]"), "out", &[]);
    assert!(folder.path("out/images/images.json").is_file());
    run(&folder, &sequence("[]"), "out", &[]);
    assert!(!folder.path("out/images/images.json").exists());
    assert!(!folder.path("out").join("images").join("walk").exists());
}

#[test]
fn a_damaged_list_of_pictures_costs_the_viewer_alone() {
    let folder = Folder::new();
    run(&folder, &sequence("[1]"), "out", &[]);
    let before = fs::read(folder.path("out/report.html")).unwrap();
    let list = fs::read(folder.path("out/images/images.json")).unwrap();
    folder.write("out/images/images.json", &list[..list.len() / 2]);
    let words = ["images.json", "the page has no viewer", "--resume"];
    folder.run(&["report", "out"]).ok().says(&words);
    let page = fs::read_to_string(folder.path("out/report.html")).unwrap();
    assert!(!page.contains("viewer-data") && page.contains("id=\"conditions\""));
    run(&folder, &sequence("[1]"), "out", &["--resume"]);
    assert!(fs::read(folder.path("out/report.html")).unwrap() == before);
}

#[test]
fn shards_bring_their_pictures_and_the_others_are_named() {
    let folder = Folder::new();
    folder.write("s.toml", of_length(26, "[\"first\", \"worst\", 6]"));
    for shard in ["1", "2"] {
        let (part, output) = (format!("{shard}/2"), format!("part-{shard}"));
        folder.run(&["run", "s.toml", "--shard", &part, "--output", &output]).ok();
    }
    let merged = folder.run(&["merge", "part-1", "part-2", "--output", "out"]).ok();
    let whole = folder.run(&["run", "s.toml", "--output", "whole"]).ok();
    assert!(!whole.stderr.contains("missing"));
    let chosen = list(&folder, "whole");
    assert_eq!(list(&folder, "out"), chosen);
    let known = files(&folder.path("out/images"));
    let all = files(&folder.path("whole/images"));
    assert!(known.iter().all(|(name, bytes)| all[name] == *bytes));
    assert!(known.contains_key("walk/0006/methods/RMFR/test.png"));
    let is_complete = known.len() == all.len();
    assert_eq!(merged.stderr.contains("are missing"), !is_complete, "{}", merged.stderr);
    folder.run(&["run", "s.toml", "--output", "out", "--resume"]).ok();
    assert!(files(&folder.path("out/images")) == all);
    // With the frames, all are taken at once.
    let merge = |experiment: &str| {
        let shards = ["merge", "part-1", "part-2", "--output", "with", "--experiment"];
        folder.run(&[&shards[..], &[experiment]].concat())
    };
    let said = merge("s.toml").ok().stderr;
    assert!(!said.contains("missing"), "{said}");
    assert_same(&results(&folder.path("with")), &results(&folder.path("whole")), "with frames");
    folder.write("t.toml", of_length(26, "[\"first\"]"));
    merge("t.toml").fails(3, &["t.toml", "the shards belong to another experiment"]);
    merge("nowhere.toml").fails(2, &["nowhere.toml"]);
}

#[test]
fn mistakes_in_settings_of_pictures_are_underlined() {
    let cases: [(&str, &[&str]); 6] = [
        ("[report]\nframes = [\"last\"]\n", &["last", "\"first\", \"worst\", \"median\""]),
        ("[report]\nframes = [3, 3]\n", &["appears twice"]),
        ("[report]\nmetric = \"haar\"\n", &["haar has no score of a single frame", "fpsnr"]),
        ("[report]\nmetric = \"gmsd\"\n", &["gmsd ranks frames, but is not scored", "gmsd = {}"]),
        ("[report]\nsize = 20\n", &["64 to 4096"]),
        ("[output]\nmaps = [\"ms_ssim\", \"gmsd\"]\n", &["ms_ssim has no map", "not scored"]),
    ];
    let folder = Folder::with_pair();
    for (keys, words) in cases {
        let text = format!(
            "name = \"s\"\n[[scene]]\nname = \"a\"\nreference = \"a.png\"\n\
             [[method]]\nname = \"b\"\ntest = \"b.png\"\n[metrics]\nmse = {{}}\nms_ssim = {{}}\n{keys}"
        );
        folder.write("s.toml", text);
        folder.run(&["check", "s.toml"]).fails(2, words);
    }
}

/// The data of the viewer on a page.
fn viewer(folder: &Folder, name: &str) -> Value {
    let page = fs::read_to_string(folder.path(&format!("{name}/report.html"))).unwrap();
    let data = page.split("id=\"viewer-data\">").nth(1).unwrap();
    serde_json::from_str(data.split("</script>").next().unwrap()).unwrap()
}

#[test]
fn the_page_holds_the_pictures_maps_and_scores_of_the_files() {
    let folder = Folder::new();
    let maps = "[output]\nmaps = [\"ssim\"]\n";
    run(&folder, &(sequence("[3]") + maps), "out", &[]);
    let data = viewer(&folder, "out");
    let eye = &data["scenes"][0]["eyes"][0];
    assert_eq!(eye["methods"], serde_json::json!(["RMFR", "DEAMP"]));
    assert_eq!(eye["sequence"]["frames"].as_array().unwrap().len(), 8);
    let frame = &eye["frames"][0];
    assert_eq!((&frame["frame"], &frame["why"]), (&3.into(), &serde_json::json!([3])));
    let test = &frame["tests"][1];
    let source = test["src"].as_str().unwrap().strip_prefix("data:image/webp;base64,").unwrap();
    let small = folder.path("out/images/walk/0003/methods/DEAMP/page.webp");
    assert!(BASE64_STANDARD.decode(source).unwrap() == fs::read(small).unwrap());
    assert_eq!(test["full"], "images/walk/0003/methods/DEAMP/test.png");
    assert_eq!(test["borders"].as_array().unwrap().len(), 2, "three layers have two borders");

    // 80 pixels, 64 on the page, 16 blocks: 5 pixels a block.
    let map = test["maps"].as_array().unwrap().iter().find(|map| map["map"] == "ssim").unwrap();
    assert_eq!((&map["block"], &map["columns"], &map["rows"]), (&5.into(), &15.into(), &16.into()));
    let deflated = BASE64_STANDARD.decode(map["values"].as_str().unwrap()).unwrap();
    let mut bytes = Vec::new();
    flate2::read::DeflateDecoder::new(deflated.as_slice()).read_to_end(&mut bytes).unwrap();
    let file = folder.path("out/maps/walk/DEAMP/ssim-0003.exr");
    let frame = read_frame(&file, &ReadOptions::default()).unwrap().frame;
    let Samples::F32(values) = frame.samples() else { panic!("32-bit floats") };
    for (column, row) in [(0, 0), (7, 8), (14, 15)] {
        let places = (row * 5..(row * 5 + 5).min(80))
            .flat_map(|y| (column * 5..(column * 5 + 5).min(72)).map(move |x| y * 72 + x));
        let known: Vec<f64> =
            places.map(|at| f64::from(values[at])).filter(|value| !value.is_nan()).collect();
        let at = 2 * (row * 15 + column);
        let half = half::f16::from_le_bytes([bytes[at], bytes[at + 1]]).to_f64();
        if known.is_empty() {
            assert!(half.is_nan());
            continue;
        }
        let mean = known.iter().sum::<f64>() / known.len() as f64;
        assert!((half - mean).abs() <= mean.abs() / 2048.0, "{column},{row}: {half} {mean}");
    }

    let mut rows = csv::Reader::from_path(folder.path("out/results.csv")).unwrap();
    let mut compared = 0;
    for row in rows.records().map(Result::unwrap) {
        if &row[1] != "DEAMP" || &row[4] != "3" || &row[6] != "psnr" || &row[5] != "pair" {
            continue;
        }
        let value: f64 = row[11].parse().unwrap();
        let found = if row[9].is_empty() {
            test["scores"]["psnr"].as_f64()
        } else {
            let from: f64 = row[9].parse().unwrap();
            let edges = eye["bands_deg"].as_array().unwrap();
            let band = edges.iter().position(|edge| edge.as_f64() == Some(from)).unwrap();
            test["bands"][band]["psnr"].as_f64()
        };
        assert!((found.unwrap() - value).abs() <= 1e-6 * value, "{row:?}");
        compared += 1;
    }
    assert!(compared > 5, "{compared}");
    // Drawing again needs no frames, and gives the same page.
    let before = fs::read(folder.path("out/report.html")).unwrap();
    fs::remove_file(folder.path("s.toml")).unwrap();
    folder.run(&["report", "out"]).ok();
    assert!(fs::read(folder.path("out/report.html")).unwrap() == before);
    fs::remove_file(folder.path("out/images/walk/0003/methods/DEAMP/page.webp")).unwrap();
    folder.run(&["report", "out"]).ok().says(&["pictures of walk, frame 3", "--resume"]);
}

#[test]
fn of_a_sweep_the_best_point_is_shown() {
    let folder = Folder::new();
    let text = "name = \"s\"\n[view]\nfov_vertical_deg = 90\n[[scene]]\nname = \"hall\"\n\
                builtin = \"gallery\"\nresolution = \"72x80\"\nframes = 1\nsamples = 1\n\
                [[method]]\nname = \"RMFR\"\nemulate = { model = \"rmfr\" }\n\
                [[method]]\nname = \"CPS\"\nemulate = { model = \"cps\" }\n\
                [metrics]\npsnr = {}\n[sweep]\n\"RMFR.sigma\" = [3.0, 1.4, 2.2]\n[report]\nsize = 64\n";
    run(&folder, text, "out", &[]);
    let methods = &viewer(&folder, "out")["scenes"][0]["eyes"][0]["methods"];
    assert_eq!(*methods, serde_json::json!(["RMFR (sigma=1.4)", "CPS"]));
}

#[test]
fn pictures_that_are_lost_cost_no_result() {
    let folder = Folder::new();
    folder.write("s.toml", of_length(26, "[\"worst\"]"));
    for shard in ["1", "2"] {
        let (part, output) = (format!("{shard}/2"), format!("part-{shard}"));
        folder.run(&["run", "s.toml", "--shard", &part, "--output", &output]).ok();
    }
    // No shard has taken any.
    let merge = ["merge", "part-1", "part-2", "--output", "out"];
    folder.run(&merge).ok().says(&["pictures of some frames", "--output out --resume"]);
    let results = fs::read(folder.path("out/results.csv")).unwrap();
    let again = ["run", "s.toml", "--output", "out", "--resume"];
    fs::remove_dir_all(folder.path("out").join("images")).unwrap();
    fs::write(folder.path("out").join("images"), "mine").unwrap();
    folder.run(&again).ok().says(&["the page lacks pictures", "--output out --resume"]);
    assert!(fs::read(folder.path("out/results.csv")).unwrap() == results);
    fs::remove_file(folder.path("out").join("images")).unwrap();
    folder.run(&again).ok();
    // One that was cut off is noticed, and taken again.
    let frame = list(&folder, "out")["views"][0]["frames"][0]["frame"].as_i64().unwrap();
    for picture in ["page.webp", "test.png"] {
        let path = folder.path(&format!("out/images/walk/{frame:04}/methods/DEAMP/{picture}"));
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..40]).unwrap();
        if picture == "page.webp" {
            folder.run(&["report", "out"]).ok().says(&["--output out --resume` takes them again"]);
        }
        folder.run(&again).ok();
        assert!(fs::read(&path).unwrap() == whole, "{picture}");
    }
}
