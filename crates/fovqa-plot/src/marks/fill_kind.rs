//! The look of an area between two curves: its meaning and its hatch.

use crate::canvas::drawing::{Drawing, Point, Rect, Stroke};
use crate::canvas::look::{Colour, DEFICIT, DEFICIT_HATCH, SURPLUS, SURPLUS_EDGE};

/// Horizontal distance between the lines of the hatch.
const HATCH_PITCH_PX: f64 = 6.0;
/// Width of a line of the hatch, and of the edge of a key.
const HATCH_PX: f64 = 0.9;

/// The meaning of an area between two curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FillKind {
    /// More than is needed, such as over-sampling. It is plain light blue.
    #[default]
    Surplus,
    /// Less than is needed, such as under-sampling. It is orange and hatched, so that it can be
    /// recognised without colour.
    Deficit,
}

impl FillKind {
    /// Fills an area, with its hatch.
    pub(crate) fn draw(self, drawing: &mut Drawing, corners: &[Point]) {
        let (fill, hatch) = self.colours();
        drawing.area(corners.to_vec(), fill);
        if self == Self::Deficit {
            for line in hatch_lines(corners) {
                drawing.line(&line, Stroke { colour: hatch, width_px: HATCH_PX });
            }
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
        }
    }
}

/// Lines within an area that rise to the right. Their positions are the same in the whole picture,
/// so that two adjacent areas look like one.
fn hatch_lines(corners: &[Point]) -> Vec<[Point; 2]> {
    let along = |(x, y): Point| (x + y) / HATCH_PITCH_PX;
    let (first, last) =
        corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
            (low.min(along(*p)), high.max(along(*p)))
        });
    if first > last {
        return Vec::new();
    }
    let line = |count: i64| {
        let off = |p: Point| along(p) - count as f64;
        let mut crossings: Vec<Point> = Vec::new();
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (before, after) = (off(*a), off(*b));
            if (before < 0.0) != (after < 0.0) {
                let share = before / (before - after);
                crossings.push((a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share));
            }
        }
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let pairs = crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
        pairs.filter(|[from, to]| to.0 - from.0 > HATCH_PX / 2.0).collect::<Vec<_>>()
    };
    (first.ceil() as i64..=last.floor() as i64).flat_map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hatch_stays_within() {
        let triangle = [(10.0, 10.0), (90.0, 10.0), (10.0, 90.0)];
        let lines = hatch_lines(&triangle);
        assert!(lines.len() > 10);
        for (x, y) in lines.concat() {
            assert!(x >= 10.0 - 1e-9 && y >= 10.0 - 1e-9 && x + y <= 100.0 + 1e-9);
            assert!(
                ((x + y) / HATCH_PITCH_PX).fract().min(1.0 - ((x + y) / HATCH_PITCH_PX).fract())
                    < 1e-6
            );
        }
        assert!(hatch_lines(&[]).is_empty());
    }

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
