//! Table, JSON, CSV, lists, help, completions, exit of a closed pipe, threads.

use std::process::Stdio;

use crate::fovqa::{Folder, Run, command};

#[test]
fn json_has_the_documented_keys() {
    let folder = Folder::with_pair();
    let json = folder.json(&["a.png", "b.png", "--fov-vertical", "60"]);
    assert_eq!(json["schema"], "fovqa.score/1");
    assert_eq!(json["version"], env!("CARGO_PKG_VERSION"));
    let view = &json["view"];
    assert_eq!((&view["width"], &view["height"]), (&48.into(), &40.into()));
    assert_eq!(view["gaze_px"], serde_json::json!([24.0, 20.0]));
    assert!((view["focal_px"][0].as_f64().unwrap() - 34.641_016).abs() < 1e-5);
    assert_eq!(view["eccentricity"], "angular");
    let frame = &json["frames"][0];
    assert_eq!(
        (&frame["frame"], &frame["reference"], &frame["test"]),
        (&0.into(), &"a.png".into(), &"b.png".into())
    );
    let metrics: Vec<_> = frame["metrics"].as_object().unwrap().keys().collect();
    assert_eq!(metrics, ["fpsnr", "mse", "psnr", "ssim"], "the default, and no more");
    let band = &frame["bands"][1];
    assert_eq!((&band["from_deg"], &band["to_deg"]), (&5.0.into(), &10.0.into()));
    assert!(band["pixels"].is_u64() && band["psnr"].is_f64() && band["ssim"].is_f64());
    let pixels: u64 =
        frame["bands"].as_array().unwrap().iter().map(|b| b["pixels"].as_u64().unwrap()).sum();
    assert_eq!(pixels, 48 * 40, "default bands hold every pixel");
    let summary = &json["summary"]["psnr"];
    assert_eq!(summary["mean"], frame["metrics"]["psnr"]);
    assert_eq!(summary["identical_frames"], 0);
    assert!(json["sequence"].is_object());
    assert!(json.get("errors").is_none());
}

#[test]
fn identical_pictures_are_inf_and_one() {
    let folder = Folder::with_pair();
    let run = folder.score(&["a.png", "a.png", "--fov-vertical", "60", "--format", "json"]).ok();
    let frame = &run.json()["frames"][0];
    assert_eq!(frame["metrics"]["psnr"], "inf");
    assert_eq!(frame["metrics"]["fpsnr"], "inf");
    assert_eq!(frame["metrics"]["ssim"], 1.0);
    assert_eq!(frame["metrics"]["mse"], 0.0);
    assert_eq!(frame["bands"][0]["psnr"], "inf");
    let csv = folder.score(&["a.png", "a.png", "--format", "csv"]).ok().stdout;
    assert!(csv.contains("psnr,,,,,inf\n"), "{csv}");
    assert!(folder.score(&["a.png", "a.png"]).ok().stdout.contains("inf"));
}

#[test]
fn csv_is_one_tidy_table() {
    let folder = Folder::with_pair();
    let arguments = ["a.png", "b.png", "--fov-vertical", "60", "--bands", "0,10,20,80"];
    let csv = folder.score(&[&arguments[..], &["--format", "csv"]].concat()).ok().stdout;
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some(
            "scene,method,parameters,eye,frame,image,metric,statistic,level,from_deg,to_deg,value"
        )
    );
    assert!(!csv.contains('\r'));
    let json = folder.json(&arguments);
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 12));
    let value = |metric: &str, from: &str| {
        let row = rows.iter().find(|r| r[4] == "0" && r[6] == metric && r[9] == from).unwrap();
        row[11].parse::<f64>().unwrap()
    };
    assert_eq!(Some(value("psnr", "")), json["frames"][0]["metrics"]["psnr"].as_f64());
    assert_eq!(Some(value("psnr", "10.0")), json["frames"][0]["bands"][1]["psnr"].as_f64());
    assert_eq!(Some(value("pixels", "20.0")), json["frames"][0]["bands"][2]["pixels"].as_f64());
}

#[test]
fn the_table_shows_values_and_bands() {
    let folder = Folder::with_pair();
    let table = folder
        .score(&["a.png", "b.png", "--fov-vertical", "60", "--metrics", "psnr,ssim"])
        .ok()
        .stdout;
    assert!(table.starts_with("b.png against a.png\n"), "{table}");
    for word in ["PSNR dB", "SSIM", "eccentricity", "0° to 5°", "focal length 34.64 px"] {
        assert!(table.contains(word), "{word} is not in\n{table}");
    }
    assert!(table.lines().all(|line| line.trim_end() == line), "no blanks behind a line");
}

#[test]
fn a_band_without_pixels_is_kept_with_null() {
    let folder = Folder::with_pair();
    let json = folder.json(&["a.png", "b.png", "--fov-vertical", "60", "--bands", "10,20,90,100"]);
    let frame = &json["frames"][0];
    let empty = &frame["bands"][2];
    assert_eq!(empty["pixels"], 0);
    assert!(empty["psnr"].is_null() && empty["ssim"].is_null() && empty["mse"].is_null());
    let arguments = ["a.png", "b.png", "--fov-vertical", "60", "--bands", "10,20,90,100"];
    let table = folder.score(&arguments).ok().stdout;
    assert!(table.contains("pixels lie outside all bands"), "{table}");
    let csv = folder.score(&[&arguments[..], &["--format", "csv"]].concat()).ok().stdout;
    assert!(csv.contains("pair,pixels_outside_bands,"), "{csv}");
    let inside: u64 =
        frame["bands"].as_array().unwrap().iter().map(|b| b["pixels"].as_u64().unwrap()).sum();
    assert_eq!(frame["pixels_outside_bands"], 48 * 40 - inside);
}

#[test]
fn default_metrics_that_do_not_fit_are_left_out_and_said() {
    let folder = Folder::with_pair();
    folder.png_pair("s.png", "t.png", 10, 10);
    let run = folder.score(&["s.png", "t.png", "--format", "json"]).ok().says(&[
        "FPSNR is left out: it needs a view",
        "SSIM is left out: SSIM needs 11 pixels on each side; the frame has 10x10",
    ]);
    let json = run.json();
    let metrics: Vec<_> = json["frames"][0]["metrics"].as_object().unwrap().keys().collect();
    assert_eq!(metrics, ["mse", "psnr"]);
    assert!(json["view"].is_null());
    folder.score(&["s.png", "t.png", "--metrics", "ssim"]).fails(3, &["SSIM needs 11 pixels"]);
    folder
        .score(&["a.png", "b.png", "--metrics", "ms-ssim"])
        .fails(3, &["MS-SSIM needs 176 pixels"]);
}

#[test]
fn a_flat_foveal_weight_is_said() {
    let folder = Folder::with_pair();
    let view = |fov: &str| {
        let run = folder.score(&["a.png", "b.png", "--fov-vertical", fov, "--format", "json"]).ok();
        let metrics = run.json()["frames"][0]["metrics"].clone();
        let (psnr, fpsnr) = (metrics["psnr"].as_f64().unwrap(), metrics["fpsnr"].as_f64().unwrap());
        ((psnr - fpsnr).abs() < 1e-6, run.stderr.contains("the foveal weight is constant"))
    };
    assert_eq!(view("60"), (true, true));
    // A tenth of the angle in the same pixels: 6.7 px a degree, 3.3 cpd, still seen everywhere …
    assert_eq!(view("6"), (true, true));
    // … and 67 px a degree, more than the eye resolves even at the gaze.
    assert_eq!(view("0.6"), (false, false));
}

#[test]
fn a_closed_pipe_is_success() {
    let folder = Folder::with_pair();
    let (a, b) = (folder.path("a.png"), folder.path("b.png"));
    // More than any buffer holds, so that a row in the middle meets the closed pipe.
    let bands = (0..=900).map(|i| (f64::from(i) / 5.0).to_string()).collect::<Vec<_>>().join(",");
    let banded = ["--fov-vertical", "60", "--bands", &bands, "--format", "csv"];
    for arguments in [
        vec!["score", a.to_str().unwrap(), b.to_str().unwrap(), "--format", "json"],
        vec!["score", a.to_str().unwrap(), b.to_str().unwrap(), "--format", "csv"],
        vec!["score", a.to_str().unwrap(), b.to_str().unwrap()],
        [&["score", a.to_str().unwrap(), b.to_str().unwrap()][..], &banded].concat(),
        vec!["list", "displays"],
        vec!["completions", "bash"],
        vec!["--help"],
        vec!["--version"],
    ] {
        let mut child =
            command(&arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let run = Run::from(child.wait_with_output().unwrap());
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.stderr);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said() {
    let folder = Folder::with_pair();
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let arguments = [folder.path("a.png"), folder.path("b.png")].map(|p| p.display().to_string());
    let output = command(&["score", &arguments[0], &arguments[1]]).stdout(full).output().unwrap();
    Run::from(output).fails(3, &["the results cannot be written", "help:"]);
}

#[test]
fn help_lists_completions() {
    let folder = Folder::new();
    for help in [&["--help"][..], &["score", "--help"], &["list", "--help"]] {
        let text = folder.run(help).ok().stdout;
        assert!(text.contains("Usage: fovqa"), "{text}");
    }
    assert!(folder.run(&["score", "--help"]).stdout.contains("Exit codes"));
    assert_eq!(
        folder.run(&["--version"]).ok().stdout,
        format!("fovqa {}\n", env!("CARGO_PKG_VERSION"))
    );
    let metrics = folder.run(&["list", "metrics"]).ok().stdout;
    for word in ["ms_ssim", "--set ssim.sigma=1.5", "Lee, Pattichis, Bovik 2002", "dB"] {
        assert!(metrics.contains(word), "{word}");
    }
    let displays = folder.run(&["list", "displays"]).ok().stdout;
    for word in ["vive-pro-eye", "1440x1600", "110° diagonal", "75.40", "Patney et al. 2016"] {
        assert!(displays.contains(word), "{word}");
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(
            folder.run(&["completions", shell]).ok().stdout.contains("fov-vertical"),
            "{shell}"
        );
    }
}

#[test]
fn wrong_command_lines_are_exit_2() {
    let folder = Folder::with_pair();
    let with = |arguments: &[&str]| folder.score(&[&["a.png", "b.png"], arguments].concat());
    with(&["--metrics", "pnsr"]).fails(2, &["there is no such metric", "did you mean psnr?"]);
    with(&["--metrics", "fpsnr"]).fails(2, &["FPSNR needs a view", "--fov-vertical"]);
    with(&["--bands", "0,5"]).fails(2, &["eccentricity bands needs a view"]);
    with(&["--gaze", "3,4"]).fails(2, &["a gaze needs a view"]);
    with(&["--fov-vertical", "180"]).fails(2, &["180", "0°"]);
    with(&["--fov-vertical", "-5"]).fails(2, &["-5"]);
    with(&["--fov-vertical", "60", "--display", "vive-pro-eye"]).fails(2, &["more than one way"]);
    with(&["--display", "vive"]).fails(2, &["no such display", "did you mean vive-pro-eye?"]);
    with(&["--frustum", "1,1,1"]).fails(2, &["L,R,U,D"]);
    with(&["--frustum", "1,-1,1,1"]).fails(2, &["must be positive"]);
    with(&["--distance-m", "1"]).fails(2, &["--pixel-pitch-mm"]);
    with(&["--fov-vertical", "60", "--bands", "5,0"]).fails(2, &["above the edge before"]);
    with(&["--fov-vertical", "60", "--gaze", "5"]).fails(2, &["X,Y"]);
    with(&["--set", "ssim.sigma=0"]).fails(2, &["ssim.sigma cannot be 0"]);
    with(&["--set", "ssim.sgima=1"]).fails(2, &["no parameter", "sigma"]);
    with(&["--set", "psnr.peak=1"]).fails(2, &["psnr has no parameter", "it has none"]);
    with(&["--set", "sigma"]).fails(2, &["METRIC.PARAM=VALUE"]);
    with(&["--crop", "0,0,0,4"]).fails(2, &["X,Y,W,H"]);
    with(&["--frames", "5"]).fails(2, &["A..B"]);
    with(&["--fps", "0"]).fails(2, &["above 0"]);
    with(&["--threads", "0"]).fails(2, &["threads"]);
    with(&["--threads", "99999999999"]).fails(2, &["1..=256"]);
    with(&["--set", "ssim.k1=1e30"]).fails(2, &["ssim.k1 cannot be", "0.001 to 1"]);
    with(&["--set", "ssim.sigma=1e-200"]).fails(2, &["0.1 to 64"]);
    with(&["--set", "fpsnr.alpha=1e300"]).fails(2, &["fpsnr.alpha"]);
    with(&["--frustum", "1e308,1e308,1,1"]).fails(2, &["at most 6000"]);
    with(&["--tonemap", "filmic"]).fails(2, &["clamp"]);
    folder.run(&["score", "a.png"]).fails(2, &["TEST"]);
    folder.run(&[]).fails(2, &["Usage"]);
}

#[test]
fn names_take_dashes_and_underscores_alike() {
    let folder = Folder::new();
    folder.png_pair("a.png", "b.png", 200, 180);
    let run = |metrics: &str, display: &str| {
        folder
            .score(&[
                "a.png",
                "b.png",
                "--metrics",
                metrics,
                "--display",
                display,
                "--format",
                "json",
            ])
            .ok()
            .stdout
    };
    assert_eq!(run("ms-ssim", "vive-pro-eye"), run("ms_ssim", "vive_pro_eye"));
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let folder = Folder::new();
    folder.png_pair("a.png", "b.png", 700, 531);
    let arguments = [
        "score",
        "a.png",
        "b.png",
        "--fov-vertical",
        "90",
        "--gaze",
        "333.3,70",
        "--metrics",
        "mse,psnr,ssim,ms-ssim,fpsnr,fssim",
        "--format",
        "json",
    ];
    let run = |threads: &str| {
        let mut command = command(&arguments);
        let output =
            command.env("RAYON_NUM_THREADS", threads).current_dir(folder.path("").as_path());
        Run::from(output.output().unwrap()).ok().stdout
    };
    let one = run("1");
    assert_eq!(one, run("8"));
    assert_eq!(one, run("3"));
    let option = folder.run(&[&arguments[..], &["--threads", "5"]].concat()).ok().stdout;
    assert_eq!(one, option);
}
