//! Motion and depth of OpenEXR files, as a caller of this crate reads them.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::float_cmp, reason = "what is only passed on comes back exactly")]

mod files;
mod hostile_files;
mod separate_files;
mod windows;

use exr::prelude::{Blocks, Compression, Encoding, LineOrder, Vec2};
use fovqa_frame::Guides;
use fovqa_io::{
    AlphaPolicy, DepthChannels, GuideOptions, GuidePreset, GuideSearch, MotionChannels, MotionUnit,
    NamedMotion, ReadErrorKind, ReadOptions, id_of_file, read_frame, read_frame_and_hash,
    read_guides,
};
use fovqa_params::Words;
use fovqa_testkit::exr_files::{File, Part, Values};
use fovqa_testkit::png_files::write8;

use crate::files::{
    Folder, H, SIZE, W, auto, depth_named, float, found, frame_of, half, is_motion, is_said,
    is_seed, is_seed_frame, named, options, part, preset, two_layers, value,
};

// ---- beside the colour ----

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

/// Colour of three parts and many compressions, with alpha, with other primaries, with and
/// without guides.
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
fn what_is_missing_is_none_and_can_be_said() {
    let decoded = frame_of(vec![part(&["R", "G", "B", "motion.X", "albedo"])], &auto()).unwrap();
    assert_eq!(decoded.guides, Guides::default(), "one of two is none");
    let motion = decoded.guide_search.missing_motion().unwrap();
    is_said(&motion, &["no motion", "motion.X + motion.Y", "Vector.X + Vector.Y", "albedo"]);
    let depth = decoded.guide_search.missing_depth().unwrap();
    is_said(&depth, &["no depth", "Z, Depth.Z", "WorldDepth.R", "B, G, R"]);
    let ours = options(named(["flow.U", "flow.V"]), depth_named("far"));
    let decoded = frame_of(vec![part(&["R", "G", "B"])], &ours).unwrap();
    is_said(&decoded.guide_search.missing_motion().unwrap(), &["flow.U + flow.V"]);
    is_said(&decoded.guide_search.missing_depth().unwrap(), &["as far;"]);
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

// ---- names ----

/// `ViewLayer.Vector.X`, with all of it, or some, in the name of the part.
#[test]
fn parts_and_layers_are_in_front_of_names() {
    let blender = preset(GuidePreset::Blender);
    let colour = || part(&["R", "G", "B"]).named("ViewLayer.Combined");
    let vector = |lead: &str| {
        let names = ["X", "Y", "Z", "W"].map(|name| format!("{lead}{name}"));
        part(&names.each_ref().map(String::as_str))
    };
    let depth = |name| part(&["R", name]);
    for parts in [
        vec![colour(), vector("").named("ViewLayer.Vector"), depth("Z").named("ViewLayer.Depth")],
        vec![colour(), vector("").named("Vector"), depth("Z").named("Depth")],
        vec![vector("Vector.").named("ViewLayer"), depth("Depth.Z").named("a"), colour()],
        vec![
            vector("ViewLayer.Vector.").named("ViewLayer"),
            depth("Depth.Z").named("Depth"),
            colour(),
        ],
        vec![vector("VIEWLAYER.vector.").named("a"), depth("DEPTH.z").named("b"), colour()],
    ] {
        let what = format!("{parts:?}");
        let decoded = frame_of(parts, &blender).expect(&what);
        let motion = decoded.guides.motion.as_ref().expect(&what);
        is_motion(motion, [0, 1], [1.0, -1.0]);
        is_seed(decoded.guides.depth.as_ref().unwrap(), 1);
        is_seed_frame(&decoded);
    }
    let decoded = frame_of(
        vec![colour(), vector("").named("ViewLayer.Vector"), depth("Z").named("ViewLayer.Depth")],
        &auto(),
    );
    let search = decoded.unwrap().guide_search;
    assert_eq!(found(search.motion.as_ref()), Some("ViewLayer.Vector.X + ViewLayer.Vector.Y"));
    assert_eq!(found(search.depth.as_ref()), Some("ViewLayer.Depth.Z"));
}

#[test]
fn names_begin_at_a_dot() {
    let names = ["R", "G", "B", "xmotion.X", "xmotion.Y", "FooZ", "motion.X.A", "motion.Y.A"];
    assert_eq!(frame_of(vec![part(&names)], &auto()).unwrap().guides, Guides::default());
}

#[test]
fn both_channels_of_motion_are_of_one_layer() {
    let ours = options(named(["u", "v"]), DepthChannels::None);
    let motion = |other| {
        let parts = vec![part(&["R", "G", "B", "a.u", other])];
        frame_of(parts, &ours).unwrap().guides.motion
    };
    assert!(motion("b.v").is_none());
    assert!(motion("v").is_none());
    is_motion(&motion("a.v").unwrap(), [3, 4], [1.0, 1.0]);
}

#[test]
fn of_several_layers_that_of_the_colour() {
    for (layer, [x, y, z]) in [("near.Combined", [3, 4, 5]), ("far.Combined", [9, 10, 11])] {
        for ours in [
            auto(),
            preset(GuidePreset::Blender),
            options(named(["vector.x", "vector.y"]), depth_named("depth.z")),
        ] {
            let ours = ReadOptions { layer: Some(layer.to_owned()), ..ours };
            let guides = frame_of(vec![two_layers()], &ours).unwrap().guides;
            let motion = guides.motion.as_ref().unwrap();
            assert_eq!(
                motion.at(3, 5).map(f64::abs),
                [x, y].map(|seed| f64::from(value(seed, 3, 5)))
            );
            is_seed(guides.depth.as_ref().unwrap(), z);
        }
    }
    // Whole names are meant whatever the colour's layer is.
    let far = options(named(["far.Vector.X", "far.Vector.Y"]), depth_named("far.depth.z"));
    let far = ReadOptions { layer: Some("near.Combined".to_owned()), ..far };
    let guides = frame_of(vec![two_layers()], &far).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [9, 10], [1.0, 1.0]);
    is_seed(guides.depth.as_ref().unwrap(), 11);
}

/// The colour's own layer may be that without a name, and goes before a name without a layer.
#[test]
fn automatic_names_of_the_root_and_of_a_layer() {
    let both = ["motion.X", "motion.Y", "L.motion.X", "L.motion.Y", "L.Depth.Z", "Depth.Z"];
    for (colour, [x, y], depth) in [("", [3, 4], 8), ("L.C.", [5, 6], 7)] {
        let colour = ["R", "G", "B"].map(|name| format!("{colour}{name}"));
        let colour = colour.each_ref().map(String::as_str);
        let guides = frame_of(vec![part(&[&colour[..], &both].concat())], &auto()).unwrap().guides;
        is_motion(guides.motion.as_ref().unwrap(), [x, y], [1.0, 1.0]);
        is_seed(guides.depth.as_ref().unwrap(), depth);
    }
}

#[test]
fn a_whole_name_goes_before_that_of_a_layer() {
    let names = ["L.C.R", "L.C.G", "L.C.B", "far", "L.far", "u", "v", "L.u", "L.v"];
    let guides = frame_of(vec![part(&names)], &options(named(["u", "v"]), depth_named("far")));
    let guides = guides.unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [5, 6], [1.0, 1.0]);
    is_seed(guides.depth.as_ref().unwrap(), 3);
}

#[test]
fn several_that_could_be_meant_are_an_error() {
    let mut rest = two_layers();
    rest.channels.retain(|(name, _)| !name.contains("Combined"));
    let colour = part(&["R", "G", "B"]).named("other");
    let parts = vec![colour, rest.named("left")];
    let motion = frame_of(parts.clone(), &options(MotionChannels::Auto, DepthChannels::None));
    let pairs = [
        "could be the motion",
        "left.near.Vector.X + left.near.Vector.Y",
        "left.far.Vector.X + left.far.Vector.Y",
        "name the one",
    ];
    is_said(&motion.unwrap_err(), &pairs);
    let depth = options(MotionChannels::None, depth_named("Depth.Z"));
    let words = ["could be the depth", "left.far.Depth.Z, left.near.Depth.Z"];
    is_said(&frame_of(parts.clone(), &depth).unwrap_err(), &words);
    let near = options(MotionChannels::None, depth_named("near.Depth.Z"));
    assert!(frame_of(parts, &near).unwrap().guides.depth.is_some());
    // Two of the colour's own layer.
    let two = vec![part(&["a.R", "a.G", "a.B", "a.b.Depth.Z", "a.c.Depth.Z"])];
    is_said(&frame_of(two, &auto()).unwrap_err(), &["a.b.Depth.Z, a.c.Depth.Z"]);
}

#[test]
fn automatic_names_have_an_order() {
    let names = ["R", "G", "B", "Vector.X", "Vector.Y", "motion.X", "motion.Y", "Depth.Z", "Z"];
    let guides = frame_of(vec![part(&names)], &auto()).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [5, 6], [1.0, 1.0]);
    is_seed(guides.depth.as_ref().unwrap(), 8);
    let guides = frame_of(vec![part(&names[..5])], &auto()).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [3, 4], [1.0, -1.0]);
}

/// Normals, positions and mist end in Z too.
#[test]
fn automatic_depth_is_no_other_z() {
    for names in [
        &["R", "G", "B", "N.X", "N.Y", "N.Z", "ViewLayer.Mist.Z", "Vector.Z"][..],
        &["R", "G", "B", "X", "Y", "Z"],
        &["L.C.R", "L.C.G", "L.C.B", "L.C.X", "L.C.Y", "L.C.Z"],
    ] {
        assert!(frame_of(vec![part(names)], &auto()).unwrap().guides.depth.is_none(), "{names:?}");
    }
    for names in [
        &["L.C.R", "L.C.G", "L.C.B", "Z"][..],
        &["L.C.R", "L.C.G", "L.C.B", "L.Z"],
        &["L.C.R", "L.C.G", "L.C.B", "L.C.Z"],
    ] {
        let parts = vec![part(names).named("L")];
        is_seed(frame_of(parts, &auto()).unwrap().guides.depth.as_ref().unwrap(), 3);
    }
    let mist = options(MotionChannels::None, depth_named("Mist.Z"));
    let parts = vec![part(&["R", "G", "B", "ViewLayer.Mist.Z"])];
    is_seed(frame_of(parts, &mist).unwrap().guides.depth.as_ref().unwrap(), 3);
}

// ---- what the values mean ----

#[test]
fn named_motion_has_sign_scale_and_unit() {
    let motion = |unit| {
        let motion = NamedMotion {
            channels: ["u".to_owned(), "v".to_owned()],
            sign: [-1.0, 1.0],
            scale: [0.5, 3.0],
            unit,
        };
        let ours = options(MotionChannels::Named(motion), DepthChannels::None);
        let folder = Folder::new();
        // The frame is the display window, not the larger data window.
        let parts = vec![part(&["R", "G", "B", "u", "v"]).placed((-3, -2))];
        let file = File { display: Some(((0, 0), (20, 30))), ..File::new(parts) };
        read_frame(&folder.written(&file), &ours).unwrap().guides.motion.unwrap()
    };
    for (unit, scale) in [
        (MotionUnit::Pixels, [-0.5, 3.0]),
        (MotionUnit::Frame, [-10.0, 90.0]),
        (MotionUnit::Ndc, [-5.0, 45.0]),
    ] {
        let motion = motion(unit);
        assert_eq!((motion.file_size(), motion.scale()), ((20, 30), scale));
        let at = [value(3, 7, 11), value(4, 7, 11)].map(f64::from);
        assert_eq!(motion.at(4, 9), [at[0] * scale[0], at[1] * scale[1]]);
    }
}

#[test]
fn presets_mean_what_their_renderers_write() {
    let (w, h) = (W as f64, H as f64);
    let unreal = "FinalImageMovieRenderQueue_MotionVectors";
    let unreal = [format!("{unreal}.R"), format!("{unreal}.G")];
    let cases = [
        (GuidePreset::Blender, ["V.Vector.X", "V.Vector.Y"], "V.Depth.Z", [1.0, -1.0], 0.0),
        (GuidePreset::Falcor, ["mvec.R", "mvec.G"], "linearZ.R", [w, h], 0.0),
        (
            GuidePreset::Unreal,
            [unreal[0].as_str(), unreal[1].as_str()],
            "FinalImageMovieRenderQueue_WorldDepth.R",
            [-2.0 * w, 2.0 * h],
            0.5,
        ),
        (GuidePreset::Mitsuba, ["motion.X", "motion.Y"], "depth.T", [1.0, 1.0], 0.0),
    ];
    for (given, [x, y], depth, scale, offset) in cases {
        let parts = vec![part(&["R", "G", "B", x, y, depth])];
        for ours in [preset(given), auto()] {
            let guides = frame_of(parts.clone(), &ours).unwrap().guides;
            let motion = guides.motion.unwrap();
            assert_eq!(motion.scale(), scale, "{}", given.word());
            for (x, y) in [(0, 0), (13, 20)] {
                let at = [value(3, x, y), value(4, x, y)].map(|v| f64::from(v) - offset);
                assert_eq!(motion.at(x, y), [at[0] * scale[0], at[1] * scale[1]]);
                let (mut across, mut down) = ([0.0], [0.0]);
                motion.fill_row(y, x..x + 1, &mut across, &mut down);
                assert_eq!([across[0], down[0]].map(f64::from), at);
            }
            is_seed(guides.depth.as_ref().unwrap(), 5);
        }
    }
    let names = GuidePreset::ALL.map(Words::word);
    assert_eq!(names, ["blender", "falcor", "unreal", "mitsuba"]);
}

#[test]
fn a_preset_looks_for_its_own_names_alone() {
    let parts = vec![part(&["R", "G", "B", "Z", "motion.X", "motion.Y"])];
    let decoded = frame_of(parts, &preset(GuidePreset::Blender)).unwrap();
    assert_eq!(decoded.guides, Guides::default());
    let missing = decoded.guide_search.missing_motion().unwrap();
    is_said(&missing, &["looked for as Vector.X + Vector.Y;"]);
}
