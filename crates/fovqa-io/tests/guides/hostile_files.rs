//! Files of motion and depth that are damaged, unsupported or too large.

use std::fs;

use fovqa_io::{
    DepthChannels, MotionChannels, ReadErrorKind, ReadOptions, read_frame, read_guides,
};
use fovqa_testkit::exr_files::{
    Part, block_starts, deep, with_block_as, with_deep_part, with_subsampled,
};

use crate::files::{Folder, auto, depth_named, is_said, options, part};

fn colour_and_guides() -> Vec<Part> {
    let guides = part(&["Z", "motion.X", "motion.Y"]);
    vec![part(&["R", "G", "B"]).named("rgba"), guides.named("rgba.other")]
}

fn ours() -> ReadOptions {
    options(MotionChannels::Auto, depth_named("Z"))
}

#[test]
fn damaged_guides_do_not_affect_the_colour() {
    let folder = Folder::new();
    let whole = fs::read(folder.file(colour_and_guides())).unwrap();
    let plain = read_frame(&folder.path(), &ReadOptions::default()).unwrap();
    read_frame(&folder.path(), &ours()).unwrap();
    let starts = block_starts(&whole);
    assert_eq!(starts.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    for (part, blocks) in starts.iter().enumerate() {
        // A block is its part, row and length, followed by the compressed samples.
        let mut broken = whole.clone();
        broken[blocks[1] + 12..blocks[1] + 40].fill(0xa5);
        let path = folder.bytes(&broken);
        let colour = read_frame(&path, &ReadOptions::default());
        let (rich, guides) = (read_frame(&path, &ours()), read_guides(&path, &ours()));
        let error = rich.unwrap_err().kind;
        assert!(matches!(error, ReadErrorKind::Damaged { .. }), "{error}");
        assert_eq!(colour.is_ok(), part == 1);
        assert_eq!(guides.is_ok(), part == 0);
        if let Ok(colour) = colour {
            assert_eq!(colour, plain);
        }
    }
}

#[test]
fn blocks_of_guides_that_are_missing_or_there_twice() {
    let folder = Folder::new();
    let whole = fs::read(folder.file(colour_and_guides())).unwrap();
    let twice = folder.bytes(with_block_as(&whole, 1, 2, 0));
    is_said(&read_frame(&twice, &ours()).unwrap_err().kind, &["one of its blocks appears twice"]);
    is_said(&read_guides(&twice, &ours()).unwrap_err().kind, &["appears twice"]);
    read_frame(&twice, &ReadOptions::default()).unwrap();
    // A block of one part claims to belong to the other.
    let starts = block_starts(&whole);
    let mut stray = whole.clone();
    stray[starts[1][1]] = 0;
    let stray = folder.bytes(&stray);
    assert!(read_frame(&stray, &ours()).is_err());
    assert!(read_guides(&stray, &ours()).is_err());
    read_frame(&stray, &ReadOptions::default()).unwrap();
}

#[test]
fn guide_files_that_are_cut_short_or_flipped() {
    let folder = Folder::new();
    let whole = fs::read(folder.file(colour_and_guides())).unwrap();
    for length in [4, 5, 100, whole.len() / 2, whole.len() - 3] {
        let path = folder.bytes(&whole[..length]);
        let error = read_guides(&path, &ours()).unwrap_err().kind;
        assert!(matches!(error, ReadErrorKind::Damaged { .. }), "{length}: {error}");
    }
    for at in 4..whole.len() {
        let mut flipped = whole.clone();
        flipped[at] ^= 0x55;
        let path = folder.bytes(&flipped);
        // Some bits have no effect; none may cause worse than an error.
        let _ = read_guides(&path, &auto());
        let _ = read_frame(&path, &ours());
    }
}

#[test]
fn kinds_of_guides_that_are_not_read() {
    let folder = Folder::new();
    let whole = fs::read(folder.file(colour_and_guides())).unwrap();
    let path = folder.bytes(with_subsampled(&whole, "motion.Y"));
    is_said(&read_frame(&path, &ours()).unwrap_err().kind, &["motion.Y is subsampled"]);
    is_said(&read_guides(&path, &ours()).unwrap_err().kind, &["motion.Y is subsampled"]);
    let path = folder.bytes(with_deep_part(&whole));
    is_said(&read_frame(&path, &ours()).unwrap_err().kind, &["deep data"]);
    is_said(&read_guides(&path, &ours()).unwrap_err().kind, &["deep data"]);
    is_said(&read_guides(&folder.bytes(deep()), &ours()).unwrap_err().kind, &["deep data"]);
}

#[test]
fn sizes_of_guide_files_are_limited() {
    let folder = Folder::new();
    let whole = fs::read(folder.file(vec![part(&["Z"])])).unwrap();
    let depth = options(MotionChannels::None, DepthChannels::Auto);
    for window in ["dataWindow\0box2i\0", "displayWindow\0box2i\0"] {
        let at = whole.windows(window.len()).position(|w| w == window.as_bytes()).unwrap();
        let corner = at + window.len() + 4 + 8;
        let mut huge = whole.clone();
        huge[corner..corner + 4].copy_from_slice(&99_999i32.to_le_bytes());
        huge[corner + 4..corner + 8].copy_from_slice(&99_999i32.to_le_bytes());
        let error = read_guides(&folder.bytes(&huge), &depth).unwrap_err().kind;
        is_said(&error, &["100000x100000", "megapixels"]);
    }
}
