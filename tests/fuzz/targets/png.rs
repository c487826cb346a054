//! PNG and JPEG, with every way to take alpha, as masks, and their headers alone.

#![no_main]

use fovqa_fuzz::{abort_on_escaping_panics, with_file};
use fovqa_io::{AlphaPolicy, ReadOptions, frame_size, read_frame, read_mask};
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: abort_on_escaping_panics(), |bytes: &[u8]| {
    let options = ReadOptions { max_megapixels: 1, ..ReadOptions::default() };
    with_file(bytes, |path| {
        let size = frame_size(path);
        for alpha in [AlphaPolicy::Error, AlphaPolicy::OverBlack] {
            let options = ReadOptions { alpha, ..options.clone() };
            if let Ok(decoded) = read_frame(path, &options) {
                let frame = (decoded.frame.width(), decoded.frame.height());
                assert_eq!(size.as_ref().ok(), Some(&frame), "what its header says");
            }
        }
        let _ = read_mask(path, &options);
    });
});
