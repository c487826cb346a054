//! The values of a finished run, from results.csv and summary.json.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_config::{Aggregate, Quantity};
use fovqa_metrics::{Metric, mse_of_db, psnr_db};

use super::aggregate::aggregate;
use crate::csv_table::ERROR;
use crate::files::{FileError, RESULTS_CSV, SUMMARY_JSON, read_json_file};
use crate::json::{ComparisonSummary, SUMMARY_SCHEMA, SummaryRecord};

/// Scene, method and eye.
pub type Place = (String, String, String);

/// The values of a run, comparison by comparison.
#[derive(Debug, Default)]
pub struct RunValues {
    places: BTreeMap<Place, Values>,
    /// What could not be scored, in words.
    pub errors: Vec<String>,
}

/// The values of a comparison.
#[derive(Debug, Default)]
struct Values {
    rows: BTreeMap<Kind, Vec<Row>>,
    summary: Option<ComparisonSummary>,
    /// Frames, or the whole, that could not be scored.
    errors: usize,
}

/// What a row is of: metric, statistic, image, level.
type Kind = (String, String, String, Option<usize>);

/// A value.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// `None`: of the whole sequence.
    frame: Option<u64>,
    band: Option<[f64; 2]>,
    value: Option<f64>,
}

/// A value of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The value.
    pub value: f64,
    /// The frames it is of, with theirs; empty where it is of the sequence alone.
    pub frames: Vec<(u64, f64)>,
}

/// Why there is no value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Lacking {
    /// The band is not one, or several, of those that were scored.
    Band(String),
    /// There are pixels, but no value: what was asked for was not scored.
    NotScored(String),
    /// There is nothing to have a value of.
    Nothing(String),
}

impl RunValues {
    /// Reads those of a folder of results.
    ///
    /// # Errors
    /// When its files are missing or not what they should be.
    pub fn read(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(SUMMARY_JSON);
        let summary: SummaryRecord = read_json_file(&path, SUMMARY_SCHEMA, "a summary of a run")?;
        let mut values = Self::default();
        values.read_csv(&folder.join(RESULTS_CSV))?;
        for comparison in summary.comparisons {
            let place =
                (comparison.scene.clone(), comparison.method.clone(), comparison.eye.clone());
            let entry = values.places.entry(place).or_default();
            entry.errors = comparison.errors;
            entry.summary = Some(comparison);
        }
        values.errors = summary
            .errors
            .iter()
            .map(|error| {
                let frame = error.frame.map(|frame| format!("frame {frame}"));
                let eye = Some(error.eye.clone()).filter(|eye| !eye.is_empty());
                let place = [Some(error.scene.clone()), Some(error.method.clone()), eye, frame];
                let place: Vec<String> = place.into_iter().flatten().collect();
                format!("{}: {}", place.join(", "), error.message)
            })
            .collect();
        Ok(values)
    }

    fn read_csv(&mut self, path: &Path) -> Result<(), FileError> {
        let broken = |detail: String| FileError::Format {
            path: path.to_owned(),
            expected: "the results of a run",
            detail,
        };
        let mut reader = csv::Reader::from_path(path).map_err(|e| broken(e.to_string()))?;
        let headers = reader.headers().map_err(|e| broken(e.to_string()))?.clone();
        if !headers.iter().eq(crate::csv_table::COLUMNS) {
            return Err(broken("its columns are others".to_owned()));
        }
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|e| broken(e.to_string()))? {
            let cell = |index: usize| record.get(index).unwrap_or_default();
            let line = record.position().map_or(0, csv::Position::line);
            let number = |index: usize| -> Result<Option<f64>, FileError> {
                let text = cell(index);
                let wrong = |_| broken(format!("line {line}: {text:?} is no number"));
                if text.is_empty() { Ok(None) } else { text.parse().map(Some).map_err(wrong) }
            };
            if cell(6) == ERROR {
                continue;
            }
            let whole = |value: Option<f64>| value.map(|value| value as u64);
            let row = Row {
                frame: whole(number(4)?),
                band: number(9)?.zip(number(10)?).map(|(from, to)| [from, to]),
                value: number(11)?.filter(|value| !value.is_nan()),
            };
            let level = whole(number(8)?).map(|level| level as usize);
            let text = |index: usize| cell(index).to_owned();
            let values = self.places.entry((text(0), text(1), text(3))).or_default();
            values.rows.entry((text(6), text(7), text(5), level)).or_default().push(row);
        }
        Ok(())
    }

    /// Scene, method and eye of every comparison.
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        self.places.keys()
    }

    /// Frames of a comparison that could not be scored.
    pub fn errors_of(&self, place: &Place) -> usize {
        self.places.get(place).map_or(0, |values| values.errors)
    }

    /// Frames of a comparison that were scored.
    pub fn frames_of(&self, place: &Place) -> usize {
        let summary = self.places.get(place).and_then(|values| values.summary.as_ref());
        summary.map_or(0, |summary| summary.frames)
    }

    /// A value of a comparison.
    ///
    /// # Errors
    /// When there is none.
    pub fn of(&self, place: &Place, quantity: &Quantity) -> Result<Found, Lacking> {
        let nothing = || Lacking::Nothing("there is no such comparison".to_owned());
        self.places.get(place).ok_or_else(nothing)?.of(quantity)
    }
}

impl Values {
    fn of(&self, quantity: &Quantity) -> Result<Found, Lacking> {
        let Some(kind) = quantity.aggregate else { return self.of_sequence(quantity) };
        let frames = self.frames(quantity)?;
        let values: Vec<f64> = frames.iter().map(|(_, value)| *value).collect();
        let decibels = Metric::find(&quantity.metric).is_some_and(Metric::is_decibel);
        let value = match (kind, quantity.image.as_str()) {
            // As tables have it: of the means, not the mean of the frames' ratios.
            (Aggregate::Mean, "ratio") => self.ratio_of_means(quantity)?,
            (kind, _) => aggregate(kind, &values, decibels).ok_or_else(|| lacks(quantity))?,
        };
        Ok(Found { value, frames })
    }

    /// A value of the sequence as a whole: JOD, or decibels of the pooled error.
    fn of_sequence(&self, quantity: &Quantity) -> Result<Found, Lacking> {
        let frame_statistic = if quantity.statistic == "jod" { "frame_jod" } else { "" };
        let of_frames = Quantity { statistic: frame_statistic.to_owned(), ..quantity.clone() };
        let frames = self.frames(&of_frames).unwrap_or_default();
        let summary = self.summary.as_ref();
        let value = match (Metric::find(&quantity.metric), quantity.band_deg) {
            (Some(Metric::Fvvdp), _) => summary.and_then(|summary| summary.fvvdp.as_ref()?.jod),
            (Some(metric), None) => {
                summary.and_then(|summary| summary.metrics.get(&metric)?.pooled)
            }
            (Some(_), Some(band)) => self.pooled_in(band),
            (None, _) => None,
        };
        Ok(Found { value: value.ok_or_else(|| lacks(quantity))?, frames })
    }

    /// PSNR of the error of all frames in a band.
    fn pooled_in(&self, band: [f64; 2]) -> Option<f64> {
        let psnr = Quantity { band_deg: Some(band), ..Quantity::of(Metric::Psnr, Aggregate::Mean) };
        let parts = self.parts(&psnr).ok()?;
        let (mut squared, mut pixels) = (0.0, 0.0);
        for part in parts.into_values().flatten() {
            squared += mse_of_db(part.value?) * part.weight;
            pixels += part.weight;
        }
        (pixels > 0.0).then(|| psnr_db(squared / pixels))
    }

    fn ratio_of_means(&self, quantity: &Quantity) -> Result<f64, Lacking> {
        let mean = |image: &str| {
            let of = Quantity { image: image.to_owned(), ..quantity.clone() };
            let values: Vec<f64> = self.frames(&of)?.into_iter().map(|(_, value)| value).collect();
            let kind = if quantity.statistic.starts_with("max_abs") {
                Aggregate::Max
            } else {
                Aggregate::Mean
            };
            aggregate(kind, &values, false).ok_or_else(|| lacks(quantity))
        };
        let (reference, test) = (mean("reference")?, mean("test")?);
        if reference == 0.0 {
            let why = format!("{quantity}: there is no ratio to a reference of 0");
            return Err(Lacking::NotScored(why));
        }
        Ok(test / reference)
    }

    /// The value of each frame that has one.
    fn frames(&self, quantity: &Quantity) -> Result<Vec<(u64, f64)>, Lacking> {
        let parts = self.parts(quantity)?;
        let metric = Metric::find(&quantity.metric);
        let mut frames = Vec::new();
        let mut pixels = 0.0;
        for (frame, parts) in parts {
            pixels += parts.iter().map(|part| part.weight).sum::<f64>();
            if let Some(value) = united(metric, &quantity.statistic, &parts) {
                frames.push((frame, value));
            }
        }
        if frames.is_empty() && quantity.band_deg.is_some() && pixels == 0.0 {
            return Err(Lacking::Nothing(format!("{quantity}: no pixel is in the band")));
        }
        if frames.is_empty() { Err(lacks(quantity)) } else { Ok(frames) }
    }

    /// The values of each frame's bands that a quantity is of, with their weights.
    fn parts(&self, quantity: &Quantity) -> Result<BTreeMap<u64, Vec<Part>>, Lacking> {
        let Quantity { metric, statistic, image, level, band_deg, .. } = quantity;
        let kind = (metric.clone(), statistic.clone(), image.clone(), *level);
        let rows = self.rows.get(&kind).map(Vec::as_slice).unwrap_or_default();
        let mut frames: BTreeMap<u64, Vec<Part>> = BTreeMap::new();
        let Some([from, to]) = *band_deg else {
            for row in rows.iter().filter(|row| row.band.is_none()) {
                let part = Part { value: row.value, weight: 1.0 };
                if let Some(frame) = row.frame {
                    frames.entry(frame).or_default().push(part);
                }
            }
            return Ok(frames);
        };
        let weights = self.weights(quantity);
        let mut edges: Vec<[f64; 2]> = Vec::new();
        for row in rows {
            let (Some(frame), Some(band)) = (row.frame, row.band) else { continue };
            edges.push(band);
            if from <= band[0] && band[1] <= to {
                let weight = weights.get(&(frame, band.map(f64::to_bits))).copied().unwrap_or(0.0);
                frames.entry(frame).or_default().push(Part { value: row.value, weight });
            }
        }
        let is_edge =
            |at: f64, side: usize| edges.iter().any(|band| band[side].to_bits() == at.to_bits());
        let known = rows.is_empty() || (is_edge(from, 0) && is_edge(to, 1));
        if !known {
            return Err(Lacking::Band(known_bands(quantity, &edges)));
        }
        Ok(frames)
    }

    /// How much each band of each frame weighs: its pixels or, of the wavelet, its coefficients.
    fn weights(&self, quantity: &Quantity) -> BTreeMap<(u64, [u64; 2]), f64> {
        let pair = |metric: &str, statistic: &str, level| {
            (metric.to_owned(), statistic.to_owned(), "pair".to_owned(), level)
        };
        let kind = match quantity.level {
            Some(level) if quantity.metric == Metric::Haar.key() => {
                pair(Metric::Haar.key(), "coefficients", Some(level))
            }
            _ => pair("pixels", "", None),
        };
        let rows = self.rows.get(&kind).into_iter().flatten();
        let weight =
            |row: &Row| Some(((row.frame?, row.band?.map(f64::to_bits)), row.value.unwrap_or(0.0)));
        rows.filter_map(weight).collect()
    }
}

/// A band of a frame.
#[derive(Debug, Clone, Copy)]
struct Part {
    value: Option<f64>,
    weight: f64,
}

/// The value of several bands together: errors and structure by their pixels, wavelet coefficients by their
/// number, the largest of maxima, shares as they add up. `None` without a value, or where several cannot
/// be put together.
fn united(metric: Option<Metric>, statistic: &str, parts: &[Part]) -> Option<f64> {
    let scored: Vec<(f64, f64)> =
        parts.iter().filter_map(|part| Some((part.value?, part.weight))).collect();
    if let [(value, _)] = scored.as_slice() {
        return Some(*value);
    }
    let weighed = |of: &dyn Fn(f64) -> f64| {
        let sum: f64 = scored.iter().map(|(value, weight)| of(*value) * weight).sum();
        let weights: f64 = scored.iter().map(|(_, weight)| weight).sum();
        (weights > 0.0).then(|| sum / weights)
    };
    match metric? {
        Metric::Psnr => weighed(&mse_of_db).map(psnr_db),
        Metric::Mse | Metric::Ssim => weighed(&|value| value),
        Metric::Haar if statistic.starts_with("max_abs") => {
            scored.iter().map(|(value, _)| *value).reduce(f64::max)
        }
        Metric::Haar => weighed(&|value| value),
        Metric::Fvvdp => (!scored.is_empty()).then(|| scored.iter().map(|(value, _)| value).sum()),
        _ => None,
    }
}

fn known_bands(quantity: &Quantity, edges: &[[f64; 2]]) -> String {
    let mut edges = edges.to_vec();
    edges.sort_by(|a, b| a[0].total_cmp(&b[0]));
    edges.dedup();
    let known: Vec<String> = edges.iter().map(|[from, to]| format!("{from} to {to}")).collect();
    format!(
        "{quantity}: the band does not begin and end with bands that are scored: {}",
        known.join(", ")
    )
}

fn lacks(quantity: &Quantity) -> Lacking {
    Lacking::NotScored(format!("{quantity}: it has no value"))
}
