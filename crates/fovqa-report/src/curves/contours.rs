//! Lines of equal density through the cells of a map (marching squares).

use std::collections::BTreeMap;

use fovqa_methods::curves::DensityMap;
use fovqa_plot::RasterLine;

/// Levels in each power of ten.
const LEVELS: [f64; 3] = [1.0, 2.0, 5.0];
/// The powers of ten in which levels are looked for.
const POWERS: std::ops::RangeInclusive<i32> = -4..=3;
/// A line with fewer points is a speck.
const LEAST_POINTS: usize = 8;

/// Side of a square of cells: row, column, and whether it goes down. A line crosses it at one point.
type Side = (usize, usize, bool);

/// The lines of round levels between the lowest and the highest value.
pub(super) fn contours(map: &DensityMap, (width, height): (f64, f64)) -> Vec<RasterLine> {
    let steps = (width / map.columns as f64, height / map.rows as f64);
    let levels = POWERS.flat_map(|power| LEVELS.map(|level| (level, power)));
    let mut lines = Vec::new();
    for (digit, power) in levels {
        // From the text, so that 0.2 is 0.2 and not 2 x 0.1.
        let level: f64 = format!("{digit}e{power}").parse().unwrap_or(f64::NAN);
        let found = lines_at(map, level).into_iter().filter(|line| line.len() >= LEAST_POINTS);
        for (i, line) in found.enumerate() {
            let points = line.into_iter().map(|(x, y)| (x * steps.0, y * steps.1)).collect();
            // Each level is labelled once.
            let name = if i == 0 { level.to_string() } else { String::new() };
            lines.push(RasterLine { name, points });
        }
    }
    lines
}

/// The lines of a level, in cells from the upper left corner of the map.
fn lines_at(map: &DensityMap, level: f64) -> Vec<Vec<(f64, f64)>> {
    let value = |row: usize, column: usize| map.values[row * map.columns + column];
    let above = |row: usize, column: usize| value(row, column) >= level;
    let mut next: BTreeMap<Side, Vec<Side>> = BTreeMap::new();
    for row in 0..map.rows.saturating_sub(1) {
        for column in 0..map.columns.saturating_sub(1) {
            let sides = [
                (row, column, false),
                (row, column + 1, true),
                (row + 1, column, false),
                (row, column, true),
            ];
            let corners = [(0, 0), (0, 1), (1, 1), (1, 0)]
                .map(|(down, right)| above(row + down, column + right));
            let crossed: Vec<Side> =
                (0..4).filter(|&i| corners[i] != corners[(i + 1) % 4]).map(|i| sides[i]).collect();
            // In a saddle two lines pass; they are paired in the order of the sides.
            for pair in crossed.chunks_exact(2) {
                next.entry(pair[0]).or_default().push(pair[1]);
                next.entry(pair[1]).or_default().push(pair[0]);
            }
        }
    }
    let point = |(row, column, down): Side| {
        let (a, b) =
            (value(row, column), value(row + usize::from(down), column + usize::from(!down)));
        let share = if a.is_finite() && b.is_finite() { (level - a) / (b - a) } else { 0.5 };
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        if down { (x, y + share) } else { (x + share, y) }
    };
    let mut lines = Vec::new();
    // Lines that end at the border begin there; those that remain are closed.
    let ends: Vec<Side> =
        next.iter().filter(|(_, to)| to.len() == 1).map(|(side, _)| *side).collect();
    let starts: Vec<Side> = ends.into_iter().chain(next.keys().copied()).collect();
    for start in starts {
        let mut line = Vec::new();
        let mut at = Some(start);
        while let Some(side) = at {
            let Some(to) = next.remove(&side) else {
                // The line is closed.
                line.push(point(side));
                break;
            };
            line.push(point(side));
            let before = line.len();
            at = to.iter().copied().find(|side| next.contains_key(side));
            if at.is_none() && before > 2 && to.contains(&start) {
                at = Some(start);
            }
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(columns: usize, rows: usize, of: impl Fn(f64, f64) -> f64) -> DensityMap {
        let values = (0..rows * columns)
            .map(|i| of((i % columns) as f64 + 0.5, (i / columns) as f64 + 0.5))
            .collect();
        DensityMap { columns, rows, values }
    }

    #[test]
    fn a_cone_has_closed_circles() {
        let cone = map(40, 40, |x, y| 1.0 - (x - 20.0).hypot(y - 20.0) / 20.0);
        let lines = lines_at(&cone, 0.5);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].len() > 40 && lines[0].first() == lines[0].last());
        assert!(lines[0].iter().all(|(x, y)| ((x - 20.0).hypot(y - 20.0) - 10.0).abs() < 0.05));
    }

    #[test]
    fn a_slope_has_lines_from_border_to_border_with_one_label_each() {
        let slope = map(30, 10, |x, _| x / 30.0);
        let lines = contours(&slope, (300.0, 200.0));
        let names: Vec<&str> = lines.iter().map(|line| line.name.as_str()).collect();
        assert_eq!(names, ["0.02", "0.05", "0.1", "0.2", "0.5"]);
        for line in &lines {
            let at = 300.0 * line.name.parse::<f64>().unwrap();
            assert!(line.points.iter().all(|(x, _)| (x - at).abs() < 1e-9), "{line:?}");
            assert!(line.points.len() == 10);
        }
    }
}
