//! Video as YUV4MPEG2: the values of an independent program, and everything that a file or a pipe can bring.

use std::fs;
use std::io::{Read, Write};
use std::process::{ChildStdin, Stdio};
use std::thread;

use fovqa_frame::source::Source;
use fovqa_io::{SourceOptions, open_source, video_stream};
use serde_json::Value;

use crate::fovqa::{Folder, Run, command};

/// A video of gray frames, each of one code with a ramp on it.
fn video(header: &str, size: (usize, usize), codes: &[u8]) -> Vec<u8> {
    let mut bytes = format!("YUV4MPEG2 W{} H{} Cmono {header}\n", size.0, size.1).into_bytes();
    for code in codes {
        bytes.extend(b"FRAME\n");
        bytes.extend(plane(size, *code));
    }
    bytes
}

fn plane((width, height): (usize, usize), code: u8) -> Vec<u8> {
    (0..width * height).map(|at| code.wrapping_add((at % width) as u8)).collect()
}

const SIZE: (usize, usize) = (24, 16);

/// `a.y4m` of frames, and `b.y4m` of so many that differ from it.
fn videos(frames: u8, others: u8) -> Folder {
    let folder = Folder::new();
    let codes = |from: u8, count: u8| (0..count).map(|at| from + 3 * at).collect::<Vec<u8>>();
    folder.write("a.y4m", video("F30:1", SIZE, &codes(20, frames)));
    folder.write("b.y4m", video("F30:1", SIZE, &codes(28, others)));
    folder
}

/// Runs a command that reads what is written to its standard input.
fn piped(
    folder: &Folder,
    arguments: &[&str],
    write: impl FnOnce(&mut ChildStdin) + Send + 'static,
) -> Run {
    let mut child = command(&[&["score"], arguments].concat())
        .current_dir(folder.path(""))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let writer = thread::spawn(move || write(&mut stdin));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    output.into()
}

/// Writes bytes, as far as anybody reads them.
fn bytes(bytes: Vec<u8>) -> impl FnOnce(&mut ChildStdin) + Send + 'static {
    move |stdin| {
        let _ = stdin.write_all(&bytes);
    }
}

fn file(folder: &Folder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

pub(super) fn psnrs(json: &Value) -> Vec<f64> {
    let frames = json["frames"].as_array().unwrap().iter();
    frames.map(|frame| frame["metrics"]["psnr"].as_f64().unwrap()).collect()
}

fn numbers(json: &Value) -> Vec<i64> {
    let frames = json["frames"].as_array().unwrap().iter();
    frames.map(|frame| frame["frame"].as_i64().unwrap()).collect()
}

#[test]
fn a_pipe_has_the_scores_of_a_file() {
    let folder = videos(4, 4);
    let options = ["--metrics", "psnr,ssim,fpsnr,atd", "--format", "json", "--fov-vertical", "60"];
    let mut from_file = folder.score(&[&["a.y4m", "b.y4m"], &options[..]].concat()).ok().json();
    let run =
        piped(&folder, &[&["a.y4m", "-"], &options[..]].concat(), bytes(file(&folder, "b.y4m")));
    let mut from_pipe = run.ok().json();
    for frame in from_pipe["frames"].as_array_mut().unwrap() {
        assert_eq!(frame["test"].take(), "standard input");
    }
    for frame in from_file["frames"].as_array_mut().unwrap() {
        assert_eq!(frame["test"].take(), "b.y4m");
    }
    assert_eq!(from_pipe, from_file);
    // The reference, too; and any file is a video by its first bytes.
    fs::copy(folder.path("b.y4m"), folder.path("b.bin")).unwrap();
    let arguments = ["-", "b.bin", "--metrics", "psnr", "--format", "json"];
    let run = piped(&folder, &arguments, bytes(file(&folder, "a.y4m"))).ok();
    assert_eq!(psnrs(&run.json()), psnrs(&from_file));
}

#[cfg(target_os = "linux")]
#[test]
fn a_pipe_takes_the_memory_of_a_few_frames() {
    const LARGE: (usize, usize) = (400, 300);
    let folder = Folder::new();
    let peak = |frames: u8| {
        folder.write("gt.y4m", video("F30:1", LARGE, &[20].repeat(frames.into())));
        let mut child = command(&["score", "gt.y4m", "-", "--metrics", "psnr", "--threads", "1"])
            .current_dir(folder.path(""))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let status = format!("/proc/{}/status", child.id());
        let mut peak = 0;
        stdin.write_all(&video("F30:1", LARGE, &[])).unwrap();
        for _ in 0..frames {
            stdin.write_all(b"FRAME\n").unwrap();
            stdin.write_all(&plane(LARGE, 20)).unwrap();
            let text = fs::read_to_string(&status).unwrap_or_default();
            let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
            let kb = line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok());
            peak = peak.max(kb.unwrap_or(0));
        }
        drop(stdin);
        assert!(child.wait().unwrap().success());
        peak
    };
    let (short, long): (u64, u64) = (peak(20), peak(200));
    assert!(short > 0 && long < short + 6_000, "{short} kB for 20 frames, {long} kB for 200");
}

#[test]
fn a_video_is_what_its_frames_are_as_files() {
    /// Each code once a row.
    const WIDE: (usize, usize) = (256, 8);
    let folder = Folder::new();
    let codes = [40, 90, 150, 200];
    folder.write("clip.y4m", video("XCOLORRANGE=FULL", WIDE, &codes));
    for (number, code) in [(7, codes[0]), (8, codes[1]), (10, codes[3])] {
        let gray = plane(WIDE, code);
        let rgb: Vec<u8> = gray.iter().flat_map(|code| [*code; 3]).collect();
        folder.png(&format!("frames/f_{number:04}.png"), WIDE.0, WIDE.1, &rgb);
    }
    // The third has no picture: its place in the video is alone.
    let run = folder.score(&["frames", "clip.y4m", "--metrics", "mse"]);
    run.says(&["clip.y4m, frame 2", "--allow-missing"]);
    let json = folder.json(&["frames", "clip.y4m", "--metrics", "mse", "--allow-missing"]);
    assert_eq!(numbers(&json), [7, 8, 10]);
    assert!(json["frames"].as_array().unwrap().iter().all(|f| f["metrics"]["mse"] == 0.0));
    let json = folder.json(&["clip.y4m", "frames", "--metrics", "mse", "--frames", "8..9"]);
    assert_eq!(numbers(&json), [8]);
    assert_eq!(json["frames"][0]["metrics"]["mse"], 0.0);
}

#[test]
fn a_part_of_a_video_and_a_crop_of_it() {
    let folder = videos(5, 5);
    let all = psnrs(&folder.json(&["a.y4m", "b.y4m", "--metrics", "psnr"]));
    let some = folder.json(&["a.y4m", "b.y4m", "--metrics", "psnr", "--frames", "1..4:2"]);
    assert_eq!((numbers(&some), psnrs(&some)), (vec![1, 3], vec![all[1], all[3]]));
    // A pipe passes over what is not asked for, at its beginning and at its end.
    let arguments = ["a.y4m", "-", "--metrics", "psnr", "--frames", "1..4:2", "--format", "json"];
    let piped = piped(&folder, &arguments, bytes(file(&folder, "b.y4m"))).ok();
    assert_eq!(psnrs(&piped.json()), [all[1], all[3]]);
    let crop = folder.json(&["a.y4m", "b.y4m", "--metrics", "psnr", "--crop", "3,2,10,9"]);
    assert_eq!(psnrs(&crop).len(), 5);
}

#[test]
fn a_cut_video_keeps_its_whole_frames() {
    let folder = videos(5, 5);
    let whole = file(&folder, "b.y4m");
    let frame = SIZE.0 * SIZE.1 + b"FRAME\n".len();
    let header = whole.len() - 5 * frame;
    let arguments = ["a.y4m", "b.y4m", "--metrics", "psnr", "--format", "json"];
    let all = psnrs(&folder.score(&arguments).ok().json());
    let from_pipe = |cut: Vec<u8>| {
        piped(&folder, &["a.y4m", "-", "--metrics", "psnr", "--format", "json"], bytes(cut))
    };
    for (behind, said) in [
        (9, "frame 3: it is cut short: only 3 of 384 bytes are present"),
        (3, "frame 3: it is cut short before its pixels"),
    ] {
        let cut = &whole[..header + 3 * frame + behind];
        folder.write("b.y4m", cut);
        let from_file = folder.score(&arguments);
        let in_file = "b.y4m: its frame 3 is damaged, and no frame after it can be found";
        let in_pipe =
            "standard input is damaged after its first 3 frames, and 1 frame of the other";
        for (end, run) in [(in_file, from_file), (in_pipe, from_pipe(cut.to_vec()))] {
            assert_eq!(run.code, 3, "{}", run.stderr);
            assert_eq!(psnrs(&run.json()), all[..3], "{end} {behind}");
            run.says(&[end, said, "copy or write the video again"]);
        }
        let run = folder.score(&[&arguments[..], &["--allow-missing"]].concat());
        assert_eq!((run.code, psnrs(&run.json())), (3, all[..3].to_vec()));
    }
    // Cut between two frames, it is a shorter video.
    let cut = &whole[..header + 3 * frame];
    folder.write("b.y4m", cut);
    folder
        .score(&arguments)
        .fails(3, &["without a test frame: a.y4m, frames 3, 4", "--allow-missing"]);
    let json = folder.json(&["a.y4m", "b.y4m", "--metrics", "psnr", "--allow-missing"]);
    assert_eq!(psnrs(&json), all[..3]);
    let run = from_pipe(cut.to_vec());
    assert_eq!((run.code, psnrs(&run.json())), (3, all[..3].to_vec()));
    run.says(&["standard input ends after 3 frames, and 2 frames of the other sequence have no"]);
}

#[test]
fn a_pipe_that_is_shorter_or_longer_is_said() {
    let folder = videos(3, 5);
    let long = file(&folder, "b.y4m");
    let run = piped(&folder, &["a.y4m", "-", "--metrics", "psnr"], bytes(long.clone()));
    assert_eq!(run.code, 3);
    let run =
        run.says(&["standard input: it continues after its first 3 frames", "--allow-missing"]);
    assert!(run.stdout.contains("PSNR"), "{}", run.stdout);
    let arguments = ["a.y4m", "-", "--metrics", "psnr", "--allow-missing"];
    piped(&folder, &arguments, bytes(long)).ok().says(&["it continues after its first 3 frames"]);
    let short = video("", SIZE, &[28, 31]);
    let run = piped(&folder, &["a.y4m", "-", "--metrics", "psnr"], bytes(short.clone()));
    assert_eq!(run.code, 3);
    run.says(&[
        "standard input ends after 2 frames, and 1 frame of the other sequence has no partner",
    ]);
    piped(&folder, &arguments, bytes(short)).ok().says(&["1 frame without a partner"]);
}

#[test]
fn what_a_pipe_cannot_do_is_said() {
    let folder = videos(6, 6);
    let b = || bytes(file(&videos(6, 6), "b.y4m"));
    piped(&folder, &["-", "-"], b()).fails(2, &["standard input (-), which can only be read once"]);
    piped(&folder, &["a.y4m", "-"], bytes(Vec::new())).fails(3, &["standard input: it is empty"]);
    let arguments = [
        "a.y4m",
        "-",
        "--metrics",
        "fvvdp",
        "--display",
        "htc-vive-pro",
        "--set",
        "fvvdp.temp_padding=circular",
    ];
    let said = ["FovVideoVDP begins with later frames", "write it to a file first"];
    piped(&folder, &arguments, b()).fails(3, &said);
    let png = bytes(b"\x89PNG\r\n\x1a\n".to_vec());
    piped(&folder, &["a.y4m", "-"], png).fails(3, &["it does not begin with YUV4MPEG2"]);
    folder.write("e.toml", "name = \"e\"\n[[scene]]\nname = \"s\"\nreference = \"-\"\n[[method]]\nname = \"m\"\ntest = \"b.y4m\"\n[metrics]\npsnr = {}\n");
    folder.run(&["run", "e.toml"]).fails(2, &["\"-\" is standard input", "give a file"]);
}

#[test]
fn what_is_no_video_that_is_read_is_said() {
    let folder = videos(2, 2);
    let gray = |header: &str| [header.as_bytes(), b"\nFRAME\n", &plane(SIZE, 20)[..]].concat();
    let cases: [(&str, Vec<u8>, &[&str]); 11] = [
        ("interlaced", gray("YUV4MPEG2 W24 H16 Cmono It"), &["it is interlaced", "bwdif"]),
        (
            "tag",
            gray("YUV4MPEG2 W24 H16 C420p16"),
            &["colour tag is C420p16", "the supported tags are 420, "],
        ),
        ("alpha", gray("YUV4MPEG2 W24 H16 C444alpha"), &["C444alpha, which has alpha"]),
        ("magic", gray("YUV4MPEG W24 H16 Cmono"), &["does not begin with YUV4MPEG2"]),
        (
            "large",
            gray("YUV4MPEG2 W60000 H60000 Cmono"),
            &["60000x60000 pixels", "--max-megapixels"],
        ),
        ("range", gray("YUV4MPEG2 W24 H16 XCOLORRANGE=PC"), &["XCOLORRANGE is \"PC\""]),
        ("empty", Vec::new(), &["it is empty, where a y4m video should begin"]),
        ("no frames", b"YUV4MPEG2 W24 H16 Cmono\n".to_vec(), &["it has a header but no frames"]),
        ("cut header", b"YUV4MPEG2 W24 H1".to_vec(), &["its header is cut short"]),
        ("long header", [b"YUV4MPEG2 X", &[b'x'; 5000][..]].concat(), &["longer than 4096 bytes"]),
        ("binary", vec![0xff; 300], &["does not begin with YUV4MPEG2"]),
    ];
    for (name, bytes, said) in cases {
        folder.write("c.y4m", bytes);
        for run in [folder.score(&["a.y4m", "c.y4m"]), folder.score(&["c.y4m", "a.y4m"])] {
            let run = run.fails(3, &["c.y4m: ", "help: "]);
            assert!(said.iter().all(|said| run.stderr.contains(said)), "{name}: {}", run.stderr);
        }
    }
    folder.run(&["score", "a.y4m", "gone.y4m"]).fails(3, &["gone.y4m"]);
    folder.write("videos_1.y4m", "");
    folder.write("videos_2.y4m", "");
    folder.score(&["videos_%d.y4m", "a.y4m"]).fails(3, &["each video is a sequence of its own"]);
}

#[test]
fn a_frame_that_cannot_be_used_costs_itself_alone() {
    let folder = videos(3, 3);
    // A size that changes: a second header where a frame should begin.
    let mut bytes = video("", SIZE, &[28, 31]);
    bytes.extend(video("", (8, 8), &[1]));
    folder.write("c.y4m", bytes);
    let arguments = ["--metrics", "psnr", "--format", "json"];
    let run = folder.score(&[&["a.y4m", "c.y4m"], &arguments[..]].concat());
    assert_eq!((run.code, psnrs(&run.json()).len()), (3, 2));
    run.says(&["c.y4m, frame 2: another video begins here", "give each video as a separate file"]);
    // A code of more than the tag's bits.
    let mut bytes = b"YUV4MPEG2 W2 H1 Cmono10\n".to_vec();
    for code in [400u16, 1024, 500] {
        bytes.extend(b"FRAME\n");
        bytes.extend([code, 0x0100].map(u16::to_le_bytes).as_flattened());
    }
    folder.write("d.y4m", bytes);
    let run = folder.score(&[&["d.y4m", "d.y4m"], &arguments[..]].concat());
    assert_eq!((run.code, numbers(&run.json())), (3, vec![0, 2]));
    run.says(&["d.y4m, frame 1: Y' at (0, 0) of its plane is 1024, more than 10 bits can hold"]);
    // Two sizes.
    folder.write("e.y4m", video("", (8, 8), &[1, 2, 3]));
    folder.score(&["a.y4m", "e.y4m"]).says(&["a.y4m has 24x16 pixels, but e.y4m has 8x8"]);
}

#[test]
fn the_rate_comes_from_the_header() {
    let folder = Folder::new();
    for (name, from) in [("a", 20), ("b", 60)] {
        let codes = [from, from + 9, from + 3, from + 20];
        folder.write(&format!("{name}25.y4m"), video("F25:1", (64, 64), &codes));
        folder.write(&format!("{name}.y4m"), video("", (64, 64), &codes));
    }
    let jod = |files: [&str; 2], more: &[&str]| {
        let options = ["--metrics", "fvvdp", "--display", "htc-vive-pro"];
        folder.json(&[&files, &options[..], more].concat())["sequence"]["fvvdp"]["jod"].clone()
    };
    let plain = jod(["a.y4m", "b.y4m"], &["--fps", "25"]);
    assert!(plain.as_f64().is_some(), "{plain}");
    assert_eq!(jod(["a25.y4m", "b25.y4m"], &[]), plain);
    assert_eq!(jod(["a.y4m", "b25.y4m"], &[]), plain);
    // What the user says counts.
    let other = jod(["a25.y4m", "b25.y4m"], &["--fps", "60"]);
    assert_eq!(other, jod(["a.y4m", "b.y4m"], &["--fps", "60"]));
    assert_ne!(other, plain);
    folder.write("c.y4m", video("F24:1", (64, 64), &[1, 2, 3, 4]));
    let run = folder.score(&["a25.y4m", "c.y4m"]).ok();
    run.says(&["a25.y4m has 25 frames per second, but c.y4m has 24; the first rate is used"]);
}

#[test]
fn the_shape_of_pixels_is_looked_at() {
    let folder = Folder::new();
    for name in ["a.y4m", "b.y4m"] {
        folder.write(name, video("A4:3", SIZE, &[20]));
    }
    let run = folder.score(&["a.y4m", "b.y4m", "--fov-vertical", "60"]);
    run.fails(
        3,
        &["a.y4m declares pixels that are 1.3333334 times as wide as high", "A1:1 of y4m"],
    );
}

#[test]
fn an_experiment_of_videos_is_written_down_and_goes_on() {
    let folder = videos(4, 4);
    let text = "name = \"e\"\n[signal]\nrange = \"full\"\n[[scene]]\nname = \"s\"\nreference = \"a.y4m\"\n\
                [[method]]\nname = \"m\"\ntest = \"b.y4m\"\n[metrics]\npsnr = {}\natd = {}\n";
    folder.write("e.toml", text);
    folder.run(&["run", "e.toml", "--output", "out"]).ok();
    let run: Value = serde_json::from_slice(&file(&folder, "out/run.json")).unwrap();
    let eye = &run["resolved"]["scenes"][0]["eyes"][0]["signal"];
    assert_eq!((&eye["range"], &eye["matrix"]), (&Value::from("full"), &Value::Null), "{run:#}");
    let results = file(&folder, "out/results.csv");
    let expected = folder.json(&["a.y4m", "b.y4m", "--metrics", "psnr", "--range", "full"]);
    let limited = folder.json(&["a.y4m", "b.y4m", "--metrics", "psnr"]);
    assert_ne!(psnrs(&expected), psnrs(&limited));
    let text = String::from_utf8(results.clone()).unwrap();
    for psnr in psnrs(&expected) {
        assert!(text.contains(&psnr.to_string()), "{psnr} is not in\n{text}");
    }
    // Half of it is done when it goes on.
    let journal = String::from_utf8(file(&folder, "out/journal.jsonl")).unwrap();
    let lines: Vec<&str> = journal.lines().collect();
    folder.write("out/journal.jsonl", lines[..lines.len() / 2].join("\n") + "\n");
    folder.run(&["run", "e.toml", "--output", "out", "--resume"]).ok();
    assert!(file(&folder, "out/results.csv") == results);
    // A video that has changed is another input.
    folder.write("b.y4m", video("F30:1", SIZE, &[90, 91, 92, 93]));
    folder.run(&["run", "e.toml", "--output", "out", "--resume"]).says(&["b.y4m has changed"]);
}

/// A damaged video is one input: shards, and a run that goes on, have the errors of a whole run.
#[test]
fn shards_of_a_damaged_video_are_a_whole_run() {
    let folder = videos(9, 9);
    let whole = file(&folder, "b.y4m");
    folder.write("b.y4m", &whole[..whole.len() - 3 * (SIZE.0 * SIZE.1 + 6) - 50]);
    for missing in ["", "allow_missing = true\n"] {
        let text = format!(
            "name = \"e\"\n[[scene]]\nname = \"s\"\nreference = \"a.y4m\"\n{missing}\
             [[method]]\nname = \"m\"\ntest = \"b.y4m\"\n[[method]]\nname = \"same\"\ntest = \"a.y4m\"\n\
             [metrics]\npsnr = {{}}\natd = {{}}\n"
        );
        folder.write("e.toml", text);
        folder.run(&["check", "e.toml"]).ok().says(&["b.y4m: its frame 5 is damaged"]);
        let run = folder.run(&["run", "e.toml", "--output", "whole"]);
        assert_eq!(run.code, 3, "{}", run.stderr);
        run.says(&["b.y4m, frame 5: it is cut short"]);
        for shard in ["1", "2", "3"] {
            let (share, output) = (format!("{shard}/3"), format!("s{shard}"));
            folder.run(&["run", "e.toml", "--shard", &share, "--output", &output]);
        }
        let run = folder.run(&["merge", "s1", "s2", "s3", "--output", "merged"]);
        assert_eq!(run.code, 3, "{}", run.stderr);
        for name in ["results.csv", "summary.json"] {
            let [whole, merged] =
                ["whole", "merged"].map(|run| file(&folder, &format!("{run}/{name}")));
            assert!(whole == merged, "{name}");
        }
        for output in ["whole", "s1", "s2", "s3", "merged"] {
            fs::remove_dir_all(folder.path(output)).unwrap();
        }
    }
}

#[test]
fn other_videos_and_other_places_are_explained() {
    let folder = videos(2, 2);
    let other: [(&str, &[u8], &str); 3] = [
        ("a.mkv", b"\x1a\x45\xdf\xa3aaaaaaaa", "it is a Matroska or WebM video"),
        ("b.mp4", b"\0\0\0\x20ftypisom", "it is an MP4 or QuickTime video"),
        ("c.avi", b"RIFF\0\0\0\0AVI LIST", "it is an AVI video"),
    ];
    for (name, bytes, said) in other {
        folder.write(name, bytes);
        let said = [name, said, "but only y4m video is supported", "-f yuv4mpegpipe"];
        folder.score(&["a.y4m", name]).fails(3, &said);
        folder.score(&[name, name]).fails(3, &said);
    }
    folder.write("folder/c.y4m", file(&folder, "a.y4m"));
    folder.score(&["a.y4m", "folder"]).fails(3, &["or a y4m video by its name"]);
}

/// Every prefix of a small video, as a file and as a stream, ends in frames or in errors, the same ones.
#[test]
fn files_and_streams_tell_the_same() {
    let folder = Folder::new();
    let whole = video("F30:1 Ip", (3, 2), &[20, 30, 40]);
    for length in 0..=whole.len() {
        folder.write("c.y4m", &whole[..length]);
        let file = open_source(&folder.path("c.y4m"), SourceOptions::default());
        let bytes = std::io::Cursor::new(whole[..length].to_vec());
        let name = folder.path("c.y4m").display().to_string();
        let stream = video_stream(name, bytes, &SourceOptions::default().read);
        match (file, stream) {
            (Err(file), Err(stream)) => assert_eq!(file.to_string(), stream.to_string()),
            (Err(file), Ok(stream)) => {
                assert!(file.to_string().contains("no frames"), "{length}: {file}");
                assert!(stream.read(0, false).unwrap_err().has_ended);
            }
            (Ok(file), Ok(stream)) => {
                for frame in 0..4 {
                    let of = |source: &dyn Source| {
                        let read = source.read(frame, false);
                        read.map(|picture| picture.frame)
                            .map_err(|error| (error.message, error.has_ended))
                    };
                    assert_eq!(of(&*file), of(&*stream), "{length}, frame {frame}");
                }
            }
            (Ok(_), Err(stream)) => panic!("{length}: {stream}"),
        }
    }
}

#[test]
fn a_reader_that_fails_is_an_error() {
    struct Fails(std::io::Cursor<Vec<u8>>);
    impl Read for Fails {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            match self.0.read(buffer)? {
                0 => Err(std::io::Error::other("the cable is out")),
                read => Ok(read),
            }
        }
    }
    let whole = video("", (3, 2), &[20, 30]);
    let reader = Fails(std::io::Cursor::new(whole));
    let clip = video_stream("net".to_owned(), reader, &SourceOptions::default().read).unwrap();
    assert!(clip.read(0, false).is_ok() && clip.read(1, false).is_ok());
    let error = clip.read(2, false).unwrap_err();
    assert_eq!(error.message, "net, frame 2: it cannot be read: the cable is out");
}
