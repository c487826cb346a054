//! Pictures of a quantity over a plane, for example the sampling density over the field of view.

use crate::axes::axis::{AXIS_STROKE, Axis};
use crate::axes::colour_bar::ColourBar;
use crate::axes::position_axis::PositionAxis;
use crate::axes::value_axis::ValueAxis;
use crate::canvas::colour::WHITE;
use crate::canvas::colour_map::NO_VALUE;
use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{LINE_PITCH, TITLE_PX};
use crate::canvas::wrap::wrap;
use crate::charts::overlay;
use crate::charts::raster_panel::RasterPanel;
use crate::error::PlotError;
use crate::page::layout::{self, MARGIN_PX, TITLE_LINES};
use crate::page::panel_grid::{Cell, Grid, Needs};
use crate::page::paper::Paper;
use crate::scales::scale::{AxisPlace, Scale};

/// The smallest and the largest height of the colour bar. Beside low pictures the bar is higher
/// than they are, because its title would not fit otherwise.
const BAR_PX: (f64, f64) = (110.0, 340.0);
/// The approximate space that axes need beside a picture.
const BESIDE_PX: f64 = 64.0;
/// The number of times that axes are measured before the final layout.
const MEASURED: usize = 2;
/// Pictures in rows and columns with one colour scale, whose bar is on the right.
///
/// The colours are those of viridis, in which lighter means more, with 255 steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RasterChart {
    /// The title above the figure.
    pub title: Option<String>,
    /// The pictures, row by row. If all pictures of a row have the same vertical axis, only the
    /// first one has the axis title.
    pub panels: Vec<RasterPanel>,
    /// The largest number of pictures in a row; 0 is treated as 1. A figure with one column is as
    /// wide as a single chart, and one with several columns as wide as a page.
    pub columns: usize,
    /// The quantity that the colours show, with the unit: "Samples per square degree".
    pub colour: Axis,
    /// Whether the colour scale is logarithmic.
    pub log: bool,
    /// The values of the first and the last colour, which also apply to values beyond. `None` means
    /// the smallest and the largest value. Ends are ignored if they are not finite, not in order,
    /// or not above 0 for a logarithmic scale.
    pub range: Option<(f64, f64)>,
}

/// A picture with its axes.
struct Panel<'a> {
    chart: &'a RasterPanel,
    title: Vec<String>,
    x: PositionAxis,
    y: ValueAxis,
    size_px: (f64, f64),
}

impl RasterChart {
    pub(crate) fn draw(&self, paper: &Paper) -> Result<Drawing, PlotError> {
        self.panels.iter().try_for_each(RasterPanel::check)?;
        let none = [RasterPanel::default()];
        let charts = if self.panels.is_empty() { &none } else { self.panels.as_slice() };
        let columns = self.columns.clamp(1, charts.len());
        let scale = self.scale();

        // The space for axes and bar depends on the height of the pictures, which in turn depends
        // on the space that is left.
        let picture_px = if columns == 1 { paper.column_px } else { paper.page_px };
        let least_px = paper.least_picture_px();
        let mut width_px = picture_px / columns as f64 - BESIDE_PX;
        // Dots alone have no colours that a bar could explain.
        let has_bar = !charts.iter().all(RasterPanel::has_only_dots);
        let bar_width_px = |bar: &ColourBar| if has_bar { bar.width_px() } else { 0.0 };
        for _ in 0..MEASURED {
            let (panels, grid) = panels(charts, columns, (width_px, least_px));
            let bar = ColourBar::new(&self.colour, scale, bar_px(plots_px(&panels, &grid)));
            width_px += (picture_px - grid.width_px() - bar_width_px(&bar)) / columns as f64;
        }
        let (panels, grid) = panels(charts, columns, (width_px, least_px));
        let plots_px = plots_px(&panels, &grid);
        let bar_px = bar_px(plots_px);
        let bar = ColourBar::new(&self.colour, scale, bar_px);

        let first = grid.place(0, 0.0).plot;
        let width_px = (grid.width_px() + bar_width_px(&bar)).ceil();
        let (mut drawing, top) = layout::head(self.title.as_deref(), &[], first.left, width_px);
        for (i, panel) in panels.iter().enumerate() {
            panel.draw(&mut drawing, grid.place(i, top), scale);
        }
        let bar_top = top + first.top + (plots_px - bar_px).max(0.0) / 2.0;
        let mut bottom = top + grid.height_px();
        if has_bar {
            bar.draw(&mut drawing, (grid.width_px(), bar_top), bar_px);
            bottom = bottom.max(bar_top + bar_px + 2.0 * MARGIN_PX);
        }
        drawing.height_px = bottom.ceil();
        Ok(drawing)
    }

    /// The range of the colours; `None` without values that it could include.
    fn scale(&self) -> Option<Scale> {
        let given = self.range.and_then(|range| Scale::between(range, self.log));
        let values = self.panels.iter().flat_map(|panel| &panel.values);
        let values = values.filter_map(|value| AxisPlace::of(*value)?.finite());
        given.or_else(|| if self.log { Scale::holding_log(values) } else { Scale::holding(values) })
    }
}

/// The distance from the top of the first row of pictures to the bottom of the last row.
fn plots_px(panels: &[Panel<'_>], grid: &Grid) -> f64 {
    let top = |i: usize| grid.place(i, 0.0).plot.top;
    let bottoms = panels.iter().enumerate().map(|(i, panel)| top(i) + panel.size_px.1);
    bottoms.fold(0.0, f64::max) - top(0)
}

/// The height of the bar beside pictures of this height.
fn bar_px(plots_px: f64) -> f64 {
    plots_px.clamp(BAR_PX.0, BAR_PX.1)
}

/// The pictures in a grid, as wide as the width unless that is less than the smallest one.
fn panels(charts: &[RasterPanel], columns: usize, widths_px: (f64, f64)) -> (Vec<Panel<'_>>, Grid) {
    let panels: Vec<Panel<'_>> = charts
        .chunks(columns)
        .flat_map(|row| {
            let same = row.iter().all(|chart| chart.y == row[0].y);
            let panel = move |(i, chart)| Panel::new(chart, !same || i == 0, widths_px);
            row.iter().enumerate().map(panel)
        })
        .collect();
    let needs: Vec<Needs> = panels.iter().map(Panel::needs).collect();
    // Each picture has its own size, which its needs include.
    let grid = Grid::new(&needs, columns, (0.0, 0.0));
    (panels, grid)
}

impl<'a> Panel<'a> {
    fn new(chart: &'a RasterPanel, y_title: bool, (width_px, least_px): (f64, f64)) -> Self {
        let size_px = chart.size_px(width_px, least_px);
        let (left, right) = chart.x_range;
        let (top, bottom) = chart.y_range;
        let title = chart.title.as_deref().unwrap_or_default();
        let untitled = Axis::default();
        let y = if y_title { &chart.y } else { &untitled };
        Self {
            chart,
            title: wrap(title, TITLE_PX, size_px.0, TITLE_LINES),
            x: PositionAxis::spanning(
                &chart.x,
                Some(Scale { log: chart.x.log, ..Scale::even(left, right) }),
                None,
                size_px.0,
            ),
            y: ValueAxis::new(
                y,
                Some(Scale { log: chart.y.log, ..Scale::even(bottom, top) }),
                size_px.1,
            ),
            size_px,
        }
    }

    fn title_px(&self) -> f64 {
        self.title.len() as f64 * TITLE_PX * LINE_PITCH
    }

    fn needs(&self) -> Needs {
        Needs {
            left: self.y.left_px().max(self.x.left_px()),
            right: self.size_px.0 + self.x.right_px(),
            title: self.title_px(),
            strips: (MARGIN_PX, 0.0),
            axis: self.size_px.1 + self.x.below_px(),
        }
    }

    fn draw(&self, drawing: &mut Drawing, cell: Cell, scale: Option<Scale>) {
        let Cell { edge_px, title_px, plot, .. } = cell;
        for (i, line) in self.title.iter().enumerate() {
            let down = TITLE_PX * (1.0 + i as f64 * LINE_PITCH);
            let at = (plot.left, title_px - self.title_px() + down);
            drawing.text(Text::new(line, at, TITLE_PX, Anchor::Start));
        }
        let (width, height) = self.size_px;
        let plot = Rect { right: plot.left + width, bottom: plot.top + height, ..plot };
        let chart = self.chart;
        if chart.values.is_empty() {
            let paper = if chart.has_only_dots() { WHITE } else { NO_VALUE };
            drawing.area(plot.corners().to_vec(), paper);
        } else {
            drawing.picture(plot, chart.bitmap(scale));
        }
        if !chart.has_only_dots() && chart.values.iter().all(|value| value.is_nan()) {
            layout::write_no_data(drawing, plot);
        } else {
            overlay::draw(drawing, plot, chart);
        }
        drawing.frame(plot, AXIS_STROKE);
        self.y.draw(drawing, plot, edge_px);
        self.x.draw(drawing, plot, 0.0);
    }
}
