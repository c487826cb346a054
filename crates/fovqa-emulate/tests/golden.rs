//! Emulation against pictures and counts of two independent programs, pixel by pixel
//! (`tests/golden/emulate`).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::{Path, PathBuf};

use fovqa_emulate::{Budget, Counts, EmulationSpec, Emulator, FilterChoice, History, Picture};
use fovqa_emulate::{Sampling, Space};
use fovqa_frame::{Frame, Motion, Samples, SignalParams, SignalTables};
use fovqa_io::{GuideOptions, MotionChannels, ReadOptions, read_frame, read_guides};
use fovqa_methods::BudgetSamples;
use fovqa_params::{ParamValue, Words};
use fovqa_vision::ViewSpec;
use serde::Deserialize;

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    input: String,
    folder: bool,
    args: Vec<String>,
    frames: Vec<Expected>,
    tolerance: Tolerance,
}

#[derive(Deserialize)]
struct Expected {
    expected: String,
    counts: ExpectedCounts,
}

#[derive(Deserialize)]
struct ExpectedCounts {
    buffers: Vec<[usize; 2]>,
    samples: f64,
    samples_on_screen: f64,
    samples_beyond: f64,
    quads: Option<u64>,
}

#[derive(Deserialize)]
struct Tolerance {
    codes: u8,
    share: f64,
    on_screen_relative: f64,
    samples_relative: f64,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/golden/emulate")
}

/// The arguments of a case, read as the command would.
struct Arguments {
    spec: EmulationSpec,
    signal: SignalParams,
    vertical_deg: f64,
    gaze: Option<String>,
    motion: Option<PathBuf>,
}

impl Arguments {
    fn of(case: &Case) -> Self {
        let words: Vec<String> = case
            .args
            .iter()
            .map(|arg| arg.replace("{dir}", root().to_str().expect("a path in Unicode")))
            .flat_map(|arg| match arg.split_once('=') {
                Some((name, value)) if name.starts_with("--") => {
                    vec![name.to_owned(), value.to_owned()]
                }
                _ => vec![arg],
            })
            .collect();
        let value = |name: &str| {
            let at = words.iter().position(|word| word == name)?;
            Some(words[at + 1].clone())
        };
        let mut spec = EmulationSpec::new(&value("--method").unwrap()).unwrap();
        for (i, _) in words.iter().enumerate().filter(|(_, word)| *word == "--set") {
            let (name, value) = words[i + 1].split_once('=').unwrap();
            let value = serde_json::from_str(value).unwrap_or(ParamValue::Text(value.to_owned()));
            spec.set(name, &value).unwrap();
        }
        let number = |name: &str| value(name).map(|value| value.parse::<f64>().unwrap());
        if let Some(word) = value("--sampling") {
            spec.set_sampling(Sampling::find(&word).unwrap());
        }
        if let Some(word) = value("--space") {
            spec.set_space(Space::find(&word).unwrap());
        }
        if let Some(word) = value("--filter") {
            spec.set_filters(FilterChoice::find(&word).unwrap()).unwrap();
        }
        if words.iter().any(|word| word == "--temporal") {
            spec.set_temporal(true);
        }
        if let Some(f_max) = number("--enhance") {
            spec.set_enhance(f_max).unwrap();
        }
        if let Some(share) = number("--budget") {
            spec.set_budget(Budget { share, of: BudgetSamples::Buffer }).unwrap();
        }
        let exposure_stops = number("--exposure").unwrap_or_default();
        Self {
            spec,
            signal: SignalParams { exposure_stops, ..SignalParams::default() },
            vertical_deg: number("--fov-vertical").unwrap(),
            gaze: value("--gaze"),
            motion: value("--motion-files").map(PathBuf::from),
        }
    }

    /// The gaze of a frame; the centre where none is given.
    fn gaze_px(&self, frame: usize, size: [usize; 2]) -> [f64; 2] {
        let pair = |text: &str| {
            let numbers: Vec<f64> = text.split(',').map(|n| n.parse().unwrap()).collect();
            [numbers[numbers.len() - 2], numbers[numbers.len() - 1]]
        };
        match &self.gaze {
            None => size.map(|side| side as f64 / 2.0),
            Some(path) if Path::new(path).extension().is_some_and(|ending| ending == "csv") => {
                let text = fs::read_to_string(path).unwrap();
                pair(text.lines().nth(frame + 1).unwrap())
            }
            Some(point) => pair(point),
        }
    }
}

fn frame(path: &Path) -> Frame {
    read_frame(path, &ReadOptions::default()).unwrap().frame
}

fn motion(path: &Path) -> Motion {
    let guides = GuideOptions { motion: MotionChannels::Auto, ..GuideOptions::default() };
    let options = ReadOptions { guides, ..ReadOptions::default() };
    read_guides(path, &options).unwrap().guides.motion.unwrap()
}

/// The frames of a case as it is emulated, with their counts.
fn emulated(case: &Case) -> Vec<(Picture, Counts)> {
    let arguments = Arguments::of(case);
    let tables = SignalTables::new(arguments.signal);
    let input = root().join(&case.input);
    let mut history = History::default();
    case.frames
        .iter()
        .enumerate()
        .map(|(index, _)| {
            let path =
                if case.folder { input.join(format!("{index:04}.png")) } else { input.clone() };
            let frame = frame(&path);
            let size = [frame.width(), frame.height()];
            let view =
                ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(arguments.vertical_deg) };
            let view = view.resolve(size[0], size[1]).unwrap().view;
            let gaze_px = arguments.gaze_px(index, size);
            let emulator = Emulator::new(&arguments.spec, size, Some(&view), gaze_px).unwrap();
            let motion = arguments
                .motion
                .as_ref()
                .map(|folder| motion(&folder.join(format!("{index:04}.exr"))));
            let picture = Picture::from_frame(&frame, &tables);
            let shown = emulator.emulate_next(&picture, motion.as_ref(), &mut history).unwrap();
            (shown, emulator.counts().clone())
        })
        .collect()
}

fn codes(frame: &Frame) -> &[u8] {
    match frame.samples() {
        Samples::U8(codes) => codes,
        _ => panic!("8 bits"),
    }
}

/// What is wrong with a frame of a case, if anything is.
fn fault(case: &Case, wanted: &Expected, shown: &Picture, counts: &Counts) -> Option<String> {
    let (shown, expected) = (shown.to_codes8(), frame(&root().join(&wanted.expected)));
    let channels = shown.channels().count();
    let pairs = codes(&shown).chunks(channels).zip(codes(&expected).chunks(channels));
    let off = |(a, b): (&[u8], &[u8])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
    let offs: Vec<u8> = pairs.filter_map(off).collect();
    let near = offs.iter().filter(|off| **off <= case.tolerance.codes).count();
    let share = near as f64 / offs.len() as f64;
    if share < case.tolerance.share {
        let worst = offs.iter().enumerate().max_by_key(|(_, off)| **off).unwrap();
        let at = [worst.0 % expected.width(), worst.0 / expected.width()];
        return Some(format!(
            "{:.3} % of pixels agree; {} codes at {at:?}",
            share * 100.0,
            worst.1
        ));
    }
    let ExpectedCounts { buffers, samples, samples_on_screen, samples_beyond, quads } =
        &wanted.counts;
    let tolerance = &case.tolerance;
    let near = |found: f64, wanted: f64, relative: f64, absolute: f64| {
        (found - wanted).abs() <= relative * wanted + absolute
    };
    let agree = counts.buffers == *buffers
        && counts.quads == *quads
        && near(counts.samples, *samples, tolerance.samples_relative, 1e-6)
        && near(counts.samples_beyond, *samples_beyond, tolerance.samples_relative, 1e-6)
        && near(counts.samples_on_screen, *samples_on_screen, tolerance.on_screen_relative, 1.0);
    (!agree).then(|| {
        format!(
            "{counts:?}, expected {buffers:?}, {samples}, {samples_on_screen}, {samples_beyond}, \
             {quads:?}"
        )
    })
}

#[test]
fn pictures_and_counts_are_those_of_independent_programs() {
    let text = fs::read_to_string(root().join("golden.json")).unwrap();
    let golden: Golden = serde_json::from_str(&text).unwrap();
    assert!(golden.cases.len() >= 58, "all cases");
    let mut faults = Vec::new();
    for case in &golden.cases {
        for (index, (shown, counts)) in emulated(case).iter().enumerate() {
            if let Some(fault) = fault(case, &case.frames[index], shown, counts) {
                faults.push(format!("{} {index}: {fault}", case.name));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
