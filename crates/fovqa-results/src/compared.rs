//! Measures that are computed for the reference and for the test in the same way, such as profiles
//! and temporal differences: the value of each image and their ratio.

use fovqa_metrics::{FrameRows, Image, Key, Row, Statistic};

use crate::report::FrameResult;

/// A pair of values: one for the reference and one for the test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sides<T> {
    /// Value of the reference.
    pub reference: T,
    /// Value of the test.
    pub test: T,
}

impl<T> Sides<T> {
    /// Applies `of` to both values.
    pub fn map<'a, U>(&'a self, of: impl Fn(&'a T) -> U) -> Sides<U> {
        Sides { reference: of(&self.reference), test: of(&self.test) }
    }
}

impl Sides<Option<f64>> {
    /// test / reference of a statistic; `None` if either value is missing, or if the reference is 0 or
    /// below the statistic's floor. The ratio is never infinite.
    pub fn ratio(&self, statistic: &Statistic) -> Option<f64> {
        let has_ratio = |value: &f64| *value != 0.0 && *value >= statistic.floor;
        let reference = self.reference.filter(has_ratio)?;
        Some(self.test? / reference)
    }

    /// Why there is no ratio; `None` if there is one.
    pub fn reason(&self, statistic: &Statistic) -> Option<&'static str> {
        match (self.reference, self.test) {
            _ if self.ratio(statistic).is_some() => None,
            (Some(reference), Some(_)) if reference != 0.0 => Some("the reference is next to 0"),
            (Some(_), Some(_)) => Some("the reference is 0"),
            _ => Some("no value"),
        }
    }
}

impl FrameResult {
    /// The measures of each image that are compared, in the order of results. The key is that of
    /// the ratio.
    pub fn compared(&self) -> impl Iterator<Item = (Key, Sides<Option<f64>>)> {
        compared_in(&self.rows)
    }
}

/// The measures of each image among the values of a frame, as [`FrameResult::compared`] returns them.
pub(crate) fn compared_in(
    rows: &FrameRows,
) -> impl Iterator<Item = (Key, Sides<Option<f64>>)> + use<'_> {
    let of_picture = |key: &Key| key.image != Image::Pair && key.statistic().has_ratio;
    let mut rows = rows.of_keys(of_picture).peekable();
    std::iter::from_fn(move || {
        let of_reference = |row: &Row| row.key.image == Image::Reference;
        let Row { key, value: reference, .. } = rows.by_ref().find(of_reference)?;
        // The row of the test follows that of the reference.
        let test = rows.peek().filter(|row| row.key == key.of_image(Image::Test));
        let test = test.and_then(|row| row.value);
        Some((key.of_image(Image::Ratio), Sides { reference, test }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_to_nothing_is_none_and_says_why() {
        let sides = |reference, test| Sides { reference, test };
        let statistic = Key::of(fovqa_metrics::Metric::Atd).statistic();
        assert_eq!(sides(Some(0.5), Some(0.25)).ratio(statistic), Some(0.5));
        assert_eq!(sides(Some(0.5), Some(0.0)).ratio(statistic), Some(0.0));
        assert_eq!(sides(Some(0.5), Some(0.25)).reason(statistic), None);
        for test in [0.0, 1.0] {
            let sides = sides(Some(0.0), Some(test));
            assert_eq!(
                (sides.ratio(statistic), sides.reason(statistic)),
                (None, Some("the reference is 0"))
            );
        }
        assert_eq!(sides(None, Some(1.0)).reason(statistic), Some("no value"));
        let power = Key::of(fovqa_metrics::Metric::Spectrum).statistic();
        let next_to_nothing = sides(Some(1e-13), Some(1.0));
        assert_eq!(next_to_nothing.ratio(power), None);
        assert_eq!(next_to_nothing.reason(power), Some("the reference is next to 0"));
        assert_eq!(sides(Some(0.5), Some(1.0)).ratio(power), Some(2.0));
    }
}
