//! `make bench`: CPU seconds, megapixels a second and peak memory of whole runs of the command,
//! beside decoding alone and beside the peers it finds installed. `cargo bench … -- fvvdp`: of FovVideoVDP
//! alone; `-- emulate`: of emulation alone; `-- gallery`: of the built-in scene; `-- memory`: the peak memory of large runs alone.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot go on has nothing to say")]
#![allow(clippy::print_stdout, reason = "its results")]

mod bench_emulate;
mod bench_memory;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use fovqa_io::{DepthChannels, GuideOptions, MotionChannels, ReadOptions, read_frame};
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::png_files::write8;
use fovqa_testkit::synthetic::{codes, disturbed};
use wait4::Wait4;

/// Runs of each case; the median counts.
const RUNS: usize = 7;

/// This program decoding alone, for comparison: colour, with motion and depth where a file has them and
/// they are of use.
const DECODE: &str = "--decode-only";
const DECODE_ALL: &str = "--decode-all";
const DECODE_COLOUR: &str = "--decode-colour";

/// This program decoding a frame and emulating a method on it.
const EMULATE: &str = "--emulate";

/// This program writing the inputs into a folder.
const MAKE: &str = "--make-inputs";
/// The same for the peak memory of large runs.
const MAKE_LARGE: &str = "--make-large-inputs";

const FOUR_K: (usize, usize) = (3840, 2160);
const FULL_HD: (usize, usize) = (1920, 1080);

const FIDELITY: [&str; 6] =
    ["--fov-vertical", "60", "--metrics", "mse,psnr,ssim,ms-ssim,fpsnr,fssim", "--format", "json"];

const PROFILES: [&str; 6] =
    ["--fov-vertical", "60", "--metrics", "rms-contrast,haar", "--format", "json"];

/// FovVideoVDP, on a display.
const VISIBLE: [&str; 4] = ["--metrics", "fvvdp", "--format", "json"];

/// Metrics that share a pass with no other, with the files they need and what they have to cost at most. The
/// exposures of HDR-FLIP are given, because the picture has no more than three.
const OWN_PASSES: [(&str, &str, &[&str], Option<&str>); 4] = [
    (
        "PNG: FLIP",
        "png",
        &["--metrics", "flip", "--set", "flip.ppd=67"],
        Some("0.15 CPU s, 350 MiB"),
    ),
    (
        "EXR: HDR-FLIP, 10 exposures",
        "exr",
        &[
            "--metrics",
            "hdr-flip",
            "--set",
            "flip.ppd=67",
            "--set",
            "hdr_flip.start=-8",
            "--set",
            "hdr_flip.stop=2",
        ],
        Some("0.80 CPU s, 350 MiB"),
    ),
    ("PNG: FWQI", "png", &["--metrics", "fwqi", "--fov-vertical", "60"], None),
    ("PNG: spectrum", "png", &["--metrics", "spectrum", "--fov-vertical", "60"], None),
];

/// Frames of the sequence, and those that flicker compares.
const FRAMES: usize = 8;
const COMPARED: usize = 4;
const COMPARED_FRAMES: &str = "flicker.frames=4";

/// Size and length of the sequence of FovVideoVDP.
const VGA: (usize, usize) = (640, 480);
const VGA_FRAMES: usize = 16;

/// What a run took.
#[derive(Clone, Copy)]
struct Cost {
    cpu_s: f64,
    wall_s: f64,
    peak_mib: f64,
}

fn run(program: &str, arguments: &[&str]) -> Option<Cost> {
    let start = Instant::now();
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let used = child.wait4().ok()?;
    let cpu = used.rusage.utime + used.rusage.stime;
    used.status.success().then(|| Cost {
        cpu_s: cpu.as_secs_f64(),
        wall_s: start.elapsed().as_secs_f64(),
        peak_mib: used.rusage.maxrss as f64 / f64::from(1 << 20),
    })
}

/// The median of each figure; `None` where the program is not there or fails.
fn measure(program: &str, arguments: &[&str]) -> Option<Cost> {
    let mut costs = (0..RUNS).map(|_| run(program, arguments)).collect::<Option<Vec<_>>>()?;
    let mut median = |figure: fn(&Cost) -> f64| {
        costs.sort_by(|a, b| figure(a).total_cmp(&figure(b)));
        figure(&costs[RUNS / 2])
    };
    Some(Cost {
        cpu_s: median(|c| c.cpu_s),
        wall_s: median(|c| c.wall_s),
        peak_mib: median(|c| c.peak_mib),
    })
}

fn row(name: &str, megapixels: Option<f64>, cost: Option<Cost>, aim: Option<&str>) {
    let Some(cost) = cost else {
        println!("{name:<44} not installed");
        return;
    };
    let speed = megapixels.map(|m| format!("{:.1}", m / cost.cpu_s)).unwrap_or_default();
    let aim = aim.map(|aim| format!("at most {aim}")).unwrap_or_default();
    let Cost { cpu_s, wall_s, peak_mib } = cost;
    let line = format!("{name:<44} {cpu_s:>7.3} {wall_s:>7.3} {speed:>8} {peak_mib:>7.0}   {aim}");
    println!("{}", line.trim_end());
}

/// A committed render, mirrored over a larger frame.
fn enlarged(name: &str, width: usize, height: usize) -> Vec<u8> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("data/small/living-room").join(name);
    let frame = read_frame(&path, &ReadOptions::default()).unwrap().frame;
    let mirrored = |at: usize, side: usize| {
        let at = at % (2 * side);
        if at < side { at } else { 2 * side - 1 - at }
    };
    let mut codes = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        for x in 0..width {
            let (x, y) = (mirrored(x, frame.width()), mirrored(y, frame.height()));
            codes.extend((0..3).map(|c| frame.sample(c, x, y) as u8));
        }
    }
    codes
}

struct Pair {
    paths: [PathBuf; 2],
    megapixels: f64,
}

impl Pair {
    fn new(folder: &Path, ending: &str, width: usize, height: usize) -> Self {
        let path = |name| folder.join(format!("{width}x{height}_{name}.{ending}"));
        Self { paths: ["gt", "rmfr"].map(path), megapixels: (width * height) as f64 / 1e6 }
    }

    fn names(&self) -> [&str; 2] {
        self.paths.each_ref().map(|path| path.to_str().unwrap())
    }
}

/// Writes both pictures of a size, as PNG and as half-float EXR.
fn make(folder: &Path, width: usize, height: usize) {
    let (png, exr) =
        (Pair::new(folder, "png", width, height), Pair::new(folder, "exr", width, height));
    for (index, name) in ["gt.png", "rmfr.png"].into_iter().enumerate() {
        let codes = enlarged(name, width, height);
        write8(&png.paths[index], width, height, &codes);
        let plane = |c: usize| {
            let light = |code: &u8| (f32::from(*code) / 255.0).powf(2.2);
            Values::Half(codes.iter().skip(c).step_by(3).map(light).collect())
        };
        let channels = [("R", plane(0)), ("G", plane(1)), ("B", plane(2))];
        File::new(vec![Part::new((width, height), &channels)]).write(&exr.paths[index]);
    }
}

/// Writes a sequence: references with motion and depth, and tests without.
fn make_sequence(folder: &Path, width: usize, height: usize) {
    let light = |name: &str, c: usize| {
        let codes = enlarged(name, width, height);
        let light = |code: &u8| (f32::from(*code) / 255.0).powf(2.2);
        Values::Half(codes.iter().skip(c).step_by(3).map(light).collect())
    };
    let each = |value: &dyn Fn(f32, f32) -> f32| {
        let at = |i: usize| value((i % width) as f32, (i / width) as f32);
        Values::Half((0..width * height).map(at).collect())
    };
    // A camera that moves forward and turns a little, before a floor.
    let channels = [
        ("R", light("gt.png", 0)),
        ("G", light("gt.png", 1)),
        ("B", light("gt.png", 2)),
        ("Z", each(&|_, y| 3000.0 / (y + 100.0))),
        ("motion.X", each(&|x, y| (x - 1900.0) * 0.004 + y * 0.0003 + 0.37)),
        ("motion.Y", each(&|x, y| (y - 1000.0) * 0.003 + x * 0.0005 - 0.2)),
    ];
    for side in ["gt", "test"] {
        std::fs::create_dir_all(folder.join("sequence").join(side)).unwrap();
    }
    let path = |side: &str, frame: usize, ending: &str| {
        folder.join("sequence").join(side).join(format!("{frame:04}.{ending}"))
    };
    File::new(vec![Part::new((width, height), &channels)]).write(&path("gt", 0, "exr"));
    write8(&path("test", 0, "png"), width, height, &enlarged("rmfr.png", width, height));
    for frame in 1..FRAMES {
        for (side, ending) in [("gt", "exr"), ("test", "png")] {
            std::fs::hard_link(path(side, 0, ending), path(side, frame, ending)).unwrap();
        }
    }
}

/// Differences over time: alone, and what they add to profiles, without the decoding of motion and depth.
fn sequence(folder: &Path) {
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let this = std::env::current_exe().unwrap().display().to_string();
    let [gt, test] =
        ["gt", "test"].map(|side| folder.join("sequence").join(side).display().to_string());
    let [all, colour] = [DECODE_ALL, DECODE_COLOUR].map(|what| measure(&this, &[what, &gt, &test]));
    let score = |metrics: &str| {
        let view = ["--fov-vertical", "60", "--threads", "1", "--format", "json"];
        let more = ["--set", COMPARED_FRAMES, "--metrics", metrics];
        measure(fovqa, &[&["score", &gt, &test][..], &view, &more].concat())
    };
    let (alone, profiles) = (score("atd"), score("rms-contrast,haar"));
    let with_atd = score("rms-contrast,haar,atd");
    let with_flicker = score("rms-contrast,haar,flicker");
    let megapixels = FRAMES as f64 * 8.2944;
    let name = "4K EXR, motion, depth; PNG; 8 frames";
    row(&format!("{name}: decoding"), Some(megapixels), all, None);
    row(&format!("{name}: ATD"), Some(megapixels), alone, None);
    for (label, with, before, aim) in [
        ("ATD", with_atd, 1, Some("0.08")),
        ("flicker of 4 frames", with_flicker, COMPARED - 1, None),
    ] {
        let (Some(all), Some(colour), Some(profiles), Some(with)) = (all, colour, profiles, with)
        else {
            continue;
        };
        let frames = (FRAMES - before) as f64;
        let added = |figure: fn(&Cost) -> f64| {
            (figure(&with) - figure(&profiles)) - (figure(&all) - figure(&colour))
        };
        let added = Cost {
            cpu_s: added(|c| c.cpu_s) / frames,
            wall_s: added(|c| c.wall_s) / frames,
            peak_mib: added(|c| c.peak_mib),
        };
        row(&format!("4K: what {label} adds, per frame"), Some(8.2944), Some(added), aim);
    }
}

/// Writes a sequence whose frames differ by what moves over them.
fn make_video(folder: &Path, (width, height): (usize, usize)) {
    let [gt, test] = ["gt.png", "rmfr.png"].map(|name| enlarged(name, width + VGA_FRAMES, height));
    for (side, codes) in [("gt", gt), ("test", test)] {
        let folder = folder.join("video").join(side);
        std::fs::create_dir_all(&folder).unwrap();
        for frame in 0..VGA_FRAMES {
            let rows = codes.chunks_exact(3 * (width + VGA_FRAMES));
            let moved: Vec<u8> =
                rows.flat_map(|row| &row[3 * frame..3 * (frame + width)]).copied().collect();
            write8(&folder.join(format!("{frame:04}.png")), width, height, &moved);
        }
    }
}

/// FovVideoVDP of stills and sequences, beyond decoding, and its memory.
fn visible_difference(folder: &Path) {
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let this = std::env::current_exe().unwrap().display().to_string();
    let score = |a: &str, b: &str, more: &[&str]| {
        measure(fovqa, &[&["score", a, b][..], &VISIBLE, more].concat())
    };
    for (name, size, display, aim) in [
        ("1080p PNG", FULL_HD, "standard-fhd", Some("0.10 CPU s")),
        ("4K PNG", FOUR_K, "standard-4k", Some("600 MiB")),
    ] {
        let pair = Pair::new(folder, "png", size.0, size.1);
        let [a, b] = pair.names();
        let decode = measure(&this, &[DECODE, a, b]);
        let cost = beyond(score(a, b, &["--display", display]), decode);
        row(&format!("{name}: FovVideoVDP beyond decoding"), Some(pair.megapixels), cost, aim);
    }
    let [a, b] = ["gt", "test"].map(|side| folder.join("video").join(side).display().to_string());
    let decode = measure(&this, &[DECODE_COLOUR, &a, &b]);
    let video = score(&a, &b, &["--display", "standard-fhd", "--fps", "30"]);
    let megapixels = (VGA.0 * VGA.1 * VGA_FRAMES) as f64 / 1e6;
    let name = "640x480 PNG, 16 frames: FovVideoVDP";
    row(name, Some(megapixels), video, Some("0.30 CPU s"));
    row(&format!("{name} beyond"), Some(megapixels), beyond(video, decode), Some("0.20 CPU s"));
    let small = |side: &str| folder.join("small").join(side).display().to_string();
    let (a, b) = (small("gt"), small("a"));
    for (frames, aim) in [("0..30", None), ("0..1000", Some("the MiB of 30 frames"))] {
        let more = ["--display", "standard-fhd", "--fps", "90", "--frames", frames];
        let count = frames.trim_start_matches("0..");
        row(&format!("64x64 PNG, {count} frames: FovVideoVDP"), None, score(&a, &b, &more), aim);
    }
}

/// Metrics that share a pass with no other, beyond decoding.
fn own_passes(folder: &Path) {
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let this = std::env::current_exe().unwrap().display().to_string();
    for (name, ending, arguments, aim) in OWN_PASSES {
        let pair = Pair::new(folder, ending, FULL_HD.0, FULL_HD.1);
        let [a, b] = pair.names();
        let decode = measure(&this, &[DECODE, a, b]);
        let cost = beyond(measure(fovqa, &[&["score", a, b][..], arguments].concat()), decode);
        row(&format!("1080p {name} beyond decoding"), Some(pair.megapixels), cost, aim);
    }
}

/// What a run takes beyond decoding, with the whole of its memory.
fn beyond(score: Option<Cost>, decode: Option<Cost>) -> Option<Cost> {
    let (score, decode) = (score?, decode?);
    let wall_s = score.wall_s - decode.wall_s;
    Some(Cost { cpu_s: score.cpu_s - decode.cpu_s, wall_s, ..score })
}

/// The reference program, where it is installed: a still of the same size.
fn reference_program(pair: &Pair) {
    let [a, b] = pair.names();
    let script = "import sys, pyfvvdp\n\
        from pyfvvdp.utils import load_image_as_array as load\n\
        fv = pyfvvdp.fvvdp(display_name='standard_fhd', heatmap=None, foveated=True)\n\
        fv.predict(load(sys.argv[2]), load(sys.argv[1]), dim_order='HWC')";
    let cost = measure("python3", &["-c", script, a, b]);
    row("1080p PNG: pyfvvdp", Some(pair.megapixels), cost, None);
}

fn compare(name: &str, pair: &Pair, aim: Option<&str>, aim_beyond: Option<&str>) {
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let this = std::env::current_exe().unwrap().display().to_string();
    let [a, b] = pair.names();
    let megapixels = Some(pair.megapixels);
    let decode = measure(&this, &[DECODE, a, b]);
    let score = measure(fovqa, &[&["score", a, b][..], &FIDELITY].concat());
    row(&format!("{name}: decoding alone"), megapixels, decode, None);
    row(&format!("{name}: six metrics, bands"), megapixels, score, aim);
    let beyond = |score: Option<Cost>| {
        let (score, decode) = (score?, decode?);
        Some(Cost {
            cpu_s: score.cpu_s - decode.cpu_s,
            wall_s: score.wall_s - decode.wall_s,
            peak_mib: score.peak_mib - decode.peak_mib,
        })
    };
    row(&format!("{name}: beyond decoding"), megapixels, beyond(score), aim_beyond);
    let profiles = measure(fovqa, &[&["score", a, b][..], &PROFILES].concat());
    let aim = aim_beyond.map(|_| "0.06");
    let what = format!("{name}: what contrast and wavelet add");
    row(&what, megapixels, beyond(profiles), aim);
}

/// Methods of the experiments.
const METHODS: [&str; 4] = ["a", "b", "c", "d"];

/// Writes an experiment of many small frames, and one of a large one: four methods each.
fn make_experiments(folder: &Path) {
    const SIDE: usize = 64;
    let experiment = |name: &str, reference: &str, test: &dyn Fn(&str) -> String| {
        let methods =
            METHODS.map(|m| format!("[[method]]\nname = \"{m}\"\ntest = \"{}\"\n", test(m)));
        let text = format!(
            "name = \"{name}\"\n[view]\nfov_vertical_deg = 60\n[[scene]]\nname = \"s\"\nreference = \"{reference}\"\n{}",
            methods.concat()
        );
        std::fs::write(folder.join(format!("{name}.toml")), text).unwrap();
    };
    experiment("small", "small/gt", &|method| format!("small/{method}"));
    let [gt, test] = Pair::new(folder, "png", FOUR_K.0, FOUR_K.1).paths;
    let path = |path: &Path| path.display().to_string();
    experiment("large", &path(&gt), &|_| path(&test));
    for (index, side) in ["gt"].into_iter().chain(METHODS).enumerate() {
        let side = folder.join("small").join(side);
        std::fs::create_dir_all(&side).unwrap();
        for frame in 0..1000 {
            let codes = codes(SIDE, SIDE, 3, frame);
            let codes = if index == 0 { codes } else { disturbed(&codes, 10.0 * index as f64, 1) };
            write8(&side.join(format!("{frame:04}.png")), SIDE, SIDE, &codes);
        }
    }
}

/// Whole experiments: scoring, hashing, journal, results, figures.
fn experiments(folder: &Path) {
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let path = |name: &str| folder.join(name).display().to_string();
    let cost = |name: &str, more: &[&str]| {
        let (file, output) = (path(&format!("{name}.toml")), path("results"));
        measure(fovqa, &[&["run", &file, "--output", &output], more].concat())
    };
    let all = Some(4000.0 * 0.004_096);
    row("64x64 PNG, 4 methods: 10 frames", None, cost("small", &["--frames", "0..10"]), None);
    row("64x64 PNG, 4 methods: 1,000 frames", all, cost("small", &[]), Some("5 wall s"));
    row("4K PNG, 4 methods: one frame", Some(4.0 * 8.2944), cost("large", &[]), None);
}

fn peers(pair: &Pair) {
    let [a, b] = pair.names();
    for filter in ["psnr", "ssim"] {
        let filter_of = format!("[0][1]{filter}");
        let arguments = ["-i", b, "-i", a, "-lavfi", &filter_of, "-f", "null", "-"];
        row(
            &format!("4K PNG: ffmpeg {filter}"),
            Some(pair.megapixels),
            measure("ffmpeg", &arguments),
            None,
        );
    }
    let script = "import sys; from skimage.io import imread; from skimage.metrics import structural_similarity as s\n\
        s(imread(sys.argv[1]), imread(sys.argv[2]), channel_axis=2, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=255)";
    let cost = measure("python3", &["-c", script, a, b]);
    row("4K PNG: scikit-image SSIM", Some(pair.megapixels), cost, None);
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [DECODE, files @ ..] => {
            for file in files {
                read_frame(Path::new(file), &ReadOptions::default()).unwrap();
            }
        }
        [what @ (DECODE_ALL | DECODE_COLOUR), folders @ ..] => {
            let auto = GuideOptions { motion: MotionChannels::Auto, depth: DepthChannels::Auto };
            let guides = if *what == DECODE_ALL { auto } else { GuideOptions::default() };
            let options = ReadOptions { guides, ..ReadOptions::default() };
            // Pair by pair, as the command does. Folder by folder, the allocator would learn of
            // the sizes of blocks and frames in another order, and return memory it needs again.
            let files = |folder: &&str| {
                let files = std::fs::read_dir(folder).unwrap();
                let mut files: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
                files.sort();
                files
            };
            let sides: Vec<Vec<PathBuf>> = folders.iter().map(files).collect();
            for frame in 0..sides[0].len() {
                for side in &sides {
                    read_frame(&side[frame], &options).unwrap();
                }
            }
        }
        [MAKE, folder] => {
            for (width, height) in [FOUR_K, FULL_HD] {
                make(Path::new(folder), width, height);
            }
            make_experiments(Path::new(folder));
            make_sequence(Path::new(folder), FOUR_K.0, FOUR_K.1);
            make_video(Path::new(folder), VGA);
        }
        [EMULATE, method, applied, file] => {
            bench_emulate::emulate(method, applied, Path::new(file));
        }
        [MAKE_LARGE, folder] => bench_memory::make(Path::new(folder)),
        words if words.contains(&"memory") => large_runs(),
        words if words.contains(&"emulate") => emulation_alone(),
        words if words.contains(&"gallery") => built_in_scene(),
        words => report(words.contains(&"fvvdp")),
    }
}

/// Measures the built-in scene, each case once.
fn built_in_scene() {
    let folder = tempfile::tempdir().unwrap();
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let view = ["--resolution", "1440x1600", "--fov-vertical", "100"];
    println!("\nthe built-in scene, 1440x1600, each case once\n");
    heading("aim");
    let megapixels = Some(1.44 * 1.6);
    let path = |name: &str| folder.path().join(name).display().to_string();
    for (frames, aim) in [("1", Some("20 CPU s")), ("3", Some("the MiB of 1 frame"))] {
        let output = path(frames);
        let what = ["gallery", "--output", &output, "--samples", "16", "--frames", frames];
        let cost = run(fovqa, &[&what[..], &view].concat());
        row(&format!("frames with 16 samples a pixel: {frames}"), megapixels, cost, aim);
    }
    let output = path("rmfr.png");
    let foveate = ["foveate", "builtin:gallery", &output, "--method", "rmfr"];
    let cost = run(fovqa, &[&foveate[..], &view].concat());
    row("RMFR, 340,710 samples, PNG written", megapixels, cost, Some("0.5 CPU s"));
}

/// Measures emulation alone.
fn emulation_alone() {
    let folder = tempfile::tempdir().unwrap();
    let this = std::env::current_exe().unwrap().display().to_string();
    run(&this, &[MAKE, folder.path().to_str().unwrap()]).expect("inputs");
    emulation(&Pair::new(folder.path(), "png", FOUR_K.0, FOUR_K.1));
}

/// Measures emulation of a 4K frame, beside decoding it.
fn emulation(pair: &Pair) {
    let this = std::env::current_exe().unwrap().display().to_string();
    let megapixels = Some((FOUR_K.0 * FOUR_K.1) as f64 / 1e6);
    let [file, _] = pair.names();
    println!("\nemulation of a 4K PNG, with decoding, without writing\n");
    heading("aim");
    let decoding = measure(&this, &[DECODE, file]);
    row("decode alone", megapixels, decoding, None);
    let aim = decoding.map(|cost| format!("{:.3} s (3 x decoding)", 3.0 * cost.cpu_s));
    for method in bench_emulate::PLAIN {
        let cost = measure(&this, &[EMULATE, method, "", file]);
        row(method, megapixels, cost, aim.as_deref());
    }
    let aim = decoding.map(|cost| format!("{:.3} s (2 s and decoding)", 2.0 + cost.cpu_s));
    for [method, applied] in bench_emulate::FILTERED {
        let cost = measure(&this, &[EMULATE, method, applied, file]);
        let name =
            if applied.is_empty() { method.to_owned() } else { format!("{method}, {applied}") };
        row(&name, megapixels, cost, aim.as_deref());
    }
}

/// Measures the peak memory of large runs.
fn large_runs() {
    let folder = tempfile::tempdir().unwrap();
    let this = std::env::current_exe().unwrap().display().to_string();
    run(&this, &[MAKE_LARGE, folder.path().to_str().unwrap()]).expect("inputs");
    println!("\npeak memory of large runs, each run once\n");
    heading("limit");
    bench_memory::memory(folder.path());
}

fn heading(last: &str) {
    println!("{:<44} {:>7} {:>7} {:>8} {:>7}   {last}", "case", "CPU s", "wall s", "Mpx/s", "MiB");
}

/// Measures everything, or FovVideoVDP alone.
fn report(only_visible: bool) {
    let folder = tempfile::tempdir().unwrap();
    // In a process of its own: a child's peak memory counts from that of its parent.
    let this = std::env::current_exe().unwrap().display().to_string();
    run(&this, &[MAKE, folder.path().to_str().unwrap()]).expect("inputs");
    let pair = |ending, (width, height)| Pair::new(folder.path(), ending, width, height);
    let four_k = pair("png", FOUR_K);
    println!(
        "medians of {RUNS} runs of whole processes; Mpx/s: megapixels of a pair a CPU second\n"
    );
    heading("aim");
    if only_visible {
        return visible_difference(folder.path());
    }
    compare("4K PNG", &four_k, Some("0.60 CPU s, 350 MiB"), Some("0.30"));
    compare("1080p PNG", &pair("png", FULL_HD), Some("0.18 CPU s"), None);
    compare("4K EXR, half, ZIP", &pair("exr", FOUR_K), None, None);
    sequence(folder.path());
    visible_difference(folder.path());
    own_passes(folder.path());
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    row("fovqa --version", None, measure(fovqa, &["--version"]), Some("0.010 wall s"));
    experiments(folder.path());
    emulation(&four_k);
    built_in_scene();
    peers(&four_k);
    reference_program(&pair("png", FULL_HD));
    large_runs();
}
