//! Measures of reference and test alike, profiles and differences over time: the value of each picture,
//! and their ratio.

use fovqa_metrics::profile::Orientation;
use fovqa_metrics::{HaarStatistics, Metric, Profile};

use crate::report::FrameResult;

/// Something of the reference and of the test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sides<T> {
    /// The reference's.
    pub reference: T,
    /// The test's.
    pub test: T,
}

impl<T> Sides<T> {
    /// The same thing of each.
    pub fn map<'a, U>(&'a self, of: impl Fn(&'a T) -> U) -> Sides<U> {
        Sides { reference: of(&self.reference), test: of(&self.test) }
    }
}

impl Sides<Option<f64>> {
    /// test / reference; `None` where either is missing, or the reference is 0: never an infinity.
    pub fn ratio(&self) -> Option<f64> {
        let reference = self.reference.filter(|value| *value != 0.0)?;
        Some(self.test? / reference)
    }

    /// Why there is no ratio, where there is none.
    pub fn reason(&self) -> Option<&'static str> {
        match (self.reference, self.test) {
            _ if self.ratio().is_some() => None,
            (Some(_), Some(_)) => Some("the reference is 0"),
            _ => Some("no value"),
        }
    }
}

/// A statistic of wavelet coefficients: of all, or of one orientation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct HaarStatistic {
    /// 0: all; else one more than the index in [`Orientation::ALL`].
    of: usize,
    /// Index in [`HaarStatistics::NAMES`].
    statistic: usize,
}

impl HaarStatistic {
    /// The orientation; `None`: all together.
    pub fn orientation(self) -> Option<Orientation> {
        self.of.checked_sub(1).map(|index| Orientation::ALL[index])
    }

    /// Its name without that of the orientation.
    pub fn statistic(self) -> &'static str {
        HaarStatistics::NAMES[self.statistic]
    }

    /// Its name in tables: `mean_abs`, `energy_lh`.
    pub fn name(self) -> String {
        match self.orientation() {
            None => self.statistic().to_owned(),
            Some(orientation) => format!("{}_{}", self.statistic(), orientation.name()),
        }
    }

    /// Whether it is a maximum, of which the largest counts over frames.
    pub fn is_maximum(self) -> bool {
        self.statistic() == "max_abs"
    }
}

/// What a value is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Measure {
    /// The metric.
    pub metric: Metric,
    /// Level of the wavelet, from 1 on.
    pub level: Option<usize>,
    /// Index of the band; `None`: the whole frame.
    pub band: Option<usize>,
    /// Of the wavelet, which statistic.
    pub statistic: Option<HaarStatistic>,
}

/// A measure with its two values.
pub type Compared = (Measure, Sides<Option<f64>>);

impl Measure {
    fn of(metric: Metric, band: Option<usize>) -> Self {
        Self { metric, level: None, band, statistic: None }
    }
}

impl FrameResult {
    /// What is compared of the whole frame.
    pub fn compared(&self) -> Option<Compared> {
        let atd = self.atd.as_ref()?;
        Some((Measure::of(Metric::Atd, None), atd.map(|side| side.whole.mean)))
    }

    /// What is compared of a band, without the wavelet.
    pub fn compared_in(&self, band: usize) -> Vec<Compared> {
        let contrast = self.profiles.as_ref().and_then(|profiles| {
            profiles.reference.rms_contrast.as_ref()?;
            let of = |profile: &Profile| *profile.rms_contrast.as_ref()?.get(band)?;
            Some((Measure::of(Metric::RmsContrast, Some(band)), profiles.map(of)))
        });
        let difference = self.atd.as_ref().map(|atd| {
            let of = atd.map(|side| side.bands.get(band).and_then(|band| band.mean));
            (Measure::of(Metric::Atd, Some(band)), of)
        });
        contrast.into_iter().chain(difference).collect()
    }

    /// How many coefficients a level of the wavelet has in a band.
    pub fn coefficients(&self, level: usize, band: usize) -> u64 {
        let levels = self.profiles.as_ref().and_then(|p| p.reference.haar.as_ref());
        let found = levels.and_then(|levels| levels.get(level - 1)?.get(band));
        found.map_or(0, |band| band.coefficients)
    }

    /// Levels of the wavelet; 0 without.
    pub fn haar_levels(&self) -> usize {
        let levels = self.profiles.as_ref().and_then(|p| p.reference.haar.as_ref());
        levels.map_or(0, Vec::len)
    }

    /// What is compared of a level of the wavelet in a band.
    pub fn compared_haar(&self, level: usize, band: usize) -> Vec<Compared> {
        let Some(profiles) = &self.profiles else { return Vec::new() };
        let found = profiles.map(|profile| profile.haar.as_ref()?.get(level - 1)?.get(band));
        let Some(reference) = found.reference else { return Vec::new() };
        let orientations =
            if reference.orientations.is_some() { Orientation::ALL.len() } else { 0 };
        let of = |of: usize, statistic: usize| {
            let values = found.map(|band| {
                let band = band.as_ref()?;
                let statistics = match of.checked_sub(1) {
                    None => band.statistics?,
                    Some(index) => band.orientations.as_ref()?[index],
                };
                Some(statistics.values()[statistic])
            });
            let statistic = Some(HaarStatistic { of, statistic });
            let (level, band) = (Some(level), Some(band));
            (Measure { metric: Metric::Haar, level, band, statistic }, values)
        };
        let statistics = HaarStatistics::NAMES.len();
        (0..=orientations)
            .flat_map(|i| (0..statistics).map(move |s| (i, s)))
            .map(|(i, s)| of(i, s))
            .collect()
    }

    /// All that is compared, in the order of results: the whole frame, its bands, the wavelet.
    pub fn all_compared(&self) -> Vec<Compared> {
        let bands = self.scores.bands.len();
        let haar = (1..=self.haar_levels())
            .flat_map(|level| (0..bands).map(move |band| (level, band)))
            .flat_map(|(level, band)| self.compared_haar(level, band));
        let in_bands = (0..bands).flat_map(|band| self.compared_in(band));
        self.compared().into_iter().chain(in_bands).chain(haar).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_to_nothing_is_none_and_says_why() {
        let sides = |reference, test| Sides { reference, test };
        assert_eq!(sides(Some(0.5), Some(0.25)).ratio(), Some(0.5));
        assert_eq!(sides(Some(0.5), Some(0.0)).ratio(), Some(0.0));
        assert_eq!(sides(Some(0.5), Some(0.25)).reason(), None);
        for test in [0.0, 1.0] {
            let sides = sides(Some(0.0), Some(test));
            assert_eq!((sides.ratio(), sides.reason()), (None, Some("the reference is 0")));
        }
        assert_eq!(sides(None, Some(1.0)).reason(), Some("no value"));
    }
}
