//! Converts a PNG's codes, with or without alpha, to a frame's samples.

use fovqa_frame::{Channels, Samples};

use crate::alpha::{AlphaPolicy, require_opaque};
use crate::error::ReadErrorKind;

/// A code of 8 or 16 bits.
pub(super) trait Code: Copy + PartialEq + Into<u32> {
    const MAX: Self;

    /// The codes as the samples of a frame.
    fn samples(codes: Vec<Self>) -> Samples;

    /// The code as a share of the largest code.
    fn share(self) -> f64 {
        f64::from(self.into()) / f64::from(Self::MAX.into())
    }
}

impl Code for u8 {
    const MAX: u8 = u8::MAX;

    fn samples(codes: Vec<u8>) -> Samples {
        Samples::U8(codes.into())
    }
}

impl Code for u16 {
    const MAX: u16 = u16::MAX;

    fn samples(codes: Vec<u16>) -> Samples {
        Samples::U16(codes.into())
    }
}

/// Converts interleaved codes to colour samples; if there is alpha, it is the last code of each
/// pixel. Over black, where any alpha is not 1, samples are encoded floats in consecutive planes,
/// because codes would round them.
///
/// # Errors
/// When alpha is not 1 everywhere, and the policy does not allow it.
pub(super) fn samples<C: Code>(
    mut codes: Vec<C>,
    channels: Channels,
    has_alpha: bool,
    width: usize,
    policy: AlphaPolicy,
) -> Result<Samples, ReadErrorKind> {
    let colours = channels.count();
    if !has_alpha {
        return Ok(C::samples(codes));
    }
    let stride = colours + 1;
    let alpha = codes.chunks_exact(stride).map(|pixel| pixel[colours]);
    match policy {
        AlphaPolicy::Error => require_opaque(alpha.map(|a| a.share() as f32), width)?,
        AlphaPolicy::OverBlack if alpha.clone().any(|a| a != C::MAX) => {
            return Ok(Samples::F32(over_black(&codes, colours).into()));
        }
        AlphaPolicy::OverBlack | AlphaPolicy::Ignore => {}
    }
    let pixels = codes.len() / stride;
    for i in 0..pixels {
        codes.copy_within(i * stride..i * stride + colours, i * colours);
    }
    codes.truncate(pixels * colours);
    Ok(C::samples(codes))
}

/// Encoded values multiplied by alpha.
fn over_black<C: Code>(codes: &[C], colours: usize) -> Vec<f32> {
    let stride = colours + 1;
    let mut planes = Vec::with_capacity(codes.len() / stride * colours);
    for c in 0..colours {
        let pixels = codes.chunks_exact(stride);
        planes.extend(pixels.map(|pixel| (pixel[c].share() * pixel[colours].share()) as f32));
    }
    planes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_black_keeps_what_codes_would_round() {
        let codes = vec![255u8, 100, 10, 100, 51, 0, 0, 255];
        let over = |codes, policy| samples(codes, Channels::Rgb, true, 2, policy);
        let Ok(Samples::F32(planes)) = over(codes.clone(), AlphaPolicy::OverBlack) else {
            panic!("floats")
        };
        let share = |code: f64, alpha: f64| (code * alpha / (255.0 * 255.0)) as f32;
        let red = [share(255.0, 100.0), share(51.0, 255.0)];
        let green = [share(100.0, 100.0), 0.0];
        assert_eq!(planes, [red, green, [share(10.0, 100.0), 0.0]].concat().into());
        let ignored = over(codes.clone(), AlphaPolicy::Ignore).unwrap();
        assert_eq!(ignored, Samples::U8(vec![255, 100, 10, 51, 0, 0].into()));
        assert!(matches!(
            over(codes, AlphaPolicy::Error),
            Err(ReadErrorKind::Alpha { transparent: 1, x: 0, y: 0, .. })
        ));
        let opaque = vec![1u16, 2, 3, 65535, 4, 5, 6, 65535];
        let kept = samples(opaque, Channels::Rgb, true, 2, AlphaPolicy::OverBlack).unwrap();
        assert_eq!(kept, Samples::U16(vec![1, 2, 3, 4, 5, 6].into()));
    }
}
