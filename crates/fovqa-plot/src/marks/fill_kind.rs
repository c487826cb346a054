//! The look of an area between two curves: its meaning and its hatch.

use crate::canvas::colour::{Colour, DEFICIT, DEFICIT_HATCH, SURPLUS, SURPLUS_EDGE};
use crate::canvas::drawing::{Drawing, Point, Rect, Stroke};
use crate::canvas::look::{Hatch, Look};
use crate::marks::hatch;

/// Horizontal distance between the lines of the hatch.
const HATCH_PITCH_PX: f64 = 6.0;
/// Width of a line of the hatch, and of the edge of a key.
const HATCH_PX: f64 = 0.9;

/// The share of the colour of a series in its band.
const BAND_TINT: f64 = 0.3;

/// The meaning of an area between two curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FillKind {
    /// More than is needed, such as over-sampling. It is plain light blue.
    #[default]
    Surplus,
    /// Less than is needed, such as under-sampling. It is orange and hatched, so that it can be
    /// recognised without colour.
    Deficit,
    /// The range of a series, such as all rates of a method over several displays. It has a tint of
    /// the colour of the series.
    Band(Look),
}

impl FillKind {
    /// Fills an area, with its hatch.
    pub(crate) fn draw(self, drawing: &mut Drawing, corners: &[Point]) {
        let (fill, line) = self.colours();
        drawing.area(corners.to_vec(), fill);
        if self == Self::Deficit {
            let stroke = Stroke { colour: line, width_px: HATCH_PX };
            hatch::draw(drawing, corners, Hatch::Rising, (HATCH_PITCH_PX, stroke));
        }
    }

    /// Fills the key in the legend, with an edge because it is small.
    pub(crate) fn draw_key(self, drawing: &mut Drawing, rect: Rect) {
        self.draw(drawing, &rect.corners());
        drawing.frame(rect, Stroke { colour: self.colours().1, width_px: HATCH_PX });
    }

    /// The colour of the area, and that of lines in and around it.
    fn colours(self) -> (Colour, Colour) {
        match self {
            Self::Surplus => (SURPLUS, SURPLUS_EDGE),
            Self::Deficit => (DEFICIT, DEFICIT_HATCH),
            Self::Band(look) => (look.colour().tint(BAND_TINT), look.colour()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kinds_differ_without_colour() {
        let gray = |Colour(r, g, b): Colour| {
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        assert!(gray(DEFICIT) - gray(DEFICIT_HATCH) > 60.0, "the hatch is seen");
        let marks = |kind: FillKind| {
            let mut drawing = Drawing { width_px: 90.0, height_px: 90.0, marks: Vec::new() };
            kind.draw(&mut drawing, &[(0.0, 0.0), (90.0, 0.0), (90.0, 90.0)]);
            drawing.marks.len()
        };
        assert_eq!(marks(FillKind::Surplus), 1);
        assert!(marks(FillKind::Deficit) > 10);
    }
}
