//! Areas between two curves: where one has more than the other, and where less.

use crate::clip;
use crate::drawing::{Drawing, Point, Rect, Stroke};
use crate::legend::Key;
use crate::look::{Colour, DEFICIT, DEFICIT_HATCH, SURPLUS, SURPLUS_EDGE};
use crate::scale::{Place, Scale};

/// From a line of the hatch to the next, along a level line.
const HATCH_PITCH_PX: f64 = 6.0;
/// Width of a line of the hatch, and of the edge of a key.
const HATCH_PX: f64 = 0.9;
/// A smaller share of the plot area is nothing to see.
const LEAST_SHARE: f64 = 1e-9;

/// What an area between two curves says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FillKind {
    /// More than is needed, such as over-sampling: a plain light blue.
    #[default]
    Surplus,
    /// Less than is needed, such as under-sampling: orange and hatched, so that it is told apart
    /// without colour.
    Deficit,
}

/// An area between two curves, behind all curves of its chart and over the grid.
///
/// It lies where `low` is below `high` and ends exactly where they cross, so that the same two
/// curves, handed over once each way, are two areas that share no point. It does not widen the
/// axes; the part within them is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fill {
    /// Its name in the legend, which shows each name once.
    pub name: String,
    /// What it says.
    pub kind: FillKind,
    /// `(x, low, high)` in the order of the curves. What is not a number leaves a gap; infinite
    /// values, and on a logarithmic axis those not above 0, reach beyond the border.
    pub points: Vec<(f64, f64, f64)>,
}

/// Shares of the axes: along, and up to the two curves.
type Slice = (f64, f64, f64);

impl Fill {
    /// The areas to be seen on two axes, as shares of them.
    pub(crate) fn areas(&self, x: Scale, y: Scale) -> Vec<Vec<Point>> {
        let slices: Vec<_> =
            self.points.iter().map(|(at, low, high)| slice(x, y, *at, *low, *high)).collect();
        let areas = slices.split(Option::is_none).flat_map(|run| {
            let run: Vec<Slice> = run.iter().copied().flatten().collect();
            above(&with_crossings(&run))
        });
        areas
            .map(|slices| clip::area(&outline(&slices)))
            .filter(|c| size(c) > LEAST_SHARE)
            .collect()
    }

    pub(crate) fn key(&self) -> (&str, Key) {
        (self.name.as_str(), Key::Fill(self.kind))
    }
}

/// A point of both curves; none where one is no number.
fn slice(x: Scale, y: Scale, at: f64, low: f64, high: f64) -> Option<Slice> {
    let up = |value: f64| {
        Some(match Place::of(value)? {
            Place::At(value) => y.share(value).clamp(-clip::FAR, clip::FAR),
            Place::Above => clip::FAR,
            Place::Below => -clip::FAR,
        })
    };
    let at = Place::of(at)?.finite()?;
    Some((x.share(at).clamp(-clip::FAR, clip::FAR), up(low)?, up(high)?))
}

/// The points of both curves and those between where they cross.
fn with_crossings(run: &[Slice]) -> Vec<Slice> {
    let mut all: Vec<Slice> = run.first().copied().into_iter().collect();
    for ends in run.windows(2) {
        let ((x0, low0, high0), (x1, low1, high1)) = (ends[0], ends[1]);
        let (before, after) = (high0 - low0, high1 - low1);
        if before * after < 0.0 {
            let share = before / (before - after);
            let up = low0 + (low1 - low0) * share;
            all.push((x0 + (x1 - x0) * share, up, up));
        }
        all.push(ends[1]);
    }
    all
}

/// The stretches over which the upper curve is above the lower one.
fn above(slices: &[Slice]) -> Vec<Vec<Slice>> {
    let mut stretches: Vec<Vec<Slice>> = Vec::new();
    let mut open = false;
    for ends in slices.windows(2) {
        let gap = |(_, low, high): Slice| high - low;
        let (before, after) = (gap(ends[0]), gap(ends[1]));
        let is_above = before >= 0.0 && after >= 0.0 && before + after > 0.0;
        if is_above && !open {
            stretches.push(vec![ends[0]]);
        }
        if let (true, Some(stretch)) = (is_above, stretches.last_mut()) {
            stretch.push(ends[1]);
        }
        open = is_above;
    }
    stretches
}

/// Along the upper curve, and back along the lower one.
fn outline(slices: &[Slice]) -> Vec<Point> {
    let upper = slices.iter().map(|(x, _, high)| (*x, *high));
    let lower = slices.iter().rev().map(|(x, low, _)| (*x, *low));
    upper.chain(lower).collect()
}

fn size(corners: &[Point]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum::<f64>().abs() / 2.0
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

    /// Fills the key in the legend, with an edge: it is small.
    pub(crate) fn draw_key(self, drawing: &mut Drawing, rect: Rect) {
        self.draw(drawing, &rect.corners());
        drawing.frame(rect, Stroke { colour: self.colours().1, width_px: HATCH_PX });
    }

    /// Of the area, and of lines in and around it.
    fn colours(self) -> (Colour, Colour) {
        match self {
            Self::Surplus => (SURPLUS, SURPLUS_EDGE),
            Self::Deficit => (DEFICIT, DEFICIT_HATCH),
        }
    }
}

/// Lines rising to the right within an area. They lie alike in the whole picture, so that two
/// areas beside each other look like one.
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
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    const UNIT: Scale = Scale { low: 0.0, high: 1.0, log: false };

    fn areas(points: &[(f64, f64, f64)]) -> Vec<Vec<Point>> {
        let fill = Fill { points: points.to_vec(), ..Fill::default() };
        fill.areas(UNIT, UNIT)
    }

    #[test]
    fn lie_where_low_is_below_high() {
        let curves = [(0.0, 0.0, 0.5), (0.5, 0.5, 0.0), (1.0, 0.5, 0.25)];
        assert_eq!(areas(&curves), [[(0.0, 0.5), (0.25, 0.25), (0.25, 0.25), (0.0, 0.0)]]);
        let swapped = curves.map(|(x, low, high)| (x, high, low));
        let other = areas(&swapped);
        assert_eq!(other[0][0], (0.25, 0.25), "from the crossing on");
        assert!((size(&other[0]) - (0.0625 + 0.1875)).abs() < 1e-12);
        assert!(areas(&[(0.0, 0.5, 0.5), (1.0, 0.5, 0.5)]).is_empty());
        let later = &areas(&[(0.0, 0.5, 0.5), (0.5, 0.5, 0.5), (1.0, 0.5, 1.0)])[0];
        assert!(later.iter().all(|(x, _)| *x >= 0.5), "not along equal curves");
    }

    #[test]
    fn end_at_the_border_and_at_gaps() {
        let beyond = areas(&[(-1.0, 0.5, 9.0), (3.0, 0.5, f64::INFINITY)]);
        assert_eq!(beyond.len(), 1);
        assert!((size(&beyond[0]) - 0.5).abs() < 1e-9, "{beyond:?}");
        let (nan, wide) = (f64::NAN, [0.0, 0.25, 0.5, 0.75]);
        let gap = wide.map(|x| (x, 0.0, if x == 0.25 { nan } else { 1.0 }));
        let found = areas(&gap);
        assert_eq!(found.len(), 1);
        assert_eq!(size(&found[0]), 0.25);
        assert!(areas(&[(0.0, 2.0, 3.0), (1.0, 2.0, 3.0)]).is_empty());
    }

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
