//! Maps: a value for every pixel or block of pixels of a frame, and its picture in colours.

use multiversion::multiversion;

/// A map of a pair of frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The map's name in file names.
    pub name: &'static str,
    /// The number of values in a row.
    pub width: usize,
    /// The number of rows.
    pub height: usize,
    /// The values, row by row; NaN where there is no value.
    pub values: Vec<f32>,
    /// Whether half floats are precise enough for the values.
    pub is_half: bool,
    /// The map in colours, in one or more pictures.
    pub pictures: Vec<MapPicture>,
}

/// A map in colours.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPicture {
    /// A suffix for the map's name, if there are several pictures.
    pub name: Option<&'static str>,
    /// Interleaved 8-bit codes of red, green and blue.
    pub codes: Vec<u8>,
}

/// The description of a metric's map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapInfo {
    /// The map's name in file names.
    pub name: &'static str,
    /// Side of the block of pixels that each value describes.
    pub block: u64,
    /// A description of the values in one line.
    pub about: &'static str,
    /// The colour scale.
    pub scale: MapScale,
}

/// The values with the darkest and the brightest colour. They are the same for every frame, so that
/// pictures can be compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MapScale {
    /// Equal steps, from the value for no difference to that for the largest difference.
    Linear {
        /// The value with the darkest colour.
        none: f32,
        /// The value with the brightest colour.
        most: f32,
    },
    /// Equal steps of the logarithm.
    Logarithmic {
        /// The value with the darkest colour; lower values have the same colour.
        none: f32,
        /// The value with the brightest colour.
        most: f32,
    },
    /// The metric colours its map itself.
    Own,
}

impl MapInfo {
    /// A map of these values, in the colours of this scale.
    pub(crate) fn colored(&self, (width, height): (usize, usize), values: Vec<f32>) -> Map {
        let codes = values.iter().flat_map(|value| self.scale.color(*value)).collect();
        let pictures = vec![MapPicture { name: None, codes }];
        Map { name: self.name, width, height, values, is_half: false, pictures }
    }
}

/// Colours at equal steps, each brighter than the one before: black, violet, red, orange, pale yellow.
const COLORS: [[f32; 3]; 5] = [
    [0.0, 0.0, 4.0],
    [81.0, 18.0, 124.0],
    [183.0, 55.0, 121.0],
    [252.0, 137.0, 97.0],
    [252.0, 253.0, 191.0],
];

/// The colour for pixels without a value.
const NOTHING: [u8; 3] = [128; 3];

impl MapScale {
    /// The colour of a value: red, green and blue codes.
    fn color(self, value: f32) -> [u8; 3] {
        let share = match self {
            _ if value.is_nan() => return NOTHING,
            Self::Linear { none, most } => (value - none) / (most - none),
            Self::Logarithmic { none, most } => {
                let log = |value: f32| libm::log10f(value.max(none));
                (log(value) - log(none)) / (log(most) - log(none))
            }
            Self::Own => return NOTHING,
        };
        let at = share.clamp(0.0, 1.0) * (COLORS.len() - 1) as f32;
        let below = (at as usize).min(COLORS.len() - 2);
        let (from, to, share) = (COLORS[below], COLORS[below + 1], at - below as f32);
        std::array::from_fn(|c| (from[c] + (to[c] - from[c]) * share + 0.5) as u8)
    }
}

/// Multiplies a row by a factor.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
pub(crate) fn scaled(values: &[f32], by: f32, out: &mut [f32]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out = value * by;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brightness(color: [u8; 3]) -> f32 {
        let [r, g, b] = color.map(f32::from);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn larger_differences_are_brighter() {
        let linear = MapScale::Linear { none: 1.0, most: 0.0 };
        let logarithmic = MapScale::Logarithmic { none: 1e-6, most: 1.0 };
        let values: Vec<f32> = (0..=100).map(|i| i as f32 / 100.0).collect();
        for pair in values.windows(2) {
            let [less, more] =
                [pair[0], pair[1]].map(|value| brightness(linear.color(1.0 - value)));
            assert!(less <= more, "{pair:?}");
            let decades = [pair[0], pair[1]].map(|share| 10f32.powf(6.0 * share - 6.0));
            let [less, more] = decades.map(|value| brightness(logarithmic.color(value)));
            assert!(less <= more, "{decades:?}");
        }
        assert_eq!(linear.color(1.0), [0, 0, 4]);
        assert_eq!(linear.color(-0.5), [252, 253, 191]);
        assert_eq!(logarithmic.color(0.0), [0, 0, 4]);
        assert_eq!(linear.color(f32::NAN), [128; 3]);
    }
}
