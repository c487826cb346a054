//! The scale of a heat map: which colour each value has.

use libm::{log10, pow};

use crate::canvas::colour_map::{MAP_NO_VALUE, map_palette};
use crate::scales::scale::Scale;

/// The number of colours.
const COLOURS: usize = 256;

/// The index of the colour of a missing value.
const NO_VALUE: usize = COLOURS;

/// The values with the first and the last colour of a heat map. They are the same for all maps of a
/// kind, so that their pictures can be compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatScale {
    /// The value of no difference, with the darkest colour.
    pub none: f32,
    /// The value of the largest difference that is told apart, with the brightest colour. It may be
    /// below `none`.
    pub most: f32,
    /// Whether equal ratios rather than equal differences have equal steps; both values are then
    /// above 0.
    pub log: bool,
}

impl HeatScale {
    /// The position of a value along the scale, from 0 at `none` to 1 at `most`. Values beyond the
    /// ends have the positions of the ends; NaN has none.
    pub fn share(&self, value: f32) -> Option<f64> {
        let share = self.range().share(f64::from(value));
        (!value.is_nan()).then(|| share.clamp(0.0, 1.0))
    }

    /// The scale as that of an axis, from `none` to `most`.
    pub(crate) fn range(&self) -> Scale {
        Scale { low: f64::from(self.none), high: f64::from(self.most), log: self.log }
    }
}

/// The colours of values. They are looked up, because a logarithm for every pixel takes longer than
/// everything else.
#[derive(Debug, Clone)]
pub(crate) struct HeatColours {
    levels: Levels,
    /// The colours, then that of a missing value.
    palette: [[u8; 3]; COLOURS + 1],
}

#[derive(Debug, Clone)]
enum Levels {
    /// The value of the first level, and levels per value.
    Linear {
        none: f32,
        per_value: f32,
    },
    Logarithmic(LogLevels),
}

#[derive(Debug, Clone)]
struct LogLevels {
    /// For each upper half of the bits of a positive number, the level of the smallest such number.
    table: Vec<u8>,
    /// The smallest number of each level after the first, then NaN, which no number reaches.
    starts: Vec<f32>,
    /// Whether the largest number has the first colour.
    falls: bool,
}

impl HeatColours {
    pub(crate) fn new(scale: HeatScale) -> Self {
        let HeatScale { none, most, log } = scale;
        let levels = if log {
            Levels::Logarithmic(LogLevels::new(none, most))
        } else {
            Levels::Linear { none, per_value: (COLOURS - 1) as f32 / (most - none) }
        };
        let mut palette = [MAP_NO_VALUE; COLOURS + 1];
        palette[..COLOURS].copy_from_slice(&map_palette());
        Self { levels, palette }
    }

    /// Writes the colours of a row of values, each `times` times side by side. Pixels after the last
    /// value have the colour of a missing value.
    pub(crate) fn fill(&self, values: &[f32], times: usize, row: &mut [u8]) {
        match &self.levels {
            Levels::Linear { none, per_value } => {
                let last = (COLOURS - 1) as f32;
                let level = |value: f32| {
                    // A NaN passes through `clamp`.
                    let level = ((value - none) * per_value).clamp(0.0, last);
                    if level.is_nan() { NO_VALUE } else { (level + 0.5) as usize }
                };
                self.fill_by(values, times, row, level);
            }
            Levels::Logarithmic(levels) => {
                self.fill_by(values, times, row, |value| levels.level(value));
            }
        }
    }

    fn fill_by(&self, values: &[f32], times: usize, row: &mut [u8], level: impl Fn(f32) -> usize) {
        let (filled, rest) = row.split_at_mut((values.len() * times * 3).min(row.len()));
        if times == 1 {
            for (pixel, value) in filled.as_chunks_mut::<3>().0.iter_mut().zip(values) {
                *pixel = self.palette[level(*value)];
            }
        } else {
            for (pixels, value) in filled.chunks_mut(3 * times).zip(values) {
                pixels.as_chunks_mut::<3>().0.fill(self.palette[level(*value)]);
            }
        }
        rest.as_chunks_mut::<3>().0.fill(MAP_NO_VALUE);
    }
}

impl LogLevels {
    fn new(none: f32, most: f32) -> Self {
        let (low, high) = (log10(f64::from(none.min(most))), log10(f64::from(none.max(most))));
        let start = |level: usize| {
            let share = (level as f64 - 0.5) / (COLOURS - 1) as f64;
            pow(10.0, low + (high - low) * share) as f32
        };
        let starts: Vec<f32> = (1..COLOURS).map(start).chain([f32::NAN]).collect();
        let reached = |value: f32| starts.partition_point(|start| *start <= value) as u8;
        let table = (0..1u32 << 15).map(|half| reached(f32::from_bits(half << 16))).collect();
        Self { table, starts, falls: most < none }
    }

    fn level(&self, value: f32) -> usize {
        if value.is_nan() {
            return NO_VALUE;
        }
        let level = if value > 0.0 {
            let mut level = usize::from(self.table[(value.to_bits() >> 16) as usize]);
            while value >= self.starts[level] {
                level += 1;
            }
            level
        } else {
            0
        };
        if self.falls { COLOURS - 1 - level } else { level }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOG: HeatScale = HeatScale { none: 1e-6, most: 1.0, log: true };
    const FALLING: HeatScale = HeatScale { none: 1.0, most: 0.0, log: false };

    fn colour(scale: HeatScale, value: f32) -> [u8; 3] {
        let mut pixel = [0; 3];
        HeatColours::new(scale).fill(&[value], 1, &mut pixel);
        pixel
    }

    #[test]
    fn worse_is_brighter() {
        let luma =
            |[r, g, b]: [u8; 3]| 2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b);
        let shares: Vec<f32> = (0..=50).map(|i| i as f32 / 50.0).collect();
        for pair in shares.windows(2) {
            let lumas = |value: &dyn Fn(f32) -> f32, scale| {
                [pair[0], pair[1]].map(|share| luma(colour(scale, value(share))))
            };
            let falling = lumas(&|share| 1.0 - share, FALLING);
            let log = lumas(&|share| 10f32.powf(6.0 * share - 6.0), LOG);
            assert!(falling[0] < falling[1] && log[0] < log[1], "{pair:?}");
        }
    }

    #[test]
    fn ends_and_missing_values() {
        let palette = map_palette();
        for (scale, dark, bright) in [
            (FALLING, [1.0, 1.5, f32::INFINITY], [0.0, -0.2, f32::NEG_INFINITY]),
            (LOG, [1e-6, 0.0, -1.0], [1.0, 3.0, f32::INFINITY]),
            (HeatScale { none: 1.0, most: 1e-6, ..LOG }, [1.0, 2.0, f32::MAX], [1e-6, 1e-40, 0.0]),
        ] {
            assert!(dark.iter().all(|value| colour(scale, *value) == palette[0]), "{scale:?}");
            assert!(bright.iter().all(|value| colour(scale, *value) == palette[255]), "{scale:?}");
            assert_eq!(colour(scale, f32::NAN), MAP_NO_VALUE);
            assert_eq!(scale.share(f32::NAN), None);
        }
    }

    /// The looked-up colour is that of the position, except for values between two colours.
    #[test]
    fn colours_are_those_of_the_positions() {
        let palette = map_palette();
        for scale in [FALLING, LOG, HeatScale { none: 0.3, most: 0.31, log: true }] {
            let colours = HeatColours::new(scale);
            for i in 0..=100_000u32 {
                let value = i as f32 / 100_000.0;
                let at = 255.0 * scale.share(value).unwrap();
                if (at.fract() - 0.5).abs() > 1e-3 {
                    let mut pixel = [0; 3];
                    colours.fill(&[value], 1, &mut pixel);
                    assert_eq!(pixel, palette[at.round() as usize], "{value} of {scale:?}");
                }
            }
        }
    }

    #[test]
    fn blocks_are_repeated_and_the_rest_has_no_value() {
        let mut row = [0; 15];
        HeatColours::new(FALLING).fill(&[1.0, 0.0], 2, &mut row);
        let [dark, bright] = [0, 255].map(|level| map_palette()[level]);
        assert_eq!(row.as_chunks::<3>().0, [dark, dark, bright, bright, MAP_NO_VALUE]);
    }
}
