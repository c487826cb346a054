//! Gaze traces, by frames and by times, with and without holding what they do not cover.

#![no_main]

use fovqa_fuzz::abort_on_escaping_panics;
use fovqa_vision::GazeTrace;
use libfuzzer_sys::fuzz_target;

/// The first ones, a gap, and the largest there is.
const FRAMES: &[u64] = &[0, 1, 2, 3, 7, 1000, u64::MAX];

fuzz_target!(init: abort_on_escaping_panics(), |table: &[u8]| {
    let Ok(trace) = GazeTrace::read(table) else { return };
    for hold in [false, true] {
        for fps in [None, Some(72.0), Some(f64::MIN_POSITIVE), Some(1e6)] {
            // One by one too: a frame without a gaze ends the others.
            let ones = FRAMES.iter().map(std::slice::from_ref);
            for frames in ones.chain([FRAMES]) {
                for first in [0, 3] {
                    let Ok(gaze) = trace.at_frames(frames, first, fps, hold) else { continue };
                    assert_eq!(gaze.len(), frames.len());
                    assert!(gaze.iter().all(|at| at.px.iter().all(|px| px.is_finite())));
                }
            }
        }
    }
});
