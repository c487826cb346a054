//! JSON for measures that are computed for reference and test in the same way: of one frame (`T` is
//! a number), or over frames (`T` is a mean with its extremes).

use std::collections::BTreeMap;

use fovqa_metrics::{Key, Metric, Statistic, Subject};
use serde::{Deserialize, Serialize};

use crate::compared::Sides;
use crate::report::{FrameResult, ViewResult};
use crate::spread::Spread;
use crate::summary::{SideStatistics, Summary};

/// A measure of each image, and their ratio.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SideValues<T> {
    /// Value of the reference; `None` if there is none.
    pub reference: Option<T>,
    /// Value of the test; `None` if there is none.
    pub test: Option<T>,
    /// test / reference; `None` if that is not a number.
    pub ratio: Option<f64>,
    /// Why there is no ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The statistics of the wavelet coefficients of one image.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HaarValues<T> {
    /// Mean |c|.
    pub mean_abs: Option<T>,
    /// Max |c|.
    pub max_abs: Option<T>,
    /// Mean c².
    pub energy: Option<T>,
}

/// The wavelet coefficients of each image, and the ratios of their statistics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HaarSides<T> {
    /// Statistics of the reference.
    pub reference: HaarValues<T>,
    /// Statistics of the test.
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
    /// The level, counted from 1.
    pub level: usize,
    /// Lower edge in degrees.
    pub from_deg: f64,
    /// Upper edge in degrees.
    pub to_deg: f64,
    /// Number of coefficients.
    pub coefficients: u64,
    /// All orientations together.
    #[serde(flatten)]
    pub all: HaarSides<T>,
    /// `lh`, `hl` and `hh` individually, if that is requested.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub orientations: BTreeMap<String, HaarSides<T>>,
}

impl SideValues<f64> {
    /// The values of a frame.
    pub(super) fn of_frame(sides: &Sides<Option<f64>>, statistic: &Statistic) -> Self {
        Self {
            reference: sides.reference,
            test: sides.test,
            ratio: sides.ratio(statistic),
            reason: sides.reason(statistic).map(str::to_owned),
        }
    }
}

impl SideValues<Spread> {
    fn of(statistics: &SideStatistics, statistic: &Statistic) -> Self {
        let reason = statistics.headline(statistic).reason(statistic).map(str::to_owned);
        let SideStatistics { reference, test, ratio } = *statistics;
        Self { reference, test, ratio, reason }
    }
}

/// The compared measures in a band, by name.
pub(crate) fn in_band(frame: &FrameResult, band: usize) -> Vec<(String, SideValues<f64>)> {
    let compared = frame.compared().filter(|(key, _)| is_in_band(key, band));
    compared
        .map(|(key, sides)| (name(&key), SideValues::of_frame(&sides, key.statistic())))
        .collect()
}

/// The compared measures in a band over the frames. Only the metrics' own values are included.
pub(crate) fn in_summary_band(
    summary: &Summary,
    band: usize,
) -> BTreeMap<Metric, SideValues<Spread>> {
    let of_band = |(key, statistics): (&Key, &SideStatistics)| {
        let wanted = is_in_band(key, band) && key.statistic().name.is_empty();
        let sides = || SideValues::of(statistics, key.statistic());
        key.metric().filter(|_| wanted).map(|metric| (metric, sides()))
    };
    summary.compared.iter().filter_map(of_band).collect()
}

/// The name of a value: the metric and, if it is not the metric's own value, the statistic. Some statistics
/// say both.
pub(crate) fn name(key: &Key) -> String {
    match key.statistic().name {
        "" => key.subject.name().to_owned(),
        statistic if key.statistic().is_named_alone => statistic.to_owned(),
        statistic => format!("{}_{statistic}", key.subject.name()),
    }
}

fn is_in_band(key: &Key, band: usize) -> bool {
    key.band.map(usize::from) == Some(band) && key.level.is_none()
}

/// The wavelet statistics of a frame, level by level.
pub(crate) fn haar(frame: &FrameResult, view: Option<&ViewResult>) -> Vec<HaarRecord<f64>> {
    let edges = view.map(|view| view.bands_deg.as_slice()).unwrap_or_default();
    haar_records(of_frame(frame), edges, |key| frame.rows.number(key))
}

/// The wavelet statistics over the frames.
pub(crate) fn summary_haar(summary: &Summary) -> Vec<HaarRecord<Spread>> {
    let edges: Vec<(f64, f64)> =
        summary.bands.iter().map(|band| (band.from_deg, band.to_deg)).collect();
    haar_records(of_summary(summary), &edges, |key| {
        summary.counts.get(&key).copied().unwrap_or_default()
    })
}

/// The measures of each image of a frame.
pub(super) fn of_frame(frame: &FrameResult) -> impl Iterator<Item = (Key, SideValues<f64>)> {
    let values = frame.compared();
    values.map(|(key, sides)| (key, SideValues::of_frame(&sides, key.statistic())))
}

/// The measures of each image over the frames.
pub(crate) fn of_summary(summary: &Summary) -> impl Iterator<Item = (Key, SideValues<Spread>)> {
    let values = summary.compared.iter();
    values.map(|(key, statistics)| (*key, SideValues::of(statistics, key.statistic())))
}

/// The statistics of a level in a band, by the name of the orientation; `None` is the key for all
/// orientations together.
type Grouped<T> = BTreeMap<Option<&'static str>, Vec<SideValues<T>>>;

fn haar_records<T: Clone>(
    values: impl Iterator<Item = (Key, SideValues<T>)>,
    edges: &[(f64, f64)],
    count: impl Fn(Key) -> u64,
) -> Vec<HaarRecord<T>> {
    let mut places: BTreeMap<(i16, usize), Grouped<T>> = BTreeMap::new();
    for (key, sides) in values.filter(|(key, _)| key.metric() == Some(Metric::Haar)) {
        let (Some(level), Some(band)) = (key.level, key.band) else { continue };
        let place = places.entry((level, band.into())).or_default();
        place.entry(orientation(key.statistic().name)).or_default().push(sides);
    }
    let record = |((level, band), mut of): ((i16, usize), Grouped<T>)| {
        let &(from_deg, to_deg) = edges.get(band)?;
        let coefficients = Key::named(Subject::Metric(Metric::Haar), "coefficients")?;
        let coefficients = count(coefficients.at_level(level).in_band(band));
        let all = sides(of.remove(&None).unwrap_or_default());
        let orientations =
            of.into_iter().filter_map(|(name, values)| Some((name?.to_owned(), sides(values))));
        let orientations = orientations.collect();
        Some(HaarRecord {
            level: level as usize,
            from_deg,
            to_deg,
            coefficients,
            all,
            orientations,
        })
    };
    places.into_iter().filter_map(record).collect()
}

/// The orientation of a wavelet statistic; `None` for all orientations together.
fn orientation(statistic: &str) -> Option<&'static str> {
    ORIENTATIONS.into_iter().find(|name| statistic.ends_with(&format!("_{name}")))
}

/// Low frequencies in x and high in y; high in x and low in y; high in both.
const ORIENTATIONS: [&str; 3] = ["lh", "hl", "hh"];

/// Number of statistics per orientation: `mean_abs`, `max_abs` and `energy`.
const PER_ORIENTATION: usize = 3;

/// The three statistics, in this order, as three fields.
fn sides<T: Clone>(values: Vec<SideValues<T>>) -> HaarSides<T> {
    debug_assert!(values.len() <= PER_ORIENTATION, "one per statistic");
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
