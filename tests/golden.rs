//! Every number of independent implementations, through the command, within the tolerances of docs/metrics.md.

use std::path::Path;

use fovqa_testkit::golden::{Case, cases};
use serde_json::Value;

use crate::fovqa::{Run, command, root, shared};

/// Largest deviations from scikit-image and NumPy (docs/metrics.md).
const PSNR_DB: f64 = 1e-4;
const SSIM: f64 = 1e-5;

fn score(folder: &Path, case: &Case, channels: &str) -> Value {
    let file = |name: &str| folder.join(name).display().to_string();
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let metrics = "mse,psnr,ssim,fpsnr,fssim".to_owned()
        + if case.width.min(case.height) >= 176 { ",ms-ssim" } else { "" };
    let (reference, test) = (file(&case.reference), file(&case.test));
    let (fov, bands) = (case.vfov_deg.to_string(), list(&case.bands_deg));
    let gaze = case.gaze.map(|gaze| list(&gaze));
    let mut arguments = vec![
        "score",
        &reference,
        &test,
        "--fov-vertical",
        &fov,
        "--bands",
        &bands,
        "--channels",
        channels,
        "--metrics",
        &metrics,
        "--format",
        "json",
    ];
    if let Some(gaze) = &gaze {
        arguments.extend(["--gaze", gaze]);
    }
    Run::from(command(&arguments).output().unwrap()).ok().json()["frames"][0].clone()
}

#[track_caller]
fn near(what: &str, got: &Value, want: Option<f64>, tolerance: f64) {
    match want {
        None => assert_eq!(got, "inf", "{what}"),
        Some(want) => {
            let got = got.as_f64().unwrap_or_else(|| panic!("{what}: {got}"));
            assert!((got - want).abs() <= tolerance, "{what}: {got} for {want}");
        }
    }
}

fn check(folder: &Path) {
    let cases = cases(folder);
    assert!(!cases.is_empty());
    for case in &cases {
        for channels in ["rgb", "luma"] {
            let frame = score(folder, case, channels);
            let found = &frame["metrics"];
            let rgb = channels == "rgb";
            let pick = |rgb_value, luma_value| if rgb { rgb_value } else { luma_value };
            let what = |metric: &str| format!("{} {metric} {channels}", case.id);
            near(&what("psnr"), &found["psnr"], pick(case.psnr_rgb, case.psnr_luma), PSNR_DB);
            near(&what("fpsnr"), &found["fpsnr"], pick(case.fpsnr_rgb, case.fpsnr_luma), PSNR_DB);
            near(
                &what("ssim"),
                &found["ssim"],
                pick(Some(case.ssim_rgb), Some(case.ssim_luma)),
                SSIM,
            );
            near(
                &what("fssim"),
                &found["fssim"],
                pick(Some(case.fssim_rgb), Some(case.fssim_luma)),
                SSIM,
            );
            let ms_ssim = pick(case.ms_ssim_rgb, case.ms_ssim_luma);
            if ms_ssim.is_some() {
                near(&what("ms_ssim"), &found["ms_ssim"], ms_ssim, SSIM);
            }
            if !rgb {
                continue;
            }
            near(&what("mse"), &found["mse"], Some(case.mse_rgb), 1e-12);
            let bands = frame["bands"].as_array().unwrap();
            assert_eq!(bands.len(), case.bands_deg.len() - 1);
            for band in case.bands.iter().filter(|band| band.pixels > 0) {
                let found = bands.iter().find(|b| b["from_deg"] == band.from_deg).unwrap();
                let what = what(&format!("band {}", band.from_deg));
                assert_eq!(found["pixels"], band.pixels, "{what}");
                assert_eq!(found["to_deg"], band.to_deg, "{what}");
                near(&what, &found["psnr"], band.psnr, PSNR_DB);
            }
        }
    }
}

#[test]
fn committed_renders() {
    check(&root().join("tests/golden/small"));
}

#[test]
fn photographs() {
    if let Some(folder) = shared("golden/classic") {
        check(&folder);
    }
}

#[test]
fn full_size_renders() {
    if let Some(folder) = shared("golden/stills") {
        check(&folder);
    }
}
