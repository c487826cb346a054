//! The values of single frames, for the whole frame and for eccentricity bands.

use std::collections::BTreeMap;

use fovqa_metrics::{Better, Metric};
use fovqa_plan::Quantity;

/// The values of a quantity in the frames of a comparison.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Series {
    /// The value of each frame that has one.
    pub(crate) frames: BTreeMap<i64, f64>,
    /// The values in each scored band, whatever band the quantity is of.
    pub(crate) bands: Vec<([f64; 2], BTreeMap<i64, f64>)>,
    /// Significant digits of the values of bands; `None` if they are not rounded.
    pub(crate) digits: Option<usize>,
}

impl Series {
    /// The values in a band.
    pub(super) fn band(&self, edges: [f64; 2]) -> Option<&BTreeMap<i64, f64>> {
        let is_same = |other: &[f64; 2]| other.map(f64::to_bits) == edges.map(f64::to_bits);
        self.bands.iter().find(|(edges, _)| is_same(edges)).map(|(_, values)| values)
    }
}

/// How much is lost at a value: larger is worse. The losses of decibels are squared errors, so that a
/// change of what was almost identical is not a large loss.
pub(super) fn amount(quantity: &Quantity, value: f64) -> f64 {
    let is_decibel = Metric::find(&quantity.metric).is_some_and(Metric::is_decibel);
    match quantity.better() {
        Better::Higher if is_decibel => libm::pow(10.0, -value / 10.0),
        Better::Higher => -value,
        Better::Lower | Better::Neither => value,
    }
}

/// How much more is lost at a value than at an earlier one; 0 if that cannot be said.
pub(super) fn growth(quantity: &Quantity, value: f64, before: f64) -> f64 {
    let growth = amount(quantity, value) - amount(quantity, before);
    match quantity.better() {
        _ if growth.is_nan() => 0.0,
        Better::Neither => growth.abs(),
        Better::Higher | Better::Lower => growth,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fovqa_plan::Aggregate;

    #[test]
    fn a_worse_value_is_a_larger_loss() {
        let growth =
            |metric, value, before| growth(&Quantity::of(metric, Aggregate::Mean), value, before);
        for (metric, worse, better) in
            [(Metric::Psnr, 30.0, 40.0), (Metric::Ssim, 0.8, 0.9), (Metric::Mse, 0.02, 0.01)]
        {
            assert!(growth(metric, worse, better) > 0.0, "{metric:?}");
            assert!(growth(metric, better, worse) < 0.0, "{metric:?}");
        }
        assert!(growth(Metric::Mse, f64::NAN, 0.01).abs() < 1e-300);
    }
}
