//! Writes the seeds of `png` and `exr`: small files of every kind that is read, most of them a
//! corner of a committed render. The other seeds are written by hand.

use std::fs;
use std::path::{Path, PathBuf};

use exr::prelude::{Blocks, Compression, Encoding, LineOrder, Vec2};
use fovqa_testkit::exr_files::{File, Part, Values, deep, with_deep_part, with_subsampled};
use fovqa_testkit::png_files::{chunk, header_only, palette, with_chunk, write8, write16};
use image::{DynamicImage, ImageReader};

/// 11x9: whole blocks of 8 and of 4, and rests.
const SIZE: (usize, usize) = (11, 9);

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let picture = root.join("../data/small/living-room/gt.png");
    let picture = ImageReader::open(picture).expect("a render").decode().expect("a render");
    let corner = picture.crop_imm(96, 64, SIZE.0 as u32, SIZE.1 as u32);
    let folder = |name| {
        let folder = root.join("seeds").join(name);
        fs::create_dir_all(&folder).expect("a writable folder");
        folder
    };
    png(&folder("png"), &corner);
    exr(&folder("exr"), &corner);
}

fn png(folder: &Path, corner: &DynamicImage) {
    let at = |name: &str| -> PathBuf { folder.join(name) };
    let put = |name: &str, bytes: &[u8]| fs::write(at(name), bytes).expect("a writable file");
    let (w, h) = SIZE;
    write8(&at("gray.png"), w, h, &corner.to_luma8());
    write8(&at("gray-alpha.png"), w, h, &corner.to_luma_alpha8());
    write8(&at("rgb.png"), w, h, &corner.to_rgb8());
    let mut glass = corner.to_rgba8();
    glass.pixels_mut().step_by(3).for_each(|pixel| pixel.0[3] = 99);
    write8(&at("rgba.png"), w, h, &glass);
    write16(&at("gray16.png"), w, h, &corner.to_luma16());
    write16(&at("rgb16.png"), w, h, &corner.to_rgb16());
    write8(&at("rgb.jpg"), w, h, &corner.to_rgb8());
    write8(&at("gray.jpg"), w, h, &corner.to_luma8());
    put("progressive.jpg", &progressive());

    let indices: Vec<u8> = (0..w * h).map(|i| (i % 3) as u8).collect();
    let colours = [[9, 9, 9], [99, 0, 200], [255, 255, 255]];
    put("palette.png", &palette(w, h, &indices, &colours, &[]));
    put("palette-alpha.png", &palette(w, h, &indices, &colours, &[255, 0, 99]));
    put("interlaced.png", &interlaced());
    put("header.png", &header_only(60_000, 60_000));

    let gray = fs::read(at("gray.png")).expect("just written");
    let chunks: [(&str, [u8; 4], &[u8]); 5] = [
        ("gamma.png", *b"gAMA", &[0, 0, 177, 143]),
        ("code-points.png", *b"cICP", &[9, 16, 0, 1]),
        ("profile.png", *b"iCCP", b"name\0\0\x78\x01\x01\x03\0\xfc\xffabc\x02\x4d\x01\x27"),
        ("text.png", *b"zTXt", b"name\0\0\x78\x01\x01\x03\0\xfc\xffabc\x02\x4d\x01\x27"),
        ("orientation.png", *b"eXIf", EXIF),
    ];
    for (name, chunk, data) in chunks {
        put(name, &with_chunk(&gray, chunk, data));
    }
    let animated = with_chunk(&gray, *b"fcTL", &frame_control());
    put("animated.png", &with_chunk(&animated, *b"acTL", &[0, 0, 0, 2, 0, 0, 0, 0]));
    let mut turned = fs::read(at("gray.jpg")).expect("just written");
    let marker = [&[0xff, 0xe1, 0, 8 + EXIF.len() as u8][..], b"Exif\0\0", EXIF].concat();
    turned.splice(2..2, marker);
    put("orientation.jpg", &turned);
}

/// One entry: turned by a quarter.
const EXIF: &[u8] = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";

/// 8x8 in one bit and seven passes (PNG, 8.2): 15 rows of at most a byte.
fn interlaced() -> Vec<u8> {
    let rows: Vec<u8> = (0..15).flat_map(|row| [0, row * 17]).collect();
    let length = rows.len() as u16;
    let mut data = vec![0x78, 0x01, 1];
    data.extend(length.to_le_bytes());
    data.extend((!length).to_le_bytes());
    let (a, b) = rows.iter().fold((1u32, 0u32), |(a, b), byte| {
        let a = (a + u32::from(*byte)) % 65521;
        (a, (a + b) % 65521)
    });
    data.extend(&rows);
    data.extend((b << 16 | a).to_be_bytes());
    let header = chunk(*b"IHDR", &[0, 0, 0, 8, 0, 0, 0, 8, 1, 0, 0, 0, 1]);
    let magic = b"\x89PNG\r\n\x1a\n";
    [&magic[..], &header, &chunk(*b"IDAT", &data), &chunk(*b"IEND", &[])].concat()
}

/// The frame of an animated PNG.
fn frame_control() -> Vec<u8> {
    let size = [SIZE.0 as u32, SIZE.1 as u32].map(u32::to_be_bytes).concat();
    [&[0; 4][..], &size, &[0; 8], &[0, 1, 0, 30, 0, 0]].concat()
}

/// A gray 8x8 JPEG in two scans: the mean, which is 0, and the rest, which is nothing.
fn progressive() -> Vec<u8> {
    let one_code = |class: u8| {
        let lengths = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        [&[0xff, 0xc4, 0, 20, class][..], &lengths, &[0]].concat()
    };
    let scan = |from, to| vec![0xff, 0xda, 0, 8, 1, 1, 0, from, to, 0, 0x7f];
    [
        vec![0xff, 0xd8, 0xff, 0xdb, 0, 67, 0],
        vec![1; 64],
        vec![0xff, 0xc2, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0],
        one_code(0x00),
        one_code(0x10),
        scan(0, 0),
        scan(1, 63),
        vec![0xff, 0xd9],
    ]
    .concat()
}

fn exr(folder: &Path, corner: &DynamicImage) {
    let at = |name: &str| folder.join(name);
    let put = |name: &str, bytes: &[u8]| fs::write(at(name), bytes).expect("a writable file");
    let picture = corner.to_luma8();
    let value = |x: usize, y: usize| f32::from(picture[(x as u32, y as u32)].0[0]) / 64.0;
    let plane = |scale: f32| -> Vec<f32> {
        (0..SIZE.0 * SIZE.1).map(|i| scale * value(i % SIZE.0, i / SIZE.0)).collect()
    };
    let half = |scale| Values::Half(plane(scale));
    let float = |scale| Values::Float(plane(scale));
    let colour = || Part::rgb(SIZE, value);
    let guides = [("motion.X", half(3.0)), ("motion.Y", half(-1.0)), ("Z", float(9.0))];
    let all = || colour().with(&guides);

    for (name, compression) in [
        ("plain", Compression::Uncompressed),
        ("rle", Compression::RLE),
        ("zips", Compression::ZIP1),
        ("zip", Compression::ZIP16),
        ("piz", Compression::PIZ),
        ("pxr24", Compression::PXR24),
        ("b44", Compression::B44),
        ("b44a", Compression::B44A),
        ("dwaa", Compression::DWAA(None)),
        ("dwab", Compression::DWAB(Some(45.0))),
    ] {
        for (kind, blocks) in [("lines", Blocks::ScanLines), ("tiles", Blocks::Tiles(Vec2(8, 8)))] {
            let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            File { encoding, ..File::new(vec![all()]) }.write(&at(&format!("{name}-{kind}.exr")));
        }
    }

    let write = |name: &str, file: &File| file.write(&at(name));
    let mut whole = colour();
    whole.channels = vec![("Y".to_owned(), Values::Uint(vec![7; SIZE.0 * SIZE.1]))];
    write("gray.exr", &File::new(vec![whole]));
    let opaque = Values::Half(vec![1.0; SIZE.0 * SIZE.1]);
    write("alpha.exr", &File::new(vec![colour().with(&[("A", opaque)])]));
    let wide = [(0.7, 0.3), (0.2, 0.8), (0.1, 0.1), (0.3, 0.3)];
    write("primaries.exr", &File { chromaticities: Some(wide), ..File::new(vec![colour()]) });
    let display = Some(((2, -1), (13, 9)));
    write("windows.exr", &File { display, ..File::new(vec![all().placed((-3, 2))]) });
    let vector = Part::new(SIZE, &[("X", half(1.0)), ("Y", float(2.0)), ("Z", half(3.0))]);
    write("vector.exr", &File::new(vec![vector.clone()]));
    let mut blender = colour().in_layer("ViewLayer.Combined");
    blender.channels.extend(vector.in_layer("ViewLayer.Vector").channels);
    blender.channels.push(("ViewLayer.Depth.Z".to_owned(), float(5.0)));
    blender.channels.extend(colour().in_layer("ViewLayer.Normal").channels);
    write("blender.exr", &File::new(vec![blender]));
    let motion = Part::new(SIZE, &guides[..2]).named("motion");
    let parts = vec![colour().named("beauty"), motion, Part::new(SIZE, &guides[2..]).named("z")];
    write("parts.exr", &File::new(parts));

    let read = |name| fs::read(at(name)).expect("just written");
    put("deep-part.exr", &with_deep_part(&read("parts.exr")));
    put("subsampled.exr", &with_subsampled(&read("zip-lines.exr"), "B"));
    put("deep.exr", &deep());
}
