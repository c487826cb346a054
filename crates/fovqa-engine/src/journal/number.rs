//! Numbers in a journal: whatever a measure can be, infinite or none at all too.

pub(super) use fovqa_results::Number;

/// A number that may not be there.
pub(super) fn maybe(number: Option<f64>) -> Option<Number> {
    number.map(Number)
}

/// The same, read again.
pub(super) fn read(number: Option<Number>) -> Option<f64> {
    number.map(|number| number.0)
}
