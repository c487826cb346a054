//! Experiments to break off and to divide: what runs leave behind, compared byte by byte.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use fovqa_testkit::exr_files::{File, Part};
use fovqa_testkit::synthetic::{codes, disturbed};

use crate::fovqa::Folder;
use crate::frames::moving_frames::{MOTION, SIZE, float, motion, moving};
use crate::runs::experiment_folder::bytes;

/// Frames of the sequence: more than the filters of FovVideoVDP reach over, which at 24 frames a second
/// are 6.
pub(crate) const FRAMES: usize = 12;

const HEAD: &str = "name = \"e\"\n[view]\ndisplay = \"htc-vive-pro\"\nbands_deg = [0, 10, 30]\n\
                    [signal]\ntransfer = \"srgb\"\n";

const METHODS: &str = "[[method]]\nname = \"A\"\ntest = \"{scene}/a\"\n\
                       [[method]]\nname = \"B\"\ntest = \"{scene}/b\"\n";

const MOVING: &str = "[[scene]]\nname = \"moving\"\nreference = \"moving/gt\"\nfps = 24\n\
                      gaze = { trace = \"gaze.csv\" }\n";

/// Everything that is measured over time, and some that is not.
const METRICS: &str = "[metrics]\nmse = {}\npsnr = {}\nssim = {}\nfpsnr = {}\npu_psnr = {}\n\
                       rms_contrast = {}\nhaar = { levels = 2 }\nspectrum = { block = 16 }\natd = {}\n\
                       flicker = { frames = 4 }\n";

/// Figures take longer than these frames.
const PLOTS: &str = "[[plot]]\nkind = \"table\"\n";

/// A sequence with motion and depth, two methods and a gaze trace.
pub(crate) fn sequence(padding: &str) -> Folder {
    let folder = Folder::new();
    write_sequence(&folder);
    folder.write(
        "e.toml",
        format!(
            "{HEAD}{MOVING}{METHODS}{METRICS}fvvdp = {{ temp_padding = \"{padding}\" }}\n{PLOTS}"
        ),
    );
    folder
}

pub(crate) fn write_sequence(folder: &Folder) {
    for frame in 0..FRAMES {
        let depth = |x: usize, y: usize| ((x * 7 + y * 3 + frame * frame) % 50) as f32 + 10.0;
        let gt = part(1, frame).with(&motion(MOTION)).with(&[("Z", float(depth))]);
        write(folder, &format!("moving/gt/{frame:04}.exr"), gt);
        write(folder, &format!("moving/a/{frame:04}.exr"), part(2, frame));
        write(folder, &format!("moving/b/{frame:04}.exr"), part(3, frame));
    }
    let rows = (0..FRAMES).map(|frame| format!("{frame},{},{}\n", 20 + frame, 10 + frame / 2));
    folder.write("gaze.csv", format!("frame,x_px,y_px\n{}", rows.collect::<String>()));
}

fn part(seed: usize, frame: usize) -> Part {
    Part::rgb(SIZE, moving(seed, frame * frame))
}

fn write(folder: &Folder, name: &str, part: Part) {
    File::new(vec![part]).write(&folder.path(name));
}

/// The sequence, and another one of two eyes.
pub(crate) fn two_scenes() -> Folder {
    let folder = Folder::new();
    write_sequence(&folder);
    for frame in 0..3 {
        for (seed, eye) in ["left", "right"].into_iter().enumerate() {
            let reference = codes(48, 40, 3, (10 * seed + frame) as u64);
            folder.png(&format!("eyes/{eye}/gt/{frame:04}.png"), 48, 40, &reference);
            for (method, noise) in [("a", 20.0), ("b", 35.0)] {
                let test = disturbed(&reference, noise + frame as f64, 3);
                folder.png(&format!("eyes/{eye}/{method}/{frame:04}.png"), 48, 40, &test);
            }
        }
    }
    let eyes = "[[scene]]\nname = \"eyes\"\nfps = 24\n\
                reference = { left = \"eyes/left/gt\", right = \"eyes/right/gt\" }\n";
    let tests = |method: &str| {
        let [name, upper] = [method.to_owned(), method.to_uppercase()];
        format!(
            "[[method]]\nname = \"{upper}\"\nscenes = [\"moving\"]\ntest = \"moving/{name}\"\n\
             [[method]]\nname = \"{upper}2\"\nscenes = [\"eyes\"]\ntest = \"eyes/{{eye}}/{name}\"\n"
        )
    };
    folder.write(
        "e.toml",
        format!("{HEAD}{MOVING}{eyes}{}{}{METRICS}fvvdp = {{}}\n{PLOTS}", tests("a"), tests("b")),
    );
    folder
}

/// What a run has left, its journal too: nothing tells how it came about.
#[track_caller]
pub(crate) fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = bytes(folder);
    assert!(files.contains_key("journal.jsonl"), "a journal is left");
    files
}

/// Files that differ, by name.
#[track_caller]
pub(crate) fn assert_same(
    found: &BTreeMap<String, Vec<u8>>,
    wanted: &BTreeMap<String, Vec<u8>>,
    of: &str,
) {
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(found), names(wanted), "{of}");
    for (name, bytes) in wanted {
        if found[name] != *bytes {
            let [found, wanted] = [&found[name], bytes].map(|b| String::from_utf8_lossy(b));
            let line = found.lines().zip(wanted.lines()).find(|(found, wanted)| found != wanted);
            panic!("{of}: {name} differs: {line:?}");
        }
    }
}

/// A line of a journal with the checksum that it has to have, where it has one: CRC-32 of what is in front of it.
pub(crate) fn sealed(line: &str) -> String {
    let Some((object, _)) = line.rsplit_once(",\"sum\":\"") else { return line.to_owned() };
    format!("{object},\"sum\":\"{:08x}\"}}\n", crc32fast::hash(object.as_bytes()))
}

/// The journal of a run, line by line.
pub(crate) fn journal(folder: &Folder, results: &str) -> Vec<String> {
    let text = fs::read_to_string(folder.path(&format!("{results}/journal.jsonl"))).unwrap();
    text.split_inclusive('\n').map(str::to_owned).collect()
}
