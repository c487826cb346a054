//! CPU seconds of every method on a 4K frame, beside decoding the frame's PNG: `cargo run --release
//! --example cpu_time [METHOD…]`. Of each figure the median of several runs; Linux alone.
//!
//! | column | what |
//! | --- | --- |
//! | setup | preparing an emulator: once for all frames of one gaze |
//! | frame | emulation of one frame, from codes of 8 bits to codes of 8 bits |
//! | sum | both: what a frame with a gaze of its own takes |

#![allow(clippy::unwrap_used, reason = "a measurement that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "its results")]

use std::fs;

use fovqa_emulate::{EmulationSpec, Emulator, FilterChoice, History, Picture};
use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables};
use fovqa_io::{ReadOptions, png_rgb8, read_frame};
use fovqa_vision::ViewSpec;

const SIZE: [usize; 2] = [3840, 2160];
const GAZE_PX: [f64; 2] = [1920.0, 1080.0];
const FOV_VERTICAL_DEG: f64 = 60.0;

/// Runs of each method.
const RUNS: usize = 9;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let frame = frame();
    let decode_s = decoding(&frame);
    println!("decoding the PNG: {decode_s:.3} s of CPU time");
    println!("{:28} setup   frame     sum   sum / decoding", "");
    for (name, spec) in specs() {
        if !asked.is_empty() && !asked.iter().any(|asked| *asked == spec.key().replace('_', "-")) {
            continue;
        }
        let [setup_s, frame_s] = emulation(&spec, &frame);
        let sum_s = setup_s + frame_s;
        let ratio = sum_s / decode_s;
        println!("{name:26} {setup_s:7.3} {frame_s:7.3} {sum_s:7.3} {ratio:8.2}");
    }
}

/// Every method; those with filters of their own with these too; temporal filter and enhancement.
fn specs() -> Vec<(String, EmulationSpec)> {
    let mut specs = Vec::new();
    for info in EmulationSpec::methods() {
        let name = info.key.replace('_', "-");
        let spec = EmulationSpec::new(&name).unwrap();
        let mut filtered = spec.clone();
        let has_filters = filtered.set_filters(FilterChoice::Own).is_ok();
        specs.push((name.clone(), spec));
        if has_filters {
            specs.push((format!("{name}, own filters"), filtered));
        }
    }
    let mut spec = EmulationSpec::new("cps").unwrap();
    spec.set_temporal(true);
    specs.push(("cps, temporal filter".to_owned(), spec));
    let mut spec = EmulationSpec::new("full").unwrap();
    spec.set_enhance(1.0).unwrap();
    specs.push(("full, enhancement".to_owned(), spec));
    specs
}

/// Smooth colours with a texture on them.
fn frame() -> Frame {
    let [width, height] = SIZE;
    let code = |i: usize| {
        let (x, y, c) = (i / 3 % width, i / 3 / width, i % 3);
        let smooth = (x + y * (c + 1)) / 16 % 192;
        let noise = (i as u32).wrapping_mul(2_654_435_761) >> 28;
        (smooth + noise as usize + 40 * usize::from(x / 5 % 2 == y / 7 % 2)) as u8
    };
    let codes = (0..width * height * 3).map(code).collect();
    Frame::new(width, height, Channels::Rgb, Samples::U8(codes)).unwrap()
}

fn decoding(frame: &Frame) -> f64 {
    let Samples::U8(codes) = frame.samples() else { panic!("codes of 8 bits") };
    let path = std::env::temp_dir().join(format!("fovqa-cpu-time-{}.png", std::process::id()));
    fs::write(&path, png_rgb8(SIZE[0], SIZE[1], codes).unwrap()).unwrap();
    let times =
        (0..RUNS).map(|_| cpu_s_of(|| read_frame(&path, &ReadOptions::default()).unwrap()).0);
    let time = median(times.collect());
    fs::remove_file(&path).unwrap();
    time
}

/// CPU seconds of the setup and of a frame; with the temporal filter, of the second one.
fn emulation(spec: &EmulationSpec, frame: &Frame) -> [f64; 2] {
    let fov = ViewSpec::Fov { horizontal_deg: None, vertical_deg: Some(FOV_VERTICAL_DEG) };
    let view = fov.resolve(SIZE[0], SIZE[1]).unwrap().view;
    let tables = SignalTables::new(SignalParams::default());
    let (mut setups, mut frames) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        let (setup_s, emulator) =
            cpu_s_of(|| Emulator::new(spec, SIZE, Some(&view), GAZE_PX).unwrap());
        let mut history = History::default();
        let mut next = || {
            let picture = Picture::from_frame(frame, &tables);
            emulator.emulate_next(&picture, None, &mut history).unwrap().to_codes8()
        };
        let (frame_s, _) = if spec.is_temporal() {
            next();
            cpu_s_of(next)
        } else {
            cpu_s_of(|| emulator.emulate_codes8(frame, &tables).unwrap())
        };
        setups.push(setup_s);
        frames.push(frame_s);
    }
    [median(setups), median(frames)]
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The CPU seconds of all threads that something takes, and what it gives.
fn cpu_s_of<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let before = cpu_s();
    let result = work();
    (cpu_s() - before, result)
}

/// CPU seconds of the threads of this process up to now; the scheduler counts them in nanoseconds.
fn cpu_s() -> f64 {
    let of_task = |task: fs::DirEntry| -> Option<f64> {
        let text = fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse().ok()
    };
    // A thread that gives way is counted up to now.
    std::thread::sleep(std::time::Duration::from_micros(200));
    let tasks = fs::read_dir("/proc/self/task").unwrap();
    tasks.flatten().filter_map(of_task).sum::<f64>() * 1e-9
}
