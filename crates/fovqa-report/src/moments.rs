//! Half the length of error bars: how far a mean may be from that of further frames or scenes.

use fovqa_plan::ErrorBars;

/// Half the length of the error bar of a mean; `None` with fewer than two values.
pub(crate) fn half_length(values: &[f64], kind: ErrorBars) -> Option<f64> {
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    Moments::of(&finite).half_length(kind)
}

/// The sums that a spread follows from, added value by value (Welford 1962).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Moments {
    count: f64,
    mean: f64,
    /// Sum of the squared distances from the mean.
    squares: f64,
}

impl Moments {
    pub(crate) fn of(values: &[f64]) -> Self {
        let mut moments = Self::default();
        for value in values {
            moments.add(*value);
        }
        moments
    }

    /// Adds a finite value.
    pub(crate) fn add(&mut self, value: f64) {
        self.count += 1.0;
        let off = value - self.mean;
        self.mean += off / self.count;
        self.squares += off * (value - self.mean);
    }

    /// Half the length of the error bar of the mean; `None` with fewer than two values.
    pub(crate) fn half_length(self, kind: ErrorBars) -> Option<f64> {
        if self.count < 2.0 {
            return None;
        }
        let deviation = (self.squares / (self.count - 1.0)).sqrt();
        let standard_error = deviation / self.count.sqrt();
        Some(match kind {
            ErrorBars::Deviation => deviation,
            ErrorBars::StandardError => standard_error,
            ErrorBars::Confidence => t_975(self.count - 1.0) * standard_error,
        })
    }
}

/// The 97.5 % quantile of Student's t distribution for up to 20 degrees of freedom (tables of any
/// textbook).
const SMALL_T: [f64; 20] = [
    12.706_204_736,
    4.302_652_730,
    3.182_446_305,
    2.776_445_105,
    2.570_581_836,
    2.446_911_851,
    2.364_624_252,
    2.306_004_135,
    2.262_157_163,
    2.228_138_852,
    2.200_985_160,
    2.178_812_830,
    2.160_368_656,
    2.144_786_688,
    2.131_449_546,
    2.119_905_299,
    2.109_815_578,
    2.100_922_040,
    2.093_024_054,
    2.085_963_447,
];

/// The 97.5 % quantile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// The 97.5 % quantile of Student's t distribution. Beyond the table it is the expansion by Fisher
/// and Cornish (Abramowitz and Stegun 26.7.5), which is right to six digits there.
fn t_975(degrees: f64) -> f64 {
    if let Some(known) = SMALL_T.get(degrees as usize - 1) {
        return *known;
    }
    let (z2, z) = (Z * Z, Z);
    let terms = [
        z * (z2 + 1.0) / 4.0,
        z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0,
        z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0,
        z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0,
    ];
    z + terms.iter().rev().fold(0.0, |sum, term| (sum + term) / degrees)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_those_of_the_textbook() {
        // Standard deviation 2, of four values around 5.
        let values = [3.0, 5.0, 7.0, 5.0 - 4e-17];
        let sd = (8.0_f64 / 3.0).sqrt();
        let near = |kind, want: f64| {
            let found = half_length(&values, kind).unwrap();
            assert!((found - want).abs() < 1e-9, "{kind:?}: {found} {want}");
        };
        near(ErrorBars::Deviation, sd);
        near(ErrorBars::StandardError, sd / 2.0);
        near(ErrorBars::Confidence, sd / 2.0 * 3.182_446_305);
        assert_eq!(half_length(&[1.0, f64::INFINITY], ErrorBars::Deviation), None);
    }

    #[test]
    fn quantiles_of_t_are_right() {
        // SciPy's stats.t.ppf(0.975, n).
        for (degrees, want) in [
            (1.0, 12.706_204_736_2),
            (10.0, 2.228_138_852_0),
            (11.0, 2.200_985_160_1),
            (21.0, 2.079_613_844_7),
            (29.0, 2.045_229_642_1),
            (100.0, 1.983_971_518_5),
            (1e6, 1.959_966_356_8),
        ] {
            let found = t_975(degrees);
            assert!((found / want - 1.0).abs() < 2e-6, "{degrees}: {found} {want}");
        }
    }
}
