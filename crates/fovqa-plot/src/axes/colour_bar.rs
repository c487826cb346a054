//! The colour bar of pictures, which shows the colour of each value.

use crate::axes::axis::{AXIS_STROKE, Axis, LABEL_GAP_PX, TICK_LENGTH_PX, TITLE_GAP_PX};
use crate::axes::value_axis::ticks;
use crate::canvas::bitmap::Bitmap;
use crate::canvas::colour_map::LEVELS;
use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{CAPITAL, LINE_PITCH, TICK_PX, TITLE_PX, width_px};
use crate::canvas::wrap::wrap;
use crate::page::layout::{MARGIN_PX, TITLE_LINES};
use crate::scales::scale::Scale;
use crate::scales::ticks::Tick;

/// Distance from the pictures to the bar.
const GAP_PX: f64 = 6.0;
/// Width of the bar.
const BAR_PX: f64 = 14.0;

/// A bar with its range.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ColourBar {
    ticks: Vec<(f64, Tick)>,
    title: Vec<String>,
}

impl ColourBar {
    /// A bar of a height. Without a range it has no ticks.
    pub(crate) fn new(axis: &Axis, scale: Option<Scale>, height_px: f64) -> Self {
        let of = |scale: Scale| {
            let ticks = ticks(scale, height_px).into_iter();
            ticks.map(|tick| (scale.share(tick.value).clamp(0.0, 1.0), tick)).collect()
        };
        Self {
            ticks: scale.map(of).unwrap_or_default(),
            title: wrap(&axis.title, TITLE_PX, height_px, TITLE_LINES),
        }
    }

    /// Its width with labels, title and margin.
    pub(crate) fn width_px(&self) -> f64 {
        let title = match self.title.len() {
            0 => 0.0,
            lines => lines as f64 * TITLE_PX * LINE_PITCH + TITLE_GAP_PX,
        };
        GAP_PX + BAR_PX + TICK_LENGTH_PX + LABEL_GAP_PX + self.labels_px() + title + MARGIN_PX
    }

    fn labels_px(&self) -> f64 {
        self.ticks.iter().map(|(_, tick)| width_px(&tick.label, TICK_PX)).fold(0.0, f64::max)
    }

    /// Draws the bar, with the upper left corner of its area at this point.
    pub(crate) fn draw(&self, drawing: &mut Drawing, (left, top): (f64, f64), height_px: f64) {
        let left = left + GAP_PX;
        let bar = Rect { left, top, right: left + BAR_PX, bottom: top + height_px };
        drawing.picture(bar, Bitmap { columns: 1, levels: (0..LEVELS).rev().collect() });
        drawing.frame(bar, AXIS_STROKE);
        let tick_px = bar.right + TICK_LENGTH_PX;
        for (share, tick) in &self.ticks {
            let y = bar.bottom - share * height_px;
            drawing.line(&[(bar.right, y), (tick_px, y)], AXIS_STROKE);
            let at = (tick_px + LABEL_GAP_PX, y + CAPITAL * TICK_PX / 2.0);
            drawing.text(Text::new(&tick.label, at, TICK_PX, Anchor::Start));
        }
        for (i, line) in self.title.iter().enumerate() {
            let down = TITLE_PX * (1.0 + i as f64 * LINE_PITCH);
            let x = tick_px + LABEL_GAP_PX + self.labels_px() + TITLE_GAP_PX + down;
            let text = Text::new(line, (x, bar.centre().1), TITLE_PX, Anchor::Middle);
            drawing.text(text.upwards());
        }
    }
}
