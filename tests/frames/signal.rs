//! Transfer, exposure, tone maps, channels, crop, mask, and the ways to give a view.

use fovqa_testkit::exr_files::{File, Part};
use fovqa_testkit::synthetic::codes;

use crate::fovqa::Folder;

/// A gray EXR of one value, and the PNG code it should become.
fn becomes(value: f32, arguments: &[&str], code: u8) {
    let folder = Folder::new();
    File::new(vec![Part::rgb((16, 16), |_, _| value)]).write(&folder.path("v.exr"));
    let psnr = |code: u8| {
        folder.png("v.png", 16, 16, &[code; 16 * 16 * 3]);
        folder.metric("psnr", &[&["v.exr", "v.png"], arguments].concat())
    };
    // Nearer than half a code: 54 dB.
    assert!(psnr(code) > 54.0, "{value} with {arguments:?}: {} dB from {code}", psnr(code));
}

#[test]
fn linear_input_is_exposed_tone_mapped_and_encoded() {
    // sRGB of 0.5, 1.0; Reinhard of 1 is 0.5; ACES (Narkowicz) of 1 is 0.8038.
    becomes(0.5, &[], 188);
    becomes(0.25, &["--exposure", "1"], 188);
    becomes(0.5, &["--exposure", "-1"], 137);
    becomes(1.0, &["--tonemap", "reinhard"], 188);
    becomes(1.0, &["--tonemap", "aces"], 232);
    becomes(7.0, &["--tonemap", "clamp"], 255);
    becomes(0.2, &["--transfer", "srgb"], 51);
    becomes(0.2, &["--transfer", "pq"], 51);
}

#[test]
fn encoded_input_is_used_as_it_is_unless_it_is_linear() {
    let folder = Folder::with_pair();
    let psnr =
        |arguments: &[&str]| folder.metric("psnr", &[&["a.png", "b.png"], arguments].concat());
    let plain = psnr(&[]);
    for same in [
        &["--transfer", "srgb"][..],
        &["--transfer", "pq"],
        &["--transfer", "gamma2.2"],
        &["--exposure", "2"],
        &["--tonemap", "aces"],
    ] {
        assert_eq!(psnr(same).to_bits(), plain.to_bits(), "{same:?}");
    }
    assert!((psnr(&["--transfer", "linear"]) - plain).abs() > 0.1);
    assert!((psnr(&["--channels", "luma"]) - plain).abs() > 0.1);
}

#[test]
fn an_encoded_float_beyond_its_range_is_said() {
    let folder = Folder::with_pair();
    File::new(vec![Part::rgb((48, 40), |x, _| x as f32 / 20.0)]).write(&folder.path("v.exr"));
    folder.score(&["a.png", "v.exr", "--transfer", "srgb"]).ok().says(&["v.exr", "clamped"]);
}

#[test]
fn a_crop_is_scored_as_if_it_were_the_picture() {
    let folder = Folder::with_pair();
    let crop = |codes: &[u8]| -> Vec<u8> {
        (5..35).flat_map(|y| codes[(y * 48 + 8) * 3..(y * 48 + 44) * 3].to_vec()).collect()
    };
    let a = codes(48, 40, 3, 1);
    let b = fovqa_testkit::synthetic::disturbed(&a, 40.0, 2);
    folder.png("ca.png", 36, 30, &crop(&a));
    folder.png("cb.png", 36, 30, &crop(&b));
    let view = ["--fov-vertical", "70", "--gaze", "10,12"];
    let cropped = folder.json(&[&["a.png", "b.png", "--crop", "8,5,36,30"], &view[..]].concat());
    let small = folder.json(&[&["ca.png", "cb.png"], &view[..]].concat());
    assert_eq!(cropped["view"], small["view"]);
    assert_eq!(cropped["frames"][0]["metrics"], small["frames"][0]["metrics"]);
    assert_eq!(cropped["frames"][0]["bands"], small["frames"][0]["bands"]);
    folder
        .score(&["a.png", "b.png", "--crop", "20,0,36,30"])
        .fails(3, &["crop 20,0,36,30 reaches beyond the frame of 48x40", "a.png"]);
}

#[test]
fn a_mask_keeps_pixels_out() {
    let folder = Folder::with_pair();
    let lens = |x: usize, y: usize| (x as f64 - 23.5).hypot(y as f64 - 19.5) < 19.0;
    let mask: Vec<u8> = (0..48 * 40).map(|i| if lens(i % 48, i / 48) { 255 } else { 0 }).collect();
    folder.png("mask.png", 48, 40, &mask);
    // Garbage in the corners of the test picture.
    let mut garbage = fovqa_testkit::synthetic::disturbed(&codes(48, 40, 3, 1), 40.0, 2);
    for (i, code) in garbage.iter_mut().enumerate() {
        if mask[i / 3] == 0 {
            *code = 255 - *code;
        }
    }
    folder.png("garbage.png", 48, 40, &garbage);
    let scores = |test: &str| {
        let json = folder.json(&[
            "a.png",
            test,
            "--mask",
            "mask.png",
            "--fov-vertical",
            "60",
            "--metrics",
            "mse,psnr,ssim,fpsnr,fssim",
        ]);
        (
            json["frames"][0]["metrics"].clone(),
            json["frames"][0]["bands"].clone(),
            json["frames"][0]["pixels_left_out"].clone(),
        )
    };
    let (clean, garbage) = (scores("b.png"), scores("garbage.png"));
    assert_eq!(clean, garbage);
    assert_eq!(clean.2, mask.iter().map(|m| usize::from(*m == 0)).sum::<usize>());
    let pixels: u64 =
        clean.1.as_array().unwrap().iter().map(|b| b["pixels"].as_u64().unwrap()).sum();
    assert_eq!(pixels, mask.iter().map(|m| u64::from(*m == 255)).sum::<u64>());
    // The mask of the whole frame serves a crop, and so does one of the crop's size.
    let cropped = ["a.png", "b.png", "--crop", "10,10,20,20", "--metrics", "psnr", "--mask"];
    let whole = folder.json(&[&cropped[..], &["mask.png"]].concat());
    let part: Vec<u8> = (0..400).map(|i| mask[(10 + i / 20) * 48 + 10 + i % 20]).collect();
    folder.png("part.png", 20, 20, &part);
    assert_eq!(whole["frames"], folder.json(&[&cropped[..], &["part.png"]].concat())["frames"]);

    // Stripes without a whole window: SSIM, which nobody named, is left out; named, it is an error.
    let stripes: Vec<u8> = (0..48 * 40).map(|i| if i % 8 == 0 { 0 } else { 255 }).collect();
    folder.png("stripes.png", 48, 40, &stripes);
    let striped = ["a.png", "b.png", "--mask", "stripes.png"];
    let run = folder.score(&[&striped[..], &["--format", "json"]].concat()).ok();
    let run = run.says(&["SSIM is left out of frame 0", "no complete window"]);
    let metrics = run.json()["frames"][0]["metrics"].clone();
    assert!(metrics["psnr"].is_f64() && metrics.get("ssim").is_none());
    folder
        .score(&[&striped[..], &["--metrics", "ssim"]].concat())
        .fails(3, &["no complete window"]);

    // A mask larger than the files is of other files, whatever the crop.
    folder.png("wide.png", 100, 80, &[255; 8000]);
    folder.score(&[&cropped[..], &["wide.png"]].concat()).fails(3, &["mask has 100x80 pixels"]);

    folder.png("other.png", 30, 40, &[255; 1200]);
    folder
        .score(&["a.png", "b.png", "--mask", "other.png"])
        .fails(3, &["mask has 30x40 pixels, but the frames have 48x40"]);
    folder.png("black.png", 48, 40, &[0; 48 * 40]);
    folder.score(&["a.png", "b.png", "--mask", "black.png"]).fails(3, &["leaves no pixel"]);
    folder
        .score(&["a.png", "b.png", "--mask", "nope.png"])
        .fails(3, &["mask nope.png", "no such file"]);
}

#[test]
fn the_ways_to_give_a_view() {
    let folder = Folder::with_pair();
    let view = |arguments: &[&str]| {
        folder.json(&[&["a.png", "b.png"], arguments].concat())["view"].clone()
    };
    let focal = |arguments: &[&str]| -> Vec<f64> {
        let view = view(arguments);
        (0..2).map(|i| view["focal_px"][i].as_f64().unwrap()).collect()
    };
    let near = |found: Vec<f64>, want: [f64; 2]| {
        assert!(
            found.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-6 * b),
            "{found:?} {want:?}"
        );
    };
    near(focal(&["--fov-vertical", "90"]), [20.0, 20.0]);
    near(focal(&["--fov-horizontal", "90"]), [24.0, 24.0]);
    near(focal(&["--fov-horizontal", "90", "--fov-vertical", "90"]), [24.0, 20.0]);
    near(focal(&["--fov-diagonal", "90"]), [(48f64.hypot(40.0)) / 2.0; 2]);
    near(focal(&["--distance-m", "0.6", "--pixel-pitch-mm", "0.2"]), [3000.0, 3000.0]);
    near(focal(&["--frustum", "1,2,0.5,1.5"]), [16.0, 20.0]);
    assert_eq!(
        view(&["--frustum", "1,2,0.5,1.5"])["gaze_px"],
        serde_json::json!([16.0, 10.0]),
        "the default gaze is the principal point"
    );
    assert_eq!(view(&["--frustum", "-1,2,0.5,-1.5"]), view(&["--frustum", "1,2,0.5,1.5"]));
    let stretched = folder
        .score(&["a.png", "b.png", "--display", "huawei-vr-glass", "--format", "json"])
        .ok()
        .says(&["stretched over the display's 1600x1600"]);
    let found = &stretched.json()["view"]["focal_px"];
    assert!(
        (found[0].as_f64().unwrap() - 24.0).abs() < 1e-9
            && (found[1].as_f64().unwrap() - 20.0).abs() < 1e-9
    );
    let planar = view(&["--fov-vertical", "90", "--eccentricity", "planar"]);
    assert_eq!(planar["eccentricity"], "planar");
}

#[test]
fn parameters_change_what_they_say() {
    let folder = Folder::with_pair();
    let score = |metric: &str, set: &[&str]| {
        folder.metric(metric, &[&["a.png", "b.png", "--fov-vertical", "10"], set].concat())
    };
    assert_eq!(score("ssim", &["--set", "ssim.sigma=1.5"]).to_bits(), score("ssim", &[]).to_bits());
    assert_ne!(score("ssim", &["--set", "ssim.sigma=1"]).to_bits(), score("ssim", &[]).to_bits());
    assert_ne!(score("ssim", &["--set", "ssim.k2=0.1"]).to_bits(), score("ssim", &[]).to_bits());
    assert_ne!(score("fssim", &["--set", "ssim.sigma=1"]).to_bits(), score("fssim", &[]).to_bits());
    let off_gaze = |set: &[&str]| {
        let view =
            ["a.png", "b.png", "--distance-m", "1", "--pixel-pitch-mm", "5", "--gaze", "0,0"];
        folder.metric("fpsnr", &[&view[..], set].concat())
    };
    assert_ne!(
        off_gaze(&["--set", "fpsnr.weight=acuity"]).to_bits(),
        off_gaze(&[
            "--set",
            "fpsnr.weight=acuity",
            "--set",
            "fpsnr.acuity=linear_mar",
            "--set",
            "fpsnr.m=2"
        ])
        .to_bits()
    );
}
