//! From values to positions along an axis: scales, ticks and the numbers at them.

pub(crate) mod number;
pub(crate) mod scale;
pub(crate) mod ticks;
