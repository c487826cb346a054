//! JPEG against libjpeg: what is accepted, libjpeg accepts without a warning, and sees the same.

#![no_main]

use fovqa_frame::Samples;
use fovqa_fuzz::{abort_on_escaping_panics, decode_on_one_thread, with_file};
use fovqa_fuzz_libjpeg::{Transform, decode};
use fovqa_io::{ReadOptions, frame_size, read_frame};
use libfuzzer_sys::fuzz_target;

/// Where whole numbers overflow in libjpeg, its floats are compared with instead: each of three
/// components may be rounded otherwise, and colours double that.
const FLOAT_TOLERANCE: u8 = 8;
const MAX_SAMPLES: usize = 4 << 20;

fn prepare() {
    abort_on_escaping_panics();
    decode_on_one_thread();
}

fuzz_target!(init: prepare(), |bytes: &[u8]| {
    // Other kinds of files are of other targets.
    if !bytes.starts_with(b"\xff\xd8\xff") {
        return;
    }
    let options = ReadOptions { max_megapixels: 1, ..ReadOptions::default() };
    let (size, frame) = with_file(bytes, |path| (frame_size(path), read_frame(path, &options)));
    let Ok(decoded) = frame else { return };
    let (width, height) = (decoded.frame.width(), decoded.frame.height());
    assert_eq!(size.ok(), Some((width, height)), "what its header says");
    let Samples::U8(samples) = decoded.frame.samples() else { panic!("8 bits") };
    let libjpeg = |transform| decode(bytes, MAX_SAMPLES, transform);
    let expected = match libjpeg(Transform::Whole) {
        Ok(expected) => expected,
        // A height behind the first scan is read here alone.
        Err(message) if message.contains("Empty JPEG image") => return,
        Err(message) => panic!("libjpeg refuses it: {message}"),
    };
    assert_eq!(expected.warning, None, "libjpeg warns");
    assert_eq!((width, height), (expected.width, expected.height));
    if **samples != *expected.samples {
        let expected = libjpeg(Transform::Float).expect("as before").samples;
        assert_eq!(samples.len(), expected.len());
        let differences = samples.iter().zip(&expected).map(|(a, b)| a.abs_diff(*b));
        let worst = differences.max().unwrap_or_default();
        assert!(worst <= FLOAT_TOLERANCE, "libjpeg sees something else, by {worst} codes");
    }
});
