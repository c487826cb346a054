//! Sequences over time: their conditions, and their two channels compared with sums that are
//! written out.

use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::fidelity::fvvdp::temporal_filters::TemporalFilters;

#[test]
fn a_sequence_needs_a_frame_rate_that_filters_can_have() {
    let time = |frames, fps| Time::new(frames, fps, Padding::Replicate);
    assert_eq!(time(2, None), Err(TimeError::NoFps));
    for fps in [4.0, 0.0, -30.0, 1000.5, 1001.0, f64::INFINITY] {
        assert_eq!(time(2, Some(fps)), Err(TimeError::Fps { fps }));
    }
    assert!(matches!(time(2, Some(f64::NAN)), Err(TimeError::Fps { .. })));
    for fps in [4.01, 5.0, 23.976, 1000.0] {
        assert!(time(2, Some(fps)).is_ok(), "{fps}");
    }
    // A still needs no frame rate.
    for fps in [None, Some(0.0), Some(4.0), Some(1e9)] {
        assert!(time(1, fps).is_ok(), "{fps:?}");
    }
    let message = time(9, Some(4.0)).unwrap_err().to_string();
    assert!(message.contains("more than 4 and at most 1000") && message.contains("has 4"));
}

#[test]
fn a_still_is_its_own_only_channel() {
    for padding in [Padding::Replicate, Padding::Circular, Padding::Pingpong] {
        let time = Time::new(1, None, padding).unwrap();
        assert!(time.before_first().is_empty());
        let still = Arc::new(random(5, 4, 1, [0.0, 9.0]));
        let stream = Stream::begin(&time, &still, &BTreeMap::new());
        assert_eq!(stream.channels(&time), [still]);
    }
}

/// The frame `back` steps before frame `now`, as FovVideoVDP's padding defines it.
fn frame_before(padding: Padding, frames: usize, taps: usize, now: usize, back: usize) -> usize {
    if back <= now && !(padding == Padding::Circular && back == now) {
        return now - back;
    }
    let before = (back - now) as isize;
    match padding {
        Padding::Replicate => 0,
        // The order is 0, 1, .., F - 1, F - 2, .., 1, repeated; it ends just before a 0.
        Padding::Pingpong => {
            let there = 0..frames;
            let period: Vec<usize> = there.chain((1..frames - 1).rev()).collect();
            period[(-before).rem_euclid(period.len() as isize) as usize]
        }
        // The window of the first frame ends with the last frame but one, at the position where
        // frame 0 would be.
        Padding::Circular => {
            let (frames, taps) = (frames as isize, taps as isize);
            let k = taps - 1 - before;
            (frames - 1 - taps + k).rem_euclid(frames) as usize
        }
    }
}

#[test]
fn channels_are_the_sums_of_their_formula() {
    for (frames, fps) in [(3, 30.0), (2, 30.0), (4, 60.0), (12, 30.0), (5, 8.0), (5, 240.0)] {
        for padding in [Padding::Replicate, Padding::Circular, Padding::Pingpong] {
            let time = Time::new(frames, Some(fps), padding).unwrap();
            let filters = TemporalFilters::new(fps);
            let taps = filters.len();
            let pictures: Vec<_> = (0..frames as u64)
                .map(|seed| Arc::new(random(7, 5, 40 + seed, [1.0, 90.0])))
                .collect();
            let before = time.before_first();
            let needed: BTreeSet<usize> =
                (0..taps).map(|back| frame_before(padding, frames, taps, 0, back)).collect();
            assert_eq!(before, &needed - &BTreeSet::from([0]), "{padding:?}, {frames} frames");
            let before = before.into_iter().map(|frame| (frame, Arc::clone(&pictures[frame])));
            let mut stream = Stream::begin(&time, &pictures[0], &before.collect());
            for now in 0..frames {
                if now > 0 {
                    stream.push(now, Arc::clone(&pictures[now]));
                }
                let reach: Vec<usize> =
                    (0..taps).rev().map(|k| frame_before(padding, frames, taps, now, k)).collect();
                assert_eq!(stream.frames(), reach, "{padding:?}, frame {now} of {frames}");
                let channels = stream.channels(&time);
                assert_eq!(channels.len(), 2);
                for (channel, weights) in channels.iter().zip(&filters.taps) {
                    let pixel = |i: usize| {
                        let of_tap = |k: usize| {
                            let picture = &pictures[reach[taps - 1 - k]];
                            weights[k] * f64::from(picture.row(i / 7)[i % 7])
                        };
                        (0..taps).map(of_tap).sum::<f64>()
                    };
                    assert_near("channel", values(channel), (0..35).map(pixel), [1e-6, 2e-5]);
                }
            }
        }
    }
}

#[test]
fn pingpong_of_three_frames_goes_to_and_fro() {
    let time = Time::new(3, Some(30.0), Padding::Pingpong).unwrap();
    assert_eq!(time.before_first(), BTreeSet::from([1, 2]));
    let picture = |seed| Arc::new(random(4, 4, seed, [1.0, 2.0]));
    let before = BTreeMap::from([(1, picture(1)), (2, picture(2))]);
    let mut stream = Stream::begin(&time, &picture(0), &before);
    assert_eq!(stream.frames(), [1, 2, 1, 0, 1, 2, 1, 0]);
    stream.push(1, picture(1));
    assert_eq!(stream.frames(), [2, 1, 0, 1, 2, 1, 0, 1]);
}
