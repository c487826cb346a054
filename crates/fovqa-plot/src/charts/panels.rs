//! Several charts of curves in one figure with one legend, for example a measure for each scene.

use crate::axes::axis::Axis;
use crate::axes::position_axis::PositionAxis;
use crate::axes::value_axis::ValueAxis;
use crate::canvas::drawing::{Anchor, Drawing, Text};
use crate::canvas::text::{LINE_PITCH, TITLE_PX};
use crate::canvas::wrap::wrap;
use crate::charts::line::{Frame, LineChart};
use crate::marks::legend::{self, Key};
use crate::page::layout::{self, MARGIN_PX, TITLE_LINES};
use crate::page::panel_grid::{Cell, Grid, Needs};
use crate::page::paper::Paper;

/// The smallest width of a plot area beside others, as a share of its part of the width. Wide labels
/// widen the picture instead.
const LEAST_PANEL: f64 = 0.45;

/// The same where the width was asked for.
const LEAST_FIXED_PANEL: f64 = 0.3;

/// Charts of curves in rows and columns, with one legend for all.
///
/// Each chart has its own axes, so charts are compared by shape. All plot areas have the same size.
/// A figure with one column is as wide as a single chart, and one with several columns as wide as a
/// page.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PanelChart {
    /// The title above the figure.
    pub title: Option<String>,
    /// The charts, row by row, each with its title above it. Series, areas and spans of the same
    /// name have one entry in the legend, with the look of the first one. If all charts of a row
    /// have the same vertical axis, only the first one has the axis title.
    pub panels: Vec<LineChart>,
    /// The largest number of charts in a row; 0 is treated as 1.
    pub columns: usize,
}

/// A chart with its axes.
struct Panel<'a> {
    chart: &'a LineChart,
    title: Vec<String>,
    x: PositionAxis,
    y: ValueAxis,
}

impl PanelChart {
    pub(crate) fn draw(&self, paper: &Paper) -> Drawing {
        let none = [LineChart::default()];
        let charts = if self.panels.is_empty() { &none } else { self.panels.as_slice() };
        let columns = self.columns.clamp(1, charts.len());
        let height_px = paper.panel_height_px;
        let y_axes = y_axes(charts, columns, height_px);
        let plot_width_px = plot_width_px(charts, &y_axes, columns, paper);
        let panel = |(chart, y)| Panel::new(chart, y, plot_width_px);
        let panels: Vec<Panel<'_>> = charts.iter().zip(y_axes).map(panel).collect();
        let needs: Vec<Needs> = panels.iter().map(Panel::needs).collect();
        let grid = Grid::new(&needs, columns, (plot_width_px, height_px));

        let left_px = grid.place(0, 0.0).plot.left;
        let width_px = grid.width_px().ceil();
        let keys = keys(charts);
        let (mut drawing, top) = layout::head(self.title.as_deref(), &keys, left_px, width_px);
        for (i, panel) in panels.iter().enumerate() {
            panel.draw(&mut drawing, grid.place(i, top));
        }
        drawing.height_px = (top + grid.height_px()).ceil();
        drawing
    }
}

/// The vertical axes. An axis has no title if it equals the other axes of its row.
fn y_axes(charts: &[LineChart], columns: usize, height_px: f64) -> Vec<ValueAxis> {
    let row = |charts: &[LineChart]| -> Vec<ValueAxis> {
        let same = charts.iter().all(|chart| chart.y == charts[0].y);
        let axis = |(i, chart): (usize, &LineChart)| {
            let untitled = Axis::default();
            let axis = if same && i > 0 { &untitled } else { &chart.y };
            ValueAxis::new(axis, chart.y_scale(), height_px)
        };
        charts.iter().enumerate().map(axis).collect()
    };
    charts.chunks(columns).flat_map(row).collect()
}

/// The common width of the plot areas: the part of the picture that the axes leave.
fn plot_width_px(charts: &[LineChart], y_axes: &[ValueAxis], columns: usize, paper: &Paper) -> f64 {
    let (picture_px, least_px) = if columns == 1 {
        (paper.column_px, paper.least_plot_px())
    } else {
        let share = if paper.fixed { LEAST_FIXED_PANEL } else { LEAST_PANEL };
        (paper.page_px, paper.page_px / columns as f64 * share)
    };
    let column_px = |c| {
        let axes = y_axes.iter().skip(c).step_by(columns);
        axes.map(ValueAxis::left_px).fold(0.0, f64::max)
    };
    let lefts_px: f64 = (0..columns).map(column_px).sum();
    let available_px = (picture_px - lefts_px) / columns as f64;
    let width_px = |chart: &LineChart| {
        let room = (available_px, least_px);
        PositionAxis::new(&chart.x, chart.x_scale(), chart.x_ticks(), room).plot_width_px()
    };
    charts.iter().map(width_px).fold(f64::INFINITY, f64::min)
}

/// The series of all charts with reference curves last, then their areas and spans.
fn keys(charts: &[LineChart]) -> Vec<(&str, Key)> {
    let all = || charts.iter().flat_map(LineChart::series_keys);
    let reference = |(_, key): &(&str, Key)| matches!(key, Key::Reference(_));
    let series = all().filter(|key| !reference(key)).chain(all().filter(reference));
    let fills = charts.iter().flat_map(LineChart::fill_keys);
    let spans = charts.iter().flat_map(LineChart::span_keys);
    legend::once(series).chain(legend::once(fills)).chain(legend::once(spans)).collect()
}

impl<'a> Panel<'a> {
    fn new(chart: &'a LineChart, y: ValueAxis, plot_width_px: f64) -> Self {
        let title = chart.title.as_deref().unwrap_or_default();
        Self {
            chart,
            title: wrap(title, TITLE_PX, plot_width_px, TITLE_LINES),
            x: PositionAxis::spanning(&chart.x, chart.x_scale(), chart.x_ticks(), plot_width_px),
            y,
        }
    }

    fn title_px(&self) -> f64 {
        self.title.len() as f64 * TITLE_PX * LINE_PITCH
    }

    fn needs(&self) -> Needs {
        let (above, below) = self.chart.strips_px();
        Needs {
            left: self.y.left_px().max(self.x.left_px()),
            right: self.x.right_px(),
            title: self.title_px(),
            strips: (above.max(MARGIN_PX), below),
            axis: self.x.below_px(),
        }
    }

    fn draw(&self, drawing: &mut Drawing, place: Cell) {
        let Cell { edge_px, title_px, plot, below_px } = place;
        for (i, line) in self.title.iter().enumerate() {
            let down = TITLE_PX * (1.0 + i as f64 * LINE_PITCH);
            let at = (plot.left, title_px - self.title_px() + down);
            drawing.text(Text::new(line, at, TITLE_PX, Anchor::Start));
        }
        let frame = Frame { x: &self.x, y: &self.y, plot, edge_px, below_px };
        self.chart.draw_in(drawing, &frame);
    }
}
