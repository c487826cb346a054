//! Which channels of OpenEXR files are colour, and a layer for each side.

use std::fs;

use fovqa_testkit::exr_files::{File, Part, Values};
use serde_json::json;

use crate::fovqa::{Folder, root};
use crate::runs::experiment_folder;

const SIZE: (usize, usize) = (24, 20);

fn values(seed: usize) -> Values {
    let value = |i: usize| ((i * 37 + seed * 101) % 251) as f32 / 256.0;
    Values::Float((0..SIZE.0 * SIZE.1).map(value).collect())
}

/// A part with these channels, each of another pattern, by their places.
fn part(names: &[&str]) -> Part {
    let channels: Vec<_> = names.iter().enumerate().map(|(i, name)| (*name, values(i))).collect();
    Part::new(SIZE, &channels)
}

fn write(folder: &Folder, name: &str, part: Part) {
    File::new(vec![part]).write(&folder.path(name));
}

fn psnr(folder: &Folder, arguments: &[&str]) -> f64 {
    folder.metric("psnr", arguments)
}

/// The value is that of the decoding by OpenImageIO, which `rgb_of_yc.exr` holds.
#[test]
fn luminance_and_chroma_are_colour() {
    let folder = Folder::new();
    let case = root().join("tests/cases/exr-yc");
    let [yc, rgb, of_yc] = ["yc.exr", "rgb.exr", "rgb_of_yc.exr"].map(|name| case.join(name));
    let [yc, rgb, of_yc] = [&yc, &rgb, &of_yc].map(|path| path.to_str().unwrap());
    let value = psnr(&folder, &[yc, rgb]);
    assert!((value - 28.550).abs() < 5e-4, "{value}");
    // Half floats leave 80 dB.
    assert!(psnr(&folder, &[yc, of_yc]) > 75.0);
}

/// In the primaries of the file: luminance is that of its R, G and B.
#[test]
fn luminance_weights_are_those_of_the_primaries() {
    let folder = Folder::new();
    let primaries = [(0.713, 0.293), (0.165, 0.83), (0.128, 0.044), (0.32168, 0.33767)];
    let weights = [0.272_228_7, 0.674_081_8, 0.053_689_52];
    let planes = [0, 1, 2].map(|seed| match values(seed) {
        Values::Float(values) => values.iter().map(|v| v + 0.1).collect::<Vec<f32>>(),
        _ => unreachable!("floats"),
    });
    let [r, g, b] = &planes;
    let pixels = 0..r.len();
    let y: Vec<f32> =
        pixels.map(|i| weights[0] * r[i] + weights[1] * g[i] + weights[2] * b[i]).collect();
    let chroma = |plane: &[f32]| plane.iter().zip(&y).map(|(c, y)| (c - y) / y).collect();
    let (ry, by) = (Values::Float(chroma(r)), Values::Float(chroma(b)));
    let [red, green, blue] = planes.clone().map(Values::Float);
    let yc = Part::new(SIZE, &[("L.BY", by), ("L.RY", ry), ("L.Y", Values::Float(y))]);
    let rgb = Part::new(SIZE, &[("R", red), ("G", green), ("B", blue)]);
    for (name, part) in [("yc.exr", yc), ("rgb.exr", rgb)] {
        let chromaticities = Some(primaries);
        File { chromaticities, ..File::new(vec![part]) }.write(&folder.path(name));
    }
    let value = psnr(&folder, &["yc.exr", "rgb.exr"]);
    assert!(value > 80.0, "{value}");
}

#[test]
fn what_only_looks_like_colour_is_refused_by_name() {
    let folder = Folder::new();
    write(&folder, "rgb.exr", part(&["R", "G", "B"]));
    for (names, words) in [
        (
            &["RY", "Y"][..],
            &["layer root has the channels Y and RY without BY", "Y, RY and BY"][..],
        ),
        (&["BY", "Y"], &["Y and BY without RY"]),
        (&["L.Y", "L.Cb", "L.Cr"], &["layer L has the channels Y, Cb and Cr"]),
        (&["Y", "U", "V"], &["Y, U and V"]),
        (&["X", "Y", "Z"], &["it has no colour", "X, Y, Z", "not converted"]),
        (&["H", "S", "V"], &["it has no colour", "not converted"]),
        (&["x", "y", "Y"], &["it has no colour"]),
    ] {
        write(&folder, "odd.exr", part(names));
        let run = folder.score(&["odd.exr", "rgb.exr", "--metrics", "psnr"]);
        run.fails(3, &["odd.exr: "]).says(words);
    }
    // Chroma at half the resolution.
    let halves = |name| (name, Values::Half(vec![0.5; SIZE.0 * SIZE.1]));
    let whole = Part::new(SIZE, &["BY", "RY", "Y"].map(halves));
    write(&folder, "odd.exr", whole);
    let bytes = fs::read(folder.path("odd.exr")).unwrap();
    folder.write("odd.exr", fovqa_testkit::exr_files::with_subsampled(&bytes, "RY"));
    let run = folder.score(&["odd.exr", "rgb.exr", "--metrics", "psnr"]);
    run.fails(3, &["channel RY is subsampled", "every channel at full resolution"]);
}

#[test]
fn luminance_alone_is_gray_beside_alpha_and_depth() {
    let folder = Folder::new();
    let opaque = Values::Half(vec![1.0; SIZE.0 * SIZE.1]);
    write(&folder, "y.exr", Part::new(SIZE, &[("Y", values(0)), ("A", opaque), ("Z", values(3))]));
    let gray = ["R", "G", "B"].map(|name| (name, values(0)));
    write(&folder, "gray.exr", Part::new(SIZE, &gray));
    let run = folder.score(&["y.exr", "gray.exr", "--metrics", "psnr", "--channels", "luma"]);
    run.ok();
}

/// Named by the attributes, or by the usual names; the only colour needs no --layer.
#[test]
fn cryptomattes_are_no_colour() {
    let folder = Folder::new();
    let rgba = |layer: &str| ["r", "g", "b", "a"].map(|name| format!("{layer}.{name}"));
    let with = |layers: &[&str]| {
        let names: Vec<String> = layers.iter().flat_map(|layer| rgba(layer)).collect();
        let names = names.iter().map(String::as_str);
        part(
            &["VL.Combined.R", "VL.Combined.G", "VL.Combined.B"]
                .into_iter()
                .chain(names)
                .collect::<Vec<_>>(),
        )
    };
    let score = ["a.exr", "a.exr", "--metrics", "psnr"];
    let named = with(&["VL.Things00", "VL.Things01", "VL.Things"]);
    write(&folder, "a.exr", named.clone().saying("cryptomatte/1234567/name", "VL.Things"));
    folder.score(&score).ok();
    let run = folder.score(&[&score[..], &["--layer", "VL.Things00"]].concat());
    run.fails(3, &["VL.Things00", "Cryptomatte", "not colour"]);
    let run = folder.score(&[&score[..], &["--layer", "none"]].concat());
    run.fails(3, &["it has no colour layer \"none\"; it has: VL.Combined\n"]);
    // Without the attribute they could be anything.
    write(&folder, "a.exr", named);
    let several = "several colour layers: VL.Combined, VL.Things, VL.Things00, VL.Things01";
    folder.score(&score).fails(3, &[several]);
    write(&folder, "a.exr", with(&["VL.CryptoObject00", "crypto_material01"]));
    folder.score(&score).ok();
    write(
        &folder,
        "a.exr",
        part(&["VL.CryptoObject00.R", "VL.CryptoObject00.G", "VL.CryptoObject00.B"]),
    );
    folder.score(&score).fails(3, &["it has no colour"]);
}

/// What a renderer writes as motion or depth is a picture only for those who ask for it.
#[test]
fn motion_and_depth_with_three_channels_are_no_colour() {
    let folder = Folder::new();
    let unreal = "FinalImageMovieRenderQueue_MotionVectors";
    let names = ["R", "G", "B"].map(|name| format!("{unreal}.{name}"));
    let names = names.each_ref().map(String::as_str);
    write(&folder, "a.exr", part(&[&["R", "G", "B"], &names[..]].concat()));
    folder.score(&["a.exr", "a.exr", "--metrics", "psnr"]).ok();
    folder.score(&["a.exr", "a.exr", "--metrics", "psnr", "--layer", unreal]).ok();
}

#[test]
fn each_side_has_a_layer() {
    let folder = Folder::new();
    let rgb = |layer: &str| ["R", "G", "B"].map(|name| format!("{layer}.{name}"));
    let names = [rgb("full"), rgb("fast")].concat();
    write(&folder, "both.exr", part(&names.iter().map(String::as_str).collect::<Vec<_>>()));
    let [full, fast] = [[0, 1, 2], [3, 4, 5]].map(|seeds| {
        ["R", "G", "B"]
            .iter()
            .zip(seeds)
            .map(|(name, seed)| (*name, values(seed)))
            .collect::<Vec<_>>()
    });
    write(&folder, "full.exr", Part::new(SIZE, &full));
    write(&folder, "fast.exr", Part::new(SIZE, &fast));
    let expected = psnr(&folder, &["full.exr", "fast.exr"]);
    let layers = ["--layer", "full", "--test-layer", "fast"];
    let value = psnr(&folder, &[&["both.exr", "both.exr"], &layers[..]].concat());
    assert_eq!(value.to_bits(), expected.to_bits());
    assert!(psnr(&folder, &["both.exr", "both.exr", "--layer", "full"]).is_infinite());
    let run = folder.score(&["both.exr", "both.exr", "--layer", "full", "--test-layer", "slow"]);
    run.fails(3, &["no colour layer \"slow\"", "fast, full", "--layer", "--test-layer"]);

    let experiment = |layer: &str| {
        format!(
            "name = \"e\"\n[signal]\nlayer = \"full\"\n[[scene]]\nname = \"s\"\nreference = \"both.exr\"\n\
             [[method]]\nname = \"A\"\ntest = \"both.exr\"\n{layer}[[method]]\nname = \"B\"\n\
             test = \"both.exr\"\n[metrics]\npsnr = {{}}\n"
        )
    };
    folder.write("e.toml", experiment("layer = \"fast\"\n"));
    folder.run(&["run", "e.toml"]).ok();
    let summary = experiment_folder::json(&folder, "reports/e/summary.json");
    let means = [0, 1].map(|i| summary["comparisons"][i]["metrics"]["psnr"]["mean"].clone());
    assert_eq!(means, [json!(expected), json!("inf")]);
    let record = experiment_folder::json(&folder, "reports/e/run.json");
    let eye = &record["resolved"]["scenes"][0]["eyes"][0];
    assert_eq!(
        (&eye["test_layers"], &eye["signal"]["layer"]),
        (&json!({ "A": "fast" }), &json!("full"))
    );
    folder.run(&["run", "e.toml", "--resume"]).ok();
    // Per eye only where there are eyes.
    folder.write("e.toml", experiment("layer = { left = \"fast\", right = \"full\" }\n"));
    folder.run(&["run", "e.toml"]).fails(2, &["has a layer for each eye", "one reference"]);
    folder.write("e.toml", experiment("layer = 3\n"));
    folder.run(&["run", "e.toml"]).fails(2, &["layer"]);
}

#[test]
fn a_layer_per_eye_of_a_method() {
    let folder = Folder::new();
    let names = ["a.R", "a.G", "a.B", "b.R", "b.G", "b.B"];
    write(&folder, "both.exr", part(&names));
    folder.write(
        "e.toml",
        "name = \"e\"\n[signal]\nlayer = \"a\"\n[[scene]]\nname = \"s\"\n\
         reference = { left = \"both.exr\", right = \"both.exr\" }\n[[method]]\nname = \"A\"\n\
         test = { left = \"both.exr\", right = \"both.exr\" }\nlayer = { right = \"b\" }\n\
         [metrics]\npsnr = {}\n",
    );
    folder.run(&["run", "e.toml"]).ok();
    let csv = fs::read_to_string(folder.path("reports/e/results.csv")).unwrap();
    let is_identical = |eye: &str| {
        let row =
            csv.lines().find(|row| row.contains(&format!(",{eye},")) && row.contains(",psnr,"));
        row.unwrap().ends_with(",inf")
    };
    assert!(is_identical("left") && !is_identical("right"), "{csv}");
}

/// A header that would take the memory of thousands of files.
#[test]
fn attributes_are_limited() {
    let folder = Folder::new();
    write(&folder, "a.exr", part(&["R", "G", "B"]));
    let whole = fs::read(folder.path("a.exr")).unwrap();
    let with = |attributes: &[u8]| [&whole[..8], attributes, &whole[8..]].concat();
    let huge = [b"note\0string\0".as_slice(), &0x7fff_ffffu32.to_le_bytes(), b"text"].concat();
    folder.write("b.exr", with(&huge));
    let run = folder.score(&["b.exr", "a.exr", "--metrics", "psnr"]);
    run.fails(3, &["b.exr: its header has an attribute (\"note\") of 2147483647 bytes", "limit"]);
    let many: Vec<u8> =
        (0..100_000).flat_map(|i| format!("{i}\0x\0\0\0\0\0").into_bytes()).collect();
    folder.write("b.exr", with(&many));
    let run = folder.score(&["b.exr", "a.exr", "--metrics", "psnr"]);
    run.fails(3, &["more than 65536 attributes", "save the file again"]);
}
