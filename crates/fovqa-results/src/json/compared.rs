//! Measures of reference and test alike as JSON has them: of a frame (`T` a number), or over frames (`T` a
//! mean with its extremes).

use std::collections::BTreeMap;

use fovqa_metrics::profile::Orientation;
use fovqa_metrics::{HaarStatistics, Metric};
use serde::{Deserialize, Serialize};

use crate::compared::{HaarStatistic, Measure, Sides};
use crate::report::{FrameResult, ViewResult};
use crate::summary::{SideStatistics, Spread, Summary};

/// A measure of each picture, and their ratio.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SideValues<T> {
    /// The reference's; `None` where there is no value.
    pub reference: Option<T>,
    /// The test's.
    pub test: Option<T>,
    /// test / reference; `None` where that is not a number.
    pub ratio: Option<f64>,
    /// Why there is no ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The statistics of one picture's coefficients.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HaarValues<T> {
    /// Mean |c|.
    pub mean_abs: Option<T>,
    /// Max |c|.
    pub max_abs: Option<T>,
    /// Mean c².
    pub energy: Option<T>,
}

/// Coefficients of each picture, and the ratios of their statistics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HaarSides<T> {
    /// The reference's.
    pub reference: HaarValues<T>,
    /// The test's.
    pub test: HaarValues<T>,
    /// test / reference.
    pub ratio: HaarValues<f64>,
    /// Why there are no ratios.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// One level of the wavelet in one band.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound(deserialize = "T: Deserialize<'de>"))]
pub struct HaarRecord<T> {
    /// The level, from 1 on.
    pub level: usize,
    /// Lower edge.
    pub from_deg: f64,
    /// Upper edge.
    pub to_deg: f64,
    /// How many coefficients.
    pub coefficients: u64,
    /// All together.
    #[serde(flatten)]
    pub all: HaarSides<T>,
    /// `lh`, `hl` and `hh` one by one, where that is asked for.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub orientations: BTreeMap<String, HaarSides<T>>,
}

impl From<Sides<Option<f64>>> for SideValues<f64> {
    fn from(sides: Sides<Option<f64>>) -> Self {
        Self {
            reference: sides.reference,
            test: sides.test,
            ratio: sides.ratio(),
            reason: sides.reason().map(str::to_owned),
        }
    }
}

impl SideValues<Spread> {
    fn of(statistics: &SideStatistics, maximum: bool) -> Self {
        let reason = statistics.headline(maximum).reason().map(str::to_owned);
        let SideStatistics { reference, test, ratio } = *statistics;
        Self { reference, test, ratio, reason }
    }
}

/// What is compared in a band, by metric.
pub(crate) fn in_band(frame: &FrameResult, band: usize) -> Vec<(Metric, SideValues<f64>)> {
    let compared = frame.compared_in(band).into_iter();
    compared.map(|(measure, sides)| (measure.metric, sides.into())).collect()
}

/// The same over the frames.
pub(crate) fn in_summary_band(
    summary: &Summary,
    band: usize,
) -> BTreeMap<Metric, SideValues<Spread>> {
    let of_band = |(measure, statistics): (&Measure, &SideStatistics)| {
        let wanted = measure.band == Some(band) && measure.level.is_none();
        wanted.then(|| (measure.metric, SideValues::of(statistics, false)))
    };
    summary.compared.iter().filter_map(of_band).collect()
}

/// The wavelet of a frame, level by level.
pub(crate) fn haar(frame: &FrameResult, view: Option<&ViewResult>) -> Vec<HaarRecord<f64>> {
    let edges = view.map(|view| view.bands_deg.as_slice()).unwrap_or_default();
    let places = (1..=frame.haar_levels())
        .flat_map(|level| edges.iter().enumerate().map(move |(band, edges)| (level, band, *edges)));
    let record = |(level, band, edges): (usize, usize, (f64, f64))| {
        let values = frame.compared_haar(level, band).into_iter();
        let values = values.filter_map(|(measure, sides)| Some((measure.statistic?, sides.into())));
        haar_record(level, edges, frame.coefficients(level, band), values.collect())
    };
    places.map(record).collect()
}

/// The wavelet over the frames.
pub(crate) fn summary_haar(summary: &Summary) -> Vec<HaarRecord<Spread>> {
    let mut by_place: BTreeMap<(usize, usize), Vec<Named<Spread>>> = BTreeMap::new();
    for (measure, statistics) in &summary.compared {
        if let (Some(level), Some(band), Some(statistic)) =
            (measure.level, measure.band, measure.statistic)
        {
            let values = SideValues::of(statistics, statistic.is_maximum());
            by_place.entry((level, band)).or_default().push((statistic, values));
        }
    }
    let record = |((level, band), values): ((usize, usize), Vec<_>)| {
        let edges = summary.bands.get(band).map(|band| (band.from_deg, band.to_deg))?;
        let coefficients = summary.coefficients.get(&(level, band)).copied().unwrap_or_default();
        Some(haar_record(level, edges, coefficients, values))
    };
    by_place.into_iter().filter_map(record).collect()
}

/// A statistic with its values.
type Named<T> = (HaarStatistic, SideValues<T>);

fn haar_record<T: Clone>(
    level: usize,
    (from_deg, to_deg): (f64, f64),
    coefficients: u64,
    values: Vec<Named<T>>,
) -> HaarRecord<T> {
    let mut of: BTreeMap<Option<&str>, Vec<SideValues<T>>> = BTreeMap::new();
    for (statistic, sides) in values {
        of.entry(statistic.orientation().map(Orientation::name)).or_default().push(sides);
    }
    let all = sides(of.remove(&None).unwrap_or_default());
    let orientations =
        of.into_iter().filter_map(|(name, values)| Some((name?.to_owned(), sides(values))));
    HaarRecord { level, from_deg, to_deg, coefficients, all, orientations: orientations.collect() }
}

/// The three statistics, in their order, as the three fields.
fn sides<T: Clone>(values: Vec<SideValues<T>>) -> HaarSides<T> {
    debug_assert!(values.len() <= HaarStatistics::NAMES.len(), "one a statistic");
    HaarSides {
        reference: three(&values, |sides| sides.reference.clone()),
        test: three(&values, |sides| sides.test.clone()),
        ratio: three(&values, |sides| sides.ratio),
        reason: values.into_iter().find_map(|sides| sides.reason),
    }
}

fn three<T, V>(
    values: &[SideValues<T>],
    of: impl Fn(&SideValues<T>) -> Option<V>,
) -> HaarValues<V> {
    let value = |index: usize| values.get(index).and_then(&of);
    HaarValues { mean_abs: value(0), max_abs: value(1), energy: value(2) }
}
