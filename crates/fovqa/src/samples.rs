//! Converts arrays to frames.

use fovqa_frame::{Buffer, Channels, Frame, Samples};
use half::f16;
use ndarray::ArrayView3;

use crate::error::Error;

/// The element type of an array. `u8` and `u16` are codes that are encoded for a display. Floats
/// are linear values unless the settings state another transfer function
/// ([`SignalParams::transfer`](crate::SignalParams)).
pub trait Sample: Copy + sealed::Sealed + Send + Sync + 'static {
    /// Samples of an image in which the channels of a pixel are side by side.
    #[doc(hidden)]
    fn samples(interleaved: Buffer<Self>) -> Samples;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for u8 {}
    impl Sealed for u16 {}
    impl Sealed for half::f16 {}
    impl Sealed for f32 {}
}

impl Sample for u8 {
    fn samples(interleaved: Buffer<Self>) -> Samples {
        Samples::U8(interleaved)
    }
}

impl Sample for u16 {
    fn samples(interleaved: Buffer<Self>) -> Samples {
        Samples::U16(interleaved)
    }
}

impl Sample for f16 {
    fn samples(interleaved: Buffer<Self>) -> Samples {
        Samples::F16(interleaved)
    }
}

impl Sample for f32 {
    fn samples(interleaved: Buffer<Self>) -> Samples {
        Samples::F32(interleaved)
    }
}

/// The frame of an array of height x width x channel, with one channel (gray) or three (RGB).
///
/// # Errors
/// If it has no pixels, or another number of channels.
#[allow(clippy::needless_pass_by_value, reason = "a view is a borrow already")]
pub(crate) fn frame<T: Sample>(name: &str, pixels: ArrayView3<'_, T>) -> Result<Frame, Error> {
    let (height, width, channels) = pixels.dim();
    let channels = match channels {
        1 => Channels::Gray,
        3 => Channels::Rgb,
        n => {
            return Err(Error::input(
                format!("the {name} has {n} channels"),
                "give an array of height x width x channel, with 1 channel (gray) or 3 (RGB)",
            ));
        }
    };
    // Shared, so that reading the frame copies nothing again.
    let samples = Buffer::shared(pixels.iter().copied().collect::<Vec<T>>());
    Frame::new(width, height, channels, T::samples(samples))
        .map(Frame::interleaved)
        .map_err(|error| Error::input(format!("the {name}: {error}"), "give an array with pixels"))
}
