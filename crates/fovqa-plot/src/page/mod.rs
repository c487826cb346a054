//! The layout of a figure: paper, title, legend, margins, and the grid of panels.

pub(crate) mod fitting;
pub(crate) mod layout;
pub(crate) mod panel_grid;
pub(crate) mod paper;
pub(crate) mod style;
