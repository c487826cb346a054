//! The values of single frames, from results.csv.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::Metric;
use fovqa_results::{FileError, RESULTS_CSV, open_result_file};

/// Whole-frame values by scene, method and eye, in the order of the frames.
#[derive(Debug, Default)]
pub(crate) struct FrameValues(BTreeMap<(String, String, String), Comparison>);

/// Those of one comparison.
#[derive(Debug, Default)]
struct Comparison {
    /// By metric and image: of the pair, or of one of its pictures.
    values: BTreeMap<(Metric, Image), Vec<FrameValue>>,
    /// How far the gaze has moved since the frame before, degrees.
    gaze_steps: Vec<FrameValue>,
}

/// A frame's number and a value.
pub(crate) type FrameValue = (i64, f64);

/// What a value is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Image {
    Pair,
    Reference,
    Test,
}

impl FrameValues {
    /// Reads them from a folder of results.
    pub(crate) fn read(folder: &Path) -> Result<Self, FileError> {
        let path = folder.join(RESULTS_CSV);
        let broken = |detail: String| {
            let path = path.clone();
            FileError::Format { path, expected: "the results of a run", detail }
        };
        let mut reader = csv::Reader::from_reader(open_result_file(&path)?);
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
            // Of what has several statistics a frame, this one stands for it.
            let plain = match cell(metric) {
                "fvvdp" => cell(statistic) == "frame_jod",
                _ => cell(statistic).is_empty(),
            };
            if !whole || !plain || cell(value).is_empty() {
                continue;
            }
            let image = match cell(image) {
                "pair" => Image::Pair,
                "reference" => Image::Reference,
                "test" => Image::Test,
                _ => continue,
            };
            let known = Metric::ALL.into_iter().find(|m| m.key() == cell(metric));
            let gaze_step = cell(metric) == "gaze_step_deg";
            if known.is_none() && !gaze_step {
                continue;
            }
            let line = record.position().map_or(0, csv::Position::line);
            let no_number = |cell: &str| broken(format!("line {line}: {cell:?} is no number"));
            let number = cell(value).parse::<f64>().map_err(|_| no_number(cell(value)))?;
            let frame = cell(frame).parse::<i64>().map_err(|_| no_number(cell(frame)))?;
            let key = (cell(scene).to_owned(), cell(method).to_owned(), cell(eye).to_owned());
            let comparison = values.0.entry(key).or_default();
            match known {
                Some(metric) => {
                    comparison.values.entry((metric, image)).or_default().push((frame, number));
                }
                None => comparison.gaze_steps.push((frame, number)),
            }
        }
        Ok(values)
    }

    fn comparison(&self, scene: &str, method: &str, eye: &str) -> Option<&Comparison> {
        self.0.get(&(scene.to_owned(), method.to_owned(), eye.to_owned()))
    }

    /// The values of a method in a scene: of both eyes, where there are two.
    pub(crate) fn of(
        &self,
        scene: &str,
        method: &str,
        (metric, image): (Metric, Image),
    ) -> &[FrameValue] {
        let of_eye = |eye: &str| self.comparison(scene, method, eye);
        let comparison = of_eye("both").or_else(|| of_eye(""));
        let values = comparison.and_then(|comparison| comparison.values.get(&(metric, image)));
        values.map(Vec::as_slice).unwrap_or_default()
    }

    /// The frames in which the gaze of any eye jumps farther than `deg`, in order.
    pub(crate) fn jumps(&self, scene: &str, method: &str, deg: f64) -> Vec<i64> {
        let eyes = ["", "left", "right"].into_iter();
        let steps = eyes.filter_map(|eye| self.comparison(scene, method, eye));
        let far = steps.flat_map(|comparison| &comparison.gaze_steps).filter(|step| step.1 > deg);
        let mut frames: Vec<i64> = far.map(|(frame, _)| *frame).collect();
        frames.sort_unstable();
        frames.dedup();
        frames
    }
}
