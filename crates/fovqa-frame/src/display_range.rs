//! The luminance that a display shows: its curve over encoded values, and its range for absolute
//! luminance.

use crate::codes::{CODES_16, within_unit};

/// How a display shows absolute luminance: `clip(value cd_m2_per_unit, floor, peak) + black`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayRange {
    /// Luminance of a sample of 1, in cd/m².
    pub cd_m2_per_unit: f64,
    /// Lowest luminance before black is added, in cd/m².
    pub floor_cd_m2: f64,
    /// Highest luminance before black is added, in cd/m².
    pub peak_cd_m2: f64,
    /// The black level that the display adds to everything, in cd/m².
    pub black_cd_m2: f64,
}

impl DisplayRange {
    /// The displayed luminance of a sample, in cd/m².
    #[inline]
    pub(crate) fn displayed(self, value: f32) -> f32 {
        // `max` comes first: the maximum of NaN and a number is the number.
        let luminance = (value * self.cd_m2_per_unit as f32).max(self.floor_cd_m2 as f32);
        luminance.min(self.peak_cd_m2 as f32) + self.black_cd_m2 as f32
    }
}

/// A display's curve over encoded values: a table over 16-bit codes with linear interpolation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Curve<'a>(pub(crate) &'a [f32; CODES_16]);

impl Curve<'_> {
    #[inline]
    pub(crate) fn at(self, encoded: f32) -> f32 {
        const LAST: usize = CODES_16 - 2;
        let at = within_unit(encoded) * (CODES_16 - 1) as f32;
        let below = (at as usize).min(LAST);
        let (from, to) = (self.0[below], self.0[below + 1]);
        from + (to - from) * (at - below as f32)
    }
}
