//! Tone maps: from linear light without an upper limit to `[0, 1]`, each channel on its own.

use fovqa_params::words;

use crate::codes::within_unit;

words! {
    /// How linear input is brought into the range of a display.
    #[derive(Default)]
    pub enum ToneMap {
        /// `min(max(x, 0), 1)`.
        #[default]
        Clamp "clamp" "min(max(x, 0), 1)";
        /// `max(x, 0) / (1 + max(x, 0))` (Reinhard et al. 2002, Eq. 3).
        Reinhard "reinhard" "x / (1 + x)";
        /// Narkowicz 2015, a fit to the ACES reference rendering transform.
        Aces "aces" "Narkowicz 2015";
    }
}

impl ToneMap {
    /// Maps one linear value. Infinity becomes 1, so that an extremely bright pixel is only white.
    #[inline]
    pub fn map(self, linear: f32) -> f32 {
        let x = linear.max(0.0);
        match self {
            ToneMap::Clamp => x.min(1.0),
            // Beyond this limit x / (1 + x) is 1 in f32 anyway. Without it, infinity would become
            // NaN.
            ToneMap::Reinhard => {
                let x = x.min(1e9);
                x / (1.0 + x)
            }
            ToneMap::Aces => {
                let x = x.min(1e9);
                ((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0)
            }
        }
    }
}

impl ToneMap {
    /// The linear value that [`ToneMap::map`] maps to a value in `[0, 1]`; `None` for `aces`, whose
    /// inverse is not given. Values beyond 1 count as 1, and 1 of `reinhard`, which no finite value
    /// reaches, is 1e9.
    #[inline]
    pub fn inverse(self, mapped: f32) -> Option<f32> {
        let y = within_unit(mapped);
        match self {
            ToneMap::Clamp => Some(y),
            ToneMap::Reinhard => Some((y / (1.0 - y)).min(1e9)),
            ToneMap::Aces => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_leads_back() {
        for v in [0.0f32, 1e-4, 0.18, 0.5, 1.0] {
            assert_eq!(ToneMap::Clamp.inverse(v), Some(v));
            let back = ToneMap::Reinhard.inverse(ToneMap::Reinhard.map(v)).unwrap();
            assert!((back - v).abs() < 1e-6, "{v}: {back}");
        }
        assert_eq!(ToneMap::Reinhard.inverse(1.0), Some(1e9));
        assert_eq!(ToneMap::Aces.inverse(0.5), None);
    }

    #[test]
    fn known_values_and_range() {
        assert!((ToneMap::Reinhard.map(1.0) - 0.5).abs() < 1e-7);
        assert!((ToneMap::Aces.map(1.0) - 0.803_797_5).abs() < 1e-6);
        for map in [ToneMap::Clamp, ToneMap::Reinhard, ToneMap::Aces] {
            let mut last = 0.0;
            for v in [-1.0, 0.0, 1e-4, 0.18, 1.0, 10.0, 60_000.0, f32::MAX, f32::INFINITY] {
                let mapped = map.map(v);
                assert!((last..=1.0).contains(&mapped), "{map:?} of {v}: {mapped}");
                last = mapped;
            }
        }
    }
}
