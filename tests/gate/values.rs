//! `fovqa gate`: the value of every rule against what `fovqa score` finds, margins and verdicts.

use serde_json::Value;

use crate::fovqa::Folder;
use crate::gate::experiments::{
    Expected, check, experiment, gate, largest, mean, near, number, only, percentile, sequence,
    smallest, write_frames,
};

const VIEW: &str = "fov_vertical_deg = 60\nbands_deg = [0, 5, 10, 20, 30, 50]";
const METRICS: &str = "[metrics]\nmse = {}\npsnr = {}\nssim = {}\nfpsnr = {}\nrms_contrast = {}\nhaar = { levels = 3, orientations = true }\natd = {}\n";

/// What `fovqa score` finds of a pair of folders, seen as [`VIEW`] says.
fn scores(folder: &Folder, [gt, test]: [&str; 2]) -> Value {
    folder.json(&[
        gt,
        test,
        "--fov-vertical",
        "60",
        "--bands",
        "0,5,10,20,30,50",
        "--metrics",
        "mse,psnr,ssim,fpsnr,rms-contrast,haar,atd",
        "--set",
        "haar.levels=3",
        "--set",
        "haar.orientations=true",
    ])
}

fn frames(scores: &Value) -> &Vec<Value> {
    scores["frames"].as_array().unwrap()
}

fn all(scores: &Value, of: impl Fn(&Value) -> f64) -> Vec<f64> {
    frames(scores).iter().map(of).collect()
}

/// The bands of a frame from the first up to an edge.
fn bands(frame: &Value, to: f64) -> Vec<&Value> {
    let bands = frame["bands"].as_array().unwrap().iter();
    bands.filter(|band| band["to_deg"].as_f64().unwrap() <= to).collect()
}

/// A value of several bands, weighted by a count of theirs.
fn pooled(bands: &[&Value], count: &str, of: impl Fn(&Value) -> f64) -> f64 {
    let weight = |band: &Value| band[count].as_f64().unwrap();
    let filled = || bands.iter().filter(|band| weight(band) > 0.0);
    let sum: f64 = filled().map(|band| of(band) * weight(band)).sum();
    sum / filled().map(|band| weight(band)).sum::<f64>()
}

fn psnr(mse: f64) -> f64 {
    -10.0 * mse.log10()
}

fn limit_of(metric: &str) -> &'static str {
    if matches!(metric, "mse" | "atd") { "at_most = 1e9" } else { "at_least = -1e9" }
}

fn rule(metric: &str, rest: &str, value: f64) -> Expected {
    let rule = format!("metric = \"{metric}\"\n{rest}\n{}", limit_of(metric));
    Expected { rule, value, worst: None }
}

fn aggregated(word: &str, values: &[f64]) -> f64 {
    match word {
        "mean" => mean(values),
        "min" => smallest(values),
        "max" => largest(values),
        percent => percentile(percent[1..].parse().unwrap(), values),
    }
}

const AGGREGATES: [&str; 9] = ["mean", "min", "max", "p01", "p05", "p25", "p50", "p75", "p99"];

#[test]
fn every_aggregate_is_of_the_values_of_the_frames() {
    let folder = sequence();
    let scores = scores(&folder, ["gt", "test"]);
    let mut rules = Vec::new();
    for metric in ["mse", "psnr", "ssim", "fpsnr"] {
        let values = all(&scores, |frame| number(&frame["metrics"][metric]));
        // Of decibels, over the frames that differ.
        let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        for word in AGGREGATES {
            let of = if word == "mean" { &finite } else { &values };
            let value = aggregated(word, of);
            let rest = format!("aggregate = \"{word}\"");
            rules.push(Expected { worst: Some((1, values[1])), ..rule(metric, &rest, value) });
        }
        rules.push(rule(metric, "", mean(&finite)));
    }
    for metric in ["psnr", "fpsnr"] {
        let value = number(&scores["summary"][metric][format!("{metric}_pooled")]);
        rules.push(rule(metric, "statistic = \"pooled\"", value));
    }
    check(&folder, &experiment(VIEW, "", METRICS), &rules);
}

#[test]
fn bands_are_put_together_by_what_is_in_them() {
    let folder = sequence();
    let scores = scores(&folder, ["gt", "test"]);
    let mut rules = Vec::new();
    for to in [5.0, 10.0, 30.0, 50.0] {
        let mse = all(&scores, |f| pooled(&bands(f, to), "pixels", |band| number(&band["mse"])));
        let of = |f: &Value| pooled(&bands(f, to), "ssim_map_pixels", |b| number(&b["ssim"]));
        let ssim = all(&scores, of);
        if to > 49.0 {
            // All bands together are the frame.
            let whole = all(&scores, |f| number(&f["metrics"]["ssim"]));
            assert!(whole.iter().zip(&ssim).all(|(a, b)| (a - b).abs() < 1e-12));
        }
        let psnrs: Vec<f64> = mse.iter().map(|mse| psnr(*mse)).collect();
        for word in AGGREGATES {
            let finite: Vec<f64> = psnrs.iter().copied().filter(|p| p.is_finite()).collect();
            let of = if word == "mean" { &finite } else { &psnrs };
            let rest = format!("band_deg = [0, {to}]\naggregate = \"{word}\"");
            rules.push(rule("psnr", &rest, aggregated(word, of)));
            rules.push(rule("mse", &rest, aggregated(word, &mse)));
            rules.push(rule("ssim", &rest, aggregated(word, &ssim)));
        }
        // The gaze stays, and so do the pixels of a band.
        let pooled = format!("band_deg = [0, {to}]\nstatistic = \"pooled\"");
        rules.push(rule("psnr", &pooled, psnr(mean(&mse))));
    }
    let contrast = |image: &str| all(&scores, |f| number(&bands(f, 5.0)[0]["rms_contrast"][image]));
    for image in ["reference", "test"] {
        let rest = format!("band_deg = [0, 5]\nimage = \"{image}\"\naggregate = \"p25\"");
        rules.push(rule("rms_contrast", &rest, percentile(25.0, &contrast(image))));
    }
    let ratio = mean(&contrast("test")) / mean(&contrast("reference"));
    rules.push(rule("rms_contrast", "band_deg = [0, 5]\nimage = \"ratio\"", ratio));
    let least = smallest(&contrast("ratio"));
    rules.push(rule(
        "rms_contrast",
        "band_deg = [0, 5]\nimage = \"ratio\"\naggregate = \"min\"",
        least,
    ));
    check(&folder, &experiment(VIEW, "", METRICS), &rules);
}

/// A statistic of the wavelet of one picture in bands up to an edge, by coefficients or the largest.
fn haar(frame: &Value, level: u64, to: f64, image: &str, statistic: &str) -> f64 {
    let entries = frame["haar"].as_array().unwrap().iter();
    let entries = entries.filter(|e| e["level"] == level && e["to_deg"].as_f64().unwrap() <= to);
    let (mut sum, mut count, mut most) = (0.0, 0.0, 0.0f64);
    for entry in entries {
        let coefficients = entry["coefficients"].as_f64().unwrap();
        let (plain, orientation) = statistic.rsplit_once('_').unwrap_or((statistic, ""));
        let values = if matches!(orientation, "lh" | "hl" | "hh") {
            &entry["orientations"][orientation][image][plain]
        } else {
            &entry[image][statistic]
        };
        if coefficients > 0.0 {
            sum += number(values) * coefficients;
            count += coefficients;
            most = most.max(number(values));
        }
    }
    if statistic.starts_with("max_abs") { most } else { sum / count }
}

#[test]
fn the_wavelet_is_put_together_by_coefficients() {
    let folder = sequence();
    let scores = scores(&folder, ["gt", "test"]);
    let mut rules = Vec::new();
    for statistic in ["energy", "mean_abs", "max_abs", "energy_hl", "max_abs_hh"] {
        for (level, to) in [(1, 5.0), (1, 20.0), (2, 30.0), (3, 10.0), (3, 50.0)] {
            let of = |image: &str| all(&scores, |f| haar(f, level, to, image, statistic));
            let (reference, test) = (of("reference"), of("test"));
            let ratios: Vec<f64> = test.iter().zip(&reference).map(|(t, r)| t / r).collect();
            let rest =
                format!("statistic = \"{statistic}\"\nlevel = {level}\nband_deg = [0, {to}]");
            // By default the mean over frames, and of largest values the largest.
            let usual = if statistic.starts_with("max_abs") { largest } else { mean };
            rules.push(rule("haar", &format!("{rest}\nimage = \"test\""), usual(&test)));
            let mut add = |image: &str, word: &str, value: f64| {
                let rest = format!("{rest}\nimage = \"{image}\"\naggregate = \"{word}\"");
                rules.push(rule("haar", &rest, value));
            };
            add("test", "mean", mean(&test));
            add("reference", "max", largest(&reference));
            add("ratio", "min", smallest(&ratios));
            add("ratio", "p50", percentile(50.0, &ratios));
            let whole = if statistic.starts_with("max_abs") { largest } else { mean };
            add("ratio", "mean", whole(&test) / whole(&reference));
        }
    }
    check(&folder, &experiment(VIEW, "", METRICS), &rules);
}

#[test]
fn differences_over_time_are_of_the_test_unless_the_rule_says() {
    let folder = sequence();
    let scores = scores(&folder, ["gt", "test"]);
    let atd = &scores["sequence"]["atd"];
    let of_frames: Vec<f64> =
        frames(&scores)[1..].iter().map(|f| number(&f["atd"]["test"])).collect();
    let in_band: Vec<f64> =
        frames(&scores)[1..].iter().map(|f| number(&f["bands"][1]["atd"]["test"])).collect();
    let mut rules = vec![
        rule("atd", "", number(&atd["test"])),
        rule("atd", "image = \"test\"\naggregate = \"max\"", largest(&of_frames)),
        rule("atd", "image = \"ratio\"", number(&atd["ratio"])),
        rule("atd", "band_deg = [5, 10]", mean(&in_band)),
    ];
    let reference = Expected {
        rule: "metric = \"atd\"\nimage = \"reference\"\nat_least = 0\nat_most = 1".to_owned(),
        value: number(&atd["reference"]),
        worst: None,
    };
    rules.push(reference);
    check(&folder, &experiment(VIEW, "", METRICS), &rules);
}

#[test]
fn eyes_have_values_of_their_own_and_together() {
    let folder = Folder::new();
    write_frames(&folder, ["gt/left", "test/left"], 1, &[20.0, 40.0]);
    write_frames(&folder, ["gt/right", "test/right"], 20, &[35.0, 15.0]);
    let left = scores(&folder, ["gt/left", "test/left"]);
    let right = scores(&folder, ["gt/right", "test/right"]);
    let of = |scores: &Value, metric: &str| all(scores, |f| number(&f["metrics"][metric]));
    let both = |metric: &str| -> Vec<f64> {
        let pairs = of(&left, metric).into_iter().zip(of(&right, metric));
        pairs.map(|(left, right)| f64::midpoint(left, right)).collect()
    };
    let mse = both("mse");
    let mut rules = vec![
        rule("mse", "", mean(&mse)),
        rule("ssim", "eye = \"both\"\naggregate = \"min\"", smallest(&both("ssim"))),
        rule("psnr", "aggregate = \"min\"", psnr(largest(&mse))),
    ];
    for (eye, scores) in [("left", &left), ("right", &right)] {
        let rest = format!("eye = \"{eye}\"");
        for metric in ["mse", "ssim", "psnr"] {
            rules.push(rule(metric, &rest, mean(&of(scores, metric))));
        }
        let near_gaze =
            all(scores, |f| pooled(&bands(f, 10.0), "pixels", |band| number(&band["mse"])));
        rules.push(rule("mse", &format!("{rest}\nband_deg = [0, 10]"), mean(&near_gaze)));
    }
    let text = experiment(VIEW, "", METRICS)
        .replace("\"gt\"", "\"gt/{eye}\"")
        .replace(
            "reference = \"gt/{eye}\"",
            "reference = { left = \"gt/left\", right = \"gt/right\" }",
        )
        .replace("\"test\"", "\"test/{eye}\"");
    check(&folder, &text, &rules);
}

#[test]
fn visible_difference_is_of_the_sequence_its_frames_and_bands() {
    let folder = sequence();
    let scores = folder.json(&[
        "gt",
        "test",
        "--metrics",
        "fvvdp",
        "--display",
        "htc-vive-pro",
        "--fps",
        "30",
        "--bands",
        "0,5,10,20,30,80",
    ]);
    let of = |key: &str| all(&scores, |f| number(&f["fvvdp"][key]));
    // Sharing needs a difference: the identical frame has one over time, as the eye is slow.
    let share = |f: &Value| {
        bands(f, 20.0).iter().map(|band| number(&band["fvvdp_share"])).filter(|s| !s.is_nan()).sum()
    };
    let shares: Vec<f64> = all(&scores, share);
    let sustained = all(&scores, |f| number(&f["fvvdp"]["spatial_bands"][1]["sustained"]));
    let lower = |rest: &str, value: f64| Expected {
        rule: format!("metric = \"fvvdp\"\n{rest}\nat_most = 1e9"),
        value,
        worst: None,
    };
    let jods = of("frame_jod");
    let worst = jods.iter().position(|jod| *jod <= smallest(&jods)).unwrap();
    let rules = [
        Expected {
            worst: Some((worst as u64, jods[worst])),
            ..rule("fvvdp", "", number(&scores["sequence"]["fvvdp"]["jod"]))
        },
        rule("fvvdp", "statistic = \"frame_jod\"\naggregate = \"min\"", smallest(&jods)),
        lower("statistic = \"q\"\naggregate = \"max\"", largest(&of("q"))),
        lower("statistic = \"q_sustained\"\nlevel = 2", mean(&sustained)),
        lower("statistic = \"share\"\nband_deg = [0, 20]\naggregate = \"max\"", largest(&shares)),
    ];
    let view = "display = \"htc_vive_pro\"\nbands_deg = [0, 5, 10, 20, 30, 80]";
    check(&folder, &experiment(view, "fps = 30", "[metrics]\nfvvdp = {}\n"), &rules);
}

#[test]
fn margins_are_kept_distances_and_the_tightest_limit_counts() {
    let folder = sequence();
    let scores = scores(&folder, ["gt", "test"]);
    let energy = all(&scores, |f| haar(f, 1, 20.0, "test", "energy"));
    let value = mean(&energy);
    let haar = "[[gate]]\nmetric = \"haar\"\nstatistic = \"energy\"\nimage = \"test\"\nlevel = 1\nband_deg = [0, 20]\n";
    let lowest = energy.iter().position(|e| *e <= smallest(&energy)).unwrap();
    let highest = energy.iter().position(|e| *e >= largest(&energy)).unwrap();
    for (least, most, margin, limit, worst) in [
        (0.5, 2.0, 0.5, 0.5, lowest),
        (0.5, 1.25, 0.25, 1.25, highest),
        (0.75, 1.5, 0.25, 0.75, lowest),
        (1.5, 3.0, -0.5, 1.5, lowest),
        (0.1, 0.75, -0.25, 0.75, highest),
    ] {
        let (least, most) = (value * least, value * most);
        let text = format!("{METRICS}{haar}at_least = {least:?}\nat_most = {most:?}\n");
        let (run, verdict) = gate(&folder, &experiment(VIEW, "", &text), &[]);
        let check = only(&verdict);
        assert_eq!(run.code, i32::from(margin < 0.0), "{verdict:#}");
        near("limit", &check["limit"], value * limit);
        near("margin", &check["margin"], value * margin);
        assert_eq!(check["worst_frame"], worst as u64, "{verdict:#}");
        assert_eq!(check["state"], if margin < 0.0 { "failed" } else { "passed" });
    }
    // Equal is inside.
    let mse = mean(&all(&scores, |f| number(&f["metrics"]["mse"])));
    let text = format!("{METRICS}[[gate]]\nmetric = \"mse\"\nat_most = {mse:?}\n");
    let (run, verdict) = gate(&folder, &experiment(VIEW, "", &text), &[]);
    assert_eq!((run.code, number(&only(&verdict)["margin"])), (0, 0.0));
    let below = f64::from_bits(mse.to_bits() - 1);
    let text = format!("{METRICS}[[gate]]\nmetric = \"mse\"\nat_most = {below:?}\n");
    let (run, verdict) = gate(&folder, &experiment(VIEW, "", &text), &[]);
    assert_eq!(run.code, 1, "{verdict:#}");
    let reason = only(&verdict)["reason"].as_str().unwrap();
    assert_eq!(reason, format!("mse mean is {mse}, above {below}"));
}
