//! Brackets above a plot area that connect bars which are compared, each with a text such as stars of
//! significance. Those that overlap are at different heights.

use crate::canvas::colour::INK;
use crate::canvas::drawing::{Anchor, Drawing, Point, Stroke, Text};
use crate::canvas::text::VALUE_PX;
use crate::charts::bar::Bracket;

/// Height of a level: the bracket and its text.
const LEVEL_PX: f64 = 17.0;
/// Length of the ends of a bracket, which point at its bars.
const END_PX: f64 = 4.0;
/// Distance between the text and the bracket.
const GAP_PX: f64 = 2.0;
/// Space below the lowest bracket.
const BELOW_PX: f64 = 4.0;
const LINE_PX: f64 = 1.0;

/// Brackets with the level of each, 0 for the lowest.
pub(crate) struct Levels<'a> {
    brackets: Vec<(&'a Bracket, usize)>,
}

impl<'a> Levels<'a> {
    /// Puts short brackets below long ones, and those that overlap at different levels.
    pub(crate) fn of(brackets: &'a [Bracket], series: usize) -> Self {
        let slot = |[group, of]: [usize; 2]| group * series.max(1) + of;
        let span = |bracket: &Bracket| {
            let [a, b] = bracket.ends.map(slot);
            (a.min(b), a.max(b))
        };
        let mut sorted: Vec<&Bracket> = brackets.iter().collect();
        sorted.sort_by_key(|bracket| {
            let (from, to) = span(bracket);
            (to - from, from)
        });
        let mut levels: Vec<Vec<(usize, usize)>> = Vec::new();
        let mut placed = Vec::new();
        for bracket in sorted {
            let (from, to) = span(bracket);
            let is_free = |level: &Vec<(usize, usize)>| {
                level.iter().all(|&(first, last)| to < first || last < from)
            };
            let level = levels.iter().position(is_free).unwrap_or_else(|| {
                levels.push(Vec::new());
                levels.len() - 1
            });
            levels[level].push((from, to));
            placed.push((bracket, level));
        }
        Self { brackets: placed }
    }

    /// The height of all levels.
    pub(crate) fn height_px(&self) -> f64 {
        let levels = self.brackets.iter().map(|(_, level)| level + 1).max();
        levels.map_or(0.0, |levels| levels as f64 * LEVEL_PX + BELOW_PX)
    }

    /// Draws the brackets upwards from a height. `x` is the position of a bar.
    pub(crate) fn draw(&self, drawing: &mut Drawing, base: f64, x: impl Fn([usize; 2]) -> f64) {
        let stroke = Stroke { colour: INK, width_px: LINE_PX };
        for (bracket, level) in &self.brackets {
            let y = base - BELOW_PX - *level as f64 * LEVEL_PX - END_PX;
            let [from, to] = bracket.ends.map(&x);
            let line: [Point; 4] = [(from, y + END_PX), (from, y), (to, y), (to, y + END_PX)];
            drawing.line(&line, stroke);
            let at = (f64::midpoint(from, to), y - GAP_PX);
            drawing.text(Text::new(&bracket.label, at, VALUE_PX, Anchor::Middle));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_that_overlap_are_at_different_heights() {
        let bracket = |a: [usize; 2], b: [usize; 2]| Bracket { ends: [a, b], label: String::new() };
        // Bars 0 and 1, 2 and 3, and 0 and 3 of two groups of two series.
        let brackets = [bracket([0, 0], [1, 1]), bracket([0, 1], [0, 0]), bracket([1, 0], [1, 1])];
        let levels = Levels::of(&brackets, 2);
        let found: Vec<usize> = levels.brackets.iter().map(|(_, level)| *level).collect();
        assert_eq!(found, [0, 0, 1]);
        assert!((levels.height_px() - 2.0 * LEVEL_PX - BELOW_PX).abs() < 1e-12);
        assert!(Levels::of(&[], 2).height_px() == 0.0);
    }
}
