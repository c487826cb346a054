//! OpenEXR files: any channels, layers, parts and windows, and a deep one.

use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, Vec2, WritableImage,
};
use half::f16;

/// Samples of a channel.
#[derive(Debug, Clone)]
pub enum Values {
    /// Half floats.
    Half(Vec<f32>),
    /// Floats.
    Float(Vec<f32>),
    /// Whole numbers.
    Uint(Vec<u32>),
}

/// A part of a file.
#[derive(Debug, Clone)]
pub struct Part {
    /// Its name, empty for none.
    pub name: &'static str,
    /// Corner of the data window.
    pub at: (i32, i32),
    /// Size of the data window.
    pub size: (usize, usize),
    /// Channels by name.
    pub channels: Vec<(String, Values)>,
}

impl Part {
    /// A part at the origin.
    pub fn new(size: (usize, usize), channels: &[(&str, Values)]) -> Self {
        let channels = channels.iter().map(|(name, v)| ((*name).to_owned(), v.clone())).collect();
        Self { name: "", at: (0, 0), size, channels }
    }

    /// R, G and B as half floats, all of them `value(x, y)`.
    pub fn rgb(size: (usize, usize), value: impl Fn(usize, usize) -> f32) -> Self {
        let plane: Vec<f32> = (0..size.0 * size.1).map(|i| value(i % size.0, i / size.0)).collect();
        let half = Values::Half(plane);
        Self::new(size, &[("R", half.clone()), ("G", half.clone()), ("B", half)])
    }
}

/// How a file is put together.
#[derive(Debug, Clone)]
pub struct File {
    /// Its parts.
    pub parts: Vec<Part>,
    /// Corner and size of the display window; `None`: the first part's data window.
    pub display: Option<((i32, i32), (usize, usize))>,
    /// Compression and blocks.
    pub encoding: Encoding,
    /// Primaries red, green, blue, white.
    pub chromaticities: Option<[(f32, f32); 4]>,
}

impl File {
    /// A file of these parts, ZIP-compressed.
    pub fn new(parts: Vec<Part>) -> Self {
        Self { parts, display: None, encoding: Encoding::SMALL_LOSSLESS, chromaticities: None }
    }

    /// Writes it.
    ///
    /// # Panics
    /// When it cannot be written.
    pub fn write(&self, path: &Path) {
        let first = &self.parts[0];
        let (at, size) = self.display.unwrap_or((first.at, first.size));
        let mut attributes =
            ImageAttributes::new(IntegerBounds::new(Vec2(at.0, at.1), Vec2(size.0, size.1)));
        attributes.chromaticities = self.chromaticities.map(|[r, g, b, w]| {
            let xy = |v: (f32, f32)| Vec2(v.0, v.1);
            exr::meta::attribute::Chromaticities {
                red: xy(r),
                green: xy(g),
                blue: xy(b),
                white: xy(w),
            }
        });
        let layers = self.parts.iter().map(|part| {
            let own = LayerAttributes {
                layer_name: (!part.name.is_empty()).then(|| part.name.into()),
                layer_position: Vec2(part.at.0, part.at.1),
                ..LayerAttributes::default()
            };
            let channels = part.channels.iter().map(|(name, values)| {
                let samples = match values {
                    Values::Half(v) => {
                        FlatSamples::F16(v.iter().map(|v| f16::from_f32(*v)).collect())
                    }
                    Values::Float(v) => FlatSamples::F32(v.clone()),
                    Values::Uint(v) => FlatSamples::U32(v.clone()),
                };
                AnyChannel::new(name.as_str(), samples)
            });
            Layer::new(part.size, own, self.encoding, AnyChannels::sort(channels.collect()))
        });
        Image::from_layers(attributes, layers.collect::<Vec<_>>())
            .write()
            .to_file(path)
            .expect("a writable path");
    }
}

/// The bytes of a deep scan-line file, as far as its offset table.
pub fn deep() -> Vec<u8> {
    const DEEP: u32 = 0x800;
    let mut bytes = 20_000_630u32.to_le_bytes().to_vec();
    bytes.extend((2 | DEEP).to_le_bytes());
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        bytes.extend(name.as_bytes());
        bytes.push(0);
        bytes.extend(kind.as_bytes());
        bytes.push(0);
        bytes.extend((value.len() as u32).to_le_bytes());
        bytes.extend(value);
    };
    let ints = |values: &[i32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let mut channels = Vec::new();
    for name in ["B", "G", "R", "Z"] {
        channels.extend(name.as_bytes());
        channels.push(0);
        channels.extend(ints(&[1, 0, 1, 1])); // half, not linear, sampled at every pixel
    }
    channels.push(0);
    attribute("channels", "chlist", &channels);
    attribute("chunkCount", "int", &ints(&[4]));
    attribute("compression", "compression", &[2]);
    attribute("dataWindow", "box2i", &ints(&[0, 0, 3, 3]));
    attribute("displayWindow", "box2i", &ints(&[0, 0, 3, 3]));
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("maxSamplesPerPixel", "int", &ints(&[2]));
    attribute("name", "string", b"deep");
    attribute("pixelAspectRatio", "float", &1.0f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1.0f32.to_le_bytes());
    attribute("type", "string", b"deepscanline");
    attribute("version", "int", &ints(&[1]));
    bytes.push(0);
    bytes.extend([0; 32]);
    bytes
}
