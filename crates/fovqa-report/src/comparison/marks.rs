//! Marks for the best and the second best of several methods.

use fovqa_metrics::Better;

use super::measure::Measure;

/// How a value is marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Mark {
    #[default]
    None,
    Best,
    Second,
}

/// Minimum number of values of which a second best one is marked. Of two, it would be the worse.
const FEWEST_FOR_SECOND: usize = 3;

/// The marks of the values of all methods. Values that print the same are equally good. A single
/// value is not marked. If several values are best, none is second best.
pub(super) fn marks(measure: &Measure, values: &[Option<f64>]) -> Vec<Mark> {
    let found = || values.iter().copied().flatten();
    let best_of = |values: &mut dyn Iterator<Item = f64>| match measure.better {
        Better::Higher => values.reduce(f64::max),
        Better::Lower => values.reduce(f64::min),
        Better::Neither => None,
    };
    let count = found().count();
    let printed = |value: f64| measure.shown(Some(value));
    let best = best_of(&mut found()).filter(|_| count > 1).map(printed);
    let is_best = |value: f64| best.as_ref() == Some(&printed(value));
    let alone = found().filter(|value| is_best(*value)).count() == 1;
    let second = best_of(&mut found().filter(|value| !is_best(*value)))
        .filter(|_| alone && count >= FEWEST_FOR_SECOND)
        .map(printed);
    let mark = |value: &Option<f64>| match value {
        Some(value) if is_best(*value) => Mark::Best,
        Some(value) if second.as_ref() == Some(&printed(*value)) => Mark::Second,
        _ => Mark::None,
    };
    values.iter().map(mark).collect()
}

#[cfg(test)]
mod tests {
    use fovqa_metrics::Metric;

    use super::Mark::{Best, None as No, Second};
    use super::*;

    fn of(metric: Metric, values: &[f64]) -> Vec<Mark> {
        let values: Vec<Option<f64>> =
            values.iter().map(|value| Some(*value).filter(|value| !value.is_nan())).collect();
        marks(&Measure::of(metric), &values)
    }

    #[test]
    fn the_best_and_the_second_best_are_marked() {
        assert_eq!(of(Metric::Psnr, &[24.0, 26.0, 25.0]), [No, Best, Second]);
        assert_eq!(of(Metric::Mse, &[24.0, 26.0, 25.0]), [Best, No, Second]);
        assert_eq!(of(Metric::Psnr, &[f64::INFINITY, 26.0, 25.0]), [Best, Second, No]);
        assert_eq!(of(Metric::RmsContrast, &[24.0, 26.0, 25.0]), [No; 3], "neither is better");
    }

    #[test]
    fn of_two_or_of_equals_there_is_no_second_best() {
        assert_eq!(of(Metric::Psnr, &[24.0, 26.0]), [No, Best]);
        assert_eq!(of(Metric::Psnr, &[24.0]), [No]);
        assert_eq!(of(Metric::Psnr, &[24.0, f64::NAN, 26.0]), [No, No, Best], "one is missing");
        // Printed with two decimals, the first two are the same.
        assert_eq!(of(Metric::Psnr, &[24.001, 24.002, 23.0]), [Best, Best, No]);
        assert_eq!(of(Metric::Psnr, &[24.0, 23.001, 23.002]), [Best, Second, Second]);
    }
}
