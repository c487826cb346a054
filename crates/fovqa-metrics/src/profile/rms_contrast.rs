//! RMS contrast (Peli 1990; by eccentricity as in Patney et al. 2016, Fig. 4).
//!
//! Per band it is sqrt(mean (Y - mean Y)²). Y is the luma of the display-encoded signal or, with
//! the signal `luminance`, linear luminance after exposure and before the tone map. It has the unit
//! of Y or, when normalised by the mean, no unit. Values are 0 and above. Neither higher nor lower
//! is better; the test's value is compared with the reference's.

use fovqa_frame::LumaKind;
use multiversion::multiversion;

use fovqa_params::{ParamInfo, ParamValue, ParamValues};

use crate::info::MetricInfo;
use crate::metric_params::MetricParams;

/// The metric's description.
pub(crate) const INFO: MetricInfo = MetricInfo {
    key: "rms_contrast",
    label: "RMS contrast",
    about: "standard deviation of luma in each band, of reference and test, and their ratio",
    source: "Peli 1990; Patney et al. 2016, Fig. 4",
    params: &[
        ParamInfo {
            name: "signal",
            default: "\"luma\"",
            values: ParamValues::Word(&["luma", "luminance"]),
            about: "signal: encoded luma, or linear luminance after exposure",
        },
        ParamInfo {
            name: "normalise",
            default: "\"none\"",
            values: ParamValues::Word(&["none", "mean"]),
            about: "division by the band's mean, or none",
        },
    ],
    ..MetricInfo::PROFILE
};

/// Parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Params {
    /// The signal whose contrast is computed.
    pub signal: LumaKind,
    /// The divisor of the contrast.
    pub normalise: Normalise,
}

/// The divisor of the contrast.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Normalise {
    /// No divisor.
    #[default]
    None,
    /// The mean of the band.
    Mean,
}

impl MetricParams for Params {
    fn set(&mut self, name: &str, value: &ParamValue) -> Option<()> {
        match (name, value.text()?) {
            ("signal", "luma") => self.signal = LumaKind::Luma,
            ("signal", "luminance") => self.signal = LumaKind::Luminance,
            ("normalise", "none") => self.normalise = Normalise::None,
            ("normalise", "mean") => self.normalise = Normalise::Mean,
            _ => return None,
        }
        Some(())
    }
}

/// Count, mean and sum of squared deviations of a set of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Moments {
    pixels: u64,
    mean: f64,
    squared: f64,
}

impl Moments {
    /// The moments of a stretch of a row. Deviations are computed relative to its first value, so
    /// that equal values have a deviation of exactly 0. A ratio with a reference of 0 must be
    /// recognised as such.
    pub(crate) fn of(values: &[f64]) -> Self {
        let Some(&first) = values.first() else { return Self::default() };
        let mean = first + sum_from(values, first) / values.len() as f64;
        Self { pixels: values.len() as u64, mean, squared: squares_from(values, mean) }
    }

    /// Combines two sets of pixels (Chan, Golub, LeVeque 1983, Eq. 2.1).
    pub(crate) fn merge(&mut self, other: &Self) {
        let pixels = self.pixels + other.pixels;
        if other.pixels == 0 {
            return;
        }
        let share = other.pixels as f64 / pixels as f64;
        let apart = other.mean - self.mean;
        self.squared += other.squared + apart * apart * self.pixels as f64 * share;
        self.mean = if self.pixels == 0 { other.mean } else { self.mean + apart * share };
        self.pixels = pixels;
    }

    /// The contrast; `None` if there is no pixel, or the divisor is a mean of 0.
    pub(crate) fn contrast(&self, normalise: Normalise) -> Option<f64> {
        let contrast = (self.pixels > 0).then(|| (self.squared / self.pixels as f64).sqrt())?;
        match normalise {
            Normalise::None => Some(contrast),
            Normalise::Mean => (self.mean != 0.0).then(|| contrast / self.mean),
        }
    }
}

/// The number of accumulators of a sum: two vectors of the widest kind, or four of a common one.
const LANES: usize = 16;

#[inline(always)]
fn lanes(values: &[f64], term: impl Fn(f64) -> f64) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, &value) in lanes.iter_mut().zip(chunk) {
            *lane += term(value);
        }
    }
    for (lane, &value) in lanes.iter_mut().zip(rest) {
        *lane += term(value);
    }
    lanes.iter().sum()
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn sum_from(values: &[f64], zero: f64) -> f64 {
    lanes(values, |value| value - zero)
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512bw+avx512dq", "x86_64+avx2"))]
fn squares_from(values: &[f64], zero: f64) -> f64 {
    lanes(values, |value| (value - zero) * (value - zero))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what must be exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn equal_values_have_no_contrast_at_all() {
        let mut moments = Moments::default();
        for length in [1, 7, 64, 100] {
            moments.merge(&Moments::of(&vec![0.1 + 0.2; length]));
        }
        assert_eq!(moments.contrast(Normalise::None), Some(0.0));
        assert_eq!(Moments::default().contrast(Normalise::None), None);
        assert_eq!(Moments::of(&[0.0; 3]).contrast(Normalise::Mean), None);
    }

    #[test]
    fn parts_together_are_the_whole() {
        let values: Vec<f64> = (0..1000).map(|i| 1e4 + f64::from(i * 7919 % 1000) * 1e-4).collect();
        let mut moments = Moments::default();
        for part in values.chunks(77) {
            moments.merge(&Moments::of(part));
        }
        // 1000 values at equal steps of 1e-4: a variance of (1000² - 1) / 12 steps².
        let contrast = ((1e6 - 1.0) / 12.0f64).sqrt() * 1e-4;
        let found = moments.contrast(Normalise::None).unwrap();
        assert!((found - contrast).abs() < 1e-9 * contrast, "{found} for {contrast}");
        let mean = 1e4 + 499.5e-4;
        let found = moments.contrast(Normalise::Mean).unwrap();
        assert!((found - contrast / mean).abs() < 1e-9 * found);
    }
}
