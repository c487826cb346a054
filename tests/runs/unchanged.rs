//! The committed experiments, held byte by byte against what they once gave: tests/recorded/README.md.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;

use crate::fovqa::{Folder, Run, command, root, shared};

/// Differing lines of a file that are shown.
const SHOWN: usize = 20;

/// Some comparisons of an experiment, as `fovqa score` takes them.
struct Scores {
    /// The file in `configs` or a folder in it, without its extension.
    experiment: &'static str,
    /// Its view, signal and metrics.
    options: &'static str,
    pairs: &'static [Pair],
}

/// What the recorded file is named after, reference and test from the root of the repository, and
/// what the scene or the eye has of its own.
type Pair = (&'static str, &'static str, &'static str, &'static str);

const SCORES: &[Scores] = &[
    // Stills, PNG.
    Scores {
        experiment: "renders",
        options: "--fov-vertical 100 --bands 0,5,10,20,30,45,60 \
                  --metrics psnr,ssim,ms-ssim,fpsnr,rms-contrast,haar",
        pairs: &[
            (
                "rmfr",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/rmfr.png",
                "",
            ),
            (
                "vafr",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/vafr.png",
                "",
            ),
        ],
    },
    Scores {
        experiment: "stills",
        options: "--fov-vertical 100 --bands 0,5,10,15,20,25,30,35,40,45,50,55,60 \
                  --metrics psnr,ssim,ms-ssim,fpsnr,fssim",
        pairs: &[
            (
                "sponza-kfr-inverted",
                "../shared/data/stills/sponza/gt.png",
                "../shared/data/stills/sponza/center/kfr_inv.png",
                "",
            ),
            (
                "living-room-vafr",
                "../shared/data/stills/living-room/gt.png",
                "../shared/data/stills/living-room/center/vafr.png",
                "",
            ),
            (
                "sponza-off-centre-hyper3",
                "../shared/data/stills/sponza/gt.png",
                "../shared/data/stills/sponza/offcenter/hyper3.png",
                "--gaze 480,1000",
            ),
        ],
    },
    Scores {
        experiment: "patney-fig-4-renders",
        options: "--fov-vertical 100 --bands 0,5,10,15,20,25,30,35,40,45,50,55,60 \
                  --metrics rms-contrast",
        pairs: &[(
            "kfr",
            "tests/data/small/living-room/gt.png",
            "tests/data/small/living-room/kfr.png",
            "",
        )],
    },
    Scores {
        experiment: "patney-fig-4-full",
        options: "--fov-vertical 100 --bands 0,5,10,15,20,25,30,35,40,45,50,55,60 \
                  --metrics rms-contrast",
        pairs: &[(
            "sponza-kfr",
            "../shared/data/stills/sponza/gt.png",
            "../shared/data/stills/sponza/center/kfr.png",
            "",
        )],
    },
    Scores {
        experiment: "patney-fig-10-renders",
        options: "--fov-vertical 100 --bands 0,5,10,15,20,25,30,35,40,45,50,55,60 \
                  --metrics haar --set haar.levels=5",
        pairs: &[
            (
                "rmfr",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/rmfr.png",
                "",
            ),
            (
                "hyper3",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/hyper3.png",
                "",
            ),
        ],
    },
    Scores {
        experiment: "patney-fig-10-full",
        options: "--fov-vertical 100 --bands 0,5,10,15,20,25,30,35,40,45,50,55,60 \
                  --metrics haar --set haar.levels=5",
        pairs: &[
            (
                "living-room-vafr",
                "../shared/data/stills/living-room/gt.png",
                "../shared/data/stills/living-room/center/vafr.png",
                "",
            ),
            (
                "sponza-rmfr",
                "../shared/data/stills/sponza/gt.png",
                "../shared/data/stills/sponza/center/rmfr.png",
                "",
            ),
        ],
    },
    // A still, OpenEXR.
    Scores {
        experiment: "stills-exr",
        options: "--fov-vertical 100 --bands 0,5,10,15,20,25,30,35,40,45,50,55,60 \
                  --exposure 0.7754649649991607 --metrics psnr,ssim,ms-ssim,fpsnr,fssim",
        pairs: &[
            (
                "rmfr",
                "../shared/data/stills/sponza/gt.exr",
                "../shared/data/stills/sponza/center/rmfr.exr",
                "",
            ),
            (
                "hyper3",
                "../shared/data/stills/sponza/gt.exr",
                "../shared/data/stills/sponza/center/hyper3.exr",
                "",
            ),
        ],
    },
    // Two eyes, OpenEXR, default metrics.
    Scores {
        experiment: "stereo",
        options: "--fov-vertical 90 --bands 0,10,20,30,45,65 --exposure 0.646",
        pairs: &[
            (
                "left",
                "tests/data/small/stereo/left_gt.exr",
                "tests/data/small/stereo/left_rmfr.exr",
                "--gaze 202.1,200",
            ),
            (
                "right",
                "tests/data/small/stereo/right_gt.exr",
                "tests/data/small/stereo/right_rmfr.exr",
                "--gaze 197.9,200",
            ),
        ],
    },
    // Sequences with motion, depth and a gaze trace.
    Scores {
        experiment: "patney-fig-12-renders",
        options: "--fov-vertical 100 --bands 0,10,20,30,40,50,60 --exposure 0.6597580961872381 \
                  --tonemap clamp --fps 72 --gaze tests/data/small/classroom/gaze.csv \
                  --metrics atd",
        pairs: &[
            ("rmfr", "tests/data/small/classroom/gt", "tests/data/small/classroom/rmfr_noaa", ""),
            (
                "rmfr-taa",
                "tests/data/small/classroom/gt",
                "tests/data/small/classroom/rmfr_taa",
                "",
            ),
        ],
    },
    Scores {
        experiment: "patney-fig-12-full",
        options: "--fov-vertical 100 --bands 0,10,20,30,40,50,60 --exposure 1.1764644532219348 \
                  --tonemap clamp --fps 72 --gaze ../shared/data/sequence/gaze.csv --metrics atd",
        pairs: &[(
            "rmfr-taa",
            "../shared/data/sequence/gt",
            "../shared/data/sequence/rmfr_taa",
            "",
        )],
    },
    // FovVideoVDP with its display: stills and a sequence.
    Scores {
        experiment: "visible-difference",
        options: "--fov-vertical 100 --luminance htc-vive-pro --bands 0,5,10,20,30,45,60 \
                  --metrics fvvdp,pu-psnr,psnr",
        pairs: &[
            (
                "living-room-kfr",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/kfr.png",
                "",
            ),
            (
                "classroom-rmfr",
                "tests/data/small/classroom/gt",
                "tests/data/small/classroom/rmfr_noaa",
                "--fps 72 --gaze tests/data/small/classroom/gaze.csv --exposure 0.6598",
            ),
            (
                "classroom-rmfr-taa",
                "tests/data/small/classroom/gt",
                "tests/data/small/classroom/rmfr_taa",
                "--fps 72 --gaze tests/data/small/classroom/gaze.csv --exposure 0.6598",
            ),
        ],
    },
    Scores {
        experiment: "nightly",
        options: "--fov-vertical 100 --luminance htc-vive-pro --bands 0,5,10,20,30,45,60 \
                  --metrics psnr,ssim,fpsnr,fvvdp",
        pairs: &[
            (
                "rmfr",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/rmfr.png",
                "",
            ),
            (
                "vafr",
                "tests/data/small/living-room/gt.png",
                "tests/data/small/living-room/vafr.png",
                "",
            ),
        ],
    },
];

/// An experiment that belongs to the repository.
struct Experiment {
    name: String,
    path: PathBuf,
    text: String,
}

impl Experiment {
    fn path(&self) -> &str {
        self.path.to_str().unwrap()
    }

    fn results(&self) -> String {
        format!("{}.csv", self.name)
    }

    fn verdict(&self) -> String {
        format!("{}.gate.json", self.name)
    }

    fn has_gate(&self) -> bool {
        self.text.contains("[[gate]]")
    }
}

/// Those with scenes and renders in files, by name. (The results of the demo are in `reports/sample`.)
fn experiments() -> Vec<Experiment> {
    let configs = root().join("configs");
    let folders = [configs.join("papers"), configs.join("ci"), configs];
    let mut found = Vec::new();
    for entry in folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()) {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        if text.contains("[[scene]]") && !text.contains("emulate = ") {
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            found.push(Experiment { name, path, text });
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

/// Those whose data is there.
fn runnable() -> Vec<Experiment> {
    let data = shared("data").is_some();
    experiments().into_iter().filter(|e| data || !e.text.contains("../shared")).collect()
}

fn score_file(experiment: &str, pair: &Pair) -> String {
    format!("{experiment}.{}.json", pair.0)
}

fn folder() -> PathBuf {
    root().join("tests/recorded")
}

fn recording() -> bool {
    std::env::var_os("FOVQA_RECORD").is_some_and(|value| value == "1")
}

fn read(file: &Path) -> Option<String> {
    let mut text = String::new();
    let read = GzDecoder::new(File::open(file).ok()?).read_to_string(&mut text);
    read.unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    Some(text)
}

fn write(file: &Path, text: &str) {
    fs::create_dir_all(folder()).unwrap();
    let mut encoder = GzEncoder::new(File::create(file).unwrap(), Compression::best());
    encoder.write_all(text.as_bytes()).unwrap();
    encoder.finish().unwrap();
}

/// What has changed since the file was recorded; or records it.
fn changes(name: &str, new: &str) -> Option<String> {
    assert!(!new.is_empty() && !new.contains('\r'), "{name}");
    let file = folder().join(format!("{name}.gz"));
    let recorded = read(&file);
    if recorded.as_deref() == Some(new) {
        return None;
    }
    if recording() {
        write(&file, new);
        return None;
    }
    Some(match recorded {
        Some(old) => side_by_side(name, &old, new),
        None => format!("{name}: it is not recorded\n"),
    })
}

fn line<'a>(lines: &[&'a str], at: usize) -> &'a str {
    lines.get(at).copied().unwrap_or("(no line)")
}

/// The first lines that differ, as recorded and as they are now.
fn side_by_side(name: &str, old: &str, new: &str) -> String {
    let [old, new] = [old, new].map(|text| text.split('\n').collect::<Vec<_>>());
    let lines = old.len().max(new.len());
    let differing: Vec<usize> = (0..lines).filter(|&at| old.get(at) != new.get(at)).collect();
    let shown = &differing[..differing.len().min(SHOWN)];
    let width = shown.iter().map(|&at| line(&old, at).chars().count()).max().unwrap_or(0).max(8);
    let mut report = format!("{name}: {} of {lines} lines differ\n", differing.len());
    writeln!(report, "{:>7} | {:width$} | new", "line", "recorded").unwrap();
    for &at in shown {
        let (number, old, new) = (at + 1, line(&old, at), line(&new, at));
        writeln!(report, "{number:>7} | {old:width$} | {new}").unwrap();
    }
    report
}

#[track_caller]
fn assert_unchanged(changes: impl Iterator<Item = String>) {
    let changes: Vec<String> = changes.collect();
    assert!(changes.is_empty(), "files that differ: {}\n\n{}", changes.len(), changes.join("\n"));
}

#[test]
fn results_are_what_they_were() {
    let results = Folder::new();
    assert_unchanged(runnable().iter().filter_map(|experiment| {
        results.run(&["run", experiment.path(), "--output", &experiment.name]).ok();
        let csv = results.path(&format!("{}/results.csv", experiment.name));
        changes(&experiment.results(), &fs::read_to_string(csv).unwrap())
    }));
}

#[test]
fn scores_are_what_they_were() {
    let data = shared("data").is_some();
    let pairs =
        SCORES.iter().flat_map(|scores| scores.pairs.iter().map(move |pair| (scores, pair)));
    let there = pairs.filter(|(_, pair)| data || !pair.1.starts_with("../shared"));
    assert_unchanged(there.filter_map(|(scores, pair)| {
        let mut arguments = vec!["score", pair.1, pair.2, "--format", "json"];
        arguments.extend(scores.options.split_whitespace().chain(pair.3.split_whitespace()));
        let output = command(&arguments).current_dir(root()).output().unwrap();
        changes(&score_file(scores.experiment, pair), &Run::from(output).ok().stdout)
    }));
}

#[test]
fn verdicts_are_what_they_were() {
    let results = Folder::new();
    assert_unchanged(runnable().iter().filter(|e| e.has_gate()).filter_map(|experiment| {
        let baseline = experiment.path.with_extension("baseline.json");
        let mut arguments = vec!["gate", experiment.path(), "--format", "json"];
        if baseline.exists() {
            arguments.extend(["--baseline", baseline.to_str().unwrap()]);
        }
        let run = results.run(&arguments);
        assert!(run.code == 0 || run.code == 1, "{}: {}", experiment.name, run.stderr);
        changes(&experiment.verdict(), &run.stdout)
    }));
}

/// Nothing lies there that is not compared, and every experiment has its scores.
#[test]
fn what_is_recorded_is_compared() {
    if recording() {
        return;
    }
    let mut expected = BTreeSet::from(["README.md".to_owned()]);
    for experiment in experiments() {
        let scores = SCORES.iter().find(|scores| scores.experiment == experiment.name);
        let scores = scores.unwrap_or_else(|| panic!("{} is not in SCORES", experiment.name));
        let scores = scores.pairs.iter().map(|pair| score_file(&experiment.name, pair));
        let verdict = experiment.has_gate().then(|| experiment.verdict());
        let files = scores.chain([experiment.results()]).chain(verdict);
        expected.extend(files.map(|file| format!("{file}.gz")));
    }
    let entries = fs::read_dir(folder()).unwrap();
    let found: BTreeSet<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    let missing: Vec<&String> = expected.difference(&found).collect();
    let unknown: Vec<&String> = found.difference(&expected).collect();
    assert!(missing.is_empty() && unknown.is_empty(), "missing {missing:?}, unknown {unknown:?}");
}
