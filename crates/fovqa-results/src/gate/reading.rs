//! Reads the values of a finished run from results.csv and summary.json. A table with missing or
//! added rows must not pass as a run, so the two files have to agree.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use fovqa_metrics::{Metric, Subject};

use super::values::{ComparisonName, RunValues, ValueRow, Values};
use crate::csv_names::CsvNames;
use crate::files::{FileError, SUMMARY_JSON};
use crate::json::{ComparisonSummary, read_summary};
use crate::report::RunResults;
use crate::table::{
    ERROR, TableRow, Value, Which, not_results, read_results, rows_of_run, table_file,
};

impl RunValues {
    /// Reads the values in a results folder.
    ///
    /// # Errors
    /// If its files are missing or do not have the expected content.
    pub fn read(folder: &Path, names: CsvNames) -> Result<Self, FileError> {
        let mut comparisons = Vec::new();
        let errors = read_summary(folder, |comparison| comparisons.push(comparison))?;
        let mut values = Self::default();
        let path = table_file(folder);
        let broken = |detail: String| not_results(&path, detail);
        values.read_csv(folder, names)?;
        for comparison in comparisons {
            let place = place(&comparison);
            let entry = values.places.entry(place).or_default();
            agrees(entry, &comparison).map_err(broken)?;
            entry.errors = comparison.errors;
            entry.summary = Some(comparison);
        }
        let stranger = values.places.iter().find(|(_, values)| values.summary.is_none());
        if let Some(((scene, method, _), _)) = stranger {
            return Err(broken(format!(
                "it has values of {scene}, {method} that {SUMMARY_JSON} does not have"
            )));
        }
        values.errors = errors
            .iter()
            .map(|error| {
                let frame = error.frame.map(|frame| format!("frame {frame}"));
                let eye = Some(error.eye.clone()).filter(|eye| !eye.is_empty());
                let place = [Some(error.scene.clone()), Some(error.label()), eye, frame];
                let place: Vec<String> = place.into_iter().flatten().collect();
                format!("{}: {}", place.join(", "), error.message)
            })
            .collect();
        Ok(values)
    }

    /// The values of a run that is still in memory. It has no errors of its own: they are in `results`.
    pub fn of_results(results: &RunResults) -> Self {
        let mut values = Self::default();
        // The sink refuses nothing.
        let _ = rows_of_run(results, &mut |row| {
            values.take(row);
            Ok(())
        });
        for comparison in &results.comparisons {
            let summary = ComparisonSummary::of(comparison);
            let entry = values.places.entry(place(&summary)).or_default();
            entry.errors = summary.errors;
            entry.summary = Some(summary);
        }
        values
    }

    fn take(&mut self, row: &TableRow<'_>) {
        let place = (row.scene.to_owned(), row.label(), row.eye.to_owned());
        let values = self.places.entry(place).or_default();
        if row.metric != ERROR {
            let (metric, statistic) = (row.metric.to_owned(), row.statistic.to_owned());
            let kind = (metric, statistic, row.image.name().to_owned(), row.level);
            let value = row.value.map(Value::number);
            let (frame, band) = (row.frame, row.band);
            values.rows.entry(kind).or_default().push(ValueRow { frame, band, value });
        }
    }

    fn read_csv(&mut self, folder: &Path, names: CsvNames) -> Result<(), FileError> {
        read_results(folder, names, Which::All, |row| {
            self.take(row);
            Ok(())
        })
    }
}

fn place(comparison: &ComparisonSummary) -> ComparisonName {
    (comparison.scene.clone(), comparison.label(), comparison.eye.clone())
}

/// Checks that the rows of a comparison agree with its summary.
fn agrees(values: &Values, comparison: &ComparisonSummary) -> Result<(), String> {
    let (scene, method) = (&comparison.scene, comparison.label());
    let lacks = |what: &str| format!("its {what} of {scene}, {method} differ from {SUMMARY_JSON}");
    let rows = values.rows.values().flatten();
    let frames: BTreeSet<i64> = rows.filter_map(|row| row.frame).collect();
    if frames.len() != comparison.frames {
        return Err(lacks("frames"));
    }
    let rows = |metric: &str| {
        let kind = (metric.to_owned(), String::new(), "pair".to_owned(), None);
        values.rows.get(&kind).map(Vec::as_slice).unwrap_or_default()
    };
    for (metric, statistics) in &comparison.metrics {
        let whole = rows(metric.key()).iter().filter(|row| row.band.is_none());
        let values: Vec<f64> = whole.filter_map(|row| row.value).collect();
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if min.to_bits() != statistics.min.to_bits() || max.to_bits() != statistics.max.to_bits() {
            return Err(lacks(&format!("values of {}", metric.key())));
        }
    }
    for band in &comparison.bands {
        let edges = [band.from_deg, band.to_deg].map(f64::to_bits);
        let of = |row: &&ValueRow| row.band.is_some_and(|band| band.map(f64::to_bits) == edges);
        let pixels: f64 = rows("pixels").iter().filter(of).filter_map(|row| row.value).sum();
        if pixels as u64 != band.pixels {
            return Err(lacks("pixels"));
        }
    }
    let bands = comparison.bands.len();
    for ((metric, statistic, _, level), rows) in &values.rows {
        if is_double(rows) {
            return Err(format!("a row of {metric} of {scene}, {method} appears twice in it"));
        }
        // Earlier versions wrote no rows for a wavelet orientation in bands that contain no block.
        let seldom = ["_lh", "_hl", "_hh"].iter().any(|of| statistic.ends_with(of))
            // Bands at other eccentricities have other half octaves.
            || (metric == Metric::Spectrum.key() && level.is_some());
        if Subject::find(metric).is_some() && !seldom && lacks_bands(rows, bands) {
            return Err(lacks(&format!("values of {metric}")));
        }
    }
    Ok(())
}

/// Whether a frame has two values of one statistic, for the whole frame or for a band.
fn is_double(rows: &[ValueRow]) -> bool {
    let mut seen = BTreeSet::new();
    !rows.iter().all(|row| seen.insert((row.frame, row.band.map(|band| band.map(f64::to_bits)))))
}

/// Whether a frame has a statistic in some bands, but not in all.
fn lacks_bands(rows: &[ValueRow], bands: usize) -> bool {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    let banded = rows.iter().filter(|row| row.band.is_some());
    for frame in banded.filter_map(|row| row.frame) {
        *counts.entry(frame).or_default() += 1;
    }
    counts.into_values().any(|count| count != bands)
}
