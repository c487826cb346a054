//! One picture of a quantity over a plane, and its size.

use crate::axes::axis::Axis;
use crate::canvas::colour_map::{self, NO_LEVEL};
use crate::error::PlotError;
use crate::scales::scale::{AxisPlace, Scale};

/// The largest height of a picture.
const MOST_HEIGHT_PX: f64 = 400.0;
/// The largest ratio of a picture's sides.
const MOST_RATIO: f64 = 4.0;

/// One picture: cells of equal size over a part of a plane.
///
/// A unit is equally long in both directions, unless one side of the picture would then be more
/// than four times as long as the other.
#[derive(Debug, Clone, PartialEq)]
pub struct RasterPanel {
    /// The title above the picture.
    pub title: Option<String>,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The left and right edge of the cells, in units of the axis.
    pub x_range: (f64, f64),
    /// The upper and lower edge of the cells. y may increase downwards, as in pictures, or upwards.
    pub y_range: (f64, f64),
    /// The number of cells in a row.
    pub columns: usize,
    /// The number of rows.
    pub rows: usize,
    /// The values, row by row from the upper left. NaN is light gray. Infinite values and, with a
    /// logarithmic scale, values that are not above 0 are beyond the range.
    pub values: Vec<f64>,
    /// Lines over the picture, in units of the axes. If there is no value, no line is drawn.
    pub lines: Vec<RasterLine>,
    /// Dots over the picture, in units of the axes. Without cells they are on white paper.
    pub dots: Vec<(f64, f64)>,
    /// The position of the gaze, which is marked with a cross.
    pub cross: Option<(f64, f64)>,
}

/// A line over a picture, such as a ring of equal eccentricity. It is white with a dark edge, so
/// that it is visible on every colour. Only the part within the picture is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RasterLine {
    /// A short label such as "10°" at its start, or further along if it would cover another label;
    /// empty for no label.
    pub name: String,
    /// Its points. A point that is not finite interrupts the line.
    pub points: Vec<(f64, f64)>,
}

impl Default for RasterPanel {
    /// A panel without cells, over a square with sides of 1.
    fn default() -> Self {
        Self {
            title: None,
            x: Axis::default(),
            y: Axis::default(),
            x_range: (0.0, 1.0),
            y_range: (0.0, 1.0),
            columns: 0,
            rows: 0,
            values: Vec::new(),
            lines: Vec::new(),
            dots: Vec::new(),
            cross: None,
        }
    }
}

impl RasterPanel {
    pub(crate) fn check(&self) -> Result<(), PlotError> {
        let panel = || self.title.clone().unwrap_or_default();
        if self.columns.checked_mul(self.rows) != Some(self.values.len()) {
            let (found, columns, rows) = (self.values.len(), self.columns, self.rows);
            return Err(PlotError::Cells { panel: panel(), found, columns, rows });
        }
        let (top, bottom) = self.y_range;
        let down = Scale::between((top.min(bottom), top.max(bottom)), false);
        if Scale::between(self.x_range, false).is_none() || down.is_none() {
            return Err(PlotError::Extent { panel: panel() });
        }
        Ok(())
    }

    /// Width and height of the picture within a given width, but not narrower than `least_px`.
    pub(crate) fn size_px(&self, width_px: f64, least_px: f64) -> (f64, f64) {
        let (x, y) = (self.x_range, self.y_range);
        // The division by 2 avoids an overflow: a range may be as long as the largest number.
        let ratio = (y.1 / 2.0 - y.0 / 2.0).abs() / (x.1 / 2.0 - x.0 / 2.0);
        let ratio = ratio.clamp(1.0 / MOST_RATIO, MOST_RATIO);
        let width_px = width_px.max(least_px).min(MOST_HEIGHT_PX / ratio).floor();
        (width_px, width_px * ratio)
    }

    /// Whether it consists of dots alone.
    pub(crate) fn has_only_dots(&self) -> bool {
        self.values.is_empty() && !self.dots.is_empty()
    }

    pub(crate) fn levels(&self, scale: Option<Scale>) -> Vec<u8> {
        let level = |value: &f64| match AxisPlace::of(*value) {
            None => NO_LEVEL,
            Some(AxisPlace::At(value)) => colour_map::level(scale.map_or(0.0, |s| s.share(value))),
            Some(AxisPlace::Above) => colour_map::level(1.0),
            Some(AxisPlace::Below) => colour_map::level(0.0),
        };
        self.values.iter().map(level).collect()
    }
}
