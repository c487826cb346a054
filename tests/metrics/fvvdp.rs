//! FovVideoVDP and PU-PSNR through the command: golden values, results in every form, heat maps, displays,
//! absolute light.

#![allow(
    clippy::float_cmp,
    reason = "the same number in several forms is the same to the last bit"
)]

use std::fs;
use std::path::Path;

use fovqa_frame::{Channels, Frame, Samples};
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::fvvdp_golden::{Fixation, FvvdpCase, Golden};
use fovqa_testkit::png_files::{write8, write16};
use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

#[cfg(target_os = "linux")]
use crate::fovqa::peak_kb;
use crate::fovqa::{Folder, Run, command, root, shared};

/// Required is 0.01; the reference program's own rounding is 1e-4.
const JOD: f64 = 3e-4;

pub(crate) const HEADSET: [&str; 4] = ["--metrics", "fvvdp", "--display", "htc-vive-pro"];

fn jod(json: &Value) -> f64 {
    json["sequence"]["fvvdp"]["jod"].as_f64().unwrap()
}

/// A sequence of `gt/` and `test/`, each frame of its own noise.
pub(crate) fn sequence(frames: usize, size: (usize, usize)) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let reference = codes(size.0, size.1, 3, 1 + frame as u64 / 2);
        folder.png(&format!("gt/{frame:04}.png"), size.0, size.1, &reference);
        let test = disturbed(&reference, 40.0, frame as u64);
        folder.png(&format!("test/{frame:04}.png"), size.0, size.1, &test);
    }
    folder
}

fn write_frame(folder: &Folder, name: &str, frame: &Frame) {
    let (width, height) = frame.file_size();
    let Samples::U8(codes) = frame.samples() else { panic!("8 bits") };
    let rgb: Vec<u8> = match frame.channels() {
        Channels::Rgb => codes.to_vec(),
        Channels::Gray => codes.iter().flat_map(|code| [*code; 3]).collect(),
    };
    write8(&folder.path(name), width, height, &rgb);
}

/// The arguments of a case after its files.
fn arguments(case: &FvvdpCase, folder: &Folder) -> Vec<String> {
    let mut arguments: Vec<String> =
        ["--metrics", "fvvdp", "--display", &case.display].map(str::to_owned).into();
    arguments.extend(["--set".to_owned(), format!("fvvdp.foveated={}", case.foveated)]);
    if let Some(padding) = &case.temp_padding {
        arguments.extend(["--set".to_owned(), format!("fvvdp.temp_padding={padding}")]);
    }
    if let Some(fps) = case.fps.filter(|_| case.n_frames > 1) {
        arguments.extend(["--fps".to_owned(), fps.to_string()]);
    }
    let gaze = |[x, y]: [f64; 2]| format!("{x},{y}");
    if let Some(Fixation::Trace(pixels)) = &case.fixation {
        let rows = (0..pixels.len()).map(|f| format!("{f},{}\n", gaze(case.gaze_px(f))));
        folder.write("gaze.csv", format!("frame,x_px,y_px\n{}", rows.collect::<String>()));
        arguments.extend(["--gaze".to_owned(), "gaze.csv".to_owned()]);
    } else {
        arguments.extend(["--gaze".to_owned(), gaze(case.gaze_px(0))]);
    }
    arguments
}

#[test]
fn committed_cases_of_the_reference_program() {
    let golden = Golden::read(&root().join("tests/golden/fvvdp"));
    let whole = golden.cases.iter().filter(|case| case.photometry.is_none());
    for case in whole {
        let folder = Folder::new();
        for (side, frames) in ["gt", "test"].into_iter().zip(golden.frames(case)) {
            for (index, frame) in frames.iter().enumerate() {
                write_frame(&folder, &format!("{side}/{index:04}.png"), frame);
            }
        }
        let arguments = arguments(case, &folder);
        let more: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let json = folder.json(&[&["gt", "test"][..], &more].concat());
        let found = jod(&json);
        // A gray picture and one of three equal channels differ by the weights' last digit.
        assert!((found - case.jod).abs() <= JOD, "{}: {found} for {}", case.id, case.jod);
        assert_eq!(json["frames"].as_array().unwrap().len(), case.n_frames);
    }
}

#[test]
fn all_cases_the_command_can_score() {
    let Some(folder) = shared("golden/fvvdp") else { return };
    let cases: Vec<Value> =
        serde_json::from_str(&fs::read_to_string(folder.join("cases.json")).unwrap()).unwrap();
    assert!(cases.len() > 60);
    for case in cases.iter().filter(|case| case["n_frames"] == 1) {
        let file = |key: &str| folder.join(case[key].as_str().unwrap()).display().to_string();
        let at = |i: usize| match case["fixation"][i].as_f64() {
            Some(pixel) => pixel + 0.5,
            None => (case[["width", "height"][i]].as_u64().unwrap() / 2) as f64 + 0.5,
        };
        let (gaze, foveated) =
            (format!("{},{}", at(0), at(1)), format!("fvvdp.foveated={}", case["foveated"]));
        let display = case["display"].as_str().unwrap();
        let (reference, test) = (file("reference"), file("test"));
        let arguments = ["score", &reference, &test, "--display", display, "--gaze", &gaze];
        let metric = ["--metrics", "fvvdp", "--set", &foveated, "--format", "json"];
        let run = Run::from(command(&[&arguments[..], &metric].concat()).output().unwrap());
        let found = jod(&run.ok().json());
        let wanted = case["jod"].as_f64().unwrap();
        assert!((found - wanted).abs() <= JOD, "{}: {found} for {wanted}", case["id"]);
    }
}

#[test]
fn json_tells_the_sequence_its_frames_and_their_bands() {
    let folder = sequence(4, (96, 80));
    let bands = ["--bands", "0,10,30", "--fps", "72"];
    let json = folder.json(&[&["gt", "test"][..], &HEADSET, &bands].concat());
    let all = &json["sequence"]["fvvdp"];
    assert_eq!((all["frames"].clone(), all["foveated"].clone()), (4.into(), true.into()));
    assert_eq!((all["peak_cd_m2"].clone(), all["fps"].clone()), (133.3.into(), 72.0.into()));
    let frames = json["frames"].as_array().unwrap();
    let q = |frame: &Value| frame["fvvdp"]["q"].as_f64().unwrap();
    let mean = frames.iter().map(q).sum::<f64>() / 4.0;
    assert!((all["q"].as_f64().unwrap() - mean).abs() < 1e-9 * mean);
    // 10 - a Q^b, of the mean.
    let jod_of = |q: f64| 10.0 - 0.016_171_3 * q.powf(10f64.powf(-0.2280));
    assert!((jod(&json) - jod_of(mean)).abs() < 1e-9);
    for frame in frames {
        let found = frame["fvvdp"]["frame_jod"].as_f64().unwrap();
        assert!((found - jod_of(q(frame))).abs() < 1e-9);
        assert!(frame["metrics"].get("fvvdp").is_none(), "a frame has no JOD of the sequence");
        let shares = frame["bands"].as_array().unwrap().iter();
        let inside: f64 = shares.map(|band| band["fvvdp_share"].as_f64().unwrap()).sum();
        assert!(inside > 0.1 && inside < 1.0, "some lies outside of explicit bands: {inside}");
    }
    let bands = all["spatial_bands"].as_array().unwrap();
    assert!((bands[0]["cpd"].as_f64().unwrap() - 6.576_631).abs() < 1e-5);
    for (index, band) in bands.iter().enumerate() {
        for channel in ["sustained", "transient"] {
            let of =
                |frame: &Value| frame["fvvdp"]["spatial_bands"][index][channel].as_f64().unwrap();
            let mean = frames.iter().map(of).sum::<f64>() / 4.0;
            assert!((band[channel].as_f64().unwrap() - mean).abs() <= 1e-9 * mean);
        }
    }
    let shares = all["shares"].as_array().unwrap().iter();
    let inside: f64 = shares.map(|band| band["share"].as_f64().unwrap()).sum();
    assert!((inside + all["share_outside_bands"].as_f64().unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn csv_and_table_tell_the_same() {
    let folder = sequence(2, (64, 48));
    let arguments = [&["gt", "test"][..], &HEADSET, &["--fps", "30"]].concat();
    let json = folder.json(&arguments);
    let csv = folder.score(&[&arguments[..], &["--format", "csv"]].concat()).ok().stdout;
    let value = |start: &str| -> f64 {
        let line = csv
            .lines()
            .find(|line| line.starts_with(start))
            .unwrap_or_else(|| panic!("{start} in {csv}"));
        line.rsplit(',').next().unwrap().parse().unwrap()
    };
    assert_eq!(value(",,,,,pair,fvvdp,jod,"), jod(&json));
    let frame = &json["frames"][1]["fvvdp"];
    assert_eq!(value(",,,,1,pair,fvvdp,frame_jod,,,"), frame["frame_jod"].as_f64().unwrap());
    assert_eq!(value(",,,,1,pair,fvvdp,q,,,"), frame["q"].as_f64().unwrap());
    let transient = &frame["spatial_bands"][0]["transient"];
    assert_eq!(value(",,,,1,pair,fvvdp,q_transient,1,,"), transient.as_f64().unwrap());
    let share = &json["frames"][1]["bands"][0]["fvvdp_share"];
    assert_eq!(value(",,,,1,pair,fvvdp,share,,0.0,5.0"), share.as_f64().unwrap());
    let table = folder.score(&arguments).ok().stdout;
    let line = format!("FovVideoVDP: {:.3} JOD", jod(&json));
    assert!(table.contains(&line) && table.contains("FovVideoVDP share"), "{table}");
}

#[test]
fn identical_pictures_are_ten_and_without_shares() {
    let folder = sequence(3, (48, 40));
    let more = ["--fps", "30", "--metrics", "fvvdp,pu-psnr", "--display", "htc-vive-pro"];
    let json = folder.json(&[&["gt", "gt"][..], &more].concat());
    assert_eq!(jod(&json), 10.0);
    assert_eq!(json["sequence"]["fvvdp"]["q"], 0.0);
    assert_eq!(json["frames"][0]["bands"][0]["fvvdp_share"], Value::Null);
    assert_eq!(json["frames"][2]["metrics"]["pu_psnr"], "inf");
    assert_eq!(json["summary"]["pu_psnr"]["identical_frames"], 3);
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let folder = sequence(3, (200, 150));
    let run = |threads: &str| {
        let more = ["--fps", "90", "--format", "json", "--threads", threads, "--maps", threads];
        folder.score(&[&["gt", "test"][..], &HEADSET, &more].concat()).ok().stdout
    };
    assert_eq!(run("1"), run("8"));
    let files = |name: &str| fs::read(folder.path(name)).unwrap();
    for map in ["fvvdp-0002.exr", "fvvdp-threshold-0002.png", "fvvdp-supra-threshold-0002.png"] {
        assert_eq!(files(&format!("1/{map}")), files(&format!("8/{map}")), "{map}");
    }
}

#[test]
fn a_heat_map_shows_where_pictures_differ() {
    let (width, height) = (128, 96);
    let folder = Folder::new();
    let reference = codes(width, height, 3, 1);
    let mut test = reference.clone();
    for y in 30..60 {
        let row = 3 * (y * width + 80)..3 * (y * width + 110);
        for (index, code) in test[row].iter_mut().enumerate() {
            *code = code.wrapping_add(if index % 7 < 3 { 60 } else { 200 });
        }
    }
    folder.png("gt.png", width, height, &reference);
    folder.png("test.png", width, height, &test);
    folder.score(&[&["gt.png", "test.png"][..], &HEADSET, &["--maps", "maps"]].concat()).ok();
    let map = fovqa_io::read_frame(
        &folder.path("maps/fvvdp-0000.exr"),
        &fovqa_io::ReadOptions::default(),
    );
    let map = map.unwrap().frame;
    assert_eq!((map.width(), map.height(), map.channels()), (width, height, Channels::Gray));
    let mean = |xs: std::ops::Range<usize>, ys: std::ops::Range<usize>| {
        let sum: f32 = ys
            .clone()
            .flat_map(|y| xs.clone().map(move |x| (x, y)))
            .map(|(x, y)| map.sample(0, x, y))
            .sum();
        sum / (xs.len() * ys.len()) as f32
    };
    let (here, far) = (mean(85..105, 35..55), mean(0..40, 0..40));
    assert!(here > 0.3 && far < 0.05 * here, "{here} and {far}");
    // Coloured: red above the threshold, blue below.
    let colour = |name: &str, x: usize, y: usize| {
        let path = folder.path(&format!("maps/fvvdp-{name}-0000.png"));
        let frame = fovqa_io::read_frame(&path, &fovqa_io::ReadOptions::default()).unwrap().frame;
        [0, 1, 2].map(|c| frame.sample(c, x, y))
    };
    let [r, _, b] = colour("threshold", 10, 10);
    assert!(b > 2.0 * r, "blue where nothing differs");
    let [r, g, b] = colour("supra-threshold", 10, 10);
    assert!(g > 2.0 * r && b > 2.0 * r, "cyan where nothing differs");
    let reference = ["--set", "fvvdp.map_context=reference", "--maps", "other"];
    folder.score(&[&["gt.png", "test.png"][..], &HEADSET, &reference].concat()).ok();
    let raw =
        |folder_of: &str| fs::read(folder.path(&format!("{folder_of}/fvvdp-0000.exr"))).unwrap();
    assert_eq!(raw("maps"), raw("other"), "the context is of the coloured ones alone");
    let coloured =
        |of: &str| fs::read(folder.path(&format!("{of}/fvvdp-threshold-0000.png"))).unwrap();
    assert_ne!(coloured("maps"), coloured("other"));
}

/// R, G and B of light that varies, in units.
fn light(path: &Path, scale: f32, noise: f32) {
    let value = |x: usize, y: usize| {
        let wave = ((x as f32 * 0.4).sin() + (y as f32 * 0.3).cos() + 2.2) * 20.0;
        (wave + noise * ((x * 7 + y * 13) % 5) as f32) * scale
    };
    let size = (64, 48);
    let plane: Vec<f32> = (0..size.0 * size.1).map(|i| value(i % size.0, i / size.0)).collect();
    let float = Values::Float(plane);
    let channels = [("R", float.clone()), ("G", float.clone()), ("B", float)];
    File::new(vec![Part::new(size, &channels)]).write(path);
}

#[test]
fn absolute_light_in_any_unit_and_encoding() {
    let folder = Folder::new();
    for (name, scale, noise) in
        [("gt", 1.0, 0.0), ("test", 1.0, 25.0), ("gt100", 0.01, 0.0), ("test100", 0.01, 25.0)]
    {
        light(&folder.path(&format!("{name}.exr")), scale, noise);
    }
    // Looked at directly: the pattern is fine.
    let metrics = ["--metrics", "fvvdp,pu-psnr", "--set", "fvvdp.foveated=false", "--display"];
    let linear = [&metrics[..], &["standard-hdr-linear"]].concat();
    let nits = folder.json(&[&["gt.exr", "test.exr"][..], &linear].concat());
    assert!(jod(&nits) < 9.9, "{}", jod(&nits));
    let unit = ["--set", "fvvdp.cd_m2_per_unit=100"];
    let scaled = folder.json(&[&["gt100.exr", "test100.exr"][..], &linear, &unit].concat());
    assert!((jod(&scaled) - jod(&nits)).abs() < 1e-4);
    let pu = |json: &Value| json["frames"][0]["metrics"]["pu_psnr"].as_f64().unwrap();
    assert!((pu(&scaled) - pu(&nits)).abs() < 1e-3);
    // A scene's values are too dark to be cd/m², and that is said.
    let run = folder.score(&[&["gt100.exr", "test100.exr"][..], &linear].concat()).ok();
    run.says(&["no pixel of the reference is brighter than 1 cd/m²", "fvvdp.cd_m2_per_unit"]);
    let run = folder.score(&[&["gt.exr", "test.exr"][..], &linear].concat()).ok();
    assert!(!run.stderr.contains("brighter"), "{}", run.stderr);

    // The same light as PQ codes of 16 bits, on the same display with a PQ input.
    for name in ["gt", "test"] {
        let path = folder.path(&format!("{name}.exr"));
        let frame = fovqa_io::read_frame(&path, &fovqa_io::ReadOptions::default()).unwrap().frame;
        let code = |cd_m2: f32| {
            let power = (f64::from(cd_m2) / 10_000.0).powf(2610.0 / 16384.0);
            let (c1, c2, c3) = (3424.0 / 4096.0, 2413.0 / 128.0, 2392.0 / 128.0);
            let encoded = ((c1 + c2 * power) / (1.0 + c3 * power)).powf(2523.0 / 32.0);
            (encoded * 65535.0).round() as u16
        };
        let codes: Vec<u16> = (0..64 * 48)
            .flat_map(|i| [0, 1, 2].map(|c| code(frame.sample(c, i % 64, i / 64))))
            .collect();
        write16(&folder.path(&format!("{name}.png")), 64, 48, &codes);
    }
    let pq = [&metrics[..], &["standard-hdr-pq"]].concat();
    for transfer in ["auto", "pq"] {
        let more = ["--transfer", transfer];
        let found = folder.json(&[&["gt.png", "test.png"][..], &pq, &more].concat());
        assert!((jod(&found) - jod(&nits)).abs() < 2e-3, "{} for {}", jod(&found), jod(&nits));
        assert!((pu(&found) - pu(&nits)).abs() < 0.01);
    }
}

#[test]
fn a_scene_is_shown_as_it_is_tone_mapped() {
    let folder = Folder::new();
    let reference = codes(48, 40, 3, 1);
    let test = disturbed(&reference, 30.0, 2);
    for (name, codes) in [("gt", &reference), ("test", &test)] {
        folder.png(&format!("{name}.png"), 48, 40, codes);
        let plane = |c: usize| {
            let decode = |code: &u8| {
                let v = f32::from(*code) / 255.0;
                (if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }) / 4.0
            };
            Values::Float(codes.iter().skip(c).step_by(3).map(decode).collect())
        };
        let channels = [("R", plane(0)), ("G", plane(1)), ("B", plane(2))];
        File::new(vec![Part::new((48, 40), &channels)]).write(&folder.path(&format!("{name}.exr")));
    }
    let metrics = ["--metrics", "fvvdp,pu-psnr", "--display", "standard-fhd"];
    let encoded = folder.json(&[&["gt.png", "test.png"][..], &metrics].concat());
    let exposed =
        folder.json(&[&["gt.exr", "test.exr"][..], &metrics, &["--exposure", "2"]].concat());
    assert!((jod(&encoded) - jod(&exposed)).abs() < 1e-4);
    let mixed =
        folder.json(&[&["gt.exr", "test.png"][..], &metrics, &["--exposure", "2"]].concat());
    assert!((jod(&encoded) - jod(&mixed)).abs() < 1e-4);
    let darker = folder.json(&[&["gt.exr", "test.exr"][..], &metrics].concat());
    assert!((jod(&encoded) - jod(&darker)).abs() > 0.01, "exposure counts");
}

#[test]
fn photometry_by_hand_is_that_of_a_preset() {
    let folder = sequence(1, (96, 54));
    let of = |more: &[&str]| {
        jod(&folder.json(&[&["gt", "test", "--metrics", "fvvdp"][..], more].concat()))
    };
    let preset = of(&["--display", "standard-4k"]);
    let by_hand = "peak_cd_m2=200,contrast=1000,ambient-lux=250,eotf=srgb,reflectivity=0.005";
    assert_eq!(of(&["--display", "standard-4k", "--luminance", by_hand]), preset);
    assert!(of(&["--display", "sdr-4k-30", "--luminance", "standard-4k"]) < 10.0);
    let other = of(&["--display", "standard-4k", "--luminance", "peak_cd_m2=20"]);
    assert!((other - preset).abs() > 0.01, "a dim display shows less");
    // Any way to give a view has a geometry: 38.68° on this screen with its own pixels.
    let fov = of(&["--fov-vertical", "38", "--luminance", "standard-4k"]);
    assert!(fov < 10.0);
}

#[test]
fn an_experiment_scores_methods_scenes_and_both_eyes() {
    let folder = sequence(3, (96, 80));
    for (name, seed) in [("left", 1), ("right", 2)] {
        let reference = codes(64, 48, 3, seed);
        folder.png(&format!("{name}_gt.png"), 64, 48, &reference);
        folder.png(
            &format!("{name}_test.png"),
            64,
            48,
            &disturbed(&reference, 30.0 * seed as f64, 9),
        );
    }
    let text = r#"
name = "e"
[view]
fov_vertical_deg = 90
luminance = { peak_cd_m2 = 120, min_cd_m2 = 0.05 }
[[scene]]
name = "video"
reference = "gt"
fps = 90
[[scene]]
name = "eyes"
reference = { left = "left_gt.png", right = "right_gt.png" }
[[method]]
name = "A"
test = "test"
scenes = ["video"]
[[method]]
name = "same"
test = "gt"
scenes = ["video"]
[[method]]
name = "both"
test = "{eye}_test.png"
scenes = ["eyes"]
[metrics]
fvvdp = { foveated = true }
pu_psnr = {}
"#;
    folder.write("e.toml", text);
    let run = folder.run(&["run", "e.toml", "--output", "out", "--maps", "maps"]).ok();
    assert!(run.stdout.contains("FovVideoVDP (JOD)"), "{}", run.stdout);
    let summary: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("out/summary.json")).unwrap())
            .unwrap();
    let of = |method: &str, eye: &str| {
        let all = summary["comparisons"].as_array().unwrap();
        let found = all.iter().find(|c| c["method"] == method && c["eye"] == eye).unwrap();
        found["fvvdp"]["jod"].as_f64().unwrap()
    };
    assert_eq!(of("same", ""), 10.0);
    // As alone: what several tests share is not computed otherwise.
    let alone =
        ["--fov-vertical", "90", "--luminance", "peak_cd_m2=120,min_cd_m2=0.05", "--fps", "90"];
    let alone = folder.json(&[&["gt", "test", "--metrics", "fvvdp"][..], &alone].concat());
    assert_eq!(of("A", ""), jod(&alone));
    assert_eq!(of("both", "both"), f64::midpoint(of("both", "left"), of("both", "right")));
    let csv = fs::read_to_string(folder.path("out/results.csv")).unwrap();
    let row = format!("video,A,,,,pair,fvvdp,jod,,,,{:?}", of("A", ""));
    assert!(csv.lines().any(|line| line == row), "{row}");
    for map in ["video/A/fvvdp-0002.exr", "eyes/both/left/fvvdp-threshold-0000.png"] {
        assert!(folder.path(&format!("maps/{map}")).exists(), "{map}");
    }
    for figure in ["bars-fvvdp.svg", "profile-fvvdp-video.svg", "frames-fvvdp.svg"] {
        let svg = fs::read_to_string(folder.path(&format!("out/plots/{figure}"))).unwrap();
        assert!(svg.contains("FovVideoVDP"), "{figure}");
    }
    let run: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("out/run.json")).unwrap()).unwrap();
    let view = &run["resolved"]["scenes"][0]["eyes"][0]["view"];
    assert_eq!(view["luminance"]["min_cd_m2"], 0.05);
    assert_eq!(run["resolved"]["metrics"]["fvvdp"]["temp_padding"], "replicate");
    folder.run(&["report", "out"]).ok();
}

#[test]
fn a_step_between_frames_is_a_slower_sequence() {
    let folder = sequence(8, (48, 40));
    let run = |more: &[&str]| folder.json(&[&["gt", "test"][..], &HEADSET, more].concat());
    let every = run(&["--frames", "0..:2", "--fps", "60"]);
    assert_eq!(every["sequence"]["fvvdp"]["fps"], 30.0);
    let thinned = Folder::new();
    for side in ["gt", "test"] {
        for frame in 0..4 {
            let from = folder.path(&format!("{side}/{:04}.png", 2 * frame));
            fs::copy(from, thinned.path(&format!("{side}/{frame:04}.png"))).unwrap();
        }
    }
    let own = thinned.json(&[&["gt", "test"][..], &HEADSET, &["--fps", "30"]].concat());
    assert_eq!(jod(&every), jod(&own));
}

#[test]
fn the_picture_in_the_readme_is_drawn_again() {
    let folder = Folder::new();
    let render =
        |name: &str| root().join("tests/data/small/living-room").join(name).display().to_string();
    let (gt, rmfr) = (render("gt.png"), render("rmfr.png"));
    let view = ["--metrics", "fvvdp", "--fov-vertical", "100", "--luminance", "htc-vive-pro"];
    folder.score(&[&[gt.as_str(), &rmfr, "--maps", "maps"][..], &view].concat()).ok();
    let drawn = fs::read(folder.path("maps/fvvdp-threshold-0000.png")).unwrap();
    let committed = fs::read(root().join("docs/fvvdp/threshold.png")).unwrap();
    assert!(drawn == committed, "fovqa score, and copy it");
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_sequence() {
    let folder = sequence(2, (320, 240));
    for frame in 2..400 {
        for side in ["gt", "test"] {
            let from = folder.path(&format!("{side}/{:04}.png", frame % 2));
            fs::hard_link(from, folder.path(&format!("{side}/{frame:04}.png"))).unwrap();
        }
    }
    let peak = |frames: &str| {
        let more = ["--fps", "90", "--threads", "1", "--frames", frames];
        peak_kb(&folder, &[&["score", "gt", "test"][..], &HEADSET, &more].concat())
    };
    let (short, long) = (peak("0..30"), peak("0..400"));
    assert!(long < short + 4_000, "{short} kB for 30 frames, {long} kB for 400");
}
