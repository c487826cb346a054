//! A metric frame by frame. The frames in which the gaze jumps are marked (Patney et al. 2016, Fig.
//! 12).

use fovqa_metrics::{Image, Metric, MetricKind};
use fovqa_plot::{Axis, Figure, LineChart, LineSeries, Span};

use super::{NamedFigure, Selection, frame_axis, slug};
use crate::frame_values::FrameValue;

/// Gaze movement per frame, in degrees, above which the eye is in a saccade. At 72 frames per
/// second this is 144° per second, which no smooth pursuit reaches.
const SACCADE_DEG: f64 = 2.0;

impl Selection<'_> {
    /// One figure per scene.
    pub(super) fn sequences(&self, metric: Metric) -> Vec<NamedFigure> {
        self.scenes.iter().filter_map(|scene| self.sequence(metric, scene)).collect()
    }

    fn sequence(&self, metric: Metric, scene: &str) -> Option<NamedFigure> {
        let values = |method: &str, image| self.source.values.of(scene, method, (metric, image));
        let alike = metric.is(MetricKind::Fidelity);
        let mut series = Vec::new();
        let mut jumps = Vec::new();
        let mut reference: &[FrameValue] = &[];
        for &(method, look) in &self.methods {
            let frames = values(method, if alike { Image::Pair } else { Image::Test });
            if frames.is_empty() {
                continue;
            }
            let (name, points) = (method.to_owned(), points(frames));
            series.push(LineSeries { name, look, points, ..LineSeries::default() });
            jumps.extend(self.source.values.jumps(scene, method, SACCADE_DEG));
            if reference.is_empty() {
                reference = values(method, Image::Reference);
            }
        }
        if series.is_empty() {
            return None;
        }
        if !reference.is_empty() {
            let (name, points) = ("reference".to_owned(), points(reference));
            series.push(LineSeries { name, reference: true, points, ..LineSeries::default() });
        }
        let spans = spans(jumps);
        let marked = if spans.is_empty() { "" } else { ", saccades (over 2° in a frame) marked" };
        let name = format!("sequence-{}", slug(metric.key()));
        let name = if self.scenes.len() == 1 { name } else { format!("{name}-{}", slug(scene)) };
        let caption = format!("{} over the frames, {scene}{marked}", metric.info().label);
        let figure = Figure::Line(LineChart {
            title: self.title(scene),
            x: Axis::new("Frame"),
            y: Axis::new(frame_axis(metric)),
            series,
            y_from_zero: !alike,
            spans,
            ..LineChart::default()
        });
        Some(NamedFigure::new(name, caption, figure))
    }
}

fn points(frames: &[FrameValue]) -> Vec<(f64, Option<f64>)> {
    frames.iter().map(|(frame, value)| (*frame as f64, Some(*value))).collect()
}

/// Combines consecutive frames into spans that extend half a frame to each side.
fn spans(mut frames: Vec<i64>) -> Vec<Span> {
    frames.sort_unstable();
    frames.dedup();
    let mut spans: Vec<Span> = Vec::new();
    for frame in frames {
        let (from, to) = (frame as f64 - 0.5, frame as f64 + 0.5);
        match spans.last_mut() {
            Some(last) if last.to >= from => last.to = to,
            _ => spans.push(Span { name: "saccade".to_owned(), from, to }),
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_in_a_row_are_one_saccade() {
        let ends = |frames: &[i64]| -> Vec<(f64, f64)> {
            spans(frames.to_vec()).iter().map(|span| (span.from, span.to)).collect()
        };
        assert_eq!(ends(&[9, 7, 8, 8, 20]), [(6.5, 9.5), (19.5, 20.5)]);
        assert!(ends(&[]).is_empty());
    }
}
