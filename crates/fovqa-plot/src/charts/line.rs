//! Curves over a horizontal axis: a measure over eccentricity, frame or parameter.

use std::collections::BTreeMap;

use crate::axes::axis::Axis;
use crate::axes::position_axis::PositionAxis;
use crate::axes::value_axis::ValueAxis;
use crate::canvas::clip;
use crate::canvas::colour::REFERENCE;
use crate::canvas::drawing::{Drawing, Point, Rect, Stroke};
use crate::canvas::look::Look;
use crate::canvas::smooth;
use crate::canvas::thin::thinned;
use crate::charts::dodge;
use crate::marks::error_bar;
use crate::marks::fill::Fill;
use crate::marks::fill_kind::FillKind;
use crate::marks::infinity;
use crate::marks::legend::{self, CURVE_PX, Key, REFERENCE_PX};
use crate::marks::marker;
use crate::marks::span::{self, Span};
use crate::marks::value_label::Side;
use crate::page::layout::{self, MARGIN_PX, Sides};
use crate::page::paper::Paper;
use crate::scales::scale::{AxisPlace, Scale};

/// Space above and below the data, as a share of its range.
const AIR: f64 = 0.06;
/// Space beside the data if no ticks are given, as a share of its range.
const SIDE_AIR: f64 = 0.02;
/// The smallest distance of markers along a curve. If points are denser, only some of them have
/// one.
const MARKER_PITCH_PX: f64 = 12.0;
/// The smallest number of given ticks on an axis whose ends were set.
const FEWEST_TICKS: usize = 4;
/// The outer and the inner radius of a ring, and of a small one.
const RING_PX: [(f64, f64); 2] = [(7.2, 6.0), (5.2, 4.2)];
/// The radius of a dot.
pub(crate) const DOT_PX: f64 = 2.2;
/// Distance between the markers of infinite values of two series at the same position.
const BESIDE_PX: f64 = 9.0;

/// Curves, each through points with rising `x`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineChart {
    /// The title above the figure.
    pub title: Option<String>,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis. It begins where the data begins, unless
    /// [`y_from_zero`](Self::y_from_zero) is set: the slope and distance of curves are read, not
    /// their height. At ends that were set, of either axis, curves and areas are cut off, and
    /// points beyond them have no marker.
    pub y: Axis,
    /// The curves in drawing order; the first one is behind all others.
    pub series: Vec<LineSeries>,
    /// The ticks of the horizontal axis, for example the edges of bands; `None` means round
    /// numbers. If an end of the axis was set and fewer than four of them remain, it has round
    /// numbers instead.
    pub x_ticks: Option<Vec<f64>>,
    /// Whether the vertical axis includes 0, and begins there if no value is below.
    pub y_from_zero: bool,
    /// Stretches of the horizontal axis to shade.
    pub spans: Vec<Span>,
    /// Areas between two curves, behind the curves. They are not data: neither the axes nor the
    /// [CSV](crate::Figure::csv) include them, because their edges are curves of the chart.
    pub fills: Vec<Fill>,
}

/// One curve.
#[allow(clippy::struct_excessive_bools, reason = "each is a choice of its own")]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LineSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its look.
    pub look: Look,
    /// Whether it is a reference curve, with which others are compared. It is gray, dashed and
    /// without markers.
    pub reference: bool,
    /// Whether it is a densely sampled function, whose points are not single data values. Some
    /// markers along the curve identify it. Markers of coinciding curves do not coincide.
    pub smooth: bool,
    /// Half the length of the error bar of each point, in their order; empty for none. A point
    /// without a finite one has no error bar. Where the error bars of several series are at one
    /// position, the series are drawn a few pixels apart.
    pub errors: Vec<Option<f64>>,
    /// The lower and the upper end of the interval of each point, in their order, in place of
    /// [`errors`](Self::errors); empty for none. An infinite end is drawn to the border.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// Whether its points are small dots without a line, such as positions of samples.
    pub dots: bool,
    /// Whether its points are markers without a line, such as single measured values. They stay at
    /// their positions, even if error bars of several series meet.
    pub scatter: bool,
    /// Whether its line has no markers, for example because markers would be mistaken for values.
    /// Points between two gaps keep theirs.
    pub unmarked: bool,
    /// Whether its points are rings without a line, which point out points of a curve that follows.
    /// With [`dots`](Self::dots), the rings are small, as dots are.
    pub rings: bool,
    /// Whether the legend leaves it out, because it belongs to another series or area.
    pub unlisted: bool,
    /// Points in the order of the curve. `None` and NaN leave a gap. An infinite value is drawn at
    /// the border, unconnected, with an "∞" beyond it. Points without a finite `x` are not drawn.
    pub points: Vec<(f64, Option<f64>)>,
}

impl LineSeries {
    fn key(&self) -> Key {
        match self {
            Self { reference: true, .. } => Key::Reference(self.look),
            Self { rings: true, dots, .. } => Key::Ring(self.look, ring_px(*dots)),
            Self { dots: true, .. } => Key::Dot(self.look),
            Self { scatter: true, .. } => Key::Marker(self.look),
            Self { unmarked: true, .. } => Key::Line(self.look),
            _ => Key::Curve(self.look),
        }
    }

    fn places(&self) -> impl Iterator<Item = (f64, Option<AxisPlace>)> {
        let at = |&(x, y): &(f64, Option<f64>)| Some((finite(x)?, y.and_then(AxisPlace::of)));
        self.points.iter().filter_map(at)
    }

    /// The ends of the error bars: a position, and the lower and upper value.
    fn error_bars(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        let ends = |(&(x, y), error): (&(f64, Option<f64>), &Option<f64>)| {
            let (x, y, error) = (finite(x)?, finite(y?)?, finite((*error)?)?);
            Some((x, finite(y - error.abs())?, finite(y + error.abs())?))
        };
        let of_interval = |(&(x, _), interval): (&(f64, Option<f64>), &Option<[f64; 2]>)| {
            let [low, high] = (*interval)?;
            Some((finite(x)?, low, high)).filter(|_| low <= high)
        };
        let intervals = self.points.iter().zip(&self.intervals).filter_map(of_interval);
        self.points.iter().zip(&self.errors).filter_map(ends).chain(intervals)
    }

    fn stroke(&self) -> Stroke {
        if self.reference {
            Stroke { colour: REFERENCE, width_px: REFERENCE_PX }
        } else {
            Stroke { colour: self.look.colour(), width_px: CURVE_PX }
        }
    }
}

/// The area in which a chart is drawn.
pub(crate) struct Frame<'a> {
    pub(crate) x: &'a PositionAxis,
    pub(crate) y: &'a ValueAxis,
    pub(crate) plot: Rect,
    /// Left edge of the area of the chart.
    pub(crate) edge_px: f64,
    /// Height of the strip between the plot area and the labels below it.
    pub(crate) below_px: f64,
}

impl LineChart {
    pub(crate) fn draw(&self, paper: &Paper) -> Drawing {
        let height_px = paper.plot_height_px;
        let y = ValueAxis::new(&self.y, self.y_scale(), height_px);
        let left = y.left_px();
        let room = (paper.column_px - left, paper.least_plot_px());
        let x = PositionAxis::new(&self.x, self.x_scale(), self.x_ticks(), room);
        let (above, below) = self.strips_px();
        let sides = Sides {
            left: left.max(x.left_px()),
            right: x.right_px(),
            above: above.max(MARGIN_PX),
            below: below + x.below_px(),
        };
        let areas = legend::once(self.fill_keys()).chain(legend::once(self.span_keys()));
        let keys: Vec<_> = self.series_keys().chain(areas).collect();
        let (mut drawing, plot) =
            layout::begin(self.title.as_deref(), &keys, sides, (x.plot_width_px(), height_px));
        self.draw_in(&mut drawing, &Frame { x: &x, y: &y, plot, edge_px: 0.0, below_px: below });
        drawing
    }

    /// The looks of its series and bands.
    pub(crate) fn looks(&mut self) -> impl Iterator<Item = &mut Look> {
        let bands = self.fills.iter_mut().filter_map(|fill| match &mut fill.kind {
            FillKind::Band(look) => Some(look),
            FillKind::Surplus | FillKind::Deficit => None,
        });
        self.series.iter_mut().map(|series| &mut series.look).chain(bands)
    }

    pub(crate) fn series_keys(&self) -> impl Iterator<Item = (&str, Key)> {
        let listed = self.series.iter().filter(|series| !series.unlisted);
        listed.map(|series| (series.name.as_str(), series.key()))
    }

    /// The legend keys of all visible spans.
    pub(crate) fn span_keys(&self) -> impl Iterator<Item = (&str, Key)> {
        let scale = self.x_scale();
        let seen = move |span: &&Span| scale.is_some_and(|scale| span.ends(scale).is_some());
        self.spans.iter().filter(seen).map(Span::key)
    }

    /// The legend keys of all visible areas.
    pub(crate) fn fill_keys(&self) -> impl Iterator<Item = (&str, Key)> {
        let scales = self.x_scale().zip(self.y_scale());
        let seen = move |fill: &&Fill| scales.is_some_and(|(x, y)| !fill.areas(x, y).is_empty());
        self.fills.iter().filter(seen).map(Fill::key)
    }

    /// Heights of the strips for infinite values above and below the plot area.
    pub(crate) fn strips_px(&self) -> (f64, f64) {
        infinity::strips_px(self.drawn())
    }

    /// Draws everything except title and legend.
    pub(crate) fn draw_in(&self, drawing: &mut Drawing, frame: &Frame<'_>) {
        let Frame { x, y, plot, .. } = *frame;
        for (from, to) in self.x_scale().into_iter().flat_map(|scale| self.span_ends(scale)) {
            span::draw(drawing, plot, (x.x(plot, from), x.x(plot, to)));
        }
        y.draw_grid(drawing, plot);
        self.draw_fills(drawing, plot);
        y.draw(drawing, plot, frame.edge_px);
        x.draw(drawing, plot, frame.below_px);
        if self.drawn().next().is_none() {
            layout::write_no_data(drawing, plot);
        }
        let at = |position: f64, place: Option<AxisPlace>| {
            let value = place.and_then(AxisPlace::finite)?;
            Some((x.share(position), y.share(value)))
        };
        let shifts_px = self.shifts_px(x, plot);
        for (series, shift_px) in self.series.iter().zip(shifts_px) {
            self.draw_error_bars(drawing, (series, shift_px), plot, frame);
            let points: Vec<_> = self.places(series).map(|(x, place)| at(x, place)).collect();
            // The whole curve is moved, so that its points stay on it.
            let first = drawing.marks.len();
            draw_curve(drawing, series, &points, plot);
            drawing.shift_from(first, shift_px);
        }
        self.draw_infinite(drawing, plot, x);
    }

    /// How far each series is moved sideways, so that error bars at one position do not hide each
    /// other.
    fn shifts_px(&self, x: &PositionAxis, plot: Rect) -> Vec<f64> {
        let at = |(position, ..): (f64, f64, f64)| {
            let seen = self.x.has(position) && (0.0..=1.0).contains(&x.share(position));
            seen.then(|| x.x(plot, position) - plot.left)
        };
        let bars = |series: &LineSeries| {
            let bars = series.error_bars().filter(|_| !series.scatter);
            bars.filter_map(at).collect()
        };
        let curves: Vec<Vec<f64>> = self.series.iter().map(bars).collect();
        dodge::shifts_px(&curves, plot.width())
    }

    /// Draws the error bars of a series, cut off at the ends of the axis.
    fn draw_error_bars(
        &self,
        drawing: &mut Drawing,
        (series, shift_px): (&LineSeries, f64),
        plot: Rect,
        frame: &Frame<'_>,
    ) {
        for (x, low, high) in series.error_bars().filter(|(x, ..)| self.x.has(*x)) {
            if (0.0..=1.0).contains(&frame.x.share(x)) && self.y.has(high) {
                let is_low = low.is_finite() && self.y.has(low);
                let low = if is_low { frame.y.y(plot, low) } else { plot.bottom };
                let high = if high.is_finite() { frame.y.y(plot, high) } else { plot.top };
                let ends = (low, high);
                let x = frame.x.x(plot, x) + shift_px;
                error_bar::draw(drawing, x, ends, series.stroke().colour);
            }
        }
    }

    fn draw_fills(&self, drawing: &mut Drawing, plot: Rect) {
        let Some((x, y)) = self.x_scale().zip(self.y_scale()) else { return };
        for fill in &self.fills {
            for area in fill.areas(x, y) {
                let at = |&(x, y): &Point| (plot.left + x * plot.width(), level_px(plot, y));
                fill.kind.draw(drawing, &area.iter().map(at).collect::<Vec<_>>());
            }
        }
    }

    /// The places of all its values on the vertical axis.
    fn drawn(&self) -> impl Iterator<Item = AxisPlace> {
        self.series.iter().flat_map(|series| self.places(series)).filter_map(|(_, place)| place)
    }

    /// The places of the points of a series. A logarithmic axis cannot show all numbers.
    pub(crate) fn places<'a>(
        &'a self,
        series: &'a LineSeries,
    ) -> impl Iterator<Item = (f64, Option<AxisPlace>)> + 'a {
        let has = |place: &AxisPlace| match place {
            AxisPlace::At(value) => self.y.has(*value),
            AxisPlace::Above => true,
            AxisPlace::Below => !self.y.log,
        };
        let places = series.places().filter(|(x, _)| self.x.has(*x));
        places.map(move |(x, place)| (x, place.filter(has)))
    }

    /// The finite values of a series between the ends of the horizontal axis, with those at the ends.
    fn seen(&self, series: &LineSeries) -> Vec<f64> {
        let finite = |place: Option<AxisPlace>| place.and_then(AxisPlace::finite);
        let values = || {
            let bars = series.error_bars().flat_map(|(_, low, high)| [low, high]);
            let values = self.places(series).filter_map(|(_, place)| finite(place));
            values.chain(bars.filter(|y| y.is_finite() && self.y.has(*y)))
        };
        let has_ends = self.x.min.is_some() || self.x.max.is_some();
        let Some(scale) = self.x_scale().filter(|_| has_ends) else { return values().collect() };
        let share = |x: f64| scale.share(x).clamp(-clip::FAR, clip::FAR);
        let points: Vec<Option<Point>> =
            self.places(series).map(|(x, place)| Some((share(x), finite(place)?))).collect();
        let run = |run: &[Option<Point>]| run.iter().copied().flatten().collect::<Vec<Point>>();
        let runs: Vec<Vec<Point>> = points.split(Option::is_none).map(run).collect();
        let alone = runs.iter().filter(|run| run.len() == 1).flatten();
        let alone = alone.filter(|(x, _)| (0.0..=1.0).contains(x)).copied();
        let lines = runs.iter().flat_map(|run| clip::upright(run)).flatten();
        let bars = series.error_bars().filter(|(x, ..)| (0.0..=1.0).contains(&share(*x)));
        let bars = bars.flat_map(|(_, low, high)| [low, high]);
        let bars = bars.filter(|y| y.is_finite() && self.y.has(*y));
        alone.chain(lines).map(|(_, y)| y).chain(bars).collect()
    }

    fn span_ends(&self, scale: Scale) -> impl Iterator<Item = (f64, f64)> {
        self.spans.iter().filter_map(move |span| span.ends(scale))
    }

    /// The range of the vertical axis; `None` without ends that were set and finite values. Space
    /// that would move 0 away from an end is left out.
    pub(crate) fn y_scale(&self) -> Option<Scale> {
        self.y.ranged(self.y_of_data())
    }

    fn y_of_data(&self) -> Option<Scale> {
        let values = self.series.iter().flat_map(|series| self.seen(series));
        if self.y.log {
            return Some(Scale::holding_log(values)?.with_air(AIR, AIR));
        }
        if !self.y_from_zero {
            return Some(Scale::holding(values)?.with_air(AIR, AIR));
        }
        let scale = Scale::from_zero(values)?;
        let air = |beyond: bool| if beyond { AIR } else { 0.0 };
        Some(scale.with_air(air(scale.low < 0.0), air(scale.high > 0.0)))
    }

    /// The ticks of the horizontal axis, if they are given. Of an axis whose ends were set, they are
    /// left out if only a few are between its ends: round numbers then say more.
    pub(crate) fn x_ticks(&self) -> Option<&[f64]> {
        let ticks = self.given_ticks()?;
        let has_ends = self.x.min.is_some() || self.x.max.is_some();
        let Some(scale) = self.x_scale().filter(|_| has_ends) else { return Some(ticks) };
        let seen = ticks.iter().filter(|x| (0.0..=1.0).contains(&scale.share(**x)));
        (seen.count() >= FEWEST_TICKS).then_some(ticks)
    }

    /// The given ticks, if they can be drawn.
    fn given_ticks(&self) -> Option<&[f64]> {
        let ticks = self.x_ticks.as_deref()?;
        ticks.iter().all(|x| finite(*x) == Some(*x)).then_some(ticks)
    }

    /// The range of the horizontal axis; `None` without finite positions.
    pub(crate) fn x_scale(&self) -> Option<Scale> {
        let data = self.series.iter().flat_map(LineSeries::places).map(|(x, _)| x);
        let ticks = self.given_ticks().unwrap_or_default();
        let values = data.chain(ticks.iter().copied());
        let scale = if self.x.log { Scale::holding_log(values) } else { Scale::holding(values) };
        let air = if ticks.is_empty() || self.x.log { SIDE_AIR } else { 0.0 };
        self.x.ranged(scale.map(|scale| scale.with_air(air, air)))
    }

    /// Draws markers of infinite values on the border, side by side if several series have one.
    fn draw_infinite(&self, drawing: &mut Drawing, plot: Rect, x: &PositionAxis) {
        for (beyond, side) in [(AxisPlace::Above, Side::Above), (AxisPlace::Below, Side::Below)] {
            // Grouped by position in tenths of a pixel, from left to right.
            let mut groups: BTreeMap<i64, Vec<&LineSeries>> = BTreeMap::new();
            for series in &self.series {
                for (at, place) in self.places(series) {
                    if place == Some(beyond) && (0.0..=1.0).contains(&x.share(at)) {
                        let tenths = (x.x(plot, at) * 10.0).round() as i64;
                        groups.entry(tenths).or_default().push(series);
                    }
                }
            }
            let border = if side == Side::Above { plot.top } else { plot.bottom };
            for (tenths, series) in &groups {
                let apart_px = BESIDE_PX.min(plot.width() / series.len() as f64);
                let width = apart_px * (series.len() - 1) as f64;
                let most = (plot.right - width).max(plot.left);
                let left = (*tenths as f64 / 10.0 - width / 2.0).clamp(plot.left, most);
                for (i, series) in series.iter().enumerate() {
                    let at = (left + i as f64 * apart_px, border);
                    let colour = series.stroke().colour;
                    marker::draw(drawing, at, series.look, marker::RADIUS_PX, colour);
                }
            }
            let xs = groups.keys().map(|tenths| *tenths as f64 / 10.0).collect();
            infinity::draw_labels(drawing, plot, xs, side);
        }
    }
}

/// The radii of rings.
fn ring_px(is_small: bool) -> (f64, f64) {
    RING_PX[usize::from(is_small)]
}

fn finite(x: f64) -> Option<f64> {
    AxisPlace::of(x).and_then(AxisPlace::finite)
}

/// The vertical position of a share of the vertical axis in a plot area.
fn level_px(plot: Rect, share: f64) -> f64 {
    plot.bottom - share * plot.height()
}

/// Draws the lines of a curve between its gaps, then its markers. A point between two gaps always
/// has a marker, because it would not be visible otherwise. Points are given as shares of the plot
/// area's width and height.
fn draw_curve(drawing: &mut Drawing, series: &LineSeries, points: &[Option<Point>], plot: Rect) {
    let runs: Vec<Vec<Point>> = points
        .split(Option::is_none)
        .map(|run| run.iter().copied().flatten().collect())
        .filter(|run: &Vec<Point>| !run.is_empty())
        .collect();
    let px = |&(x, y): &Point| (plot.left + x * plot.width(), level_px(plot, y));
    let inside = |(x, y): &&Point| (0.0..=1.0).contains(x) && (0.0..=1.0).contains(y);
    if series.rings {
        for at in runs.iter().flatten().filter(inside).map(px) {
            marker::draw_ring(drawing, at, ring_px(series.dots), series.stroke().colour);
        }
        return;
    }
    if series.dots {
        for at in runs.iter().flatten().filter(inside).map(px) {
            drawing.disc(at, DOT_PX, series.stroke().colour);
        }
        return;
    }
    let colour = series.stroke().colour;
    if series.scatter {
        for at in runs.iter().flatten().filter(inside).map(px) {
            marker::draw(drawing, at, series.look, marker::RADIUS_PX, colour);
        }
        return;
    }
    let pieces: Vec<Vec<Point>> = runs
        .iter()
        .flat_map(|run| clip::upright(run))
        .flat_map(|run| clip::level(&run))
        .map(|piece| thinned(piece.iter().map(px).collect()))
        .collect();
    let stroke = series.stroke();
    let dash =
        if series.reference { series.look.reference_dash_px() } else { series.look.dash_px() };
    for piece in &pieces {
        drawing.dashed(piece, stroke, dash);
    }
    let marked = !series.reference && !series.unmarked && series.look.has_markers();
    let on_points = marked && !series.smooth;
    let mut markers: Vec<Point> = Vec::new();
    for run in &runs {
        for at in run.iter().filter(inside).map(px) {
            let near = |(x, y): &Point| (at.0 - x).hypot(at.1 - y) < MARKER_PITCH_PX;
            let alone = run.len() == 1;
            if alone || (on_points && !markers.last().is_some_and(near)) {
                markers.push(at);
            }
        }
    }
    if series.smooth && marked {
        let along = |piece: &Vec<Point>| smooth::markers(piece, plot, series.look);
        markers.extend(pieces.iter().flat_map(along));
    }
    for at in markers {
        marker::draw(drawing, at, series.look, marker::RADIUS_PX, colour);
    }
}
