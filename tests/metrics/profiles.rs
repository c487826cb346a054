//! Profiles of reference and test, RMS contrast and the Haar wavelet: shapes, parameters, awkward cases.

use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::{Value, json};

use crate::fovqa::Folder;

const VIEW: [&str; 2] = ["--fov-vertical", "60"];
/// One band, of all pixels.
const ALL: [&str; 4] = ["--fov-vertical", "60", "--bands", "0,170"];

const W: usize = 52;
const H: usize = 44;

/// `a.png` and `b.png`, neither side of which is a multiple of anything.
fn folder() -> Folder {
    let folder = Folder::new();
    let reference = codes(W, H, 3, 1);
    folder.png("a.png", W, H, &reference);
    folder.png("b.png", W, H, &disturbed(&reference, 90.0, 2));
    folder
}

/// The first frame of `a.png` against `b.png`.
fn frame(folder: &Folder, arguments: &[&str]) -> Value {
    folder.json(&[&["a.png", "b.png"], arguments].concat())["frames"][0].clone()
}

fn keys(object: &Value) -> Vec<&str> {
    object.as_object().unwrap().keys().map(String::as_str).collect()
}

#[track_caller]
fn near(found: &Value, want: f64) {
    let number = found.as_f64().unwrap_or_else(|| panic!("{found} for {want}"));
    assert!((number - want).abs() <= 1e-6 * want.abs(), "{number} for {want}");
}

/// The luma of the pixels of a picture of [`codes`].
fn luma(codes: &[u8]) -> Vec<f64> {
    let of =
        |c: &[u8]| 0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2]);
    codes.chunks(3).map(|c| of(c) / 255.0).collect()
}

fn contrast(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let squared = values.iter().map(|value| (value - mean).powi(2));
    (squared.sum::<f64>() / values.len() as f64).sqrt()
}

/// LH, HL and HH of each block of a level, of a picture as wide as [`W`] without what is no multiple of the
/// coarsest block: the basis functions themselves.
fn coefficients(
    luma: &[f64],
    level: usize,
    levels: usize,
    counts: &dyn Fn(usize) -> bool,
) -> Vec<[f64; 3]> {
    let side = 1 << level;
    let (across, down) = (W >> levels << levels, (luma.len() / W) >> levels << levels);
    let mut found = Vec::new();
    for (j, i) in (0..down / side).flat_map(|j| (0..across / side).map(move |i| (j, i))) {
        let at = |dx: usize, dy: usize| (j * side + dy) * W + i * side + dx;
        let pixels = || (0..side).flat_map(|dy| (0..side).map(move |dx| (dx, dy)));
        if !pixels().all(|(dx, dy)| counts(at(dx, dy))) {
            continue;
        }
        let mut block = [0.0; 3];
        for (dx, dy) in pixels() {
            let value = luma[at(dx, dy)] / side as f64;
            let sign = |d: usize| if d < side / 2 { 1.0 } else { -1.0 };
            block[0] += value * sign(dy);
            block[1] += value * sign(dx);
            block[2] += value * sign(dx) * sign(dy);
        }
        found.push(block);
    }
    found
}

/// Mean |c|, max |c| and mean c².
#[track_caller]
fn is_of(found: &Value, coefficients: &[f64]) {
    let mean = |of: &dyn Fn(f64) -> f64| {
        coefficients.iter().map(|c| of(*c)).sum::<f64>() / coefficients.len() as f64
    };
    near(&found["mean_abs"], mean(&f64::abs));
    near(&found["max_abs"], coefficients.iter().fold(0.0, |max, c| c.abs().max(max)));
    near(&found["energy"], mean(&|c| c * c));
}

#[test]
fn default_metrics_have_profiles_of_the_documented_shape() {
    let folder = folder();
    let json = folder.json(&[&["a.png", "b.png"], &VIEW[..]].concat());
    let frame = &json["frames"][0];
    assert_eq!(keys(&frame["metrics"]), ["fpsnr", "mse", "psnr", "ssim"], "profiles are no scores");
    let bands = frame["bands"].as_array().unwrap();
    assert_eq!(
        keys(&bands[0]),
        ["from_deg", "mse", "pixels", "psnr", "rms_contrast", "ssim", "ssim_map_pixels", "to_deg"]
    );
    assert_eq!(keys(&bands[0]["rms_contrast"]), ["ratio", "reference", "test"]);
    let haar = frame["haar"].as_array().unwrap();
    let sides = ["coefficients", "from_deg", "level", "ratio", "reference", "test", "to_deg"];
    for (index, record) in haar.iter().enumerate() {
        // The bands of level 1, then those of level 2.
        let band = &bands[index % bands.len()];
        assert_eq!(record["level"], 1 + index / bands.len());
        assert_eq!((&record["from_deg"], &record["to_deg"]), (&band["from_deg"], &band["to_deg"]));
        if record["coefficients"] == 0 {
            continue;
        }
        assert_eq!(keys(record), sides);
        for side in ["reference", "test", "ratio"] {
            assert_eq!(keys(&record[side]), ["energy", "max_abs", "mean_abs"]);
        }
        let of = |side: &str| record[side]["energy"].as_f64().unwrap();
        assert_eq!(record["ratio"]["energy"], of("test") / of("reference"));
    }
    assert_eq!(haar.len(), 5 * bands.len());
    // Three a block of 2x2 of the 32x32 pixels that are whole blocks of the coarsest level.
    let of_level = |level: u64| {
        let records = haar.iter().filter(|record| record["level"] == level);
        records.map(|record| record["coefficients"].as_u64().unwrap()).sum::<u64>()
    };
    assert_eq!([1, 2, 3, 4, 5].map(of_level), [768, 192, 48, 12, 3]);
    let over_frames = &json["summary_haar"][0];
    assert_eq!(keys(over_frames), sides);
    assert_eq!(keys(&over_frames["test"]["energy"]), ["max", "mean", "min"]);
    assert_eq!(over_frames["ratio"], haar[0]["ratio"]);
    assert_eq!(
        json["summary_bands"][0]["rms_contrast"]["ratio"],
        bands[0]["rms_contrast"]["ratio"]
    );
}

#[test]
fn profiles_are_those_of_their_formulas() {
    let folder = folder();
    let json = frame(&folder, &ALL);
    let reference = codes(W, H, 3, 1);
    for (side, codes) in
        [("test", disturbed(&reference, 90.0, 2)), ("reference", reference.clone())]
    {
        let luma = luma(&codes);
        near(&json["bands"][0]["rms_contrast"][side], contrast(&luma));
        for level in 1..=5 {
            let found = &json["haar"][level - 1];
            let blocks = coefficients(&luma, level, 5, &|_| true);
            assert_eq!(found["coefficients"], 3 * blocks.len());
            is_of(&found[side], blocks.as_flattened());
        }
    }
}

#[test]
fn profiles_need_a_view() {
    let folder = folder();
    let run = folder.score(&["a.png", "b.png", "--format", "json"]).ok();
    for line in
        ["RMS contrast is left out: it needs a view", "Haar wavelet is left out: it needs a view"]
    {
        assert_eq!(run.stderr.matches(line).count(), 1, "{}", run.stderr);
    }
    let json = run.json();
    assert_eq!((json["frames"][0].get("haar"), json.get("summary_haar")), (None, None));
    assert_eq!(json["frames"][0]["bands"], json!([]));
    for (metric, label) in [("rms-contrast", "RMS contrast"), ("haar", "Haar wavelet")] {
        let arguments = ["a.png", "b.png", "--metrics", metric];
        folder.score(&arguments).fails(2, &[label, "view", "--fov-vertical"]);
    }
}

#[test]
fn a_picture_smaller_than_a_block_has_no_wavelet() {
    let folder = Folder::new();
    folder.png_pair("a.png", "b.png", 60, 31);
    let run = folder.score(&[&["a.png", "b.png", "--format", "json"], &VIEW[..]].concat()).ok();
    let line = "Haar wavelet needs 32 pixels on each side; the frame has 60x31";
    assert_eq!(run.stderr.matches(line).count(), 1, "{}", run.stderr);
    assert_eq!(run.json()["frames"][0].get("haar"), None);
    assert!(run.json()["frames"][0]["bands"][0]["rms_contrast"]["ratio"].is_f64());
    folder
        .score(&[&["a.png", "b.png", "--metrics", "haar"], &VIEW[..]].concat())
        .fails(3, &[line, "--metrics"]);
    let levels = ["--metrics", "haar", "--set", "haar.levels=4"];
    assert_eq!(frame(&folder, &[&levels[..], &ALL].concat())["haar"][3]["coefficients"], 9);
}

#[test]
fn the_wavelet_has_one_to_eight_levels() {
    let folder = Folder::new();
    folder.png_pair("a.png", "b.png", 300, 256);
    for levels in 1..=8usize {
        let set = format!("haar.levels={levels}");
        let json = frame(&folder, &[&["--metrics", "haar", "--set", &set], &ALL[..]].concat());
        let of: Vec<u64> = json["haar"]
            .as_array()
            .unwrap()
            .iter()
            .map(|h| h["coefficients"].as_u64().unwrap())
            .collect();
        let block = |side: usize, level: usize| (side >> levels << levels) >> level;
        let want: Vec<u64> =
            (1..=levels).map(|level| 3 * (block(300, level) * block(256, level)) as u64).collect();
        assert_eq!(of, want);
    }
    for wrong in ["0", "9", "2.5", "many"] {
        let set = format!("haar.levels={wrong}");
        folder
            .score(&[&["a.png", "b.png", "--set", &set], &VIEW[..]].concat())
            .fails(2, &["haar.levels", "a whole number from 1 to 8"]);
    }
}

#[test]
fn orientations_are_reported_one_by_one() {
    let folder = folder();
    let arguments =
        ["--metrics", "haar", "--set", "haar.orientations=true", "--set", "haar.levels=3"];
    let arguments = [&arguments[..], &ALL].concat();
    let json = frame(&folder, &arguments);
    let csv = csv(&folder, &arguments);
    let luma = luma(&codes(W, H, 3, 1));
    for level in 1..=3 {
        let record = &json["haar"][level - 1];
        let blocks = coefficients(&luma, level, 3, &|_| true);
        is_of(&record["reference"], blocks.as_flattened());
        assert_eq!(keys(&record["orientations"]), ["hh", "hl", "lh"]);
        for (index, orientation) in ["lh", "hl", "hh"].into_iter().enumerate() {
            let found = &record["orientations"][orientation];
            let of_one: Vec<f64> = blocks.iter().map(|block| block[index]).collect();
            is_of(&found["reference"], &of_one);
            for statistic in ["mean_abs", "max_abs", "energy"] {
                let name = format!("{statistic}_{orientation}");
                for image in ["reference", "test", "ratio"] {
                    let cell = value(&csv, image, "haar", &name, &level.to_string());
                    assert_eq!(
                        cell.parse().ok(),
                        found[image][statistic].as_f64(),
                        "{name} {image}"
                    );
                }
            }
        }
    }
    let json = frame(&folder, &ALL);
    assert_eq!(json["haar"][0].get("orientations"), None, "not unless they are asked for");
}

/// The cells of `--format csv`, a row a line.
fn csv(folder: &Folder, arguments: &[&str]) -> Vec<Vec<String>> {
    let arguments = [&["a.png", "b.png", "--format", "csv"], arguments].concat();
    let text = folder.score(&arguments).ok().stdout;
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The value of the only such row of frame 0.
#[track_caller]
fn value<'a>(
    csv: &'a [Vec<String>],
    image: &str,
    metric: &str,
    statistic: &str,
    level: &str,
) -> &'a str {
    let is_it = |row: &&Vec<String>| row[4..9] == ["0", image, metric, statistic, level];
    let found: Vec<_> = csv.iter().filter(is_it).collect();
    assert_eq!(found.len(), 1, "{image} {metric} {statistic} {level}");
    &found[0][11]
}

#[test]
fn csv_has_columns_for_image_level_and_statistic() {
    let folder = folder();
    let (json, csv) = (frame(&folder, &ALL), csv(&folder, &ALL));
    for image in ["reference", "test", "ratio"] {
        let cell = value(&csv, image, "rms_contrast", "", "");
        assert_eq!(cell.parse().ok(), json["bands"][0]["rms_contrast"][image].as_f64());
        for level in 1..=5 {
            for statistic in ["mean_abs", "max_abs", "energy"] {
                let cell = value(&csv, image, "haar", statistic, &level.to_string());
                let want = &json["haar"][level - 1][image][statistic];
                assert_eq!(cell.parse().ok(), want.as_f64());
            }
        }
    }
    assert_eq!(value(&csv, "pair", "haar", "coefficients", "1"), "768");
    let edges = |row: &&Vec<String>| row[9..11] == ["0.0", "170.0"];
    let of = |row: &&Vec<String>| ["haar", "rms_contrast"].contains(&&*row[6]);
    assert!(csv.iter().filter(of).all(|row| edges(&row)), "all of a band");
    // Over all frames: means with extremes of each picture and, of maxima, the ratio of the largest.
    let over_frames: Vec<_> =
        csv.iter().filter(|row| row[4].is_empty() && row[6] == "haar").collect();
    let statistics = |image: &str, of: &str| -> Vec<&str> {
        let rows = over_frames.iter().filter(|row| row[5] == image && row[8] == "2");
        rows.map(|row| &*row[7]).filter(|name| name.starts_with(of)).collect()
    };
    assert_eq!(statistics("test", "energy"), ["energy_mean", "energy_min", "energy_max"]);
    assert_eq!(statistics("ratio", "energy"), ["energy_mean"]);
    assert_eq!(statistics("ratio", "max_abs"), ["max_abs_max"]);
}

#[test]
fn contrast_is_of_luma_or_luminance_and_may_be_normalised() {
    let folder = Folder::new();
    let linear = |x: usize, y: usize| (1 + (x * 7 + y * 13) % 50) as f32 / 32.0;
    File::new(vec![Part::rgb((W, H), linear)]).write(&folder.path("a.png"));
    File::new(vec![Part::rgb((W, H), |x, y| 0.5 * linear(x, y))]).write(&folder.path("b.png"));
    let found = |arguments: &[&str]| {
        let arguments = [&["--metrics", "rms-contrast"], &ALL[..], arguments].concat();
        frame(&folder, &arguments)["bands"][0]["rms_contrast"].clone()
    };
    let pixels: Vec<f64> = (0..W * H).map(|i| f64::from(linear(i % W, i / W))).collect();
    let mean = pixels.iter().sum::<f64>() / pixels.len() as f64;
    let luminance = ["--set", "rms_contrast.signal=luminance"];
    let by_mean = ["--set", "rms-contrast.normalise=mean"];
    let of = found(&luminance);
    near(&of["reference"], contrast(&pixels));
    near(&of["ratio"], 0.5);
    // Before the tone map, but after exposure.
    let brighter = [&luminance[..], &["--exposure", "1", "--tonemap", "reinhard"]].concat();
    near(&found(&brighter)["reference"], 2.0 * contrast(&pixels));
    let normalised = found(&[&brighter[..], &by_mean].concat());
    near(&normalised["reference"], contrast(&pixels) / mean);
    near(&normalised["ratio"], 1.0);
    let encoded: Vec<f64> = pixels.iter().map(|value| srgb(value.min(1.0))).collect();
    near(&found(&[])["reference"], contrast(&encoded));
    near(
        &found(&by_mean)["reference"],
        contrast(&encoded) / (encoded.iter().sum::<f64>() / encoded.len() as f64),
    );
    for wrong in ["signal=luminence", "normalise=max"] {
        let set = format!("rms_contrast.{wrong}");
        folder.score(&["a.png", "b.png", "--set", &set]).fails(2, &["rms_contrast"]);
    }
    // Nothing divides by a mean of nothing.
    for file in ["a.png", "b.png"] {
        folder.png(file, W, H, &[0; W * H * 3]);
    }
    let black = found(&by_mean);
    let nothing = json!({"reference": null, "test": null, "ratio": null, "reason": "no value"});
    assert_eq!(black, nothing);
}

fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn a_ratio_to_a_flat_reference_is_null() {
    let folder = folder();
    folder.png("a.png", W, H, &[93; W * H * 3]);
    let json = frame(&folder, &ALL);
    let contrast = &json["bands"][0]["rms_contrast"];
    assert_eq!((&contrast["reference"], &contrast["ratio"]), (&json!(0.0), &json!(null)));
    assert_eq!(contrast["reason"], "the reference is 0");
    assert!(contrast["test"].as_f64().unwrap() > 0.0);
    let haar = &json["haar"][0];
    assert_eq!(haar["reference"], json!({"mean_abs": 0.0, "max_abs": 0.0, "energy": 0.0}));
    assert_eq!(haar["ratio"], json!({"mean_abs": null, "max_abs": null, "energy": null}));
    assert_eq!(haar["reason"], "the reference is 0");
    let csv = csv(&folder, &ALL);
    assert_eq!(value(&csv, "ratio", "rms_contrast", "", ""), "");
    assert_eq!(value(&csv, "ratio", "haar", "energy", "1"), "");
    assert_eq!(value(&csv, "reference", "haar", "energy", "1"), "0.0");
    // The other way round it is 0: nothing is left.
    let json = folder.json(&[&["b.png", "a.png"], &ALL[..]].concat());
    assert_eq!(json["frames"][0]["bands"][0]["rms_contrast"]["ratio"], 0.0);
}

#[test]
fn a_band_without_pixels_has_no_profile() {
    let folder = folder();
    let bands = ["--fov-vertical", "60", "--bands", "0,60,80,100"];
    let json = frame(&folder, &bands);
    for band in [1, 2] {
        let found = &json["bands"][band];
        assert_eq!(found["pixels"], 0);
        let nothing = json!({"reference": null, "test": null, "ratio": null, "reason": "no value"});
        assert_eq!(found["rms_contrast"], nothing);
        for level in 0..5 {
            let found = &json["haar"][3 * level + band];
            let nothing = json!({"mean_abs": null, "max_abs": null, "energy": null});
            assert_eq!(found["coefficients"], 0);
            for side in ["reference", "test", "ratio"] {
                assert_eq!(found[side], nothing);
            }
            assert_eq!(found["reason"], "no value");
        }
    }
    let csv = csv(&folder, &bands);
    let empty = csv.iter().filter(|row| row[4] == "0" && row[9] == "60.0" && row[6] == "haar");
    let (counts, others): (Vec<_>, Vec<_>) = empty.partition(|row| row[7] == "coefficients");
    assert!(counts.len() == 5 && counts.iter().all(|row| row[11] == "0"));
    assert!(others.len() == 5 * 3 * 3 && others.iter().all(|row| row[11].is_empty()));
}

/// One in each picture: both are left out of both.
#[test]
fn blocks_with_a_bad_pixel_do_not_count() {
    let folder = Folder::new();
    let value = |seed: usize| {
        move |x: usize, y: usize| (1 + (x * 31 + y * 17 + x * y * seed) % 97) as f32 / 128.0
    };
    let holes = [(5, 9), (30, 20)];
    for (index, file) in ["a.png", "b.png"].into_iter().enumerate() {
        let plane = (0..W * H).map(|i| {
            let (x, y) = (i % W, i / W);
            if (x, y) == holes[index] { f32::NAN } else { value(index + 1)(x, y) }
        });
        let plane = Values::Float(plane.collect());
        let part = Part::new((W, H), &["R", "G", "B"].map(|channel| (channel, plane.clone())));
        File::new(vec![part]).write(&folder.path(file));
    }
    let arguments = ["--nonfinite", "mask", "--transfer", "srgb", "--set", "haar.levels=3"];
    let arguments = [&arguments[..], &ALL].concat();
    folder
        .score(&[&["a.png", "b.png"], &arguments[2..]].concat())
        .fails(3, &["is NaN at pixel (5, 9)"]);
    let json = frame(&folder, &arguments);
    assert_eq!(
        (&json["pixels_left_out"], &json["bands"][0]["pixels"]),
        (&json!(2), &json!(W * H - 2))
    );
    let counts = |i: usize| !holes.contains(&(i % W, i / W));
    for (side, seed) in [("reference", 1), ("test", 2)] {
        let luma: Vec<f64> = (0..W * H).map(|i| f64::from(value(seed)(i % W, i / W))).collect();
        let clean: Vec<f64> = (0..W * H).filter(|i| counts(*i)).map(|i| luma[i]).collect();
        near(&json["bands"][0]["rms_contrast"][side], contrast(&clean));
        for level in 1..=3 {
            let blocks = coefficients(&luma, level, 3, &counts);
            let found = &json["haar"][level - 1];
            assert_eq!(found["coefficients"], 3 * blocks.len());
            is_of(&found[side], blocks.as_flattened());
        }
    }
    // Two of the 48x40 pixels' blocks of each size.
    assert_eq!(json["haar"][2]["coefficients"], 3 * (6 * 5 - 2));
}

/// Every ratio of a frame.
fn ratios(frame: &Value) -> Vec<f64> {
    let contrasts =
        frame["bands"].as_array().unwrap().iter().map(|band| &band["rms_contrast"]["ratio"]);
    let statistics = ["mean_abs", "max_abs", "energy"];
    let haar = frame["haar"].as_array().unwrap().iter();
    let haar = haar.flat_map(|record| statistics.map(|statistic| &record["ratio"][statistic]));
    contrasts.chain(haar).filter_map(Value::as_f64).collect()
}

#[test]
fn identical_pictures_have_ratios_of_one() {
    let folder = folder();
    std::fs::copy(folder.path("a.png"), folder.path("b.png")).unwrap();
    let ratios = ratios(&frame(&folder, &VIEW));
    assert!(ratios.len() > 40 && ratios.iter().all(|ratio| ratio.to_bits() == 1f64.to_bits()));
}

#[test]
fn swapped_pictures_have_reciprocal_ratios() {
    let folder = folder();
    let forth = ratios(&frame(&folder, &VIEW));
    let back = ratios(&folder.json(&[&["b.png", "a.png"], &VIEW[..]].concat())["frames"][0]);
    assert!(forth.len() > 40 && forth.len() == back.len());
    for (forth, back) in forth.iter().zip(&back) {
        assert!((forth * back - 1.0).abs() < 1e-12, "{forth} and {back}");
    }
    assert!(forth.iter().any(|ratio| (ratio - 1.0).abs() > 0.1));
}
