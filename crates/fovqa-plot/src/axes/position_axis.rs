//! The horizontal axis for numbers.

use crate::axes::axis::{AXIS_STROKE, Axis, LABEL_GAP_PX, TICK_LENGTH_PX, TITLE_GAP_PX};
use crate::canvas::clip;
use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{DESCENT, LINE_PITCH, TICK_PX, TITLE_PX, width_px};
use crate::canvas::wrap::wrap;
use crate::page::layout::{MARGIN_PX, TITLE_LINES};
use crate::scales::scale::Scale;
use crate::scales::ticks::{Tick, given_ticks};

/// The smallest space between two labels.
const APART_PX: f64 = 9.0;

/// A horizontal axis with its range, and the width of its plot area.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PositionAxis {
    scale: Scale,
    ticks: Vec<Tick>,
    title: Vec<String>,
    plot_width_px: f64,
}

impl PositionAxis {
    /// An axis that fits into a width, including its last label, with a plot area of at least
    /// `least_px`. Without a range it has only a title. If given ticks are too close together, only
    /// some of them get a label.
    pub(crate) fn new(
        axis: &Axis,
        scale: Option<Scale>,
        given: Option<&[f64]>,
        (available_px, least_px): (f64, f64),
    ) -> Self {
        let width = |ticks: &[Tick]| {
            (available_px - ticks.last().map_or(0.0, half_px) - MARGIN_PX).max(least_px)
        };
        Self::with_width(axis, scale, given, width)
    }

    /// An axis for a plot area of a fixed width. If that is too narrow for the fewest possible
    /// ticks, only the first one gets a label.
    pub(crate) fn spanning(
        axis: &Axis,
        scale: Option<Scale>,
        given: Option<&[f64]>,
        plot_width_px: f64,
    ) -> Self {
        let mut found = Self::with_width(axis, scale, given, |_| plot_width_px);
        leave_room(&mut found.ticks, found.scale, found.plot_width_px);
        found
    }

    fn with_width(
        axis: &Axis,
        scale: Option<Scale>,
        given: Option<&[f64]>,
        width: impl Fn(&[Tick]) -> f64,
    ) -> Self {
        let known = scale.unwrap_or(Scale::even(0.0, 1.0));
        let ticks = match (scale, given) {
            (None, _) => Vec::new(),
            (Some(scale), Some(places)) => {
                let seen = |place: &f64| (0.0..=1.0).contains(&scale.share(*place));
                let places: Vec<f64> = places.iter().copied().filter(seen).collect();
                let mut ticks = given_ticks(&places);
                let plot_width_px = width(&ticks);
                leave_room(&mut ticks, known, plot_width_px);
                ticks
            }
            (Some(_), None) => known.ticks(|ticks| all_apart(ticks, known, width(ticks))),
        };
        let plot_width_px = width(&ticks).floor();
        let title = wrap(&axis.title, TITLE_PX, plot_width_px, TITLE_LINES);
        Self { scale: known, ticks, title, plot_width_px }
    }

    /// The width of the plot area.
    pub(crate) fn plot_width_px(&self) -> f64 {
        self.plot_width_px
    }

    /// Space that the first label needs on the left of the plot area, with a margin.
    pub(crate) fn left_px(&self) -> f64 {
        MARGIN_PX + self.ticks.first().map_or(0.0, half_px)
    }

    /// Space that the last label needs on the right of the plot area, with a margin. If the last
    /// tick has no label, the last one that has is considered.
    pub(crate) fn right_px(&self) -> f64 {
        let Some((last, others)) = self.ticks.split_last() else { return MARGIN_PX };
        let beyond_px =
            |tick: &Tick| half_px(tick) - (1.0 - self.scale.share(tick.value)) * self.plot_width_px;
        MARGIN_PX + others.iter().map(beyond_px).fold(half_px(last), f64::max)
    }

    /// Space below the plot area.
    pub(crate) fn below_px(&self) -> f64 {
        let title = match self.title.len() {
            0 => 0.0,
            lines => TITLE_GAP_PX + (lines as f64 * LINE_PITCH + DESCENT) * TITLE_PX,
        };
        TICK_LENGTH_PX + LABEL_GAP_PX + TICK_PX + title + MARGIN_PX
    }

    /// The horizontal position of a value in a plot area.
    pub(crate) fn x(&self, plot: Rect, value: f64) -> f64 {
        plot.left + self.scale.share(value).clamp(0.0, 1.0) * plot.width()
    }

    /// The position of a value along the axis, from 0 at the left end to 1 at the right end.
    pub(crate) fn share(&self, value: f64) -> f64 {
        self.scale.share(value).clamp(-clip::FAR, clip::FAR)
    }

    /// Draws the line and the ticks, and the labels and the title lowered by `down_px`.
    pub(crate) fn draw(&self, drawing: &mut Drawing, plot: Rect, down_px: f64) {
        let bottom = plot.bottom;
        drawing.line(&[(plot.left, bottom), (plot.right, bottom)], AXIS_STROKE);
        let top = bottom + TICK_LENGTH_PX + LABEL_GAP_PX + down_px;
        for tick in &self.ticks {
            let x = self.x(plot, tick.value);
            drawing.line(&[(x, bottom), (x, bottom + TICK_LENGTH_PX)], AXIS_STROKE);
            let at = (x, top + TICK_PX * (1.0 - DESCENT));
            drawing.text(Text::new(&tick.label, at, TICK_PX, Anchor::Middle));
        }
        for (i, line) in self.title.iter().enumerate() {
            let baseline = top + TICK_PX + TITLE_GAP_PX + TITLE_PX * (1.0 + i as f64 * LINE_PITCH);
            drawing.text(Text::new(line, (plot.centre().0, baseline), TITLE_PX, Anchor::Middle));
        }
    }
}

fn half_px(tick: &Tick) -> f64 {
    width_px(&tick.label, TICK_PX) / 2.0
}

fn all_apart(ticks: &[Tick], scale: Scale, plot_width_px: f64) -> bool {
    ticks.windows(2).all(|pair| {
        let distance = (scale.share(pair[1].value) - scale.share(pair[0].value)) * plot_width_px;
        distance >= half_px(&pair[0]) + half_px(&pair[1]) + APART_PX
    })
}

/// Removes the labels of ticks that are too close to the one before.
fn leave_room(ticks: &mut [Tick], scale: Scale, plot_width_px: f64) {
    let mut free_px = f64::NEG_INFINITY;
    for tick in ticks {
        let (x, half) = (scale.share(tick.value) * plot_width_px, half_px(tick));
        if x - half >= free_px {
            free_px = x + half + APART_PX;
        } else {
            tick.label.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stay_apart_where_only_one_fits() {
        let mut single = 0;
        for (i, j) in (0..30).flat_map(|i| (0..30).map(move |j| (i, j))) {
            let low = 1e9 + 0.37 * f64::from(i);
            let scale = Scale::even(low, low + 1.5 + 0.31 * f64::from(j));
            let axis = PositionAxis::spanning(&Axis::default(), Some(scale), None, 140.0);
            let labelled: Vec<Tick> =
                axis.ticks.into_iter().filter(|tick| !tick.label.is_empty()).collect();
            assert!(all_apart(&labelled, scale, 140.0), "{labelled:?}");
            single += usize::from(labelled.len() == 1);
        }
        assert!(single > 0, "it is needed");
    }
}
