//! What emulated methods score, and what they write.

use std::collections::BTreeMap;
use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use fovqa::{
    Emulation, EmulationSpec, Experiment, EyeView, Given, Metric, MetricChoice, Plan, Run,
    RunOptions, Scene, Settings, Silent, SourceSpec, ViewSpec,
};
use fovqa_frame::source::{Length, Listing, Origin, Picture, PictureGuides, Source, SourceError};
use fovqa_frame::{Channels, Frame, Samples};
use fovqa_testkit::exr_files::{File, Part};
use fovqa_testkit::synthetic::codes;

use crate::fovqa::Folder;
use crate::frames::moving_frames::{SIZE, moving};
use crate::runs::experiment_folder::{bytes, json, rows};

const HEAD: &str = "name = \"e\"\n[view]\nfov_vertical_deg = 90\nbands_deg = [0, 15, 30]\n";

/// The values of a method that do not say how many samples it has, by everything else in their rows.
fn values(rows: &[BTreeMap<String, String>], method: &str) -> BTreeMap<String, String> {
    let of = rows.iter().filter(|row| row["method"] == method);
    let of = of
        .filter(|row| !row["metric"].starts_with("samples") && !row["metric"].starts_with("quads"));
    let key = |row: &BTreeMap<String, String>| {
        let columns = row.iter().filter(|(name, _)| !["method", "value"].contains(&name.as_str()));
        columns.map(|(_, cell)| cell.as_str()).collect::<Vec<_>>().join(",")
    };
    of.map(|row| (key(row), row["value"].clone())).collect()
}

#[test]
fn frames_that_are_kept_score_the_same() {
    let folder = Folder::new();
    for frame in 0..2 {
        folder.png(&format!("gt/{frame:04}.png"), 96, 80, &codes(96, 80, 3, frame));
    }
    folder.write("gaze.csv", "frame,x_px,y_px\n0,20,30\n1,70,60.5\n");
    let scene = "gaze = { trace = \"gaze.csv\" }\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n";
    folder.write(
        "e.toml",
        format!(
            "{HEAD}{scene}[[method]]\nname = \"KFR\"\n\
             emulate = {{ model = \"kfr\", sigma = 2, filter = \"own\", keep_frames = true }}\n\
             [[method]]\nname = \"RMFR\"\nemulate = {{ model = \"rmfr\" }}\n"
        ),
    );
    folder.run(&["run", "e.toml", "--output", "one", "--maps", "maps"]).ok();
    let kept: Vec<String> = bytes(&folder.path("one/emulated")).into_keys().collect();
    assert_eq!(kept, ["s/KFR/0000.png", "s/KFR/0001.png"]);
    assert!(folder.path("maps/s/RMFR/ssim-0001.exr").exists());
    let samples: Vec<_> =
        rows(&folder, "one").into_iter().filter(|r| r["metric"] == "samples").collect();
    let samples: Vec<&str> = samples.iter().map(|row| row["value"].as_str()).collect();
    assert_eq!(samples, ["1920.0", "1920.0", "1147.0", "1147.0"]);
    folder.write(
        "f.toml",
        format!("{HEAD}{scene}[[method]]\nname = \"files\"\ntest = \"one/emulated/s/KFR\"\n"),
    );
    folder.run(&["run", "f.toml", "--output", "two"]).ok();
    let [one, two] = ["one", "two"].map(|results| rows(&folder, results));
    let emulated = values(&one, "KFR");
    assert!(emulated.len() > 50);
    assert_eq!(emulated, values(&two, "files"));
    assert_ne!(emulated, values(&one, "RMFR"));
    // The gaze of each frame counts.
    let fixed = HEAD.to_owned() + &scene.replace("{ trace = \"gaze.csv\" }", "[20, 30]");
    let method =
        "[[method]]\nname = \"KFR\"\nemulate = { model = \"kfr\", sigma = 2, filter = \"own\" }\n";
    folder.write("g.toml", fixed + method);
    folder.run(&["run", "g.toml", "--output", "three"]).ok();
    let mse = |results: &str| -> Vec<String> {
        let rows = rows(&folder, results).into_iter();
        let rows = rows
            .filter(|r| r["metric"] == "mse" && r["from_deg"].is_empty() && r["method"] == "KFR");
        rows.map(|row| row["value"].clone()).collect()
    };
    let [moving, still] = [mse("one"), mse("three")];
    assert!(moving[0] == still[0] && moving[1] != still[1], "{moving:?} {still:?}");
}

/// A method that shades every pixel shows the frame itself, whatever its file is.
#[test]
fn full_rate_is_the_reference() {
    let folder = Folder::new();
    folder.png("png/a.png", 48, 40, &codes(48, 40, 3, 1));
    let bright = |x: usize, y: usize| moving(1, 0)(x, y) * 5.0 - 0.5;
    File::new(vec![Part::rgb(SIZE, bright)]).write(&folder.path("exr/a.exr"));
    let luma: Vec<u8> = codes(48, 40, 1, 3);
    let video = [b"YUV4MPEG2 W48 H40 F24:1 Cmono\nFRAME\n".as_slice(), &luma].concat();
    folder.write("video.y4m", video);
    for (reference, signal) in [
        ("png", ""),
        ("exr", "tonemap = \"reinhard\"\nexposure_stops = 0.5\n"),
        ("exr", "tonemap = \"aces\"\n"),
        ("exr", ""),
        ("video.y4m", ""),
    ] {
        folder.write(
            "e.toml",
            format!(
                "{HEAD}[signal]\n{signal}[[scene]]\nname = \"s\"\nreference = \"{reference}\"\n\
                 [[method]]\nname = \"F\"\nemulate = {{ model = \"full\" }}\n\
                 [[method]]\nname = \"R\"\nemulate = {{ model = \"rmfr\", sigma = 1.5 }}\n\
                 [metrics]\npsnr = {{}}\n"
            ),
        );
        folder.run(&["run", "e.toml", "--output", "out"]).ok();
        let psnr: Vec<f64> = rows(&folder, "out")
            .iter()
            .filter(|row| row["metric"] == "psnr" && row["from_deg"].is_empty())
            .map(|row| row["value"].parse().unwrap())
            .collect();
        assert!(psnr[0].is_infinite() && psnr[1] > 5.0 && psnr[1] < 60.0, "{reference}: {psnr:?}");
    }
}

/// Linear light that a method shows as it is keeps highlights that the tone map cuts.
#[test]
fn highlights_are_not_cut_where_the_frame_is_shown() {
    let folder = Folder::new();
    let bright = |x: usize, y: usize| moving(1, 0)(x, y) * 50.0;
    File::new(vec![Part::rgb(SIZE, bright)]).write(&folder.path("a.exr"));
    let experiment = |signal: &str, model: &str| {
        format!(
            "name = \"e\"\n[view]\ndisplay = \"htc-vive-pro\"\n\
             luminance = {{ peak_cd_m2 = 1000, eotf = \"linear\" }}\n[signal]\n{signal}\
             [[scene]]\nname = \"s\"\nreference = \"a.exr\"\n\
             [[method]]\nname = \"F\"\nemulate = {{ model = \"{model}\" }}\n[metrics]\nfvvdp = {{}}\n"
        )
    };
    folder.write("e.toml", experiment("", "full"));
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let summary = json(&folder, "out/summary.json");
    assert_eq!(summary["comparisons"][0]["fvvdp"]["jod"], 10.0, "{summary}");
    folder.write("e.toml", experiment("tonemap = \"aces\"\n", "rmfr"));
    let run = folder.run(&["run", "e.toml", "--output", "out"]);
    assert_eq!(run.code, 3);
    run.says(&["`aces` cannot be undone"]);
}

#[test]
fn samples_are_in_the_table_and_the_summary() {
    let folder = Folder::new();
    folder.png("gt.png", 96, 80, &codes(96, 80, 3, 1));
    folder.png("file.png", 96, 80, &codes(96, 80, 3, 2));
    let scene = "[[scene]]\nname = \"s\"\nreference = \"gt.png\"\n";
    let methods = "[[method]]\nname = \"RMFR\"\nemulate = { model = \"rmfr\", budget = 0.25 }\n\
                   [[method]]\nname = \"File\"\ntest = \"file.png\"\n\
                   [[method]]\nname = \"VaFR\"\nemulate = { model = \"vafr\", beyond = \"black\" }\n";
    folder.write(
        "e.toml",
        format!("{HEAD}{scene}{methods}[[gate]]\nmetric = \"psnr\"\nat_least = 5\n"),
    );
    let run = folder.run(&["run", "e.toml", "--output", "out"]).ok();
    assert!(run.stdout.contains("Samples (% of pixels)"), "{}", run.stdout);
    let comparisons = json(&folder, "out/summary.json")["comparisons"].clone();
    assert_eq!(comparisons[0]["samples"]["samples"], 1920.0);
    assert_eq!(comparisons[0]["samples"]["share"], 0.25);
    assert!(comparisons[1].get("samples").is_none());
    let vafr = &comparisons[2]["samples"];
    let number = |key: &str| vafr[key].as_f64().unwrap();
    let share = (number("samples") + number("beyond")) / (96.0 * 80.0);
    assert!(number("on_screen") > 0.0 && (number("share") - share).abs() < 1e-12, "{vafr}");
    let resolved = &json(&folder, "out/run.json")["resolved"]["scenes"][0]["eyes"][0];
    assert_eq!(resolved["emulations"]["RMFR"]["budget"], 0.25);
    assert_eq!(resolved["emulations"]["VaFR"]["parameters"]["beyond"], "black");
    assert_eq!(resolved["tests"].as_object().unwrap().len(), 1);
    // What is drawn again from the folder alone is the same, and the gate holds.
    let table = fs::read(folder.path("out/table.md")).unwrap();
    folder.run(&["report", "out"]).ok();
    assert_eq!(fs::read(folder.path("out/table.md")).unwrap(), table);
    folder.run(&["gate", "out"]).ok();
    let checked = folder.run(&["check", "e.toml"]).ok();
    assert!(checked.stdout.contains("emulated: rmfr, budget = 0.25"), "{}", checked.stdout);
}

/// Blocks of 2x2 samples: of the buffers, or of the frame's pixels. Polar buffers and continuous rates
/// have none.
#[test]
fn quads_are_counted_and_a_table_shows_them() {
    let folder = Folder::new();
    folder.png("gt.png", 95, 81, &codes(95, 81, 3, 1));
    let methods = [
        ("Full", "model = \"full\""),
        ("TAA", "model = \"taa\""),
        ("Stable", "model = \"stable\""),
        // 37 x 31 samples: 95 / 2.6 and 81 / 2.6, rounded.
        ("RMFR", "model = \"rmfr\""),
        ("Guenter", "model = \"guenter\", scales = [1, 2, 4]"),
        ("CPS", "model = \"cps\""),
        ("KFR", "model = \"kfr\""),
        ("VaFR", "model = \"vafr\""),
        ("Linear", "model = \"linear\""),
        ("Continuous", "model = \"cps\", quantise = \"continuous\""),
    ];
    let methods = methods
        .iter()
        .map(|(name, model)| format!("[[method]]\nname = \"{name}\"\nemulate = {{ {model} }}\n"))
        .collect::<Vec<_>>()
        .concat();
    let scene = "[[scene]]\nname = \"s\"\nreference = \"gt.png\"\n";
    let table =
        "[metrics]\npsnr = {}\n[[plot]]\nkind = \"table\"\nmetrics = [\"quads\", \"samples\"]\n";
    folder.write("e.toml", format!("{HEAD}{scene}{methods}{table}"));
    let run = folder.run(&["run", "e.toml", "--output", "out"]).ok();
    assert!(run.stdout.contains("Quads (% of the frame's)"), "{}", run.stdout);
    let comparisons = json(&folder, "out/summary.json")["comparisons"].clone();
    let of = |method: &str| {
        let of = comparisons.as_array().unwrap().iter().find(|c| c["method"] == method).unwrap();
        of["samples"].clone()
    };
    let whole = 48.0 * 41.0;
    for method in ["Full", "TAA", "Stable"] {
        assert_eq!(of(method)["quads"], whole, "{method}");
        assert_eq!(of(method)["quads_share"], 1.0, "{method}");
    }
    assert_eq!(of("RMFR")["samples"], 37.0 * 31.0);
    assert_eq!(of("RMFR")["quads"], 19.0 * 16.0);
    assert_eq!(of("RMFR")["quads_share"], 19.0 * 16.0 / whole);
    // At 90°, R(10°) = 7.1 and R(20°) = 14.7 pixels around (47.5, 40.5): squares of 16 and 30 pixels, or
    // of 15 samples, and 24 x 20 samples of the frame.
    assert_eq!(of("Guenter")["quads"], 8.0 * 8.0 + 8.0 * 8.0 + 12.0 * 10.0);
    let cps = of("CPS")["quads"].as_f64().unwrap();
    let samples = of("CPS")["samples"].as_f64().unwrap();
    assert!(cps > samples / 4.0 && cps < whole, "{cps}");
    for method in ["KFR", "VaFR", "Linear", "Continuous"] {
        assert!(of(method).get("quads").is_none(), "{method}");
    }
    let rows = rows(&folder, "out");
    let shares = rows.iter().filter(|row| row["metric"] == "quads_share").count();
    assert_eq!(shares, 6);
    let csv = fs::read_to_string(folder.path("out/table.csv")).unwrap();
    assert!(csv.starts_with("scene,quads_percent Full,"), "{csv}");
}

/// Threads do not matter.
#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let folder = Folder::new();
    folder.png("gt.png", 160, 120, &codes(160, 120, 3, 1));
    let method = |model: &str| {
        format!(
            "[[method]]\nname = \"{model}\"\nemulate = {{ model = \"{model}\", keep_frames = true }}\n"
        )
    };
    let methods: String = EmulationSpec::methods().iter().map(|info| method(info.key)).collect();
    folder.write(
        "e.toml",
        format!("{HEAD}[[scene]]\nname = \"s\"\nreference = \"gt.png\"\n{methods}"),
    );
    for threads in ["1", "3"] {
        folder.run(&["run", "e.toml", "--output", threads, "--threads", threads]).ok();
    }
    assert_eq!(bytes(&folder.path("1")), bytes(&folder.path("3")));
}

/// Frames in memory, and how often they are read.
#[derive(Debug)]
struct Counted {
    listing: Listing,
    reads: Arc<AtomicUsize>,
}

impl Source for Counted {
    fn listing(&self) -> &Listing {
        &self.listing
    }

    fn size(&self, _frame: usize) -> Result<(usize, usize), SourceError> {
        Ok((48, 40))
    }

    fn bytes_per_pixel(&self) -> u64 {
        3
    }

    fn read(&self, frame: usize, _guides: bool) -> Result<Picture, SourceError> {
        self.reads.fetch_add(1, Ordering::SeqCst);
        let samples = Samples::U8(codes(48, 40, 3, frame as u64).into());
        Ok(Picture::new(Frame::new(48, 40, Channels::Rgb, samples).unwrap()))
    }

    fn read_guides(&self, _frame: usize) -> Result<PictureGuides, SourceError> {
        Err(SourceError::new("no guides", ""))
    }

    fn origins(&self, _frame: usize) -> Vec<(String, Origin)> {
        Vec::new()
    }
}

#[test]
fn the_reference_is_decoded_once_for_all_methods() {
    let reads = Arc::new(AtomicUsize::new(0));
    let listing = Listing::counted("memory".to_owned(), Length::Whole(3));
    let source: Arc<dyn Source> = Arc::new(Counted { listing, reads: Arc::clone(&reads) });
    let emulated =
        |model: &str| -> SourceSpec { Emulation::from(EmulationSpec::new(model).unwrap()).into() };
    let models = ["rmfr", "kfr", "taa", "stable", "deamp"];
    let view = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(90.0) };
    let eye = EyeView {
        reference: SourceSpec::Given("memory".to_owned()),
        tests: models.iter().map(|model| emulated(model)).enumerate().collect(),
        settings: Settings { view: Some(view), ..Settings::default() },
        ..EyeView::default()
    };
    let plan = Plan {
        scenes: vec![Scene { name: "s".to_owned(), eyes: vec![eye], ..Scene::default() }],
        methods: models.map(str::to_owned).to_vec(),
        metrics: MetricChoice::Named(vec![Metric::Psnr, Metric::Atd]),
        ..Plan::default()
    };
    let given = Given::from([("memory".to_owned(), source)]);
    let folder = Folder::new();
    let options = RunOptions { output: Some(folder.path("out")), ..RunOptions::default() };
    let experiment = Experiment { name: "e".to_owned(), plan, ..Experiment::default() };
    let finished = Run::new(experiment, options, &given).unwrap().start(&Silent).unwrap();
    assert_eq!((finished.scored, finished.errors), (3 * models.len(), 0));
    assert_eq!(reads.load(Ordering::SeqCst), 3);
}
