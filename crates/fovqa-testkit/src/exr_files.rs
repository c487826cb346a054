//! OpenEXR files: any channels, layers, parts and windows, a deep one, and ways to break them.

use std::path::Path;

use exr::meta::attribute::AttributeValue;
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
    /// The attribute `view`, empty for none.
    pub view: &'static str,
    /// The attribute `multiView`, empty for none.
    pub views: Vec<&'static str>,
    /// Further attributes: names and texts.
    pub texts: Vec<(String, String)>,
}

impl Part {
    /// A part at the origin.
    pub fn new(size: (usize, usize), channels: &[(&str, Values)]) -> Self {
        let channels = channels.iter().map(|(name, v)| ((*name).to_owned(), v.clone())).collect();
        let (views, texts) = (Vec::new(), Vec::new());
        Self { name: "", at: (0, 0), size, channels, view: "", views, texts }
    }

    /// The same with a name.
    #[must_use]
    pub fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// The same of one view.
    #[must_use]
    pub fn of_view(self, view: &'static str) -> Self {
        Self { view, ..self }
    }

    /// The same with channels of these views, the first of which needs no name.
    #[must_use]
    pub fn of_views(self, views: &[&'static str]) -> Self {
        Self { views: views.to_vec(), ..self }
    }

    /// The same with an attribute.
    #[must_use]
    pub fn saying(mut self, name: &str, text: &str) -> Self {
        self.texts.push((name.to_owned(), text.to_owned()));
        self
    }

    /// The same with the corner of its data window elsewhere.
    #[must_use]
    pub fn placed(self, at: (i32, i32)) -> Self {
        Self { at, ..self }
    }

    /// R, G and B as half floats, all of them `value(x, y)`.
    pub fn rgb(size: (usize, usize), value: impl Fn(usize, usize) -> f32) -> Self {
        let plane: Vec<f32> = (0..size.0 * size.1).map(|i| value(i % size.0, i / size.0)).collect();
        let half = Values::Half(plane);
        Self::new(size, &[("R", half.clone()), ("G", half.clone()), ("B", half)])
    }

    /// The same with more channels.
    #[must_use]
    pub fn with(mut self, channels: &[(&str, Values)]) -> Self {
        self.channels.extend(Self::new(self.size, channels).channels);
        self
    }

    /// The same with all its channels in a layer.
    #[must_use]
    pub fn in_layer(mut self, layer: &str) -> Self {
        for (name, _) in &mut self.channels {
            *name = format!("{layer}.{name}");
        }
        self
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
    /// Width of a pixel over its height.
    pub pixel_aspect: f32,
}

impl File {
    /// A file of these parts, ZIP-compressed.
    pub fn new(parts: Vec<Part>) -> Self {
        let encoding = Encoding::SMALL_LOSSLESS;
        Self { parts, display: None, encoding, chromaticities: None, pixel_aspect: 1.0 }
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
        attributes.pixel_aspect = self.pixel_aspect;
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
                view_name: (!part.view.is_empty()).then(|| part.view.into()),
                multi_view_names: (!part.views.is_empty())
                    .then(|| part.views.iter().map(|&view| view.into()).collect()),
                other: part
                    .texts
                    .iter()
                    .map(|(name, text)| {
                        (name.as_str().into(), AttributeValue::Text(text.as_str().into()))
                    })
                    .collect(),
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

/// Where the blocks of a file start, for each of its parts: the entries of its offset tables.
///
/// # Panics
/// When its headers or tables cannot be read.
pub fn block_starts(file: &[u8]) -> Vec<Vec<usize>> {
    let (mut at, parts) = offset_tables(file);
    let mut table = |blocks: usize| {
        let entries = file[at..at + 8 * blocks].as_chunks::<8>().0.iter();
        at += 8 * blocks;
        entries.map(|entry| u64::from_le_bytes(*entry) as usize).collect()
    };
    parts.into_iter().map(&mut table).collect()
}

/// A file in which one block of a part is taken for another one of that part.
///
/// # Panics
/// When its headers cannot be read or have no such blocks.
pub fn with_block_as(file: &[u8], part: usize, block: usize, other: usize) -> Vec<u8> {
    let (tables, parts) = offset_tables(file);
    let table = tables + 8 * parts[..part].iter().sum::<usize>();
    let mut file = file.to_vec();
    file.copy_within(table + 8 * other..table + 8 * other + 8, table + 8 * block);
    file
}

/// Where the offset tables start, and how many blocks each part has.
fn offset_tables(file: &[u8]) -> (usize, Vec<usize>) {
    let mut rest = file;
    let meta = exr::meta::MetaData::read_from_buffered(&mut rest, false).expect("whole headers");
    (file.len() - rest.len(), meta.headers.iter().map(|header| header.chunk_count).collect())
}

/// A file whose first channel of this name, of half floats, says that it has every second column.
///
/// # Panics
/// When there is none.
pub fn with_subsampled(file: &[u8], channel: &str) -> Vec<u8> {
    // The name, the type, a flag and three zeros, then how often there is a sample.
    let entry = [channel.as_bytes(), b"\0\x01\0\0\0"].concat();
    let at = file.windows(entry.len()).position(|w| w == entry).expect("the channel");
    let mut file = file.to_vec();
    file[at + entry.len() + 4] = 2;
    file
}

/// A file of several parts, the last of which says that it holds deep data. Only its headers
/// still make sense.
///
/// # Panics
/// When it has no parts with a type.
pub fn with_deep_part(file: &[u8]) -> Vec<u8> {
    let flat = b"string\0\x0d\0\0\0scanlineimage";
    let at = file.windows(flat.len()).rposition(|w| w == flat).expect("the type of a part");
    let deep = b"string\0\x0c\0\0\0deepscanline";
    let mut file = [&file[..at], deep, &file[at + flat.len()..]].concat();
    file[5] |= 0x08;
    file
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
