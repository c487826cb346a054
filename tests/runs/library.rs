//! The library and the command have the same numbers, and units of work are as good as a whole run.

use std::fs;
use std::path::Path;

use fovqa::{
    Finished, Given, MergeOptions, Metric, MetricChoice, ParamSet, ParamValue, ReadOptions, Run,
    RunOptions, ScoreOptions, Settings, Silent, SourceSpec, Task, TaskFindings, ViewSpec, merge,
    read_experiment, results, score, units, video_stream, write_json,
};
use ndarray::Array3;
use serde_json::Value;

use crate::fovqa::command;
use crate::runs::interrupted_runs::{assert_same, results as results_of, two_scenes};
use crate::runs::shards::names;

/// Height and width: the least that MS-SSIM takes, and more.
const SIZE: (usize, usize) = (150, 180);

fn picture(seed: usize) -> Array3<u8> {
    Array3::from_shape_fn((SIZE.0, SIZE.1, 3), |(y, x, c)| {
        ((x * 7 + y * 13 + c * 31 + (x * y) % 17 * seed) % 256) as u8
    })
}

fn write_png(path: &Path, pixels: &Array3<u8>) {
    let (height, width, _) = pixels.dim();
    let codes: Vec<u8> = pixels.iter().copied().collect();
    fs::write(path, fovqa_io::png_rgb8(width, height, &codes).unwrap()).unwrap();
}

/// Without what the two are called.
fn nameless(mut scores: Value) -> Value {
    for frame in scores["frames"].as_array_mut().unwrap() {
        frame["reference"] = Value::Null;
        frame["test"] = Value::Null;
    }
    scores
}

#[test]
fn arrays_score_as_files_do() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = [1, 3].map(picture);
    let [a_png, b_png] = ["a.png", "b.png"].map(|name| folder.path().join(name));
    write_png(&a_png, &a);
    write_png(&b_png, &b);
    let names =
        ["psnr", "ssim", "ms-ssim", "fpsnr", "fssim", "gmsd", "rms-contrast", "haar", "fvvdp"];
    let mut params = ParamSet::default();
    params.set(Metric::Ssim, "sigma", &ParamValue::Number(1.2)).unwrap();
    params.set(Metric::Haar, "levels", &ParamValue::Number(3.0)).unwrap();
    let options = ScoreOptions {
        settings: Settings {
            view: fovqa_vision::find_display("htc-vive-pro").cloned().map(ViewSpec::Display),
            gaze: fovqa::Gaze::Point([30.5, 40.0]),
            ..Settings::default()
        },
        metrics: MetricChoice::Named(names.iter().filter_map(|name| Metric::find(name)).collect()),
        params,
        maps: true,
    };
    let scores = score(a.view(), b.view(), &options).unwrap();
    let mut text = Vec::new();
    write_json(&scores.report, &mut text).unwrap();
    let ours: Value = serde_json::from_slice(&text).unwrap();
    let names = names.join(",");
    let arguments = [
        a_png.to_str().unwrap(),
        b_png.to_str().unwrap(),
        "--metrics",
        &names,
        "--display",
        "htc-vive-pro",
        "--gaze",
        "30.5,40",
        "--set",
        "ssim.sigma=1.2",
        "--set",
        "haar.levels=3",
        "--format",
        "json",
    ];
    let output = command(&[&["score"], &arguments[..]].concat()).output().unwrap();
    let theirs: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(nameless(ours), nameless(theirs));
    let maps: Vec<&str> = scores.maps.iter().map(|map| map.name).collect();
    assert!(maps.contains(&"ssim") && maps.contains(&"fvvdp"), "{maps:?}");
    assert!(scores.warnings.iter().any(|warning| warning.contains("stretched")));
}

#[test]
fn other_kinds_of_samples_and_slices() {
    let codes = picture(2);
    let wide = codes.mapv(|code| u16::from(code) * 257);
    let options = ScoreOptions::default();
    let same = score(codes.view(), wide.view(), &options).unwrap();
    assert_eq!(same.value(Metric::Mse), Some(0.0));
    // A view with another order of rows in memory is the same picture.
    let mut flipped = codes.clone();
    flipped.invert_axis(ndarray::Axis(0));
    let mut again = flipped.view();
    again.invert_axis(ndarray::Axis(0));
    let same = score(codes.view(), again, &options).unwrap();
    assert_eq!(same.value(Metric::Mse), Some(0.0));
    // Floats are linear light: half of full scale, once encoded.
    let light = Array3::from_elem((SIZE.0, SIZE.1, 3), 0.214_041_14_f32);
    let grey = Array3::from_elem((SIZE.0, SIZE.1, 3), 32768u16);
    let near = score(grey.view(), light.view(), &options).unwrap();
    assert!(near.value(Metric::Mse).unwrap() < 1e-9, "{:?}", near.value(Metric::Mse));
    let two = Array3::<u8>::zeros((8, 8, 2));
    let error = score(two.view(), two.view(), &options).unwrap_err();
    assert!(error.to_string().contains("the reference has 2 channels"), "{error}");
    let error =
        score(codes.view(), two.slice_axis(ndarray::Axis(2), (..1).into()), &options).unwrap_err();
    assert!(error.to_string().contains("180x150 pixels, but test has 8x8"), "{error}");
    let empty = Array3::<u8>::zeros((0, 8, 3));
    assert!(score(empty.view(), empty.view(), &options).is_err());
}

/// Four frames of two methods, with a measure over time.
fn experiment(folder: &Path) -> std::path::PathBuf {
    for method in ["gt", "a", "b"] {
        fs::create_dir(folder.join(method)).unwrap();
        for frame in 0..4 {
            let seed = frame + if method == "gt" { 1 } else { method.len() * 4 + 2 };
            write_png(&folder.join(format!("{method}/{frame:04}.png")), &picture(seed));
        }
    }
    let text = "name = \"units\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\n\
                reference = \"gt\"\nfps = 30\n[[method]]\nname = \"A\"\ntest = \"a\"\n\
                [[method]]\nname = \"B\"\ntest = \"b\"\n[metrics]\npsnr = {}\natd = {}\nhaar = { levels = 2 }\n";
    let file = folder.join("units.toml");
    fs::write(&file, text).unwrap();
    file
}

#[test]
fn units_done_elsewhere_are_a_whole_run() {
    let folder = tempfile::tempdir().unwrap();
    let file = experiment(folder.path());
    let run = Run::new(read_experiment(&file).unwrap(), RunOptions::default(), &Given::default());
    let run = run.unwrap();
    let plan = &run.experiment().plan;
    let whole = units(run.found(), None);
    assert_eq!(whole.iter().map(|unit| unit.pairs.len()).sum::<usize>(), 8);
    let findings = |pieces: usize| {
        let tasks = whole.iter().flat_map(|unit| unit.pieces(pieces));
        let done = tasks.map(|unit| {
            // Another process has the text alone.
            let text = Task::new(plan, run.found(), unit).unwrap().to_json().unwrap();
            let task = Task::from_json(&text).unwrap();
            assert_eq!(task.to_json().unwrap(), text);
            let lines = task.run(&Given::default(), &Silent).unwrap().to_lines(&task);
            TaskFindings::from_lines(&task, &lines).unwrap()
        });
        TaskFindings::merge(done.collect::<Vec<_>>())
    };
    let [once, pieces] = [100, 3].map(|most| results(plan, &Silent, findings(most)));
    assert_eq!(once, pieces);
    assert_eq!(once.comparisons.len(), 2);
    assert!(once.comparisons.iter().all(|c| c.report.frames.len() == 4));
    assert_eq!(once.inputs.len(), 12);
}

#[test]
fn a_task_of_other_frames_or_text_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = experiment(folder.path());
    let run = Run::new(read_experiment(&file).unwrap(), RunOptions::default(), &Given::default());
    let run = run.unwrap();
    let unit = run.units().remove(0);
    let task = Task::new(&run.experiment().plan, run.found(), unit).unwrap();
    let text = task.to_json().unwrap();
    for wrong in ["", "{}", &text.replace("fovqa.task/1", "fovqa.task/0"), &text[..text.len() / 2]]
    {
        assert!(
            Task::from_json(wrong).unwrap_err().to_string().contains("not a unit of work"),
            "{wrong}"
        );
    }
    let lines = task.run(&Given::default(), &Silent).unwrap().to_lines(&task);
    for wrong in ["", "x\n", lines.split_once('\n').unwrap().0, &lines.replace("\"s\"", "\"t\"")] {
        let error = TaskFindings::from_lines(&task, wrong).unwrap_err().to_string();
        assert!(error.contains("do not belong to the unit of work"), "{error}");
    }
    fs::remove_file(folder.path().join("a/0003.png")).unwrap();
    let error = task.run(&Given::default(), &Silent).unwrap_err().to_string();
    assert!(error.contains("differ from those in the unit of work"), "{error}");
}

/// Frames of a y4m video of grey pixels.
fn video(frames: usize) -> Vec<u8> {
    let mut bytes = b"YUV4MPEG2 W16 H16 F25:1 Cmono\n".to_vec();
    for frame in 0..frames {
        bytes.extend(b"FRAME\n");
        bytes.extend((0..256).map(|at| (20 + (at * 5 + frame * 3) % 200) as u8));
    }
    bytes
}

/// Runs an experiment whose reference has `frames` frames and whose test is a stream, whose length is unknown
/// until it ends.
fn streamed(
    folder: &Path,
    frames: usize,
    allow: bool,
    stream: usize,
    options: RunOptions,
) -> Finished {
    fs::write(folder.join("gt.y4m"), video(frames)).unwrap();
    let text = format!(
        "name = \"e\"\n[metrics]\npsnr = {{}}\n[[scene]]\nname = \"s\"\nreference = \"gt.y4m\"\n\
         allow_missing = {allow}\n[[method]]\nname = \"a\"\ntest = \"a.y4m\"\n"
    );
    fs::write(folder.join("e.toml"), text).unwrap();
    let mut experiment = read_experiment(&folder.join("e.toml")).unwrap();
    experiment.plan.scenes[0].eyes[0].tests[0].1 = SourceSpec::Given("a".to_owned());
    let reader = std::io::Cursor::new(video(stream));
    let source = video_stream("a".to_owned(), reader, &ReadOptions::default()).unwrap();
    let given = Given::from([("a".to_owned(), source)]);
    Run::new(experiment, options, &given).unwrap().start(&Silent).unwrap()
}

#[test]
fn a_stream_that_continues_is_an_error_in_every_resumed_run() {
    let folder = tempfile::tempdir().unwrap();
    let output = Some(folder.path().join("out"));
    let run = |stream, resume| {
        let options = RunOptions { output: output.clone(), resume, ..RunOptions::default() };
        let finished = streamed(folder.path(), 4, false, stream, options);
        (finished.scored, finished.errors)
    };
    assert_eq!(run(6, false), (4, 1));
    let journal = || fs::read_to_string(folder.path().join("out/journal.jsonl")).unwrap();
    assert!(journal().contains("it continues after its first 4 frames"), "{}", journal());
    assert_eq!(run(6, true), (4, 1), "it is not forgotten");
    assert_eq!(run(4, true), (4, 0), "it has been corrected");
    assert!(!journal().contains("it continues after"), "{}", journal());
}

#[test]
fn shards_of_streams_are_finished_wherever_the_stream_ends() {
    for (allow, stream, errors) in
        [(true, 6, 0), (true, 4, 0), (true, 2, 0), (false, 4, 1), (false, 8, 1)]
    {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let run = |name: &str, shard: Option<&str>| {
            let shard = shard.map(|shard| shard.parse().unwrap());
            let options = RunOptions { output: Some(at(name)), shard, ..RunOptions::default() };
            streamed(folder.path(), 6, allow, stream, options)
        };
        let whole = run("whole", None);
        assert_eq!((whole.scored, whole.errors), (stream.min(6), errors), "{allow} {stream}");
        let found =
            [("one", "1/2"), ("two", "2/2")].map(|(name, shard)| run(name, Some(shard)).errors);
        assert_eq!(found, [0, errors], "{allow} {stream}: the first shard has all of its frames");
        let shards = ["one", "two"].map(at);
        let merged = merge(&shards, &at("merged"), MergeOptions::default(), &Silent);
        let merged = merged.unwrap_or_else(|error| panic!("{allow} {stream}: {error}"));
        assert_eq!((merged.scored, merged.errors), (whole.scored, whole.errors));
        for file in ["results.csv", "summary.json", "journal.jsonl"] {
            let of = |name: &str| fs::read_to_string(at(name).join(file)).unwrap();
            assert_eq!(of("merged"), of("whole"), "{allow} {stream}: {file}");
        }
    }
}

/// The frames of an experiment are found once for all shards, and each shard is one like any other.
#[test]
fn one_search_for_frames_serves_all_shards() {
    let folder = two_scenes();
    let at = |name: &str| folder.path(name);
    let experiment = read_experiment(&at("e.toml")).unwrap();
    let run = |experiment| Run::new(experiment, RunOptions::default(), &Given::default()).unwrap();
    let shards = run(experiment.clone());
    assert!(shards.reads_frames_before());
    let score = |index: usize, resume| {
        let shard = format!("{index}/3").parse().unwrap();
        shards.score_shard(shard, &at(&format!("s-{index}-of-3")), resume, &Silent).unwrap()
    };
    // In whichever order, and one of them twice.
    let known: Vec<(usize, usize)> = [(3, true), (1, true), (2, true), (1, true), (3, false)]
        .map(|(index, resume)| score(index, resume))
        .map(|finished| (finished.scored, finished.known))
        .into();
    assert_eq!(known, [(12, 0), (12, 0), (12, 0), (12, 12), (12, 0)]);
    let names = names("s", 3);
    let folders: Vec<_> = names.iter().map(|name| at(name)).collect();
    merge(&folders, &at("merged"), MergeOptions::default(), &Silent).unwrap();
    folder.run(&["run", "e.toml", "--output", "whole"]).ok();
    assert_same(&results_of(&at("merged")), &results_of(&at("whole")), "merged");
    // Other frames have another fingerprint.
    assert_eq!(shards.fingerprint(), run(experiment.clone()).fingerprint());
    fs::remove_file(at("eyes/left/a/0002.png")).unwrap();
    assert_ne!(shards.fingerprint(), run(experiment).fingerprint());
}
