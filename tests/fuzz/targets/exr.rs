//! OpenEXR: the only colour layer or one by name, motion and depth beside it or alone, and the
//! header alone.

#![no_main]

use fovqa_fuzz::{abort_on_escaping_panics, decode_on_one_thread, with_file};
use fovqa_io::{
    AlphaPolicy, DepthChannels, GuideOptions, GuidePreset, MotionChannels, MotionUnit, NamedMotion,
    ReadOptions, frame_size, read_frame, read_guides,
};
use libfuzzer_sys::fuzz_target;

fn prepare() {
    abort_on_escaping_panics();
    decode_on_one_thread();
}

fuzz_target!(init: prepare(), |bytes: &[u8]| {
    let any = ReadOptions {
        layer: None,
        alpha: AlphaPolicy::Error,
        max_megapixels: 1,
        guides: GuideOptions { motion: MotionChannels::Auto, depth: DepthChannels::Auto },
        ..ReadOptions::default()
    };
    let named = ReadOptions {
        layer: Some("ViewLayer.Combined".to_owned()),
        alpha: AlphaPolicy::Ignore,
        guides: GuideOptions {
            motion: MotionChannels::Preset(GuidePreset::Blender),
            depth: DepthChannels::Named("Depth.Z".to_owned()),
        },
        ..any.clone()
    };
    let alone = ReadOptions {
        guides: GuideOptions {
            motion: MotionChannels::Named(NamedMotion {
                channels: ["X".to_owned(), "Y".to_owned()],
                sign: [1.0, -1.0],
                scale: [0.5, 2.0],
                unit: MotionUnit::Ndc,
            }),
            depth: DepthChannels::None,
        },
        ..any.clone()
    };
    with_file(bytes, |path| {
        let size = frame_size(path);
        for options in [&any, &named] {
            if let Ok(decoded) = read_frame(path, options) {
                let frame = (decoded.frame.width(), decoded.frame.height());
                assert_eq!(size.as_ref().ok(), Some(&frame), "what its header says");
            }
        }
        for options in [&any, &alone] {
            let _ = read_guides(path, options);
        }
    });
});
