//! How the values of eccentricity bands vary over the frames, from the table of results.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::{Image, Key, Metric};
use fovqa_plan::ErrorBars;
use fovqa_results::{CsvNames, FileError, TableRow, Value, Which, read_results};

use crate::moments::Moments;

/// What is measured in a band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InBand<'a> {
    pub(crate) metric: Metric,
    pub(crate) image: Image,
    /// Level of the wavelet, from 1.
    pub(crate) level: Option<i64>,
    /// Statistic of the wavelet; `None` for a metric's own value.
    pub(crate) statistic: Option<&'a str>,
    pub(crate) from_deg: f64,
    pub(crate) to_deg: f64,
}

/// Metric, image, level and statistic of values, and the edges of their band, bit by bit.
type Place = (Metric, Image, Option<i64>, String, [u64; 2]);

/// The moments over the frames, by scene and method, and by eye.
#[derive(Debug, Default)]
pub(crate) struct BandSpread(BTreeMap<[String; 3], BTreeMap<Place, Moments>>);

impl BandSpread {
    /// Reads the values of all bands from a results folder.
    pub(crate) fn read(folder: &Path, names: CsvNames) -> Result<Self, FileError> {
        let mut spread = Self::default();
        read_results(folder, names, Which::All, |row| {
            spread.take(row);
            Ok(())
        })?;
        Ok(spread)
    }

    fn take(&mut self, row: &TableRow<'_>) {
        let (Some(band), Some(value)) = (row.band, row.value.map(Value::number)) else { return };
        let Some(metric) = Metric::ALL.into_iter().find(|m| m.key() == row.metric) else { return };
        if row.frame.is_none() || !value.is_finite() {
            return;
        }
        let of = [row.scene.to_owned(), row.label(), row.eye.to_owned()];
        let place =
            (metric, row.image, row.level, row.statistic.to_owned(), band.map(f64::to_bits));
        self.0.entry(of).or_default().entry(place).or_default().add(value);
    }

    /// Half the length of the error bar of a band's mean over the frames. If the scene has two
    /// eyes, it is that of both together.
    pub(crate) fn half_length(
        &self,
        (scene, method): (&str, &str),
        band: InBand<'_>,
        kind: ErrorBars,
    ) -> Option<f64> {
        let of_eye = |eye: &str| self.0.get(&[scene, method, eye].map(str::to_owned));
        let values = of_eye("both").or_else(|| of_eye(""))?;
        let statistic = band.statistic.unwrap_or_else(|| Key::of(band.metric).statistic().name);
        let edges = [band.from_deg, band.to_deg].map(f64::to_bits);
        let place = (band.metric, band.image, band.level, statistic.to_owned(), edges);
        values.get(&place)?.half_length(kind)
    }
}
