//! Linear light as OpenEXR, with the channels R, G and B, or Y.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use fovqa_frame::{Frame, Guides};
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

/// An OpenEXR file of floats with motion (`motion.X`, `motion.Y`, in pixels to the right and down, back
/// to the frame before) and depth (`Z`), where there are any. The light is rounded to half floats.
///
/// # Errors
/// If the encoder refuses.
pub fn encode_exr_with_guides(frame: &Frame, guides: &Guides) -> Result<Vec<u8>, String> {
    let (width, height) = (frame.width(), frame.height());
    let names = (0..frame.channels().count()).map(|c| frame.channels().name(c));
    let mut channels: Vec<AnyChannel<FlatSamples>> = names
        .enumerate()
        .map(|(c, name)| {
            let at = |pixel: usize| f16::from_f32(frame.sample(c, pixel % width, pixel / width));
            AnyChannel::new(name, FlatSamples::F16((0..width * height).map(at).collect()))
        })
        .collect();
    let plane = |name: &'static str, at: &dyn Fn(usize, usize) -> f32| {
        let values = (0..width * height).map(|pixel| at(pixel % width, pixel / width));
        AnyChannel::new(name, FlatSamples::F32(values.collect()))
    };
    if let Some(motion) = &guides.motion {
        channels.push(plane("motion.X", &|x, y| motion.at(x, y)[0] as f32));
        channels.push(plane("motion.Y", &|x, y| motion.at(x, y)[1] as f32));
    }
    if let Some(depth) = &guides.depth {
        channels.push(plane("Z", &|x, y| depth.at(x, y)));
    }
    file([width, height], AnyChannels::sort(channels.into_iter().collect()))
}

fn encode(frame: &Frame, samples: impl Fn(usize) -> FlatSamples) -> Result<Vec<u8>, String> {
    let channels = frame.channels();
    let channel = |c: usize| AnyChannel::new(channels.name(c), samples(c));
    let list = AnyChannels::sort((0..channels.count()).map(channel).collect());
    file([frame.width(), frame.height()], list)
}

fn file([width, height]: [usize; 2], list: AnyChannels<FlatSamples>) -> Result<Vec<u8>, String> {
    let encoding = Encoding::SMALL_FAST_LOSSLESS;
    let layer = Layer::new((width, height), LayerAttributes::default(), encoding, list);
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .map_err(|error| error.to_string())?;
    Ok(file.into_inner())
}
