//! Floats as half floats, for files.

use half::f16;

use crate::frame::{Frame, Samples};

/// A frame with its floats rounded to half floats. Finite values beyond the range
/// of half floats become the largest or the smallest half float. Other samples stay as they are.
pub fn half_floats(frame: &Frame) -> Frame {
    let Samples::F32(values) = frame.samples() else { return frame.clone() };
    let largest = f16::MAX.to_f32();
    let half = |value: &f32| {
        f16::from_f32(if value.is_finite() { value.clamp(-largest, largest) } else { *value })
    };
    let samples = Samples::F16(values.iter().map(half).collect());
    let (width, height) = frame.file_size();
    let halves = Frame::new(width, height, frame.channels(), samples)
        .unwrap_or_else(|_| unreachable!("as many samples as before"))
        .cropped(frame.crop())
        .unwrap_or_else(|_| unreachable!("the same crop as before"));
    let halves = if frame.is_interleaved() { halves.interleaved() } else { halves };
    if frame.is_encoded() { halves.encoded() } else { halves }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Channels;

    #[test]
    fn large_values_stay_finite() {
        let values = vec![0.1, -1e9, 1e9, f32::INFINITY];
        let frame = Frame::new(4, 1, Channels::Gray, Samples::F32(values.into())).unwrap();
        let halves = [f16::from_f32(0.1), f16::MIN, f16::MAX, f16::INFINITY].to_vec();
        assert_eq!(half_floats(&frame).samples(), &Samples::F16(halves.into()));
        assert!(half_floats(&frame.encoded()).is_encoded());
    }
}
