//! The layout of a figure: title, legend, margins, and the grid of panels.

pub(crate) mod layout;
pub(crate) mod panel_grid;
