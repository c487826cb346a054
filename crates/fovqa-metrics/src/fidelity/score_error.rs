//! Errors of pairs that cannot be scored.

use thiserror::Error;

use crate::metric::Metric;
use crate::row::Image;

/// A pair that a metric cannot score.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScoreError {
    /// The picture is smaller than the metric's window.
    #[error("{} needs {needed} pixels on each side; the frame has {width}x{height}", metric.info().label)]
    TooSmall {
        /// The metric.
        metric: Metric,
        /// Width of the frame.
        width: usize,
        /// Height of the frame.
        height: usize,
        /// The smallest side, in pixels.
        needed: usize,
    },
    /// The metric is not defined where pixels are left out.
    #[error("{} is not defined where pixels are left out", metric.info().label)]
    Masked {
        /// The metric.
        metric: Metric,
    },
    /// The mask has no pixel.
    #[error("the mask leaves no pixel to score")]
    NothingLeft,
    /// The mask has no complete window.
    #[error("the mask leaves no complete window for {}", metric.info().label)]
    NoWindow {
        /// The metric.
        metric: Metric,
    },
    /// The mask leaves fewer than two values.
    #[error("the mask leaves fewer than two complete {what} for {}", metric.info().label)]
    TooFew {
        /// The metric.
        metric: Metric,
        /// What its values describe, in words.
        what: &'static str,
    },
    /// The pair does not fit the metric for a reason of its own.
    #[error("{}: {reason}", metric.info().label)]
    Unfit {
        /// The metric.
        metric: Metric,
        /// The picture that does not fit.
        image: Image,
        /// What does not fit.
        reason: String,
        /// How to mend it.
        help: &'static str,
    },
    /// A foveal metric has no weight.
    #[error("{} needs a view", metric.info().label)]
    NoView {
        /// The metric.
        metric: Metric,
    },
}
