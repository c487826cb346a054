//! Leaves out what nobody could see: points of very long curves, and marks on top of each other.

use super::drawing::Point;

/// Curves with fewer points stay as they are.
const MOST_POINTS: usize = 10_000;
/// The width of a column, of which a curve keeps four points. At 300 pixels per inch, the finest that figures
/// are written with, a pixel of the picture is wider.
const COLUMN_PX: f64 = 0.25;

/// A curve without the points that lie, within a narrow column, between the first, the lowest, the highest and
/// the last one. It looks the same, and its size no longer depends on the number of points.
pub(crate) fn thinned(points: Vec<Point>) -> Vec<Point> {
    if points.len() <= MOST_POINTS {
        return points;
    }
    let mut kept = Vec::new();
    for of_column in points.chunk_by(|(a, _), (b, _)| column(*a) == column(*b)) {
        let by_height = |a: &usize, b: &usize| of_column[*a].1.total_cmp(&of_column[*b].1);
        let lowest = (0..of_column.len()).min_by(by_height).unwrap_or(0);
        let highest = (0..of_column.len()).max_by(by_height).unwrap_or(0);
        let mut at = [0, lowest, highest, of_column.len() - 1];
        at.sort_unstable();
        for (nth, index) in at.iter().enumerate() {
            if nth == 0 || at[nth - 1] != *index {
                kept.push(of_column[*index]);
            }
        }
    }
    kept
}

/// Positions of marks that are drawn where they are: of those on top of each other, only some.
const MOST_MARKS: usize = 1_000;

/// Rising or falling positions along a line without those that are too near to the one before.
pub(crate) fn apart(mut positions: Vec<f64>) -> Vec<f64> {
    if positions.len() > MOST_MARKS {
        let mut before = f64::NAN;
        positions.retain(|at| {
            let is_near = (at - before).abs() < COLUMN_PX;
            before = if is_near { before } else { *at };
            !is_near
        });
    }
    positions
}

fn column(x: f64) -> i64 {
    (x / COLUMN_PX).floor() as i64
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    #[test]
    fn extremes_and_ends_of_each_column_are_kept() {
        let wave = |n: usize| -> Vec<Point> {
            (0..n).map(|at| (at as f64 / n as f64 * 100.0, (at as f64 * 0.7).sin())).collect()
        };
        assert_eq!(thinned(wave(MOST_POINTS)), wave(MOST_POINTS));
        let long = wave(100 * MOST_POINTS);
        let kept = thinned(long.clone());
        assert!(kept.len() <= 4 * 400 && kept.is_sorted_by(|(a, _), (b, _)| a < b));
        assert_eq!((kept.first(), kept.last()), (long.first(), long.last()));
        let range = |points: &[Point], of: i64| {
            let heights = points.iter().filter(|(x, _)| column(*x) == of).map(|(_, y)| *y);
            heights.fold([f64::MAX, f64::MIN], |[low, high], y| [low.min(y), high.max(y)])
        };
        for of in 0..400 {
            assert_eq!(range(&kept, of), range(&long, of), "{of}");
        }
    }

    #[test]
    fn marks_on_top_of_each_other_are_one() {
        let few = vec![1.0; MOST_MARKS];
        assert_eq!(apart(few.clone()), few);
        let many: Vec<f64> = (0..=MOST_MARKS).map(|at| at as f64 * 0.1).collect();
        let kept = apart(many);
        assert!(kept.len() < MOST_MARKS / 2, "{}", kept.len());
        assert_eq!(kept[..3], [0.0, 0.1 * 3.0, 0.1 * 6.0]);
        assert_eq!(apart(vec![7.0; MOST_MARKS + 1]), [7.0]);
    }

    #[test]
    fn a_single_point_in_a_column_is_kept_once() {
        let rare: Vec<Point> = (0..2 * MOST_POINTS).map(|at| (at as f64, 1.0)).collect();
        assert_eq!(thinned(rare.clone()), rare);
    }
}
