//! The values of single frames, from results.csv.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::Metric;
use fovqa_results::{FileError, RESULTS_CSV};

/// Whole-frame values by scene, method, eye and metric, in the order of the frames.
#[derive(Debug, Default)]
pub(crate) struct FrameValues(BTreeMap<(String, String, String), BTreeMap<Metric, Vec<f64>>>);

impl FrameValues {
    /// Reads them from a folder of results.
    pub(crate) fn read(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(RESULTS_CSV);
        let broken = |detail: String| {
            let path = path.clone();
            FileError::Format { path, expected: "the results of a run", detail }
        };
        let mut reader = csv::Reader::from_path(&path).map_err(|e| broken(e.to_string()))?;
        let headers = reader.headers().map_err(|e| broken(e.to_string()))?.clone();
        let column = |name: &str| {
            let found = headers.iter().position(|header| header == name);
            found.ok_or_else(|| broken(format!("it has no column {name}")))
        };
        let [scene, method, eye, frame, image, metric, statistic, from, value] = [
            column("scene")?,
            column("method")?,
            column("eye")?,
            column("frame")?,
            column("image")?,
            column("metric")?,
            column("statistic")?,
            column("from_deg")?,
            column("value")?,
        ];
        let mut values = Self::default();
        let mut record = csv::StringRecord::new();
        while reader.read_record(&mut record).map_err(|e| broken(e.to_string()))? {
            let cell = |column: usize| record.get(column).unwrap_or_default();
            let whole = !cell(frame).is_empty() && cell(from).is_empty();
            if !whole || !cell(statistic).is_empty() || cell(image) != "pair" {
                continue;
            }
            let metric = Metric::ALL.into_iter().find(|m| m.key() == cell(metric));
            let Some(metric) = metric else { continue };
            let line = record.position().map_or(0, csv::Position::line);
            let value = cell(value)
                .parse::<f64>()
                .map_err(|_| broken(format!("line {line}: {:?} is no number", cell(value))))?;
            let key = (cell(scene).to_owned(), cell(method).to_owned(), cell(eye).to_owned());
            values.0.entry(key).or_default().entry(metric).or_default().push(value);
        }
        Ok(values)
    }

    /// The values of a method in a scene: of both eyes, where there are two.
    pub(crate) fn of(&self, scene: &str, method: &str, metric: Metric) -> Vec<f64> {
        let of_eye = |eye: &str| self.0.get(&(scene.to_owned(), method.to_owned(), eye.to_owned()));
        let values = of_eye("both").or_else(|| of_eye(""));
        values.and_then(|values| values.get(&metric)).cloned().unwrap_or_default()
    }
}
