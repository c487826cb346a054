//! Folders, patterns, pairing, gaze traces, memory, interruption.

use fovqa_testkit::synthetic::{codes, disturbed};

#[cfg(target_os = "linux")]
use crate::fovqa::peak_kb;
use crate::fovqa::{Folder, command, root};

/// `gt/0000.png …` and `test/…`, each frame of its own noise.
fn sequence(frames: usize) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let reference = codes(48, 40, 3, frame as u64);
        folder.png(&format!("gt/{frame:04}.png"), 48, 40, &reference);
        let test = disturbed(&reference, 30.0 + frame as f64, 77);
        folder.png(&format!("test/rmfr_{frame:04}.png"), 48, 40, &test);
    }
    folder
}

#[test]
fn folders_globs_and_patterns_are_alike() {
    let folder = sequence(3);
    let strip = |json: serde_json::Value| json["frames"].clone();
    let want = strip(folder.json(&["gt", "test"]));
    assert_eq!(want.as_array().unwrap().len(), 3);
    assert_eq!(want[2]["reference"], "gt/0002.png");
    assert_eq!(want[2]["test"], "test/rmfr_0002.png");
    assert_eq!(strip(folder.json(&["gt/*.png", "test/rmfr_*"])), want);
    assert_eq!(strip(folder.json(&["gt/%04d.png", "test/rmfr_%04d.png"])), want);
    let absolute = folder.path("gt").canonicalize().unwrap();
    assert_eq!(strip(folder.json(&[absolute.to_str().unwrap(), "./test/"])), want);
}

#[test]
fn means_extremes_and_pooled_values() {
    let folder = sequence(3);
    // One frame without error: it must not lift the mean.
    std::fs::copy(folder.path("gt/0001.png"), folder.path("test/rmfr_0001.png")).unwrap();
    let json = folder.json(&["gt", "test", "--fov-vertical", "60"]);
    let of =
        |frame: usize, metric: &str| json["frames"][frame]["metrics"][metric].as_f64().unwrap();
    let psnr = &json["summary"]["psnr"];
    let mean = f64::midpoint(of(0, "psnr"), of(2, "psnr"));
    assert!((psnr["mean"].as_f64().unwrap() - mean).abs() < 1e-12);
    assert_eq!(psnr["max"], "inf");
    assert_eq!(psnr["identical_frames"], 1);
    let pooled = -10.0 * ((of(0, "mse") + of(2, "mse")) / 3.0).log10();
    assert!((psnr["psnr_pooled"].as_f64().unwrap() - pooled).abs() < 1e-9);
    let fpsnr = json["summary"]["fpsnr"]["fpsnr_pooled"].as_f64().unwrap();
    let fmse = |frame| 10f64.powf(-of(frame, "fpsnr") / 10.0);
    assert!((fpsnr + 10.0 * ((fmse(0) + fmse(2)) / 3.0).log10()).abs() < 1e-9);
    let ssim = json["summary"]["ssim"]["mean"].as_f64().unwrap();
    assert!((ssim - (of(0, "ssim") + 1.0 + of(2, "ssim")) / 3.0).abs() < 1e-12);
    let table = folder.score(&["gt", "test"]).ok().stdout;
    assert!(table.contains("1 of 3 frames are identical"), "{table}");
}

#[test]
fn frames_are_picked_by_number() {
    let folder = sequence(8);
    let numbers = |range: &str| -> Vec<u64> {
        let json = folder.json(&["gt", "test", "--frames", range]);
        json["frames"].as_array().unwrap().iter().map(|f| f["frame"].as_u64().unwrap()).collect()
    };
    assert_eq!(numbers("2..5"), [2, 3, 4]);
    assert_eq!(numbers("1..:3"), [1, 4, 7]);
    folder
        .score(&["gt", "test", "--frames", "20..30"])
        .fails(3, &["the selection contains no frame", "0 to 7"]);
}

#[test]
fn unpaired_frames_are_listed() {
    let folder = sequence(4);
    std::fs::remove_file(folder.path("test/rmfr_0002.png")).unwrap();
    std::fs::remove_file(folder.path("gt/0003.png")).unwrap();
    folder.score(&["gt", "test"]).fails(
        3,
        &[
            "reference without a test frame: gt/0002.png",
            "test without a reference frame: test/rmfr_0003.png",
            "--allow-missing",
        ],
    );
    let json = folder.json(&["gt", "test", "--allow-missing"]);
    assert_eq!(json["frames"].as_array().unwrap().len(), 2);
}

#[test]
fn one_bad_frame_does_not_cost_the_others() {
    let folder = sequence(4);
    folder.write("test/rmfr_0001.png", "no picture");
    folder.png("test/rmfr_0003.png", 50, 40, &codes(50, 40, 3, 1));
    let run = folder.score(&["gt", "test", "--format", "json"]).says(&[
        "frame 1: test/rmfr_0001.png: this is not a PNG",
        "frame 3: gt/0003.png has 48x40 pixels, but test/rmfr_0003.png has 50x40",
    ]);
    assert_eq!(run.code, 3);
    let json = run.json();
    assert_eq!(json["frames"].as_array().unwrap().len(), 2);
    assert_eq!(json["errors"].as_array().unwrap().len(), 2);
    assert_eq!(json["errors"][0]["frame"], 1);
}

#[test]
fn a_sequence_has_one_size() {
    let folder = sequence(3);
    for name in ["gt/0002.png", "test/rmfr_0002.png"] {
        folder.png(name, 60, 40, &codes(60, 40, 3, 1));
    }
    let run =
        folder.score(&["gt", "test"]).says(&["gt/0002.png has 60x40 pixels, but gt/0000.png"]);
    assert_eq!(run.code, 3);
}

#[test]
fn gaze_traces_move_the_bands() {
    let folder = sequence(4);
    folder.write(
        "gaze.csv",
        "frame,time_s,x_px,y_px\n0,0,24,20\n1,0.1,4,4\n2,0.2,nan,nan\n3,0.3,24,20\n",
    );
    let arguments = ["gt", "test", "--fov-vertical", "60", "--gaze", "gaze.csv"];
    let json = folder.json(&arguments);
    let gaze = |frame: usize| json["frames"][frame]["gaze_px"].clone();
    assert_eq!(gaze(1), serde_json::json!([4.0, 4.0]));
    assert_eq!(gaze(2), serde_json::json!([4.0, 4.0]), "a blink holds the gaze before it");
    assert_eq!(json["gaze_held"], 1);
    // The bands of each frame are those of its own gaze.
    for (frame, gaze) in [(0, "24,20"), (1, "4,4"), (3, "24,20")] {
        let edges = json["frames"][0]["bands"].as_array().unwrap().iter();
        let edges: Vec<String> = edges.map(|b| b["from_deg"].to_string()).collect();
        let bands = format!("{},90", edges.join(","));
        let range = format!("{frame}..={frame}");
        let fixed = folder.json(&[
            "gt",
            "test",
            "--fov-vertical",
            "60",
            "--gaze",
            gaze,
            "--frames",
            &range,
            "--bands",
            &bands,
        ]);
        let (moving, fixed) = (&json["frames"][frame], &fixed["frames"][0]);
        assert_eq!(moving["metrics"], fixed["metrics"]);
        for band in 0..edges.len() - 1 {
            let mut moving = moving["bands"][band].clone();
            // A frame alone has none before it.
            moving.as_object_mut().unwrap().remove("atd");
            assert_eq!(moving, fixed["bands"][band]);
        }
    }
    let held = folder.score(&[&arguments[..], &["--format", "table"]].concat()).ok().stdout;
    assert!(held.contains("gaze from a trace, kept from an earlier frame in 1 frame"), "{held}");
}

#[test]
fn a_mask_follows_a_moving_gaze() {
    let folder = sequence(2);
    folder.png(
        "mask.png",
        48,
        40,
        &(0..48 * 40).map(|i| if i % 48 < 6 { 0 } else { 255 }).collect::<Vec<_>>(),
    );
    folder.write("gaze.csv", "frame,x_px,y_px\n0,40,20\n1,10,4\n");
    let metrics = ["gt", "test", "--metrics", "mse,psnr,ssim,rms-contrast,haar"];
    let bands = ["--fov-vertical", "60", "--mask", "mask.png", "--bands", "0,10,25,80"];
    let bands = [&metrics[..], &bands[..]].concat();
    let moving = folder.json(&[&bands[..], &["--gaze", "gaze.csv"]].concat());
    for (frame, gaze, range) in [(0, "40,20", "0..1"), (1, "10,4", "1..2")] {
        let fixed = folder.json(&[&bands[..], &["--gaze", gaze, "--frames", range]].concat());
        for part in ["bands", "haar"] {
            assert_eq!(moving["frames"][frame][part], fixed["frames"][0][part]);
        }
    }
}

#[test]
fn gaze_traces_over_time_need_a_frame_rate() {
    let folder = sequence(3);
    folder.write("gaze.csv", "time_s,x_px,y_px\n0.000000,10,10\n0.013889,20,20\n0.027778,30,30\n");
    let arguments = ["gt", "test", "--fov-vertical", "60", "--gaze", "gaze.csv"];
    folder.score(&arguments).fails(2, &["but the frame rate is not known", "--fps"]);
    let json = folder.json(&[&arguments[..], &["--fps", "72"]].concat());
    assert_eq!(json["frames"][2]["gaze_px"], serde_json::json!([30.0, 30.0]));
}

#[test]
fn a_missing_first_frame_does_not_shift_the_gaze() {
    let folder = sequence(3);
    std::fs::remove_file(folder.path("test/rmfr_0000.png")).unwrap();
    folder.write("gaze.csv", "time_s,x_px,y_px\n0.0,10,10\n0.1,20,20\n0.2,30,30\n");
    let arguments = ["gt", "test", "--fov-vertical", "60", "--gaze", "gaze.csv", "--fps", "10"];
    let run = folder.score(&[&arguments[..], &["--allow-missing", "--format", "json"]].concat());
    let run = run.ok().says(&["skipped frames without a partner: 1"]);
    let gaze = |frame: usize| run.json()["frames"][frame]["gaze_px"].clone();
    assert_eq!(
        (gaze(0), gaze(1)),
        (serde_json::json!([20.0, 20.0]), serde_json::json!([30.0, 30.0]))
    );
}

#[test]
fn two_files_of_one_number_are_that_frame() {
    let folder = sequence(3);
    let json = folder.json(&["gt/0002.png", "test/rmfr_0002.png"]);
    assert_eq!(json["frames"][0]["frame"], 2);
    let json = folder.json(&["gt/0002.png", "test/rmfr_0001.png"]);
    assert_eq!(json["frames"][0]["frame"], 0, "two numbers name no frame");
}

#[test]
fn gaze_traces_that_do_not_fit_are_errors() {
    let folder = sequence(3);
    let with = |text: &str, more: &[&str]| {
        folder.write("gaze.csv", text);
        folder
            .score(&[&["gt", "test", "--fov-vertical", "60", "--gaze", "gaze.csv"], more].concat())
    };
    with("frame,x_px,y_px\n0,1,1\n1,2,2\n", &[])
        .fails(3, &["no gaze for frame 2", "0 to 1", "--gaze-hold"]);
    with("frame,x_px,y_px\n0,1,1\n1,2,2\n", &["--gaze-hold"]).ok();
    with("frame,x_px,y_px\n1,1,1\n2,2,2\n", &["--gaze-hold"])
        .fails(3, &["frame 0 has no gaze", "no earlier gaze that could be kept"]);
    with("frame,x_px,y_px\n1,1,1\n0,2,2\n", &[]).fails(3, &["line 3", "is not greater than"]);
    with("x,y\n1,2\n", &[]).fails(3, &["no column frame (or time_s)", "x, y"]);
    with("frame,x_px,y_px\n0,one,2\n", &[]).fails(3, &["line 2", "x_px has \"one\""]);
    with("", &[]).fails(3, &["gaze.csv"]);
    with("\u{0}\u{1}\u{2}PNG", &[]).fails(3, &["gaze.csv"]);
    folder.write("binary.csv", [0xff, 0xfe, 0x00, 0x80, b'\n', 0xff]);
    folder
        .score(&["gt", "test", "--fov-vertical", "60", "--gaze", "binary.csv"])
        .fails(3, &["binary.csv"]);
    folder
        .score(&["gt", "test", "--fov-vertical", "60", "--gaze", "nope.csv"])
        .fails(3, &["nope.csv", "cannot be read"]);
    folder
        .score(&["gt", "test", "--fov-vertical", "60", "--gaze", "gt"])
        .fails(3, &["gaze file cannot be read"]);
}

#[test]
fn a_gaze_outside_the_frame_is_a_warning() {
    let folder = sequence(2);
    let arguments = ["gt", "test", "--metrics", "psnr", "--fov-vertical", "60", "--gaze"];
    let run =
        folder.score(&[&arguments[..], &["-30,20"]].concat()).ok().says(&["(-30, 20) is outside"]);
    assert_eq!(run.stderr.matches("warning").count(), 1, "{}", run.stderr);
    let border = folder.score(&[&arguments[..], &["48,40"]].concat()).ok();
    assert_eq!(border.stderr, "", "borders are inside");
}

#[test]
fn the_committed_sequence_scores_with_its_gaze() {
    let folder = Folder::new();
    let data = root().join("tests/data/small/classroom");
    let file = |name: &str| data.join(name).display().to_string();
    let exposure = 1.579_817_705_667_f64.log2().to_string();
    let json = folder.json(&[
        &file("gt"),
        &file("rmfr_taa"),
        "--fov-vertical",
        "100",
        "--gaze",
        &file("gaze.csv"),
        "--exposure",
        &exposure,
    ]);
    // NumPy and scikit-image, from the same files: exposure, clamp, sRGB, against the PNG's codes.
    let independent = [
        (21.904_510_429, 0.739_589_135),
        (23.301_425_306, 0.772_063_947),
        (23.349_849_879, 0.764_908_351),
        (23.169_775_072, 0.770_124_944),
        (23.272_769_016, 0.773_029_098),
        (23.406_873_737, 0.781_785_631),
    ];
    let frames = json["frames"].as_array().unwrap();
    assert_eq!(frames.len(), independent.len());
    for (frame, (psnr, ssim)) in frames.iter().zip(independent) {
        let of = |metric: &str| frame["metrics"][metric].as_f64().unwrap();
        assert!((of("psnr") - psnr).abs() < 1e-4 && (of("ssim") - ssim).abs() < 1e-5, "{frame}");
    }
}

/// Decoded, a frame here takes 590 kB and a pair 1.2 MB: 200 pairs would take 236 MB.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_number_of_frames() {
    const SIDE: usize = 443;
    let folder = Folder::new();
    folder.png_pair("gt/0000.png", "test/0000.png", SIDE, SIDE);
    for frame in 1..200 {
        for side in ["gt", "test"] {
            let first = folder.path(&format!("{side}/0000.png"));
            std::fs::hard_link(first, folder.path(&format!("{side}/{frame:04}.png"))).unwrap();
        }
    }
    let arguments = ["score", "gt", "test", "--fov-vertical", "60", "--threads", "2"];
    let ten = peak_kb(&folder, &[&arguments[..], &["--frames", "0..10"]].concat());
    let all = peak_kb(&folder, &arguments);
    assert!(ten > 0 && all < ten + 8_000, "{ten} kB for 10 frames, {all} kB for 200");
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_with_130_and_no_result() {
    use std::process::{Command, Stdio};
    use std::time::Duration;
    let folder = Folder::new();
    folder.png_pair("gt/0000.png", "test/0000.png", 1000, 1000);
    for frame in 1..1000 {
        for side in ["gt", "test"] {
            let first = folder.path(&format!("{side}/0000.png"));
            std::fs::hard_link(first, folder.path(&format!("{side}/{frame:04}.png"))).unwrap();
        }
    }
    let child = command(&["score", "gt", "test", "--format", "json"])
        .current_dir(folder.path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(500));
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let run = crate::fovqa::Run::from(child.wait_with_output().unwrap());
    run.fails(130, &["interrupted"]);
}
