//! Every number of independent implementations, through the command, within the tolerances of docs/metrics.md.

use std::path::Path;

use fovqa_testkit::golden::{AtdValues, Case, Haar, atd, cases};
use serde_json::Value;

use crate::fovqa::{Run, command, root, shared};

/// Largest deviations from scikit-image and NumPy (docs/metrics.md).
const PSNR_DB: f64 = 1e-4;
const SSIM: f64 = 1e-5;
const RMS_CONTRAST: f64 = 1e-6;
/// Relative deviations from PyWavelets and NumPy.
const HAAR: f64 = 1e-5;
const ATD: f64 = 1e-4;

fn score(folder: &Path, case: &Case, channels: &str) -> Value {
    let file = |name: &str| folder.join(name).display().to_string();
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let metrics = "mse,psnr,ssim,fpsnr,fssim,rms-contrast,haar".to_owned()
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
                for (side, contrast) in
                    [("reference", band.rms_contrast_reference), ("test", band.rms_contrast_test)]
                {
                    let found = &found["rms_contrast"][side];
                    assert!(contrast.is_some(), "{what}: no contrast to hold it to");
                    near(&format!("{what} contrast {side}"), found, contrast, RMS_CONTRAST);
                }
            }
            check_haar(&case.id, &frame["haar"], "reference", &case.haar_reference);
            check_haar(&case.id, &frame["haar"], "test", &case.haar_test);
        }
    }
}

/// All levels and bands of one picture; where the golden values have none, there is none.
fn check_haar(id: &str, found: &Value, side: &str, golden: &[Haar]) {
    let found = found.as_array().unwrap();
    assert!(!golden.is_empty());
    for Haar { level, from_deg, to_deg, coefficients, mean_abs, max_abs, energy } in golden {
        let is_it = |h: &&Value| h["level"] == *level && h["from_deg"] == *from_deg;
        let found = found.iter().find(is_it).unwrap();
        let what = format!("{id} {side} level {level} from {from_deg}°");
        assert_eq!(found["to_deg"], *to_deg, "{what}");
        assert_eq!(found["coefficients"], *coefficients, "{what}");
        for (statistic, want) in [("mean_abs", mean_abs), ("max_abs", max_abs), ("energy", energy)]
        {
            let what = format!("{what} {statistic}");
            near(&what, &found[side][statistic], Some(*want), HAAR * want);
        }
    }
    let some = found.iter().filter(|found| found["coefficients"] != 0).count();
    assert_eq!(some, golden.len(), "{id}");
}

/// The differences over time of both methods of a sequence, along the motion in its ground truth.
fn check_atd(golden: &Path, data: &Path) {
    let golden = atd(golden);
    let exposure = golden.exposure_stops.to_string();
    let reference = data.join("gt").display().to_string();
    for method in ["rmfr_noaa", "rmfr_taa"] {
        let test = data.join(method).display().to_string();
        for (values, tolerance) in [
            (&golden.atd, "atd.depth_tolerance=0.05"),
            (&golden.atd_borders_only, "atd.depth_tolerance=off"),
        ] {
            let arguments = [
                "score",
                &reference,
                &test,
                "--metrics",
                "atd",
                "--exposure",
                &exposure,
                "--set",
                tolerance,
                "--format",
                "json",
            ];
            let json = Run::from(command(&arguments).output().unwrap()).ok().json();
            let with_depth = !tolerance.ends_with("off");
            let all = &json["sequence"]["atd"];
            assert_eq!(all["motion"], "reference");
            assert_eq!(all["depth"], if with_depth { "reference" } else { "none" });
            for (side, sequence) in [("reference", "gt"), ("test", method)] {
                let AtdValues { mean, frames } = &values[sequence];
                let what = format!("{sequence} {tolerance}");
                near(&what, &all[side], Some(*mean), ATD * mean);
                let found = json["frames"].as_array().unwrap();
                assert_eq!((found.len(), found[0].get("atd")), (frames.len() + 1, None));
                for (found, want) in found[1..].iter().zip(frames) {
                    let what = format!("{what} frame {}", found["frame"]);
                    near(&what, &found["atd"][side], Some(*want), ATD * want);
                }
            }
            if with_depth {
                let left_out = &golden.left_out;
                let mean = left_out.iter().sum::<f64>() / left_out.len() as f64;
                near("left out", &all["left_out"], Some(mean), 1e-12);
                assert_eq!(all.get("left_out_test"), None, "the test has no motion of its own");
                for (frame, want) in left_out.iter().enumerate() {
                    let found = &json["frames"][frame + 1]["atd"];
                    near(&format!("left out of {frame}"), &found["left_out"], Some(*want), 1e-12);
                    assert_eq!(found["left_out"], found["left_out_test"]);
                }
            }
        }
    }
}

#[test]
fn differences_over_time_of_the_committed_sequence() {
    check_atd(&root().join("tests/golden/small"), &root().join("tests/data/small/classroom"));
}

#[test]
fn differences_over_time_of_the_long_sequence() {
    if let (Some(golden), Some(data)) = (shared("golden/sequence"), shared("data/sequence")) {
        check_atd(&golden, &data);
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
