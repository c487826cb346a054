//! The legend: one or more rows of keys and names above the plot area, where it covers no data.

use std::collections::BTreeSet;

use crate::canvas::colour::{REFERENCE, SPAN, SPAN_EDGE};
use crate::canvas::drawing::{Anchor, Drawing, Point, Rect, Stroke, Text};
use crate::canvas::look::Look;
use crate::canvas::text::{CAPITAL, LINE_PITCH, TICK_PX};
use crate::canvas::wrap::{widest_px, wrap};
use crate::charts::line::DOT_PX;
use crate::marks::fill_kind::FillKind;
use crate::marks::marker;
use crate::marks::swatch;

/// Width of a key in pixels, enough for one and a half dashes.
const KEY_PX: f64 = 24.0;
/// Distance from a key to its name.
const KEY_GAP_PX: f64 = 5.0;
/// Distance from a name to the next key.
const ENTRY_GAP_PX: f64 = 14.0;
/// Additional distance between two rows.
const ROW_GAP_PX: f64 = 2.0;
/// The largest number of lines of a name.
const MOST_LINES: usize = 3;
/// Half the height of the key of a bar or box.
const HALF_SWATCH_PX: f64 = 4.5;

/// Width of the edge of a span's key.
const SPAN_EDGE_PX: f64 = 0.8;

/// Width of the curve of a series in pixels.
pub(crate) const CURVE_PX: f64 = 1.6;
/// Width of a reference curve.
pub(crate) const REFERENCE_PX: f64 = 1.4;

/// The way in which a series, area or span is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Key {
    /// A curve with markers.
    Curve(Look),
    /// A curve without markers.
    Line(Look),
    /// A dashed reference curve.
    Reference(Look),
    /// Filled bars.
    Bar(Look),
    /// Boxes filled with a tint.
    Box(Look),
    /// Markers only.
    Marker(Look),
    /// Small dots.
    Dot(Look),
    /// Rings with an outer and an inner radius.
    Ring(Look, (f64, f64)),
    /// An area between two curves.
    Fill(FillKind),
    /// A shaded span.
    Span,
}

/// The legend: the lines of each name and its position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Legend {
    entries: Vec<(Key, Vec<String>, Point)>,
    /// Its height in pixels; 0 if no series has a name.
    pub(crate) height_px: f64,
}

impl Legend {
    /// The legend of named series within a width.
    pub(crate) fn new(series: &[(&str, Key)], width_px: f64) -> Self {
        let limit = width_px - KEY_PX - KEY_GAP_PX;
        let named: Vec<_> = series
            .iter()
            .map(|(name, key)| (*key, wrap(name, TICK_PX, limit, MOST_LINES)))
            .filter(|(_, lines)| !lines.is_empty())
            .collect();
        let widths: Vec<f64> = named.iter().map(|(_, lines)| entry_px(lines)).collect();
        let mut entries = Vec::new();
        let mut top = 0.0;
        let mut rest = named.as_slice();
        for lefts in rows(&widths, width_px) {
            let (row, after) = rest.split_at(lefts.len());
            rest = after;
            let lines = row.iter().map(|(_, lines)| lines.len()).max().unwrap_or(0);
            for ((key, lines), left) in row.iter().zip(lefts) {
                entries.push((*key, lines.clone(), (left, top)));
            }
            top += lines as f64 * TICK_PX * LINE_PITCH + ROW_GAP_PX;
        }
        Self { entries, height_px: top }
    }

    /// Draws the legend with its upper left corner at this point.
    pub(crate) fn draw(&self, drawing: &mut Drawing, (left, top): Point) {
        for (key, lines, (x, y)) in &self.entries {
            let x = left + x;
            for (i, line) in lines.iter().enumerate() {
                let baseline = top + y + TICK_PX + i as f64 * TICK_PX * LINE_PITCH;
                let at = (x + KEY_PX + KEY_GAP_PX, baseline);
                drawing.text(Text::new(line, at, TICK_PX, Anchor::Start));
            }
            key.draw(drawing, (x, top + y + TICK_PX * (1.0 - CAPITAL / 2.0)));
        }
    }
}

impl Key {
    /// Draws the key; the point is the centre of its left side.
    fn draw(self, drawing: &mut Drawing, (x, y): Point) {
        let line = [(x, y), (x + KEY_PX, y)];
        let middle = (x + KEY_PX / 2.0, y);
        let rect = Rect {
            left: x + KEY_PX / 4.0,
            right: x + KEY_PX,
            top: y - HALF_SWATCH_PX,
            bottom: y + HALF_SWATCH_PX,
        };
        match self {
            Self::Curve(look) => {
                let stroke = Stroke { colour: look.colour(), width_px: CURVE_PX };
                drawing.dashed(&line, stroke, look.dash_px());
                if look.has_markers() {
                    marker::draw(drawing, middle, look, marker::RADIUS_PX, look.colour());
                }
            }
            Self::Line(look) => {
                let stroke = Stroke { colour: look.colour(), width_px: CURVE_PX };
                drawing.dashed(&line, stroke, look.dash_px());
            }
            Self::Reference(look) => {
                let stroke = Stroke { colour: REFERENCE, width_px: REFERENCE_PX };
                drawing.dashed(&line, stroke, look.reference_dash_px());
            }
            Self::Bar(look) => swatch::draw(drawing, rect, look, look.colour()),
            Self::Box(look) => swatch::draw(drawing, rect, look, look.colour().tint(swatch::TINT)),
            Self::Marker(look) => {
                marker::draw(drawing, middle, look, marker::RADIUS_PX, look.colour());
            }
            Self::Dot(look) => drawing.disc(middle, DOT_PX, look.colour()),
            Self::Ring(look, radii_px) => {
                marker::draw_ring(drawing, middle, radii_px, look.colour());
            }
            Self::Fill(kind) => kind.draw_key(drawing, rect),
            Self::Span => {
                drawing.rect(rect, SPAN, Stroke { colour: SPAN_EDGE, width_px: SPAN_EDGE_PX });
            }
        }
    }
}

/// Each name once, with its first key.
pub(crate) fn once<'a>(
    keys: impl Iterator<Item = (&'a str, Key)>,
) -> impl Iterator<Item = (&'a str, Key)> {
    let mut names = BTreeSet::new();
    keys.filter(move |(name, _)| names.insert(*name))
}

fn entry_px(lines: &[String]) -> f64 {
    KEY_PX + KEY_GAP_PX + widest_px(lines, TICK_PX)
}

/// The left sides of the entries of each row. Entries are aligned in columns if that needs no more
/// rows than filling each row separately; otherwise each row is filled separately.
fn rows(widths: &[f64], limit_px: f64) -> Vec<Vec<f64>> {
    let filled = filled_rows(widths, limit_px);
    let count = widths.len();
    let mut in_columns = (1..=count).filter(|columns| count.div_ceil(*columns) <= filled.len());
    let lefts = in_columns.find_map(|c| column_lefts(widths, c, limit_px));
    let Some(lefts) = lefts else { return filled };
    let row = |first| lefts[..lefts.len().min(count - first)].to_vec();
    (0..count).step_by(lefts.len()).map(row).collect()
}

/// Fills the rows one after the other.
fn filled_rows(widths: &[f64], limit_px: f64) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut left = f64::INFINITY;
    for width in widths {
        if left + width > limit_px {
            rows.push(Vec::new());
            left = 0.0;
        }
        if let Some(row) = rows.last_mut() {
            row.push(left);
        }
        left += width + ENTRY_GAP_PX;
    }
    rows
}

/// The left sides of columns that are filled row by row, if they fit.
fn column_lefts(widths: &[f64], columns: usize, limit_px: f64) -> Option<Vec<f64>> {
    let mut lefts = vec![0.0];
    let mut left = 0.0;
    for column in 0..columns {
        let width = widths.iter().skip(column).step_by(columns).copied().fold(0.0, f64::max);
        if left + width > limit_px {
            return None;
        }
        left += width + ENTRY_GAP_PX;
        lefts.push(left);
    }
    lefts.pop();
    Some(lefts)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "what is exact is compared exactly")]
mod tests {
    use super::*;

    fn legend(names: &[&str], width_px: f64) -> Legend {
        let series: Vec<_> = names.iter().map(|n| (*n, Key::Curve(Look::new(0)))).collect();
        Legend::new(&series, width_px)
    }

    #[test]
    fn rows_wrap_by_width() {
        let four = legend(&["RMFR", "KFR", "VaFR", "Hyper3"], 420.0);
        assert!(four.entries.iter().all(|(_, _, (_, y))| *y == 0.0));
        let narrow = legend(&["RMFR", "KFR", "VaFR", "Hyper3"], 150.0);
        assert_eq!(narrow.entries[2].2.0, narrow.entries[0].2.0, "in columns");
        assert!(narrow.entries[2].2.1 > 0.0 && narrow.height_px > four.height_px);
        assert_eq!(legend(&["", " "], 420.0).height_px, 0.0);
    }

    #[test]
    fn stays_within_its_width() {
        let long = "a name as long as a line of this paper, and then some more of it ".repeat(4);
        for count in 1..13 {
            let names: Vec<&str> = (0..count).map(|i| [&long, "b", "Hyper3"][i % 3]).collect();
            let legend = legend(&names, 300.0);
            let mut drawing = Drawing { width_px: 300.0, height_px: 0.0, marks: Vec::new() };
            legend.draw(&mut drawing, (0.0, 0.0));
            let bounds: Vec<Rect> = drawing.texts().iter().map(|t| t.bounds()).collect();
            assert!(bounds.iter().all(|b| b.right <= 300.0 && b.bottom <= legend.height_px));
            for (i, a) in bounds.iter().enumerate() {
                assert!(bounds[..i].iter().all(|b| !a.overlaps(*b)));
            }
        }
    }
}
