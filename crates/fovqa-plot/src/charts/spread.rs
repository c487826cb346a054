//! Grouped distributions: how a measure varies over the frames of a sequence.

use crate::axes::axis::{AXIS_STROKE, Axis};
use crate::axes::group_axis::GroupAxis;
use crate::axes::value_axis::ValueAxis;
use crate::canvas::colour::{INK, WHITE};
use crate::canvas::drawing::{Drawing, Point, Rect, Stroke};
use crate::canvas::look::Look;
use crate::canvas::thin::apart;
use crate::charts::box_summary::{BoxSummary, quantile};
use crate::charts::left_out::LeftOut;
use crate::charts::spread_series::{BOX_FROM, SpreadSeries, finite};
use crate::charts::violin::{self, Shape};
use crate::error::PlotError;
use crate::marks::marker;
use crate::marks::swatch;
use crate::page::layout::{self, MARGIN_PX, Sides};
use crate::page::paper::Paper;
use crate::scales::scale::{AxisPlace, Scale};

/// The width of the box inside a violin, as a share of the violin's largest width.
const BOX_IN_VIOLIN: f64 = 0.14;
/// The share of its slot that a box fills.
const FILLED: f64 = 0.72;
/// The largest width of a box.
const MOST_BOX_PX: f64 = 26.0;
/// Space above and below the data, as a share of its range.
const AIR: f64 = 0.06;
/// Radius of the points of a strip, and of an outlier.
const POINT_PX: f64 = 2.6;
const OUTLIER_PX: f64 = 1.7;
/// Width of the line at the median.
const MEDIAN_PX: f64 = 1.8;

/// Groups of distributions, with one distribution per series.
///
/// A distribution of at least ten finite values is a box: median, quartiles (interpolated
/// linearly), whiskers to the farthest value within 1.5 interquartile ranges, and a point for each
/// value beyond. Fewer values are drawn as points in their order, from left to right, with a line
/// at the median. Infinite values are left out, and their number is written: "3 × ∞".
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpreadChart {
    /// The title above the figure.
    pub title: Option<String>,
    /// The vertical axis. It begins where the data begins.
    pub y: Axis,
    /// Names of the groups, from left to right.
    pub groups: Vec<String>,
    /// The series.
    pub series: Vec<SpreadSeries>,
    /// Whether distributions of enough values are violins instead of boxes: a smooth estimate of
    /// their density, with the box inside.
    pub violins: bool,
}

impl SpreadChart {
    pub(crate) fn draw(&self, paper: &Paper) -> Result<Drawing, PlotError> {
        let height_px = paper.plot_height_px;
        for series in &self.series {
            PlotError::check_groups(&series.name, series.values.len(), self.groups.len())?;
        }
        let axis = ValueAxis::new(&self.y, self.axis_range(), height_px);
        let beside_px = axis.left_px() + MARGIN_PX;
        let groups = GroupAxis::new(&self.groups, self.series.len(), beside_px, paper);
        let left_out = LeftOut::of(&self.series, groups.pitch_px());
        let sides = Sides {
            left: axis.left_px(),
            right: MARGIN_PX,
            above: left_out.above_px().max(MARGIN_PX),
            below: left_out.below_px() + groups.below_px(),
        };
        let keys: Vec<_> = self.series.iter().map(|s| (s.name.as_str(), s.key())).collect();
        let (mut drawing, plot) =
            layout::begin(self.title.as_deref(), &keys, sides, (groups.plot_width_px(), height_px));
        axis.draw_grid(&mut drawing, plot);
        axis.draw(&mut drawing, plot, 0.0);
        groups.draw(&mut drawing, plot, left_out.below_px());
        let bottom = plot.bottom;
        drawing.line(&[(plot.left, bottom), (plot.right, bottom)], AXIS_STROKE);
        if self.places().next().is_none() {
            layout::write_no_data(&mut drawing, plot);
        }
        for (s, series) in self.series.iter().enumerate() {
            for (g, values) in series.values.iter().enumerate() {
                let slot = Slot {
                    x: groups.x(plot, g, s),
                    half_px: (groups.pitch_px() * FILLED).min(MOST_BOX_PX) / 2.0,
                    look: series.look,
                    violin: self.violins,
                    y: &|value| axis.y(plot, value),
                    seen: &|value| (0.0..=1.0).contains(&axis.share(value)),
                };
                let on_axis = finite(values).into_iter().filter(|value| self.y.has(*value));
                slot.draw(&mut drawing, &on_axis.collect::<Vec<f64>>());
            }
        }
        left_out.draw(&mut drawing, plot, |group, series| groups.x(plot, group, series));
        Ok(drawing)
    }

    fn places(&self) -> impl Iterator<Item = AxisPlace> {
        let values = self.series.iter().flat_map(|series| series.values.iter().flatten());
        values.copied().filter_map(AxisPlace::of)
    }

    /// The range of the axis; `None` without ends that were set and finite values.
    pub(crate) fn axis_range(&self) -> Option<Scale> {
        let values = self.places().filter_map(AxisPlace::finite);
        let scale = if self.y.log { Scale::holding_log(values) } else { Scale::holding(values) };
        self.y.ranged(scale.map(|scale| scale.with_air(AIR, AIR)))
    }
}

/// The slot of one distribution.
struct Slot<'a> {
    x: f64,
    half_px: f64,
    look: Look,
    violin: bool,
    y: &'a dyn Fn(f64) -> f64,
    /// Whether a value is between the ends of the axis.
    seen: &'a dyn Fn(f64) -> bool,
}

impl Slot<'_> {
    fn draw(&self, drawing: &mut Drawing, values: &[f64]) {
        match BoxSummary::of(values) {
            Some(summary) if values.len() >= BOX_FROM => {
                let shape = if self.violin { violin::shape(values) } else { None };
                match shape {
                    Some(shape) => self.draw_violin(drawing, &shape, &summary),
                    None => self.draw_box(drawing, &summary),
                }
            }
            _ => self.draw_strip(drawing, values),
        }
    }

    fn draw_box(&self, drawing: &mut Drawing, summary: &BoxSummary) {
        let (x, half, edge) = (self.x, self.half_px, swatch::edge(self.look));
        let cap = half / 2.0;
        for (quartile, whisker) in summary.quartiles.iter().zip(&summary.whiskers) {
            let (from, to) = ((self.y)(*quartile), (self.y)(*whisker));
            drawing.line(&[(x, from), (x, to)], edge);
            drawing.line(&[(x - cap, to), (x + cap, to)], edge);
        }
        let [bottom, top] = summary.quartiles.map(self.y);
        let rect = Rect { left: x - half, right: x + half, top, bottom };
        swatch::draw(drawing, rect, self.look, self.look.colour().tint(swatch::TINT));
        self.draw_median(drawing, summary.median);
        let seen = summary.outliers.iter().filter(|value| (self.seen)(**value));
        for y in apart(seen.map(|value| (self.y)(*value)).collect()) {
            drawing.disc((x, y), OUTLIER_PX, self.look.colour());
        }
    }

    /// Draws the density to both sides, with a thin box and the median in the middle.
    fn draw_violin(&self, drawing: &mut Drawing, shape: &Shape, summary: &BoxSummary) {
        let side = |sign: f64| {
            move |(value, density): &(f64, f64)| {
                (self.x + sign * density * self.half_px, (self.y)(*value))
            }
        };
        let right: Vec<Point> = shape.iter().map(side(1.0)).collect();
        let left = shape.iter().rev().map(side(-1.0));
        let mut outline: Vec<Point> = right.into_iter().chain(left).collect();
        drawing.area(outline.clone(), self.look.colour().tint(swatch::TINT));
        outline.push(outline[0]);
        drawing.line(&outline, swatch::edge(self.look));
        let edge = swatch::edge(self.look);
        let [bottom, top] = summary.quartiles.map(self.y);
        let half = (self.half_px * BOX_IN_VIOLIN).max(1.0);
        let rect = Rect { left: self.x - half, right: self.x + half, top, bottom };
        drawing.rect(rect, WHITE, edge);
        let y = (self.y)(summary.median);
        let ends = [(self.x - half, y), (self.x + half, y)];
        drawing.line(&ends, Stroke { colour: INK, width_px: MEDIAN_PX });
    }

    fn draw_strip(&self, drawing: &mut Drawing, values: &[f64]) {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let Some(median) = quantile(&sorted, 0.5) else { return };
        self.draw_median(drawing, median);
        // The points are evenly spaced, so that equal values do not hide each other.
        let wide = (self.half_px - POINT_PX).max(0.0);
        let step = 2.0 * wide / values.len() as f64;
        for (i, value) in values.iter().enumerate().filter(|(_, value)| (self.seen)(**value)) {
            let at: Point = (self.x - wide + (i as f64 + 0.5) * step, (self.y)(*value));
            marker::draw(drawing, at, self.look, POINT_PX, self.look.colour());
        }
    }

    fn draw_median(&self, drawing: &mut Drawing, median: f64) {
        let y = (self.y)(median);
        let ends = [(self.x - self.half_px, y), (self.x + self.half_px, y)];
        drawing.line(&ends, Stroke { colour: INK, width_px: MEDIAN_PX });
    }
}
