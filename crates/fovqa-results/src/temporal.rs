//! The values of temporal metrics over a whole sequence.

use std::collections::BTreeMap;
use std::fmt;

use fovqa_metrics::{FrameRows, Image, Key, Metric, MetricKind, Pool, Subject};
use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, Visitor};
use serde::ser::{Serialize, Serializer};

use crate::compared::Sides;
use crate::report::{GuideSource, ScoreReport};
use crate::spread::Gathered;

/// A temporal metric over a whole sequence.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct TemporalSummary {
    /// The value of the reference over its frames; `None` if no frame has one.
    pub reference: Option<f64>,
    /// The value of the test over its frames; `None` if no frame has one.
    pub test: Option<f64>,
    /// test / reference, which the papers give as a percentage.
    pub ratio: Option<f64>,
    /// Share of the pixels that were left out, from 0 to 1.
    pub left_out: Option<f64>,
    /// Share of the pixels of the test that were left out, if the test used its own motion or
    /// depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out_test: Option<f64>,
    /// Number of frames that have a value.
    pub frames: usize,
    /// Source of the motion.
    pub motion: GuideSource,
    /// Source of the depth.
    pub depth: GuideSource,
    /// Why a value is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The temporal metrics of a sequence. In JSON each has its own key, beside other keys.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TemporalSummaries(pub BTreeMap<Metric, TemporalSummary>);

impl TemporalSummaries {
    /// The values of a metric; `None` if it was not requested.
    pub fn of(&self, metric: Metric) -> Option<&TemporalSummary> {
        self.0.get(&metric)
    }
}

/// The statistic with the share of pixels that were left out.
pub(crate) fn left_out(metric: Metric) -> Option<Key> {
    Key::named(Subject::Metric(metric), "left_out")
}

/// Collects a temporal metric over the frames.
#[derive(Default)]
pub(crate) struct TemporalValues {
    /// Number of frames that were compared with earlier ones, with or without a value.
    found: usize,
    /// Number of frames that have a value.
    frames: usize,
    sides: Sides<Gathered>,
    left_out: Sides<Pool>,
}

impl TemporalValues {
    pub(crate) fn add(&mut self, metric: Metric, rows: &FrameRows) {
        if !rows.has(metric) {
            return;
        }
        self.found += 1;
        let row = |image| rows.get(Key::of(metric).of_image(image));
        let value = |image| row(image).and_then(|row| row.value);
        if let (Some(reference), Some(test)) = (value(Image::Reference), value(Image::Test)) {
            self.frames += 1;
            self.sides.reference.add(Some(reference));
            self.sides.test.add(Some(test));
        }
        let Some(key) = left_out(metric) else { return };
        let Sides { reference, test } = &mut self.left_out;
        for (pool, image) in [(reference, Image::Reference), (test, Image::Test)] {
            if let Some(row) = rows.get(key.of_image(image)) {
                pool.add(row.value, row.parts);
            }
        }
    }

    pub(crate) fn summary(&self, metric: Metric, report: &ScoreReport) -> TemporalSummary {
        let statistic = Key::of(metric).statistic();
        let sides = self.sides.map(|values| values.headline(statistic));
        let left_out = self.left_out.map(|pool| {
            let key = left_out(metric)?;
            pool.value(key.statistic().frames).0
        });
        let guides = report.guide_sources;
        let own = [guides.motion, guides.depth].contains(&GuideSource::Test);
        let needed = report.frames_needed(metric);
        let reason = match () {
            () if self.frames > 0 => sides.reason(statistic).map(str::to_owned),
            () if report.frames.len() < needed => Some(needs_frames(needed)),
            () if self.found == 0 && needed == 2 => {
                Some("no two of the frames follow each other".to_owned())
            }
            () if self.found == 0 => Some(format!("no {needed} of the frames follow each other")),
            () => Some("no pixel can be compared".to_owned()),
        };
        TemporalSummary {
            reference: sides.reference,
            test: sides.test,
            ratio: sides.ratio(statistic),
            left_out: left_out.reference,
            left_out_test: left_out.test.filter(|_| own),
            frames: self.frames,
            motion: guides.motion,
            depth: guides.depth,
            reason,
        }
    }
}

/// Says that a metric needs more frames than there are.
pub fn needs_frames(frames: usize) -> String {
    if frames == 2 { "needs two frames".to_owned() } else { format!("needs {frames} frames") }
}

impl Serialize for TemporalSummaries {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(metric, summary)| (metric.key(), summary)))
    }
}

impl<'de> Deserialize<'de> for TemporalSummaries {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        /// Takes the keys of temporal metrics and passes over all others.
        struct OfMetrics;
        impl<'de> Visitor<'de> for OfMetrics {
            type Value = TemporalSummaries;

            fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.write_str("temporal metrics")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut found = TemporalSummaries::default();
                while let Some(key) = map.next_key::<String>()? {
                    let metric = Metric::find(&key);
                    match metric.filter(|metric| metric.is(MetricKind::Temporal)) {
                        Some(metric) => drop(found.0.insert(metric, map.next_value()?)),
                        None => drop(map.next_value::<IgnoredAny>()?),
                    }
                }
                Ok(found)
            }
        }
        deserializer.deserialize_map(OfMetrics)
    }
}
