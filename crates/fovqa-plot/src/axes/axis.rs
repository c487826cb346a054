//! The description of an axis, and constants that all axes share.

use crate::canvas::colour::{AXIS, GRID};
use crate::canvas::drawing::Stroke;
use crate::scales::scale::Scale;

/// An axis of a figure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// Its title with the unit: "PSNR (dB)", "Eccentricity (°)".
    pub title: String,
    /// Whether it is logarithmic. Values that are not above 0 then leave a gap, and an end that is
    /// not above 0 is ignored.
    pub log: bool,
    /// Its first value; `None` leaves it to the data. An end that is not finite or not below the
    /// other one is ignored.
    pub min: Option<f64>,
    /// Its last value; `None` leaves it to the data.
    pub max: Option<f64>,
}

impl Axis {
    /// A linear axis with a title, whose ends follow from the data.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Whether a value has a place on the axis.
    pub(crate) fn has(&self, value: f64) -> bool {
        !self.log || value > 0.0
    }

    /// The range of the axis: that of the data, with the ends that were set.
    pub(crate) fn ranged(&self, data: Option<Scale>) -> Option<Scale> {
        if self.min.is_none() && self.max.is_none() {
            return data;
        }
        let usual = data.unwrap_or(Scale { log: self.log, ..Scale::even(1.0, 2.0) });
        let (low, high) = match (self.min, self.max) {
            // Where all data are beyond the end that was set, the axis has their length.
            (Some(min), None) if usual.high <= min => (min, beyond(usual, min, 1.0)),
            (None, Some(max)) if usual.low >= max => (beyond(usual, max, -1.0), max),
            (min, max) => (min.unwrap_or(usual.low), max.unwrap_or(usual.high)),
        };
        Scale::between((low, high), self.log).or(data)
    }
}

/// The other end of an axis that begins or ends at a value and is as long as another one.
fn beyond(like: Scale, end: f64, side: f64) -> f64 {
    if like.log {
        let ratio = like.high / like.low;
        if side > 0.0 { end * ratio } else { end / ratio }
    } else {
        end + side * (like.high - like.low)
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
