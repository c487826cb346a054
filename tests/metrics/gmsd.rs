//! GMSD through the command: golden values, results in every form, bands and frames put together, eyes, masks.

use std::fs;
use std::path::Path;

use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::{Folder, Run, command, root, shared};
use crate::runs::experiment_folder::rows;

/// Largest deviation from NumPy.
const TOLERANCE: f64 = 1e-6;

fn number(value: &Value) -> Option<f64> {
    (!value.is_null()).then(|| value.as_f64().unwrap())
}

/// Holds whole frames and bands to the values of an independent implementation.
fn check(golden: &Path, pictures: &Path) {
    let cases: Value = serde_json::from_str(&fs::read_to_string(golden).unwrap()).unwrap();
    let cases = cases.as_array().unwrap();
    assert!(!cases.is_empty());
    for case in cases {
        let file = |key: &str| pictures.join(case[key].as_str().unwrap()).display().to_string();
        let list = |value: &Value| {
            let numbers = value.as_array().unwrap().iter().map(Value::to_string);
            numbers.collect::<Vec<_>>().join(",")
        };
        let (reference, test) = (file("reference"), file("test"));
        let (fov, bands) = (case["vfov_deg"].to_string(), list(&case["bands_deg"]));
        let mut arguments =
            vec!["score", &reference, &test, "--metrics", "gmsd", "--format", "json"];
        arguments.extend(["--fov-vertical", &fov, "--bands", &bands]);
        let gaze = (!case["gaze"].is_null()).then(|| list(&case["gaze"]));
        if let Some(gaze) = &gaze {
            arguments.extend(["--gaze", gaze]);
        }
        let frame =
            Run::from(command(&arguments).output().unwrap()).ok().json()["frames"][0].clone();
        let near = |what: &str, found: &Value, wanted: &Value| {
            let (found, wanted) = (number(found), number(wanted));
            let alike = match (found, wanted) {
                (Some(found), Some(wanted)) => (found - wanted).abs() <= TOLERANCE,
                (found, wanted) => found == wanted,
            };
            assert!(alike, "{} {what}: {found:?} for {wanted:?}", case["id"]);
        };
        near("whole", &frame["metrics"]["gmsd"], &case["gmsd"]);
        let wanted = case["bands"].as_array().unwrap();
        assert_eq!(frame["bands"].as_array().unwrap().len(), wanted.len());
        for (band, wanted) in frame["bands"].as_array().unwrap().iter().zip(wanted) {
            near("band", &band["gmsd"], &wanted["gmsd"]);
            assert_eq!(band["gmsd_map_pixels"], wanted["pixels"], "{}", case["id"]);
        }
    }
}

#[test]
fn committed_renders() {
    let data = root().join("tests/data/small/living-room");
    check(&root().join("tests/golden/small/gmsd.json"), &data);
}

#[test]
fn photographs() {
    if let (Some(golden), Some(pictures)) = (shared("golden/gmsd"), shared("golden/classic")) {
        check(&golden.join("golden.json"), &pictures);
    }
}

const SIZE: (usize, usize) = (96, 80);

/// Three frames, each with more noise than the one before.
fn sequence() -> Folder {
    let folder = Folder::new();
    for frame in 0..3 {
        let reference = codes(SIZE.0, SIZE.1, 3, frame);
        folder.png(&format!("gt/{frame}.png"), SIZE.0, SIZE.1, &reference);
        let test = disturbed(&reference, 10.0 + 20.0 * frame as f64, 3);
        folder.png(&format!("test/{frame}.png"), SIZE.0, SIZE.1, &test);
    }
    folder
}

const VIEW: [&str; 4] = ["--fov-vertical", "80", "--bands", "0,10,30,90"];

/// N, mean and deviation of some values put together.
fn together(parts: &[(f64, f64, f64)]) -> f64 {
    let count: f64 = parts.iter().map(|(n, ..)| n).sum();
    let mean = parts.iter().map(|(n, mean, _)| n * mean).sum::<f64>() / count;
    let squared = |(n, of, deviation): &(f64, f64, f64)| {
        (n - 1.0) * deviation * deviation + n * (of - mean) * (of - mean)
    };
    (parts.iter().map(squared).sum::<f64>() / (count - 1.0)).sqrt()
}

fn part(band: &Value) -> (f64, f64, f64) {
    let value = |key: &str| band[key].as_f64().unwrap();
    (value("gmsd_map_pixels"), value("gmsd_map_mean"), value("gmsd"))
}

#[test]
fn bands_and_frames_are_put_together_without_loss() {
    let folder = sequence();
    let json = folder.json(&[&["gt", "test", "--metrics", "gmsd"][..], &VIEW].concat());
    let frames = json["frames"].as_array().unwrap();
    let mut all = Vec::new();
    for frame in frames {
        let parts: Vec<_> = frame["bands"].as_array().unwrap().iter().map(part).collect();
        let whole = frame["metrics"]["gmsd"].as_f64().unwrap();
        assert!((together(&parts) - whole).abs() < 1e-9, "the bands cover the frame");
        all.extend(parts);
    }
    let summary = &json["summary"]["gmsd"];
    assert!((summary["gmsd_pooled"].as_f64().unwrap() - together(&all)).abs() < 1e-9);
    let mean = frames.iter().map(|f| f["metrics"]["gmsd"].as_f64().unwrap()).sum::<f64>() / 3.0;
    assert!((summary["mean"].as_f64().unwrap() - mean).abs() < 1e-12);
    assert!((frames[0]["metrics"]["gmsd_map_mean"].as_f64().unwrap() - 1.0).abs() < 0.5);
    // Two bands, and all their frames, by results alone.
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 80\nbands_deg = [0, 10, 30, 90]\n\
         [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
         [metrics]\ngmsd = {}\n\
         [[gate]]\nmetric = \"gmsd\"\nband_deg = [0, 30]\naggregate = \"max\"\nat_most = 0.5\n\
         [[gate]]\nmetric = \"gmsd\"\nband_deg = [0, 30]\nstatistic = \"pooled\"\nat_most = 0.5\n\
         [[gate]]\nmetric = \"gmsd\"\nstatistic = \"pooled\"\nat_most = 0.5\n",
    );
    let verdict = folder.run(&["gate", "e.toml", "--format", "json"]).ok().json();
    let value = |rule: usize| verdict["rules"][rule]["checks"][0]["value"].as_f64().unwrap();
    let inner = |frame: &Value| [part(&frame["bands"][0]), part(&frame["bands"][1])];
    let largest = frames.iter().map(|f| together(&inner(f))).reduce(f64::max).unwrap();
    assert!((value(0) - largest).abs() < 1e-9, "{} for {largest}", value(0));
    let pooled = together(&frames.iter().flat_map(inner).collect::<Vec<_>>());
    assert!((value(1) - pooled).abs() < 1e-9, "{} for {pooled}", value(1));
    assert!((value(2) - together(&all)).abs() < 1e-9);
    let found = rows(&folder, "reports/e");
    let of = |statistic: &str| found.iter().filter(|row| row["statistic"] == statistic).count();
    assert_eq!((of("map_pixels"), of("map_mean")), (9, 12));
}

/// A band of one block has no deviation, and yet the block counts where bands are put together.
#[test]
fn a_band_of_one_block_counts_among_others() {
    let folder = sequence();
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 80\nbands_deg = [0, 1.5, 90]\n\
         gaze = [41.0, 41.0]\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n\
         [[method]]\nname = \"m\"\ntest = \"test\"\n[metrics]\ngmsd = {}\n\
         [[gate]]\nmetric = \"gmsd\"\nband_deg = [0, 90]\naggregate = \"max\"\nat_most = 0.5\n\
         [[gate]]\nmetric = \"gmsd\"\naggregate = \"max\"\nat_most = 0.5\n",
    );
    let verdict = folder.run(&["gate", "e.toml", "--format", "json"]).ok().json();
    let value = |rule: usize| verdict["rules"][rule]["checks"][0]["value"].as_f64().unwrap();
    assert!((value(0) - value(1)).abs() < 1e-9, "{} for {}", value(0), value(1));
    let found = rows(&folder, "reports/e");
    let inner =
        found.iter().find(|row| row["statistic"] == "map_pixels" && row["from_deg"] == "0.0");
    assert_eq!(inner.unwrap()["value"], "1");
    // Without it, how the bands weigh would be guessed. Versions that left it out had no checksums either.
    let path = folder.path("reports/e/run.json");
    let mut record: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    record.as_object_mut().unwrap().remove("files");
    fs::write(&path, record.to_string()).unwrap();
    let csv = fs::read_to_string(folder.path("reports/e/results.csv")).unwrap();
    let without: Vec<&str> = csv.lines().filter(|line| !line.contains("map_pixels")).collect();
    folder.write("reports/e/results.csv", without.join("\n") + "\n");
    let run = folder.run(&["gate", "reports/e"]);
    let why = "the results do not say how many pixels of each band";
    assert!(run.code == 3 && run.stdout.contains(why), "{}{}", run.stdout, run.stderr);
    let mut lines: Vec<&str> = csv.lines().collect();
    lines.remove(lines.iter().position(|line| line.contains("map_pixels")).unwrap());
    folder.write("reports/e/results.csv", lines.join("\n") + "\n");
    folder.run(&["gate", "reports/e"]).fails(3, &["its values of gmsd of s, m differ"]);
    let last = csv.lines().last().unwrap();
    folder.write("reports/e/results.csv", format!("{csv}{last}\n"));
    folder.run(&["gate", "reports/e"]).fails(3, &["a row of gmsd of s, m appears twice"]);
}

/// The same picture in every type of file, whatever the channels of other metrics.
#[test]
fn every_kind_of_picture() {
    let folder = sequence();
    let wanted = folder.metric("gmsd", &["gt/1.png", "test/1.png"]);
    let luma = folder.metric("gmsd", &["gt/1.png", "test/1.png", "--channels", "luma"]);
    assert!((luma - wanted).abs() < 1e-12);
    let light = |name: &str, codes: &[u8]| {
        let channel = |c: usize| {
            let codes = codes.iter().skip(c).step_by(3).map(|code| f64::from(*code) / 255.0);
            Values::Float(
                codes.map(|code| fovqa_frame::transfer::srgb::decode(code) as f32).collect(),
            )
        };
        let part = Part::new(SIZE, &[("R", channel(0)), ("G", channel(1)), ("B", channel(2))]);
        File::new(vec![part]).write(&folder.path(name));
    };
    let reference = codes(SIZE.0, SIZE.1, 3, 1);
    light("a.exr", &reference);
    light("b.exr", &disturbed(&reference, 30.0, 3));
    let linear = folder.metric("gmsd", &["a.exr", "b.exr"]);
    assert!((linear - wanted).abs() < 1e-5, "{linear} for {wanted}");
    let gray = |codes: &[u8]| codes.iter().step_by(3).flat_map(|c| [*c; 3]).collect::<Vec<u8>>();
    folder.png("g.png", SIZE.0, SIZE.1, &gray(&reference));
    folder.png("h.png", SIZE.0, SIZE.1, &gray(&disturbed(&reference, 30.0, 3)));
    let one: Vec<u8> = reference.iter().step_by(3).copied().collect();
    folder.png("i.png", SIZE.0, SIZE.1, &one);
    let [rgb, mixed] = ["g.png", "i.png"].map(|name| folder.metric("gmsd", &[name, "h.png"]));
    assert!((rgb - mixed).abs() < 1e-7, "{mixed} for {rgb}");
}

#[test]
fn both_eyes_are_one_set_of_blocks() {
    let folder = Folder::new();
    for (seed, eye) in ["left", "right"].into_iter().enumerate() {
        let size = (SIZE.0 + 20 * seed, SIZE.1);
        let reference = codes(size.0, size.1, 3, seed as u64);
        folder.png(&format!("{eye}.png"), size.0, size.1, &reference);
        let test = disturbed(&reference, 20.0 + 30.0 * seed as f64, 3);
        folder.png(&format!("{eye}-m.png"), size.0, size.1, &test);
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 80\nbands_deg = [0, 90]\n[[scene]]\nname = \"s\"\n\
         reference = { left = \"left.png\", right = \"right.png\" }\n\
         [[method]]\nname = \"m\"\ntest = \"{eye}-m.png\"\n[metrics]\ngmsd = {}\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    let found = rows(&folder, "reports/e");
    let value = |eye: &str, statistic: &str, banded: bool| -> f64 {
        let of = |row: &&_| {
            let row: &std::collections::BTreeMap<String, String> = row;
            let whole = row["from_deg"].is_empty();
            row["eye"] == eye
                && row["metric"] == "gmsd"
                && row["statistic"] == statistic
                && whole != banded
        };
        found.iter().find(of).unwrap()["value"].parse().unwrap()
    };
    let part = |eye: &str| {
        let of = |statistic: &str| value(eye, statistic, true);
        (of("map_pixels"), of("map_mean"), of(""))
    };
    let wanted = together(&[part("left"), part("right")]);
    assert!((value("both", "", false) - wanted).abs() < 1e-9);
    assert!((value("both", "", true) - wanted).abs() < 1e-9);
    let ((n, left, _), (m, right, _)) = (part("left"), part("right"));
    assert!(n + 100.0 < m, "the eyes differ in size");
    assert!((part("both").1 - (n * left + m * right) / (n + m)).abs() < 1e-12);
}

#[test]
fn the_awkward_cases() {
    let folder = sequence();
    let gt = "gt/0.png";
    assert!(folder.metric("gmsd", &[gt, gt]).abs() < 1e-300, "identical");
    folder.png_pair("small-a.png", "small-b.png", 3, 30);
    let run = folder.score(&["small-a.png", "small-b.png", "--metrics", "gmsd"]);
    run.fails(3, &["GMSD needs 4 pixels on each side; the frame has 3x30"]);
    // What a mask leaves out is in no number, and a map is of blocks.
    let mask = |i: usize| if i % SIZE.0 < 48 { [255; 3] } else { [0; 3] };
    let mask: Vec<u8> = (0..SIZE.0 * SIZE.1).flat_map(mask).collect();
    folder.png("mask.png", SIZE.0, SIZE.1, &mask);
    let mut other = codes(SIZE.0, SIZE.1, 3, 2);
    let test = disturbed(&other, 50.0, 3);
    for (i, code) in other.iter_mut().enumerate() {
        if i / 3 % SIZE.0 < 48 {
            *code = test[i];
        }
    }
    folder.png("half.png", SIZE.0, SIZE.1, &other);
    let masked = ["half.png", "test/2.png", "--mask", "mask.png", "--maps", "maps"];
    assert!(folder.metric("gmsd", &masked).abs() < 1e-300, "it differs where nothing counts alone");
    let options = fovqa_io::ReadOptions::default();
    let map = fovqa_io::read_frame(&folder.path("maps/gmsd-0000.exr"), &options).unwrap().frame;
    assert_eq!((map.width(), map.height()), (SIZE.0 / 2, SIZE.1 / 2));
    assert!(map.sample(0, 22, 5) > 0.999 && map.sample(0, 23, 5).is_nan());
    assert!(folder.path("maps/gmsd-0000.png").exists());
    let nothing: Vec<u8> =
        (0..SIZE.0 * SIZE.1).flat_map(|i| [u8::from(i % 4 > 0) * 255; 3]).collect();
    folder.png("nothing.png", SIZE.0, SIZE.1, &nothing);
    let masked = [gt, "test/0.png", "--metrics", "gmsd", "--mask", "nothing.png"];
    folder
        .score(&masked)
        .fails(3, &["the mask leaves fewer than two complete blocks of 2x2 pixels for GMSD"]);
}
