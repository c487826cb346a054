//! The light that a display shows: its curve over encoded values, and absolute light within its range.

use crate::codes::{CODES_16, within_unit};

/// Absolute light as a display shows it: `clip(value cd_m2_per_unit, floor, peak) + black`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShownLight {
    /// cd/m² of a sample of 1.
    pub cd_m2_per_unit: f64,
    /// Darkest light, before black is added, cd/m².
    pub floor_cd_m2: f64,
    /// Brightest light, before black is added, cd/m².
    pub peak_cd_m2: f64,
    /// What the display adds to everything, cd/m².
    pub black_cd_m2: f64,
}

impl ShownLight {
    /// The light of a sample, cd/m².
    #[inline]
    pub(crate) fn shown(self, value: f32) -> f32 {
        // `max` first: of NaN and a number it is the number.
        let light = (value * self.cd_m2_per_unit as f32).max(self.floor_cd_m2 as f32);
        light.min(self.peak_cd_m2 as f32) + self.black_cd_m2 as f32
    }
}

/// A display's curve over encoded values, tabulated where 16-bit codes lie; straight between them.
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
