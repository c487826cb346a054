//! Gaze traces, by frames and by times, with and without holding what they do not cover.

#![no_main]

use fovqa_fuzz::abort_on_escaping_panics;
use fovqa_vision::{FrameAt, GazeTrace};
use libfuzzer_sys::fuzz_target;

/// Numbers with their places in the sequence: the first ones, a gap, and the ends of all there are.
const FRAMES: &[FrameAt] =
    &[(i64::MIN, 0), (-1, 1), (0, 2), (1, 3), (2, 4), (7, 9), (1000, 1002), (i64::MAX, usize::MAX)];

fuzz_target!(init: abort_on_escaping_panics(), |table: &[u8]| {
    let Ok(trace) = GazeTrace::read(table) else { return };
    let _ = trace.interval_s();
    for hold in [false, true] {
        for fps in [None, Some(72.0), Some(f64::MIN_POSITIVE), Some(1e6)] {
            // One by one too: a frame without a gaze ends the others.
            let ones = FRAMES.iter().map(std::slice::from_ref);
            for frames in ones.chain([FRAMES]) {
                let Ok(gaze) = trace.at_frames(frames, fps, hold) else { continue };
                assert_eq!(gaze.len(), frames.len());
                assert!(gaze.iter().all(|at| at.px.iter().all(|px| px.is_finite())));
            }
        }
    }
});
