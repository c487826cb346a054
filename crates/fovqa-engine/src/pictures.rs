//! Pictures of a pair, for the report of a run.

use std::sync::Arc;

use fovqa_emulate::{Border, Picture};
use fovqa_frame::{Channels, Crop, Frame, Samples, SignalTables, Transfer};

/// The pictures of a pair, as RGB or gray codes of 8 bits for display.
#[derive(Debug, Clone, PartialEq)]
pub struct PicturePair {
    /// The reference. It is the same picture for all tests of a frame.
    pub reference: Arc<Frame>,
    /// The test.
    pub test: Frame,
    /// The borders between layers or rates of an emulated test.
    pub borders: Vec<Border>,
}

/// A frame as codes of 8 bits for display. Bad pixels and those outside 0 to 1 become the nearest
/// codes.
pub(crate) fn picture_of(frame: &Frame, tables: &SignalTables) -> Frame {
    let is_shown_as_it_is = matches!(frame.samples(), Samples::U8(_))
        && matches!(frame.channels(), Channels::Rgb | Channels::Gray)
        && tables.params().transfer_of(frame) != Transfer::Linear;
    let (width, height) = (frame.width(), frame.height());
    // A crop keeps the samples around it.
    let visible = || frame.part(Crop { x: 0, y: 0, width, height });
    match is_shown_as_it_is.then(visible) {
        Some(Ok(visible)) => visible,
        _ => Picture::from_frame(frame, tables).to_codes8(),
    }
}
