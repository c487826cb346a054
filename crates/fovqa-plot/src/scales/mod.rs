//! Converts values to positions along an axis: scales, ticks and their labels.

pub(crate) mod number;
pub(crate) mod scale;
pub(crate) mod ticks;
