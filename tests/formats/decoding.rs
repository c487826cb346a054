//! Every kind of file that is read: the same picture scores the same.

use exr::prelude::{Blocks, Compression, Encoding, LineOrder, Vec2};
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::png_files::{palette, write16};
use fovqa_testkit::synthetic::{Xorshift, codes};

use crate::fovqa::{Folder, root, shared};

const W: usize = 48;
const H: usize = 40;

/// sRGB code to linear light.
fn light(code: u8) -> f32 {
    let v = f64::from(code) / 255.0;
    (if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }) as f32
}

/// The planes of interleaved codes, as light.
fn planes(codes: &[u8]) -> [Vec<f32>; 3] {
    std::array::from_fn(|c| codes.iter().skip(c).step_by(3).map(|code| light(*code)).collect())
}

fn rgb_part(codes: &[u8], values: impl Fn(Vec<f32>) -> Values) -> Part {
    let [r, g, b] = planes(codes).map(values);
    Part::new((W, H), &[("R", r), ("G", g), ("B", b)])
}

#[test]
fn eight_and_sixteen_bits_gray_and_rgb() {
    let folder = Folder::with_pair();
    let rgb = codes(W, H, 3, 1);
    let wide: Vec<u16> = rgb.iter().map(|c| u16::from(*c) * 257).collect();
    write16(&folder.path("a16.png"), W, H, &wide);
    let psnr = |a: &str, b: &str| folder.metric("psnr", &[a, b]);
    assert!(psnr("a.png", "a16.png").is_infinite());
    assert!((psnr("a16.png", "b.png") - psnr("a.png", "b.png")).abs() < 1e-6);
    let gray = codes(W, H, 1, 5);
    folder.png("gray.png", W, H, &gray);
    folder.png("gray_rgb.png", W, H, &gray.iter().flat_map(|c| [*c; 3]).collect::<Vec<_>>());
    write16(
        &folder.path("gray16.png"),
        W,
        H,
        &gray.iter().map(|c| u16::from(*c) * 257).collect::<Vec<_>>(),
    );
    let gray_alpha: Vec<u8> = gray.iter().flat_map(|c| [*c, 255]).collect();
    folder.png("gray_alpha.png", W, H, &gray_alpha);
    for other in ["gray_rgb.png", "gray16.png", "gray_alpha.png"] {
        assert!(psnr("gray.png", other).is_infinite(), "{other}");
        assert!((psnr(other, "b.png") - psnr("gray.png", "b.png")).abs() < 1e-6, "{other}");
        assert!((psnr("b.png", other) - psnr("b.png", "gray.png")).abs() < 1e-6, "{other}");
    }
}

#[test]
fn palettes() {
    let folder = Folder::with_pair();
    let colours: Vec<[u8; 3]> = (0..=255).map(|i| [i, 255 - i, i / 2]).collect();
    let indices = codes(W, H, 1, 9);
    let rgb: Vec<u8> = indices.iter().flat_map(|i| colours[usize::from(*i)]).collect();
    folder.png("rgb.png", W, H, &rgb);
    folder.write("palette.png", palette(W, H, &indices, &colours, &[]));
    assert!(folder.metric("psnr", &["rgb.png", "palette.png"]).is_infinite());
    folder.write("opaque.png", palette(W, H, &indices, &colours, &[255; 256]));
    assert!(folder.metric("psnr", &["rgb.png", "opaque.png"]).is_infinite());
    folder.write("clear.png", palette(W, H, &indices, &colours, &[0; 256]));
    folder.score(&["rgb.png", "clear.png"]).fails(3, &["alpha is 0 everywhere"]);
    // An index beyond the palette.
    folder.write("beyond.png", palette(W, H, &indices, &colours[..4], &[]));
    assert!([0, 3].contains(&folder.score(&["rgb.png", "beyond.png"]).code));
}

#[test]
fn exr_of_every_type_and_compression() {
    let folder = Folder::with_pair();
    let a = codes(W, H, 3, 1);
    let want = folder.metric("psnr", &["a.png", "b.png"]);
    let near = |file: &str, tolerance: f64| {
        let got = folder.metric("psnr", &[file, "b.png"]);
        assert!((got - want).abs() < tolerance, "{file}: {got} for {want}");
    };
    let whole = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ];
    let tiles = Blocks::Tiles(Vec2(17, 13));
    for (i, compression) in whole.into_iter().enumerate() {
        for blocks in [Blocks::ScanLines, tiles] {
            let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            let name = format!("{i}.exr");
            let file = File { encoding, ..File::new(vec![rgb_part(&a, Values::Half)]) };
            file.write(&folder.path(&name));
            near(&name, 0.01);
            let file = File { encoding, ..File::new(vec![rgb_part(&a, Values::Float)]) };
            file.write(&folder.path(&name));
            near(&name, 1e-4);
        }
    }
    let lossy = [
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
        Compression::DWAA(None),
        Compression::DWAB(None),
    ];
    for (i, compression) in lossy.into_iter().enumerate() {
        let encoding =
            Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
        let file = File { encoding, ..File::new(vec![rgb_part(&a, Values::Half)]) };
        file.write(&folder.path(&format!("lossy{i}.exr")));
        near(&format!("lossy{i}.exr"), 1.5);
    }
}

#[test]
fn exr_of_whole_numbers_and_of_mixed_types() {
    let folder = Folder::new();
    let ones = |value: u32| Values::Uint(vec![value; W * H]);
    File::new(vec![Part::new((W, H), &[("R", ones(1)), ("G", ones(0)), ("B", ones(7))])])
        .write(&folder.path("u.exr"));
    let pixel: Vec<u8> = [255, 0, 255].repeat(W * H);
    folder.png("u.png", W, H, &pixel);
    assert!(folder.metric("psnr", &["u.exr", "u.png"]).is_infinite());
    let mixed = [
        ("R", Values::Half(vec![1.0; W * H])),
        ("G", ones(0)),
        ("B", Values::Float(vec![7.0; W * H])),
    ];
    File::new(vec![Part::new((W, H), &mixed)]).write(&folder.path("mixed.exr"));
    assert!(folder.metric("psnr", &["mixed.exr", "u.png"]).is_infinite());
    File::new(vec![Part::new((W, H), &[("Y", Values::Half(vec![1.0; W * H]))])])
        .write(&folder.path("y.exr"));
    folder.png("white.png", W, H, &[255; W * H]);
    assert!(folder.metric("psnr", &["y.exr", "white.png"]).is_infinite());
}

#[test]
fn other_channels_never_enter_a_score() {
    let folder = Folder::with_pair();
    let a = codes(W, H, 3, 1);
    let plain = rgb_part(&a, Values::Half);
    let mut rich = plain.clone();
    for name in ["Z", "motion.X", "motion.Y", "albedo.X", "N.X", "N.Y", "N.Z"] {
        rich.channels.push((name.to_owned(), Values::Float(vec![60_000.0; W * H])));
    }
    // Depth of the sky, or none at all: no bad pixel of the picture.
    rich.channels.push(("depth.V".to_owned(), Values::Float(vec![f32::INFINITY; W * H])));
    File::new(vec![plain]).write(&folder.path("plain.exr"));
    File::new(vec![rich]).write(&folder.path("rich.exr"));
    assert!(folder.metric("psnr", &["plain.exr", "rich.exr"]).is_infinite());
}

#[test]
fn overscan_is_cropped_to_the_display_window() {
    let folder = Folder::with_pair();
    let a = codes(W, H, 3, 1);
    let inner = planes(&a);
    let (w, h) = (W + 7, H + 5);
    let outer = inner.clone().map(|plane| {
        let value = |x: i64, y: i64| {
            let inside = (0..W as i64).contains(&x) && (0..H as i64).contains(&y);
            if inside { plane[y as usize * W + x as usize] } else { 9.0 }
        };
        let at = |i: usize| value((i % w) as i64 - 4, (i / w) as i64 - 2);
        Values::Float((0..w * h).map(at).collect())
    });
    let [r, g, b] = outer;
    let mut part = Part::new((w, h), &[("R", r), ("G", g), ("B", b)]);
    part.at = (96, 198);
    let file = File { display: Some(((100, 200), (W, H))), ..File::new(vec![part]) };
    file.write(&folder.path("overscan.exr"));
    let run = folder.score(&["overscan.exr", "a.png", "--metrics", "psnr"]).ok();
    assert_eq!(run.stderr, "", "overscan is no reason to warn");
    assert!(folder.metric("psnr", &["overscan.exr", "a.png"]) > 100.0);
}

#[test]
fn pixels_outside_the_data_window_are_black_with_a_warning() {
    let folder = Folder::new();
    let mut part = Part::rgb((20, 10), |_, _| 1.0);
    part.at = (5, 7);
    File { display: Some(((0, 0), (W, H))), ..File::new(vec![part]) }
        .write(&folder.path("region.exr"));
    let white = |i: usize| (5..25).contains(&(i % W)) && (7..17).contains(&(i / W));
    let codes: Vec<u8> = (0..W * H).map(|i| if white(i) { 255 } else { 0 }).collect();
    folder.png("region.png", W, H, &codes);
    assert!(folder.metric("psnr", &["region.exr", "region.png"]).is_infinite());
    folder.score(&["region.exr", "region.png"]).ok().says(&["does not cover the display window"]);
}

/// A region render is opaque where it is; around it there is nothing to be transparent.
#[test]
fn alpha_counts_only_where_there_is_data() {
    let folder = Folder::new();
    let half = |value: f32| Values::Half(vec![value; 20 * 10]);
    let region = |name: &str, alpha: f32| {
        let channels = [("R", half(1.0)), ("G", half(1.0)), ("B", half(1.0)), ("A", half(alpha))];
        let mut part = Part::new((20, 10), &channels);
        part.at = (5, 7);
        File { display: Some(((0, 0), (W, H))), ..File::new(vec![part]) }.write(&folder.path(name));
    };
    region("opaque.exr", 1.0);
    region("glass.exr", 0.5);
    folder.score(&["opaque.exr", "opaque.exr"]).ok();
    folder.score(&["opaque.exr", "glass.exr"]).fails(3, &["200 pixels", "(5, 7)"]);
}

/// Noise that DWA cannot compress: blocks are stored raw, the last of them short.
#[test]
fn raw_blocks_of_a_lossy_file() {
    let folder = Folder::new();
    let height = 33;
    let mut random = Xorshift::new(5);
    let mut plane =
        || Values::Half((0..W * height).map(|_| (random.next_unit() * 1e4) as f32).collect());
    let part = Part::new((W, height), &[("R", plane()), ("G", plane()), ("B", plane())]);
    let encoding = |compression| Encoding {
        compression,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    for (name, compression) in [
        ("zip.exr", Compression::ZIP16),
        ("dwaa.exr", Compression::DWAA(None)),
        ("dwab.exr", Compression::DWAB(None)),
    ] {
        let file = File { encoding: encoding(compression), ..File::new(vec![part.clone()]) };
        file.write(&folder.path(name));
    }
    for name in ["dwaa.exr", "dwab.exr"] {
        folder.score(&["zip.exr", name, "--exposure", "-14"]).ok();
    }
}

#[test]
fn other_primaries_are_converted() {
    let folder = Folder::new();
    // Rec.2020 primaries: their pure red lies outside Rec.709, their white does not move.
    let bt2020 = [(0.708, 0.292), (0.170, 0.797), (0.131, 0.046), (0.3127, 0.3290)];
    let write = |name: &str, rgb: [f32; 3], chromaticities| {
        let [r, g, b] = rgb.map(|v| Values::Float(vec![v; W * H]));
        let part = Part::new((W, H), &[("R", r), ("G", g), ("B", b)]);
        File { chromaticities, ..File::new(vec![part]) }.write(&folder.path(name));
    };
    write("gray2020.exr", [0.5; 3], Some(bt2020));
    write("gray709.exr", [0.5; 3], None);
    assert!(folder.metric("psnr", &["gray2020.exr", "gray709.exr"]) > 100.0);
    write("red2020.exr", [0.5, 0.1, 0.1], Some(bt2020));
    // ITU-R BT.2087: the matrix from Rec.2020 to Rec.709.
    let converted = [
        1.6605 * 0.5 - 0.5876 * 0.1 - 0.0728 * 0.1,
        -0.1246 * 0.5 + 1.1329 * 0.1 - 0.0083 * 0.1,
        -0.0182 * 0.5 - 0.1006 * 0.1 + 1.1187 * 0.1,
    ];
    write("red709.exr", converted, None);
    assert!(folder.metric("psnr", &["red2020.exr", "red709.exr"]) > 70.0);
    folder.score(&["red2020.exr", "red709.exr"]).ok().says(&["chromaticities", "converted"]);
    write("broken.exr", [0.5; 3], Some([(0.3, 0.3); 4]));
    folder.score(&["broken.exr", "red709.exr"]).fails(3, &["does not span a colour space"]);
}

#[test]
fn every_committed_render_is_read() {
    let data = root().join("tests/data/small");
    let folder = Folder::new();
    let file = |name: &str| data.join(name).display().to_string();
    for method in ["rmfr", "kfr", "hyper3", "vafr"] {
        let test = file(&format!("living-room/{method}.png"));
        folder.score(&[&file("living-room/gt.png"), &test]).ok();
    }
    for eye in ["left", "right"] {
        let (gt, rmfr) =
            (file(&format!("stereo/{eye}_gt.exr")), file(&format!("stereo/{eye}_rmfr.exr")));
        folder.score(&[&gt, &rmfr, "--exposure", "0.6459"]).ok();
    }
}

#[test]
fn every_full_size_render_scores_as_png_and_as_exr() {
    let Some(stills) = shared("data/stills") else { return };
    let folder = Folder::new();
    for scene in ["sponza", "living-room"] {
        let root = stills.join(scene);
        let meta = std::fs::read_to_string(root.join("meta.json")).unwrap();
        let meta: serde_json::Value = serde_json::from_str(&meta).unwrap();
        let exposure = meta["exposure"].as_f64().unwrap().log2().to_string();
        let file = |name: &str| root.join(name).display().to_string();
        let (png, exr) = (file("gt.png"), file("gt.exr"));
        for place in ["center", "offcenter"] {
            for entry in std::fs::read_dir(root.join(place)).unwrap() {
                let path = entry.unwrap().path();
                let test = path.display().to_string();
                let with = |reference: &str, test: &str| {
                    folder.metric("psnr", &[reference, test, "--exposure", &exposure])
                };
                let of_png = with(&png, &path.with_extension("png").display().to_string());
                let of_exr = with(&exr, &test);
                assert!((of_png - of_exr).abs() < 0.1, "{test}: {of_exr} for {of_png}");
            }
        }
        assert!(folder.metric("psnr", &[&exr, &png, "--exposure", &exposure]) > 45.0);
    }
}
