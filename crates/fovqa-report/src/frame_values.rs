//! The values of single frames, from the table of results.

use std::collections::BTreeMap;
use std::path::Path;

use fovqa_metrics::{Image, Key, Metric};
use fovqa_results::{CsvNames, FileError, GAZE_STEP, TableRow, Value, Which, read_results};

/// The name of the number of pixels that are left out, in the table of results.
const PIXELS_LEFT_OUT: &str = "pixels_left_out";

/// Values of whole frames by scene, method and eye, in the order of the frames.
#[derive(Debug, Default)]
pub(crate) struct FrameValues(BTreeMap<(String, String, String), Comparison>);

/// The values of one comparison.
#[derive(Debug, Default)]
struct Comparison {
    /// Values by metric and by image: of the pair, or of one of its images.
    values: BTreeMap<(Metric, Image), Vec<FrameValue>>,
    /// How far the gaze has moved since the previous frame, in degrees.
    gaze_steps: Vec<FrameValue>,
    /// The smallest and the largest number of pixels that masks leave out of a frame.
    left_out: Option<(u64, u64)>,
}

/// A frame's number and a value.
pub(crate) type FrameValue = (i64, f64);

impl FrameValues {
    /// Reads the values from a results folder.
    pub(crate) fn read(folder: &Path, names: CsvNames) -> Result<Self, FileError> {
        let mut values = Self::default();
        read_results(folder, names, Which::WholeFrames, |row| {
            values.take(row);
            Ok(())
        })?;
        Ok(values)
    }

    fn take(&mut self, row: &TableRow<'_>) {
        let (Some(frame), Some(value)) = (row.frame, row.value.map(Value::number)) else { return };
        let known = Metric::ALL.into_iter().find(|m| m.key() == row.metric);
        // If a metric has several statistics per frame, the first one represents it.
        let first = known.map_or("", |metric| Key::of(metric).statistic().name);
        let plain = row.statistic == first && row.level.is_none();
        if row.band.is_some() || !plain || row.image == Image::Ratio {
            return;
        }
        let is_left_out = row.metric == PIXELS_LEFT_OUT;
        if known.is_none() && row.metric != GAZE_STEP && !is_left_out {
            return;
        }
        let key = (row.scene.to_owned(), row.label(), row.eye.to_owned());
        let comparison = self.0.entry(key).or_default();
        match known {
            Some(metric) => {
                comparison.values.entry((metric, row.image)).or_default().push((frame, value));
            }
            None if is_left_out => {
                let (least, most) = comparison.left_out.unwrap_or((u64::MAX, 0));
                comparison.left_out = Some((least.min(value as u64), most.max(value as u64)));
            }
            None => comparison.gaze_steps.push((frame, value)),
        }
    }

    /// Adds made-up values of two frames, for figures that are laid out before anything is scored.
    pub(crate) fn expect(&mut self, scene: &str, method: &str, metrics: &[Metric]) {
        let key = (scene.to_owned(), method.to_owned(), String::new());
        let values = &mut self.0.entry(key).or_default().values;
        for metric in metrics {
            for image in [Image::Pair, Image::Test, Image::Reference] {
                values.insert((*metric, image), vec![(0, 1.0), (1, 2.0)]);
            }
        }
    }

    /// The smallest and the largest number of pixels that masks, and values that are not finite,
    /// leave out of a frame. `eye` is empty if the scene has one image per frame.
    pub(crate) fn pixels_left_out(
        &self,
        scene: &str,
        method: &str,
        eye: &str,
    ) -> Option<(u64, u64)> {
        self.comparison(scene, method, eye)?.left_out
    }

    fn comparison(&self, scene: &str, method: &str, eye: &str) -> Option<&Comparison> {
        self.0.get(&(scene.to_owned(), method.to_owned(), eye.to_owned()))
    }

    /// The values of a method in a scene. If the scene has two eyes, these are the values of both
    /// together.
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

    /// The values of a method in a scene, of one eye; `eye` is empty if the scene has one image per
    /// frame.
    pub(crate) fn of_eye(
        &self,
        (scene, method, eye): (&str, &str, &str),
        (metric, image): (Metric, Image),
    ) -> &[FrameValue] {
        let comparison = self.comparison(scene, method, eye);
        let values = comparison.and_then(|comparison| comparison.values.get(&(metric, image)));
        values.map(Vec::as_slice).unwrap_or_default()
    }

    /// Whether there are values of a frame in any eye; `None` if there are none of single frames.
    pub(crate) fn has_frame(&self, scene: &str, method: &str, frame: i64) -> Option<bool> {
        let eyes = ["both", "", "left", "right"].into_iter();
        let of_eyes = eyes.filter_map(|eye| self.comparison(scene, method, eye));
        let mut values = of_eyes.flat_map(|of| of.values.values().flatten()).peekable();
        values.peek()?;
        Some(values.any(|(number, _)| *number == frame))
    }

    /// The frames in which the gaze of any eye moves by more than `deg` degrees, in order.
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
