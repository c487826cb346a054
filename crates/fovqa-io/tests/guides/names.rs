//! The channel names of motion and depth, among several layers and views.

use fovqa_frame::Guides;
use fovqa_io::{DepthChannels, GuidePreset, MotionChannels, ReadOptions};

use crate::files::{
    auto, depth_named, found, frame_of, is_motion, is_said, is_seed, is_seed_frame, named, options,
    part, preset, two_layers, value,
};

/// The prefix of `ViewLayer.Vector.X` may be in the name of the part, as a whole or partly.
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
fn both_channels_of_motion_come_from_one_layer() {
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
fn of_several_layers_the_colours_own_is_read() {
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
    // Full names decide, whatever the colour's layer is.
    let far = options(named(["far.Vector.X", "far.Vector.Y"]), depth_named("far.depth.z"));
    let far = ReadOptions { layer: Some("near.Combined".to_owned()), ..far };
    let guides = frame_of(vec![two_layers()], &far).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [9, 10], [1.0, 1.0]);
    is_seed(guides.depth.as_ref().unwrap(), 11);
}

/// The colour's own layer takes precedence over names without a layer; it may be the layer without
/// a name.
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
fn a_full_name_takes_precedence_over_a_layer() {
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
        "name the right one",
    ];
    is_said(&motion.unwrap_err(), &pairs);
    let depth = options(MotionChannels::None, depth_named("Depth.Z"));
    let words = ["could be the depth", "left.far.Depth.Z, left.near.Depth.Z"];
    is_said(&frame_of(parts.clone(), &depth).unwrap_err(), &words);
    let near = options(MotionChannels::None, depth_named("near.Depth.Z"));
    assert!(frame_of(parts, &near).unwrap().guides.depth.is_some());
    // Two channels of the colour's own layer match.
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

/// The names of normals, positions and mist also end in Z.
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
