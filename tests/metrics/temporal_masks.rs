//! Differences over time where pixels are left out: bad pixels, masks and crops.

use fovqa_testkit::exr_files::{Part, Values};

use super::temporal::Literal;
use crate::fovqa::Folder;
use crate::frames::moving_frames::{
    ENCODED, H, MOTION, SIZE, W, atd, float, motion, moving, near, noise, part, plane, write,
};

/// Holes: a pixel of the reference before, and one of the test now.
pub(super) const HOLES: [(usize, usize); 2] = [(20, 10), (40, 20)];

pub(super) fn with_hole(
    value: impl Fn(usize, usize) -> f32,
    hole: (usize, usize),
) -> impl Fn(usize, usize) -> f32 {
    move |x, y| if (x, y) == hole { f32::NAN } else { value(x, y) }
}

/// Two frames with holes: a NaN in `gt` before, one in `test` now.
pub(super) fn with_holes(vector: [f32; 2]) -> Folder {
    let folder = Folder::new();
    let [before, now] = HOLES;
    let motion = motion(vector);
    let part = |value: &dyn Fn(usize, usize) -> f32| {
        Part::new(SIZE, &["R", "G", "B"].map(|c| (c, float(value))))
    };
    write(&folder, "gt/0.exr", part(&with_hole(moving(1, 0), before)).with(&motion));
    write(&folder, "gt/1.exr", part(&moving(1, 2)).with(&motion));
    write(&folder, "test/0.exr", part(&moving(2, 0)));
    write(&folder, "test/1.exr", part(&with_hole(moving(2, 2), now)));
    folder
}

/// The pixel is left out, and every pixel whose source touches one, for whichever picture it is bad in.
#[test]
fn a_bad_pixel_is_left_out_where_it_is_and_where_it_was() {
    for vector in [[0.5, -0.25], [-2.0, 1.5], MOTION] {
        let folder = with_holes(vector);
        folder.score(&["gt", "test", "--metrics", "atd"]).fails(3, &["channel", "is NaN at pixel"]);
        let arguments = [&ENCODED[..], &["--nonfinite", "mask"]].concat();
        let found = &atd(&folder, &arguments)["frames"][1]["atd"];
        for (side, seed) in [("reference", 1), ("test", 2)] {
            let mut literal = Literal::new(plane(moving(seed, 2)), plane(moving(seed, 0)), vector);
            let [before, now] = HOLES.map(|(x, y)| y * W + x);
            literal.counts[0][now] = false;
            literal.counts[1][before] = false;
            let (mean, left_out) = literal.atd();
            near(&found[side], mean);
            near(&found["left_out"], left_out);
        }
    }
}

#[test]
fn a_lens_mask_leaves_out_pixels_and_sources() {
    let seen = |x: usize, y: usize| (x * y) % 7 != 3 && x > 5;
    let codes: Vec<u8> = (0..W * H).map(|i| if seen(i % W, i / W) { 255 } else { 0 }).collect();
    let vector = [1.5, 0.0];
    let folder = with_holes(vector);
    folder.png("mask.png", W, H, &codes);
    let arguments = [&ENCODED[..], &["--nonfinite", "mask", "--mask", "mask.png"]].concat();
    let found = &atd(&folder, &arguments)["frames"][1]["atd"];
    let mut literal = Literal::new(plane(moving(2, 2)), plane(moving(2, 0)), vector);
    literal.counts = [1, 0].map(|hole| {
        let counts = |i| seen(i % W, i / W) && (i % W, i / W) != HOLES[hole];
        (0..W * H).map(counts).collect()
    });
    let (mean, left_out) = literal.atd();
    near(&found["test"], mean);
    near(&found["left_out"], left_out);
}

/// What comes from outside of the crop comes from outside of the frame.
#[test]
fn a_crop_cuts_motion_and_depth_too() {
    let folder = Folder::new();
    let depth =
        |frame: usize| move |x: usize, y: usize| 1.0 + noise(7 + frame, x as i64, y as i64) / 10.0;
    let vectors =
        |frame: usize| move |x: usize, _: usize| if frame == 1 && x > 30 { -2.5 } else { 1.0 };
    for frame in 0..2 {
        let guides = [
            ("motion.X", float(vectors(frame))),
            ("motion.Y", float(|_, _| -0.5)),
            ("Z", float(depth(frame))),
        ];
        let gt = part(moving(1, 3 * frame)).with(&guides);
        write(&folder, &format!("gt/{frame}.exr"), gt);
        write(&folder, &format!("test/{frame}.exr"), part(moving(2, 3 * frame)));
        // The same, cut out beforehand.
        let cut = |values: Vec<f32>| -> Vec<f32> {
            (4..24).flat_map(|y| values[y * W + 9..y * W + 49].to_vec()).collect()
        };
        let picture = |seed| {
            let gray = Values::Half(cut(plane(moving(seed, 3 * frame))));
            Part::new((40, 20), &["R", "G", "B"].map(|channel| (channel, gray.clone())))
        };
        let guides = guides.map(|(name, values)| match values {
            Values::Float(values) => (name, Values::Float(cut(values))),
            other => (name, other),
        });
        write(&folder, &format!("cut/gt/{frame}.exr"), picture(1).with(&guides));
        write(&folder, &format!("cut/test/{frame}.exr"), picture(2));
    }
    let found = atd(&folder, &["--crop", "9,4,40,20"])["sequence"]["atd"].clone();
    let cut = folder.json(&["cut/gt", "cut/test", "--metrics", "atd"]);
    assert_eq!(found, cut["sequence"]["atd"]);
    assert_ne!(found, atd(&folder, &[])["sequence"]["atd"]);
    let left_out = found["left_out"].as_f64().unwrap();
    assert!((0.05..0.95).contains(&left_out), "depth and border leave out some: {left_out}");
}
