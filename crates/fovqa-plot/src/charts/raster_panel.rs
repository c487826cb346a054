//! One picture of a quantity over a plane, and its size.

use libm::log10;

use crate::axes::axis::Axis;
use crate::canvas::bitmap::Bitmap;
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
    /// The position of the gaze, or another place, which is marked with a cross.
    pub cross: Option<(f64, f64)>,
    /// The values in a grid, if this is a map over two parameters.
    pub grid: Option<GridPlaces>,
}

/// Where the cells of a map over two parameters are. Each extends half the way to its neighbours, on
/// a logarithmic axis in ratios. The parameters have different units, so that the map fills its place.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GridPlaces {
    /// The value of each column, rising.
    pub x: Vec<f64>,
    /// The value of each row, falling: the largest is at the top.
    pub y: Vec<f64>,
}

/// Height of a map over two parameters over its width.
const MAP_RATIO: f64 = 0.85;
/// Number of cells along each side of the picture of such a map, whose own cells may differ in size.
const FINE: usize = 360;

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
            grid: None,
        }
    }
}

impl RasterPanel {
    /// A map over two parameters, each with at least two different values above 0 if its axis is
    /// logarithmic. `value` returns the value of a column and a row, by their indices.
    pub fn map(
        x: (Axis, &[f64]),
        y: (Axis, &[f64]),
        value: impl Fn(usize, usize) -> Option<f64>,
    ) -> Self {
        let ordered = |values: &[f64]| {
            let mut order: Vec<usize> = (0..values.len()).collect();
            order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
            order
        };
        let (columns, mut rows) = (ordered(x.1), ordered(y.1));
        rows.reverse();
        let at = |(column, row): (&usize, &usize)| value(*column, *row).unwrap_or(f64::NAN);
        let cells = rows.iter().flat_map(|row| columns.iter().map(move |column| (column, row)));
        let values: Vec<f64> = cells.map(at).collect();
        let grid = GridPlaces {
            x: columns.iter().map(|column| x.1[*column]).collect(),
            y: rows.iter().map(|row| y.1[*row]).collect(),
        };
        Self {
            x_range: ends(&grid.x, x.0.log),
            y_range: ends(&grid.y, y.0.log),
            x: x.0,
            y: y.0,
            columns: columns.len(),
            rows: rows.len(),
            values,
            grid: Some(grid),
            ..Self::default()
        }
    }

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
        if self.grid.is_some() {
            let width_px = width_px.max(least_px).min(MOST_HEIGHT_PX / MAP_RATIO).floor();
            return (width_px, (width_px * MAP_RATIO).floor());
        }
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

    /// The colours of its cells, or of the finer cells of a map.
    pub(crate) fn bitmap(&self, scale: Option<Scale>) -> Bitmap {
        let levels = self.levels(scale);
        let Some(grid) = &self.grid else { return Bitmap { columns: self.columns, levels } };
        let across = nearest(&grid.x, self.x_range, self.x.log);
        let down = nearest(&grid.y, self.y_range, self.y.log);
        let mut fine: Vec<u8> = Vec::with_capacity(FINE * FINE);
        for row in down {
            fine.extend(across.iter().map(|column| levels[row * self.columns + column]));
        }
        Bitmap { columns: FINE, levels: fine }
    }

    fn levels(&self, scale: Option<Scale>) -> Vec<u8> {
        let level = |value: &f64| match AxisPlace::of(*value) {
            None => NO_LEVEL,
            Some(AxisPlace::At(value)) => colour_map::level(scale.map_or(0.0, |s| s.share(value))),
            Some(AxisPlace::Above) => colour_map::level(1.0),
            Some(AxisPlace::Below) => colour_map::level(0.0),
        };
        self.values.iter().map(level).collect()
    }
}

/// A value as it is placed along an axis.
pub(crate) fn along(value: f64, log: bool) -> f64 {
    if log { log10(value) } else { value }
}

/// The edges of the first and of the last cell.
fn ends(values: &[f64], log: bool) -> (f64, f64) {
    let placed: Vec<f64> = values.iter().map(|value| along(*value, log)).collect();
    let (Some(first), Some(last)) = (placed.first(), placed.last()) else { return (0.0, 1.0) };
    let step = |pair: Option<&[f64]>| pair.map_or(1.0, |pair| pair[1] - pair[0]);
    let (before, after) = (step(placed.windows(2).next()), step(placed.windows(2).last()));
    let back = |placed: f64| if log { libm::pow(10.0, placed) } else { placed };
    (back(first - before / 2.0), back(last + after / 2.0))
}

/// The index of the value that is nearest to each of the fine cells of an axis.
fn nearest(values: &[f64], (from, to): (f64, f64), log: bool) -> Vec<usize> {
    let placed: Vec<f64> = values.iter().map(|value| along(*value, log)).collect();
    let (from, to) = (along(from, log), along(to, log));
    let cell = |fine: usize| {
        let at = from + (to - from) * (fine as f64 + 0.5) / FINE as f64;
        let distance = |index: &usize| (placed[*index] - at).abs();
        let nearest = (0..placed.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.unwrap_or(0)
    };
    (0..FINE).map(cell).collect()
}
