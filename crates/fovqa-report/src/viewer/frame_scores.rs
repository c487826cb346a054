//! The scores of the frames that have pictures, whole and by band, from the table of all values.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use fovqa_metrics::{Image, Key, Metric, MetricKind};
use fovqa_params::Words;
use fovqa_results::{
    CsvNames, FileError, ImagesRecord, RunRecord, TableRow, Value, Which, read_results,
};

/// The scores of frames.
#[derive(Debug, Default)]
pub(super) struct FrameScores(BTreeMap<Place, Scores>);

/// Scene, eye, method and frame.
type Place = (String, String, String, i64);

/// The scores of a frame.
#[derive(Debug, Default)]
pub(super) struct Scores {
    pub(super) whole: BTreeMap<&'static str, f64>,
    /// By the lower edge of the band in degrees, as bits: edges are compared exactly.
    bands: BTreeMap<u64, BTreeMap<&'static str, f64>>,
}

impl FrameScores {
    pub(super) fn read(
        folder: &Path,
        run: &RunRecord,
        record: &ImagesRecord,
    ) -> Result<Self, FileError> {
        let wanted: BTreeSet<(&str, &str, i64)> = record
            .views
            .iter()
            .flat_map(|view| {
                let eye = view.eye.map(Words::word).unwrap_or_default();
                view.frames.iter().map(move |chosen| (view.scene.as_str(), eye, chosen.frame))
            })
            .collect();
        let mut scores = Self::default();
        read_results(folder, CsvNames::from(&run.resolved), Which::All, |row| {
            if row.frame.is_some_and(|frame| wanted.contains(&(row.scene, row.eye, frame))) {
                scores.take(row);
            }
            Ok(())
        })?;
        Ok(scores)
    }

    fn take(&mut self, row: &TableRow<'_>) {
        let Some(metric) = Metric::ALL.into_iter().find(|m| m.key() == row.metric) else { return };
        // A measure of each image is shown by its ratio.
        let image = if metric.is(MetricKind::Fidelity) { Image::Pair } else { Image::Ratio };
        let first = Key::of(metric).statistic().name;
        let is_shown = row.image == image && row.statistic == first && row.level.is_none();
        let (Some(frame), Some(value)) = (row.frame, row.value.map(Value::number)) else { return };
        if !is_shown {
            return;
        }
        let place = (row.scene.to_owned(), row.eye.to_owned(), row.label(), frame);
        let scores = self.0.entry(place).or_default();
        match row.band {
            None => scores.whole.insert(metric.key(), value),
            Some([from, _]) => {
                scores.bands.entry(from.to_bits()).or_default().insert(metric.key(), value)
            }
        };
    }

    /// The scores of a frame; `None` if there are none.
    pub(super) fn of(&self, scene: &str, eye: &str, method: &str, frame: i64) -> Option<&Scores> {
        self.0.get(&(scene.to_owned(), eye.to_owned(), method.to_owned(), frame))
    }
}

impl Scores {
    /// The scores in the band from this edge in degrees.
    pub(super) fn band(&self, from_deg: f64) -> BTreeMap<&'static str, f64> {
        self.bands.get(&from_deg.to_bits()).cloned().unwrap_or_default()
    }
}
