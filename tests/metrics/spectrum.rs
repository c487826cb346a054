//! Power spectra through the command: sequences, eyes, masks, gates, figures, errors.

use std::fs;

use fovqa_testkit::synthetic::{codes, disturbed};
use serde_json::Value;

use crate::fovqa::Folder;
use crate::runs::experiment_folder::{self, rows};

const SIZE: (usize, usize) = (160, 120);
const VIEW: [&str; 6] = ["--fov-vertical", "40", "--bands", "0,8,16,40", "--metrics", "spectrum"];

/// Each pixel the mean of its row's neighbours, three pixels wide.
fn blurred(codes: &[u8]) -> Vec<u8> {
    let (width, _) = SIZE;
    let at = |i: usize, by: i64| {
        let x = (i / 3 % width) as i64 + by;
        let x = x.clamp(0, width as i64 - 1) as usize;
        u16::from(codes[(i / 3 / width * width + x) * 3 + i % 3])
    };
    (0..codes.len()).map(|i| ((at(i, -1) + at(i, 0) + at(i, 1)) / 3) as u8).collect()
}

fn sequence(frames: u64) -> Folder {
    let folder = Folder::new();
    for frame in 0..frames {
        let reference = codes(SIZE.0, SIZE.1, 3, frame);
        let noisy = disturbed(&reference, 60.0, 3);
        folder.png(&format!("gt/{frame}.png"), SIZE.0, SIZE.1, &noisy);
        folder.png(&format!("test/{frame}.png"), SIZE.0, SIZE.1, &blurred(&noisy));
    }
    folder
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-12 * wanted.abs(), "{found} for {wanted}");
}

#[test]
fn a_sequence_has_the_mean_power_and_its_cut_off() {
    let folder = sequence(3);
    let json = folder.json(&[&["gt", "test"][..], &VIEW].concat());
    let frames = json["frames"].as_array().unwrap();
    let all = json["summary_spectrum"].as_array().unwrap();
    assert_eq!(all.len(), 3);
    for (index, band) in all.iter().enumerate() {
        let of = |frame: &Value| frame["spectrum"][index].clone();
        let blocks = |frame: &Value| number(&of(frame)["blocks"]);
        near(number(&band["blocks"]), frames.iter().map(blocks).sum());
        let mut cutoff = None;
        let mut is_lost = false;
        for (k, bin) in band["bins"].as_array().unwrap().iter().enumerate() {
            let mean = |image: &str, statistic: &str| {
                let value = |frame| number(&of(frame)["bins"][k][image][statistic]);
                frames.iter().map(value).sum::<f64>() / 3.0
            };
            for (image, statistic) in
                [("reference", "power"), ("test", "power"), ("test", "density")]
            {
                near(number(&bin[image][statistic]["mean"]), mean(image, statistic));
            }
            near(number(&bin["ratio"]), mean("test", "power") / mean("reference", "power"));
            is_lost |= number(&bin["ratio"]) < 0.5;
            cutoff = if is_lost { cutoff } else { bin["cpd"].as_f64() };
        }
        assert_eq!(band["cutoff_cpd"].as_f64(), cutoff);
        assert!(is_lost && cutoff.is_some(), "the blur takes the high frequencies: {band}");
        // The same is in results of bands.
        for frame in frames {
            let cutoff = &frame["bands"][index]["spectrum_cutoff_cpd"];
            assert_eq!(cutoff, &of(frame)["cutoff_cpd"]);
        }
    }
}

#[test]
fn masks_leave_out_blocks_and_both_eyes_are_one() {
    let folder = sequence(1);
    let whole = folder.json(&[&["gt", "test"][..], &VIEW].concat());
    let mut mask = vec![255u8; SIZE.0 * SIZE.1 * 3];
    mask[(60 * SIZE.0 + 80) * 3..][..3].fill(0);
    folder.png("mask.png", SIZE.0, SIZE.1, &mask);
    let masked = folder.json(&[&["gt", "test", "--mask", "mask.png"][..], &VIEW].concat());
    let blocks = |json: &Value| -> f64 {
        let bands = json["frames"][0]["spectrum"].as_array().unwrap();
        bands.iter().map(|band| number(&band["blocks"])).sum()
    };
    // The blocks at 32 and 64 from the left, and at 0 and 32 from the top, have the pixel.
    near(blocks(&whole), 4.0 * 2.0);
    near(blocks(&masked), 4.0 * 2.0 - 4.0);
    for (eye, frame) in [("left", 0), ("right", 1)] {
        let reference = codes(SIZE.0, SIZE.1, 3, frame);
        folder.png(&format!("{eye}.png"), SIZE.0, SIZE.1, &disturbed(&reference, 60.0, 3));
        folder.png(&format!("{eye}-m.png"), SIZE.0, SIZE.1, &disturbed(&reference, 30.0, 5));
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nbands_deg = [0, 12, 40]\n\
         left = { fov_vertical_deg = 40 }\nright = { fov_vertical_deg = 40, gaze = [20, 20] }\n\
         [[scene]]\nname = \"s\"\nreference = { left = \"left.png\", right = \"right.png\" }\n\
         [[method]]\nname = \"m\"\ntest = \"{eye}-m.png\"\n[metrics]\nspectrum = { block = 32 }\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let of = |eye: &str| {
        let all = summary["comparisons"].as_array().unwrap();
        all.iter().find(|of| of["eye"] == eye).unwrap()["spectrum"][0].clone()
    };
    let (left, right, both) = (of("left"), of("right"), of("both"));
    let count = |band: &Value| number(&band["blocks"]);
    near(count(&both), count(&left) + count(&right));
    assert!((count(&left) - count(&right)).abs() > 1.0);
    let power = |band: &Value, k: usize| number(&band["bins"][k]["test"]["power"]["mean"]);
    for k in 0..4 {
        let sum = count(&left) * power(&left, k) + count(&right) * power(&right, k);
        near(power(&both, k), sum / count(&both));
    }
    let found = rows(&folder, "reports/e");
    let cutoff = found.iter().find(|row| row["eye"] == "both" && row["statistic"] == "cutoff_cpd");
    assert_eq!(cutoff.unwrap()["value"].parse::<f64>().ok(), both["cutoff_cpd"].as_f64());
    assert!(found.iter().any(|row| row["level"] == "-4"), "half octaves below 1 cpd");
}

#[test]
fn gates_figures_and_tables_show_it() {
    let folder = sequence(2);
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 40\nbands_deg = [0, 8, 16, 40]\n\
         [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
         [metrics]\nspectrum = {}\n\
         [[gate]]\nmetric = \"spectrum\"\nstatistic = \"cutoff_cpd\"\nband_deg = [8, 16]\nat_least = 0.5\n\
         [[gate]]\nmetric = \"spectrum\"\nstatistic = \"power\"\nimage = \"ratio\"\nlevel = -2\nband_deg = [8, 16]\nat_least = 0.5\n\
         [[gate]]\nmetric = \"spectrum\"\nstatistic = \"power\"\nimage = \"test\"\nlevel = 0\nband_deg = [0, 16]\nat_least = 0.0\n",
    );
    let verdict = folder.run(&["gate", "e.toml", "--format", "json"]).ok().json();
    let value = |rule: usize| number(&verdict["rules"][rule]["checks"][0]["value"]);
    let json = folder.json(&[&["gt", "test"][..], &VIEW].concat());
    let frames = json["frames"].as_array().unwrap();
    let mean = |of: &dyn Fn(&Value) -> f64| frames.iter().map(of).sum::<f64>() / 2.0;
    near(value(0), mean(&|frame| number(&frame["spectrum"][1]["cutoff_cpd"])));
    let bin = |band: &Value, cpd: f64| {
        let bins = band["bins"].as_array().unwrap().iter();
        bins.clone().find(|bin| (number(&bin["cpd"]) - cpd).abs() < 1e-9).unwrap().clone()
    };
    let summary = &json["summary_spectrum"];
    near(value(1), number(&bin(&summary[1], 0.5)["ratio"]));
    let by_blocks = |frame: &Value| {
        let bands = [0, 1].map(|index| &frame["spectrum"][index]);
        let power =
            |band: &&Value| number(&band["blocks"]) * number(&bin(band, 1.0)["test"]["power"]);
        bands.iter().map(power).sum::<f64>()
            / bands.map(|band| number(&band["blocks"])).iter().sum::<f64>()
    };
    near(value(2), mean(&by_blocks));
    for name in ["profile-spectrum", "ratio-profile-spectrum"] {
        assert!(folder.path(&format!("reports/e/plots/{name}.svg")).exists(), "{name}");
    }
    let table = fs::read_to_string(folder.path("reports/e/ratios-spectrum.md")).unwrap();
    assert!(table.contains("Cut-off") && table.contains("8° to 16°"), "{table}");
    let shown = folder.score(&[&["gt", "test"][..], &VIEW].concat()).ok().stdout;
    assert!(shown.contains("spectrum cut-off in cpd"), "{shown}");
}

/// Far from the gaze there are other half octaves than near it.
#[test]
fn bands_with_other_half_octaves_are_results_too() {
    let folder = sequence(2);
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 85\nbands_deg = [0, 15, 30, 60]\n\
         [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
         [metrics]\nspectrum = { block = 32 }\n\
         [[gate]]\nmetric = \"spectrum\"\nstatistic = \"cutoff_cpd\"\nband_deg = [30, 60]\nat_least = 0.1\nmax_drop = 0.01\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    folder.run(&["baseline", "save", "reports/e", "base.json"]).ok();
    folder.run(&["gate", "e.toml", "--baseline", "base.json"]).ok();
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let bins = |band: usize| {
        let bins = summary["comparisons"][0]["spectrum"][band]["bins"].as_array().unwrap();
        bins.iter().map(|bin| bin["cpd"].to_string()).collect::<Vec<_>>()
    };
    assert_ne!(bins(0), bins(2));
}

/// Where the reference has nothing, the test has no share of it.
#[test]
fn next_to_no_power_has_no_ratio_and_no_cut_off() {
    let folder = Folder::new();
    folder.png("flat.png", 64, 64, &[90; 64 * 64 * 3]);
    folder.png("noise.png", 64, 64, &codes(64, 64, 3, 4));
    let view = [
        "--fov-vertical",
        "40",
        "--bands",
        "0,40",
        "--metrics",
        "spectrum",
        "--plausibility",
        "off",
    ];
    let json = folder.json(&[&["flat.png", "noise.png"][..], &view].concat());
    let band = &json["frames"][0]["spectrum"][0];
    assert_eq!((&band["blocks"], &band["cutoff_cpd"]), (&1.into(), &Value::Null));
    for bin in band["bins"].as_array().unwrap() {
        assert!(number(&bin["test"]["power"]) > 1e-9 && bin["ratio"].is_null(), "{bin}");
    }
    let csv = folder.score(&[&["flat.png", "noise.png", "--format", "csv"][..], &view].concat());
    let csv = csv.ok().stdout;
    let mut ratios = csv.lines().filter(|line| line.contains(",ratio,spectrum,power,"));
    assert!(ratios.all(|line| line.ends_with(',')), "{csv}");
}

#[test]
fn what_it_cannot_measure_is_said() {
    let folder = sequence(1);
    let spectrum = |more: &[&str]| folder.score(&[&["gt", "test"][..], &VIEW, more].concat());
    spectrum(&["--set", "spectrum.block=128"])
        .fails(3, &["Spectrum needs 128 pixels on each side"]);
    spectrum(&["--set", "spectrum.block=48"])
        .fails(2, &["spectrum.block cannot be 48", "16, 32, 64, 128 or 256"]);
    folder.score(&["gt", "test", "--metrics", "spectrum"]).fails(2, &["Spectrum", "view"]);
    for (rule, said) in [
        ("", "a gate on spectrum needs a statistic"),
        ("statistic = \"power\"\nimage = \"ratio\"\n", "a gate on spectrum power needs a level"),
        ("statistic = \"cutoff_cpd\"\nlevel = 2\n", "cutoff_cpd has no levels"),
        ("statistic = \"cutoff_cpd\"\nimage = \"test\"\n", "cutoff_cpd has one value per pair"),
        ("statistic = \"samples\"\n", "spectrum has no statistic \"samples\""),
        ("statistic = \"power\"\nimage = \"test\"\nlevel = 101\n", "-100 to 100"),
    ] {
        folder.write(
            "e.toml",
            format!(
                "name = \"e\"\n[view]\nfov_vertical_deg = 40\nbands_deg = [0, 8, 16, 40]\n\
                 [[scene]]\nname = \"s\"\nreference = \"gt\"\n[[method]]\nname = \"m\"\ntest = \"test\"\n\
                 [metrics]\nspectrum = {{}}\n[[gate]]\nmetric = \"spectrum\"\nband_deg = [8, 16]\nat_least = 0.5\n{rule}"
            ),
        );
        folder.run(&["check", "e.toml"]).fails(2, &[said]);
    }
    folder.write(
        "e.toml",
        "name = \"e\"\n[view]\nfov_vertical_deg = 40\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n\
         [[method]]\nname = \"m\"\ntest = \"test\"\n[metrics]\nspectrum = { block = 48 }\n\
         [[plot]]\nkind = \"profile\"\nmetric = \"spectrum\"\nerror_bars = \"se\"\n",
    );
    let said =
        ["the power spectrum has no error bars", "spectrum.block cannot be 48", "e.toml:11:"];
    folder.run(&["check", "e.toml"]).fails(2, &said);
    let e = "name = \"e\"\n[view]\nfov_vertical_deg = 40\n[[scene]]\nname = \"s\"\nreference = \"gt\"\n\
             [[method]]\nname = \"m\"\ntest = \"test\"\n[metrics]\nhaar = {}\n\
             [[gate]]\nmetric = \"haar\"\nstatistic = \"energy\"\nimage = \"test\"\nlevel = 0\nband_deg = [0, 5]\nat_most = 1\n";
    folder.write("e.toml", e);
    folder.run(&["check", "e.toml"]).fails(2, &["haar has no level 0", "levels count from 1"]);
}
