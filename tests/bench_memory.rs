//! Peak memory of large runs, each beside its limit: very many methods, a pair at the resolution of the retina,
//! and a long sequence.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use fovqa_testkit::png_files::write8;
use fovqa_testkit::synthetic::{codes, disturbed};

use crate::{Cost, Pair, enlarged, measure, row, run};

const METHODS: usize = 1000;
const SCENES: usize = 10;
/// Side of the frames of many methods and of a long sequence.
const SIDE: usize = 64;
/// The resolution of the retina.
const RETINAL: (usize, usize) = (11_520, 6480);
/// Lengths of the sequence; what the longer takes beyond the shorter is counted per frame.
const FRAMES: [usize; 2] = [200, 2000];

/// Every metric but FovVideoVDP.
const METRICS: &str = "mse,psnr,ssim,ms-ssim,fpsnr,fssim,gmsd,pu-psnr,rms-contrast,haar";

const HEAD: &str = "[view]\nfov_vertical_deg = 60\n";

/// Writes the inputs into a folder.
pub(crate) fn make(folder: &Path) {
    make_many(&folder.join("many"));
    let pair = Pair::new(folder, "png", RETINAL.0, RETINAL.1);
    for (path, name) in pair.paths.iter().zip(["gt.png", "rmfr.png"]) {
        write8(path, RETINAL.0, RETINAL.1, &enlarged(name, RETINAL.0, RETINAL.1));
    }
    make_long(&folder.join("long"));
}

/// A few pictures that the files of all methods and frames are links to; the first is the reference.
fn make_pictures(folder: &Path) -> impl Fn(usize, &Path) {
    const PICTURES: usize = 8;
    fs::create_dir_all(folder).unwrap();
    let path = {
        let folder = folder.to_owned();
        move |nth: usize| folder.join(format!("{nth}.png"))
    };
    let first = codes(SIDE, SIDE, 3, 1);
    write8(&path(0), SIDE, SIDE, &first);
    for nth in 1..PICTURES {
        write8(&path(nth), SIDE, SIDE, &disturbed(&first, 5.0 * nth as f64, 1));
    }
    move |nth, to| {
        let nth = if nth == 0 { 0 } else { 1 + nth % (PICTURES - 1) };
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::hard_link(path(nth), to).unwrap();
    }
}

/// Writes an experiment of many methods and scenes.
fn make_many(folder: &Path) {
    let link = make_pictures(folder);
    let mut text = format!("name = \"many\"\n{HEAD}");
    for scene in 0..SCENES {
        link(0, &folder.join(format!("s{scene}/gt.png")));
        let _ = write!(text, "[[scene]]\nname = \"s{scene}\"\nreference = \"{{scene}}/gt.png\"\n");
        for method in 0..METHODS {
            link(1 + scene + method, &folder.join(format!("s{scene}/m{method}.png")));
        }
    }
    for method in 0..METHODS {
        let _ =
            write!(text, "[[method]]\nname = \"m{method}\"\ntest = \"{{scene}}/m{method}.png\"\n");
    }
    fs::write(folder.join("e.toml"), text).unwrap();
}

/// Writes an experiment of a long sequence.
fn make_long(folder: &Path) {
    let link = make_pictures(folder);
    for frame in 0..FRAMES[1] {
        link(0, &folder.join(format!("gt/{frame:04}.png")));
        link(1 + frame, &folder.join(format!("a/{frame:04}.png")));
    }
    let text = format!(
        "name = \"long\"\n{HEAD}[[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"a\"\ntest = \"a\"\n"
    );
    fs::write(folder.join("e.toml"), text).unwrap();
}

/// Measures each case, the large ones once.
pub(crate) fn memory(folder: &Path) {
    let fovqa = env!("CARGO_BIN_EXE_fovqa-under-test");
    let path = |name: &str| folder.join(name).display().to_string();
    let (many, output) = (path("many/e.toml"), path("many-results"));
    let name = format!("64x64 PNG, {METHODS} methods x {SCENES} scenes");
    let limit = Some("500 MiB");
    row(&format!("{name}: run"), None, run(fovqa, &["run", &many, "--output", &output]), limit);
    row(&format!("{name}: report"), None, run(fovqa, &["report", &output]), limit);

    let pair = Pair::new(folder, "png", RETINAL.0, RETINAL.1);
    let [a, b] = pair.names();
    let view = ["--display", "standard-4k", "--threads", "2", "--format", "json"];
    let cost = run(fovqa, &[&["score", a, b, "--metrics", METRICS][..], &view].concat());
    row("11520x6480 PNG: all but FovVideoVDP", Some(pair.megapixels), cost, Some("1,716 MiB"));

    let (long, output) = (path("long/e.toml"), path("long-results"));
    let costs = FRAMES.map(|frames| {
        let frames = format!("0..{frames}");
        let arguments = ["run", &long, "--output", &output, "--threads", "2", "--frames", &frames];
        // The difference is small: a single run of each could be off by as much.
        measure(fovqa, &arguments)
    });
    for (frames, cost) in FRAMES.iter().zip(costs) {
        row(&format!("64x64 PNG, {frames} frames: run"), None, cost, None);
    }
    if let [Some(short), Some(long)] = costs {
        let frames = (FRAMES[1] - FRAMES[0]) as f64;
        let per_frame = |figure: fn(&Cost) -> f64| (figure(&long) - figure(&short)) / frames;
        let kib = per_frame(|cost| cost.peak_mib) * 1024.0;
        println!("{:<44} {kib:>33.2} KiB   at most 1.00 KiB", "64x64 PNG: memory per frame");
    }
}
