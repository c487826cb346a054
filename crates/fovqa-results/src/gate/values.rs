//! The values of a finished run, from results.csv and summary.json.

use std::collections::BTreeMap;
use std::fmt;

use fovqa_metrics::{Key, Metric, MetricKind, Parts, Pooling, Statistic, Subject, Weight, pool};
use fovqa_plan::{Aggregate, Quantity};

use super::aggregate::aggregate;
use super::series::Series;
use crate::compared::Sides;
use crate::json::ComparisonSummary;
use crate::samples::SampleSummary;

/// Scene, method and eye.
pub type ComparisonName = (String, String, String);

/// The values of a run, by comparison.
#[derive(Debug, Default)]
pub struct RunValues {
    pub(super) places: BTreeMap<ComparisonName, Values>,
    /// The items that could not be scored, in words.
    pub errors: Vec<String>,
    /// The values of further runs of the same build, for rules that test the spread of repeated runs.
    pub repeats: Vec<Self>,
}

/// The values of a comparison.
#[derive(Debug, Default)]
pub(super) struct Values {
    pub(super) rows: BTreeMap<Kind, Vec<ValueRow>>,
    pub(super) summary: Option<ComparisonSummary>,
    /// Number of frames, or whole comparisons, that could not be scored.
    pub(super) errors: usize,
}

/// What a row contains: metric, statistic, image and level.
pub(super) type Kind = (String, String, String, Option<i64>);

/// One row of the table.
#[derive(Debug, Clone, Copy)]
pub(super) struct ValueRow {
    /// Frame number; `None` for a value of the whole sequence.
    pub(super) frame: Option<i64>,
    pub(super) band: Option<[f64; 2]>,
    pub(super) value: Option<f64>,
}

/// A value of a comparison, with the values of its frames.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundValue {
    /// The value.
    pub value: f64,
    /// The frames that the value is made from, with their values. Empty if only the sequence has a
    /// value.
    pub frames: Vec<(i64, f64)>,
}

/// Why there is no value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Lacking {
    /// The requested band is not one, or a union, of the scored bands.
    Band(String),
    /// There are pixels, but no value: the requested quantity was not scored.
    NotScored(String),
    /// There is nothing that could have a value.
    Nothing(String),
}

impl Lacking {
    /// Adds the place in front of the message.
    pub(super) fn within(self, place: &str) -> Self {
        let named = |why: String| format!("{place}: {why}");
        match self {
            Self::Band(why) => Self::Band(named(why)),
            Self::NotScored(why) => Self::NotScored(named(why)),
            Self::Nothing(why) => Self::Nothing(named(why)),
        }
    }
}

impl fmt::Display for Lacking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Band(why) | Self::NotScored(why) | Self::Nothing(why)) = self;
        f.write_str(why)
    }
}

impl RunValues {
    /// Scene, method and eye of each comparison.
    pub fn places(&self) -> impl Iterator<Item = &ComparisonName> {
        self.places.keys()
    }

    /// Number of frames of a comparison that could not be scored.
    pub fn errors_of(&self, place: &ComparisonName) -> usize {
        self.places.get(place).map_or(0, |values| values.errors)
    }

    /// Number of frames of a comparison that were scored.
    pub fn frames_of(&self, place: &ComparisonName) -> usize {
        let summary = self.places.get(place).and_then(|values| values.summary.as_ref());
        summary.map_or(0, |summary| summary.frames)
    }

    /// The samples of a comparison, if its method is emulated.
    pub fn samples_of(&self, place: &ComparisonName) -> Option<&SampleSummary> {
        self.places.get(place)?.summary.as_ref()?.samples.as_ref()
    }

    /// A value of a comparison.
    ///
    /// # Errors
    /// If there is none.
    pub fn of(&self, place: &ComparisonName, quantity: &Quantity) -> Result<FoundValue, Lacking> {
        let nothing = || Lacking::Nothing("there is no such comparison".to_owned());
        self.places.get(place).ok_or_else(nothing)?.of(quantity)
    }
}

impl RunValues {
    /// Whether a comparison has values of a metric's pairs.
    pub(crate) fn has(&self, place: &ComparisonName, metric: Metric) -> bool {
        let kind = (metric.key().to_owned(), String::new(), "pair".to_owned(), None);
        self.places.get(place).is_some_and(|values| values.rows.contains_key(&kind))
    }

    /// The value of each frame that has one.
    ///
    /// # Errors
    /// If there is none.
    pub(super) fn frames(
        &self,
        place: &ComparisonName,
        quantity: &Quantity,
    ) -> Result<Vec<(i64, f64)>, Lacking> {
        let nothing = || Lacking::Nothing("there is no such comparison".to_owned());
        self.places.get(place).ok_or_else(nothing)?.frames(quantity)
    }

    /// The values of single frames, with those of all bands; `None` if there are none.
    pub(crate) fn series(&self, place: &ComparisonName, quantity: &Quantity) -> Option<Series> {
        let frames = self.frames(place, quantity).ok()?.into_iter().collect();
        let mut bands: Vec<([f64; 2], BTreeMap<i64, f64>)> = Vec::new();
        let rows = self.places.get(place)?.rows.get(&kind(quantity))?;
        for row in rows {
            let (Some(frame), Some(band), Some(value)) = (row.frame, row.band, row.value) else {
                continue;
            };
            let same =
                |(edges, _): &&mut ([f64; 2], _)| edges.map(f64::to_bits) == band.map(f64::to_bits);
            match bands.iter_mut().find(same) {
                Some((_, values)) => _ = values.insert(frame, value),
                None => bands.push((band, BTreeMap::from([(frame, value)]))),
            }
        }
        bands.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.0[1].total_cmp(&b.0[1])));
        Some(Series { frames, bands, digits: None })
    }
}

impl Values {
    fn of(&self, quantity: &Quantity) -> Result<FoundValue, Lacking> {
        let Some(kind) = quantity.aggregate else { return self.of_sequence(quantity) };
        let frames = self.frames(quantity)?;
        let values: Vec<f64> = frames.iter().map(|(_, value)| *value).collect();
        let decibels = Metric::find(&quantity.metric).is_some_and(Metric::is_decibel);
        let value = match (kind, quantity.image.as_str()) {
            // As in the tables, this is the ratio of the means (of the pooled values of metrics that pool
            // their frames), not the mean of the frames' ratios.
            (Aggregate::Mean, "ratio") => self.ratio_of_means(quantity)?,
            (kind, _) => aggregate(kind, &values, decibels).ok_or_else(|| lacks(quantity))?,
        };
        Ok(FoundValue { value, frames })
    }

    /// A value of the whole sequence: the JOD, or the value of all frames together.
    fn of_sequence(&self, quantity: &Quantity) -> Result<FoundValue, Lacking> {
        let frame_statistic = if quantity.statistic == "jod" { "frame_jod" } else { "" };
        let of_frames = Quantity { statistic: frame_statistic.to_owned(), ..quantity.clone() };
        let frames = self.frames(&of_frames).unwrap_or_default();
        let summary = self.summary.as_ref();
        let value = match (Metric::find(&quantity.metric), quantity.band_deg) {
            (Some(Metric::Fvvdp), _) => summary.and_then(|summary| summary.fvvdp.as_ref()?.jod),
            (Some(metric), None) if metric.is(MetricKind::Temporal) => {
                summary.and_then(|summary| {
                    let of = summary.temporal.of(metric)?;
                    match quantity.image.as_str() {
                        "reference" => of.reference,
                        "ratio" => of.ratio,
                        _ => of.test,
                    }
                })
            }
            (Some(metric), None) => {
                summary.and_then(|summary| summary.metrics.get(&metric)?.pooled)
            }
            (Some(_), Some(_)) if quantity.image == "ratio" => {
                let of = |image: &str| {
                    let image = image.to_owned();
                    self.pooled_in_bands(&Quantity { image, ..of_frames.clone() })
                };
                let (reference, test) = (of("reference")?, of("test")?);
                Some(ratio(&of_frames, reference, test).ok_or_else(|| no_ratio(quantity))?)
            }
            (Some(_), Some(_)) => Some(self.pooled_in_bands(&of_frames)?),
            _ => None,
        };
        Ok(FoundValue { value: value.ok_or_else(|| lacks(quantity))?, frames })
    }

    /// The pooled value of all frames in one or several bands.
    fn pooled_in_bands(&self, quantity: &Quantity) -> Result<f64, Lacking> {
        // This call returns the error if something is missing.
        self.frames(quantity)?;
        let pooling = statistic(quantity).map_or(Pooling::None, |statistic| statistic.frames);
        let parts = self.parts(quantity, pooling)?.into_values().flatten();
        pool(pooling, parts.map(|part| (part.value, part.parts))).0.ok_or_else(|| lacks(quantity))
    }

    fn ratio_of_means(&self, quantity: &Quantity) -> Result<f64, Lacking> {
        let mean = |image: &str| {
            let of = Quantity { image: image.to_owned(), ..quantity.clone() };
            let values: Vec<f64> = self.frames(&of)?.into_iter().map(|(_, value)| value).collect();
            let statistic = statistic(quantity);
            if let Some(statistic) = statistic.filter(|statistic| statistic.pools_values()) {
                let values = values.into_iter().map(|value| (Some(value), Parts::Value));
                return pool(statistic.frames, values).0.ok_or_else(|| lacks(quantity));
            }
            let maximum = statistic.is_some_and(Statistic::is_maximum);
            let kind = if maximum { Aggregate::Max } else { Aggregate::Mean };
            aggregate(kind, &values, false).ok_or_else(|| lacks(quantity))
        };
        let (reference, test) = (mean("reference")?, mean("test")?);
        ratio(quantity, reference, test).ok_or_else(|| no_ratio(quantity))
    }

    /// The value of each frame that has one.
    fn frames(&self, quantity: &Quantity) -> Result<Vec<(i64, f64)>, Lacking> {
        let pooling = statistic(quantity).map_or(Pooling::None, |statistic| statistic.bands);
        let parts = self.parts(quantity, pooling)?;
        if !self.rows.contains_key(&kind(quantity)) {
            return Err(lacks(quantity));
        }
        if quantity.image == "ratio" && parts.values().any(|parts| parts.len() > 1) {
            return self.ratios(quantity);
        }
        if let Some(frame) = self.frame_without_score(quantity) {
            let why = format!("{quantity}: frame {frame} has no value");
            return Err(Lacking::NotScored(why));
        }
        let mut frames = Vec::new();
        let mut pixels = 0.0;
        for (frame, parts) in parts {
            pixels += parts.iter().map(|part| part.weight).sum::<f64>();
            let parts = parts.iter().map(|part| (part.value, part.parts));
            if let Some(value) = pool(pooling, parts).0 {
                frames.push((frame, value));
            }
        }
        if frames.is_empty() && quantity.band_deg.is_some() {
            if pooling == Pooling::Deviation {
                let why = "fewer than two of its values are in the band";
                return Err(Lacking::Nothing(format!("{quantity}: {why}")));
            }
            if pixels == 0.0 {
                return Err(Lacking::Nothing(format!("{quantity}: no pixel is in the band")));
            }
        }
        match quantity.image.as_str() {
            _ if !frames.is_empty() => Ok(frames),
            "ratio" => Err(no_ratio(quantity)),
            _ => Err(lacks(quantity)),
        }
    }

    /// A frame that was scored, but that a metric has no value for. Only bands may be without one, where no pixel is in
    /// them; a frame that is left out must not pass.
    fn frame_without_score(&self, quantity: &Quantity) -> Option<i64> {
        if quantity.band_deg.is_some() || quantity.image != "pair" {
            return None;
        }
        let rows = self.rows.get(&kind(quantity))?;
        let mut without = rows.iter().filter(|row| row.band.is_none() && row.value.is_none());
        without.find_map(|row| row.frame)
    }

    /// For each frame, the ratio test / reference of several bands together. It is not the mean of
    /// the bands' ratios.
    fn ratios(&self, quantity: &Quantity) -> Result<Vec<(i64, f64)>, Lacking> {
        let of =
            |image: &str| self.frames(&Quantity { image: image.to_owned(), ..quantity.clone() });
        let (references, tests) = (of("reference")?, of("test")?);
        let references: BTreeMap<i64, f64> = references.into_iter().collect();
        let of_frame = |(frame, test): (i64, f64)| {
            Some((frame, ratio(quantity, *references.get(&frame)?, test)?))
        };
        let frames: Vec<(i64, f64)> = tests.into_iter().filter_map(of_frame).collect();
        if frames.is_empty() { Err(no_ratio(quantity)) } else { Ok(frames) }
    }

    /// The values of a quantity in the bands of each frame, with the weights that pool them.
    fn parts(
        &self,
        quantity: &Quantity,
        pooling: Pooling,
    ) -> Result<BTreeMap<i64, Vec<Part>>, Lacking> {
        let rows = self.rows.get(&kind(quantity)).map(Vec::as_slice).unwrap_or_default();
        let mut frames: BTreeMap<i64, Vec<Part>> = BTreeMap::new();
        let Some([from, to]) = quantity.band_deg else {
            for row in rows.iter().filter(|row| row.band.is_none()) {
                let part = Part { value: row.value, weight: 1.0, parts: Parts::Value };
                if let Some(frame) = row.frame {
                    frames.entry(frame).or_default().push(part);
                }
            }
            return Ok(frames);
        };
        let (weights, means) = self.weights(quantity)?;
        for row in rows {
            let (Some(frame), Some(band)) = (row.frame, row.band) else { continue };
            if from <= band[0] && band[1] <= to {
                let of = |values: &Weights| values.get(&(frame, band.map(f64::to_bits))).copied();
                let weight = of(&weights);
                if weight.is_none() && row.value.is_some() {
                    return Err(unweighted(quantity));
                }
                let (weight, mean) = (weight.unwrap_or(0.0), of(&means).unwrap_or(0.0));
                let parts = Parts::of_value(pooling, row.value, weight, mean);
                frames.entry(frame).or_default().push(Part { value: row.value, weight, parts });
            }
        }
        // Every band has a number of pixels, even if it has no other value.
        let pixels = ("pixels".to_owned(), String::new(), "pair".to_owned(), None);
        let pixels = self.rows.get(&pixels).into_iter().flatten();
        let edges: Vec<[f64; 2]> = pixels.filter_map(|row| row.band).collect();
        let is_edge =
            |at: f64, side: usize| edges.iter().any(|band| band[side].to_bits() == at.to_bits());
        let known = rows.is_empty() || (is_edge(from, 0) && is_edge(to, 1));
        if !known {
            return Err(Lacking::Band(known_bands(quantity, &edges)));
        }
        Ok(frames)
    }

    /// The weight of each band in each frame and, for deviations, the mean in the band.
    fn weights(&self, quantity: &Quantity) -> Result<(Weights, Weights), Lacking> {
        let of =
            |statistic: &str| self.by_band(quantity, (&quantity.metric, statistic, quantity.level));
        let pixels = || self.by_band(quantity, (Subject::Pixels.name(), "", None));
        match statistic(quantity).map_or(Weight::Pixels, |statistic| statistic.weight) {
            Weight::Pixels => Ok((pixels()?, Weights::new())),
            Weight::Statistic(name) => Ok((of(name)?, Weights::new())),
            Weight::Moments { count, mean } => Ok((of(count)?, of(mean)?)),
        }
    }

    /// The values of a pair's statistic, by frame and band.
    fn by_band(
        &self,
        quantity: &Quantity,
        (metric, statistic, level): (&str, &str, Option<i64>),
    ) -> Result<Weights, Lacking> {
        let kind = (metric.to_owned(), statistic.to_owned(), "pair".to_owned(), level);
        let none = Vec::new();
        let scored = self.rows.contains_key(&self::kind(quantity));
        // A count of a whole band holds for all of its levels.
        let of_band = (kind.0.clone(), kind.1.clone(), kind.2.clone(), None);
        let rows = self.rows.get(&kind).or_else(|| self.rows.get(&of_band));
        let Some(rows) = rows.or(Some(&none).filter(|_| !scored)) else {
            return Err(unweighted(quantity));
        };
        let weight = |row: &ValueRow| {
            Some(((row.frame?, row.band?.map(f64::to_bits)), row.value.unwrap_or(0.0)))
        };
        Ok(rows.iter().filter_map(weight).collect())
    }
}

/// Values by frame and band.
type Weights = BTreeMap<(i64, [u64; 2]), f64>;

/// test / reference; `None` where the reference is 0 or next to it.
fn ratio(quantity: &Quantity, reference: f64, test: f64) -> Option<f64> {
    Sides { reference: Some(reference), test: Some(test) }.ratio(statistic(quantity)?)
}

/// The rule by which the statistic of a quantity is pooled.
fn statistic(quantity: &Quantity) -> Option<&'static Statistic> {
    let subject = Subject::Metric(Metric::find(&quantity.metric)?);
    Some(Key::named(subject, &quantity.statistic)?.statistic())
}

fn kind(quantity: &Quantity) -> Kind {
    let Quantity { metric, statistic, image, level, .. } = quantity;
    (metric.clone(), statistic.clone(), image.clone(), *level)
}

/// One band of a frame.
#[derive(Debug, Clone, Copy)]
struct Part {
    value: Option<f64>,
    weight: f64,
    parts: Parts,
}

fn known_bands(quantity: &Quantity, edges: &[[f64; 2]]) -> String {
    let mut edges = edges.to_vec();
    edges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    edges.dedup();
    let known: Vec<String> = edges.iter().map(|[from, to]| format!("{from} to {to}")).collect();
    format!(
        "{quantity}: the band must begin and end at edges of scored bands: {}",
        known.join(", ")
    )
}

/// The error for results of a version that did not write the weights. Pixel counts of the bands
/// would be wrong weights.
fn unweighted(quantity: &Quantity) -> Lacking {
    Lacking::NotScored(format!(
        "{quantity}: the results do not say how many pixels of each band have a value; score them again"
    ))
}

fn no_ratio(quantity: &Quantity) -> Lacking {
    Lacking::NotScored(format!("{quantity}: there is no ratio to a reference of 0"))
}

fn lacks(quantity: &Quantity) -> Lacking {
    Lacking::NotScored(format!("{quantity}: it has no value"))
}
