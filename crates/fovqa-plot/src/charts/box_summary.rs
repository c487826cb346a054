//! The box plot statistics of a distribution, after Tukey (Exploratory Data Analysis, 1977).

/// Whiskers end at the farthest value within this many interquartile ranges of the box.
const REACH: f64 = 1.5;

/// Quartiles, whiskers and outliers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BoxSummary {
    pub(crate) median: f64,
    /// Lower and upper quartile.
    pub(crate) quartiles: [f64; 2],
    /// Ends of the lower and upper whisker.
    pub(crate) whiskers: [f64; 2],
    /// Values beyond the whiskers, in rising order.
    pub(crate) outliers: Vec<f64>,
}

impl BoxSummary {
    /// The summary of finite values; `None` for an empty list.
    pub(crate) fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let [low, median, high] = [0.25, 0.5, 0.75].map(|p| quantile(&sorted, p));
        let (low, median, high) = (low?, median?, high?);
        let reach = REACH * (high - low);
        let within = |v: &&f64| (low - reach..=high + reach).contains(*v);
        let inside = || sorted.iter().filter(within).copied();
        // An interpolated quartile may lie beyond the last value that the whisker may reach.
        let whiskers = [inside().fold(low, f64::min), inside().fold(high, f64::max)];
        let outliers = sorted.iter().filter(|v| !within(v)).copied().collect();
        Some(Self { median, quartiles: [low, high], whiskers, outliers })
    }
}

/// The value below which a share of sorted values lies, with linear interpolation between the two
/// nearest values (NumPy's default; type 7 of Hyndman and Fan 1996); `None` without values.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share * last as f64;
    let below = (place.floor() as usize).min(last);
    let above = (below + 1).min(last);
    let part = place - below as f64;
    Some(sorted[below] + (sorted[above] - sorted[below]) * part)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn quartiles_as_numpy_has_them() {
        // numpy.percentile([1, 2, 4, 7, 11, 16], [25, 50, 75]) is [2.5, 5.5, 10].
        let summary = BoxSummary::of(&[16.0, 1.0, 7.0, 2.0, 11.0, 4.0]).unwrap();
        assert_eq!((summary.quartiles, summary.median), ([2.5, 10.0], 5.5));
        assert_eq!(summary.whiskers, [1.0, 16.0]);
        // numpy.percentile(range(10), [25, 50, 75]) is [2.25, 4.5, 6.75].
        let ten: Vec<f64> = (0..10).map(f64::from).collect();
        let summary = BoxSummary::of(&ten).unwrap();
        assert_eq!((summary.quartiles, summary.median), ([2.25, 6.75], 4.5));
        assert_eq!(quantile(&[3.0], 0.25), Some(3.0));
        assert!(BoxSummary::of(&[]).is_none());
    }

    #[test]
    fn whiskers_stop_before_outliers() {
        // The quartiles are 2.25 and 6.75, so whiskers may extend from -4.5 to 13.5.
        let mut values: Vec<f64> = (1..9).map(f64::from).collect();
        values.extend([-4.6, 13.4]);
        let summary = BoxSummary::of(&values).unwrap();
        assert_eq!(summary.quartiles, [2.25, 6.75]);
        assert_eq!(summary.outliers, [-4.6]);
        assert_eq!(summary.whiskers, [1.0, 13.4]);
    }

    #[test]
    fn equal_values_are_a_line() {
        let summary = BoxSummary::of(&[5.0; 12]).unwrap();
        assert_eq!((summary.quartiles, summary.whiskers), ([5.0; 2], [5.0; 2]));
        assert!(summary.outliers.is_empty());
    }
}
