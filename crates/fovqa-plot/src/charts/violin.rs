//! The shape of a violin: a smooth estimate of the density of values.

use libm::{exp, pow};

use crate::charts::box_summary::BoxSummary;

/// Number of steps from the smallest to the largest value.
const STEPS: usize = 64;

/// The shape: values in rising order, each with its density as a share of the largest density.
pub(crate) type Shape = Vec<(f64, f64)>;

/// The density of finite values from the smallest to the largest one, estimated with normal
/// kernels of the width of Silverman's rule (Density Estimation for Statistics and Data Analysis,
/// 1986, Eq. 3.31); `None` if all values are equal.
pub(crate) fn shape(values: &[f64]) -> Option<Shape> {
    let summary = BoxSummary::of(values)?;
    let count = values.len() as f64;
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)));
    let mean = values.iter().map(|v| v / count).sum::<f64>();
    let variance =
        values.iter().map(|v| (v - mean) * (v - mean) / (count - 1.0).max(1.0)).sum::<f64>();
    let range = (summary.quartiles[1] - summary.quartiles[0]) / 1.34;
    let spread = if range > 0.0 { variance.sqrt().min(range) } else { variance.sqrt() };
    let width = 0.9 * spread * pow(count, -0.2);
    if !(width > 0.0 && width.is_finite() && high > low) {
        return None;
    }
    let density = |at: f64| -> f64 {
        values
            .iter()
            .map(|v| {
                let z = (at - v) / width;
                exp(-0.5 * z * z)
            })
            .sum()
    };
    let places = (0..=STEPS).map(|i| low + (high - low) * i as f64 / STEPS as f64);
    let points: Shape = places.map(|at| (at, density(at))).collect();
    let most = points.iter().map(|point| point.1).fold(0.0, f64::max);
    (most > 0.0).then(|| points.into_iter().map(|(at, density)| (at, density / most)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shape_has_the_width_of_silvermans_rule() {
        // 0.9 min(sd, iqr / 1.34) n^-0.2 of 0, 1, ..., 31: sd 9.3808, iqr 15.5 / 1.34 = 11.5672.
        let values: Vec<f64> = (0..32).map(f64::from).collect();
        let shape = shape(&values).unwrap();
        let width = 0.9 * 9.380_831_519_646_86 / 2.0;
        let density =
            |at: f64| values.iter().map(|v| exp(-0.5 * ((at - v) / width).powi(2))).sum::<f64>();
        assert_eq!((shape.len(), shape[0].0, shape[64].0), (65, 0.0, 31.0));
        let want = density(0.0) / density(15.5);
        assert!((shape[0].1 - want).abs() < 1e-12 && (shape[32].1 - 1.0).abs() < 1e-12, "{want}");
    }

    #[test]
    fn equal_values_have_no_shape() {
        assert_eq!(shape(&[3.0; 20]), None);
        assert_eq!(shape(&[]), None);
        assert_eq!(shape(&[1.0]), None);
    }
}
