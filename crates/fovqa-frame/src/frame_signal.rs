//! One frame as the signal, for those who change pictures rather than compare them.

use crate::frame::{Channels, Frame};
use crate::side::Side;
use crate::signal::SignalTables;

/// A frame, ready to be read row by row as the display-encoded signal in `[0, 1]`.
#[derive(Debug)]
pub struct FrameSignal<'a> {
    side: Side<'a>,
    width: usize,
    height: usize,
    channels: Channels,
}

impl<'a> FrameSignal<'a> {
    /// Prepares a frame; codes are divided by 255 or 65535.
    pub fn new(frame: &'a Frame, tables: &'a SignalTables) -> Self {
        Self {
            side: Side::new(frame, tables.unit(frame)),
            width: frame.width(),
            height: frame.height(),
            channels: frame.channels(),
        }
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Gray or colour.
    pub fn channels(&self) -> Channels {
        self.channels
    }

    /// Reads row `y`, all channels of a pixel side by side.
    ///
    /// # Panics
    /// When there is no such row, or `out` does not have width times channels values.
    pub fn fill_row(&self, y: usize, out: &mut [f32]) {
        assert_eq!(out.len(), self.width * self.channels.count(), "a value for each channel");
        self.side.fill_interleaved(y, out);
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "codes are divided exactly")]
mod tests {
    use super::*;
    use crate::frame::{Crop, Samples};
    use crate::signal_params::SignalParams;

    #[test]
    fn codes_and_planes_come_pixel_by_pixel() {
        let tables = SignalTables::new(SignalParams::default());
        let codes: Vec<u8> = (0..24).collect();
        let frame = Frame::new(4, 2, Channels::Rgb, Samples::U8(codes.into())).unwrap();
        let frame = frame.cropped(Crop { x: 1, y: 1, width: 2, height: 1 }).unwrap();
        let mut row = [0.0; 6];
        FrameSignal::new(&frame, &tables).fill_row(0, &mut row);
        assert_eq!(row, [15, 16, 17, 18, 19, 20].map(|code| code as f32 / 255.0));

        let planes: Vec<f32> = (0..6).map(|i| i as f32 / 8.0).collect();
        let frame = Frame::new(2, 1, Channels::Rgb, Samples::F32(planes.into())).unwrap().encoded();
        FrameSignal::new(&frame, &tables).fill_row(0, &mut row);
        assert_eq!(row, [0.0, 0.25, 0.5, 0.125, 0.375, 0.625]);
    }
}
