//! The horizontal axis of groups. Each group has a slot with room for every series, and its name
//! below the slot: horizontal if it fits, else upright.

use crate::axes::axis::{GRID_STROKE, LABEL_GAP_PX, TICK_LENGTH_PX};
use crate::canvas::drawing::{Anchor, Drawing, Rect, Text};
use crate::canvas::text::{CAPITAL, DESCENT, LINE_PITCH, TICK_PX};
use crate::canvas::wrap::{keeps_words, widest_px, wrap};
use crate::page::layout::MARGIN_PX;
use crate::page::paper::Paper;

/// The preferred width of a bar or box, including gaps.
const WANTED_PITCH_PX: f64 = 18.0;
/// The largest width of a bar or box, including gaps.
const MOST_PITCH_PX: f64 = 44.0;
/// The share of a slot that bars or boxes may fill.
const FILLED: f64 = 0.84;
/// The largest number of lines of a group's name.
const MOST_LINES: usize = 3;
/// Free space beside a horizontal name.
const NAME_GAP_PX: f64 = 6.0;
/// Distance between the upright lines of a name.
const LINE_PX: f64 = TICK_PX * LINE_PITCH;
/// The possible lengths of upright names. The first one that holds all names is used.
const UPRIGHT_PX: [f64; 4] = [80.0, 120.0, 160.0, 220.0];

/// The slots of groups in a plot area.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GroupAxis {
    names: Vec<Vec<String>>,
    upright: bool,
    series: usize,
    plot_width_px: f64,
}

impl GroupAxis {
    /// The axis of named groups for this number of series, with this much space beside the plot
    /// area.
    pub(crate) fn new(groups: &[String], series: usize, beside_px: f64, paper: &Paper) -> Self {
        let slots = groups.len().max(1) as f64;
        let wanted = slots * (series as f64 * WANTED_PITCH_PX / FILLED).max(LINE_PX);
        let usual = (paper.column_px - beside_px).max(paper.least_plot_px());
        let most = (paper.most_px() - beside_px).max(usual);
        let plot_width_px = wanted.clamp(usual, most).floor();
        let slot_px = plot_width_px / slots;
        let level_px = slot_px - NAME_GAP_PX;
        let level: Vec<_> =
            groups.iter().map(|name| wrap(name, TICK_PX, level_px, MOST_LINES + 1)).collect();
        let upright = level.iter().any(|lines| lines.len() > MOST_LINES)
            || !groups.iter().all(|name| keeps_words(name, TICK_PX, level_px));
        let names = if upright { upright_names(groups, slot_px) } else { level };
        Self { names, upright, series, plot_width_px }
    }

    /// The width of the plot area.
    pub(crate) fn plot_width_px(&self) -> f64 {
        self.plot_width_px
    }

    /// Space below the plot area.
    pub(crate) fn below_px(&self) -> f64 {
        let names = if self.upright {
            self.names.iter().map(|lines| widest_px(lines, TICK_PX)).fold(0.0, f64::max)
        } else {
            self.names.iter().map(Vec::len).max().unwrap_or(0) as f64 * LINE_PX
        };
        TICK_LENGTH_PX + LABEL_GAP_PX + names + MARGIN_PX
    }

    /// The width of a bar or box, including gaps.
    pub(crate) fn pitch_px(&self) -> f64 {
        let slot = self.plot_width_px / self.names.len().max(1) as f64;
        (slot * FILLED / self.series.max(1) as f64).min(MOST_PITCH_PX)
    }

    /// The horizontal centre of the bar or box of a series in a group.
    pub(crate) fn x(&self, plot: Rect, group: usize, series: usize) -> f64 {
        let place = series as f64 + 0.5 - self.series as f64 / 2.0;
        self.centre(plot, group) + place * self.pitch_px()
    }

    fn centre(&self, plot: Rect, group: usize) -> f64 {
        plot.left + (group as f64 + 0.5) * plot.width() / self.names.len().max(1) as f64
    }

    /// Draws upright lines between the groups, for marks that are not close together.
    pub(crate) fn draw_dividers(&self, drawing: &mut Drawing, plot: Rect) {
        for group in 1..self.names.len() {
            let x = self.centre(plot, group - 1).midpoint(self.centre(plot, group));
            drawing.line(&[(x, plot.top), (x, plot.bottom)], GRID_STROKE);
        }
    }

    /// Draws the names, lowered by `down_px`.
    pub(crate) fn draw(&self, drawing: &mut Drawing, plot: Rect, down_px: f64) {
        let top = plot.bottom + TICK_LENGTH_PX + LABEL_GAP_PX + down_px;
        for (group, lines) in self.names.iter().enumerate() {
            let x = self.centre(plot, group);
            for (i, line) in lines.iter().enumerate() {
                if self.upright {
                    let off = (i as f64 - (lines.len() as f64 - 1.0) / 2.0) * LINE_PX;
                    let at = (x + off + CAPITAL * TICK_PX / 2.0, top);
                    drawing.text(Text::new(line, at, TICK_PX, Anchor::End).upwards());
                } else {
                    let baseline = top + TICK_PX * (1.0 - DESCENT) + i as f64 * LINE_PX;
                    drawing.text(Text::new(line, (x, baseline), TICK_PX, Anchor::Middle));
                }
            }
        }
    }
}

/// Names in as many upright lines as fit into a slot. If not even one line fits, only every second
/// or third group, and so on, has its name.
fn upright_names(groups: &[String], slot_px: f64) -> Vec<Vec<String>> {
    let lines = ((slot_px / LINE_PX).floor() as usize).clamp(1, MOST_LINES);
    let every = (LINE_PX / slot_px - 1e-9).ceil().max(1.0) as usize;
    let wrapped = |length_px: f64| -> Vec<Vec<String>> {
        let name = |(i, name): (usize, &String)| match i % every {
            0 => wrap(name, TICK_PX, length_px, lines),
            _ => Vec::new(),
        };
        groups.iter().enumerate().map(name).collect()
    };
    let whole = |names: &Vec<Vec<String>>| !names.iter().flatten().any(|line| line.ends_with('…'));
    let shortest = UPRIGHT_PX.iter().map(|length_px| wrapped(*length_px)).find(whole);
    shortest.unwrap_or_else(|| wrapped(UPRIGHT_PX[UPRIGHT_PX.len() - 1]))
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    fn axis(names: &[&str], series: usize) -> GroupAxis {
        let names: Vec<String> = names.iter().map(ToString::to_string).collect();
        GroupAxis::new(&names, series, 60.0, &Paper::wide())
    }

    #[test]
    fn names_turn_upright_when_they_must() {
        assert!(!axis(&["Sponza", "Bistro", "San Miguel"], 4).upright);
        assert!(!axis(&["a scene with a name of words"; 4], 4).upright, "wrapped");
        assert!(axis(&["unbreakablenameofascene"; 8], 1).upright);
        assert!(axis(&["Sponza"; 40], 1).upright);
    }

    #[test]
    fn many_bars_widen_the_plot_area_up_to_a_limit() {
        let Paper { column_px, page_px, .. } = Paper::wide();
        assert_eq!(axis(&["a"; 3], 4).plot_width_px(), (column_px - 60.0).floor());
        let wide = axis(&["a"; 12], 4).plot_width_px();
        assert!(wide > column_px && wide <= page_px - 60.0);
        assert_eq!(axis(&["a"; 400], 12).plot_width_px(), (page_px - 60.0).floor());
    }

    #[test]
    fn bars_of_neighbours_stay_apart() {
        for (groups, series) in [(1, 1), (3, 4), (40, 12), (400, 1)] {
            let axis = axis(&vec!["Sponza"; groups], series);
            let plot =
                Rect { left: 60.0, top: 0.0, right: 60.0 + axis.plot_width_px(), bottom: 200.0 };
            let half = axis.pitch_px() / 2.0;
            assert!(axis.x(plot, 0, 0) - half >= plot.left);
            assert!(axis.x(plot, groups - 1, series - 1) + half <= plot.right);
            if groups > 1 {
                assert!(axis.x(plot, 0, series - 1) + half < axis.x(plot, 1, 0) - half);
            }
        }
    }
}
