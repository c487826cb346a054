//! The shapes of markers. Their corners are constants, so that they are the same on every machine.

use crate::canvas::colour::{Colour, WHITE};
use crate::canvas::drawing::{Drawing, Point};
use crate::canvas::look::{Look, Marker};

/// Half the size of a marker in pixels, large enough to distinguish the shapes in print.
pub(crate) const RADIUS_PX: f64 = 3.6;

/// The white rim that separates a marker from one below it.
const RIM_PX: f64 = 0.8;

impl Marker {
    /// The corners for a radius of 1; empty for a circle. All shapes have about the same area.
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

/// The radius of the hole when the shapes repeat, as a share of the radius, and that of the dot
/// inside the hole when they repeat again.
const HOLE: f64 = 0.55;
const DOT: f64 = 0.25;

/// Draws a marker with a white rim. When the shapes repeat it is hollow, and when they repeat again
/// it has a dot inside.
pub(crate) fn draw(drawing: &mut Drawing, at: Point, look: Look, radius_px: f64, colour: Colour) {
    let mut rings = vec![(radius_px + RIM_PX, WHITE), (radius_px, colour)];
    if look.turn() > 0 {
        rings.push((radius_px * HOLE, WHITE));
    }
    if look.turn() > 1 {
        rings.push((radius_px * DOT, colour));
    }
    for (radius, colour) in rings {
        shape(drawing, at, look.marker(), radius, colour);
    }
}

/// Draws a ring with an outer and an inner radius. It hides what is inside.
pub(crate) fn draw_ring(
    drawing: &mut Drawing,
    at: Point,
    (outer_px, inner_px): (f64, f64),
    colour: Colour,
) {
    drawing.disc(at, outer_px, colour);
    drawing.disc(at, inner_px, WHITE);
}

fn shape(drawing: &mut Drawing, (x, y): Point, marker: Marker, radius_px: f64, colour: Colour) {
    let corner = |(dx, dy): &Point| (x + dx * radius_px, y + dy * radius_px);
    let corners: Vec<Point> = marker.corners().iter().map(corner).collect();
    if corners.is_empty() {
        drawing.disc((x, y), radius_px, colour);
    } else {
        drawing.area(corners, colour);
    }
}
