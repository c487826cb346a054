//! Grouped bars: one value for each method in each scene.

use crate::axes::axis::{AXIS_STROKE, Axis};
use crate::axes::group_axis::GroupAxis;
use crate::axes::value_axis::ValueAxis;
use crate::canvas::colour::{INK, REFERENCE};
use crate::canvas::drawing::{Drawing, Rect, Stroke};
use crate::canvas::look::Look;
use crate::error::PlotError;
use crate::marks::bracket;
use crate::marks::error_bar;
use crate::marks::infinity;
use crate::marks::legend::{Key, REFERENCE_PX};
use crate::marks::marker;
use crate::marks::swatch;
use crate::marks::value_label::{Orientation, Side, widest_px};
use crate::page::layout::{self, MARGIN_PX, Sides};
use crate::page::paper::Paper;
use crate::scales::number::Format;
use crate::scales::scale::{AxisPlace, Scale};

/// The share of its slot that a bar fills.
const FILLED: f64 = 0.88;
/// Space around the data of an axis that does not begin at 0, as a share of its range.
const AIR: f64 = 0.06;
/// The largest share of the plot area's height that labels above and below the bars may take.
const MOST_LABELS: f64 = 0.8;
/// The text in place of a missing value.
const MISSING: &str = "n/a";

/// Groups of bars with one bar per series, and its value above it if there is room.
#[derive(Debug, Clone, PartialEq)]
pub struct BarChart {
    /// The title above the figure.
    pub title: Option<String>,
    /// The vertical axis.
    pub y: Axis,
    /// Names of the groups, from left to right.
    pub groups: Vec<String>,
    /// The series.
    pub series: Vec<BarSeries>,
    /// Whether the axis begins at 0, which is the default.
    ///
    /// A bar is read by its length, and a truncated bar shows wrong ratios. So if the axis does not
    /// begin at 0, there are no bars: each value is a marker on an axis that fits the data, which
    /// is read by position (a dot plot, Cleveland and McGill 1984) and cannot be mistaken for a
    /// bar. The same holds for a logarithmic axis, and for one that was set to begin above 0.
    pub from_zero: bool,
    /// Brackets above the plot area, which connect bars that are compared.
    pub brackets: Vec<Bracket>,
    /// Level lines with which values are compared, such as chance. The axis includes them. They are
    /// gray and dashed.
    pub references: Vec<ReferenceLine>,
    /// Whether each value has a label, which is the default. Notes are written in any case.
    pub labels: bool,
}

/// A level line over all groups.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ReferenceLine {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Its value. A line that is not finite, or beyond an end of the axis that was set, is not drawn.
    pub value: f64,
}

/// A bracket between two bars.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bracket {
    /// The bars that it connects, each by the indices of its group and its series.
    pub ends: [[usize; 2]; 2],
    /// The text above it, such as stars of significance.
    pub label: String,
}

/// The bars of one series.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BarSeries {
    /// Its name in the legend.
    pub name: String,
    /// Its look.
    pub look: Look,
    /// Half the length of the error bar of each value; empty for none.
    pub errors: Vec<Option<f64>>,
    /// The lower and the upper end of the interval of each value, in place of
    /// [`errors`](Self::errors); empty for none. An infinite end is drawn to the border.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// A text behind the label of each value, such as stars of significance; empty for none.
    pub notes: Vec<String>,
    /// A value for each group. `None` and NaN have an "n/a" instead of a bar. An infinite value has
    /// a bar as high as the plot area, with an "∞" above it.
    pub values: Vec<Option<f64>>,
}

impl Default for BarChart {
    fn default() -> Self {
        Self {
            title: None,
            y: Axis::default(),
            groups: Vec::new(),
            series: Vec::new(),
            from_zero: true,
            brackets: Vec::new(),
            references: Vec::new(),
            labels: true,
        }
    }
}

/// The measures of a chart that its marks need.
struct Frame<'a> {
    axis: &'a ValueAxis,
    groups: &'a GroupAxis,
    plot: Rect,
    format: Format,
    values: Orientation,
    /// Whether values have labels.
    labelled: bool,
    missing: Orientation,
}

impl BarChart {
    pub(crate) fn draw(&self, paper: &Paper) -> Result<Drawing, PlotError> {
        let height_px = paper.plot_height_px;
        for series in &self.series {
            PlotError::check_groups(&series.name, series.values.len(), self.groups.len())?;
            for count in [series.errors.len(), series.intervals.len(), series.notes.len()] {
                if count > 0 {
                    PlotError::check_groups(&series.name, count, self.groups.len())?;
                }
            }
        }
        let scale = self.scale();
        let rough = ValueAxis::new(&self.y, scale, height_px);
        let beside_px = rough.left_px() + MARGIN_PX;
        let groups = GroupAxis::new(&self.groups, self.series.len(), beside_px, paper);
        let finite = || self.places().filter_map(AxisPlace::finite);
        let format = Format::of_values(finite());
        let labels: Vec<String> = self.labels(format).collect();
        let label_px = widest_px(labels.iter().map(String::as_str));
        let values = Orientation::of(label_px, groups.pitch_px());
        let missing = Orientation::of(widest_px([MISSING]), groups.pitch_px());
        // Labels that leave too little room for the bars are left out: the axis tells the values.
        let reach_px = values.reach_px(label_px);
        let labelled = 2.0 * reach_px <= MOST_LABELS * height_px;
        let reach_px = if labelled && label_px > 0.0 { reach_px } else { 0.0 };
        let axis = self.axis_with_room(scale, reach_px, height_px);

        let (above, below) = infinity::strips_px(self.places());
        // Under an end that was set, labels have no room in the plot area.
        let above = if self.y.max.is_some() { above.max(reach_px) } else { above };
        let brackets = bracket::Levels::of(&self.brackets, self.series.len());
        let above = above + brackets.height_px();
        let sides = Sides {
            left: axis.left_px(),
            right: MARGIN_PX,
            above: above.max(MARGIN_PX),
            below: below + groups.below_px(),
        };
        let keys: Vec<_> = self.keys().collect();
        let (mut drawing, plot) =
            layout::begin(self.title.as_deref(), &keys, sides, (groups.plot_width_px(), height_px));
        axis.draw_grid(&mut drawing, plot);
        if !self.has_bars() {
            groups.draw_dividers(&mut drawing, plot);
        }
        groups.draw(&mut drawing, plot, below);
        if self.places().next().is_none() {
            layout::write_no_data(&mut drawing, plot);
        } else {
            let frame =
                Frame { axis: &axis, groups: &groups, plot, format, values, labelled, missing };
            self.draw_references(&mut drawing, &frame);
            self.draw_series(&mut drawing, &frame);
        }
        let strip_px = above - brackets.height_px();
        brackets.draw(&mut drawing, plot.top - strip_px, |[group, series]| {
            groups.x(plot, group, series)
        });
        axis.draw(&mut drawing, plot, 0.0);
        let base = if self.has_bars() { axis.y(plot, 0.0) } else { plot.bottom };
        drawing.line(&[(plot.left, base), (plot.right, base)], AXIS_STROKE);
        Ok(drawing)
    }

    /// Whether values are bars, and not markers.
    pub(crate) fn has_bars(&self) -> bool {
        self.from_zero && !self.y.log && self.y.min.is_none_or(|min| min <= 0.0)
    }

    fn key(&self, look: Look) -> Key {
        if self.has_bars() { Key::Bar(look) } else { Key::Marker(look) }
    }

    /// The keys of the series, then those of the reference lines.
    fn keys(&self) -> impl Iterator<Item = (&str, Key)> {
        let series = self.series.iter().map(|series| (series.name.as_str(), self.key(series.look)));
        let references = self.references.iter().enumerate();
        let references = references
            .map(|(i, reference)| (reference.name.as_str(), Key::Reference(Look::new(i))));
        series.chain(references)
    }

    pub(crate) fn places(&self) -> impl Iterator<Item = AxisPlace> {
        self.series.iter().flat_map(|series| &series.values).filter_map(|value| self.place(*value))
    }

    /// The ends of all error bars, and the reference lines.
    fn error_ends(&self) -> impl Iterator<Item = f64> {
        let of = |series: &BarSeries| {
            let ends: Vec<_> = (0..series.values.len()).filter_map(|g| series.ends(g)).collect();
            ends
        };
        let ends = self.series.iter().flat_map(of).flat_map(<[f64; 2]>::from);
        let references = self.references.iter().map(|reference| reference.value);
        ends.chain(references).filter(|end| end.is_finite() && self.y.has(*end))
    }

    /// The labels of all finite values.
    fn labels(&self, format: Format) -> impl Iterator<Item = String> {
        self.series.iter().flat_map(move |series| {
            let value = |(g, value): (usize, &Option<f64>)| {
                Some(self.label(series, g, self.place(*value)?.finite()?, format))
            };
            series.values.iter().enumerate().filter_map(value).collect::<Vec<_>>()
        })
    }

    /// The place of a value, if the axis has one for it.
    fn place(&self, value: Option<f64>) -> Option<AxisPlace> {
        let place = value.and_then(AxisPlace::of)?;
        place.finite().is_none_or(|value| self.y.has(value)).then_some(place)
    }

    /// The range of the values, including 0 if there are bars; `None` without finite values.
    fn scale(&self) -> Option<Scale> {
        let finite = || self.places().filter_map(AxisPlace::finite).chain(self.error_ends());
        if !self.has_bars() {
            let scale =
                if self.y.log { Scale::holding_log(finite()) } else { Scale::holding(finite()) };
            return scale.map(|scale| scale.with_air(AIR, AIR));
        }
        let below = self.places().any(|place| place == AxisPlace::Below);
        let (low, high) = finite().fold((0.0, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
        let high = if low < high { high } else { 1.0 };
        // An infinite bar downwards needs space to be visible.
        let low = if below && low >= 0.0 { -high / 2.0 } else { low };
        (finite().next().is_some() || below).then(|| Scale::even(low, high))
    }

    /// The range of the axis, without space for labels.
    pub(crate) fn axis_range(&self) -> Option<Scale> {
        self.y.ranged(self.scale())
    }

    /// The axis, with space beyond the outermost values for their labels.
    fn axis_with_room(&self, scale: Option<Scale>, reach_px: f64, height_px: f64) -> ValueAxis {
        let axis = |scale| ValueAxis::new(&self.y, scale, height_px);
        let Some(scale) = scale else { return axis(self.y.ranged(None)) };
        let down_px = if self.has_bars() && scale.low < 0.0 { reach_px } else { 0.0 };
        // The label of a 0 is above it, even if all other values are negative.
        let upwards = self.places().filter_map(AxisPlace::finite).any(|value| value >= 0.0);
        let up_px = match (self.has_bars(), upwards) {
            (true, true) => reach_px,
            (true, false) => 0.0,
            (false, _) => reach_px + marker::RADIUS_PX,
        };
        let data_px = height_px - up_px - down_px;
        axis(self.y.ranged(Some(scale.with_air(down_px / data_px, up_px / data_px))))
    }

    fn draw_series(&self, drawing: &mut Drawing, frame: &Frame<'_>) {
        let mut infinite = [(AxisPlace::Above, Side::Above), (AxisPlace::Below, Side::Below)]
            .map(|(place, side)| (place, side, Vec::new()));
        for (s, series) in self.series.iter().enumerate() {
            for (g, value) in series.values.iter().enumerate() {
                let x = frame.groups.x(frame.plot, g, s);
                let place = self.place(*value);
                match place {
                    None => self.draw_missing(drawing, frame, x),
                    Some(place) => {
                        let label = place.finite().map(|v| self.label(series, g, v, frame.format));
                        let at = (x, place, series.ends(g));
                        self.draw_value(drawing, frame, at, (series.look, label));
                    }
                }
                for (beyond, _, xs) in &mut infinite {
                    if place == Some(*beyond) {
                        xs.push(x);
                    }
                }
            }
        }
        for (_, side, xs) in infinite {
            infinity::draw_labels(drawing, frame.plot, xs, side);
        }
    }

    /// Draws the reference lines that are between the ends of the axis.
    fn draw_references(&self, drawing: &mut Drawing, frame: &Frame<'_>) {
        let plot = frame.plot;
        let stroke = Stroke { colour: REFERENCE, width_px: REFERENCE_PX };
        for (i, reference) in self.references.iter().enumerate() {
            let is_on_axis = reference.value.is_finite() && self.y.has(reference.value);
            if is_on_axis && (0.0..=1.0).contains(&frame.axis.share(reference.value)) {
                let y = frame.axis.y(plot, reference.value);
                let line = [(plot.left, y), (plot.right, y)];
                drawing.dashed(&line, stroke, Look::new(i).reference_dash_px());
            }
        }
    }

    /// The label of a value, with its note.
    fn label(&self, series: &BarSeries, group: usize, value: f64, format: Format) -> String {
        let note = series.notes.get(group).map_or("", String::as_str);
        if self.labels { with_note(format.label(value), note) } else { note.to_owned() }
    }

    fn draw_value(
        &self,
        drawing: &mut Drawing,
        frame: &Frame<'_>,
        (x, place, ends): (f64, AxisPlace, Option<(f64, f64)>),
        (look, label): (Look, Option<String>),
    ) {
        let plot = frame.plot;
        let outside = |value: f64| !(0.0..=1.0).contains(&frame.axis.share(value));
        if !self.has_bars() && place.finite().is_some_and(outside) {
            return;
        }
        let end = match place {
            AxisPlace::At(value) => frame.axis.y(plot, value),
            AxisPlace::Above => plot.top,
            AxisPlace::Below => plot.bottom,
        };
        let ends = ends.map(|(low, high)| {
            let is_low = low.is_finite() && self.y.has(low);
            let low = if is_low { frame.axis.y(plot, low) } else { plot.bottom };
            (low, if high.is_finite() { frame.axis.y(plot, high) } else { plot.top })
        });
        if self.has_bars() {
            let base = frame.axis.y(plot, 0.0);
            let half = frame.groups.pitch_px() * FILLED / 2.0;
            let (top, bottom) = (end.min(base), end.max(base));
            let rect = Rect { left: x - half, right: x + half, top, bottom };
            swatch::draw(drawing, rect, look, look.colour());
        }
        if let Some(ends) = ends {
            error_bar::draw(drawing, x, ends, INK);
        }
        if !self.has_bars() {
            let radius_px = marker::RADIUS_PX.min(frame.groups.pitch_px() / 2.0);
            marker::draw(drawing, (x, end), look, radius_px, look.colour());
        }
        if let Some((value, label)) = place.finite().zip(label).filter(|_| frame.labelled) {
            let downwards = self.has_bars() && value < 0.0;
            let side = if downwards { Side::Below } else { Side::Above };
            let off = if self.has_bars() { 0.0 } else { marker::RADIUS_PX };
            // The label is beyond the error bar.
            let end = match (ends, side) {
                (Some((_, high)), Side::Above) => high.min(end - off),
                (Some((low, _)), Side::Below) => low.max(end - off),
                (None, _) => end - off,
            };
            if !label.is_empty() {
                frame.values.draw(drawing, &label, (x, end), side);
            }
        }
    }

    /// Writes "n/a" above the base line, or below it if there is no room above.
    fn draw_missing(&self, drawing: &mut Drawing, frame: &Frame<'_>, x: f64) {
        let plot = frame.plot;
        let base = if self.has_bars() { frame.axis.y(plot, 0.0) } else { plot.bottom };
        let room_above = base - plot.top >= frame.missing.reach_px(widest_px([MISSING]));
        let side = if room_above { Side::Above } else { Side::Below };
        frame.missing.draw(drawing, MISSING, (x, base), side);
    }
}

impl BarSeries {
    /// The ends of the error bar of the value of a group.
    fn ends(&self, group: usize) -> Option<(f64, f64)> {
        let value = self.values.get(group).copied().flatten();
        if let Some([low, high]) = self.intervals.get(group).copied().flatten() {
            return Some((low, high)).filter(|_| value.is_some() && low <= high);
        }
        error_ends(value, self.errors.get(group).copied().flatten())
    }
}

fn with_note(label: String, note: &str) -> String {
    if note.is_empty() { label } else { format!("{label} {note}") }
}

/// The ends of the error bar of a value.
fn error_ends(value: Option<f64>, error: Option<f64>) -> Option<(f64, f64)> {
    let finite = |value: f64| AxisPlace::of(value).and_then(AxisPlace::finite);
    let (value, error) = (finite(value?)?, finite(error?)?.abs());
    Some((finite(value - error)?, finite(value + error)?))
}
