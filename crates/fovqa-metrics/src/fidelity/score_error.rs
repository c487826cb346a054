//! Why a pair has no score.

use thiserror::Error;

use crate::metric::Metric;

/// A pair that a metric cannot score.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ScoreError {
    /// A picture smaller than the metric's window.
    #[error("{} needs {needed} pixels on each side; the frame has {width}x{height}", metric.info().label)]
    TooSmall {
        /// The metric.
        metric: Metric,
        /// Width of the frame.
        width: usize,
        /// Height of the frame.
        height: usize,
        /// Smallest side.
        needed: usize,
    },
    /// A metric that is not defined where pixels are left out.
    #[error("{} is not defined where pixels are left out", metric.info().label)]
    Masked {
        /// The metric.
        metric: Metric,
    },
    /// A mask without a pixel.
    #[error("the mask leaves no pixel to score")]
    NothingLeft,
    /// A mask without a whole window.
    #[error("the mask leaves no whole window for {}", metric.info().label)]
    NoWindow {
        /// The metric.
        metric: Metric,
    },
    /// A mask that leaves fewer than two values.
    #[error("the mask leaves fewer than two whole {what} for {}", metric.info().label)]
    TooFew {
        /// The metric.
        metric: Metric,
        /// What its values are of, in words.
        what: &'static str,
    },
    /// A foveal metric without a weight.
    #[error("{} needs a view", metric.info().label)]
    NoView {
        /// The metric.
        metric: Metric,
    },
}
