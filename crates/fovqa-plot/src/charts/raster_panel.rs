//! One picture of a quantity over a plane, and its size.

use crate::axes::axis::Axis;
use crate::canvas::colour_map::{self, NO_LEVEL};
use crate::error::PlotError;
use crate::scales::scale::{AxisPlace, Scale};

/// The highest a picture becomes.
const MOST_HEIGHT_PX: f64 = 400.0;
/// The narrowest.
const LEAST_WIDTH_PX: f64 = 140.0;
/// A picture is no more than so many times as long as it is wide.
const MOST_RATIO: f64 = 4.0;

/// One picture: cells of equal size over a part of a plane.
///
/// A degree, or whatever the unit, is as long down as it is across, but where the picture would be
/// more than four times as long as it is wide, or as wide as it is long.
#[derive(Debug, Clone, PartialEq)]
pub struct RasterPanel {
    /// What stands above it.
    pub title: Option<String>,
    /// The axis across.
    pub x: Axis,
    /// The axis down.
    pub y: Axis,
    /// The left and right edge of the cells, in units of the axis.
    pub x_range: (f64, f64),
    /// The upper and lower edge: y may run down, as it does in pictures, or up.
    pub y_range: (f64, f64),
    /// Cells of a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Row by row from the upper left. What is not a number is light gray; infinite values and,
    /// with a logarithm, those not above 0 are beyond the range.
    pub values: Vec<f64>,
    /// Lines over the picture, in units of the axes; without any value none is drawn.
    pub lines: Vec<RasterLine>,
    /// Where the gaze rests, marked with a cross.
    pub cross: Option<(f64, f64)>,
}

/// A line over a picture, such as a ring of equal eccentricity: white with a dark edge, so that it
/// is seen on every colour. The part over the picture is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RasterLine {
    /// A short label at its start, such as "10°", or further along where that would cover another;
    /// none when empty.
    pub name: String,
    /// Its points; one that is not finite parts it.
    pub points: Vec<(f64, f64)>,
}

impl Default for RasterPanel {
    /// No cells over a square of 1.
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

    /// Width and height within a width.
    pub(crate) fn size_px(&self, width_px: f64) -> (f64, f64) {
        let (x, y) = (self.x_range, self.y_range);
        // In halves: a range may be as long as the largest number.
        let ratio = (y.1 / 2.0 - y.0 / 2.0).abs() / (x.1 / 2.0 - x.0 / 2.0);
        let ratio = ratio.clamp(1.0 / MOST_RATIO, MOST_RATIO);
        let width_px = width_px.max(LEAST_WIDTH_PX).min(MOST_HEIGHT_PX / ratio).floor();
        (width_px, width_px * ratio)
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
