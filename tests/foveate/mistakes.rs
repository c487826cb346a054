//! What is refused, with the exit code and the words.

use std::fs;

use fovqa_testkit::exr_files::{File, Part};
use fovqa_testkit::png_files;

use super::frames::{HEIGHT, WIDTH, with_frame, with_sequence};

#[test]
fn a_wrong_command_line_is_exit_2() {
    let folder = with_frame();
    let cases: [(&str, &[&str]); 25] = [
        ("--method rmfl", &["did you mean rmfr?", "perceptual-target"]),
        ("", &["--method"]),
        ("--method rmfr --set sigma=0.05", &["rmfr.sigma cannot be 0.05", "list methods"]),
        ("--method rmfr --set sigma=nan", &["rmfr.sigma"]),
        ("--method rmfr --set sigmas=2", &["no parameter \"sigmas\"", "sigma"]),
        ("--method rmfr --set sigma", &["PARAM=VALUE"]),
        ("--method rmfr --set taa.beta=0", &["taa.beta cannot be 0"]),
        ("--method rmfr --set taa.gamma=0", &["taa has no parameter", "alpha_max"]),
        (
            "--method rmfr --set filter.factor=1",
            &["rmfr has no", "only deamp, kfr, lafr and vafr have filters"],
        ),
        (
            "--method rmfr --filter own",
            &["rmfr has no filter", "only deamp, kfr, lafr and vafr have filters"],
        ),
        ("--method deamp --filter buffer", &["`buffer`", "`screen`"]),
        ("--method vafr --filter screen --fov-vertical 90", &["`screen`", "`buffer`"]),
        ("--method kfr --filter all", &["--filter", "own"]),
        ("--method rmfr --sampling box", &["--sampling", "area"]),
        ("--method rmfr --enhance -1 --fov-vertical 90", &["-1", "between 0 and 100"]),
        ("--method rmfr --enhance 1", &["enhancement", "--fov-vertical"]),
        ("--method vafr", &["vafr needs a view", "--display"]),
        ("--method rmfr --gaze nan,1", &["--gaze"]),
        ("--method rmfr --fov-vertical 190", &["190"]),
        ("--method rmfr --budget 0", &["budget", "0"]),
        ("--method rmfr --budget 500", &["cannot reach a budget of 500", "allows"]),
        ("--method full --budget 0.5", &["full"]),
        ("--method stable --budget 0.5 --fov-vertical 90", &["stable"]),
        ("--method rmfr --budget-of buffer", &["--budget"]),
        ("--method cps --fov-vertical 90 --buffer b.png", &["cps has no reduced buffer"]),
    ];
    for (arguments, words) in cases {
        folder.foveate(&format!("a.png o.png {arguments}")).fails(2, words);
        assert!(!folder.path("o.png").exists(), "{arguments}");
    }
}

#[test]
fn a_budget_out_of_reach_states_its_range() {
    let folder = with_frame();
    let run = folder.foveate("a.png o.png --method guenter --fov-vertical 80 --budget 0.000001");
    run.fails(2, &["cannot reach a budget of 0.000001", "allows", " to ", "another share"]);
}

#[test]
fn a_file_that_cannot_hold_the_frame_is_refused() {
    let folder = with_frame();
    let codes: Vec<u16> = (0..WIDTH * HEIGHT).map(|i| i as u16).collect();
    png_files::write16(&folder.path("deep.png"), WIDTH, HEIGHT, &codes);
    File::new(vec![Part::rgb((WIDTH, HEIGHT), |x, _| x as f32 / 50.0)])
        .write(&folder.path("a.exr"));
    let cases: [(&str, &[&str]); 8] = [
        ("a.exr o.jpg", &["o.jpg: JPEG files cannot hold linear light", "OpenEXR"]),
        ("deep.png o.jpeg", &["o.jpeg: JPEG files cannot hold codes of 16 bits", "PNG"]),
        ("a.png o.y4m", &["o.y4m", "videos cannot be written", "PNG"]),
        ("a.png o.tiff", &["\"o.tiff\"", ".png, .exr, .jpg, .jpeg"]),
        ("a.png o", &["\"o\"", ".png"]),
        ("a.exr o.exr --tonemap aces", &["aces", "PNG"]),
        ("a.png o.exr --transfer pq", &["pq", "PNG"]),
        ("a.exr o.png --method rmfr --buffer b.jpg", &["b.jpg: JPEG"]),
    ];
    for (arguments, words) in cases {
        let arguments = arguments.replace(" --method rmfr", "");
        folder.foveate(&format!("{arguments} --method rmfr")).fails(2, words);
        for output in ["o.jpg", "o.jpeg", "o.y4m", "o.tiff", "o", "o.exr", "o.png"] {
            assert!(!folder.path(output).exists(), "{arguments}");
        }
    }
}

#[test]
fn several_frames_need_a_folder() {
    let folder = with_sequence(2);
    for output in ["o.png", "o.exr", "new/o.jpg"] {
        folder
            .foveate(&format!("gt {output} --method rmfr"))
            .fails(2, &["2 frames", "give a folder"]);
    }
    folder.foveate("gt o.y4m --method rmfr").fails(2, &["videos cannot be written"]);
    folder.foveate("gt/%04d.png o.png --method rmfr").fails(2, &["give a folder"]);
    folder.write("taken", "a file");
    folder.foveate("gt taken --method rmfr").fails(2, &["taken is a file", "give a folder"]);
    folder.foveate("gt out --method rmfr --buffer b.png").fails(2, &["b.png", "give a folder"]);
    assert_eq!(fs::read(folder.path("taken")).unwrap(), b"a file");
}

#[test]
fn no_output_replaces_an_input() {
    let folder = with_sequence(2);
    let before = fs::read(folder.path("gt/0001.png")).unwrap();
    let cases = [
        "gt gt --method rmfr",
        "gt ./gt/ --method rmfr",
        "gt/*.png gt/../gt --method rmfr",
        "gt gt --method rmfr --frames 1..2",
        "gt/0001.png gt/0001.png --method rmfr",
        "gt/0001.png gt --method rmfr",
        "gt/0001.png gt/0000.png --method rmfr --buffer gt/0001.png",
    ];
    for arguments in cases {
        folder.foveate(arguments).fails(2, &["is an input", "another output"]);
        assert_eq!(fs::read(folder.path("gt/0001.png")).unwrap(), before, "{arguments}");
    }
    folder
        .foveate("gt/0001.png o.png --method rmfr --buffer o.png")
        .fails(2, &["two outputs have the same name o.png"]);
}

#[cfg(unix)]
#[test]
fn no_output_replaces_an_input_through_a_link() {
    let folder = with_frame();
    let before = fs::read(folder.path("a.png")).unwrap();
    std::os::unix::fs::symlink("a.png", folder.path("link.png")).unwrap();
    folder.foveate("a.png link.png --method rmfr").fails(2, &["is an input"]);
    assert_eq!(fs::read(folder.path("a.png")).unwrap(), before);
}

#[test]
fn two_inputs_with_one_name_are_refused() {
    let folder = with_sequence(1);
    let codes = fs::read(folder.path("gt/0000.png")).unwrap();
    folder.write("other/0000.png", codes);
    folder.foveate("*/0000.png out --method rmfr").fails(3, &["gt/0000.png", "other/0000.png"]);
}

#[test]
fn an_unreadable_input_or_output_is_exit_3() {
    let folder = with_frame();
    folder.write("bad.png", "not a picture");
    folder.write("file", "a file");
    folder.foveate("none.png o.png --method rmfr").fails(3, &["none.png"]);
    folder.foveate("bad.png o.png --method rmfr").fails(3, &["bad.png"]);
    folder.foveate("a.png none/o.png --method rmfr").fails(3, &["none/o.png", "cannot be written"]);
    folder.foveate("a.png file/o.png --method rmfr").fails(3, &["file/o.png"]);
    folder.foveate("a.png o.png --method rmfr --gaze none.csv").fails(3, &["none.csv"]);
    folder.foveate("a.png o.png --method rmfr --frames 5..6").fails(3, &["no frame"]);
    folder.foveate("a.png o.png --method taa --motion-files none").fails(3, &["none"]);
    assert!(!folder.path("o.png").exists());
}

#[test]
fn a_video_on_standard_input_is_refused() {
    let folder = with_frame();
    folder.foveate("- out --method rmfr").fails(2, &["standard input", ".y4m"]);
}

#[test]
fn bad_pixels_are_refused() {
    let folder = with_frame();
    let bad = Part::rgb((WIDTH, HEIGHT), |x, y| if (x, y) == (3, 2) { f32::NAN } else { 0.5 });
    File::new(vec![bad]).write(&folder.path("bad.exr"));
    folder.foveate("bad.exr o.png --method rmfr").fails(3, &["bad.exr", "(3, 2)"]);
}
