//! From a decoded frame to a picture, as metrics read the frame.

use fovqa_frame::{Channels, Frame, FrameSignal, SignalTables};

use crate::image::Image;
use crate::picture::Picture;

impl Picture {
    /// The encoded signal of a frame: codes over 255 or 65535; linear light after exposure, tone map
    /// and sRGB encoding. What `SignalParams::channels` asks for is left aside: a picture keeps the
    /// channels of its frame.
    pub fn from_frame(frame: &Frame, tables: &SignalTables) -> Self {
        let signal = FrameSignal::new(frame, tables);
        match signal.channels() {
            Channels::Gray => Self::Gray(read(&signal)),
            Channels::Rgb => Self::Rgb(read(&signal)),
        }
    }
}

fn read<const C: usize>(signal: &FrameSignal) -> Image<C> {
    Image::by_rows(signal.width(), signal.height(), |y, row| {
        signal.fill_row(y, row.as_flattened_mut());
    })
}
