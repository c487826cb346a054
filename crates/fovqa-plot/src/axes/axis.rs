//! What the caller says of an axis, and what all axes share.

use crate::canvas::drawing::Stroke;
use crate::canvas::look::{AXIS, GRID};

/// An axis of a figure.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Axis {
    /// What it shows, with the unit: "PSNR (dB)", "Eccentricity (°)".
    pub title: String,
}

impl Axis {
    /// An axis of a title.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into() }
    }
}

/// Length of a tick, outside of the plot area.
pub(crate) const TICK_LENGTH_PX: f64 = 4.0;
/// From a tick to its label.
pub(crate) const LABEL_GAP_PX: f64 = 3.0;
/// From the labels to the axis' title.
pub(crate) const TITLE_GAP_PX: f64 = 5.0;

/// Axis lines and ticks.
pub(crate) const AXIS_STROKE: Stroke = Stroke { colour: AXIS, width_px: 1.0 };
/// Lines of the grid.
pub(crate) const GRID_STROKE: Stroke = Stroke { colour: GRID, width_px: 0.8 };
