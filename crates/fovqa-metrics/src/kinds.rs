//! What kinds of metrics there are, and which values are better.

/// What a metric measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MetricKind {
    /// A test against its reference: one number.
    Fidelity,
    /// One picture by eccentricity: of reference and test alike, and their ratio.
    Profile,
    /// One sequence over time: of reference and test alike, and their ratio.
    Temporal,
}

/// Which way a metric points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// Larger is better.
    Higher,
    /// Smaller is better.
    Lower,
    /// Neither: the value is compared with that of the reference.
    Neither,
}

/// How many frames of its sequence a metric has to have seen before the one it measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LeadIn {
    /// None: each frame stands by itself.
    None,
    /// The one before.
    Frame,
    /// As many as its filters reach over.
    Filters,
}
