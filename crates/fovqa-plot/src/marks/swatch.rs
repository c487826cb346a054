//! Filled rectangles with the look of a series: bars, boxes, and their keys in the legend.

use crate::canvas::colour::{Colour, WHITE};
use crate::canvas::drawing::{Drawing, Rect, Stroke};
use crate::canvas::look::Look;
use crate::marks::hatch;

/// Width of the edge in pixels.
const EDGE_PX: f64 = 0.8;

/// Width of a line of the hatch in pixels.
const HATCH_PX: f64 = 1.0;

/// Distance between the lines of the hatch along the axes, in pixels.
const HATCH_PITCH_PX: f64 = 5.0;

/// The share of its colour in the fill of a box. Whiskers and median remain visible on it.
pub(crate) const TINT: f64 = 0.35;

/// The edge of a series' bars and boxes.
pub(crate) fn edge(look: Look) -> Stroke {
    Stroke { colour: look.colour().darker(), width_px: EDGE_PX }
}

/// Draws a rectangle in a colour of the series, with its hatch and its edge.
pub(crate) fn draw(drawing: &mut Drawing, rect: Rect, look: Look, fill: Colour) {
    let corners = rect.corners();
    drawing.area(corners.to_vec(), fill);
    let line = Stroke {
        colour: if fill == look.colour() { WHITE } else { look.colour() },
        width_px: HATCH_PX,
    };
    hatch::draw(drawing, &corners, look.hatch(), (HATCH_PITCH_PX, line));
    drawing.frame(rect, edge(look));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::drawing::Mark;

    #[test]
    fn series_differ_by_their_hatch() {
        let rect = Rect { left: 5.0, top: 10.0, right: 15.0, bottom: 40.0 };
        let hatches: Vec<Vec<Mark>> = (0..7)
            .map(|i| {
                let look = Look::new(i);
                let mut drawing = Drawing { width_px: 20.0, height_px: 90.0, marks: Vec::new() };
                draw(&mut drawing, rect, look, look.colour());
                let is_hatch = |mark: &Mark| matches!(mark, Mark::Line(_, s) if s.colour == WHITE);
                drawing.marks.into_iter().filter(is_hatch).collect()
            })
            .collect();
        assert!(hatches[0].is_empty());
        for (i, a) in hatches.iter().enumerate().skip(1) {
            assert!(a.len() >= 2, "{i}");
            assert!(hatches[..i].iter().all(|b| a != b), "{i}");
        }
    }
}
