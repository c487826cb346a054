//! Linear light as OpenEXR, with the channels R, G and B, or Y.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use fovqa_frame::Frame;
use half::f16;

use super::visible::channel;

/// An OpenEXR file of half floats.
pub(super) fn halves(frame: &Frame, values: &[f16]) -> Result<Vec<u8>, String> {
    encode(frame, |c| FlatSamples::F16(channel(frame, values, c).into_owned()))
}

/// An OpenEXR file of floats.
pub(super) fn floats(frame: &Frame, values: &[f32]) -> Result<Vec<u8>, String> {
    encode(frame, |c| FlatSamples::F32(channel(frame, values, c).into_owned()))
}

fn encode(frame: &Frame, samples: impl Fn(usize) -> FlatSamples) -> Result<Vec<u8>, String> {
    let channels = frame.channels();
    let channel = |c: usize| AnyChannel::new(channels.name(c), samples(c));
    let list = AnyChannels::sort((0..channels.count()).map(channel).collect());
    let encoding = Encoding::SMALL_FAST_LOSSLESS;
    let size = (frame.width(), frame.height());
    let layer = Layer::new(size, LayerAttributes::default(), encoding, list);
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .map_err(|error| error.to_string())?;
    Ok(file.into_inner())
}
