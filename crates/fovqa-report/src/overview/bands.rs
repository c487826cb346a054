//! The values of a run by eccentricity: of metrics, wavelet levels and power spectra.

use fovqa_metrics::{Key, Metric};
use fovqa_results::{
    BandStatistics, HaarRecord, HaarValues, SideValues, SpectrumBin, SpectrumRecord,
    SpectrumValues, Spread, Statistics,
};

/// The values of an eccentricity band over the frames.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Band {
    pub(crate) from_deg: f64,
    pub(crate) to_deg: f64,
    pub(super) means: Box<[(Metric, Option<f64>)]>,
    pub(super) compared: Box<[(Metric, Compared)]>,
}

/// The power spectrum of a band.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SpectrumBand {
    pub(crate) from_deg: f64,
    pub(crate) to_deg: f64,
    /// The frequency up to which the test has the reference's power.
    pub(crate) cutoff_cpd: Option<f64>,
    pub(crate) points: Box<[SpectrumPoint]>,
}

/// Power density at a frequency, and the ratio of the power.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SpectrumPoint {
    pub(crate) cpd: f64,
    pub(super) values: Compared,
}

/// The values of a wavelet level in an eccentricity band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WaveletBand {
    pub(crate) level: u8,
    pub(crate) from_deg: f64,
    pub(crate) to_deg: f64,
    /// Mean |c|, max |c| and mean c².
    pub(super) statistics: [Compared; 3],
}

/// A measure of the reference, the same measure of the test, and their ratio. NaN, which is never a
/// measured value, marks a missing value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Compared([f64; 3]);

impl Band {
    pub(super) fn of(band: &BandStatistics) -> Self {
        let mean = |(metric, of): (&Metric, &Option<Statistics>)| (*metric, of.map(|of| of.mean));
        let compared = |(metric, of): (&Metric, &SideValues<Spread>)| {
            let statistic = Key::of(*metric).statistic();
            (*metric, Compared::of(of, |spread| spread.headline(statistic)))
        };
        let compared = band.compared.iter().map(compared);
        Self {
            from_deg: band.from_deg,
            to_deg: band.to_deg,
            means: band.metrics.iter().map(mean).collect(),
            compared: compared.collect(),
        }
    }

    /// The mean of a metric over the frames.
    pub(crate) fn mean(&self, metric: Metric) -> Option<f64> {
        *of(&self.means, metric)?
    }

    /// The values of a measure that is computed for each image.
    pub(crate) fn compared(&self, metric: Metric) -> Option<&Compared> {
        of(&self.compared, metric)
    }
}

impl SpectrumBand {
    pub(super) fn of(record: &SpectrumRecord<Spread>) -> Self {
        let density = |of: &SpectrumValues<Spread>| of.density.map(|spread| spread.mean);
        let point = |bin: &SpectrumBin<Spread>| SpectrumPoint {
            cpd: bin.cpd,
            values: Compared::new([density(&bin.reference), density(&bin.test), bin.ratio]),
        };
        Self {
            from_deg: record.from_deg,
            to_deg: record.to_deg,
            cutoff_cpd: record.cutoff_cpd,
            points: record.bins.iter().map(point).collect(),
        }
    }

    /// Both edges in degrees, bit by bit.
    pub(crate) fn edges(&self) -> [u64; 2] {
        [self.from_deg, self.to_deg].map(f64::to_bits)
    }
}

impl SpectrumPoint {
    /// Power density of the reference.
    pub(crate) fn reference(&self) -> Option<f64> {
        self.values.reference()
    }

    /// Power density of the test.
    pub(crate) fn test(&self) -> Option<f64> {
        self.values.test()
    }

    /// test / reference of the power.
    pub(crate) fn ratio(&self) -> Option<f64> {
        self.values.ratio()
    }
}

impl WaveletBand {
    pub(super) fn of(record: &HaarRecord<Spread>) -> Self {
        let all = &record.all;
        let of = |statistic: fn(&HaarValues<Spread>) -> Option<f64>, ratio: Option<f64>| {
            Compared::new([statistic(&all.reference), statistic(&all.test), ratio])
        };
        Self {
            level: record.level as u8,
            from_deg: record.from_deg,
            to_deg: record.to_deg,
            statistics: [
                of(|values| values.mean_abs.map(|spread| spread.mean), all.ratio.mean_abs),
                of(|values| values.max_abs.map(|spread| spread.max), all.ratio.max_abs),
                of(|values| values.energy.map(|spread| spread.mean), all.ratio.energy),
            ],
        }
    }

    /// A statistic by its name.
    pub(crate) fn statistic(&self, name: &str) -> &Compared {
        let [mean_abs, max_abs, energy] = &self.statistics;
        match name {
            "mean_abs" => mean_abs,
            "max_abs" => max_abs,
            _ => energy,
        }
    }
}

impl Compared {
    pub(super) fn new(values: [Option<f64>; 3]) -> Self {
        Self(values.map(|value| value.unwrap_or(f64::NAN)))
    }

    pub(super) fn of(sides: &SideValues<Spread>, headline: impl Fn(&Spread) -> f64) -> Self {
        let of = |side: &Option<Spread>| side.as_ref().map(&headline);
        Self::new([of(&sides.reference), of(&sides.test), sides.ratio])
    }

    /// Value of the reference.
    pub(crate) fn reference(&self) -> Option<f64> {
        self.get(0)
    }

    /// Value of the test.
    pub(crate) fn test(&self) -> Option<f64> {
        self.get(1)
    }

    /// test / reference.
    pub(crate) fn ratio(&self) -> Option<f64> {
        self.get(2)
    }

    fn get(&self, index: usize) -> Option<f64> {
        Some(self.0[index]).filter(|value| !value.is_nan())
    }
}

/// The value of a metric in a list.
pub(super) fn of<T>(values: &[(Metric, T)], metric: Metric) -> Option<&T> {
    values.iter().find(|(of, _)| *of == metric).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn the_numbers_of_each_statistic_are_kept_apart() {
        let spread =
            |mean: f64| Some(Spread { mean, min: 0.5 * mean, max: 2.0 * mean, pooled: None });
        let values = |mean: f64| HaarValues {
            mean_abs: spread(mean),
            max_abs: spread(10.0 * mean),
            energy: None,
        };
        let ratio = HaarValues { mean_abs: Some(3.0), max_abs: None, energy: Some(4.0) };
        let record = HaarRecord {
            level: 2,
            from_deg: 0.0,
            to_deg: 5.0,
            coefficients: 7,
            all: fovqa_results::HaarSides {
                reference: values(1.0),
                test: values(2.0),
                ratio,
                reason: None,
            },
            orientations: BTreeMap::new(),
        };
        let band = WaveletBand::of(&record);
        let numbers = |name: &str| {
            let of = band.statistic(name);
            [of.reference(), of.test(), of.ratio()]
        };
        assert_eq!(numbers("mean_abs"), [Some(1.0), Some(2.0), Some(3.0)]);
        assert_eq!(numbers("max_abs"), [Some(20.0), Some(40.0), None], "maxima, not means");
        assert_eq!(numbers("energy"), [None, None, Some(4.0)]);
    }
}
