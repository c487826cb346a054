//! Filled rectangles with the look of a series: bars, boxes, and their keys in the legend.

use crate::canvas::drawing::{Drawing, Rect, Stroke};
use crate::canvas::look::{Colour, Look, WHITE};

/// Width of the edge in pixels.
const EDGE_PX: f64 = 0.8;

/// Width of a stripe in pixels.
const STRIPE_PX: f64 = 1.0;

/// Distance between the stripes of one group, in pixels.
const STRIPE_PITCH_PX: f64 = 2.0;

/// The share of its colour in the fill of a box. Whiskers and median remain visible on it.
pub(crate) const TINT: f64 = 0.35;

/// The edge of a series' bars and boxes.
pub(crate) fn edge(look: Look) -> Stroke {
    Stroke { colour: look.colour().darker(), width_px: EDGE_PX }
}

/// Draws a rectangle in a colour of the series, with its edge. After the first turn of the palette
/// it has horizontal stripes, in groups of one for the second turn, of two for the third, and so
/// on. They are counted from the bottom.
pub(crate) fn draw(drawing: &mut Drawing, rect: Rect, look: Look, fill: Colour) {
    drawing.rect(rect, fill, edge(look));
    if look.turn() == 0 {
        return;
    }
    let stripe = Stroke {
        colour: if fill == look.colour() { WHITE } else { look.colour() },
        width_px: STRIPE_PX,
    };
    let group_px = STRIPE_PITCH_PX * (look.turn() as f64 + 1.0);
    let mut bottom = rect.bottom - STRIPE_PITCH_PX;
    while bottom > rect.top + STRIPE_PX {
        for i in 0..look.turn() {
            let y = bottom - i as f64 * STRIPE_PITCH_PX;
            if y > rect.top + STRIPE_PX {
                drawing.line(&[(rect.left + EDGE_PX, y), (rect.right - EDGE_PX, y)], stripe);
            }
        }
        bottom -= group_px;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::drawing::Mark;

    #[test]
    fn stripes_stay_within_and_tell_the_turns_apart() {
        let stripes = |turn: usize, height: f64| {
            let look = Look::new(7 * turn);
            let rect = Rect { left: 5.0, top: 10.0, right: 15.0, bottom: 10.0 + height };
            let mut drawing = Drawing { width_px: 20.0, height_px: 90.0, marks: Vec::new() };
            draw(&mut drawing, rect, look, look.colour());
            let stripe = |mark: &Mark| match mark {
                Mark::Line(points, stroke) if stroke.colour == WHITE => Some(points[0].1),
                _ => None,
            };
            let ys: Vec<f64> = drawing.marks.iter().filter_map(stripe).collect();
            assert!(ys.iter().all(|y| *y > rect.top && *y < rect.bottom), "{ys:?}");
            ys.len()
        };
        assert_eq!([0, 1, 2].map(|turn| stripes(turn, 12.5)), [0, 3, 4]);
        assert!((0..13).all(|height| stripes(5, f64::from(height)) < 7));
    }
}
