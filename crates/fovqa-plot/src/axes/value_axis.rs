//! The vertical axis: values, their ticks on the left, and the grid.

use crate::axes::axis::{
    AXIS_STROKE, Axis, GRID_STROKE, LABEL_GAP_PX, TICK_LENGTH_PX, TITLE_GAP_PX,
};
use crate::canvas::clip;
use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{CAPITAL, LINE_PITCH, TICK_PX, TITLE_PX, width_px};
use crate::canvas::wrap::wrap;
use crate::page::layout::{MARGIN_PX, TITLE_LINES};
use crate::scales::scale::Scale;
use crate::scales::ticks::Tick;

/// The smallest distance between two ticks.
const PITCH_PX: f64 = 30.0;
/// The smallest distance of logarithmic ticks, whose distances vary.
const LOG_PITCH_PX: f64 = 18.0;

/// The ticks of a vertical range with this height.
pub(crate) fn ticks(scale: Scale, height_px: f64) -> Vec<Tick> {
    let apart = |pair: &[Tick], least_px: f64| {
        (scale.share(pair[1].value) - scale.share(pair[0].value)).abs() * height_px >= least_px
    };
    if scale.log {
        return scale.ticks(|ticks| ticks.windows(2).all(|pair| apart(pair, LOG_PITCH_PX)));
    }
    scale.ticks(|ticks| apart(ticks, PITCH_PX))
}

/// A vertical axis with its range.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ValueAxis {
    scale: Scale,
    ticks: Vec<Tick>,
    title: Vec<String>,
}

impl ValueAxis {
    /// An axis for a plot area of a height. Without a range it has only a title.
    pub(crate) fn new(axis: &Axis, scale: Option<Scale>, plot_height_px: f64) -> Self {
        let title = wrap(&axis.title, TITLE_PX, plot_height_px, TITLE_LINES);
        let Some(scale) = scale else {
            return Self { scale: Scale::even(0.0, 1.0), ticks: Vec::new(), title };
        };
        Self { scale, ticks: ticks(scale, plot_height_px), title }
    }

    /// Space on the left of the plot area, with a margin.
    pub(crate) fn left_px(&self) -> f64 {
        let labels =
            self.ticks.iter().map(|tick| width_px(&tick.label, TICK_PX)).fold(0.0, f64::max);
        let title = match self.title.len() {
            0 => 0.0,
            lines => lines as f64 * TITLE_PX * LINE_PITCH + TITLE_GAP_PX,
        };
        (MARGIN_PX + title + labels + LABEL_GAP_PX + TICK_LENGTH_PX).ceil()
    }

    /// The vertical position of a value in a plot area.
    pub(crate) fn y(&self, plot: Rect, value: f64) -> f64 {
        plot.bottom - self.scale.share(value).clamp(0.0, 1.0) * plot.height()
    }

    /// The position of a value along its axis, from 0 at the lower end to 1 at the upper end.
    pub(crate) fn share(&self, value: f64) -> f64 {
        self.scale.share(value).clamp(-clip::FAR, clip::FAR)
    }

    /// Draws the horizontal lines of the grid, which belong behind the data.
    pub(crate) fn draw_grid(&self, drawing: &mut Drawing, plot: Rect) {
        for tick in &self.ticks {
            let y = self.y(plot, tick.value);
            drawing.line(&[(plot.left, y), (plot.right, y)], GRID_STROKE);
        }
    }

    /// Draws the line, the ticks and the labels, and the title at a margin from `edge_px`, which is
    /// 0 at the left edge of the picture.
    pub(crate) fn draw(&self, drawing: &mut Drawing, plot: Rect, edge_px: f64) {
        drawing.line(&[(plot.left, plot.top), (plot.left, plot.bottom)], AXIS_STROKE);
        for tick in &self.ticks {
            let y = self.y(plot, tick.value);
            let x = plot.left - TICK_LENGTH_PX;
            drawing.line(&[(x, y), (plot.left, y)], AXIS_STROKE);
            let at = (x - LABEL_GAP_PX, y + CAPITAL * TICK_PX / 2.0);
            drawing.text(Text::new(&tick.label, at, TICK_PX, Anchor::End));
        }
        for (i, line) in self.title.iter().enumerate() {
            let baseline = edge_px + MARGIN_PX + TITLE_PX * (1.0 + i as f64 * LINE_PITCH);
            let at = (baseline, plot.centre().1);
            drawing.text(Text::new(line, at, TITLE_PX, Anchor::Middle).upwards());
        }
    }
}
