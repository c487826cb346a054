//! From a picture back to a frame: codes of 8 or 16 bits, floats of linear light, or the signal.

use fovqa_frame::transfer::srgb;
use fovqa_frame::{Channels, Frame, Samples, SignalParams, ToneMap};
use rayon::prelude::*;
use thiserror::Error;

use crate::image::Image;
use crate::picture::Picture;
use crate::value::codes8;

/// Values one task works on.
const TASK: usize = 1 << 16;

/// A picture that cannot be written as asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum WriteFrameError {
    /// A tone map without inverse.
    #[error(
        "the tone map `aces` cannot be undone, so that linear light cannot be written: write codes, or read with `clamp` or `reinhard`"
    )]
    NoInverse,
}

impl Picture {
    /// Codes of 8 bits: `[255 clamp(V, 0, 1) + 0.5]`.
    pub fn to_codes8(&self) -> Frame {
        let mut codes = vec![0u8; self.values().len()];
        let tasks = codes.par_chunks_mut(TASK).zip(self.values().par_chunks(TASK));
        tasks.for_each(|(codes, values)| codes8(values, codes));
        self.frame(Samples::U8(codes.into()))
    }

    /// Codes of 16 bits: `[65535 clamp(V, 0, 1) + 0.5]`.
    pub fn to_codes16(&self) -> Frame {
        let mut codes = vec![0u16; self.values().len()];
        // A cast saturates, and makes 0 of NaN.
        self.each(&mut codes, |value| (value * 65535.0 + 0.5) as u16);
        self.frame(Samples::U16(codes.into()))
    }

    /// The signal itself, in floats that are encoded for display: nothing is rounded.
    pub fn to_signal(&self) -> Frame {
        self.frame(Samples::F32(self.planes(|value| value).into())).encoded()
    }

    /// Linear light in floats: sRGB decoded, the tone map inverted, the exposure undone. What was
    /// clipped on the way to the picture stays clipped.
    ///
    /// # Errors
    /// When the tone map has no inverse (`aces`).
    pub fn to_linear(&self, signal: &SignalParams) -> Result<Frame, WriteFrameError> {
        if signal.tonemap.inverse(0.0).is_none() {
            return Err(WriteFrameError::NoInverse);
        }
        let gain = libm::exp2(-signal.exposure_stops) as f32;
        let decoder = srgb::Decoder::new();
        let tonemap: ToneMap = signal.tonemap;
        let light = |value| tonemap.inverse(decoder.decode(value)).unwrap_or_default() * gain;
        Ok(self.frame(Samples::F32(self.planes(light).into())))
    }

    /// The same, but a sample that emulation has left as it was in `before`, the picture of `frame`,
    /// keeps the value of the frame: highlights beyond the range of the tone map are not cut where a
    /// method shows the frame itself.
    ///
    /// # Errors
    /// When the tone map has no inverse (`aces`).
    ///
    /// # Panics
    /// When the pictures and the frame differ in size or channels.
    pub fn to_linear_from(
        &self,
        signal: &SignalParams,
        before: &Picture,
        frame: &Frame,
    ) -> Result<Frame, WriteFrameError> {
        let linear = self.to_linear(signal)?;
        let Samples::F32(samples) = linear.samples().clone() else {
            unreachable!("linear light is in floats")
        };
        let mut samples = samples.into_vec();
        let (width, height) = (self.width(), self.height());
        assert_eq!((before.width(), before.height()), (width, height), "the picture of the frame");
        let channels = self.channels().count();
        let [now, then] = [self.values(), before.values()];
        samples.par_chunks_mut(width).enumerate().for_each(|(line, row)| {
            let (c, y) = (line / height, line % height);
            for (x, sample) in row.iter_mut().enumerate() {
                let at = (y * width + x) * channels + c;
                if now[at].to_bits() == then[at].to_bits() {
                    *sample = frame.sample(c, x, y);
                }
            }
        });
        Ok(self.frame(Samples::F32(samples.into())))
    }

    fn each<T: Send>(&self, out: &mut [T], of: impl Fn(f32) -> T + Sync) {
        out.par_chunks_mut(TASK).zip(self.values().par_chunks(TASK)).for_each(|(out, values)| {
            for (out, &value) in out.iter_mut().zip(values) {
                *out = of(value);
            }
        });
    }

    /// The values, one channel after the other.
    fn planes(&self, of: impl Fn(f32) -> f32 + Sync) -> Vec<f32> {
        let channels = self.channels().count();
        let pixels = self.width() * self.height();
        let mut planes = vec![0.0; pixels * channels];
        for (c, plane) in planes.chunks_exact_mut(pixels).enumerate() {
            let tasks = plane.par_chunks_mut(TASK).zip(self.values().par_chunks(TASK * channels));
            tasks.for_each(|(out, values)| {
                for (out, &value) in out.iter_mut().zip(values[c..].iter().step_by(channels)) {
                    *out = of(value);
                }
            });
        }
        planes
    }

    fn frame(&self, samples: Samples) -> Frame {
        frame([self.width(), self.height()], self.channels(), samples)
    }
}

impl<const C: usize> Image<C, u8> {
    /// The codes as a frame.
    pub(crate) fn into_frame(self) -> Frame {
        let size = [self.width(), self.height()];
        let channels = if C == 1 { Channels::Gray } else { Channels::Rgb };
        frame(size, channels, Samples::U8(self.into_pixels().into_flattened().into()))
    }
}

fn frame([width, height]: [usize; 2], channels: Channels, samples: Samples) -> Frame {
    let frame = Frame::new(width, height, channels, samples);
    frame.unwrap_or_else(|_| unreachable!("a value for each channel of each pixel"))
}
