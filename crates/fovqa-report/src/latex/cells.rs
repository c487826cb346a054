//! The cells of a column, and their width.

use super::escape::escaped;
use super::number::Fill;
use super::width::{lines, width};
use super::{Cell, Column, Sheet};

/// The width in points from which names are wrapped.
const WIDEST_TEXT: f64 = 130.0;
/// Longest part of a word, in characters, that is not broken where the word is too long.
const PIECE: usize = 6;

/// How the cells of a column are printed.
pub(super) struct Printer {
    is_text: bool,
    fill: Fill,
    /// The width in points, without the space between columns.
    pub(super) width: f64,
}

impl Printer {
    pub(super) fn of(sheet: &Sheet, index: usize) -> Self {
        let Column { head, is_text, .. } = &sheet.columns[index];
        let rows = || sheet.sections.iter().flat_map(|section| &section.rows);
        let cells = || rows().filter_map(|row| row.get(index));
        let fill = Fill::of(cells().filter_map(|cell| match cell {
            Cell::Number(number) => Some(number),
            Cell::Text(_) => None,
        }));
        let of_cell = |cell: &Cell| match cell {
            Cell::Number(number) => fill.width(number),
            Cell::Text(text) => width(text).min(WIDEST_TEXT),
        };
        let widest = cells().map(of_cell).fold(0.0, f64::max);
        let head = head.name_width().max(head.unit_width());
        Self { is_text: *is_text, width: widest.max(head), fill }
    }

    pub(super) fn text(&self, cell: &Cell) -> String {
        match cell {
            Cell::Number(number) => self.fill.text(number),
            Cell::Text(text) if width(text) > WIDEST_TEXT => {
                let side = if self.is_text { "\\raggedright" } else { "\\raggedleft" };
                wrapped(text, WIDEST_TEXT, 't', side)
            }
            Cell::Text(text) => escaped(text),
        }
    }

    /// The number of lines of a cell.
    pub(super) fn lines(cell: &Cell) -> usize {
        match cell {
            Cell::Text(text) if width(text) > WIDEST_TEXT => lines(text, WIDEST_TEXT),
            _ => 1,
        }
    }
}

/// A text in a box of this width, whose lines are aligned as `side` says.
pub(super) fn wrapped(text: &str, column: f64, place: char, side: &str) -> String {
    let text = broken(text, column);
    format!("\\parbox[{place}]{{{column}pt}}{{{side}\\strut {text}\\strut}}")
}

/// Escaped text in which words that are too long may be broken.
pub(super) fn broken(text: &str, column: f64) -> String {
    let word = |word: &str| {
        if width(word) < 0.9 * column {
            return escaped(word);
        }
        let chars: Vec<char> = word.chars().collect();
        let pieces = chars.chunks(PIECE).map(|piece| escaped(&piece.iter().collect::<String>()));
        pieces.collect::<Vec<_>>().join("\\allowbreak{}")
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}
