//! What a comparison table shows of each method in each scene.

use fovqa_metrics::{Metric, MetricKind};

use super::measure::Measure;
use crate::overview::Measured;

/// What a table shows of each method in each scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Column {
    /// The values of a metric.
    Metric(Metric),
    /// The samples of emulated methods.
    Samples,
    /// Their quads.
    Quads,
}

impl Column {
    pub(super) fn measure(self) -> Measure {
        match self {
            Self::Metric(metric) => Measure::of_value(metric),
            Self::Samples => Measure::samples(),
            Self::Quads => Measure::quads(),
        }
    }

    pub(super) fn value(self, measured: &Measured) -> Option<f64> {
        match self {
            Self::Metric(metric) => measured.value(metric),
            Self::Samples => measured.samples_percent,
            Self::Quads => measured.quads_percent,
        }
    }

    /// Whether the value is a mean over the values of frames.
    pub(super) fn has_frames(self) -> bool {
        match self {
            Self::Metric(metric) => metric.is(MetricKind::Fidelity) && metric != Metric::Fvvdp,
            Self::Samples | Self::Quads => false,
        }
    }
}
