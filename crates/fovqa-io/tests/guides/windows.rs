//! Motion and depth in data windows and display windows.

use std::fs;

use fovqa_frame::Crop;
use fovqa_io::{DepthChannels, MotionChannels, Note, ReadErrorKind, ReadOptions, read_frame};
use fovqa_testkit::exr_files::{File, Part, Values};

use crate::files::{Folder, H, SIZE, W, auto, frame_of, options, part, value, values};

#[test]
fn guides_are_cropped_like_the_frame() {
    let decoded = frame_of(vec![part(&["R", "G", "B", "Z", "motion.X", "motion.Y"])], &auto());
    let crop = Crop { x: 5, y: 6, width: 20, height: 11 };
    let decoded = decoded.unwrap();
    let (frame, guides) =
        (decoded.frame.cropped(crop).unwrap(), decoded.guides.cropped(crop).unwrap());
    assert_eq!(frame.sample(0, 2, 3), value(0, 7, 9));
    assert_eq!(guides.depth.as_ref().unwrap().at(2, 3), value(3, 7, 9));
    assert_eq!(guides.motion.unwrap().at(2, 3), [4, 5].map(|seed| f64::from(value(seed, 7, 9))));
}

/// A depth that was rendered for a region only, and motion with overscan.
#[test]
fn pixels_outside_of_a_data_window_are_nan() {
    let region = (10, 9);
    let (at, display) = ((107, 205), ((100, 200), SIZE));
    for float in [false, true] {
        let values = |seed| {
            let values = values(seed, region);
            if float { Values::Float(values) } else { Values::Half(values) }
        };
        let colour = part(&["R", "G", "B"]).named("rgba").placed((100, 200));
        let depth = Part::new(region, &[("Z", values(7))]).named("Depth").placed(at);
        let vector = part(&["motion.X", "motion.Y"]).named("motion").placed((97, 201));
        let folder = Folder::new();
        let file = File { display: Some(display), ..File::new(vec![colour, depth, vector]) };
        let decoded = read_frame(&folder.written(&file), &auto()).unwrap();
        assert_eq!(decoded.notes, [Note::UncoveredGuides], "the colour is whole");
        assert!(decoded.notes[0].in_words().contains("motion or depth"));
        let (depth, motion) = (decoded.guides.depth.unwrap(), decoded.guides.motion.unwrap());
        for (x, y) in (0..W * H).map(|i| (i % W, i / W)) {
            let inside = (7..17).contains(&x) && (5..14).contains(&y);
            let got = depth.at(x, y);
            assert_eq!(got.is_nan(), !inside, "({x}, {y})");
            assert!(!inside || got == value(7, x - 7, y - 5));
            let inside = (0..37).contains(&x) && y >= 1;
            let got = motion.at(x, y);
            assert_eq!(got.map(f64::is_nan), [!inside; 2], "({x}, {y})");
            assert!(!inside || got == [0, 1].map(|seed| f64::from(value(seed, x + 3, y - 1))));
        }
    }
}

#[test]
fn pixels_without_colour_and_guides_are_noted_as_both() {
    let folder = Folder::new();
    let parts = vec![part(&["R", "G", "B", "Z"]).placed((3, 0))];
    let file = File { display: Some(((0, 0), SIZE)), ..File::new(parts) };
    let depth = options(MotionChannels::None, DepthChannels::Auto);
    let decoded = read_frame(&folder.written(&file), &depth).unwrap();
    assert_eq!(decoded.notes, [Note::UncoveredPixels, Note::UncoveredGuides]);
    assert_eq!(decoded.frame.sample(0, 0, 0), 0.0);
    assert!(decoded.guides.depth.unwrap().at(0, 0).is_nan());
}

#[test]
fn parts_have_one_display_window() {
    let folder = Folder::new();
    let parts = vec![part(&["R", "G", "B"]).named("a"), part(&["Z"]).named("Depth")];
    let mut bytes = fs::read(folder.file(parts)).unwrap();
    let window = b"displayWindow\0box2i\0";
    let at = bytes.windows(window.len()).rposition(|w| w == window).unwrap() + window.len() + 4;
    bytes[at + 8] -= 1;
    let path = folder.bytes(&bytes);
    read_frame(&path, &ReadOptions::default()).unwrap();
    let error = read_frame(&path, &auto()).unwrap_err().kind;
    assert!(matches!(error, ReadErrorKind::DisplayWindows), "{error}");
}

#[test]
fn a_guide_outside_of_the_display_window_is_an_error() {
    let folder = Folder::new();
    let depth = part(&["Z"]).named("Depth").placed((40, 0));
    let parts = vec![part(&["R", "G", "B"]).named("a"), depth];
    let file = File { display: Some(((0, 0), SIZE)), ..File::new(parts) };
    let path = folder.written(&file);
    read_frame(&path, &ReadOptions::default()).unwrap();
    let error = read_frame(&path, &auto()).unwrap_err().kind;
    assert!(matches!(error, ReadErrorKind::DisjointWindows { .. }), "{error}");
}
