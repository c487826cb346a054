//! Small labels above or below their marks: values, "n/a", "∞". All labels of one kind in a figure
//! have the same orientation, horizontal or upright, which depends on the narrowest slot.

use crate::canvas::drawing::{Anchor, Drawing, Point, Text};
use crate::canvas::text::{CAPITAL, VALUE_PX, width_px};

/// Distance from a mark to its label.
pub(crate) const GAP_PX: f64 = 4.0;
/// The smallest space between two labels.
const APART_PX: f64 = 3.0;

/// The orientation of labels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Orientation {
    /// Horizontal.
    Level,
    /// Upright, read upwards.
    Upright,
    /// Labels are not drawn, because there is no room.
    Nowhere,
}

/// The side of its mark on which a label is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Above,
    Below,
}

impl Orientation {
    /// The orientation in which labels of a width fit beside each other, at a distance of
    /// `pitch_px`.
    pub(crate) fn of(widest_px: f64, pitch_px: f64) -> Self {
        if widest_px + APART_PX <= pitch_px {
            Self::Level
        } else if VALUE_PX <= pitch_px {
            Self::Upright
        } else {
            Self::Nowhere
        }
    }

    /// How far labels of a width extend from their marks.
    pub(crate) fn reach_px(self, widest_px: f64) -> f64 {
        match self {
            Self::Level => GAP_PX + VALUE_PX,
            Self::Upright => 2.0 * GAP_PX + widest_px,
            Self::Nowhere => GAP_PX,
        }
    }

    /// Draws a label at the end of a mark.
    pub(crate) fn draw(self, drawing: &mut Drawing, label: &str, (x, y): Point, side: Side) {
        let capital = CAPITAL * VALUE_PX;
        let middle = x + capital / 2.0;
        let text = |at, anchor| Text::new(label, at, VALUE_PX, anchor);
        match (self, side) {
            (Self::Level, Side::Above) => drawing.text(text((x, y - GAP_PX), Anchor::Middle)),
            (Self::Level, Side::Below) => {
                drawing.text(text((x, y + GAP_PX + capital), Anchor::Middle));
            }
            (Self::Upright, Side::Above) => {
                drawing.text(text((middle, y - GAP_PX), Anchor::Start).upwards());
            }
            (Self::Upright, Side::Below) => {
                drawing.text(text((middle, y + GAP_PX), Anchor::End).upwards());
            }
            (Self::Nowhere, _) => {}
        }
    }
}

/// The width of the widest label.
pub(crate) fn widest_px<'a>(labels: impl IntoIterator<Item = &'a str>) -> f64 {
    labels.into_iter().map(|label| width_px(label, VALUE_PX)).fold(0.0, f64::max)
}
