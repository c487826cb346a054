//! The description of an axis, and constants that all axes share.

use crate::canvas::drawing::Stroke;
use crate::canvas::look::{AXIS, GRID};

/// An axis of a figure.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Axis {
    /// Its title with the unit: "PSNR (dB)", "Eccentricity (°)".
    pub title: String,
}

impl Axis {
    /// An axis with a title.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into() }
    }
}

/// Length of a tick, outside the plot area.
pub(crate) const TICK_LENGTH_PX: f64 = 4.0;
/// Distance from a tick to its label.
pub(crate) const LABEL_GAP_PX: f64 = 3.0;
/// Distance from the labels to the axis' title.
pub(crate) const TITLE_GAP_PX: f64 = 5.0;

/// The stroke of axis lines and ticks.
pub(crate) const AXIS_STROKE: Stroke = Stroke { colour: AXIS, width_px: 1.0 };
/// The stroke of grid lines.
pub(crate) const GRID_STROKE: Stroke = Stroke { colour: GRID, width_px: 0.8 };
