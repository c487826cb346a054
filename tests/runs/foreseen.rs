//! What is known before a pixel is read: `check` warns of what `run` will warn of, and frames that do not
//! fit into memory are an error rather than the end of the program.

use fovqa_testkit::png_files::header_only;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{experiment, two_scenes};

/// The warnings of a run, line by line.
fn warnings(stderr: &str) -> Vec<String> {
    let lines = stderr.lines().filter(|line| line.contains("warning"));
    lines.map(str::to_owned).collect()
}

#[test]
fn check_warns_of_what_run_warns_of() {
    let folder = two_scenes();
    folder.write("gaze.csv", "frame,x_px,y_px\n0,24,20\n1,90,20\n2,24,20\n");
    for (view, wanted) in [
        ("fov_vertical_deg = 60\ngaze = [24, 90]", "is outside the frame of 48x40"),
        ("display = \"htc-vive-pro\"", "stretched over the display's"),
        ("fov_vertical_deg = 60\ngaze = { trace = \"gaze.csv\" }", "the gaze (90, 20) is outside"),
    ] {
        let text = experiment("").replace("fov_vertical_deg = 60", view);
        folder.write("e.toml", text);
        let checked = folder.run(&["check", "e.toml"]).ok().says(&[wanted]);
        let run = folder.run(&["run", "e.toml"]).ok();
        let without_motion = |line: &String| !line.contains("without motion vectors");
        let run: Vec<String> = warnings(&run.stderr).into_iter().filter(without_motion).collect();
        assert_eq!(warnings(&checked.stderr), run, "{view}");
    }
    // Haar's default levels need blocks of 32 pixels.
    let small = Folder::new();
    small.png_pair("room/gt/0.png", "room/a/0.png", 24, 24);
    small.png_pair("room/x/0.png", "room/b/0.png", 24, 24);
    small.png_pair("hall/gt/0.png", "hall/a/0.png", 24, 24);
    small.png_pair("hall/x/0.png", "hall/b/0.png", 24, 24);
    small.write("e.toml", experiment(""));
    let checked = small.run(&["check", "e.toml"]).ok().says(&["Haar wavelet is left out"]);
    assert!(!checked.stdout.contains("Haar"), "{}", checked.stdout);
    assert!(!checked.stdout.contains("ATD"), "of stills:\n{}", checked.stdout);
}

#[test]
fn check_lists_what_will_be_scored() {
    let folder = two_scenes();
    folder.write("e.toml", experiment(""));
    let stdout = folder.run(&["check", "e.toml"]).ok().stdout;
    assert!(stdout.contains("ATD") && stdout.contains("(by default)"), "{stdout}");
    folder.write("e.toml", experiment("").replace("[view]\nfov_vertical_deg = 60\n", ""));
    let checked =
        folder.run(&["check", "e.toml"]).ok().says(&["RMS contrast is left out: it needs"]);
    assert!(!checked.stdout.contains("RMS contrast"), "{}", checked.stdout);
}

/// 23 frames of 3.6 gigapixels are more than any machine has that runs this test.
#[cfg(target_os = "linux")]
#[test]
fn frames_beyond_memory_are_an_error_before_anything_is_scored() {
    let folder = Folder::new();
    // A header, and the begin of the picture.
    let mut header = header_only(60_000, 60_000);
    header.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e");
    for frame in 0..40 {
        for side in ["gt", "test"] {
            folder.write(&format!("{side}/{frame:04}.png"), &header);
        }
    }
    let arguments =
        ["gt", "test", "--metrics", "fvvdp", "--display", "htc-vive-pro", "--fps", "90"];
    let large = ["--max-megapixels", "4000"];
    let run = folder.score(&[&arguments[..], &large].concat());
    let words = ["60000x60000 pixels need at least 7", "FovVideoVDP 7", "is available", "--crop"];
    run.fails(3, &words);
    // Of a crop, the files are decoded whole all the same.
    let part = folder.score(&[&arguments[..], &large, &["--crop", "0,0,64,64"]].concat());
    part.fails(3, &["decoded frames 43.2 GB"]);
    let text = "name = \"e\"\n[view]\ndisplay = \"htc-vive-pro\"\n[signal]\nmax_megapixels = 4000\n\
                [[scene]]\nname = \"s\"\nreference = \"gt\"\nfps = 90\n\
                [[method]]\nname = \"A\"\ntest = \"test\"\n[metrics]\nfvvdp = {}\n";
    folder.write("e.toml", text);
    folder.run(&["check", "e.toml"]).ok().says(&[
        "need at least 8",
        "maps 25.2 GB",
        "score fewer methods",
    ]);
    let run = folder.run(&["run", "e.toml"]);
    assert_eq!(run.code, 3);
    run.says(&["need at least 8", "[metrics]", "crop = [X, Y, W, H]"]);
}
