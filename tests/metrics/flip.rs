//! FLIP, HDR-FLIP and FWQI through the command: bands, frames, eyes, gates, masks, errors.

use std::fs;

use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::rows;

const SIZE: (usize, usize) = (192, 180);

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

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Linear pictures over several magnitudes.
fn light(folder: &Folder, name: &str, seed: u64, scale: f32) {
    let codes = codes(SIZE.0, SIZE.1, 3, seed);
    let channel = |c: usize| {
        let values = codes.iter().skip(c).step_by(3);
        Values::Float(values.map(|code| (f32::from(*code) / 32.0 - 4.0).exp2() * scale).collect())
    };
    let part = Part::new(SIZE, &[("R", channel(0)), ("G", channel(1)), ("B", channel(2))]);
    File::new(vec![part]).write(&folder.path(name));
}

const VIEW: [&str; 4] = ["--fov-vertical", "60", "--bands", "0,10,20,90"];

#[test]
fn bands_are_parts_of_the_frame_and_frames_of_the_sequence() {
    let folder = sequence();
    let json = folder.json(&[&["gt", "test", "--metrics", "flip,fwqi"][..], &VIEW].concat());
    let frames = json["frames"].as_array().unwrap();
    for frame in frames {
        let whole = number(&frame["metrics"]["flip"]);
        let bands = frame["bands"].as_array().unwrap();
        let pixels = |band: &Value| number(&band["pixels"]);
        let sum = bands.iter().map(|band| pixels(band) * number(&band["flip"])).sum::<f64>();
        assert!((sum / bands.iter().map(pixels).sum::<f64>() - whole).abs() < 1e-9);
        let of = |statistic: &str| number(&frame["metrics"][format!("flip_{statistic}")]);
        assert!((of("ppd") - 2.72).abs() < 0.05, "that of the view");
        assert!(of("min") < of("q1") && of("q1") < of("weighted_median"));
        assert!(of("weighted_median") < of("q3") && of("q3") < of("max") && of("max") < 1.0);
    }
    // So near to the screen, the eye sees less away from the gaze than the screen shows.
    let near = folder.json(&["gt/2.png", "test/2.png", "--metrics", "flip", "--fov-vertical", "4"]);
    let metrics = &near["frames"][0]["metrics"];
    assert!((number(&metrics["fflip"]) - number(&metrics["flip"])).abs() > 1e-6, "{metrics}");
    for metric in ["flip", "fwqi"] {
        let values = frames.iter().map(|frame| number(&frame["metrics"][metric]));
        let mean = values.sum::<f64>() / 3.0;
        assert!((number(&json["summary"][metric]["mean"]) - mean).abs() < 1e-12, "{metric}");
    }
    // Without a view, FLIP says once for which screen it is computed.
    let run = folder.score(&["gt", "test", "--metrics", "flip"]).ok();
    assert_eq!(run.stderr.matches("67.02 pixels per degree").count(), 1, "{}", run.stderr);
    assert!(
        !folder
            .score(&["gt", "test", "--metrics", "flip", "--set", "flip.ppd=40"])
            .stderr
            .contains("67.02")
    );
}

#[test]
fn gates_and_results_have_every_statistic() {
    let folder = sequence();
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\nbands_deg = [0, 10, 20, 90]\n\
         [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
         [metrics]\nflip = {}\nfwqi = {}\n\
         [[gate]]\nmetric = \"flip\"\nband_deg = [0, 20]\nat_most = 0.9\n\
         [[gate]]\nmetric = \"flip\"\nstatistic = \"fflip\"\nat_most = 0.9\n\
         [[gate]]\nmetric = \"flip\"\nstatistic = \"weighted_median\"\naggregate = \"max\"\nat_most = 0.9\n\
         [[gate]]\nmetric = \"fwqi\"\naggregate = \"min\"\nat_least = 0.01\n",
    );
    let verdict = folder.run(&["gate", "e.toml", "--format", "json"]).ok().json();
    let value = |rule: usize| number(&verdict["rules"][rule]["checks"][0]["value"]);
    let json = folder.json(&[&["gt", "test", "--metrics", "flip,fwqi"][..], &VIEW].concat());
    let frames = json["frames"].as_array().unwrap();
    let inner = |frame: &Value| {
        let [a, b] = [&frame["bands"][0], &frame["bands"][1]];
        let of = |band: &Value| (number(&band["pixels"]), number(&band["flip"]));
        let ((n, a), (m, b)) = (of(a), of(b));
        (n * a + m * b) / (n + m)
    };
    let mean = |of: &dyn Fn(&Value) -> f64| frames.iter().map(of).sum::<f64>() / 3.0;
    assert!((value(0) - mean(&inner)).abs() < 1e-9, "{}", value(0));
    assert!((value(1) - mean(&|frame| number(&frame["metrics"]["fflip"]))).abs() < 1e-9);
    let most = frames.iter().map(|frame| number(&frame["metrics"]["flip_weighted_median"]));
    assert!((value(2) - most.fold(0.0, f64::max)).abs() < 1e-9);
    let least = frames.iter().map(|frame| number(&frame["metrics"]["fwqi"]));
    assert!((value(3) - least.fold(1.0, f64::min)).abs() < 1e-9);
    let found = rows(&folder, "reports/e");
    let of = |metric: &str, statistic: &str| {
        let is = |row: &&_| {
            let row: &std::collections::BTreeMap<String, String> = row;
            row["metric"] == metric && row["statistic"] == statistic
        };
        found.iter().filter(is).count()
    };
    assert_eq!(
        (of("flip", ""), of("flip", "q3"), of("flip", "fflip"), of("fwqi", "")),
        (12, 3, 3, 3)
    );
    // FLIP ranks the frames of the page, because nothing else can.
    assert!(folder.path("reports/e/report.html").exists());
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    assert!(page.contains("FLIP") && page.contains("FWQI"));
}

#[test]
fn both_eyes_have_the_mean_or_the_extreme() {
    let folder = Folder::new();
    for (seed, eye) in ["left", "right"].into_iter().enumerate() {
        let reference = codes(SIZE.0, SIZE.1, 3, seed as u64);
        folder.png(&format!("{eye}.png"), SIZE.0, SIZE.1, &reference);
        let test = disturbed(&reference, 20.0 + 30.0 * seed as f64, 3);
        folder.png(&format!("{eye}-m.png"), SIZE.0, SIZE.1, &test);
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\nbands_deg = [0, 90]\n[[scene]]\nname = \"s\"\n\
         reference = { left = \"left.png\", right = \"right.png\" }\n\
         [[method]]\nname = \"m\"\ntest = \"{eye}-m.png\"\n[metrics]\nflip = {}\nfwqi = {}\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    let found = rows(&folder, "reports/e");
    for (metric, statistic) in [
        ("flip", ""),
        ("flip", "q1"),
        ("flip", "fflip"),
        ("fwqi", ""),
        ("flip", "flip_min"),
        ("flip", "flip_max"),
    ] {
        let value = |eye: &str| -> f64 {
            let is = |row: &&std::collections::BTreeMap<String, String>| {
                row["eye"] == eye
                    && row["metric"] == metric
                    && row["statistic"] == statistic
                    && row["from_deg"].is_empty()
            };
            found.iter().find(is).unwrap()["value"].parse().unwrap()
        };
        let (left, right) = (value("left"), value("right"));
        let wanted = match statistic {
            "flip_min" => left.min(right),
            "flip_max" => left.max(right),
            _ => f64::midpoint(left, right),
        };
        assert!((value("both") - wanted).abs() < 1e-12, "{metric} {statistic}");
    }
}

#[test]
fn hdr_flip_takes_linear_frames_alone_and_says_its_exposures() {
    let folder = sequence();
    for frame in 0..2 {
        light(&folder, &format!("a/{frame}.exr"), frame, 1.0);
        light(&folder, &format!("b/{frame}.exr"), frame, 1.25);
    }
    let arguments = ["a", "b", "--metrics", "hdr-flip,flip", "--set", "flip.ppd=30"];
    let json = folder.json(&arguments);
    let metrics = &json["frames"][0]["metrics"];
    let of = |statistic: &str| number(&metrics[format!("hdr_flip_{statistic}")]);
    assert!((of("exposures") - (of("stop") - of("start")).ceil()).abs() < 1e-9);
    assert!(number(&metrics["hdr_flip"]) > 0.01 && number(&metrics["flip"]) > 0.01);
    assert!(metrics["hdr_fflip"].is_null() && metrics["fflip"].is_null(), "no view");
    let given = [
        "--set",
        "hdr_flip.start=-2",
        "--set",
        "hdr_flip.stop=-2",
        "--set",
        "hdr_flip.tonemap=hable",
    ];
    let json = folder.json(&[&arguments[..], &given].concat());
    let metrics = &json["frames"][1]["metrics"];
    assert!((number(&metrics["hdr_flip_exposures"]) - 2.0).abs() < 1e-12);
    let exposed =
        folder.json(&[&arguments[..], &given, &["--exposure", "3", "--tonemap", "aces"]].concat());
    assert_eq!(exposed["frames"][1]["metrics"]["hdr_flip"], metrics["hdr_flip"]);
    assert_ne!(exposed["frames"][1]["metrics"]["flip"], metrics["flip"]);
    let run = folder.score(&["gt/0.png", "test/0.png", "--metrics", "hdr-flip"]);
    run.fails(3, &["gt/0.png: HDR-FLIP: the reference is not linear light", "use flip"]);
    let crossed = ["--set", "hdr_flip.start=1", "--set", "hdr_flip.stop=-2"];
    let run = folder.score(&[&arguments[..], &crossed].concat());
    run.fails(2, &["at most hdr_flip.stop, -2"]);
    let late = folder.score(&[&arguments[..], &["--set", "hdr_flip.start=90"]].concat());
    late.fails(3, &["a/0.exr", "90.00 stops, is above the last", "give both hdr_flip.start"]);
    let black = Part::new((8, 8), &[("Y", Values::Float(vec![0.0; 64]))]);
    File::new(vec![black]).write(&folder.path("black.exr"));
    let run = folder.score(&["black.exr", "black.exr", "--metrics", "hdr-flip"]);
    run.fails(3, &["half of the reference is black", "give hdr_flip.start and hdr_flip.stop"]);
    let run = folder.score(&["a", "b", "--metrics", "flip", "--transfer", "pq"]);
    run.fails(3, &["PQ codes", "use hdr_flip with linear frames"]);
    let keyhole = ["a", "b", "--metrics", "flip", "--fov-vertical", "0.001"];
    folder.score(&keyhole).fails(3, &["the view has 1.800e5 pixels per degree", "give flip.ppd"]);
    for wrong in ["flip.ppd=0", "flip.ppd=-3", "hdr_flip.exposures=1", "hdr_flip.tonemap=filmic"] {
        let run = folder.score(&["a", "b", "--metrics", "flip,hdr-flip", "--set", wrong]);
        assert_eq!(run.code, 2, "{wrong}: {}", run.stderr);
    }
}

#[test]
fn masks_leave_out_pixels_of_flip_and_are_refused_by_fwqi() {
    let folder = sequence();
    let mask = |i: usize| if i % SIZE.0 < 100 { [255; 3] } else { [0; 3] };
    let mask: Vec<u8> = (0..SIZE.0 * SIZE.1).flat_map(mask).collect();
    folder.png("mask.png", SIZE.0, SIZE.1, &mask);
    let mut half = codes(SIZE.0, SIZE.1, 3, 2);
    let other = disturbed(&half, 90.0, 3);
    for (i, code) in half.iter_mut().enumerate() {
        if i / 3 % SIZE.0 >= 100 {
            *code = other[i];
        }
    }
    folder.png("half.png", SIZE.0, SIZE.1, &half);
    let masked = ["gt/2.png", "half.png", "--mask", "mask.png", "--set", "flip.ppd=40"];
    assert!(folder.metric("flip", &masked).abs() < 1e-300, "it differs where nothing counts alone");
    let run = folder.score(&[
        "gt/2.png",
        "half.png",
        "--mask",
        "mask.png",
        "--metrics",
        "fwqi",
        "--fov-vertical",
        "60",
    ]);
    run.fails(3, &["FWQI is not defined where pixels are left out"]);
    folder.png_pair("small-a.png", "small-b.png", 200, 170);
    let run =
        folder.score(&["small-a.png", "small-b.png", "--metrics", "fwqi", "--fov-vertical", "60"]);
    run.fails(3, &["FWQI needs 176 pixels on each side; the frame has 200x170"]);
    let run = folder.score(&["gt", "test", "--metrics", "fwqi"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    // A black reference has no value, which JSON says.
    folder.png("black.png", SIZE.0, SIZE.1, &vec![0; 3 * SIZE.0 * SIZE.1]);
    let run = folder.score(&[
        "black.png",
        "gt/0.png",
        "--metrics",
        "fwqi,mse",
        "--fov-vertical",
        "60",
        "--format",
        "json",
    ]);
    let run = run.ok().says(&["FWQI has no value where the reference is black"]);
    assert!(run.json()["frames"][0]["metrics"]["fwqi"].is_null());
    assert!(run.json()["frames"][0]["metrics"].as_object().unwrap().contains_key("fwqi"));
}

/// The same bytes, maps included, for one thread and for several.
#[test]
fn threads_do_not_change_a_bit() {
    let folder = sequence();
    light(&folder, "a.exr", 1, 1.0);
    light(&folder, "b.exr", 1, 1.3);
    let of = |threads: &str, arguments: &[&str]| {
        let maps = format!("maps-{threads}");
        let more =
            ["--threads", threads, "--maps", &maps, "--format", "json", "--fov-vertical", "60"];
        let json = folder.score(&[arguments, &more].concat()).ok().stdout;
        (json, crate::runs::experiment_folder::bytes(&folder.path(&maps)))
    };
    for arguments in [
        &["gt/1.png", "test/1.png", "--metrics", "flip,fwqi"][..],
        &["a.exr", "b.exr", "--metrics", "hdr-flip,flip,fwqi"],
    ] {
        assert!(of("1", arguments) == of("3", arguments), "{arguments:?}");
    }
}

/// A frame without a score must not pass, and statistics of whole frames have no bands.
#[test]
fn gates_do_not_pass_over_what_has_no_value() {
    let folder = sequence();
    folder.png("gt/1.png", SIZE.0, SIZE.1, &vec![0; 3 * SIZE.0 * SIZE.1]);
    let experiment = |rule: &str| {
        format!(
            "name = \"e\"\n[view]\nfov_vertical_deg = 60\nbands_deg = [0, 10, 20, 90]\n\
             [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
             [metrics]\nflip = {{}}\nfwqi = {{}}\n[[gate]]\n{rule}\n"
        )
    };
    for more in ["", "per_frame = true\n"] {
        folder.write("e.toml", experiment(&format!("metric = \"fwqi\"\nat_least = 0.0\n{more}")));
        let run = folder.run(&["gate", "e.toml"]);
        assert_eq!(run.code, 3, "{}", run.stdout);
        assert!(run.stdout.contains("frame 1 has no value"), "{}", run.stdout);
    }
    let table =
        folder.score(&["gt/1.png", "test/1.png", "--metrics", "fwqi", "--fov-vertical", "60"]);
    assert!(table.ok().stdout.lines().any(|line| line.starts_with("FWQI") && line.ends_with('–')));
    for (rule, word) in [
        (
            "metric = \"flip\"\nstatistic = \"fflip\"\nband_deg = [0, 10]\nat_most = 1",
            "fflip of flip has no value per band",
        ),
        ("metric = \"flip\"\nstatistic = \"ppd\"\nat_most = 1", "flip has no statistic \"ppd\""),
    ] {
        folder.write("e.toml", experiment(rule));
        let run = folder.run(&["check", "e.toml"]);
        assert!(run.code == 2 && run.stderr.contains(word), "{}", run.stderr);
    }
    // The frame that fails is named by the statistic of the rule.
    let rule =
        "metric = \"flip\"\nstatistic = \"weighted_median\"\naggregate = \"max\"\nat_most = 0.01";
    folder.write("e.toml", experiment(rule));
    let run = folder.run(&["gate", "e.toml"]);
    assert!(run.code == 1 && run.stdout.contains(": flip weighted_median 0."), "{}", run.stdout);
}

/// The second map of HDR-FLIP is written, kept and shown like the first.
#[test]
fn the_map_of_exposures_is_everywhere() {
    let folder = Folder::new();
    light(&folder, "a/0.exr", 1, 1.0);
    light(&folder, "b/0.exr", 1, 1.3);
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\nreference = \"a\"\n\
         [[method]]\nname = \"m\"\ntest = \"b\"\n[metrics]\nhdr_flip = {}\n[output]\nmaps = [\"hdr_flip\"]\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    for file in ["hdr_flip-0000.exr", "hdr_flip-magma-0000.png", "hdr_flip_exposure-0000.exr"] {
        assert!(folder.path(&format!("reports/e/maps/s/m/{file}")).exists(), "{file}");
    }
    let page = fs::read_to_string(folder.path("reports/e/report.html")).unwrap();
    let shown = "\"hdr_flip_exposure\":{\"label\":\"Exposure of the largest HDR-FLIP\"";
    assert!(page.contains(shown), "the viewer knows what it is");
    assert!(!page.contains("\"ssim\":{\"label\""), "maps that are not there are not listed");
    let again = folder.run(&["run", "e.toml", "--resume"]).ok();
    assert!(!again.stderr.contains("maps of [output] are missing"), "{}", again.stderr);
    folder.write("reports/e/maps/s/m/hdr_flip_exposure-0000.exr", "");
    let again = folder.run(&["run", "e.toml", "--resume"]).ok();
    assert!(again.stderr.contains("maps of [output] are missing"), "{}", again.stderr);
}
