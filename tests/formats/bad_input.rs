//! What clumsy and hostile files get: a clear message, exit 3, and nothing that looks like a
//! result.

use std::fs;

use exr::prelude::{Blocks, Compression, Encoding, LineOrder, Vec2};
use fovqa_testkit::exr_files::{File, Part, Values, deep};
use fovqa_testkit::png_files::{header_only, with_chunk};
use fovqa_testkit::synthetic::codes;

use crate::fovqa::Folder;
#[cfg(target_os = "linux")]
use crate::fovqa::peak_kb;

/// The pair `a.png`, `b.png` and a file under test; scored as the test, then as the reference.
#[track_caller]
fn refuses(folder: &Folder, file: &str, words: &[&str]) {
    let words = [words, &["help:", file]].concat();
    folder.score(&["a.png", file]).fails(3, &words);
    folder.score(&[file, "b.png"]).fails(3, &words);
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

#[test]
fn missing_files_and_folders() {
    let folder = Folder::with_pair();
    refuses(&folder, "nope.png", &["there is no such file or folder"]);
    let pattern = "no/such/folder/%04d.png";
    folder
        .score(&["a.png", pattern])
        .fails(3, &["no/such/folder: there is no such file or folder"]);
    fs::create_dir_all(folder.path("empty/x").parent().unwrap()).unwrap();
    refuses(&folder, "empty", &["it matches no file"]);
    folder.write("texts/readme.txt", "hello");
    refuses(&folder, "texts", &["it matches no image, only a file of another type"]);
    refuses(&folder, "*.tiff", &["it matches no file"]);
    folder.png_pair("gt/0.png", "gt/1.png", 8, 8);
    folder.score(&["gt", "a.png"]).fails(3, &["no file of gt has a partner in a.png"]);
    folder.write("twice/0.exr", "");
    folder.png_pair("twice/0.png", "twice/1.png", 8, 8);
    refuses(&folder, "twice", &["0.exr", "0.png", "the same name without the ending"]);
}

#[test]
fn frames_of_different_sizes() {
    let folder = Folder::with_pair();
    folder.png("wide.png", 49, 40, &codes(49, 40, 3, 1));
    folder
        .score(&["a.png", "wide.png"])
        .fails(3, &["a.png has 48x40 pixels, but wide.png has 49x40", "fovqa does not resample"]);
}

#[test]
fn files_that_are_cut_short() {
    let folder = Folder::with_pair();
    let png = bytes(&folder, "a.png");
    for share in [9, 30, png.len() / 2, png.len() - 20] {
        folder.write("cut.png", &png[..share]);
        refuses(&folder, "cut.png", &["PNG data is damaged or cut short"]);
    }
    File::new(vec![Part::rgb((48, 40), |x, y| (x + y) as f32 / 90.0)]).write(&folder.path("c.exr"));
    let exr = bytes(&folder, "c.exr");
    for share in [5, 100, exr.len() / 2, exr.len() - 3] {
        folder.write("cut.exr", &exr[..share]);
        refuses(&folder, "cut.exr", &["OpenEXR data is damaged or cut short"]);
    }
    folder.png("c.jpg", 48, 40, &codes(48, 40, 3, 1));
    folder.score(&["a.png", "c.jpg"]).ok();
    let jpeg = bytes(&folder, "c.jpg");
    for share in [4, 100, jpeg.len() / 2, jpeg.len() - 2] {
        folder.write("cut.jpg", &jpeg[..share]);
        refuses(&folder, "cut.jpg", &["JPEG data is damaged or cut short"]);
    }
}

#[test]
fn files_with_bits_flipped() {
    let folder = Folder::with_pair();
    File::new(vec![Part::rgb((48, 40), |x, y| (x + y) as f32 / 90.0)]).write(&folder.path("c.exr"));
    for (name, file) in [("flip.png", "a.png"), ("flip.exr", "c.exr")] {
        let whole = bytes(&folder, file);
        for at in (8..whole.len()).step_by(whole.len() / 25) {
            let mut flipped = whole.clone();
            flipped[at] ^= 0x55;
            folder.write(name, &flipped);
            // Some bits do not matter; none may bring the command down.
            let run = folder.score(&["a.png", name]);
            assert!([0, 3].contains(&run.code), "byte {at}: {} {}", run.code, run.stderr);
        }
    }
}

#[test]
fn files_that_are_no_image() {
    let folder = Folder::with_pair();
    folder.write("text.png", "this is no picture");
    refuses(&folder, "text.png", &["not a PNG, JPEG or OpenEXR file"]);
    folder.write("empty.png", "");
    refuses(&folder, "empty.png", &["not a PNG, JPEG or OpenEXR file"]);
    fs::create_dir(folder.path("gt")).unwrap();
    fs::create_dir(folder.path("gt/folder.png")).unwrap();
    refuses(&folder, "gt", &["it matches no file"]);
}

#[test]
fn declared_sizes_beyond_reason() {
    let folder = Folder::with_pair();
    folder.write("huge.png", header_only(100_000, 100_000));
    refuses(&folder, "huge.png", &["100000x100000", "limit of 256 megapixels", "--max-megapixels"]);
    File::new(vec![Part::rgb((48, 40), |_, _| 0.5)]).write(&folder.path("c.exr"));
    let exr = bytes(&folder, "c.exr");
    for window in ["dataWindow\0box2i\0", "displayWindow\0box2i\0"] {
        let at = exr.windows(window.len()).position(|w| w == window.as_bytes()).unwrap();
        let mut huge = exr.clone();
        let corner = at + window.len() + 4 + 8;
        huge[corner..corner + 4].copy_from_slice(&99_999i32.to_le_bytes());
        huge[corner + 4..corner + 8].copy_from_slice(&99_999i32.to_le_bytes());
        folder.write("huge.exr", &huge);
        refuses(&folder, "huge.exr", &["100000x100000", "megapixels"]);
    }
    let pair = ["a.png", "b.png", "--max-megapixels"];
    folder.score(&[&pair[..], &["0"]].concat()).fails(3, &["48x40", "limit of 0 megapixels"]);
    folder.score(&[&pair[..], &["1"]].concat()).ok();
}

/// Counters of a DWA block ask for memory; no decoder may believe them.
#[test]
fn exr_whose_blocks_declare_too_much() {
    let folder = Folder::with_pair();
    let encoding = Encoding {
        compression: Compression::DWAA(None),
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let noise = |x: usize, y: usize| ((x * 7919 + y * 104_729) % 1000) as f32 / 1000.0;
    File { encoding, ..File::new(vec![Part::rgb((48, 40), noise)]) }.write(&folder.path("c.exr"));
    folder.score(&["a.png", "c.exr"]).ok();
    let whole = bytes(&folder, "c.exr");
    // The first block: y, size, then eleven counters of eight bytes; behind one offset a block.
    let blocks = 40usize.div_ceil(32);
    let header = whole.windows(17).position(|w| w == b"screenWindowWidth").unwrap();
    let at = (header..whole.len() - 8)
        .find(|&at| {
            let offset = u64::from_le_bytes(whole[at..at + 8].try_into().unwrap());
            offset == (at + 8 * blocks) as u64
        })
        .expect("the offset table");
    let counters = at + 8 * blocks + 8;
    for counter in 1..10 {
        let mut huge = whole.clone();
        huge[counters + 8 * counter + 5] = 0x7f;
        folder.write("huge.exr", &huge);
        refuses(&folder, "huge.exr", &["declares more data than it can hold"]);
    }
    // The last block, of 8 rows: longer than its pixels, but not than those of a whole block.
    let second = u64::from_le_bytes(whole[at + 8..at + 16].try_into().unwrap()) as usize;
    let mut long = whole[..second].to_vec();
    long.extend(32i32.to_le_bytes());
    long.extend(3000i32.to_le_bytes());
    let mut data = vec![0; 3000];
    data[..8].copy_from_slice(&2u64.to_le_bytes());
    data[8 * 8..8 * 9].copy_from_slice(&(1u64 << 48).to_le_bytes());
    long.extend(data);
    folder.write("long.exr", &long);
    refuses(&folder, "long.exr", &["declares more data than it can hold"]);
}

/// One tile of the whole frame in many channels: more than its pixels alone would tell.
#[test]
fn exr_with_blocks_beyond_reason() {
    let folder = Folder::with_pair();
    let plane = Values::Float(vec![0.5; 48 * 40]);
    let names = ["R", "G", "B", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z"];
    let channels: Vec<_> = names.iter().map(|name| (*name, plane.clone())).collect();
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::Tiles(Vec2(48, 40)),
        line_order: LineOrder::Increasing,
    };
    File { encoding, ..File::new(vec![Part::new((48, 40), &channels)]) }
        .write(&folder.path("c.exr"));
    folder.score(&["a.png", "c.exr"]).ok();
    let mut huge = bytes(&folder, "c.exr");
    let mut patch = |name: &[u8], skip: usize, value: u32| {
        let at = huge.windows(name.len()).position(|w| w == name).unwrap();
        let at = at + name.len() + 4 + skip;
        for word in huge[at..at + 8].as_chunks_mut::<4>().0 {
            *word = value.to_le_bytes();
        }
    };
    patch(b"dataWindow\0box2i\0", 8, 15_999);
    patch(b"displayWindow\0box2i\0", 8, 15_999);
    patch(b"tiles\0tiledesc\0", 0, 16_000);
    folder.write("huge.exr", &huge);
    refuses(&folder, "huge.exr", &["blocks of 9216000000 bytes"]);
}

#[test]
fn exr_of_kinds_that_are_not_read() {
    let folder = Folder::with_pair();
    File::new(vec![Part::rgb((48, 40), |_, _| 0.5)]).write(&folder.path("c.exr"));
    let whole = bytes(&folder, "c.exr");
    let compression = b"compression\0compression\0\x01\0\0\0";
    let at = whole.windows(compression.len()).position(|w| w == compression).unwrap();
    let mut newer = whole.clone();
    newer[at + compression.len()] = 99;
    folder.write("newer.exr", &newer);
    refuses(&folder, "newer.exr", &["this kind of OpenEXR file is not supported"]);
    let mut subsampled = whole.clone();
    let channel = b"R\0\x01\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0";
    let at = whole.windows(channel.len()).position(|w| w == channel).unwrap();
    subsampled[at + 10] = 2;
    folder.write("subsampled.exr", &subsampled);
    refuses(&folder, "subsampled.exr", &["channel R is subsampled"]);
    // Every offset points to the first block.
    let tables: Vec<usize> = (0..whole.len() - 16)
        .filter(|&at| {
            let offset = |at: usize| u64::from_le_bytes(whole[at..at + 8].try_into().unwrap());
            offset(at) == (at + 24) as u64 && offset(at + 8) > offset(at)
        })
        .collect();
    let [table] = tables[..] else { panic!("one offset table of three blocks: {tables:?}") };
    let mut same = whole.clone();
    same.copy_within(table..table + 8, table + 8);
    folder.write("same.exr", &same);
    refuses(&folder, "same.exr", &["one of its blocks appears twice"]);
}

/// Deflated zeros (RFC 1951, fixed codes): one literal, then `matches` copies of 258 bytes.
fn deflated_zeros(matches: usize) -> Vec<u8> {
    let (mut bytes, mut word, mut bits) = (vec![0x78, 0x01], 0u64, 0u32);
    let mut put = |value: u64, count: u32| {
        word |= value << bits;
        bits += count;
        while bits >= 8 {
            bytes.push(word as u8);
            (word, bits) = (word >> 8, bits - 8);
        }
    };
    put(0b011, 3); // the last block, fixed codes
    put(0b0000_1100, 8); // literal 0, its code 00110000 from the first bit on
    for _ in 0..matches {
        put(0b1010_0011, 8); // length 258, its code 11000101 from the first bit on
        put(0, 5); // distance 1
    }
    put(0, 7 + 7); // the end, and up to a whole byte
    bytes
}

/// A profile that is never applied must not cost what it inflates to: here 500 MB.
#[cfg(target_os = "linux")]
#[test]
fn png_with_a_profile_that_inflates() {
    let folder = Folder::with_pair();
    let profile = [b"bomb\0\0", deflated_zeros(2_000_000).as_slice()].concat();
    folder.write("bomb.png", with_chunk(&bytes(&folder, "a.png"), *b"iCCP", &profile));
    folder.score(&["bomb.png", "b.png"]).ok().says(&["iCCP", "not applied"]);
    let peak = peak_kb(&folder, &["score", "bomb.png", "b.png"]);
    assert!((1..150_000).contains(&peak), "{peak} kB");
}

#[cfg(unix)]
#[test]
fn devices_and_pipes() {
    let folder = Folder::with_pair();
    for (file, words) in [("/dev/null", "neither a file nor a folder"), ("fifo.png", "neither")] {
        if file == "fifo.png" {
            let made = std::process::Command::new("mkfifo").arg(folder.path(file)).status();
            assert!(made.unwrap().success());
        }
        refuses(&folder, file, &[words]);
        folder.score(&["a.png", "b.png", "--mask", file]).fails(3, &["not a regular file"]);
        let gaze = ["a.png", "b.png", "--fov-vertical", "60", "--gaze", file];
        folder.score(&gaze).fails(3, &["not a regular file"]);
    }
}

#[test]
fn exr_without_one_colour_layer() {
    let folder = Folder::with_pair();
    let plane = Values::Half(vec![0.5; 48 * 40]);
    let part = |names: &[&str]| {
        let channels: Vec<_> = names.iter().map(|name| (*name, plane.clone())).collect();
        Part::new((48, 40), &channels)
    };
    folder.write("deep.exr", deep());
    refuses(&folder, "deep.exr", &["deep data"]);
    File::new(vec![part(&["Z", "motion.X", "motion.Y"])]).write(&folder.path("depth.exr"));
    refuses(&folder, "depth.exr", &["no colour", "Z", "motion.X", "motion.Y"]);
    let names = [
        "ViewLayer.Combined.R",
        "ViewLayer.Combined.G",
        "ViewLayer.Combined.B",
        "ViewLayer.DiffCol.R",
        "ViewLayer.DiffCol.G",
        "ViewLayer.DiffCol.B",
        "ViewLayer.Depth.Z",
    ];
    File::new(vec![part(&names)]).write(&folder.path("layers.exr"));
    refuses(&folder, "layers.exr", &["ViewLayer.Combined, ViewLayer.DiffCol", "--layer"]);
    folder.score(&["a.png", "layers.exr", "--layer", "ViewLayer.Combined"]).ok();
    // A reference with nothing but R, G, B beside a test of many layers.
    File::new(vec![part(&["R", "G", "B"])]).write(&folder.path("plain.exr"));
    folder.score(&["plain.exr", "layers.exr", "--layer", "ViewLayer.Combined"]).ok();
    folder.score(&["a.png", "layers.exr", "--layer", "ViewLayer.Depth"]).fails(
        3,
        &["no colour layer \"ViewLayer.Depth\"", "ViewLayer.Combined, ViewLayer.DiffCol"],
    );
    let mut albedo = part(&["R", "G", "B"]);
    albedo.name = "albedo";
    let mut beauty = part(&["R", "G", "B"]);
    beauty.name = "beauty";
    File::new(vec![beauty, albedo]).write(&folder.path("parts.exr"));
    refuses(&folder, "parts.exr", &["beauty, albedo"]);
    folder.score(&["a.png", "parts.exr", "--layer", "beauty"]).ok();
}

#[test]
fn exr_with_disjoint_windows() {
    let folder = Folder::with_pair();
    let mut part = Part::rgb((20, 10), |_, _| 0.5);
    part.at = (48, 0);
    let file = File { display: Some(((0, 0), (48, 40))), ..File::new(vec![part]) };
    file.write(&folder.path("off.exr"));
    refuses(&folder, "off.exr", &["data window 20x10+48+0", "display window 48x40+0+0"]);
}

#[test]
fn nan_and_infinity() {
    let folder = Folder::new();
    let with = |name: &str, bad: f32| {
        let value = |x: usize, y: usize| {
            if (x, y) == (30, 20) { bad } else { (x * y % 50) as f32 / 50.0 }
        };
        File::new(vec![Part::rgb((48, 40), value)]).write(&folder.path(name));
    };
    with("clean.exr", 0.3);
    for (name, bad, said) in [("nan.exr", f32::NAN, "NaN"), ("inf.exr", f32::INFINITY, "inf")] {
        with(name, bad);
        let words = [name, "channel R", said, "pixel (30, 20)", "--nonfinite mask"];
        folder.score(&["clean.exr", name]).fails(3, &words);
        folder.score(&[name, "clean.exr"]).fails(3, &words);
        let masked =
            folder.json(&["clean.exr", name, "--nonfinite", "mask", "--metrics", "psnr,ssim"]);
        let frame = &masked["frames"][0];
        assert_eq!(frame["pixels_left_out"], 1);
        assert_eq!(frame["metrics"]["psnr"], "inf", "the other pixels are equal");
        assert_eq!(frame["metrics"]["ssim"], 1.0);
        folder
            .score(&["clean.exr", name, "--nonfinite", "mask", "--metrics", "ms-ssim"])
            .fails(3, &["MS-SSIM"]);
    }
}

#[test]
fn pixels_bad_in_either_picture_are_left_out_of_both() {
    let folder = Folder::new();
    let with = |name: &str, at: (usize, usize)| {
        let value = |x: usize, y: usize| if (x, y) == at { f32::NAN } else { 0.3 };
        File::new(vec![Part::rgb((48, 40), value)]).write(&folder.path(name));
    };
    with("a.exr", (5, 6));
    with("b.exr", (30, 20));
    let json = folder.json(&["a.exr", "b.exr", "--nonfinite", "mask", "--metrics", "psnr"]);
    assert_eq!(json["frames"][0]["pixels_left_out"], 2);
    assert_eq!(json["frames"][0]["metrics"]["psnr"], "inf");
}

#[test]
fn a_firefly_does_not_raise_psnr() {
    let folder = Folder::new();
    let write = |name: &str, firefly: f32, scale: f32| {
        let value = |x: usize, y: usize| {
            if (x, y) == (30, 20) { firefly } else { scale * (x * y % 50) as f32 / 50.0 }
        };
        File::new(vec![Part::rgb((48, 40), value)]).write(&folder.path(name));
    };
    write("gt.exr", 0.3, 1.0);
    write("plain.exr", 0.3, 0.8);
    write("firefly.exr", 60_000.0, 0.8);
    for tonemap in ["clamp", "reinhard", "aces"] {
        let psnr = |test: &str| folder.metric("psnr", &["gt.exr", test, "--tonemap", tonemap]);
        assert!(psnr("firefly.exr") < psnr("plain.exr"), "{tonemap}");
        assert!(psnr("firefly.exr") > 10.0, "{tonemap}: it is one pixel, not the peak");
    }
}

#[test]
fn alpha_that_is_not_opaque() {
    let folder = Folder::with_pair();
    let rgba = |alpha: &dyn Fn(usize) -> u8| -> Vec<u8> {
        let rgb = codes(48, 40, 3, 1);
        let pixels = rgb.as_chunks::<3>().0.iter().enumerate();
        pixels.flat_map(|(i, p)| [p[0], p[1], p[2], alpha(i)]).collect()
    };
    folder.png("opaque.png", 48, 40, &rgba(&|_| 255));
    assert!(folder.metric("psnr", &["a.png", "opaque.png"]).is_infinite());
    folder.png("glass.png", 48, 40, &rgba(&|i| if i == 48 * 7 + 5 { 128 } else { 255 }));
    refuses(&folder, "glass.png", &["alpha is not 1 everywhere", "1 pixels", "(5, 7)", "--alpha"]);
    folder.png("clear.png", 48, 40, &rgba(&|_| 0));
    refuses(&folder, "clear.png", &["alpha is 0 everywhere", "--alpha ignore"]);
    for file in ["glass.png", "clear.png"] {
        assert!(folder.metric("psnr", &["a.png", file, "--alpha", "ignore"]).is_infinite());
    }
    assert!(folder.metric("psnr", &["a.png", "glass.png", "--alpha", "over-black"]).is_finite());
    folder.png("black.png", 48, 40, &[0; 48 * 40 * 3]);
    assert!(
        folder.metric("psnr", &["black.png", "clear.png", "--alpha", "over-black"]).is_infinite()
    );

    let half = |value: f32| Values::Half(vec![value; 48 * 40]);
    let exr = |name: &str, alpha: f32| {
        let channels = [("R", half(0.5)), ("G", half(0.5)), ("B", half(0.5)), ("A", half(alpha))];
        File::new(vec![Part::new((48, 40), &channels)]).write(&folder.path(name));
    };
    exr("opaque.exr", 1.0);
    exr("clear.exr", 0.0);
    folder.score(&["a.png", "opaque.exr"]).ok();
    refuses(&folder, "clear.exr", &["alpha is 0 everywhere", "--alpha ignore"]);
    folder.score(&["a.png", "clear.exr", "--alpha", "ignore"]).ok();
}

#[test]
fn colour_chunks_are_said_once() {
    let folder = Folder::with_pair();
    let png = bytes(&folder, "a.png");
    let gamma = with_chunk(&png, *b"gAMA", &100_000u32.to_be_bytes());
    folder.write("gamma.png", &gamma);
    let run =
        folder.score(&["gamma.png", "b.png"]).ok().says(&["gamma.png", "gAMA", "not applied"]);
    assert_eq!(run.stderr.matches("gAMA").count(), 1);
    let with_srgb = with_chunk(&gamma, *b"sRGB", &[0]);
    folder.write("srgb.png", with_srgb);
    assert!(
        !folder.score(&["srgb.png", "b.png"]).ok().stderr.contains("gAMA"),
        "sRGB says the same"
    );
    folder.write("cicp.png", with_chunk(&png, *b"cICP", &[9, 16, 0, 1]));
    folder.score(&["cicp.png", "b.png"]).ok().says(&["cICP"]);
    assert_eq!(
        folder.metric("psnr", &["gamma.png", "b.png"]).to_bits(),
        folder.metric("psnr", &["a.png", "b.png"]).to_bits()
    );
}
