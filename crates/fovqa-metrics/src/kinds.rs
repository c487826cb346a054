//! The kinds of metrics, and the directions in which values are better.

/// The kind of a metric.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MetricKind {
    /// Compares a test with its reference and gives one number.
    Fidelity,
    /// Describes one picture by eccentricity. It is measured for reference and test, and reported
    /// with their ratio.
    Profile,
    /// Describes one sequence over time. It is measured for reference and test, and reported with
    /// their ratio.
    Temporal,
}

/// The direction in which a metric's values are better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Larger is better.
    Higher,
    /// Smaller is better.
    Lower,
    /// Neither: the value is compared with that of the reference.
    Neither,
}

/// The number of frames that a metric must have seen before the frame that it measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeadIn {
    /// None: each frame is measured alone.
    None,
    /// The frames that its parameters ask for ([`Params::frames_needed`](crate::Params::frames_needed)).
    Frames,
    /// As many frames as its filters cover.
    Filters,
}
