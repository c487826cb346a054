//! The meaning of the values of motion channels.

use fovqa_frame::Guides;
use fovqa_io::{DepthChannels, GuidePreset, MotionChannels, MotionUnit, NamedMotion, read_frame};
use fovqa_params::Words;
use fovqa_testkit::exr_files::File;

use crate::files::{Folder, H, W, auto, frame_of, is_said, is_seed, options, part, preset, value};

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
        // The unit "frame" is the display window, not the larger data window.
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
    is_said(&missing, &["searched for Vector.X + Vector.Y);"]);
}
