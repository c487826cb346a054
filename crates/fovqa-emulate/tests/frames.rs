//! Pictures from frames and back.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use fovqa_emulate::{Picture, WriteFrameError};
use fovqa_frame::{Channels, Frame, Samples, SignalParams, SignalTables, ToneMap};

fn read(frame: &Frame, signal: SignalParams) -> Picture {
    Picture::from_frame(frame, &SignalTables::new(signal))
}

#[test]
fn codes_come_back_as_they_were() {
    let frame = Frame::new(16, 16, Channels::Gray, Samples::U8((0..=255).collect())).unwrap();
    assert_eq!(read(&frame, SignalParams::default()).to_codes8(), frame);
    let codes: Vec<u16> = (0..=65535).rev().collect();
    let frame = Frame::new(256, 256, Channels::Gray, Samples::U16(codes.into())).unwrap();
    assert_eq!(read(&frame, SignalParams::default()).to_codes16(), frame);
    let codes: Vec<u8> = (0..96).map(|i| i * 2).collect();
    let frame = Frame::new(8, 4, Channels::Rgb, Samples::U8(codes.into())).unwrap();
    assert_eq!(read(&frame, SignalParams::default()).to_codes8(), frame);
}

#[test]
fn the_signal_is_not_rounded() {
    let frame = Frame::new(2, 2, Channels::Rgb, Samples::U8((0..12).collect())).unwrap();
    let picture = read(&frame, SignalParams::default());
    let signal = picture.to_signal();
    assert!(signal.is_encoded());
    assert_eq!(read(&signal, SignalParams::default()), picture);
}

#[test]
fn light_comes_back_exposed_and_mapped_as_it_was() {
    let values: Vec<f32> = (0..300).map(|i| i as f32 / 300.0).collect();
    let frame = Frame::new(10, 10, Channels::Rgb, Samples::F32(values.clone().into())).unwrap();
    for tonemap in [ToneMap::Clamp, ToneMap::Reinhard] {
        let signal = SignalParams { exposure_stops: -1.5, tonemap, ..SignalParams::default() };
        let back = read(&frame, signal).to_linear(&signal).unwrap();
        let Samples::F32(found) = back.samples() else { panic!("floats") };
        for (found, value) in found.iter().zip(&values) {
            assert!((found - value).abs() < 3e-6, "{tonemap:?}: {found} for {value}");
        }
    }
    let signal = SignalParams { tonemap: ToneMap::Aces, ..SignalParams::default() };
    let error = read(&frame, signal).to_linear(&signal).unwrap_err();
    assert_eq!(error, WriteFrameError::NoInverse);
}
