//! PNG: chunks that may have any length, orientation, colour chunks, and alpha over black.

use std::fs;

use fovqa_testkit::png_files::{chunk, with_chunk, write16};

use crate::fovqa::{Folder, root};

fn case(name: &str) -> String {
    root().join("tests/cases").join(name).display().to_string()
}

#[test]
fn long_chunks_that_say_nothing_of_pixels() {
    let folder = Folder::with_pair();
    let plain = fs::read(folder.path("a.png")).unwrap();
    let text = [b"comment\0", &vec![b'x'; 18 << 20][..]].concat();
    for name in [*b"tEXt", *b"zTXt", *b"iTXt", *b"iCCP", *b"eXIf", *b"prVt"] {
        folder.write("long.png", with_chunk(&plain, name, &text));
        let psnr = folder.metric("psnr", &["a.png", "long.png"]);
        assert!(psnr.is_infinite(), "{psnr} dB");
    }
}

#[test]
fn an_orientation_is_warned_of() {
    let (upright, turned) =
        (case("png-orientation/upright.png"), case("png-orientation/turned.png"));
    let folder = Folder::new();
    let warning = "the EXIF orientation is not applied";
    for turned in [&turned, &case("png-orientation/turned.jpg")] {
        folder.score(&[&upright, turned]).ok().says(&[warning]);
    }
    assert!(!folder.score(&[&upright, &upright]).ok().stderr.contains(warning));
    // Behind the pixels, where PNG allows it as well.
    let mut bytes = fs::read(&upright).unwrap();
    let exif = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";
    let end = bytes.len() - chunk(*b"IEND", &[]).len();
    bytes.splice(end..end, chunk(*b"eXIf", exif));
    folder.write("behind.png", bytes);
    folder.score(&[&upright, "behind.png"]).ok().says(&[warning, "behind.png"]);
}

#[test]
fn colour_chunks_that_say_srgb_are_no_news() {
    let folder = Folder::with_pair();
    let plain = fs::read(folder.path("a.png")).unwrap();
    let chromaticities = |values: [u32; 8]| -> Vec<u8> {
        values.iter().flat_map(|value| value.to_be_bytes()).collect()
    };
    let srgb = [31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000];
    let p3 = [31_270, 32_900, 68_000, 32_000, 26_500, 69_000, 15_000, 6_000];
    let said = |gamma: u32, values| {
        let file = with_chunk(&plain, *b"cHRM", &chromaticities(values));
        folder.write("c.png", with_chunk(&file, *b"gAMA", &gamma.to_be_bytes()));
        folder.score(&["a.png", "c.png"]).ok().stderr
    };
    assert!(!said(45_455, srgb).contains("colour chunk"));
    assert!(said(45_455, p3).contains("the colour chunk cHRM is not applied"));
    assert!(said(100_000, srgb).contains("the colour chunk gAMA is not applied"));
    assert!(said(100_000, p3).contains("the colour chunk gAMA, cHRM is not applied"));
}

/// One code apart, times alpha.
#[test]
fn over_black_is_not_rounded_to_codes() {
    const N: usize = 32;
    let folder = Folder::new();
    for alpha in [100u8, 10, 255] {
        let pixels = |code: u8| [code, code, code, alpha].repeat(N * N);
        folder.png("a.png", N, N, &pixels(128));
        folder.png("b.png", N, N, &pixels(129));
        let found = folder.metric("psnr", &["a.png", "b.png", "--alpha", "over-black"]);
        let wanted = 20.0 * (255.0 * 255.0 / f64::from(alpha)).log10();
        assert!((found - wanted).abs() < 2e-3, "alpha {alpha}: {found} for {wanted}");
    }
}

/// Every metric sees what it sees of an opaque file with the same values in 16 bits.
#[test]
fn all_metrics_see_what_lies_over_black() {
    const N: usize = 64;
    let folder = Folder::new();
    let write = |name: &str, shift: usize| {
        let code =
            |i: usize, c: usize| ((i * 7 + i / N * 13 + c * 50 + shift * (i % 5)) % 256) as u8;
        let alpha = |i: usize| (40 + i % N * 3) as u8;
        let rgba: Vec<u8> =
            (0..N * N).flat_map(|i| [code(i, 0), code(i, 1), code(i, 2), alpha(i)]).collect();
        folder.png(&format!("{name}8.png"), N, N, &rgba);
        let over = |i: usize, c: usize| {
            let share = f64::from(code(i, c)) * f64::from(alpha(i)) / (255.0 * 255.0);
            (share * 65535.0).round() as u16
        };
        let rgb: Vec<u16> = (0..N * N).flat_map(|i| [0, 1, 2].map(|c| over(i, c))).collect();
        write16(&folder.path(&format!("{name}16.png")), N, N, &rgb);
    };
    write("a", 0);
    write("b", 2);
    let scores = |bits: u8| {
        let (a, b) = (format!("a{bits}.png"), format!("b{bits}.png"));
        let view = ["--display", "htc-vive-pro", "--alpha", "over-black", "--metrics"];
        let metrics = "psnr,ssim,fpsnr,fssim,fvvdp,pu_psnr,rms_contrast";
        folder.json(&[&[&*a, &*b], &view[..], &[metrics]].concat())
    };
    let (eight, sixteen) = (scores(8), scores(16));
    for name in ["psnr", "ssim", "fpsnr", "fssim", "pu_psnr"] {
        let of = |json: &serde_json::Value| json["frames"][0]["metrics"][name].as_f64().unwrap();
        let (found, wanted) = (of(&eight), of(&sixteen));
        assert!((found - wanted).abs() < 1e-3, "{name}: {found} for {wanted}");
    }
    let jod = |json: &serde_json::Value| json["sequence"]["fvvdp"]["jod"].as_f64().unwrap();
    assert!((jod(&eight) - jod(&sixteen)).abs() < 1e-3);
    let contrast = |json: &serde_json::Value| {
        json["frames"][0]["bands"][0]["rms_contrast"]["test"].as_f64().unwrap()
    };
    assert!((contrast(&eight) - contrast(&sixteen)).abs() < 1e-4);
}
