//! Areas between two curves, which show where one is above the other, and where below.

use crate::canvas::clip;
use crate::canvas::drawing::Point;
use crate::marks::fill_kind::FillKind;
use crate::marks::legend::Key;
use crate::scales::scale::{AxisPlace, Scale};

/// A smaller share of the plot area is not visible.
const LEAST_SHARE: f64 = 1e-9;

/// An area between two curves, behind all curves of its chart and over the grid.
///
/// It lies where `low` is below `high` and ends exactly where they cross. If the same two curves
/// are passed once in each order, they make two areas that share no point. The area does not widen
/// the axes; only the part within them is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fill {
    /// Its name in the legend, which shows each name once.
    pub name: String,
    /// The meaning of the area.
    pub kind: FillKind,
    /// `(x, low, high)` in the order of the curves. NaN leaves a gap. Infinite values, and on a
    /// logarithmic axis values that are not above 0, extend beyond the border.
    pub points: Vec<(f64, f64, f64)>,
}

/// Shares of the axes: the horizontal position, and the vertical positions of the two curves.
type Slice = (f64, f64, f64);

impl Fill {
    /// The visible areas for two axes, as shares of the axes.
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

/// A point of both curves; `None` if one of the numbers is NaN.
fn slice(x: Scale, y: Scale, at: f64, low: f64, high: f64) -> Option<Slice> {
    let up = |value: f64| {
        Some(match AxisPlace::of(value)? {
            AxisPlace::At(value) => y.share(value).clamp(-clip::FAR, clip::FAR),
            AxisPlace::Above => clip::FAR,
            AxisPlace::Below => -clip::FAR,
        })
    };
    let at = AxisPlace::of(at)?.finite()?;
    Some((x.share(at).clamp(-clip::FAR, clip::FAR), up(low)?, up(high)?))
}

/// The points of both curves, and additional points where the curves cross.
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

/// The stretches in which the upper curve is above the lower one.
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

/// The outline along the upper curve and back along the lower one.
fn outline(slices: &[Slice]) -> Vec<Point> {
    let upper = slices.iter().map(|(x, _, high)| (*x, *high));
    let lower = slices.iter().rev().map(|(x, low, _)| (*x, *low));
    upper.chain(lower).collect()
}

fn size(corners: &[Point]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum::<f64>().abs() / 2.0
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
}
