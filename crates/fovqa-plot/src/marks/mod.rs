//! The marks in a plot: markers, swatches, areas, labels, and the legend that explains them.

pub(crate) mod bracket;
pub(crate) mod error_bar;
pub(crate) mod fill;
pub(crate) mod fill_kind;
pub(crate) mod hatch;
pub(crate) mod infinity;
pub(crate) mod legend;
pub(crate) mod marker;
pub(crate) mod span;
pub(crate) mod swatch;
pub(crate) mod value_label;
