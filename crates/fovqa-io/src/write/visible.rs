//! The samples of the visible part of a frame.

use std::borrow::Cow;

use fovqa_frame::Frame;

/// The interleaved samples of the visible part. Nothing is copied if all of the frame is visible.
pub(super) fn interleaved<'a, T: Copy>(frame: &Frame, samples: &'a [T]) -> Cow<'a, [T]> {
    plane(frame, samples, frame.channels().count())
}

/// The samples of the visible part of one channel.
pub(super) fn channel<'a, T: Copy>(
    frame: &Frame,
    samples: &'a [T],
    channel: usize,
) -> Cow<'a, [T]> {
    if frame.is_interleaved() {
        let pixels = interleaved(frame, samples);
        let of_channel = pixels.iter().skip(channel).step_by(frame.channels().count());
        return Cow::Owned(of_channel.copied().collect());
    }
    let (width, height) = frame.file_size();
    let pixels = width * height;
    plane(frame, &samples[channel * pixels..(channel + 1) * pixels], 1)
}

fn plane<'a, T: Copy>(frame: &Frame, samples: &'a [T], per_pixel: usize) -> Cow<'a, [T]> {
    let (width, height) = frame.file_size();
    let crop = frame.crop();
    if (crop.width, crop.height) == (width, height) {
        return Cow::Borrowed(samples);
    }
    let row = |y: usize| {
        let start = (y * width + crop.x) * per_pixel;
        &samples[start..start + crop.width * per_pixel]
    };
    Cow::Owned((crop.y..crop.y + crop.height).flat_map(row).copied().collect())
}
