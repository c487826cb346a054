//! Axes with their titles, ticks and labels, and the colour bar.

pub(crate) mod axis;
pub(crate) mod colour_bar;
pub(crate) mod group_axis;
pub(crate) mod position_axis;
pub(crate) mod value_axis;
