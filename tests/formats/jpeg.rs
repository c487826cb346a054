//! JPEG: read as libjpeg reads it, or refused with the reason.

use std::fs;

use crate::fovqa::{Folder, root};

const START_OF_SCAN: [u8; 2] = [0xff, 0xda];
const END: [u8; 2] = [0xff, 0xd9];

fn case(name: &str) -> String {
    root().join("tests/cases").join(name).display().to_string()
}

/// Bytes of a case.
fn bytes(name: &str) -> Vec<u8> {
    fs::read(case(name)).unwrap()
}

/// Where a marker stands.
fn find(bytes: &[u8], marker: [u8; 2]) -> usize {
    bytes.windows(2).position(|pair| pair == marker).unwrap()
}

/// Where the entropy-coded data of the first scan starts.
fn first_data(bytes: &[u8]) -> usize {
    let at = find(bytes, START_OF_SCAN) + 2;
    at + usize::from(u16::from_be_bytes([bytes[at], bytes[at + 1]]))
}

/// A file of these bytes is refused as damaged, in these words.
#[track_caller]
fn is_damaged(bytes: &[u8], words: &[&str]) {
    let folder = Folder::new();
    folder.write("a.jpg", bytes);
    let run = folder.score(&["a.jpg", "a.jpg"]);
    run.fails(3, &["a.jpg", "the JPEG data is damaged or cut short"]).says(words);
}

/// A file of these bytes is refused as one of a kind that is not read, in these words.
#[track_caller]
fn is_not_read(bytes: &[u8], words: &[&str]) {
    let folder = Folder::new();
    folder.write("a.jpg", bytes);
    let run = folder.score(&["a.jpg", "a.jpg"]);
    run.fails(3, &["a.jpg", "this kind of JPEG file is not supported"]).says(words);
}

/// A file of these bytes has the pixels of a case.
#[track_caller]
fn is_the_same(bytes: &[u8], as_case: &str) {
    let folder = Folder::new();
    folder.write("a.jpg", bytes);
    let psnr = folder.metric("psnr", &["a.jpg", &case(as_case)]);
    assert!(psnr.is_infinite(), "{psnr} dB");
}

/// The PNG beside each file is what libjpeg-turbo 2.1.5 makes of it.
#[test]
fn every_kind_has_the_pixels_of_libjpeg() {
    let mut kinds = 0;
    for entry in fs::read_dir(case("jpeg-kinds")).unwrap() {
        let jpeg = entry.unwrap().path();
        if jpeg.extension().is_some_and(|ending| ending == "jpg") {
            let (png, jpeg) = (jpeg.with_extension("png"), jpeg.display().to_string());
            let arguments = [&jpeg, &*png.display().to_string()];
            let psnr = Folder::new().metric("psnr", &arguments);
            assert!(psnr.is_infinite(), "{jpeg}: {psnr} dB");
            kinds += 1;
        }
    }
    assert_eq!(kinds, 22);
}

#[test]
fn scans_and_sampling_of_any_order() {
    let folder = Folder::new();
    for (jpeg, psnr) in [
        ("jpeg-scans/scans_2x2.jpg", 43.542),
        ("jpeg-scans/scans_2x1.jpg", 44.701),
        ("jpeg-sampling/s1x1_2x2_2x2.jpg", 45.579),
        ("jpeg-sampling/s1x1_2x2_2x2_prog.jpg", 45.579),
        ("not-read/sample3x1.jpg", 34.968),
    ] {
        let truth = case(&format!("{}/truth.png", jpeg.split_once('/').unwrap().0));
        let found = folder.metric("psnr", &[&case(jpeg), &truth]);
        assert!((found - psnr).abs() < 1e-3, "{jpeg}: {found} for {psnr}");
    }
}

#[test]
fn inks_are_converted_with_a_warning() {
    let inks = case("jpeg-kinds/cmyk.jpg");
    Folder::new().score(&[&inks, &inks]).ok().says(&["cmyk.jpg", "CMYK inks"]);
}

#[test]
fn damage_that_leaves_the_end_marker() {
    is_damaged(&bytes("jpeg-damaged/height96.jpg"), &["ends too early"]);
    is_damaged(&bytes("jpeg-damaged/eoi_30.jpg"), &["ends too early"]);
    let whole = bytes("jpeg-damaged/whole.jpg");
    let data = first_data(&whole);
    // A height that is too small leaves data over.
    let mut small = whole.clone();
    let height = find(&whole, [0xff, 0xc0]) + 5;
    let rows = u16::from_be_bytes([small[height], small[height + 1]]) - 16;
    small[height..height + 2].copy_from_slice(&rows.to_be_bytes());
    is_damaged(&small, &["extraneous bytes"]);
    let mut inside = whole.clone();
    inside.splice(data + 40..data + 40, END);
    is_damaged(&inside, &["ends too early"]);
    let mut lost = whole.clone();
    lost.drain(data + 40..data + 300);
    is_damaged(&lost, &["ends too early"]);
    let mut zeros = whole.clone();
    zeros.splice(whole.len() - 2..whole.len() - 2, [0; 16]);
    is_damaged(&zeros, &["extraneous bytes"]);
    is_damaged(&whole[..whole.len() - 2], &["end-of-image marker is missing"]);
}

/// Every byte of the entropy-coded data, changed: what libjpeg warns of is refused. Of what is left
/// the format shows nothing: those files have other pixels, or the same.
#[test]
fn one_changed_byte() {
    let whole = bytes("jpeg-damaged/whole.jpg");
    let folder = Folder::new();
    let (from, to) = (first_data(&whole), whole.len() - 2);
    let mut passed = 0;
    let places = (from..to).step_by(7);
    let count = places.len();
    for at in places {
        let mut changed = whole.clone();
        changed[at] ^= 0x55;
        folder.write("a.jpg", &changed);
        let run = folder.score(&["a.jpg", "a.jpg", "--metrics", "psnr"]);
        assert!(matches!(run.code, 0 | 3), "{}", run.stderr);
        passed += usize::from(run.code == 0);
    }
    // libjpeg-turbo 2.1.5 warns of 12 of the 86; 13 more hold coefficients that no image has.
    assert_eq!((count, passed), (86, 61));
}

#[test]
fn restart_markers_have_to_count() {
    let restart = bytes("jpeg-kinds/restart.jpg");
    let mut swapped = restart.clone();
    let marker = find(&restart, [0xff, 0xd1]);
    swapped[marker + 1] = 0xd2;
    is_damaged(&swapped, &["restart marker 2 is where 1 should be"]);
    let mut missing = restart.clone();
    missing.drain(marker..marker + 2);
    is_damaged(&missing, &["restart marker 2 is where 1 should be"]);
    let mut behind = restart.clone();
    let last = restart.windows(2).rposition(|p| p[0] == 0xff && (0xd0..0xd8).contains(&p[1]));
    let next = 0xd0 + (restart[last.unwrap() + 1] - 0xd0 + 1) % 8;
    behind.splice(restart.len() - 2..restart.len() - 2, [0xff, next]);
    is_the_same(&behind, "jpeg-kinds/restart.png");
}

#[test]
fn scans_have_to_be_complete() {
    let progressive = bytes("jpeg-kinds/progressive.jpg");
    let scans: Vec<usize> =
        (0..progressive.len() - 1).filter(|&i| progressive[i..i + 2] == START_OF_SCAN).collect();
    let last = *scans.last().unwrap();
    is_damaged(
        &[&progressive[..last], &END].concat(),
        &["its last scans, which contain the finest detail, are missing"],
    );
    let twice = [&progressive[..progressive.len() - 2], &progressive[last..]].concat();
    is_damaged(&twice, &["repeats what an earlier scan contains"]);
    let each = bytes("jpeg-kinds/scans.jpg");
    let last = each.windows(2).rposition(|pair| pair == START_OF_SCAN).unwrap();
    is_damaged(&[&each[..last], &END].concat(), &["scan of a component is missing"]);
}

#[test]
fn what_does_no_harm() {
    let plain = bytes("jpeg-kinds/420.jpg");
    let end = plain.len() - 2;
    let trailing = [&plain[..], b"and more\xff\xd9", &plain].concat();
    is_the_same(&trailing, "jpeg-kinds/420.png");
    let fill = [&plain[..end], &[0xff; 5], &END].concat();
    is_the_same(&fill, "jpeg-kinds/420.png");
    // A thumbnail with markers of its own, and segments of other applications.
    let thumbnail = [b"Exif\0\0", &plain[..]].concat();
    let length = (thumbnail.len() as u16 + 2).to_be_bytes();
    let unknown = [0xff, 0xe9, 0, 6, 0xff, 0xd9, 0xff, 0xda, 0xff, 0xff, 0xfe, 0, 2];
    let parts = [&plain[..2], &[0xff, 0xe1], &length, &thumbnail, &unknown, &plain[2..]];
    is_the_same(&parts.concat(), "jpeg-kinds/420.png");
    // Zeros where a sequential scan says which coefficients it has.
    let mut zeros = plain.clone();
    let data = first_data(&plain);
    zeros[data - 3..data].fill(0);
    is_the_same(&zeros, "jpeg-kinds/420.png");
}

#[test]
fn kinds_that_are_not_read_are_named() {
    let arithmetic = bytes("not-read/arithmetic.jpg");
    is_not_read(&arithmetic, &["arithmetic coding", "djpeg in.jpg | pnmtopng", "magick"]);
    let plain = bytes("jpeg-kinds/420.jpg");
    let frame = find(&plain, [0xff, 0xc0]);
    let with = |place: usize, value: u8| {
        let mut bytes = plain.clone();
        bytes[frame + place] = value;
        bytes
    };
    is_not_read(&with(1, 0xc3), &["lossless coding", "PNG"]);
    is_not_read(&with(1, 0xc5), &["hierarchical coding", "PNG"]);
    is_not_read(&with(1, 0xde), &["hierarchical coding"]);
    is_not_read(&with(1, 0xca), &["arithmetic coding"]);
    is_not_read(&with(1, 0xf7), &["JPEG-LS", "ffmpeg"]);
    is_not_read(&with(4, 12), &["12 bits per sample", "libjpeg-turbo 3"]);
    // 3x2 beside 2x2.
    let mut ratio = with(11, 0x32);
    ratio[frame + 14] = 0x22;
    is_not_read(&ratio, &["2x2 samples where others have 3x2", "subsampling"]);
    let adobe = [0xff, 0xee, 0, 14, b'A', b'd', b'o', b'b', b'e', 0, 100, 0, 0, 0, 0, 5];
    let first = find(&plain, [0xff, 0xdb]);
    is_not_read(&[&plain[..2], &adobe, &plain[first..]].concat(), &["colour transform 5"]);
}

/// A header that declares more than the file can hold costs nothing.
#[cfg(target_os = "linux")]
#[test]
fn memory_is_asked_for_when_the_header_is_plausible() {
    use crate::fovqa::peak_kb;
    for name in ["420", "progressive"] {
        let mut large = bytes(&format!("jpeg-kinds/{name}.jpg"));
        let frame = find(&large, if name == "420" { [0xff, 0xc0] } else { [0xff, 0xc2] });
        large[frame + 5..frame + 9].copy_from_slice(&[0x3a, 0x98, 0x3a, 0x98]);
        is_damaged(&large, &["too short for the 15000x15000 pixels"]);
        let folder = Folder::new();
        folder.write("a.jpg", &large);
        let peak = peak_kb(&folder, &["score", "a.jpg", "a.jpg"]);
        assert!(peak < 100_000, "{peak} kB");
    }
}
