//! Motion and depth that are read with the colour of the same file.

use exr::prelude::{Blocks, Compression, Encoding, LineOrder, Vec2};
use fovqa_frame::Guides;
use fovqa_io::{
    AlphaPolicy, DepthChannels, GuideOptions, GuideSearch, MotionChannels, ReadErrorKind,
    ReadOptions, id_of_file, read_frame, read_frame_and_hash, read_guides,
};
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::png_files::write8;

use crate::files::{
    Folder, H, SIZE, W, auto, depth_named, float, found, frame_of, half, is_motion, is_said,
    is_seed, named, options, part, value,
};

#[test]
fn nothing_is_looked_for_by_default() {
    let parts = vec![part(&["R", "G", "B", "Z", "motion.X", "motion.Y"])];
    let decoded = frame_of(parts, &ReadOptions::default()).unwrap();
    assert_eq!(decoded.guides, Guides::default());
    assert_eq!(decoded.guide_search, GuideSearch::default());
    assert!(GuideOptions::default().is_none());
    assert!(decoded.guide_search.missing_motion().is_none());
    assert!(decoded.guide_search.missing_depth().is_none());
}

#[test]
fn motion_and_depth_beside_the_colour() {
    let decoded =
        frame_of(vec![part(&["R", "G", "B", "Z", "motion.X", "motion.Y"])], &auto()).unwrap();
    is_motion(decoded.guides.motion.as_ref().unwrap(), [4, 5], [1.0, 1.0]);
    is_seed(decoded.guides.depth.as_ref().unwrap(), 3);
    assert_eq!(decoded.guides.bytes(), 3 * 2 * W * H, "half floats stay");
    let search = &decoded.guide_search;
    assert_eq!(found(search.motion.as_ref()), Some("motion.X + motion.Y"));
    assert_eq!(found(search.depth.as_ref()), Some("Z"));
    assert_eq!(search.channels, ["B", "G", "R", "Z", "motion.X", "motion.Y"]);
    assert!(search.missing_motion().is_none() && search.missing_depth().is_none());
    assert!(decoded.notes.is_empty());
}

#[test]
fn motion_or_depth_alone() {
    let parts = || vec![part(&["R", "G", "B", "Z", "motion.X", "motion.Y"])];
    let motion = options(MotionChannels::Auto, DepthChannels::None);
    let decoded = frame_of(parts(), &motion).unwrap();
    assert!(decoded.guides.motion.is_some() && decoded.guides.depth.is_none());
    assert!(decoded.guide_search.depth.is_none());
    let depth = options(MotionChannels::None, DepthChannels::Auto);
    let decoded = frame_of(parts(), &depth).unwrap();
    assert!(decoded.guides.motion.is_none());
    is_seed(decoded.guides.depth.as_ref().unwrap(), 3);
}

#[test]
fn each_channel_has_a_type_of_its_own() {
    let whole: Vec<u32> = (0..W * H).map(|i| i as u32 + 16_777_000).collect();
    let channels = [
        ("R", half(0)),
        ("G", half(1)),
        ("B", half(2)),
        ("motion.X", half(3)),
        ("motion.Y", float(4)),
        ("Z", Values::Uint(whole.clone())),
    ];
    let decoded = frame_of(vec![Part::new(SIZE, &channels)], &auto()).unwrap();
    is_motion(decoded.guides.motion.as_ref().unwrap(), [3, 4], [1.0, 1.0]);
    assert_eq!(decoded.guides.motion.as_ref().unwrap().bytes(), (2 + 4) * W * H);
    let depth = decoded.guides.depth.unwrap();
    assert_eq!(depth.at(7, 30), whole[30 * W + 7] as f32);
    assert!(matches!(decoded.frame.samples(), fovqa_frame::Samples::F16(_)));
}

/// The colour is the same with and without motion and depth: for one or two parts, lines and tiles,
/// several compressions, alpha and other primaries.
#[test]
fn the_colour_is_the_same_with_guides() {
    let colour = || {
        let opaque = Values::Half(vec![1.0; W * H]);
        let channels = [("R", half(0)), ("G", float(1)), ("B", half(2)), ("A", opaque)];
        Part::new(SIZE, &channels).named("rgba")
    };
    let guides = || part(&["motion.X", "motion.Y", "Z"]).named("other");
    let folder = Folder::new();
    for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(17, 13))] {
        for compression in [Compression::ZIP16, Compression::PIZ, Compression::Uncompressed] {
            let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
            let mut together = colour();
            together.channels.extend(guides().channels);
            let parts = [vec![together], vec![guides(), colour()], vec![colour(), guides()]];
            let files = parts.map(|parts| File { encoding, ..File::new(parts) });
            for chromaticities in [None, Some([(0.7, 0.3), (0.2, 0.8), (0.1, 0.1), (0.3, 0.3)])] {
                for file in &files {
                    let path = folder.written(&File { chromaticities, ..file.clone() });
                    let plain = read_frame(&path, &ReadOptions::default()).unwrap();
                    let ours = options(MotionChannels::Auto, depth_named("Z"));
                    let (rich, id) = read_frame_and_hash(&path, &ours).unwrap();
                    assert_eq!((&rich.frame, &rich.notes), (&plain.frame, &plain.notes));
                    assert!(matches!(rich.frame.samples(), fovqa_frame::Samples::F32(_)));
                    assert!(
                        chromaticities.is_some() || rich.frame.sample(1, 9, 8) == value(1, 9, 8)
                    );
                    assert_eq!(id, id_of_file(&path).unwrap());
                    is_motion(rich.guides.motion.as_ref().unwrap(), [0, 1], [1.0, 1.0]);
                    is_seed(rich.guides.depth.as_ref().unwrap(), 2);
                }
            }
        }
    }
}

#[test]
fn alpha_is_still_looked_at() {
    let parts = vec![part(&["R", "G", "B", "A", "Z", "motion.X", "motion.Y"])];
    let error = frame_of(parts.clone(), &auto()).unwrap_err();
    assert!(matches!(error, ReadErrorKind::Alpha { .. }), "{error}");
    let ignore = ReadOptions { alpha: AlphaPolicy::Ignore, ..auto() };
    is_seed(frame_of(parts, &ignore).unwrap().guides.depth.as_ref().unwrap(), 4);
}

#[test]
fn missing_guides_are_none_and_reported() {
    let decoded = frame_of(vec![part(&["R", "G", "B", "motion.X", "albedo"])], &auto()).unwrap();
    assert_eq!(decoded.guides, Guides::default(), "one of two is none");
    let motion = decoded.guide_search.missing_motion().unwrap();
    is_said(&motion, &["no motion", "motion.X + motion.Y", "Vector.X + Vector.Y", "albedo"]);
    let depth = decoded.guide_search.missing_depth().unwrap();
    is_said(&depth, &["no depth", "Z, Depth.Z", "WorldDepth.R", "B, G, R"]);
    let ours = options(named(["flow.U", "flow.V"]), depth_named("far"));
    let decoded = frame_of(vec![part(&["R", "G", "B"])], &ours).unwrap();
    is_said(&decoded.guide_search.missing_motion().unwrap(), &["flow.U + flow.V"]);
    is_said(&decoded.guide_search.missing_depth().unwrap(), &["for far);"]);
}

#[test]
fn other_formats_hold_no_guides() {
    let folder = Folder::new();
    let png = folder.path().with_extension("png");
    write8(&png, W, H, &[7; W * H]);
    let decoded = read_frame(&png, &auto()).unwrap();
    assert_eq!(decoded.guides, Guides::default());
    let missing = decoded.guide_search.missing_motion().unwrap();
    is_said(&missing, &["no motion", "motion.X + motion.Y", "those of its colour"]);
    assert!(decoded.guide_search.missing_depth().is_some());
    let error = read_guides(&png, &auto()).unwrap_err();
    assert_eq!(error.path, png);
    is_said(&error.kind, &["not an OpenEXR file", "save motion and depth as OpenEXR"]);
    let error = read_guides(&folder.bytes("text"), &auto()).unwrap_err();
    assert!(matches!(error.kind, ReadErrorKind::NotOpenExr));
}
