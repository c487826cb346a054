//! Files that hold motion and depth without colour.

use fovqa_frame::Guides;
use fovqa_io::{
    DepthChannels, GuidePreset, MotionChannels, Note, ReadOptions, id_of_file, read_guides,
    read_guides_and_hash,
};
use fovqa_testkit::exr_files::File;

use crate::files::{
    Folder, H, SIZE, W, auto, depth_named, found, guides_of, is_motion, is_said, is_seed, named,
    options, part, two_layers, value,
};

#[test]
fn a_file_of_guides_needs_no_colour() {
    let folder = Folder::new();
    let path = folder.file(vec![part(&["Z", "motion.X", "motion.Y"])]);
    let (decoded, id) = read_guides_and_hash(&path, &auto()).unwrap();
    assert_eq!(decoded, read_guides(&path, &auto()).unwrap());
    assert_eq!(id, id_of_file(&path).unwrap());
    is_motion(decoded.guides.motion.as_ref().unwrap(), [1, 2], [1.0, 1.0]);
    is_seed(decoded.guides.depth.as_ref().unwrap(), 0);
    assert_eq!(found(decoded.search.depth.as_ref()), Some("Z"));
    assert!(decoded.notes.is_empty());
}

#[test]
fn bare_names_of_motion_in_a_file_of_its_own() {
    let (w, h) = (W as f64, H as f64);
    let motion = |names: &[&str], given: MotionChannels| {
        let ours = options(given, DepthChannels::None);
        guides_of(vec![part(names)], &ours).map(|decoded| decoded.guides.motion.unwrap())
    };
    let scale = |names: &[&str], given| motion(names, given).unwrap().scale();
    is_motion(&motion(&["X", "Y"], MotionChannels::Auto).unwrap(), [0, 1], [1.0, 1.0]);
    is_motion(&motion(&["R", "G", "B"], MotionChannels::Auto).unwrap(), [0, 1], [w, h]);
    is_motion(&motion(&["X", "Y", "Z", "W"], MotionChannels::Auto).unwrap(), [0, 1], [1.0, -1.0]);
    assert_eq!(scale(&["x", "y"], MotionChannels::Preset(GuidePreset::Blender)), [1.0, -1.0]);
    assert_eq!(scale(&["R", "G"], MotionChannels::Preset(GuidePreset::Falcor)), [w, h]);
    assert_eq!(scale(&["X", "Y"], MotionChannels::Preset(GuidePreset::Mitsuba)), [1.0, 1.0]);
    let unreal = MotionChannels::Preset(GuidePreset::Unreal);
    let unreal = motion(&["R", "G", "B", "A"], unreal).unwrap();
    assert_eq!(unreal.scale(), [-2.0 * w, 2.0 * h]);
    assert_eq!(unreal.at(2, 1)[0], (f64::from(value(0, 2, 1)) - 0.5) * -2.0 * w);
    // Layers that are named after motion take precedence over bare names; other layers do not count.
    let both = ["X", "Y", "Vector.X", "Vector.Y"];
    is_motion(&motion(&both, MotionChannels::Auto).unwrap(), [2, 3], [1.0, -1.0]);
    assert!(motion(&["N.X", "N.Y", "albedo.R", "albedo.G"], MotionChannels::Auto).is_err());
    assert!(motion(&["R", "G"], MotionChannels::Preset(GuidePreset::Blender)).is_err());
    assert!(motion(&["X", "Y"], named(["motion.X", "motion.Y"])).is_err());
}

#[test]
fn bare_names_of_depth_in_a_file_of_its_own() {
    let depth = |names: &[&str], given: DepthChannels| {
        let ours = options(MotionChannels::None, given);
        guides_of(vec![part(names)], &ours).map(|decoded| decoded.guides.depth.unwrap())
    };
    for (names, seed) in [
        (&["Z"][..], 0),
        (&["Y"], 0),
        (&["R"], 0),
        (&["R", "G", "B"], 0),
        (&["distance"], 0),
        (&["deep.down"], 0),
        (&["A", "Z", "R"], 1),
        (&["A", "Depth.Z", "R"], 1),
        (&["X", "Y", "Z"], 2),
    ] {
        is_seed(&depth(names, DepthChannels::Auto).expect(names[0]), seed);
    }
    for names in [&["X", "Y"][..], &["X", "Y", "Z", "W"], &["a", "b"], &["N.X", "N.Y", "N.Z"]] {
        let error = depth(names, DepthChannels::Auto).unwrap_err();
        is_said(&error, &["no depth", "the only channel", names[0]]);
    }
    for (given, name) in [
        (GuidePreset::Blender, "V"),
        (GuidePreset::Falcor, "R"),
        (GuidePreset::Unreal, "R"),
        (GuidePreset::Mitsuba, "Y"),
    ] {
        is_seed(&depth(&["b", name], DepthChannels::Preset(given)).unwrap(), 1);
    }
    is_seed(&depth(&["a", "b"], depth_named("B")).unwrap(), 1);
}

#[test]
fn a_channel_of_motion_is_not_taken_for_depth() {
    let error = guides_of(vec![part(&["R", "G", "B"])], &auto()).unwrap_err();
    is_said(&error, &["no depth", "B, G, R"]);
    let guides = guides_of(vec![part(&["X", "Y", "Z"])], &auto()).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [0, 1], [1.0, 1.0]);
    is_seed(guides.depth.as_ref().unwrap(), 2);
}

#[test]
fn a_guide_missing_from_a_separate_file_is_an_error() {
    let error = guides_of(vec![part(&["Z", "normal"])], &auto()).unwrap_err();
    is_said(&error, &["no motion", "motion.X + motion.Y", "channels are Z, normal", "render them"]);
    let ours = options(MotionChannels::Auto, depth_named("far"));
    let error = guides_of(vec![part(&["motion.X", "motion.Y"])], &ours).unwrap_err();
    is_said(&error, &["no depth", "for far);", "channels are motion.X, motion.Y"]);
    assert_eq!(
        guides_of(vec![part(&["any"])], &ReadOptions::default()).unwrap().guides,
        Guides::default(),
        "nothing is lacking when nothing is asked for"
    );
}

#[test]
fn the_layer_selects_among_several_guides() {
    let error = guides_of(vec![two_layers()], &auto()).unwrap_err();
    is_said(&error, &["could be the motion", "far.Vector.X", "near.Vector.X"]);
    let far = ReadOptions { layer: Some("far.Combined".to_owned()), ..auto() };
    let guides = guides_of(vec![two_layers()], &far).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [9, 10], [1.0, -1.0]);
    is_seed(guides.depth.as_ref().unwrap(), 11);
    let root = ReadOptions { layer: Some("root".to_owned()), ..auto() };
    let names = ["motion.X", "motion.Y", "a.motion.X", "a.motion.Y", "Z"];
    let guides = guides_of(vec![part(&names)], &root).unwrap().guides;
    is_motion(guides.motion.as_ref().unwrap(), [0, 1], [1.0, 1.0]);
}

#[test]
fn a_file_of_guides_has_parts_and_windows_too() {
    let folder = Folder::new();
    let motion = part(&["X", "Y"]).named("motion").placed((-2, 0));
    let depth = part(&["Z"]).named("depth").placed((0, 5));
    let file = File { display: Some(((0, 0), SIZE)), ..File::new(vec![motion, depth]) };
    let decoded = read_guides(&folder.written(&file), &auto()).unwrap();
    assert_eq!(decoded.notes, [Note::UncoveredGuides]);
    let (motion, depth) = (decoded.guides.motion.unwrap(), decoded.guides.depth.unwrap());
    assert_eq!(motion.at(1, 2), [0, 1].map(|seed| f64::from(value(seed, 3, 2))));
    assert!(motion.at(W - 1, 0)[0].is_nan());
    assert_eq!(depth.at(1, 6), value(0, 1, 1));
    assert!(depth.at(1, 4).is_nan());
}
