//! Folders, patterns, videos, gaze traces and the temporal filter.

use std::fs;

use fovqa_frame::Samples;
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::synthetic::codes;
use serde_json::{Value, json};

use super::frames::{HEIGHT, WIDTH, with_frame, with_sequence};
use crate::fovqa::Folder;

/// Names of the files in a folder.
fn names(folder: &Folder, name: &str) -> Vec<String> {
    let entries = fs::read_dir(folder.path("").join(name)).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

#[test]
fn folders_globs_and_patterns_are_alike() {
    let folder = with_sequence(3);
    let record = folder.record("gt one --method kfr");
    let frames = record["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 3);
    assert_eq!(frames[2]["frame"], 2);
    assert_eq!(frames[2]["input"], "gt/0002.png");
    assert_eq!(frames[2]["output"], "one/0002.png");
    folder.foveate("gt/*.png two/deeper --method kfr").ok();
    folder.foveate("gt/%04d.png three/ --method kfr").ok();
    assert_eq!(names(&folder, "one"), ["0000.png", "0001.png", "0002.png"]);
    for name in names(&folder, "one") {
        let first = bytes(&folder, &format!("one/{name}"));
        assert_eq!(first, bytes(&folder, &format!("two/deeper/{name}")));
        assert_eq!(first, bytes(&folder, &format!("three/{name}")));
    }
    folder.foveate("gt some --method kfr --frames 1..3:2").ok();
    assert_eq!(names(&folder, "some"), ["0001.png"]);
    // A single frame of a folder fits into a file.
    folder.foveate("gt one.png --method kfr --frames 1..2").ok();
    assert!(bytes(&folder, "one.png") == bytes(&folder, "one/0001.png"));
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = with_sequence(3);
    for (method, input) in [("lafr --filter own", "gt"), ("cps --temporal --enhance 1", "gt")] {
        let arguments = format!("{input} OUT --method {method} --fov-vertical 80 --threads ");
        for threads in ["1", "4"] {
            folder.foveate(&format!("{}{threads}", arguments.replace("OUT", threads))).ok();
        }
        for name in names(&folder, "1") {
            let one = bytes(&folder, &format!("1/{name}"));
            assert_eq!(one, bytes(&folder, &format!("4/{name}")), "{method} {name}");
        }
    }
}

/// A gray video of some bits.
fn video(bits: u32, frames: usize) -> Vec<u8> {
    let colour = if bits == 8 { "mono".to_owned() } else { format!("mono{bits}") };
    let mut bytes =
        format!("YUV4MPEG2 W{WIDTH} H{HEIGHT} F25:1 C{colour} XCOLORRANGE=FULL\n").into_bytes();
    for frame in 0..frames {
        bytes.extend(b"FRAME\n");
        for code in codes(WIDTH, HEIGHT, 1, frame as u64) {
            match bits {
                8 => bytes.push(code),
                _ => bytes.extend((u16::from(code) << (bits - 8)).to_le_bytes()),
            }
        }
    }
    bytes
}

#[test]
fn frames_of_a_video_become_png_files() {
    let folder = Folder::new();
    folder.write("clip.y4m", video(8, 2));
    folder.write("deep.y4m", video(10, 2));
    folder.write("still.y4m", video(8, 1));
    let record = folder.record("clip.y4m out --method full");
    assert_eq!(names(&folder, "out"), ["clip.000000.png", "clip.000001.png"]);
    assert_eq!(record["frames"][1]["input"], "clip.y4m");
    assert_eq!(record["frames"][1]["output"], "out/clip.000001.png");
    let frame = folder.frame("out/clip.000001.png");
    assert_eq!(frame.samples(), &Samples::U8(codes(WIDTH, HEIGHT, 1, 1).into()));
    folder.foveate("deep.y4m deep --method full").ok();
    let frame = folder.frame("deep/deep.000000.png");
    assert!(matches!(frame.samples(), Samples::U16(_)), "more than 8 bits");
    folder.foveate("still.y4m still.png --method full").ok();
    folder.foveate("still.y4m still --method full").ok();
    assert!(bytes(&folder, "still.png") == bytes(&folder, "still/still.000000.png"));
    folder.foveate("still.y4m still.exr --method full").ok();
    assert!(matches!(folder.frame("still.exr").samples(), Samples::F16(_)));
}

#[test]
fn each_frame_has_the_gaze_of_the_trace() {
    let folder = Folder::new();
    for frame in 0..3 {
        folder.png(&format!("gt/{frame}.png"), WIDTH, HEIGHT, &codes(WIDTH, HEIGHT, 3, 7));
    }
    folder.write("gaze.csv", "frame,x_px,y_px\n0,10,12\n1,40.5,30\n2,10,12\n");
    let record = folder.record("gt out --method deamp --gaze gaze.csv");
    let gaze: Vec<&Value> =
        record["frames"].as_array().unwrap().iter().map(|frame| &frame["gaze_px"]).collect();
    assert_eq!(gaze, [&json!([10.0, 12.0]), &json!([40.5, 30.0]), &json!([10.0, 12.0])]);
    let frames = [0, 1, 2].map(|frame| bytes(&folder, &format!("out/{frame}.png")));
    assert_ne!(frames[0], frames[1]);
    assert!(frames[0] == frames[2]);
    // A trace in seconds needs a frame rate; 0.4 s has the last gaze.
    folder.write("seconds.csv", "time_s,x_px,y_px\n0,10,12\n0.4,40.5,30\n");
    let seconds = "gt out --method deamp --gaze seconds.csv";
    folder.foveate(seconds).fails(2, &["--fps"]);
    let record = folder.record(&format!("{seconds} --fps 5"));
    assert_eq!(record["frames"][2]["gaze_px"], json!([40.5, 30.0]));
    // A trace that ends too early.
    folder.write("short.csv", "frame,x_px,y_px\n0,10,12\n1,40.5,30\n");
    let short = "gt out --method deamp --gaze short.csv";
    folder.foveate(short).fails(3, &["--gaze-hold"]);
    let record = folder.record(&format!("{short} --gaze-hold"));
    assert_eq!(record["frames"][2]["gaze_px"], json!([40.5, 30.0]));
}

#[test]
fn a_gaze_outside_the_frame_is_moved_to_its_border_with_one_warning() {
    let folder = with_sequence(2);
    let run = folder.foveate("gt out --method rmfr --gaze=-20,10").ok();
    assert_eq!(run.stderr.matches("outside the frame").count(), 1, "{}", run.stderr);
    folder.foveate("gt edge --method rmfr --gaze=0,10").ok();
    assert!(bytes(&folder, "out/0001.png") == bytes(&folder, "edge/0001.png"));
}

#[test]
fn the_temporal_filter_follows_the_motion() {
    let folder = with_sequence(3);
    let run = folder.foveate("gt still --method taa").ok();
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    run.says(&["warning", "no motion vectors", "--motion"]);
    let plane = |value: f32| Values::Float(vec![value; WIDTH * HEIGHT]);
    for frame in 0..3 {
        let part = Part::new((WIDTH, HEIGHT), &[("mx", plane(3.0)), ("my", plane(-2.0))]);
        File::new(vec![part]).write(&folder.path(&format!("motion/{frame:04}.exr")));
    }
    let moving = "gt moving --method taa --motion mx,my --motion-files motion";
    assert_eq!(folder.foveate(moving).ok().stderr, "");
    assert!(folder.frame("still/0000.png") == folder.frame("gt/0000.png"));
    assert!(folder.frame("moving/0000.png") == folder.frame("gt/0000.png"));
    assert_ne!(bytes(&folder, "still/0001.png"), bytes(&folder, "moving/0001.png"));
    // The same as a filter after a method that changes nothing.
    folder.foveate("gt full --method full --temporal --motion mx,my --motion-files motion").ok();
    assert!(bytes(&folder, "full/0002.png") == bytes(&folder, "moving/0002.png"));
    // All weight on the present frame.
    folder.foveate("gt now --method taa --set taa.alpha=1 --set taa.alpha-max=1").ok();
    assert!(folder.frame("now/0002.png") == folder.frame("gt/0002.png"));
}

#[test]
fn a_single_frame_passes_the_temporal_filter_without_a_word() {
    let folder = with_frame();
    let run = folder.foveate("a.png o.png --method rmfr --temporal").ok();
    assert_eq!(run.stderr, "");
    folder.foveate("a.png p.png --method rmfr").ok();
    assert!(bytes(&folder, "o.png") == bytes(&folder, "p.png"));
}

#[test]
fn frames_that_fail_do_not_stop_the_others() {
    let folder = with_sequence(3);
    folder.write("gt/0001.png", "not a picture");
    let run = folder.foveate("gt out --method rmfr --format json");
    assert_eq!(run.code, 3);
    let record = run.json();
    run.says(&["frame 1", "gt/0001.png"]);
    assert_eq!(record["frames"].as_array().unwrap().len(), 2);
    assert_eq!(record["errors"][0]["frame"], 1);
    assert_eq!(record["errors"][0]["input"], "gt/0001.png");
    assert_eq!(names(&folder, "out"), ["0000.png", "0002.png"]);
}
