//! The shapes of markers. Their corners are written out: the same on every machine.

use crate::drawing::{Drawing, Point};
use crate::look::{Colour, Marker, WHITE};

/// Half the size of a marker in pixels: large enough to tell the shapes apart in print.
pub(crate) const RADIUS_PX: f64 = 3.6;

/// The white rim that keeps a marker apart from one beneath it.
const RIM_PX: f64 = 0.8;

impl Marker {
    /// The corners for a radius of 1; none for a circle. The shapes have about the same area.
    fn corners(self) -> &'static [Point] {
        match self {
            Self::Circle => &[],
            Self::Square => &[(-0.88, -0.88), (0.88, -0.88), (0.88, 0.88), (-0.88, 0.88)],
            Self::Triangle => &[(0.0, -1.3), (1.18, 0.75), (-1.18, 0.75)],
            Self::TriangleDown => &[(0.0, 1.3), (-1.18, -0.75), (1.18, -0.75)],
            Self::Diamond => &[(0.0, -1.3), (1.05, 0.0), (0.0, 1.3), (-1.05, 0.0)],
            Self::Plus => &[
                (-0.4, -1.2),
                (0.4, -1.2),
                (0.4, -0.4),
                (1.2, -0.4),
                (1.2, 0.4),
                (0.4, 0.4),
                (0.4, 1.2),
                (-0.4, 1.2),
                (-0.4, 0.4),
                (-1.2, 0.4),
                (-1.2, -0.4),
                (-0.4, -0.4),
            ],
            Self::Hexagon => &[
                (0.0, -1.15),
                (1.0, -0.575),
                (1.0, 0.575),
                (0.0, 1.15),
                (-1.0, 0.575),
                (-1.0, -0.575),
            ],
        }
    }
}

/// A marker around a place, with a white rim.
pub(crate) fn draw(
    drawing: &mut Drawing,
    (x, y): Point,
    marker: Marker,
    radius_px: f64,
    colour: Colour,
) {
    for (radius, colour) in [(radius_px + RIM_PX, WHITE), (radius_px, colour)] {
        let corners: Vec<Point> =
            marker.corners().iter().map(|(dx, dy)| (x + dx * radius, y + dy * radius)).collect();
        if corners.is_empty() {
            drawing.disc((x, y), radius, colour);
        } else {
            drawing.area(corners, colour);
        }
    }
}
