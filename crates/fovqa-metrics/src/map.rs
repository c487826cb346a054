//! Maps: a value for every pixel or block of pixels of a frame, and the scale of their colours.

use multiversion::multiversion;

/// A map of a pair of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The description of its values.
    pub info: &'static MapInfo,
    /// Width and height of the frames in pixels.
    pub frame_size: (usize, usize),
    /// The values, row by row, of [`MapInfo::size`]; NaN where there is no value.
    pub values: Vec<f32>,
    /// Whether half floats are precise enough for the values.
    pub is_half: bool,
    /// Pictures that the metric itself defines, of the size of the frames.
    pub pictures: Vec<MapPicture>,
}

/// A map in colours that the metric itself defines.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPicture {
    /// The name of the colours, which follows the map's name in file names.
    pub name: &'static str,
    /// Interleaved 8-bit codes of red, green and blue.
    pub codes: Vec<u8>,
}

/// The description of a metric's map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapInfo {
    /// The map's name in file names.
    pub name: &'static str,
    /// What the values are, as a title has it.
    pub label: &'static str,
    /// The unit of the values, if they have one.
    pub unit: Option<&'static str>,
    /// Side of the block of pixels that each value describes.
    pub block: usize,
    /// A description of the values in one line.
    pub about: &'static str,
    /// What pixels of the brightest colour are, in a word: worse, for maps of differences.
    pub bright: &'static str,
    /// The scale of the colours.
    pub scale: MapScale,
}

/// The values with the first and the last colour. They are the same for every frame, so that
/// pictures can be compared. Values beyond them have the colours of the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MapScale {
    /// Equal steps.
    Linear {
        /// The value of no difference, with the darkest colour.
        none: f32,
        /// The value of the largest difference that is told apart, with the brightest colour.
        most: f32,
    },
    /// Equal steps of the logarithm.
    Logarithmic {
        /// The value with the darkest colour.
        none: f32,
        /// The value with the brightest colour.
        most: f32,
    },
}

impl MapInfo {
    /// The number of values in a row and the number of rows, for frames of a size in pixels. Pixels
    /// beyond the last whole block have no value.
    pub fn size(&self, (width, height): (usize, usize)) -> (usize, usize) {
        (width / self.block, height / self.block)
    }

    /// A map of these values of frames of a size in pixels.
    pub(crate) fn with(&'static self, frame_size: (usize, usize), values: Vec<f32>) -> Map {
        Map { info: self, frame_size, values, is_half: false, pictures: Vec::new() }
    }
}

/// Multiplies a row by a factor.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn scaled(values: &[f32], by: f32, out: &mut [f32]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = value * by;
    }
}
