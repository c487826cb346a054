//! What FovVideoVDP and PU-PSNR refuse, and how they say so.

use std::fs;

use fovqa_testkit::exr_files::{File, Part};

use crate::fovqa::Folder;
use crate::metrics::fvvdp::{HEADSET, sequence};

#[test]
fn a_display_is_needed_and_has_to_be_able_to_show_the_files() {
    let folder = sequence(1, (48, 40));
    for metric in ["fvvdp", "pu-psnr"] {
        let score = |more: &[&str]| {
            folder.score(&[&["gt", "test", "--metrics", metric][..], more].concat())
        };
        score(&["--fov-vertical", "60"])
            .fails(2, &["display's photometry", "none is given", "--luminance", "list displays"]);
        score(&["--display", "vive-pro-eye"])
            .fails(2, &["the photometry of vive-pro-eye is not known", "--luminance"]);
        score(&["--display", "standard-hmd", "--transfer", "pq"])
            .fails(2, &["encoded as PQ", "expects sRGB", "--transfer"]);
        score(&["--display", "standard-hdr-pq", "--transfer", "srgb"])
            .fails(2, &["encoded as sRGB", "expects PQ"]);
        score(&["--display", "standard-hdr-linear", "--transfer", "gamma2.2"])
            .fails(2, &["a power of 2.2", "expects luminance"]);
    }
    folder.score(&["gt", "test", "--metrics", "fvvdp"]).fails(2, &["FovVideoVDP needs a view"]);
    // PU-PSNR has no geometry.
    folder.score(&["gt", "test", "--metrics", "pu-psnr", "--luminance", "htc-vive-pro"]).ok();
}

#[test]
fn photometry_by_hand_is_checked() {
    let folder = sequence(1, (48, 40));
    for (text, words) in [
        ("vive", &["no such display", "did you mean vive-pro-eye?"][..]),
        ("vive-pro-eye", &["the photometry of vive-pro-eye is not known"]),
        ("contrast=100", &["peak_cd_m2, the luminance of the display's white, is missing"]),
        ("peak_cd_m2=0", &["peak_cd_m2 of 0", "between 0.01"]),
        ("peak_cd_m2=bright", &["peak_cd_m2: write a number"]),
        ("peak_cd_m2=100,min=1", &["no such key", "min_cd_m2"]),
        ("peak_cd_m2=100,eotf=rgb", &["no such eotf", "srgb"]),
        ("peak_cd_m2=100,min_cd_m2=100", &["the display's black", "below its peak"]),
        ("peak_cd_m2=100,ambient_lux=-1", &["ambient_lux of -1"]),
    ] {
        folder
            .score(&[
                "gt",
                "test",
                "--metrics",
                "fvvdp",
                "--fov-vertical",
                "60",
                "--luminance",
                text,
            ])
            .fails(2, words);
    }
    for set in [
        "fvvdp.cd_m2_per_unit=0",
        "fvvdp.temp_padding=mirror",
        "fvvdp.foveated=1",
        "fvvdp.color_space=rgb",
        "fvvdp.sigma=1",
    ] {
        folder.score(&[&["gt", "test", "--set", set][..], &HEADSET].concat()).fails(2, &["fvvdp"]);
    }
}

#[test]
fn a_sequence_needs_a_rate_that_can_be_filtered() {
    let folder = sequence(3, (48, 40));
    let score = |more: &[&str]| folder.score(&[&["gt", "test"][..], &HEADSET, more].concat());
    score(&[]).fails(2, &["needs the frame rate", "--fps"]);
    score(&["--fps", "4"]).fails(2, &["more than 4 and at most 1000", "the sequence has 4"]);
    score(&["--fps", "2000"]).fails(2, &["the sequence has 2000"]);
    score(&["--fps", "7", "--frames", "0..:2"])
        .fails(2, &["the sequence has 3.5", "skipped frames"]);
    score(&["--fps", "4.001"]).ok();
    // One frame is a still, whatever its rate.
    score(&["--frames", "1..2"]).ok();
    score(&["--frames", "1..2", "--fps", "1"]).ok();
}

#[test]
fn small_frames_and_frames_of_other_sizes() {
    let folder = Folder::new();
    for (name, width, height) in [("3", 3, 40), ("4", 4, 5), ("5", 5, 4)] {
        folder.png_pair(&format!("{name}/a.png"), &format!("{name}/b.png"), width, height);
    }
    let score = |name: &str| {
        let files = ["a", "b"].map(|side| format!("{name}/{side}.png"));
        folder.score(&[&[files[0].as_str(), &files[1]][..], &HEADSET].concat())
    };
    score("3").fails(3, &["FovVideoVDP needs 4 pixels on each side", "3x40"]);
    score("4").ok();
    score("5").ok();
    let folder = sequence(3, (48, 40));
    folder.png_pair("gt/0002.png", "test/0002.png", 40, 48);
    let run =
        folder.score(&[&["gt", "test", "--fps", "30", "--format", "json"][..], &HEADSET].concat());
    assert_eq!(run.code, 3);
    let json = run.says(&["40x48", "the first of the sequence", "48x40"]).json();
    let all = &json["sequence"]["fvvdp"];
    assert_eq!((all["jod"].clone(), all["frames"].clone()), (serde_json::Value::Null, 2.into()));
    assert!(all["reason"].as_str().unwrap().contains("frame 2 could not be scored"));
    assert!(json["frames"][1]["fvvdp"]["q"].as_f64().unwrap() > 0.0, "nothing finished is lost");
}

#[test]
fn a_frame_that_is_missing_or_damaged_ends_the_sequence() {
    let broken = sequence(4, (48, 40));
    broken.write("test/0001.png", b"no picture");
    let with_psnr = ["--fps", "30", "--metrics", "fvvdp,psnr", "--display", "htc-vive-pro"];
    let run = broken.score(&[&["gt", "test", "--format", "json"][..], &with_psnr].concat());
    assert_eq!(run.code, 3, "{}", run.stderr);
    let json = run.json();
    assert_eq!(json["sequence"]["fvvdp"]["reason"], "frame 1 could not be scored");
    assert_eq!(json["frames"].as_array().unwrap().len(), 3, "PSNR of the others");
    assert!(json["frames"][1].get("fvvdp").is_none() && json["frames"][0].get("fvvdp").is_some());
    let gap = sequence(5, (48, 40));
    for side in ["gt", "test"] {
        fs::remove_file(gap.path(&format!("{side}/0002.png"))).unwrap();
    }
    let run = gap.score(&[&["gt", "test"][..], &with_psnr].concat());
    assert_eq!(run.code, 3);
    run.says(&["frame 2 is missing in reference and test", "frames are missing between 1 and 3"]);
    let gap = sequence(5, (48, 40));
    fs::remove_file(gap.path("test/0002.png")).unwrap();
    let run = gap.score(&[&["gt", "test", "--allow-missing"][..], &with_psnr].concat());
    assert_eq!(run.code, 3);
    run.says(&["FovVideoVDP has no value for the sequence", "frames are missing between 1 and 3"]);
    let table = gap.score(&[&["gt", "test", "--allow-missing"][..], &with_psnr].concat()).stdout;
    assert!(table.contains("FovVideoVDP: no value") && table.contains("PSNR"), "{table}");
}

#[test]
fn a_trace_that_is_too_short_and_pixels_that_are_left_out() {
    let folder = sequence(3, (48, 40));
    folder.write("gaze.csv", "frame,x_px,y_px\n0,10,10\n1,20,20\n");
    let score = |more: &[&str]| {
        folder.score(&[&["gt", "test", "--fps", "30"][..], &HEADSET, more].concat())
    };
    score(&["--gaze", "gaze.csv"]).fails(3, &["gaze.csv", "frame 2", "--gaze-hold"]);
    score(&["--gaze", "gaze.csv", "--gaze-hold"]).ok();
    score(&["--gaze", "-1000,5000"]).ok().says(&["outside the frame"]);
    let mask = vec![0u8; 3 * 48 * 20].into_iter().chain(vec![255; 3 * 48 * 20]);
    folder.png("mask.png", 48, 40, &mask.collect::<Vec<_>>());
    score(&["--mask", "mask.png"])
        .fails(3, &["FovVideoVDP is not defined where pixels are left out"]);
    // PU-PSNR leaves them out.
    let pu = ["--metrics", "pu-psnr", "--display", "htc-vive-pro", "--mask", "mask.png"];
    folder.score(&[&["gt", "test"][..], &pu].concat()).ok();
    let bad = |x: usize, y: usize| if (x, y) == (5, 6) { f32::NAN } else { 0.2 + 0.01 * x as f32 };
    File::new(vec![Part::rgb((48, 40), bad)]).write(&folder.path("bad.exr"));
    let arguments = [&["bad.exr", "bad.exr", "--nonfinite", "mask"][..], &HEADSET].concat();
    folder.score(&arguments).fails(3, &["FovVideoVDP is not defined where pixels are left out"]);
}

#[test]
fn heat_maps_need_the_metric_and_a_folder() {
    let folder = sequence(1, (48, 40));
    folder
        .score(&["gt", "test", "--metrics", "fpsnr", "--maps", "maps"])
        .fails(2, &["none of the metrics has a map", "mse, psnr, ssim"]);
    folder.write("file", "in the way");
    let run = folder.score(&[&["gt", "test", "--maps", "file"][..], &HEADSET].concat());
    run.fails(3, &["file", "the map cannot be written", "--maps"]);
}

#[test]
fn an_experiment_shows_the_place() {
    let folder = sequence(2, (48, 40));
    let check = |view: &str, scene: &str, metrics: &str| {
        let text = format!(
            "name = \"e\"\n[view]\n{view}\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n{scene}\n[[method]]\nname = \"m\"\ntest = \"test\"\n[metrics]\n{metrics}\n"
        );
        folder.write("e.toml", text);
        folder.run(&["check", "e.toml"])
    };
    let fails = |view: &str, scene: &str, metrics: &str, words: &[&str]| {
        let run = check(view, scene, metrics);
        assert_eq!(run.code, 2, "{}", run.stderr);
        run.says(words);
    };
    let fov = "fov_vertical_deg = 60";
    fails(
        fov,
        "fps = 30",
        "fvvdp = {}",
        &["fvvdp needs the display's photometry", "e.toml:12:1", "luminance = "],
    );
    fails(
        "display = \"vive-pro-eye\"",
        "fps = 30",
        "pu_psnr = {}",
        &["pu_psnr needs the display's photometry"],
    );
    let lit = |luminance: &str| format!("{fov}\nluminance = {luminance}");
    fails(
        &lit("\"vive-pro-eye\""),
        "fps = 30",
        "fvvdp = {}",
        &["vive-pro-eye has no photometry", "e.toml:4:1"],
    );
    fails(&lit("\"htc-vive\""), "fps = 30", "fvvdp = {}", &["did you mean \"htc_vive_pro\"?"]);
    fails(&lit("{ contrast = 100 }"), "fps = 30", "fvvdp = {}", &["has no peak_cd_m2"]);
    fails(
        &lit("{ peak_cd_m2 = 100, eotf = \"hlg\" }"),
        "fps = 30",
        "fvvdp = {}",
        &["eotf cannot be \"hlg\""],
    );
    fails(
        &lit("{ peak_cd_m2 = 10, min_cd_m2 = 20 }"),
        "fps = 30",
        "fvvdp = {}",
        &["the display's black of 20"],
    );
    fails(
        &lit("\"htc-vive-pro\""),
        "transfer = \"pq\"\nfps = 30",
        "fvvdp = {}",
        &["encoded as PQ"],
    );
    fails(
        &lit("\"htc-vive-pro\""),
        "fps = 30",
        "fvvdp = { temp_padding = \"none\" }",
        &["temp_padding cannot be \"none\""],
    );
    fails(
        &lit("\"htc-vive-pro\""),
        "",
        "fvvdp = {}",
        &["s: FovVideoVDP of a sequence needs the frame rate", "give fps"],
    );
    fails(&lit("\"htc-vive-pro\""), "fps = 3", "fvvdp = {}", &["the sequence has 3"]);
    let run = check(
        &lit("{ peak_cd_m2 = 100, gamma = 2.4, eotf = \"gamma\" }"),
        "fps = 30",
        "fvvdp = {}",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    folder.run(&["run", "e.toml", "--maps", "maps", "--output", "out"]).ok();
    check(fov, "fps = 30", "ms_ssim = {}");
    folder
        .run(&["run", "e.toml", "--maps", "maps"])
        .fails(2, &["none of the metrics has a map", "such as ssim = {}"]);
}
